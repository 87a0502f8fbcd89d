"""The way back: values of eliminated variables from values of the variables that remain.

A ``Lift`` turns an assignment that satisfies what a step left behind into one that satisfies what the
step started from, by giving the eliminated variable a value. Values are exact.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Protocol

from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic, irreducible_roots, real_roots
from qe.exact.fibre_stack import isolate_over
from qe.exact.field import NumberField
from qe.exact.number import simplest
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or

_DEGREE = 200  # the largest degree of a field in which a value is computed
_ATTEMPTS = 400  # each attempt moves half as far as the one before

Value = Fraction | RealAlgebraic
Assignment = Mapping[str, Value]


class Lift(Protocol):
    """How one variable gets its value from those of the others (``Solve``, ``RootOf``, a choice of substitution)."""

    @property
    def variable(self) -> str: ...

    def value(self, assignment: Assignment) -> Value:
        """The value of the variable. Raises ``Unable`` where it is undefined."""
        ...


def value_at(poly: Poly, assignment: Assignment) -> Value:
    """The exact value of a polynomial; variables without a value count as 0."""
    names = [poly.ring.names[i] for i in poly.variables]
    values = {name: assignment.get(name, Fraction(0)) for name in names}
    if all(isinstance(v, Fraction) for v in values.values()):
        return poly.evaluate([values.get(name, Fraction(0)) for name in poly.ring.names])  # type: ignore[misc]
    algebraic = [name for name in names if not isinstance(values[name], Fraction)]
    if len(algebraic) == 1:
        return _in_field(poly, algebraic[0], values)
    return _over_point(poly, algebraic, values)


def _over_point(poly: Poly, algebraic: list[str], values: Assignment) -> Value:
    """The value where several variables have irrational ones: the root of t - poly over their point."""
    degree = prod(value.degree for name in algebraic if isinstance(value := values[name], RealAlgebraic))
    if degree > _DEGREE:
        raise Unable(f"a value in a field of degree up to {degree} is not computed")
    ring = Ring.of((*values, "t" * (1 + max(map(len, values)))))
    point = Point.of(ring, values.values())
    root_of = isolate_over(point, (ring.gen(point.depth) - poly.convert(ring),)).sections[0].value
    return simplest(point.extend(root_of).number(point.depth))


def _in_field(poly: Poly, name: str, values: Assignment) -> Value:
    """The value where a single variable has an irrational one: an element of the field that this one generates."""
    ring, theta = poly.ring, values[name]
    assert isinstance(theta, RealAlgebraic)
    known = {v: value for v, value in values.items() if isinstance(value, Fraction)}
    coefficients = [
        c.evaluate([known.get(v, Fraction(0)) for v in ring.names]) for c in poly.coefficients(ring.index[name])
    ]
    return simplest(NumberField(theta).element(coefficients).to_algebraic())


_ZERO = Fraction(0)


def sign_at(poly: Poly, assignment: Assignment) -> int:
    """The exact sign of a polynomial; variables without a value count as 0."""
    ring = poly.ring
    values: list[Value] = [_ZERO] * ring.size
    for i in poly.variables:
        values[i] = assignment.get(ring.names[i], _ZERO)
    if all(isinstance(values[i], Fraction) for i in poly.variables):
        return poly.sign_at(values)  # type: ignore[arg-type]
    return Point.of(ring, values).sign(poly)


def holds_at(formula: Formula, assignment: Assignment) -> bool:
    """The truth of a quantifier-free formula without root atoms. Raises ``Unable`` for others."""
    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return relation.holds(sign_at(poly, assignment))
        case And(args):
            return all(holds_at(a, assignment) for a in args)
        case Or(args):
            return any(holds_at(a, assignment) for a in args)
        case Not(arg):
            return not holds_at(arg, assignment)
    raise Unable("a branch that still has quantifiers or root atoms cannot be evaluated at a point")


@dataclass(frozen=True, slots=True)
class Solve:
    """variable = numerator / denominator; ``fallback`` where the denominator is 0 (None: it never is)."""

    variable: str
    numerator: Poly
    denominator: Poly
    fallback: Fraction | None = None

    def value(self, assignment: Assignment) -> Value:
        """The value of the variable. Raises ``Unable`` where it is undefined."""
        bottom = value_at(self.denominator, assignment)
        if bottom == 0:
            if self.fallback is None:
                raise Unable(f"the value of {self.variable} is undefined at this point")
            return self.fallback
        return simplest(value_at(self.numerator, assignment) / bottom)


@dataclass(frozen=True, slots=True)
class RootOf:
    """variable = the real ``degree``-th root (the non-negative one for even degree) of its present value."""

    variable: str
    degree: int

    def value(self, assignment: Assignment) -> Value:
        """The value of the variable. Raises ``Unable`` for an even root of a negative number."""
        return root(assignment.get(self.variable, Fraction(0)), self.degree)


def root(value: Value, degree: int) -> Value:
    """The exact real root of a number."""
    if value == 0 or degree == 1:
        return value
    if value < 0:
        if degree % 2 == 0:
            raise Unable("a negative number has no even root")
        return -root(-value, degree)
    number = value if isinstance(value, RealAlgebraic) else RealAlgebraic.rational(value)
    line = Ring.of(("t",))
    spread = line.from_terms({(degree * k,): c for k, c in enumerate(number.minimal_polynomial)})
    # t -> t^degree keeps the order of positive numbers: the place among the positive roots is the same
    above = sum(1 for r in irreducible_roots(number.poly) if r >= number)
    return simplest(real_roots(spread.to_univariate(0))[-above])


def perturb(variables: tuple[str, ...], body: Formula, start: Assignment) -> dict[str, Value]:
    """A point near ``start`` where the body holds; ``start`` itself if it does.

    For a body that is an open condition f and inequations p /= 0, with f true at ``start`` and no p the zero
    polynomial in these variables, nearly every direction has such points as near as one likes. Raises ``Unable``
    if none is found.
    """
    if holds_at(body, start):
        return dict(start)
    for k in range(1, _ATTEMPTS):
        direction = random.Random(k)
        moved: dict[str, Value] = dict(start)
        for name in variables:
            moved[name] = Fraction(direction.randint(-64, 64), 2 ** (k + 5)) + start.get(name, Fraction(0))
        if holds_at(body, moved):
            return moved
    raise Unable("no solution was found near a solution of the open part")

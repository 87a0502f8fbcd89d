"""Certificates that a system has these real solutions and no others (docs/certificates.md)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import pairwise

from qe.errors import InternalError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.polynomial_system import solutions, system_basis
from qe.exact.ring import Poly, Ring
from qe.exact.univariate import from_univariate
from qe.exact.zeros import Zero, linear_forms
from qe.expert.solutions import sentence
from qe.formula.syntax import Relation
from qe.options import Budget
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry, Json, poly_to_text
from qe.proof.multipliers import number_texts

Condition = tuple[Poly, Relation]

CONDITIONS = frozenset((Relation.GT, Relation.GE, Relation.NE))


def solutions_certificate(
    equations: Sequence[Poly],
    conditions: Sequence[Condition] = (),
    *,
    variables: Sequence[int] = (),
    constants: Mapping[int, RealAlgebraic] | None = None,
) -> Certificate:
    """That the real solutions of the equations with the conditions are those that are found here.

    ``variables``: those to be found beside the ones that occur. ``constants``: variables that stand for real algebraic
    numbers; their minimal polynomials join the equations and their isolating intervals the conditions, so that the
    certificate speaks about rational polynomials alone. Conditions are ``>``, ``>=`` or ``/=``. Raises as
    ``solve_system``.
    """
    fixed = dict(constants or {})
    basis = system_basis(equations, variables=variables, constants=fixed)
    ring, places = basis.ring, basis.variables
    used = [i for i in places if i in fixed]
    bounds = [c for i in used for c in _between(ring, i, fixed[i])]
    wanted = [*bounds, *conditions]
    if any({*p.variables} - {*places} for p, _ in wanted) or not {r for _, r in wanted} <= CONDITIONS:
        raise InternalError("a condition on solutions has an unknown variable or relation")
    found = [
        z
        for z in solutions(basis, constants={i: fixed[i] for i in used})
        if all(r.holds(z.sign(g)) for g, r in conditions)
    ]
    names = [ring.names[i] for i in places]
    separating = (form for form in linear_forms(len(names)) if all(_generates(z, form, names) for z in found))
    intervals = _intervals([z.values[names[0]].field.theta for z in found])
    own = Ring.of(names)
    given = [*equations, *(from_univariate(ring, i, fixed[i].poly) for i in used)]
    payload: dict[str, Json] = {
        "order": list(names),
        "equations": [poly_to_text(p.convert(own).normal()[1]) for p in given if p],
        "conditions": [[poly_to_text(g.convert(own)), r.value] for g, r in wanted],
        "weights": list(basis.weights),
        "form": list(next(separating)),
        "solutions": [_solution(z, names, ends) for z, ends in zip(found, intervals, strict=True)],
    }
    return Certificate.step("solutions", names, *sentence(Entry(payload, "evidence"), Budget()), payload)


def _between(ring: Ring, i: int, number: RealAlgebraic) -> list[Condition]:
    """That a variable lies in the isolating interval of a number, whose ends are no conjugates of it: as one condition,
    since the checker's work doubles with each."""
    if number.is_rational:
        return []
    low, high = number.interval()
    x = ring.gen(i)
    return [((low.denominator * x - low.numerator) * (high.numerator - high.denominator * x), Relation.GT)]


def _generates(zero: Zero, form: Sequence[int], names: Sequence[str]) -> bool:
    field = zero.values[names[0]].field
    total = field.rational(0)
    for c, name in zip(form, names, strict=True):
        total = total + zero.values[name] * c
    return bool(total == field.generator())


def _solution(zero: Zero, names: Sequence[str], ends: tuple[Fraction, Fraction]) -> Json:
    theta = zero.values[names[0]].field.theta
    numbers: list[Json] = [list[Json](number_texts(zero.values[name])) for name in names]
    minimal: list[Json] = [str(c) for c in theta.minimal_polynomial]
    interval: list[Json] = [str(end) for end in ends]
    return {"field": {"minimal_polynomial": minimal, "interval": interval}, "values": numbers}


def _intervals(numbers: Sequence[RealAlgebraic]) -> list[tuple[Fraction, Fraction]]:
    """Disjoint intervals of ascending numbers, so narrow that slopes of the minimal polynomials keep their signs."""
    bits = 64
    while True:
        found = [(n.as_fraction(),) * 2 if n.is_rational else n.interval(bits) for n in numbers]
        apart = all(one[1] < other[0] for one, other in pairwise(found))
        if apart and all(_is_steep(n.minimal_polynomial, *ends) for n, ends in zip(numbers, found, strict=True)):
            return found
        bits *= 2


def _is_steep(coefficients: Sequence[int], low: Fraction, high: Fraction) -> bool:
    """By the mean value theorem, with a bound of the second derivative."""
    slope = [k * c for k, c in enumerate(coefficients)][1:]
    middle, reach = (low + high) / 2, int(max(abs(low), abs(high))) + 1
    value = sum(c * middle**k for k, c in enumerate(slope))
    bound = sum(k * abs(c) * reach ** (k - 1) for k, c in enumerate(slope) if k)
    return bool(abs(value) > (high - low) * bound)

"""Terms that are no polynomials: quotients of polynomials, each where its guards hold.

A term is a list of cases whose guards exclude each other; where no case holds it has no value. So a comparison of terms
is the disjunction over all combinations of their cases of (guards and comparison), false where a side has no value.
The guards of a case make sure that its denominators are not zero.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import reduce
from itertools import product
from operator import mul
from typing import NamedTuple, TypeAlias

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, neg
from qe.formula.syntax import FALSE, TRUE, Atom, Formula, Relation
from qe.io import terms
from qe.io.terms import Value

Factors: TypeAlias = tuple[tuple[Poly, int], ...]


MOST_FACTORED = 60
"""Monomials of a denominator or radicand up to which it is factored, which makes later polynomials smaller."""


class Case(NamedTuple):
    """``value`` over the product of the powers of ``below``, where all ``guards`` hold."""

    guards: tuple[Formula, ...]
    value: Value
    below: Factors = ()


Cases: TypeAlias = tuple[Case, ...]


def plain(value: Value) -> Cases:
    """A polynomial."""
    return (Case((), value),)


def guarded(guards: Sequence[Formula], case: Case) -> Cases:
    """The case under further guards: one case, or none where they contradict each other."""
    joined = _joined(guards, case.guards)
    return () if joined is None else (Case(joined, case.value, case.below),)


def _joined(left: Sequence[Formula], right: Sequence[Formula]) -> tuple[Formula, ...] | None:
    """The guards of both together, without those that say nothing; None where one is false or another's negation."""
    guards = dict.fromkeys(guard for guard in left if guard != TRUE)
    for guard in right:
        if guard == FALSE or neg(guard) in guards:
            return None
        if guard != TRUE:
            guards[guard] = None
    return None if FALSE in guards else tuple(guards)


def combine(operands: Sequence[Cases], build: Callable[[Sequence[Case]], Case]) -> Cases:
    """``build`` applied to the operands, in every combination of their cases that is not contradictory at sight."""
    made: list[Case] = []
    for choice in product(*operands):
        guards: tuple[Formula, ...] | None = ()
        for case in choice:
            guards = None if guards is None else _joined(guards, case.guards)
        made += () if guards is None else guarded(guards, build(choice))
    return tuple(made)


def negative(case: Case) -> Case:
    """``-case``."""
    return case._replace(value=terms.negative(case.value))


def total(parts: Sequence[Case]) -> Case:
    """The sum, over the least denominator that the parts show."""
    below: dict[Poly, int] = {}
    for part in parts:
        for factor, k in part.below:
            below[factor] = max(below.get(factor, 0), k)
    values = []
    for part in parts:
        own, value = dict(part.below), part.value
        for factor, k in below.items():
            if missing := k - own.get(factor, 0):
                value = terms.product(value, terms.power(_value(factor), missing))
        values.append(value)
    return Case((), terms.total(values), tuple(below.items()))


def times(left: Case, right: Case) -> Case:
    """The product."""
    below = dict(left.below)
    for factor, k in right.below:
        below[factor] = below.get(factor, 0) + k
    return Case((), terms.product(left.value, right.value), tuple(below.items()))


def inverse(case: Case) -> Case:
    """``1/case`` where it is not zero, which the guards of the result say."""
    bottom = case.value.poly
    unit, below = (bottom.constant_value(), ()) if bottom.is_constant else split(bottom)
    top = terms.number(bottom.ring, Fraction(case.value.den, unit))
    for factor, k in case.below:
        top = terms.product(top, terms.power(_value(factor), k))
    return Case(tuple(atom(factor, Relation.NE) for factor, _ in below), top, below)


def split(poly: Poly) -> tuple[int, Factors]:
    """An integer and primitive polynomials with exponents whose product is the polynomial: factors, if it is short."""
    if poly.term_count() <= MOST_FACTORED:
        return poly.factors()
    unit, primitive = poly.normal()
    return unit, ((primitive, 1),)


def power(case: Case, exponent: int) -> Case:
    """``case ** exponent`` for a natural exponent."""
    return Case((), terms.power(case.value, exponent), tuple((f, k * exponent) for f, k in case.below if exponent))


def holds(case: Case, relation: Relation) -> Formula:
    """``guards and case relation 0``."""
    odd = [factor for factor, k in case.below if k % 2]
    if not odd or relation in (Relation.EQ, Relation.NE):
        return conj((*case.guards, atom(case.value.poly, relation)))
    below, implied = reduce(mul, odd), {Atom(factor, Relation.NE) for factor in odd}
    above = conj((atom(below, Relation.GT), atom(case.value.poly, relation)))
    under = conj((atom(below, Relation.LT), atom(case.value.poly, relation.flipped)))
    return conj((*(guard for guard in case.guards if guard not in implied), disj((above, under))))


def difference(left: Cases, right: Cases) -> Cases:
    """``left - right``: a comparison of the two compares it with zero."""
    return combine((left, right), lambda pair: total((pair[0], negative(pair[1]))))


def _value(poly: Poly) -> Value:
    return Value(poly, 1, poly.height_bits())

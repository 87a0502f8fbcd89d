"""Comparisons as people write them: ``0 < x <= 2/3``, ``x^2 + y^2 <= 1``, ``b^2 - 4*a*c >= 0``, ``x*(x - 2) <= 0``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import gcd, prod
from typing import NamedTuple

from qe.exact.ring import Poly
from qe.formula.linear_forms import Forms, in_linear_forms, is_short, with_forms
from qe.formula.notation import Level, Monomial, Notation, digits, monomials, oriented, polynomial, positive
from qe.formula.relation import Relation
from qe.formula.syntax import Atom, Formula
from qe.spelling import NUMBERS

MOST_MOVED = 6
"""Terms of an equation up to which some of them are moved to its right side."""
Side = tuple[list[Monomial], Relation, list[Monomial], int]
"""The left side of a comparison, the relation, and the right side with its denominator."""
End = tuple[list[Monomial], int]
"""A sum and its denominator."""


class Range(NamedTuple):
    """``0 < x <= 2``."""

    low: End
    above: Relation
    term: list[Monomial]
    under: Relation
    high: End
    forms: Forms

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        """As formulas are."""
        notation = with_forms(self.forms, notation)
        middle = f"{notation.relation(self.above)} {_sum(self.term, notation)} {notation.relation(self.under)}"
        return f"{end_text(*self.low, notation)} {middle} {end_text(*self.high, notation)}"


def sides(poly: Poly, relation: Relation) -> Side:
    """``poly relation 0`` as people write it: left side, relation, and right side with its denominator.

    A bound of one variable is ``x <= 2/3``. Linear terms stand where they are positive, and so does the constant
    next to sums and powers of positive terms (``x^2 + y^2 <= 1``); a variable is compared with one other term
    (``y <= x^2``, ``x^2 <= y^2``), positive terms are equal to those that follow (``x^2 + y^2 = z^2``). All else, as
    ``b^2 - 4*a*c > 0`` and ``x^2 - 2*x - 1 = 0``, is compared with 0.
    """
    parts, between, terms = _oriented(poly, relation)
    first, last = terms[0][1], terms[-1][1]
    names = {name for _, powers in terms for name, _ in powers}
    linear = poly.total_degree == 1
    if linear and len(terms) == 1:
        return _bounded(poly, relation)
    variable = [name for name, k in last] if sum(k for _, k in last) == 1 else []
    coefficients = [c for c, _ in parts]
    if not linear and coefficients == [terms[0][0], -1] and variable and variable[0] not in dict(first):
        return [(1, last)], between.flipped, [(terms[0][0], first)], 1
    bounded = len(terms) < len(parts) and all(c > 0 for c, _ in terms) and (len(names) > 1 or len(terms) == 1)
    if bounded and len(terms) > 1 and all(c == terms[0][0] and [k for _, k in m] == [2] for c, m in terms):
        return _bounded(poly, relation)  # a sphere and its squared radius
    powers = len(parts) == 2 == len(names) and all(len(m) == 1 and m[0][1] > 1 for _, m in parts)
    equal = (between is Relation.EQ or powers) and 1 < len(parts) <= MOST_MOVED and len(names) > 1
    if not (linear or bounded or (equal and coefficients == sorted(coefficients, key=lambda c: c < 0))):
        return parts, between, [], 1
    return [(c, m) for c, m in parts if c > 0], between, [(-c, m) for c, m in parts if c < 0], 1


def _oriented(poly: Poly, relation: Relation) -> tuple[list[Monomial], Relation, list[Monomial]]:
    """The monomials and the relation of ``poly relation 0``, and the monomials without numbers, the first positive."""
    parts, relation = oriented(poly, relation)
    terms = [part for part in parts if part[1]]
    if numbers := {*NUMBERS}.intersection(poly.ring.names):
        terms = [part for part in terms if not numbers.issuperset(dict(part[1]))] or terms
    if terms[0][0] > 0:
        return parts, relation, terms
    return [(-c, m) for c, m in parts], relation.flipped, [(-c, m) for c, m in terms]


def ranges(parts: Sequence[Formula]) -> list[Formula | Range]:
    """Conditions that hold together; a lower and an upper bound of one term that follow one another as a range."""
    listed: list[Formula | Range] = []
    for part in parts:
        both = _between(listed[-1], part) if listed else None
        if both is not None:
            listed.pop()
        listed.append(part if both is None else both)
    return listed


def _between(first: Formula | Range, second: Formula) -> Range | None:
    if not (isinstance(first, Atom) and isinstance(second, Atom)):
        return None
    (one, forms), (two, others) = in_linear_forms(first.poly), in_linear_forms(second.poly)
    if forms != others:
        one, two, forms = first.poly, second.poly, {}
    for form in (_bounded, sides):
        lower, upper = form(one, first.relation), form(two, second.relation)
        if lower[1] in (Relation.LT, Relation.LE):
            lower, upper = upper, lower
        left, above, low, below = lower
        same, under, high, over = upper
        if left == same and above in (Relation.GT, Relation.GE) and under in (Relation.LT, Relation.LE):
            known = form is _bounded and not any(powers for _, powers in (*low, *high))
            empty = known and _number(low) * over >= _number(high) * below
            return None if empty else Range((low, below), above.flipped, left, under, (high, over), forms)
    return None


def _bounded(poly: Poly, relation: Relation) -> Side:
    """``poly relation 0`` with a number on the right."""
    parts, relation, terms = _oriented(poly, relation)
    divisor = gcd(*(c for c, _ in terms))
    right = [(-c, powers) for c, powers in parts if (c, powers) not in terms]
    common = gcd(divisor, *(c for c, _ in right))
    left = [(c // divisor, powers) for c, powers in terms]
    return left, relation, [(c // common, powers) for c, powers in right], divisor // common


def _number(parts: list[Monomial]) -> int:
    return sum(c for c, powers in parts if not powers)


def end_text(parts: list[Monomial], divisor: int, notation: Notation) -> str:
    """A sum over a denominator; in brackets where no fraction is drawn."""
    text = polynomial(parts, notation)
    if len(parts) > 1 and divisor > 1 and notation.quotient("", "") == "/":
        text = f"{notation.brackets[0]}{text}{notation.brackets[1]}"
    return text if divisor == 1 else notation.quotient(text, digits(divisor))


def written(poly: Poly, relation: Relation, notation: Notation) -> str:
    """``poly relation 0`` by its ``sides``, in linear forms where that is shorter, or as a product of factors compared
    with 0 where that is no longer."""
    shorter, forms = in_linear_forms(poly)
    text = _by_sides(shorter, relation, with_forms(forms, notation) if forms else notation)
    if not is_short(poly):
        return text
    unit, factors = poly.factors()
    if len(factors) < 2:
        return text
    negative = (unit < 0) + sum(exponent for f, exponent in factors if monomials(f)[0][0] < 0)
    between = relation.flipped if negative % 2 else relation
    product = f"{_product(poly.ring.constant(1), factors, notation)} {notation.relation(between)} 0"
    return min(product, text, key=len)


def _by_sides(poly: Poly, relation: Relation, notation: Notation) -> str:
    left, between, right, divisor = sides(poly, relation)
    return f"{_sum(left, notation)} {notation.relation(between)} {end_text(right, divisor, notation)}"


def _sum(parts: list[Monomial], notation: Notation) -> str:
    """The sum, without the brackets around a linear form that is added."""
    before, after = map(re.escape, notation.brackets)
    return re.sub(rf"\+ {before}([^()-][^()]*){after}(?= |$)", r"+ \1", polynomial(parts, notation))


def _product(one: Poly, factors: Sequence[tuple[Poly, int]], notation: Notation) -> str:
    """The single term among the factors, and sums in brackets, short ones first."""
    before, after = notation.brackets
    term = prod((f**k for f, k in factors if f.term_count() == 1), start=one)
    sums = [(before + polynomial(positive(f), notation) + after, k) for f, k in factors if f.term_count() > 1]
    powers = sorted(
        (text if k == 1 else notation.power(text, k) for text, k in sums), key=lambda text: (len(text), text)
    )
    return notation.times.join([*([] if term.is_constant else [polynomial(positive(term), notation)]), *powers])

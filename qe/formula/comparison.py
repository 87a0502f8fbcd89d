"""Comparisons as people write them: ``x >= 2/3``, ``x^2 + y^2 <= 1``, ``b^2 - 4*a*c >= 0``, ``x*(x - 2) <= 0``."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import prod

from qe.exact.ring import Poly
from qe.formula.notation import Monomial, Notation, digits, monomials, oriented, polynomial, positive
from qe.formula.relation import Relation

MOST_FACTORED = 40
"""Terms, and total degree, up to which a polynomial is factored to be written."""


def sides(poly: Poly, relation: Relation) -> tuple[list[Monomial], Relation, list[Monomial], int]:
    """``poly relation 0`` as people write it: left side, relation, and right side with its denominator.

    A bound of one variable is ``x <= 2/3``. Linear terms stand where they are positive, and so does the constant
    next to sums and powers of positive terms (``x^2 + y^2 <= 1``); a variable is compared with one other term
    (``y <= x^2``). All else, as ``b^2 - 4*a*c`` and ``x^2 - 2*x - 1``, is compared with 0.
    """
    parts, relation = oriented(poly, relation)
    terms = [(c, powers) for c, powers in parts if powers]
    (lead, first), last = terms[0], terms[-1][1]
    names = {name for _, powers in terms for name, _ in powers}
    linear = poly.total_degree == 1
    if linear and len(terms) == 1:
        bound = Fraction(-sum(c for c, powers in parts if not powers), lead)
        return [(1, first)], relation, [(bound.numerator, ())] if bound else [], bound.denominator
    variable = [name for name, k in last] if sum(k for _, k in last) == 1 else []
    if not linear and [c for c, _ in parts] == [1, -1] and variable and variable[0] not in dict(first):
        return [(1, last)], relation.flipped, [(1, first)], 1
    bounded = len(terms) < len(parts) and all(c > 0 for c, _ in terms) and (len(names) > 1 or len(terms) == 1)
    if not (linear or bounded):
        return parts, relation, [], 1
    return [(c, m) for c, m in parts if c > 0], relation, [(-c, m) for c, m in parts if c < 0], 1


def written(poly: Poly, relation: Relation, notation: Notation) -> str:
    """``poly relation 0`` by its ``sides``, or as a product of factors compared with 0 where that is no longer."""
    left, between, right, divisor = sides(poly, relation)
    end = polynomial(right, notation)
    end = end if divisor == 1 else notation.quotient(end, digits(divisor))
    text = f"{polynomial(left, notation)} {notation.relation(between)} {end}"
    if not 1 < poly.term_count() <= MOST_FACTORED or not 1 < poly.total_degree <= MOST_FACTORED:
        return text
    unit, factors = poly.factors()
    if len(factors) < 2:
        return text
    negative = (unit < 0) + sum(exponent for f, exponent in factors if monomials(f)[0][0] < 0)
    between = relation.flipped if negative % 2 else relation
    product = f"{_product(poly.ring.constant(1), factors, notation)} {notation.relation(between)} 0"
    return min(product, text, key=len)


def _product(one: Poly, factors: Sequence[tuple[Poly, int]], notation: Notation) -> str:
    """The single term among the factors, and sums in brackets, short ones first."""
    before, after = notation.brackets
    term = prod((f**k for f, k in factors if f.term_count() == 1), start=one)
    sums = [(before + polynomial(positive(f), notation) + after, k) for f, k in factors if f.term_count() > 1]
    powers = sorted(
        (text if k == 1 else notation.power(text, k) for text, k in sums), key=lambda text: (len(text), text)
    )
    return notation.times.join([*([] if term.is_constant else [polynomial(positive(term), notation)]), *powers])

"""A multiple of an equation subtracted where a product remains: x^3 + p*x + q = 0 makes y^3 + p*y + q = 0 into
(y - x)*(x^2 + x*y + y^2 + p) = 0.

Theorem. Where q = 0 holds and a > 0, the polynomials p and (a*p - b*q)/c, c > 0, have the same sign.
The equation stays. What is replaced is irreducible, and the factors of what replaces it have lower degree: this ends.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import gcd

from qe.exact.ring import Poly, format_poly
from qe.exact.watch import IDLE
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.rewrite import rewrite
from qe.rules.step import StepKind
from qe.rules.tree import Pending
from qe.simplifier.facts import factor_list

MOST_TERMS = 40
"""Polynomials with more terms are left as they are."""


def difference(poly: Poly, equation: Poly) -> tuple[int, int, Poly] | None:
    """(a, b, r) with a > 0 and r = a*poly - b*equation, a proper product of factors of lower degree than ``poly``.

    None where there is none such that two terms cancel (one, if both have as many terms and one degree), or where
    ``poly`` is a product itself.
    """
    if poly == equation or max(poly.term_count(), equation.term_count()) > MOST_TERMS:
        return None
    if poly.total_degree < 2 or equation.total_degree > poly.total_degree:
        return None
    terms, other = dict(poly.terms()), dict(equation.terms())
    shared = [exponents for exponents in terms if exponents in other]
    ratios: dict[tuple[int, int], int] = {}
    for exponents in shared:
        common = gcd(terms[exponents], other[exponents])
        sign = 1 if other[exponents] > 0 else -1
        scale, factor = abs(other[exponents]) // common, terms[exponents] // common * sign
        ratios[scale, factor] = ratios.get((scale, factor), 0) + 1
    alike = len(terms) == len(other) and poly.total_degree == equation.total_degree
    likely = [ratio for ratio, count in ratios.items() if alike or count >= 2]
    if not likely or _is_product(poly):
        return None
    for a, b in likely:
        rest = a * poly - b * equation
        if rest and _is_product(rest) and all(f.total_degree < poly.total_degree for f, _ in factor_list(rest)):
            return a, b, rest
    return None


def _is_product(poly: Poly) -> bool:
    return len([f for f, _ in factor_list(poly) if not f.is_constant]) > 1


def cancelled(formula: Formula, equation: Poly, watch: Callable[[], object] = IDLE) -> Formula:
    """The formula with a multiple of the equation subtracted from every polynomial where a product remains."""

    def change(given: Atom) -> Formula:
        watch()
        known = difference(given.poly, equation)
        return given if known is None else atom(known[2], given.relation)

    return rewrite(formula, change, {equation.ring.names[i] for i in equation.variables})


def cancel_by(equations: Sequence[Poly], formula: Formula, watch: Callable[[], object] = IDLE) -> Formula:
    """The formula with multiples of the equations subtracted, one equation after the other."""
    for equation in equations:
        formula = cancelled(formula, equation, watch)
    return formula


def cancel_equations(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The first equation of the conjunction whose multiples make products of other polynomials is subtracted there."""
    parts = conjuncts(body)
    for k, part in enumerate(parts):
        if isinstance(part, Atom) and part.relation is Relation.EQ:
            changed = tuple(p if i == k else cancelled(p, part.poly, context.watch) for i, p in enumerate(parts))
            if changed != tuple(parts):
                return Found(StepKind.CANCELLING, format_poly(part.poly), Pending(variables, conj(changed)))
    return None

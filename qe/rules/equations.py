"""The equational part of a conjunction: Groebner reduction, splitting on factors, equations at a minimum.

Theorem (Groebner). Let I be the ideal of the polynomials of the equations in a conjunction E and f. Any other
generating set of I (or of an ideal between I and its radical) may replace E. If s*g - r is in I with s > 0, then
g and r have the same sign wherever E holds, so r may replace g in f. If 1 is in I, the conjunction is false.
Theorem (factors). g*h = 0 and f  iff  (g = 0 and f) or (h = 0 and f).
Theorem (minimum). A polynomial whose least value is 0 vanishes exactly where it attains that value.
No step introduces, removes or changes a variable: they all lift to themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from qe.exact.groebner import Basis, Limits, MonomialOrder, groebner_basis
from qe.exact.ring import Poly, format_poly
from qe.exact.watch import IDLE
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import atoms
from qe.rules.rewrite import rewrite
from qe.simplifier.facts import factor_list

_LARGE = 300  # terms: equations with more in all are not given to the Groebner engine
_LIMITS = Limits(elements=60, terms=250, bits=600)
_CERTAIN, _GUARDED = 3, 1  # what a variable that can be solved for is worth: without a case distinction, with one
_GROWTH = {_CERTAIN: (6, 60), _GUARDED: (2, 20)}  # (factor, terms) by which a system may grow for a gain of so much


def split_equations(parts: Sequence[Formula]) -> tuple[list[Poly], list[Formula]]:
    """The polynomials of the equations, and the other conjuncts."""
    equations = [p.poly for p in parts if isinstance(p, Atom) and p.relation is Relation.EQ]
    others = [p for p in parts if not (isinstance(p, Atom) and p.relation is Relation.EQ)]
    return equations, others


def variable_order(formula: Formula, block: Sequence[str]) -> tuple[int, ...]:
    """The variables of the formula, those of the block first, within each part the ones in fewer atoms first."""
    counts: dict[int, int] = {}
    names: tuple[str, ...] = ()
    for atomic in atoms(formula):
        names = atomic.poly.ring.names
        for i in atomic.poly.variables:
            counts[i] = counts.get(i, 0) + 1
    return tuple(sorted(counts, key=lambda i: (names[i] not in block, counts[i], -i)))


def ideal_basis(polys: Sequence[Poly], variables: Sequence[int]) -> Basis | None:
    """A Groebner basis of the equations in a graded order, or None where it is too large."""
    if not polys or sum(p.term_count() for p in polys) > _LARGE:
        return None
    return groebner_basis(polys, variables=variables, limits=_LIMITS)


def reduce_atoms(formula: Formula, basis: Basis, watch: Callable[[], object] = IDLE) -> Formula:
    """The formula with every atom's polynomial replaced by its normal form where that is simpler."""

    def change(given: Atom) -> Formula:
        watch()
        scale, rest = basis.reduce(given.poly)
        if not rest:
            return atom(rest, given.relation)
        rest = rest if scale > 0 else -rest
        if complexity(rest) < complexity(given.poly):
            return atom(rest, given.relation)
        return given

    names = {basis.ring.names[i] for p in basis.polys for i in p.variables}
    return rewrite(formula, change, names)


def reduce_by_equations(
    assumed: Sequence[Formula], parts: Sequence[Formula], watch: Callable[[], object] = IDLE
) -> tuple[Formula, ...]:
    """The parts, every one that has quantifiers with its atoms reduced by the equations among what is assumed."""
    equations, _ = split_equations(assumed)
    basis = ideal_basis(squarefree(equations), variable_order(conj((*assumed, *parts)), ())) if equations else None
    if basis is None or basis.is_unit:
        return tuple(parts)
    return tuple(part if part.is_quantifier_free else reduce_atoms(part, basis, watch) for part in parts)


def complexity(poly: Poly) -> tuple[int, int, int]:
    """How bad a polynomial is: total degree, number of variables, number of terms."""
    return poly.total_degree, len(poly.variables), poly.term_count()


def better_equations(old: Sequence[Poly], basis: Basis, block: Sequence[str]) -> tuple[Poly, ...]:
    """The generators to go on with: the old ones, linear combinations of them, the basis, or a lexicographic basis.

    Variables that can be solved for count first (as long as the size stays moderate), then the size.
    """
    best: tuple[Poly, ...] = tuple(dict.fromkeys(old))
    candidates = [combined(best), basis.polys]
    if len(basis.polys) > 1:
        triangular = groebner_basis(basis.polys, variables=basis.variables, order=MonomialOrder.LEX, limits=_LIMITS)
        if triangular is not None:
            candidates.append(triangular.polys)
    for polys in candidates:
        gain = _solvable(polys, block) - _solvable(best, block)
        size, room = total(polys), total(best)
        allowed = any(gain >= worth and size <= factor * room + more for worth, (factor, more) in _GROWTH.items())
        if allowed or (gain >= 0 and size < room):
            best = polys
    return best


def combined(polys: Sequence[Poly]) -> tuple[Poly, ...]:
    """Linear combinations over Q that span the same space, no two with the same leading monomial (by total degree).

    They have no monomial that the given ones have not: what is linear in a variable after the higher terms cancel (the
    difference of two circles) appears, without the growth of a basis.
    """
    rows: dict[tuple[int, ...], Poly] = {}
    for poly in sorted(dict.fromkeys(polys), key=Poly.term_count):
        while poly:
            lead, coefficient = _leading(poly)
            if lead not in rows:
                rows[lead] = poly
                break
            other = rows[lead]
            poly = (_leading(other)[1] * poly - coefficient * other).normal()[1]
    return tuple(rows.values())


def _leading(poly: Poly) -> tuple[tuple[int, ...], int]:
    """The term of the greatest monomial by total degree, then lexicographically."""
    return max(poly.terms(), key=lambda term: (sum(term[0]), term[0]))


def total(polys: Sequence[Poly]) -> int:
    """The size of a system: terms weighted with degrees."""
    return sum(p.term_count() * max(1, p.total_degree) for p in polys)


def _solvable(polys: Sequence[Poly], block: Sequence[str]) -> int:
    """Variables of the block with an equation linear in them: more for a constant coefficient than for another.

    The latter counts only in a block of several variables: a single one is left to methods that need no guards.
    """
    names = polys[0].ring.names
    worth: dict[int, int] = {}
    for p in polys:
        for i in p.variables:
            if names[i] in block and p.degree(i) == 1:
                worth[i] = max(worth.get(i, 0), _CERTAIN if p.leading(i).is_constant else _GUARDED * (len(block) > 1))
    return sum(worth.values())


def squarefree(polys: Sequence[Poly]) -> tuple[Poly, ...]:
    """Every polynomial replaced by the product of its distinct factors (between the ideal and its radical)."""
    out = []
    for p in polys:
        product = p.ring.constant(1)
        for factor, _ in factor_list(p):
            product = product * factor
        out.append(product if not p.is_constant else p)
    return tuple(out)


def factor_choice(equations: Sequence[Poly], limit: int) -> tuple[int, tuple[Poly, ...]] | None:
    """The equation with the simplest proper factorisation: (its position, its distinct factors)."""
    best: tuple[int, tuple[Poly, ...]] | None = None
    for position, poly in enumerate(equations):
        factors = tuple(f for f, _ in factor_list(poly))
        if 1 < len(factors) <= limit:
            key = (len(factors), sum(f.total_degree for f in factors))
            if best is None or key < (len(best[1]), sum(f.total_degree for f in best[1])):
                best = position, factors
    return best


def describe(polys: Sequence[Poly]) -> str:
    """The equations for the record."""
    shown = [format_poly(p) for p in polys[:3]]
    return ", ".join(shown) + (", ..." if len(polys) > 3 else "")

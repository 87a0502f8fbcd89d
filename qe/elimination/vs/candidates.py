"""Elimination sets: test points such that a formula holds somewhere iff it holds at one of them.

THEOREM. Let F be a positive (and/or) combination of atoms, of degree at most 3 in x after factoring, over fixed
parameters. If F holds for some real x, then F holds at -infinity, or the leftmost point of a component of its
truth set is a root e where F becomes true: at e (closed) or just right of e (open). Some atom occurrence turns
true there, together with every subformula on the way to the root of the tree. Therefore
* an atom gives the points where it can turn true: =, <=, >= at the root; <, >, /= at the root + epsilon; and if it
  is p < 0 or p <= 0 (p > 0, p >= 0) with a simple root only where p falls (rises);
* only the disjunct containing the atom need be kept at each disjunction above it (``Candidate.formula``);
* if one conjunct has finitely many solutions (a *Gauss* constituent), its points alone suffice, and no infinity.
Upper ends, +infinity and root - epsilon are the mirror image (``side = -1``).
Loos & Weispfenning 1993, sections 3-4; Weispfenning 1997; Kosta 2016, chapters 3-4 (structural elimination sets).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import chain

from qe.elimination.vs.points import CubicRoot, LinearRoot, Root
from qe.elimination.vs.roots import ROWS
from qe.exact.ring import Poly
from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, And, Atom, Formula, Or, Relation
from qe.formula.traverse import conjuncts, disjuncts
from qe.simplifier.factors import atom_under
from qe.simplifier.facts import Facts, factor_list

EQ, NE, LT, GT, GE = Relation.EQ, Relation.NE, Relation.LT, Relation.GT, Relation.GE
_UPWARD = (GT, GE)

# Estimates of the size of what a substitution produces, in units of a linear root with a constant denominator: round
# numbers, as half or twice as much of any changes little.
_LINEAR = 2.0  # a linear root whose denominator has parameters: its sign matters for odd degrees
_QUADRATIC = 6.0  # a root with a square root: the tables make up to five atoms of one
_CUBIC = 20.0  # a root of a cubic: four to twenty-six atoms of one
_EPSILON = 2.0  # factor for a point next to a root: each derivative adds a case
_PER_DEGREE = 0.5  # per degree of a coefficient that is multiplied in (twice that for the leading one under a root)
_DEGENERATE = 4.0  # a Gauss constituent that may vanish: the problem without it comes on top


@dataclass(frozen=True, slots=True)
class Candidate:
    """Try ``formula`` at ``point`` where ``guard`` holds. ``formula`` implies the formula it was taken from.

    ``source`` is the atom that turns true at the point; ``complete``: all such points of it are candidates.
    """

    point: Root
    guard: Formula
    formula: Formula
    source: Atom
    complete: bool = True


@dataclass(frozen=True, slots=True)
class Gauss:
    """A constituent with finitely many solutions, all among the candidates, except where ``degenerate`` holds."""

    candidates: tuple[Candidate, ...]
    degenerate: Formula


def bounds(
    formula: Formula, x: int, side: int, facts: Facts, omit: frozenset[Poly] = frozenset(), highest: int = 2
) -> tuple[Candidate, ...] | None:
    """Candidates for the lower (side 1) or upper (side -1) ends of the truth set; None if a degree is too high.

    The roots of the polynomials ``omit``, of degree 2, are left out where their leading coefficient is not 0.
    ``highest``: the degree of a factor up to which its roots are points, at most that of ``roots.ROWS``.
    """
    match formula:
        case Atom(poly, _):
            return _atom_points(formula, x, side, facts, omit, highest) if poly.degree(x) else ()
        case And(args):
            gauss = best_gauss([gauss_constituent(a, x, side, facts, highest) for a in args])
            if gauss is not None:
                return _with_gauss(formula, *gauss, x, side, facts, omit, highest)
            ends_of_parts = (bounds(arg, x, side, facts, omit, highest) for arg in args)
            return _joined(within(formula, args, k, ends) for k, ends in enumerate(ends_of_parts))
        case Or(args):
            return _joined(bounds(arg, x, side, facts, omit, highest) for arg in args)
    return ()


def gauss_constituent(formula: Formula, x: int, side: int, facts: Facts, highest: int = 2) -> Gauss | None:
    """The formula as a Gauss constituent, or None if it is none (or its degree is too high)."""
    match formula:
        case Atom(poly, Relation.EQ) if poly.degree(x):
            points = _atom_points(formula, x, side, facts, frozenset(), highest)
            return None if points is None else Gauss(points, vanishing(poly, x, facts))
        case Or(args):
            parts = [gauss_constituent(a, x, side, facts, highest) for a in args]
            constituents = [p for p in parts if p is not None]
            if len(constituents) < len(parts):
                return None
            return Gauss(tuple(chain(*(p.candidates for p in constituents))), disj(p.degenerate for p in constituents))
        case And(args):
            best = best_gauss([gauss_constituent(a, x, side, facts, highest) for a in args])
            if best is None:
                return None
            gauss, k = best
            return Gauss(within(formula, args, k, gauss.candidates) or (), gauss.degenerate)
    return None


def best_gauss(options: list[Gauss | None]) -> tuple[Gauss, int] | None:
    """The Gauss constituent with the cheapest candidates, and its position."""
    ranked = [(gauss, k) for k, gauss in enumerate(options) if gauss is not None]
    return min(ranked, key=lambda pair: gauss_cost(pair[0]), default=None)


def gauss_cost(gauss: Gauss) -> float:
    """An estimate of the work that a Gauss constituent causes."""
    return points_cost(gauss.candidates) + (0.0 if gauss.degenerate == FALSE else _DEGENERATE)


def points_cost(candidates: Iterable[Candidate]) -> float:
    """An estimate of the size of the formulas that substituting these candidates produces."""
    total = 0.0
    for candidate in candidates:
        point = candidate.point
        if isinstance(point, CubicRoot):
            weight = _CUBIC + _PER_DEGREE * sum(c.total_degree for c in point.coefficients)
        elif isinstance(point, LinearRoot):
            weight = 1.0 if point.a.is_constant else _LINEAR + _PER_DEGREE * point.a.total_degree
        else:
            weight = _QUADRATIC + _PER_DEGREE * (2 * point.a.total_degree + point.b.total_degree)
        total += weight * (_EPSILON if point.epsilon else 1.0)
    return total


def in_order(candidates: Iterable[Candidate]) -> Iterator[tuple[Candidate, frozenset[Atom]]]:
    """The distinct candidates, atom by atom, cheap atoms first; each with the atoms *settled* for it.

    THEOREM. Let all candidates of the strict atom p < 0 (or p > 0, p /= 0) have been tried already, and let it be a
    conjunct of the formula F of a candidate e + epsilon. Then only the case p(e) /= 0 is left to try. Proof: if F
    is true just right of e and p(e) = 0, then the atom turns true at e, so e + epsilon was one of its candidates,
    with a formula that F implies.
    """
    by_source: dict[Atom, list[Candidate]] = {}
    for candidate in dict.fromkeys(candidates):
        by_source.setdefault(candidate.source, []).append(candidate)
    tried: set[Atom] = set()
    for source, group in sorted(by_source.items(), key=lambda item: points_cost(item[1])):
        for candidate in group:
            members = conjuncts(candidate.formula) if candidate.point.epsilon else ()
            yield candidate, frozenset(a for a in members if isinstance(a, Atom) and a in tried)
        if source.relation.is_strict and all(c.complete for c in group):
            tried.add(source)


def vanishing(f: Poly, x: int, facts: Facts) -> Formula:
    """The condition that f vanishes identically in x: a factor without x does, or all coefficients of another."""
    parts = factor_list(f)
    cases = []
    for factor, _ in parts:
        if factor.degree(x):
            cases.append(conj(atom_under(c, EQ, facts) for c in reversed(factor.coefficients(x)) if c))
        else:
            cases.append(atom_under(factor, EQ, facts))
    return disj(cases)


def _with_gauss(
    whole: And, gauss: Gauss, k: int, x: int, side: int, facts: Facts, omit: frozenset[Poly], highest: int
) -> tuple[Candidate, ...] | None:
    """The Gauss constituent's candidates, and where it degenerates those of the other conjuncts.

    Where it degenerates, equations joined by "or" are true for all x. Any other constituent can turn true there, too.
    """
    args = whole.args
    inner = within(whole, args, k, gauss.candidates)
    if gauss.degenerate == FALSE or inner is None:
        return inner
    kept = [j for j in range(len(args)) if j != k or any(isinstance(a, And) for a in disjuncts(args[k]))]
    others = _joined(within(whole, args, j, bounds(args[j], x, side, facts, omit, highest)) for j in kept)
    if others is None:
        return None
    return (*inner, *(replace(c, guard=conj((gauss.degenerate, c.guard))) for c in others))


def within(
    whole: Formula, args: tuple[Formula, ...], k: int, ends: tuple[Candidate, ...] | None
) -> tuple[Candidate, ...] | None:
    """Candidates of conjunct k as candidates of the conjunction."""
    if ends is None:
        return None
    rest = (*args[:k], *args[k + 1 :])
    return tuple(replace(c, formula=whole if c.formula is args[k] else conj((c.formula, *rest))) for c in ends)


def _joined(parts: Iterable[tuple[Candidate, ...] | None]) -> tuple[Candidate, ...] | None:
    out: list[Candidate] = []
    for part in parts:
        if part is None:
            return None
        out += part
    return tuple(out)


def _atom_points(
    given: Atom, x: int, side: int, facts: Facts, omit: frozenset[Poly], highest: int
) -> tuple[Candidate, ...] | None:
    """The points where the atom can turn true, with guards."""
    inside = [(f, e) for f, e in factor_list(given.poly) if f.degree(x)]
    if any(f.degree(x) > highest for f, _ in inside):
        return None
    relation = given.relation
    # A weak atom (=, <=, >=) is true at the root itself. A strict one is false there, and true right after it as seen
    # from the end that is sought: on the right of a lower end (side 1), on the left of an upper one (side -1).
    epsilon = side if relation.is_strict else 0
    # With one factor in x, of odd exponent, the polynomial changes its sign at every simple root, by the sign of the
    # factor's slope and of its content. < and > (also weak) turn true only where it changes in one direction: upwards
    # for > at a lower end, and the other way for < and for upper ends. So a guard on the content's sign keeps one of
    # two roots of a quadratic factor, and none is wasted on a linear one. = and /= turn true whatever the direction,
    # an even exponent gives no change of sign, and several factors leave the sign of the others at the root open.
    directed = len(inside) == 1 and inside[0][1] % 2 == 1 and relation not in (EQ, NE)
    content = given.poly.exact_divide(inside[0][0] ** inside[0][1]) if directed else None
    direction = side if relation in _UPWARD else -side
    out: list[Candidate] = []
    for factor, _ in inside:
        found = _roots(given, factor.coefficients(x), epsilon, content, direction, facts)
        # The roots of an omitted quadratic are replaced by other points (``radical_free``); where its leading
        # coefficient vanishes it is linear, and that root stays. The atom's points are then not all candidates.
        if factor in omit:
            found = (replace(c, complete=False) for c in found if isinstance(c.point, LinearRoot))
        out += found
    return tuple(out)


def _roots(
    given: Atom,
    coefficients: tuple[Poly, ...],
    epsilon: int,
    content: Poly | None,
    direction: int,
    facts: Facts,
    above: tuple[Formula, ...] = (),
) -> Iterator[Candidate]:
    """The roots of a factor by the rows of its degree, and where its leading coefficient is 0, of those below.

    Of a row those with the sign ``direction`` of content*slope, if a direction is known. ``above``: that the
    coefficients of higher degrees vanish.
    """
    lead = coefficients[-1]
    for row in ROWS[len(coefficients) - 1](coefficients, epsilon):
        guard = [atom_under(p, relation, facts) for p, relation in row.real]
        if content is None or row.slope.is_constant:
            guard.insert(0, atom_under(lead, NE, facts))
        if content is not None:
            guard.append(atom_under(content * row.slope, GT if direction > 0 else LT, facts))
        condition = conj((*above, *guard))
        if condition != FALSE:
            yield Candidate(row.point, condition, given, given)
    flat = conj((*above, atom_under(lead, EQ, facts)))
    lower = next((k for k in range(len(coefficients) - 1, 1, -1) if coefficients[k - 1]), 0)
    if flat != FALSE and lower:
        yield from _roots(given, coefficients[:lower], epsilon, content, direction, facts, (flat,))

"""Elimination sets without square roots: vertices and crossings of parabolas instead of their roots."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

from qe.elimination.vs.candidates import Candidate, bounds
from qe.elimination.vs.points import LinearRoot
from qe.exact.ring import Poly
from qe.formula.syntax import FALSE, Atom, Formula, Relation
from qe.formula.traverse import atoms, conjuncts
from qe.simplifier.factors import atom_under
from qe.simplifier.facts import Facts, factor_list

EQ, NE, LT, LE, GT = Relation.EQ, Relation.NE, Relation.LT, Relation.LE, Relation.GT


def without_radicals(formula: Formula, x: int, facts: Facts, highest: int = 2) -> tuple[Candidate, ...] | None:
    """Candidates that, with both infinities, are an elimination set without square roots; None if none applies."""
    family = convex_family(formula, x, facts)
    if family:
        return _of_family(formula, family, x, facts, highest)
    g = lone_quadratic(formula, x)
    return None if g is None else _of_lone(formula, g, x, facts)


def lone_quadratic(formula: Formula, x: int) -> Poly | None:
    """The only irreducible factor of degree 2 in x, if it stands alone (but for factors without x) in inequalities.

    At most one occurrence may be weak, none an equation. None if there is no such factor.
    """
    found: Poly | None = None
    weak = 0
    for given in atoms(formula):
        if not given.poly.degree(x):
            continue
        inside = [(f, e) for f, e in factor_list(given.poly) if f.degree(x)]
        for factor, exponent in inside:
            if factor.degree(x) < 2:
                continue
            if factor.degree(x) > 2 or (found is not None and factor != found):
                return None
            if len(inside) > 1 or exponent % 2 == 0 or given.relation is EQ:
                return None
            found = factor
            weak += not given.relation.is_strict
    return found if weak <= 1 else None


def _of_lone(formula: Formula, g: Poly, x: int, facts: Facts) -> tuple[Candidate, ...] | None:
    """THEOREM. Let g = a*x^2 + b*x + c be the lone quadratic of F. If F holds somewhere, it holds at an infinity, or

    at the lower or upper end of a component of its truth set that is a root of another atom's polynomial (or of g
    where a = 0), or at -b/(2*a), a /= 0. Proof: otherwise both ends of a component are roots of g and come from
    atoms in g. If they differ, the vertex of g is between them. If they coincide, the atom turns true at a root
    and false right after it, so it is the weak one and the root is double, the vertex.
    """
    ends = _other_ends(formula, x, facts, frozenset((g,)), 2)
    if ends is None:
        return None
    return (*ends, *_zero_of(g.derivative(x), x, facts, formula, Atom(g, LT), atom_under(g.leading(x), NE, facts)))


@dataclass(frozen=True, slots=True)
class Parabola:
    """A conjoined atom ``f < 0`` or ``f <= 0`` with the leading coefficient of f in x positive; ``factor``: of f."""

    source: Atom
    factor: Poly
    f: Poly


def convex_family(formula: Formula, x: int, facts: Facts) -> tuple[Parabola, ...]:
    """The conjuncts f < 0 and f <= 0 (f of degree 2, known positive leading coefficient) met nowhere else."""
    family: list[Parabola] = []
    elsewhere: set[Poly] = set()
    for part in conjuncts(formula):
        parabola = _parabola(part, x, facts) if isinstance(part, Atom) else None
        if parabola is not None:
            family.append(parabola)
        else:
            elsewhere |= {f for a in atoms(part) for f, _ in factor_list(a.poly)}
    return tuple(p for p in family if p.factor not in elsewhere)


def _parabola(given: Atom, x: int, facts: Facts) -> Parabola | None:
    if given.relation in (EQ, NE) or given.poly.degree(x) != 2:
        return None
    f = given.poly if given.relation in (LT, LE) else -given.poly
    inside = [(g, e) for g, e in factor_list(given.poly) if g.degree(x)]
    if len(inside) != 1 or inside[0][1] != 1 or facts.sign(f.leading(x)) != 1:
        return None
    return Parabola(given, inside[0][0], f)


def _of_family(
    formula: Formula, family: tuple[Parabola, ...], x: int, facts: Facts, highest: int
) -> tuple[Candidate, ...] | None:
    """THEOREM. Let F = f1 ? 0 and ... and fm ? 0 and G (each ? is < or <=), fi with leading coefficient ai > 0. If F

    holds somewhere, it holds at an infinity, or at an end of a component of its truth set that comes from an atom
    of G, or at the vertex of some fi, or at the root of the (at most linear) hij = aj*fi - ai*fj for some i < j.
    Proof: otherwise take a component from e1 to e2 where fi turns true at e1 and fj false after e2, fi = fj possible.
    All f are <= 0 between, so hij(e1) >= 0 >= hij(e2). If e1 = e2 it is a zero of hij, or hij vanishes identically
    and the root is double, the vertex. If e1 < e2 and hij changes sign, its root is inside. If hij(e1) = 0, then
    fj(e1) = 0 = fj(e2) and the vertex of fj is inside; if hij(e2) = 0, likewise for fi.
    """
    ends = _other_ends(formula, x, facts, frozenset(p.factor for p in family), highest)
    if ends is None:
        return None
    out = list(ends)
    for p in family:
        out += _zero_of(p.f.derivative(x), x, facts, formula, p.source)
    for p, q in combinations(family, 2):
        out += _zero_of(q.f.leading(x) * p.f - p.f.leading(x) * q.f, x, facts, formula, p.source)
    return tuple(out)


def _other_ends(
    formula: Formula, x: int, facts: Facts, omit: frozenset[Poly], highest: int
) -> tuple[Candidate, ...] | None:
    """The lower and the upper ends that come from other polynomials."""
    lower, upper = (bounds(formula, x, side, facts, omit, highest) for side in (1, -1))
    return None if lower is None or upper is None else lower + upper


def _zero_of(
    p: Poly, x: int, facts: Facts, formula: Formula, source: Atom, guard: Formula | None = None
) -> tuple[Candidate, ...]:
    """The root of a polynomial of degree at most 1, tried in the whole formula."""
    factor = next((f for f, _ in factor_list(p) if f.degree(x)), None) if p else None
    if factor is None:
        return ()
    b, a = factor.coefficients(x)
    condition = atom_under(a, NE, facts) if guard is None else guard
    if condition == FALSE:
        return ()
    return (Candidate(LinearRoot(a, b), condition, formula, source, complete=False),)

"""Elimination sets without square roots: vertices and crossings of parabolas for their roots.

THEOREM 1. Let g = a*x^2 + b*x + c be a factor of F's atoms, alone in them (but for factors without x), with an odd
exponent, in no equation, and in at most one that is weak (<=, >=). If F holds somewhere, it holds at -oo or +oo, or
at an end of a component of its solutions that is no root of g with a /= 0, or at -b/(2*a) with a /= 0. Proof:
otherwise both ends of a component are such roots, of atoms in g. If they differ, the vertex is inside. If not, an
atom turns true at a root and an atom false just after it: both are the weak one, which is false on both sides: the
root is double.

THEOREM 2. Let f1, ..., fm of degree 2 with leading coefficients ai > 0 be in conjuncts fi < 0 or fi <= 0 of F, and
their factors with x nowhere else. If F holds somewhere, it holds at -oo or +oo, or at an end of a component that is
no root of them, or at the vertex of some fi, or at the root of some hij = aj*fi - ai*fj, of degree at most 1. Proof:
otherwise take a component from e1 to e2, where fi turns true at e1 and fj false after e2. All f are <= 0 between, so
hij(e1) >= 0 >= hij(e2). If e1 = e2, it is a root of hij, or i = j or hij is identically 0, and it is the vertex of
fi. If e1 < e2 and hij changes its sign, its root is inside. If hij(e1) = 0, then fj(e1) = fj(e2) = 0, and the vertex
of fj is inside; if hij(e2) = 0, that of fi is. Where some ai is not known to be positive, a point without value must
keep the problem.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from qe.errors import CertificateRejected
from qe.exact.ring import Poly
from qe.formula.build import atom, neg
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.formula.traverse import atoms, conjuncts
from qe.kernel.turning_cover import Cover, Met
from qe.kernel.turning_points import Turn, inside
from qe.kernel.virtual_substitution import TestPoint

EQ, NE, LT, LE, GT = Relation.EQ, Relation.NE, Relation.LT, Relation.LE, Relation.GT


def replaced_ends(cover: Cover, body: Formula, quadratics: Sequence[Poly]) -> list[Met]:
    """What is used of the points, which meet one of the theorems. ``quadratics``: g alone, or f1, ..., fm.

    Raises ``CertificateRejected`` (without a path) where they do not.
    """
    if len(quadratics) == 1 and _is_lone(body, quadratics[0], cover.x):
        g = quadratics[0]
        omitted = frozenset((g,))
        found = [_crossing(cover, g.derivative(cover.x), body, (atom(g.leading(cover.x), NE),))]
    else:
        omitted = frozenset(_family(body, quadratics, cover))
        positive = tuple(atom(f.leading(cover.x), GT) for f in quadratics)
        found = [_known(cover, condition, body) for condition in positive]
        found += [_crossing(cover, f.derivative(cover.x), body, positive) for f in quadratics]
        for f, g in combinations(quadratics, 2):
            found.append(_crossing(cover, g.leading(cover.x) * f - f.leading(cover.x) * g, body, positive))
    for side in (1, -1):
        found += [cover.far(body, side, ()), cover.ends(body, (), side, (), omitted)]
    if None in found:
        raise CertificateRejected("", f"no point for {cover.missing}")
    return [met for part in found if part for met in part]


def _is_lone(body: Formula, g: Poly, x: int) -> bool:
    with_g = [a for a in atoms(body) if isinstance(a, Atom) and any(f == g for f, _ in inside(a.poly, x))]
    for found in with_g:
        parts = inside(found.poly, x)
        if len(parts) > 1 or parts[0][1] % 2 == 0 or found.relation is EQ:
            return False
    weak = sum(not found.relation.is_strict for found in with_g)
    return bool(with_g) and weak <= 1 and g.degree(x) == 2


def _family(body: Formula, quadratics: Sequence[Poly], cover: Cover) -> set[Poly]:
    """The factors of the f, each of which stands only in conjuncts f < 0 and f <= 0."""
    found: set[Poly] = set()
    members = {Atom(f.normal()[1], r if f.normal()[0] > 0 else r.flipped) for f in quadratics for r in (LT, LE)}
    for f in quadratics:
        parts = inside(f, cover.x) if f.degree(cover.x) == 2 else []
        if len(parts) != 1 or parts[0][1] != 1:
            raise CertificateRejected("", f"{f} is not of degree 2 in one factor")
        found.add(parts[0][0])
    for part in conjuncts(body):
        if part not in members and any(g in found for a in atoms(part) for g, _ in inside(a.poly, cover.x)):
            raise CertificateRejected("", f"a quadratic stands in {part}, too")
    return found


def _known(cover: Cover, condition: Formula, body: Formula) -> list[Met] | None:
    """Where a leading coefficient is not positive, the problem itself is one of the points."""
    if condition == TRUE or condition in conjuncts(body):
        return []
    cover.missing = f"the case that {condition} does not hold"
    return cover.kept((neg(condition),))


def _crossing(cover: Cover, h: Poly, body: Formula, given: tuple[Formula, ...]) -> list[Met] | None:
    """The root of a polynomial of degree at most 1 is tried, where it has exactly one."""
    if h.degree(cover.x) > 1:
        raise CertificateRejected("", "the leading terms do not cancel")
    parts = inside(h, cover.x) if h.degree(cover.x) else []
    if not parts:
        return []
    coefficients = parts[0][0].coefficients(cover.x)
    return cover.meets(Turn(TestPoint(coefficients, 0, 0), (*given, atom(coefficients[1], NE))), body)

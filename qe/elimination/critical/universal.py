"""``all y. body`` whose truth set is convex in the parameters, by critical values.

THEOREM. Let D be a bounded set of y, and g_1, ..., g_k polynomials that are convex in p for every y in D. Then
T = {p : for all y in D, all g_j(p, y) <= 0} is closed and convex, and its boundary lies in the critical hypersurfaces
of the blocks  exists y in D: g_j(p, y) > 0.
PROOF. T is an intersection of closed convex sets {p : g_j(p, y) <= 0}. A boundary point of T is one of some
T_j = {p : all y in D, g_j <= 0}, whose complement is the truth set of the j-th block.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations

from qe.convex.system import Condition
from qe.elimination.critical.block import Disjunct, Run
from qe.elimination.critical.boundary import critical_hypersurfaces, determinant
from qe.elimination.critical.bounded import has_bounded_fibres
from qe.elimination.critical.fibres import Fibres, Spared
from qe.elimination.critical.system import System, systems
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.options import Budget
from qe.proof.multipliers import FormRelation


def eliminate_universal(
    variables: Sequence[str], negated: Formula, parameters: Sequence[str], *, budget: Budget
) -> Disjunct | None:
    """The truth set of ``all variables. not negated``; None where it is not seen to be convex with interior points.

    ``negated``: quantifier-free and positive. Raises ``Unable`` as ``eliminate_block`` does.
    """
    ring = Ring.of((*parameters, *variables))
    parts = systems(convert(negated, ring), ring, len(parameters))
    if not parameters or not all(has_bounded_fibres(part) and _spares_a_convex_set(part, budget) for part in parts):
        return None
    surfaces = [critical_hypersurfaces(part, thin_parts=False, budget=budget) for part in parts]
    stats: dict[str, object] = {"universal": len(parts)}
    spared = Spared(tuple(Fibres(part, budget) for part in parts))
    hint = (Fraction(0),) * len(parameters)
    found = Run(parts[0], spared, budget, stats).body(frozenset().union(*surfaces), hint)
    return None if found is None else Disjunct(negated, found, stats)


def _spares_a_convex_set(part: System, budget: Budget) -> bool:
    """Whether the part says: y is in a set D, and g(p, y) > 0 for one polynomial g, convex in p for every y in D."""
    if (parted := _parted(part)) is None:
        return False
    domain, g = parted
    slopes = [g.derivative(i) for i in range(part.free)]
    hessian = [[slope.derivative(j) for j in range(part.free)] for slope in slopes]
    if any(entry.variables and min(entry.variables) < part.free for row in hessian for entry in row):
        return False
    inner = Ring.of(part.ring.names[part.free :])
    inside = tuple(Condition(c.poly.convert(inner), c.relation) for c in domain)
    return not any(_somewhere_negative(minor.convert(inner), inside, budget) for minor in _principal_minors(hessian))


def _parted(part: System) -> tuple[list[Condition], Poly] | None:
    """The conditions on y alone, and g, where the only other one is g(p, y) > 0."""
    domain = [c for c in part.conditions if min(c.poly.variables) >= part.free]
    others = [c for c in part.conditions if c not in domain]
    single = not part.guards and len(others) == 1 and others[0].relation is FormRelation.LT
    return (domain, -others[0].poly) if single else None


def _principal_minors(matrix: Sequence[Sequence[Poly]]) -> list[Poly]:
    """A symmetric matrix is positive semidefinite iff all are nonnegative (Horn, Johnson: Matrix Analysis, 7.2)."""
    size = range(len(matrix))
    chosen = [rows for count in range(1, len(matrix) + 1) for rows in combinations(size, count)]
    return [determinant([[matrix[i][j] for j in rows] for i in rows]) for rows in chosen]


def _somewhere_negative(poly: Poly, inside: tuple[Condition, ...], budget: Budget) -> bool:
    if poly.is_constant:
        return poly.constant_value() < 0
    system = System(poly.ring, 0, (), (*inside, Condition(poly, FormRelation.LT)))
    return Fibres(system, budget).hold_at(())

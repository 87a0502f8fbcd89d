"""Hypersurfaces of parameter space that contain the boundary of the truth set of a block.

THEOREM (after Fritz John 1948). Let the fibres {y : g_i(p, y) <= 0, h_j(p, y) = 0} be bounded locally uniformly in p.
If p is a boundary point of the truth set of ``exists y`` (any g_i may be strict), then some y with all h_j = 0 and
g_i <= 0 over p has numbers lambda_i >= 0, mu_j, not all zero and lambda_i = 0 where g_i < 0, with
sum lambda_i grad g_i + sum mu_j grad h_j = 0 (gradients in y).
PROOF. Otherwise at every y of the closed fibre the gradients of h are independent, and some direction d has
grad h . d = 0 and grad g_i . d < 0 for all active i (Motzkin); by the implicit function theorem strictly feasible
solutions persist for all p' near p. So p is interior if the closed fibre is not empty; if it is empty, compactness
keeps it empty nearby. A guard in p alone is the case of a condition with gradient zero.

By Caratheodory's theorem the lambda_i > 0 may be taken on a set I with |I| + |h| <= m + 1 for m variables y. For every
such set y is eliminated from g_I = h = 0, together with the vanishing of the maximal minors of their Jacobian matrix
in y when |I| + |h| <= m.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import combinations

from qe.decomposition.over_point import over_point
from qe.elimination.critical.system import System
from qe.errors import Unable
from qe.exact.groebner import groebner_basis
from qe.exact.hermite import leading_minors
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.build import atom, conj
from qe.formula.syntax import Relation
from qe.options import Budget


def critical_hypersurfaces(system: System, *, thin_parts: bool, budget: Budget) -> frozenset[Poly]:
    """Irreducible polynomials in the parameters whose zero sets together contain the boundary.

    Without ``thin_parts`` pieces of codimension two or more may be missing. Raises ``Unable`` when the critical points
    lie over all of parameter space, or elimination is too large.
    """
    found: set[Poly] = {f for a in system.guards for f, _ in a.poly.factors()[1]}
    for chosen in _active_sets(system):
        budget.check("critical sets", len(found))
        active = [*system.equations, *chosen]
        eliminated = _eliminated([*active, *_minors(active, system.bound)], system, thin_parts)
        if not eliminated and _may_balance(system, chosen, budget):
            raise Unable("critical-value elimination: critical points over all of parameter space")
        for p in eliminated:
            found |= {f for f, _ in p.factors()[1]}
    return frozenset(found)


def _active_sets(system: System) -> Iterator[tuple[Poly, ...]]:
    """The sets of inequalities that may be active, besides all equations, at a Fritz John point."""
    most = max(0, len(system.bound) + 1 - len(system.equations))
    for count in range(min(most, len(system.inequalities)) + 1):
        if count or system.equations:
            yield from combinations(system.inequalities, count)


def _may_balance(system: System, chosen: Sequence[Poly], budget: Budget) -> bool:
    """Whether the set has Fritz John points for some parameters, as far as that is easy to tell: without parameters
    it is a sentence, in which the multipliers of inequalities are not negative."""
    active = [*system.equations, *chosen]
    if any(f.variables and f.variables[0] < system.free for f in active):
        return True
    ring = Ring.of((*system.ring.names[system.free :], *(f"multiplier {k}" for k in range(len(active)))))
    size = len(system.bound)
    zero = [f.convert(ring) for f in active]
    multipliers = [ring.gen(size + k) for k in range(len(active))]
    free, signed = multipliers[: len(system.equations)], multipliers[len(system.equations) :]
    stationary = [sum((m * f.derivative(i) for m, f in zip(multipliers, zero)), ring.constant(0)) for i in range(size)]
    norm = sum((m * m for m in free), sum(signed, ring.constant(-1)))
    matrix = conj(
        (
            *(atom(f, Relation.EQ) for f in (*zero, *stationary, norm)),
            *(atom(m, Relation.GE) for m in signed),
        )
    )
    return over_point(matrix, ring.names, 0, budget=budget)(Point(ring))


def _minors(active: Sequence[Poly], bound: Sequence[int]) -> list[Poly]:
    """The maximal minors of the Jacobian matrix in the quantified variables; none if it has more rows than columns."""
    if len(active) > len(bound):
        return []
    rows = [[f.derivative(i) for i in bound] for f in active]
    columns = combinations(range(len(bound)), len(active))
    return [minor for chosen in columns if (minor := determinant([[row[c] for c in chosen] for row in rows]))]


def determinant(rows: Sequence[Sequence[Poly]]) -> Poly:
    """The determinant; the matrices have a few rows."""
    *_, last = leading_minors(lambda i, j: rows[i][j], len(rows), rows[0][0].ring.constant(1))
    return last


def _eliminated(polys: Sequence[Poly], system: System, thin_parts: bool) -> tuple[Poly, ...]:
    """Polynomials in the parameters that all vanish wherever the given ones have a common zero y; none if there is no
    such polynomial but zero."""
    bound = system.bound
    if len(bound) == 1 and (found := _resultants(polys, bound[0])):
        return found
    order = tuple(sorted(range(system.ring.size), reverse=True))
    basis = groebner_basis(polys, variables=order, heavy=len(bound))
    if basis is None:
        raise Unable("critical-value elimination: the elimination of a critical set is too large")
    outside = basis.free_of(bound)
    if not outside:
        return ()
    return outside if thin_parts else (reduce(Poly.gcd, outside),)


def _resultants(polys: Sequence[Poly], variable: int) -> tuple[Poly, ...]:
    """The same for one eliminated variable: f and f' have a common zero only where the discriminant of f vanishes."""
    first, *others = polys
    if others == [first.derivative(variable)] and first.degree(variable) > 1:
        found = [first.discriminant(variable)]
    else:
        found = [first.resultant(other, variable) for other in others if first.degree(variable)]
    return tuple(f for f in found if f)

"""Evidence for the rule "critical values" (``qe.expert.critical_values``): chains of elimination, samples of the open
cells, and what shows for each of them whether the block holds there. Nothing here is trusted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from qe.convex.violation import proposed
from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.projection import factor_lists
from qe.elimination.cad import certificate_for
from qe.elimination.critical.boundary import critical_hypersurfaces
from qe.elimination.critical.system import systems
from qe.errors import CertificateRejected
from qe.exact.fibre_stack import isolate_over
from qe.exact.quadratic_form import Quadratic as Form
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.expert import critical_values
from qe.expert.critical_points import active_sets
from qe.expert.critical_values import is_positive
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Exists, Formula
from qe.formula.traverse import polynomials
from qe.kernel.block import existential
from qe.kernel.negation import negation
from qe.kernel.step import Claim
from qe.options import Budget, Options
from qe.proof.entry import Json, poly_to_text
from qe.proving.elimination_chain import Row, chain

Values = tuple[Fraction, ...]


def critical_evidence(claim: Claim, order: Sequence[str], options: Options, budget: Budget) -> dict[str, Json]:
    """The evidence for a step, with the parameters in this order.

    Raises ``CertificateRejected`` where the rule does not apply, or some of the evidence is not found.
    """
    block, after = existential(claim)
    if not isinstance(block, Exists):
        raise claim.fail("expected a block")
    names = tuple(order)
    ring, outer = Ring.of((*names, *block.variables)), Ring.of(names)
    strict, holds = critical_values.is_strict(block.body), convert(after, outer)
    conditions = critical_values.read_conditions(block.body, ring, claim, strict=strict)
    regular = _table(after, outer, strict, claim, options, budget)
    (system,) = systems(convert(block.body, ring), ring, len(names))
    surfaces = critical_hypersurfaces(system, thin_parts=False, budget=budget)
    walls = {f.convert(outer).normal()[1] for f in surfaces}
    chains = _chains(conditions, len(names), walls, claim, budget)
    answer = [f for p in polynomials(holds) for f, _ in p.factors()[1]]
    levels = factor_lists([*walls, *answer], len(names), BROWN_MCCALLUM, budget, frozenset())
    cells = _Cells(conditions, claim, budget)

    def said(values: Values) -> Json:
        return cells.said(values, holds_at(holds, dict(zip(names, values, strict=True))))

    stacks = _stacks(levels, Point(ring), (), said)
    return {
        "order": list(names),
        "bound": [str(int(not c.is_equation)) for c in conditions],
        "chains": [[[[k, poly_to_text(f)] for k, f in row] for row in rows] for rows in chains],
        "factors": [[poly_to_text(f.convert(outer)) for f in level] for level in levels],
        "stacks": stacks,
        "points": [[str(v) for v in point] for point in cells.points],
        "weights": [[str(w) for w in row] for row in cells.weights],
        "regular": regular,
    }


def _stacks(levels: Sequence[Sequence[Poly]], point: Point, values: Values, said: Callable[[Values], Json]) -> Json:
    """The open cells, with what is said of each."""
    if len(values) == len(levels):
        return said(values)
    isolation = isolate_over(point, tuple(levels[len(values)]))
    return [
        [str(sample), _stacks(levels, isolation.sample(2 * k), (*values, sample), said)]
        for k, sample in enumerate(isolation.samples)
    ]


def _table(after: Formula, outer: Ring, strict: bool, claim: Claim, options: Options, budget: Budget) -> Json:
    """A cell table of the answer, or of its complement; none where it is seen to be convex."""
    try:
        critical_values.read_conditions(after, outer, claim, strict=strict)
    except CertificateRejected:
        closed = negation(after) if strict else after
        table = certificate_for(closed, closed, options, budget)
        if table is None:
            raise claim.fail("no table of the answer") from None
        cells: Json = table.evidence_for("cells")["cells"]
        return cells
    return None


def _chains(
    conditions: Sequence[critical_values.Condition], free: int, walls: set[Poly], claim: Claim, budget: Budget
) -> list[list[Row]]:
    """For each set that may be active a chain to polynomials whose common divisor vanishes in the walls alone."""
    outer = Ring.of(conditions[0].poly.ring.names[:free])

    def enough(polys: Sequence[Poly]) -> bool:
        return bool(polys) and all(f.convert(outer) in walls for f, _ in critical_values.common(polys).factors()[1])

    equations = [c.poly for c in conditions if c.is_equation]
    rows = []
    for start in active_sets([c.poly for c in conditions if not c.is_equation], equations, free):
        found = chain(start, free, enough, budget)
        if found is None:
            raise claim.fail("no chain of elimination found")
        rows.append(found)
    return rows


class _Cells:
    """Points of the block and weights that exclude it, the last one used first."""

    def __init__(self, conditions: Sequence[critical_values.Condition], claim: Claim, budget: Budget) -> None:
        self.conditions, self.claim, self.budget = conditions, claim, budget
        self.points: list[Values] = []
        self.weights: list[Values] = []
        self.sums: list[list[list[Fraction]]] = []
        self.recent: dict[bool, list[int]] = {True: [], False: []}

    def said(self, values: Values, inside: bool) -> int:
        """What the evidence says of a cell with this sample."""
        self.budget.check("prove")
        listed = self.recent[inside]
        for place, k in enumerate(listed):
            if self.shows(k, values, inside):
                listed.insert(0, listed.pop(place))
                return k if inside else -1 - k
        self.propose(values, inside)
        if not self.shows(listed[0], values, inside):
            raise self.claim.fail("neither a point nor weights found for a cell")
        return listed[0] if inside else -1 - listed[0]

    def shows(self, k: int, values: Values, inside: bool) -> bool:
        if inside:
            return all(c.holds((*values, *self.points[k])) for c in self.conditions)
        return is_positive(critical_values.over(self.sums[k], values))

    def propose(self, values: Values, inside: bool) -> None:
        """A new point, or new weights, which may be wrong."""
        forms = [_form(critical_values.over(c.matrix, values)) for c in self.conditions]
        point, weights = proposed(forms)
        if inside and point is not None:
            self.points.append(tuple(point))
            self.recent[True].insert(0, len(self.points) - 1)
        elif not inside and weights is not None and critical_values.are_weights(self.conditions, weights):
            self.weights.append(tuple(weights))
            self.sums.append(critical_values.weighted(self.conditions, weights))
            self.recent[False].insert(0, len(self.weights) - 1)
        else:
            raise self.claim.fail("neither a point nor weights found for a cell")


def _form(matrix: list[list[Fraction]]) -> Form:
    """The quadratic polynomial v^T M v as one of Hessian, gradient and constant."""
    size = len(matrix) - 1
    hessian = tuple(tuple(2 * matrix[i][j] for j in range(size)) for i in range(size))
    return Form(hessian, tuple(2 * matrix[i][size] for i in range(size)), matrix[size][size])

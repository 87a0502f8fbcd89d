"""Rule "critical values": a block over bounded fibres whose truth set is convex, decided on open cells.

In what follows the inequalities are weak; strict ones are treated below.

THEOREM. Let T be the set of parameters p for which some y satisfies inequalities g_i(p, y) <= 0, convex of degree at
most 2, and linear equations; let a sum of nonnegative multiples of the g_i be, for fixed p, a polynomial of degree 2 in
y with one positive definite Hessian for all p. Then T is closed and convex. Its boundary lies over critical points
(``critical_points``): where all of several polynomials q in p vanish, for one of finitely many sets of them. That is
inside the zeros of their greatest common divisor, but for a set of codimension two, which separates no open connected
set. So T either holds all of an open cell, but for such sets, or nothing of it that is open: if the sample is in T, and
not all q of a set vanish there, the former; if it is not in T, the latter. Let S be another set that is the
closure of its interior, with the same truth at all samples of a decomposition into open cells, sign-invariant for the
polynomials of S and those divisors; let one of the samples be in T. Then S = T: so is T.
PROOF. A bound of y by p: the sum of the g_i is <= 0. So T, the projection of a closed convex set with fibres that are
bounded locally uniformly, is closed and convex. A closed convex set with interior points is the closure of its
interior, and that of all but a nowhere dense part of the interior (Rockafellar 1970, Theorem 6.3).

THEOREM (strict). Let all inequalities be strict, T' the truth set, and T that of the weak ones. Off the critical points
T' agrees with T: there every point of T has strict solutions near by, for all parameters near by (``critical_points``).
Let T' and S agree in the same way at all samples, one of them in T', and let the complement of S be the closure of its
interior. Then S = T'.
PROOF. T' is the projection of a relatively open convex set, so convex and relatively open (Rockafellar 1970, Theorem
6.6); it has interior points, so it is open. Open convex sets are the interiors of their closures, as S is by
assumption; T' and S agree on a dense open set, so their closures are the same.

A sample is in T by a point y that satisfies the conditions, and is not by numbers w_i, nonnegative for inequalities,
such that the sum of all w_i g_i is positive everywhere. S is the closure of its interior if it is convex, as a
conjunction of convex inequalities, or by a cell table (``regular_set``); for strict inequalities S is an open convex
set, as a conjunction of strict ones, or the table is one of its complement.

Evidence: ``order`` (the parameters), ``bound`` (weights of the conditions), ``chains`` for the sets of conditions that
may be active, ``factors`` (lists by level, closed under projection), ``stacks`` (``open_cells``; of a cell: the
number k of a point, or -1 - k for weights number k), ``points``, ``weights``, ``regular`` (a cell table of S, or of its
complement; null where S is convex).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.convexity import Quadratic, inner, is_convex, rank
from qe.expert.critical_points import active_sets, vanishing
from qe.expert.open_cells import open_cells
from qe.expert.regular_set import check_regular
from qe.expert.sentences import read_list
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts, polynomials
from qe.kernel.arithmetic.products import FactorLists, check_lists
from qe.kernel.block import existential
from qe.kernel.cells import check_cells
from qe.kernel.negation import negation, normal
from qe.kernel.projection import Projected
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.cells_json import cells_from_json
from qe.proof.entry import Entry

Row = Sequence[Fraction]


@dataclass(frozen=True, slots=True)
class Condition(Quadratic):
    """That the polynomial is <= 0, or = 0."""

    is_equation: bool

    def holds(self, point: Row) -> bool:
        """Whether a point satisfies it."""
        value = self.value((*point, 1))
        return not value if self.is_equation else value <= 0


def check_critical_values(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    order, bound, chains, factors, stacks, points, weights, regular = only(
        claim, "order", "bound", "chains", "factors", "stacks", "points", "weights", "regular"
    )
    block, answer = existential(claim)
    if not isinstance(block, Exists):
        raise claim.fail("expected a block")
    names, body, after = order.names(), claim.plain(block.body), claim.plain(answer)
    if set(names) & set(block.variables) or not names:
        raise order.fail("expected the parameters, each once")
    if not set(block.free) | set(after.free) <= set(names):
        raise order.fail("a parameter is missing")
    ring, outer = Ring.of((*names, *block.variables)), Ring.of(names)
    strict, free, holds = is_strict(body), len(names), convert(after, outer)
    conditions = read_conditions(body, ring, claim, strict=strict)
    _check_bound(conditions, free, bound)
    surfaces = _surfaces(conditions, free, chains, limits)
    listed = _Listed(conditions, free, points, weights)
    if regular.value is not None:
        _check_shape(regular, negation(holds) if strict else holds, limits)
    elif any(c.is_equation for c in read_conditions(after, outer, claim, strict=strict)) and strict:
        raise claim.fail("a set with equations is not open")
    lists, inside = read_lists(factors, outer, limits), False
    for found in (*([p] for p in polynomials(holds)), *surfaces):
        if lists.decompose(common(found).convert(outer)) is None:
            raise factors.fail("a polynomial of the answer, or of the critical points, is not a product of factors")
    for values, said in open_cells(lists.lists, stacks, limits):
        if not holds_at(holds, dict(zip(names, values, strict=True))):
            listed.check_outside(values, said)
            continue
        inside = True
        listed.check_inside(values, said)
        for found in surfaces:
            if len(found) > 1 and not any(q.evaluate(padded(values, q.ring)) for q in found):
                raise said.fail("the sample lies over critical points")
    if not inside:
        raise claim.fail("no open cell on which it holds")


def is_strict(formula: Formula) -> bool:
    """Whether inequalities of a conjunction are strict; then all of them have to be."""
    return any(isinstance(part, Atom) and part.relation in (Relation.LT, Relation.GT) for part in conjuncts(formula))


def read_conditions(formula: Formula, ring: Ring, claim: Claim, *, strict: bool) -> list[Condition]:
    """The conjuncts as convex conditions, strict ones as weak; ``CertificateRejected`` where one is none."""
    found = []
    down, up = (Relation.LT, Relation.GT) if strict else (Relation.LE, Relation.GE)
    for part in conjuncts(formula):
        if not isinstance(part, Atom) or part.relation not in (down, up, Relation.EQ):
            raise claim.fail("expected a conjunction of equations and inequalities, all weak or all strict")
        poly = part.poly.convert(ring)
        poly = -poly if part.relation is up else poly
        if poly.total_degree > (1 if part.relation is Relation.EQ else 2):
            raise claim.fail("expected inequalities of degree at most 2, and linear equations")
        condition = Condition(poly, Quadratic.of(poly, 1, Fraction).matrix, part.relation is Relation.EQ)
        if not condition.is_convex:
            raise claim.fail("an inequality is not convex")
        found.append(condition)
    return found


def weighted(conditions: Sequence[Condition], weights: Row) -> list[list[Fraction]]:
    """The matrix of a weighted sum."""
    size = range(len(conditions[0].matrix))
    pairs = [(w, c.matrix) for w, c in zip(weights, conditions, strict=True) if w]
    return [[sum((w * m[i][j] for w, m in pairs), Fraction(0)) for j in size] for i in size]


def over(matrix: Sequence[Row], values: Row) -> list[list[Fraction]]:
    """The matrix of the polynomial in the other variables, with values for the first ones."""
    free, size = len(values), len(matrix)
    v = (*values, *(Fraction(0),) * (size - free - 1), Fraction(1))
    folded = [inner(v, row) + Fraction(0) for row in matrix]
    constant = inner(v, folded) + Fraction(0)
    rows = [[*matrix[i][free : size - 1], folded[i]] for i in range(free, size - 1)]
    return [*rows, [*(row[-1] for row in rows), constant]]


def is_positive(matrix: Sequence[Row]) -> bool:
    """Whether v^T M v > 0 for all v whose last entry is 1."""
    inner = [row[:-1] for row in matrix[:-1]]
    return is_convex(matrix) and rank(matrix) == rank(inner) + 1


def are_weights(conditions: Sequence[Condition], weights: Row) -> bool:
    """Whether those of inequalities are not negative."""
    return all(w >= 0 or c.is_equation for w, c in zip(weights, conditions, strict=True))


def common(polys: Sequence[Poly]) -> Poly:
    """The greatest common divisor."""
    return reduce(Poly.gcd, polys)


def _check_bound(conditions: Sequence[Condition], free: int, entry: Entry) -> None:
    weights = read_list(entry, Entry.rational, len(conditions))
    if not are_weights(conditions, weights):
        raise entry.fail("a negative weight of an inequality")
    inner = [row[free:-1] for row in weighted(conditions, weights)[free:-1]]
    if not is_convex(inner) or rank(inner) < len(inner):
        raise entry.fail("the weighted sum does not bound the variables of the block")


def _check_shape(entry: Entry, holds: Formula, limits: Limits) -> None:
    """The table is one of this formula, and shows that it describes the closure of its interior."""
    table, names = cells_from_json(entry), () if holds.ring is None else holds.ring.names
    if any(table.quantifiers):
        raise entry.fail("expected a cell table without quantifiers")
    if set(table.order) != set(names) or normal(convert(table.matrix, Ring.of(names))) != normal(holds):
        raise entry.fail("the table is about another formula")
    try:
        check_cells(table, None, (), limits.budget)
    except CertificateRejected as error:
        raise CertificateRejected(f"{entry.path}.{error.step.removeprefix('payload.')}", error.reason) from None
    check_regular(table, limits, entry.path)


def read_lists(entry: Entry, ring: Ring, limits: Limits) -> FactorLists:
    """Factor lists that are closed under projection; ``CertificateRejected`` where they are not."""
    lists = [[f.polynomial(ring) for f in level.items()] for level in entry.items()]
    try:
        check_lists(ring, lists)
        found = FactorLists(ring, lists)
        Projected(found, limits.budget, evaluates=False).closed()
    except CertificateRejected as error:
        raise entry.fail(f"{error.step}: {error.reason}") from None
    return found


def _surfaces(conditions: Sequence[Condition], free: int, chains: Entry, limits: Limits) -> list[list[Poly]]:
    """For each set of conditions that may be active: polynomials in the parameters that vanish over critical points."""
    ring = conditions[0].poly.ring
    equations = [c.poly for c in conditions if c.is_equation]
    if any(e.level < free for e in equations):
        raise chains.fail("an equation of the parameters alone")
    sets = list(active_sets([c.poly for c in conditions if not c.is_equation], equations, free))
    listed = list(chains.items())
    if len(listed) != len(sets):
        raise chains.fail(f"expected {len(sets)} chains")
    found = []
    for start, chain in zip(sets, listed, strict=True):
        limits.tick()
        found.append(vanishing(start, chain, free, ring))
    return found


def padded(values: Row, ring: Ring) -> tuple[Fraction, ...]:
    """A point with any values for the block's variables."""
    return (*values, *(Fraction(0),) * (ring.size - len(values)))


class _Listed:
    """Points and weights, each read once, and what they show at a sample."""

    def __init__(self, conditions: Sequence[Condition], free: int, points: Entry, weights: Entry) -> None:
        self.conditions = conditions
        size = conditions[0].poly.ring.size - free
        self.points = [read_list(e, Entry.rational, size) for e in points.items()]
        self.sums = []
        for entry in weights.items():
            row = read_list(entry, Entry.rational, len(conditions))
            if not are_weights(conditions, row):
                raise entry.fail("a negative weight of an inequality")
            self.sums.append(weighted(conditions, row))

    def check_inside(self, values: Row, said: Entry) -> None:
        """The point satisfies all conditions."""
        k = said.integer()
        if k >= len(self.points) or not all(c.holds((*values, *self.points[k])) for c in self.conditions):
            raise said.fail("not the number of a point that satisfies the conditions")

    def check_outside(self, values: Row, said: Entry) -> None:
        """The weighted sum is positive."""
        k = -1 - said.integer(-len(self.sums))
        if k < 0 or not is_positive(over(self.sums[k], values)):
            raise said.fail("not the number of weights that exclude the sample")

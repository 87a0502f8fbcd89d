"""Method 1, one Bézier curve of degree n, as printed (Hatakeyama, Terui and Mikawa, SCSS 2024, 4.1).

The x-coordinates are equally spaced; the y- and z-coordinates of the inner control points solve problem (4), each
coordinate for itself: P(t_a) = P(t_b) = h, start <= the first p, h <= the next up to q, goal <= the others, and the sum
over p+1..q is smallest. (4) does not say that the curve stays above h between, nor that it stays in the workspace:
``dips`` and ``bezier.curves.containment`` find out, ``bezier.methods.single.closed`` repairs it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Negative, decide
from bezier.input.task import Axis, Task, Values, equally_spaced
from qe.convex.evidence import optimum_certificate
from qe.convex.minimise import evidence_about
from qe.convex.simplex import Endless, linear_optimum
from qe.convex.system import ConvexSystem
from qe.errors import Unable
from qe.exact.quadratic_form import Quadratic, combine, independent_rows
from qe.proof.certificate import Certificate
from qe.proof.multipliers import FormRelation, OptimumStatus

TIE_BREAK = (
    "among the minima of the sum the one whose largest |coordinate| is least, then the lexicographically smallest"
)
"""The paper leaves the choice open. The maximum norm keeps the choice a linear problem and the numbers rational."""


@dataclass(frozen=True, slots=True)
class Chosen:
    """Problem (4) of one axis with its answer, and the dual proof.

    ``values``: all coordinates from start to goal, by the ``TIE_BREAK``; None when (4) has no solution.
    """

    axis: Axis
    outcome: Solution

    @property
    def values(self) -> Values | None:
        """All n+1 coordinates."""
        return (self.axis.start, *self.outcome.point, self.axis.goal) if self.outcome.optimal else None


def weights_at(degree: int, t: Fraction) -> Values:
    """C(n,i) t^i (1-t)^(n-i) for i = 0..n: P(t) is the sum of these times P_i."""
    return tuple(comb(degree, i) * t**i * (1 - t) ** (degree - i) for i in range(degree + 1))


def variables(given: Task, axis: Axis) -> tuple[str, ...]:
    """The names y1, ..., y(n-1)."""
    return tuple(f"{axis.name}{i}" for i in range(1, given.degree))


def rows_of(given: Task, axis: Axis) -> list[Row]:
    """The equations of (4) for one raised axis."""
    rows = []
    for t in given.times:
        first, *inner, last = weights_at(given.degree, t)
        known = first * axis.start + last * axis.goal - Fraction(axis.height or 0)
        rows.append((Quadratic.linear(inner, known), FormRelation.EQ))
    return rows


def lower_of(given: Task, axis: Axis) -> Values:
    """The lower bounds of (4)."""
    return tuple(given.lower_bound(axis, i) for i in range(1, given.degree))


def program(given: Task, axis: Axis) -> ConvexSystem:
    """Problem (4) for one raised axis."""
    return linear_program(variables(given, axis), objective(given), rows_of(given, axis), lower_of(given, axis))


def objective(given: Task) -> Values:
    """The coefficients of the sum over p+1..q on the inner coordinates of one axis."""
    return tuple(Fraction(int(i in given.middle)) for i in range(1, given.degree))


def choose(given: Task, axis: Axis) -> Chosen:
    """Solve (4) exactly for one raised axis, with the ``TIE_BREAK``."""
    cost, lower, zero = objective(given), lower_of(given, axis), Fraction(0)
    unit = [tuple(Fraction(int(i == j)) for i in range(len(cost) + 1)) for j in range(len(cost) + 1)]
    signed = [(side, j) for side in (1, -1) for j in range(len(cost)) if side > 0 or lower[j] < 0]
    rows = [widened(row, len(cost) + 1) for row in rows_of(given, axis)]
    for side, j in signed:
        rows.append((Quadratic.linear((*(side * v for v in unit[j][:-1]), Fraction(-1))), FormRelation.LE))
    wider = linear_program((*variables(given, axis), f"{axis.name}max"), (*cost, zero), rows, (*lower, zero))
    return Chosen(axis, solve(wider, [unit[-1], *unit[:-1]]).narrowed(program(given, axis)))


def widened(row: Row, size: int, before: int = 0) -> Row:
    """The same row in more variables, with so many of them before its own."""
    form, relation = row
    after = size - before - form.size
    gradient = (*(Fraction(0),) * before, *form.gradient, *(Fraction(0),) * after)
    return Quadratic.linear(gradient, form.constant), relation


def lowest(given: Task, axis: Axis, t: Fraction) -> Values | None:
    """Among the solutions of (4) with the least sum one that is lowest at ``t``: what (4) allows just as well."""
    return Chosen(axis, solve(program(given, axis), [weights_at(given.degree, t)[1:-1]])).values


def curve(given: Task, values: Mapping[str, Values]) -> Bezier:
    """The curve with these coordinates of the raised axes; the other axes are equally spaced."""
    columns = [values.get(axis.name, equally_spaced(given.degree, axis.start, axis.goal)) for axis in given.axes]
    return Bezier(tuple(zip(given.abscissae, *columns, strict=True)))


@dataclass(frozen=True, slots=True)
class Dip:
    """The curve is below the height of ``axis`` at the parameter ``t`` in (t_a, t_b): a hole of (4)."""

    axis: Axis
    t: Fraction
    value: Fraction


def dips(given: Task, path: Bezier) -> tuple[Dip, ...]:
    """One proved dip for each raised axis that has any: complete, by ``bezier.curves.nonnegative``."""
    result = []
    low, high = given.times
    for axis in given.raised:
        height = Fraction(axis.height or 0)
        margin = bs.restrict(path.coordinate(1 + given.axes.index(axis)), low, high)
        outcome = decide([c - height for c in margin])
        if isinstance(outcome, Negative):
            result.append(Dip(axis, low + outcome.t * (high - low), outcome.value + height))
    return tuple(result)


Numbers = tuple[Fraction, ...]
Check = Callable[[], object]
Row = tuple[Quadratic, FormRelation]
"""A linear form that is at most 0, or 0."""


def linear_program(names: Sequence[str], cost: Numbers, rows: Sequence[Row], lower: Numbers) -> ConvexSystem:
    """The points x with all rows and x_j >= lower_j."""
    bounds = (tuple(Fraction(-int(i == j)) for i in range(len(names))) for j in range(len(names)))
    forms = *(form for form, _ in rows), *map(Quadratic.linear, bounds, lower)
    relations = *(relation for _, relation in rows), *[FormRelation.LE] * len(names)
    return ConvexSystem(tuple(names), Quadratic.linear(cost), forms, relations)


@dataclass(frozen=True, slots=True)
class Solution:
    """``point`` minimises the objective of a program, and among its minima further ones. ``multipliers`` of the forms,
    >= 0 unless it is an equation, prove it: objective + sum multipliers_i forms_i = ``value`` everywhere. Where it is
    not ``optimal``, there is no point: sum multipliers_i forms_i is a positive constant (Farkas 1902)."""

    program: ConvexSystem
    point: Numbers
    multipliers: Numbers
    optimal: bool = True

    @property
    def value(self) -> Fraction:
        """The least value."""
        return Fraction(self.program.objective.value(self.point))

    @property
    def certificate(self) -> Certificate:
        """What ``qe.verify`` accepts."""
        said: dict[str, object] = {"status": OptimumStatus.INFEASIBLE}
        if self.optimal:
            said = {"status": OptimumStatus.OPTIMAL, "attained": True, "unique": False}
        return optimum_certificate(evidence_about(self.program, point=self.point, multipliers=self.multipliers, **said))

    def narrowed(self, program: ConvexSystem) -> Solution:
        """That of a program of the first rows and variables alone, if the others play no part in it."""
        size, rest = len(program.names), len(self.multipliers) - len(self.program.names)
        kept = (*self.multipliers[: len(program.forms) - size], *self.multipliers[rest : rest + size])
        return Solution(program, self.point[:size], kept, self.optimal)


def solve(program: ConvexSystem, others: Iterable[Numbers] = (), *, check: Check = lambda: None) -> Solution:
    """Minimise the objective, then the others. ``check`` is called between pivots and may raise.

    The minima of an objective are the points at which the forms that have a multiplier are 0 (complementary
    slackness): with these as equations the next objective is minimised.

    Raises ``Unable`` when an objective falls without bound.
    """
    forms, size = list(program.forms), len(program.forms)
    equal = [k for k, relation in enumerate(program.relations) if relation is FormRelation.EQ]
    forms += _negated(forms, equal)
    zero, known = {*equal}, Solution(program, (Fraction(0),) * len(program.names), ())
    for objective in (program.objective, *map(Quadratic.linear, others)):
        if known.multipliers and len(independent_rows([forms[k].gradient for k in zero])) == len(program.names):
            break  # one point is left
        optimum, falls = linear_optimum(objective, forms, check=check)
        if falls is not None:
            raise Unable("a linear objective falls without bound")
        if not known.multipliers:
            weights = {k: Fraction(w) for k, w in optimum.weights.items()}  # of equations the negative ones, too
            negative = {k: weights.get(place, 0) for place, k in enumerate(equal, size)}
            first = tuple(weights.get(k, Fraction(0)) - negative.get(k, 0) for k in range(size))
        if isinstance(optimum, Endless):
            return Solution(program, known.point, first, optimal=False)
        forms += _negated(forms, optimum.weights)
        zero |= optimum.weights.keys()
        known = Solution(program, tuple(map(Fraction, optimum.dual)), first)
    return known


def _negated(forms: Sequence[Quadratic], which: Iterable[int]) -> list[Quadratic]:
    return [combine((Fraction(-1),), (forms[k],)) for k in which]

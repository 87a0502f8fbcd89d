"""Linear cuts for Method 1*: what the conditions for all t say about the control points at single parameters.

Unknown are the inner coordinates of the raised axes, and a common slack s >= 0. With the equations of (4),

    P(t) - h = (t - t_a)(t_b - t) S(t) on each raised axis, and r^2 - |P(t)|^2 = w(t) M(t),

where w is the product of t, 1 - t, (t - t_a)^2, (t - t_b)^2 for those of these parameters at which P is on the sphere
for every solution of (4). So the conditions say S >= 0 on [t_a, t_b] and M >= 0 on [0, 1]; z >= 0 follows from the
bounds of (4) by the convex hull property. A cut at t is S(t) >= s h, or, for any plane vector c, the consequence
2 c.P(t) <= |c|^2 + |P(t)|^2 <= |c|^2 + r^2 - s r^2 w(t) of |P(t) - c|^2 >= 0 and M(t) >= s r^2.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from math import comb, prod
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Negative, decide
from bezier.curves.scalar import Vector, dot, scale, sign
from bezier.curves.workspace import Workspace
from bezier.input.task import Axis, Task, Values
from bezier.methods.single.program import Row, curve, linear_program, lower_of, objective, rows_of, weights_at, widened
from qe.convex.system import ConvexSystem
from qe.exact.quadratic_form import Quadratic
from qe.proof.multipliers import FormRelation

ZERO, ONE = Fraction(0), Fraction(1)
GRID = 32
"""Proposals for violated parameters are multiples of 1/GRID^2."""
NOISE = 1e-12
PLANE_BITS = 20


class CutKind(Enum):
    """HEIGHT: S(t) >= 0. BALL: M(t) >= 0 by a plane. START, GOAL: M >= 0 where P is on the sphere at t = 0 or 1.
    TANGENT: P.P' = 0 where P(t_a) or P(t_b) is on the sphere, an equation."""

    HEIGHT = "height"
    BALL = "ball"
    START = "start"
    GOAL = "goal"
    TANGENT = "tangent"


@dataclass(frozen=True, slots=True)
class Cut:
    """A condition at the parameter ``t``: ``axis`` for heights, empty otherwise; ``plane``: the vector c of BALL."""

    kind: CutKind
    t: Fraction
    axis: str = ""
    plane: Vector = ()


@dataclass(frozen=True, slots=True)
class Model:
    """The conditions of Method 1* for this task and ball, and their cuts as rows over the unknowns and s."""

    task: Task
    workspace: Workspace
    ends: tuple[Vector, Vector]
    """P(0) and P(1)."""
    via: tuple[Vector, Vector]
    """P(t_a) and P(t_b), which (4) fixes."""
    touches: tuple[bool, bool, bool, bool]
    """Which of the four parameters 0, 1, t_a, t_b have P on the sphere. ``Model.of`` finds them."""

    @staticmethod
    def of(task: Task, workspace: Workspace) -> Model:
        """The model of this task in this workspace."""
        straight = curve(task, {})
        heights = (None, *(axis.height for axis in task.axes))
        at_a, at_b = (
            tuple(c if height is None else height for c, height in zip(straight.point(t), heights, strict=True))
            for t in task.times
        )
        places = (straight.points[0], straight.points[-1], at_a, at_b)
        first, last, a, b = (sign(workspace.ball.margin(place)) == 0 for place in places)
        return Model(task, workspace, places[:2], (at_a, at_b), (first, last, a, b))

    @property
    def names(self) -> tuple[str, ...]:
        """y1, ..., y(n-1), z1, ..., and the slack."""
        return (*(f"{axis.name}{i}" for axis in self.task.raised for i in range(1, self.task.degree)), "s")

    @property
    def costs(self) -> Values:
        """The sum over p+1..q of all raised axes."""
        return (*objective(self.task) * len(self.task.raised), ZERO)

    def values(self, point: Sequence[Fraction]) -> dict[str, Values]:
        """The coordinates of all control points on the raised axes, from the unknowns."""
        size = self.task.degree - 1
        inner = (tuple(point[k * size : (k + 1) * size]) for k in range(len(self.task.raised)))
        return {axis.name: (axis.start, *part, axis.goal) for axis, part in zip(self.task.raised, inner, strict=True)}

    def program(self, cuts: Sequence[Cut], rigid: Collection[str] = (), costs: Values = ()) -> ConvexSystem:
        """(4) on all raised axes, the cuts, and 0 <= s <= 1, to minimise ``costs``, or without them -s. Cuts whose axis
        is among ``rigid`` have no slack."""
        axes, width, rows = self.task.raised, len(self.names), list[Row]()
        for k, axis in enumerate(axes):
            rows += [widened(row, width, k * (self.task.degree - 1)) for row in rows_of(self.task, axis)]
        for cut in (*self.tangents, *cuts):
            form, relation = self.row(cut)
            gradient = (*form.gradient[:-1], ZERO if cut.axis in rigid else form.gradient[-1])
            rows.append((Quadratic.linear(gradient, form.constant), relation))
        slack = (*(ZERO,) * (width - 1), ONE)
        rows.append((Quadratic.linear(slack, -ONE), FormRelation.LE))
        lower = (*(v for axis in axes for v in lower_of(self.task, axis)), ZERO)
        return linear_program(self.names, costs or scale(-1, slack), rows, lower)

    def plain_program(self, cuts: Sequence[Cut]) -> ConvexSystem:
        """The program of (4) and the cuts without the slack."""
        whole = self.program(cuts)
        last = len(whole.forms) - 1  # s >= 0; the row s <= 1 stands before all bounds
        kept = [k for k in range(last) if k != last - len(whole.names)]
        forms = (Quadratic.linear(whole.forms[k].gradient[:-1], whole.forms[k].constant) for k in kept)
        relations = tuple(whole.relations[k] for k in kept)
        return ConvexSystem(whole.names[:-1], Quadratic.linear(self.costs[:-1]), tuple(forms), relations)

    # --- the sphere ----------------------------------------------------------------------------------------------

    @property
    def tangents(self) -> tuple[Cut, ...]:
        """Where P(t_a) or P(t_b) is on the sphere it must not cross it there: P.P' = 0."""
        return tuple(
            Cut(CutKind.TANGENT, t) for t, there in zip(self.task.times, self.touches[2:], strict=True) if there
        )

    def factors(self, t: Fraction) -> list[Fraction]:
        """The factors of w(t)."""
        t_a, t_b = self.task.times
        factors = (t, 1 - t, (t - t_a) ** 2, (t - t_b) ** 2)
        return [factor for factor, there in zip(factors, self.touches, strict=True) if there]

    # --- rows ----------------------------------------------------------------------------------------------------

    def row(self, cut: Cut) -> Row:
        """The cut over the unknowns and s."""
        match cut.kind:
            case CutKind.HEIGHT:
                return self._height_row(cut)
            case CutKind.BALL:
                bound = dot(cut.plane, cut.plane) + self.workspace.radius_squared
                normal = tuple(2 * c for c in cut.plane)
                slack = self.workspace.radius_squared * prod(self.factors(cut.t))
                return self._plane_row(normal, weights_at(self.task.degree, cut.t), bound, slack)
            case CutKind.TANGENT:
                normal = self.via[self.task.times.index(cut.t)]
                return self._plane_row(normal, _slope_weights(self.task.degree, cut.t), ZERO, ZERO, equation=True)
            case CutKind.START | CutKind.GOAL:
                start = cut.kind is CutKind.START
                normal = tuple((2 if start else -2) * c for c in self.ends[0 if start else 1])
                weights = _slope_weights(self.task.degree, cut.t)
                slope = prod(factor for factor in self.factors(cut.t) if factor)  # |w'| at its simple zero
                return self._plane_row(normal, weights, ZERO, self.workspace.radius_squared * slope)

    def _height_row(self, cut: Cut) -> Row:
        """h - P(t) + s h (t - t_a)(t_b - t) <= 0, or, at t_a and t_b, its derivative inwards."""
        height = next(Fraction(axis.height or 0) for axis in self.task.raised if axis.name == cut.axis)
        down = (ZERO, *(Fraction(-(axis.name == cut.axis)) for axis in self.task.axes))
        degree, (t_a, t_b) = self.task.degree, self.task.times
        if cut.t in (t_a, t_b):
            inwards = down if cut.t == t_a else scale(-1, down)
            return self._plane_row(inwards, _slope_weights(degree, cut.t), ZERO, height * (t_b - t_a))
        slack = height * (cut.t - t_a) * (t_b - cut.t)
        return self._plane_row(down, weights_at(degree, cut.t), -height, slack)

    def _plane_row(
        self, normal: Vector, weights: Values, bound: Fraction, slack: Fraction, equation: bool = False
    ) -> Row:
        """normal . (sum weights_i P_i) + slack s <= bound."""
        between = [ZERO] * (self.task.degree - 1)
        straight = curve(self.task, {axis.name: (axis.start, *between, axis.goal) for axis in self.task.raised})
        fixed = [dot(weights, straight.coordinate(i)) for i in range(straight.dimension)]
        factors = [normal[1 + self.task.axes.index(axis)] for axis in self.task.raised]
        coefficients = [factor * w for factor in factors for w in weights[1:-1]]
        relation = FormRelation.EQ if equation else FormRelation.LE
        return Quadratic.linear((*coefficients, slack), dot(normal, fixed) - bound), relation

    # --- violations ----------------------------------------------------------------------------------------------

    def initial(self) -> list[Cut]:
        """Cuts to begin with: heights at the ends of [t_a, t_b], the sphere where P is on it or beyond it."""
        result = [Cut(CutKind.HEIGHT, t, axis.name) for axis in self.task.raised for t in self.task.times]
        kinds = (Cut(CutKind.START, ZERO), Cut(CutKind.GOAL, ONE))
        result += [cut for cut, there in zip(kinds, self.touches, strict=False) if there]
        for t, place in zip(self.task.times, self.via, strict=True):
            if sign(self.workspace.ball.margin(place)) < 0:
                result.append(Cut(CutKind.BALL, t, plane=place))
        return result

    def height_margin(self, path: Bezier, axis: Axis) -> bs.Coefficients:
        """S on [t_a, t_b] in Bernstein form of degree n-2, times a positive constant."""
        b = bs.restrict(path.coordinate(1 + self.task.axes.index(axis)), *self.task.times)
        n, height = self.task.degree, Fraction(axis.height or 0)
        return tuple((b[k] - height) * Fraction(comb(n, k), comb(n - 2, k - 1)) for k in range(1, n))

    def ball_margin(self, path: Bezier) -> bs.Coefficients:
        """M in Bernstein form."""
        margin = self.workspace.ball.margin_along(path)
        known: list[Values] = [(ZERO, ONE), (ONE, -ONE), *((t * t, -2 * t, ONE) for t in self.task.times)]
        divisors = [divisor for divisor, there in zip(known, self.touches, strict=True) if there]
        if not divisors:
            return margin
        power = bs.to_power(margin)
        for divisor in divisors:
            power = bs.divide(power, divisor)[0]
        return bs.from_power(power)

    def violations(self, values: Mapping[str, Values]) -> list[Cut]:
        """Cuts that exclude this curve; none exactly when the whole curve satisfies all conditions (and (4))."""
        path = curve(self.task, values)
        t_a, t_b = self.task.times
        result = []
        for axis in self.task.raised:
            for u in violated(self.height_margin(path, axis)):
                result.append(Cut(CutKind.HEIGHT, t_a + u * (t_b - t_a), axis.name))
        for t in violated(self.ball_margin(path)):
            result.append(self.ball_cut(path, t))
        return result

    def ball_cut(self, path: Bezier, t: Fraction) -> Cut:
        """A cut at t that excludes the curve, which is outside there: its plane touches the sphere nearly."""
        if t == 0 and self.touches[0]:
            return Cut(CutKind.START, t)
        if t == 1 and self.touches[1]:
            return Cut(CutKind.GOAL, t)
        t, place = self._outside(path, t)
        squared = self.workspace.radius_squared
        shrink = (float(squared) / float(dot(place, place))) ** 0.5
        plane = _short((Fraction(float(c) * shrink) for c in place), PLANE_BITS)
        bits = PLANE_BITS
        while 2 * dot(plane, place) <= dot(plane, plane) + squared:  # |place - plane|^2 >= |place|^2 - r^2
            plane, bits = _short(place, bits), 2 * bits
        return Cut(CutKind.BALL, t, plane=plane)

    def _outside(self, path: Bezier, t: Fraction) -> tuple[Fraction, Vector]:
        """t and P(t) outside the ball; a parameter near t where t is one of those that (4) puts on the sphere."""
        step, at = Fraction(1, GRID), t
        # The margin is zero on the sphere and negative outside. A cut needs a point strictly outside, so t itself is
        # tried first; where it is on the sphere, t + s, t - s/2, t + s/4, ...: on both sides, since the path may leave
        # the ball on either; ever closer, since it may be outside only for a moment; beyond [0, 1] there is no path.
        while not 0 <= at <= 1 or sign(self.workspace.ball.margin(path.point(at))) >= 0:
            at, step = t + step, -step / 2
        return at, path.point(at)


def _short(values: Iterable[Any], bits: int) -> tuple[Fraction, ...]:
    """Multiples of 2^-bits close to the values."""
    return tuple(Fraction(round(v * 2**bits), 2**bits) for v in values)


def _slope_weights(degree: int, t: Fraction) -> Values:
    """P'(t) is the sum of these times P_i."""
    lower = (ZERO, *weights_at(degree - 1, t), ZERO)
    return tuple(degree * (lower[i] - lower[i + 1]) for i in range(degree + 1))


def violated(b: bs.Coefficients) -> list[Fraction]:
    """Parameters where the polynomial is negative; empty exactly when it is nonnegative on [0, 1].

    Floating point proposes local minima on a grid; signs are exact, and the complete test decides when none is left.
    """
    numbers = [float(c) for c in b]
    floor = -NOISE * max(map(abs, numbers), default=0.0)
    result = []
    for k in range(GRID + 1):
        here = bs.value(numbers, k / GRID)
        if here < floor and all(here <= bs.value(numbers, j / GRID) for j in (k - 1, k + 1) if 0 <= j <= GRID):
            around = range(max(0, (k - 1) * GRID), min(GRID * GRID, (k + 1) * GRID) + 1)
            best = min(around, key=lambda j: float(bs.value(numbers, j / GRID**2)))
            result.append(Fraction(best, GRID * GRID))
    proved = [t for t in result if sign(bs.value(b, t)) < 0]
    if proved:
        return proved
    outcome = decide(b)
    return [outcome.t] if isinstance(outcome, Negative) else []

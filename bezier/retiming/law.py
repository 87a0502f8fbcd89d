"""How a path is run through, exactly: s is a polynomial of the time on each step. In the least time these are
quadratic, so that (ds/dt)^2 is linear in s."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate, pairwise

from bezier.input.numbers import parse
from bezier.motion.timelaw import Law, TimeLaw
from bezier.retiming.grid import Grid, Stop
from bezier.trajectories.exact import composed
from bezier.trajectories.limits import is_below
from bezier.trajectories.piecewise import Trajectory
from qe.exact.rational_poly import RationalPoly

ZERO = Fraction(0)
BITS = 24
"""Significant binary digits of times and speeds that are rounded."""
LONGEST = 10_000
"""Characters of a number that is read back."""


@dataclass(frozen=True, slots=True)
class Step:
    """``place``: s, as a polynomial of the time since the beginning of the step, which takes ``duration`` seconds."""

    place: RationalPoly
    duration: Fraction

    def __str__(self) -> str:
        """What ``read`` reads."""
        return f"s = {' '.join(map(str, self.place.coefficients()))} for {self.duration}"

    @staticmethod
    def read(text: str) -> Step:
        """Raises ``ValueError``."""
        place, _, duration = text.removeprefix("s = ").partition(" for ")
        return Step(RationalPoly.of([parse(c, LONGEST) for c in place.split()]), parse(duration, LONGEST))

    def state(self, time: Fraction) -> tuple[Fraction, Fraction]:
        """s and ds/dt."""
        return self.place(time), self.place.derivative()(time)


def short(value: Fraction | float, bits: int = BITS) -> Fraction:
    """The number with so many significant binary digits, rounded to the nearest."""
    exact = Fraction(value)
    unit = Fraction(2) ** (bits - exact.numerator.bit_length() + exact.denominator.bit_length())
    return Fraction(round(exact * unit)) / unit


def fastest(grid: Grid, speeds: Sequence[float]) -> tuple[Step, ...]:
    """Steps with about these ds/dt at the nodes. Times and growths are short; so at nodes inside of a piece s is only
    near the node, and the next step makes up for it; for a difference of speeds that rounding made none does, as
    numbers would be longer with each step. Breaks of the path are met exactly."""
    path, steps, resting = grid.path, list[Step](), set(grid.resting)
    s, v = path.breaks[0], ZERO
    for cut, node in zip(grid.intervals, grid.begins.tolist(), strict=True):
        start, wanted = (ZERO if k in resting else short(speeds[k]) for k in (node, node + 1))
        if cut.low == 0 and cut.piece in grid.stops:
            v = start
        aim, inside = path.breaks[cut.piece] + cut.low + cut.length, not grid.is_last(cut)
        time = 2 * (aim - s) / (v + wanted)
        time = short(time) if inside else time
        change = wanted - v if not inside or abs(wanted - v) * 2**BITS > wanted else ZERO
        growth = short(change / time) if inside else change / time
        steps.append(Step(RationalPoly.of([s, v, growth / 2]), time))
        s, v = steps[-1].state(time)
    return tuple(steps)


def usual(path: Trajectory, law: Law, duration: Fraction) -> tuple[Step, ...]:
    """One of the laws with a formula, for the whole path."""
    shape, start, scale = TimeLaw.of(law), path.breaks[0], path.breaks[-1] - path.breaks[0]
    moved = (RationalPoly.of([start]) + RationalPoly.of([scale]) * share for share in shape.shares)
    places = (place.compose(RationalPoly.of([0, 1 / duration])) for place in moved)
    lengths = (duration * (high - low) for low, high in pairwise(shape.breaks))
    return tuple(map(Step, places, lengths))


def is_motion(path: Trajectory, stops: Mapping[int, Stop], steps: Sequence[Step]) -> bool:
    """Whether the steps lead from one end of the path to the other, never back, at rest at its stops."""
    if not steps or any(step.duration <= 0 for step in steps):
        return False
    if any(not is_below(step.place.derivative(), step.duration, -1, ZERO) for step in steps):
        return False
    befores = [(path.breaks[0], ZERO), *(step.state(step.duration) for step in steps)]
    afters = [*(step.state(ZERO) for step in steps), (path.breaks[-1], ZERO)]
    resting, passed = {path.breaks[k]: stop for k, stop in stops.items()}, set[Fraction]()
    for (s, v), (place, w) in zip(befores, afters, strict=True):
        stop = resting.get(s)
        if s != place or (v != w if stop is None else (stop.before and v) or (stop.after and w)):
            return False
        passed.add(s)
    return passed >= set(resting)


def timed(path: Trajectory, steps: Sequence[Step]) -> Trajectory:
    """The path over time, from t = 0."""
    breaks = list(accumulate((step.duration for step in steps), initial=ZERO))
    return composed(path, breaks, [step.place for step in steps])

"""The height condition, decided for whole paths: wherever a <= x(t) <= b, y and z are not below their heights.

The paper asks it of the curve of Method 1 between t_a and t_b, and of the middle curve of Method 2. The outer curves
of Method 2 may come back into the strip a <= x <= b below the height, so it is decided for every curve. For Method 2
a and b are the abscissae of the via points, and a height is their coordinate (the lower one where they differ), if it
is positive, as the paper has it.

Signs of x(t) - a, b - x(t) and h - y(t) change only at their roots in t, and these are isolated: the answer holds
for all t, and a stretch below the height is given by the roots at its ends.

Does the path go through the origin O? The paper leaves O out of the reachable set, so it is worth a note.

A curve goes through O where its three coordinates vanish together: at events at which all three signs are zero.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, groupby, pairwise, zip_longest
from operator import itemgetter
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure
from bezier.curves.nonnegative import Event, Interval, events_of
from bezier.curves.scalar import brief, decimal_text, sign
from bezier.obstacles.clearance import Along
from bezier.obstacles.obstacle import Constraint
from bezier.paths.path import Path

AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True, slots=True)
class Strip:
    """The condition: ``heights`` by axis, to be kept wherever low <= x <= high."""

    low: Fraction
    high: Fraction
    heights: Mapping[str, Fraction]

    def outline(self, axis: str) -> tuple[Constraint, ...]:
        """Where the condition is violated: x - a >= 0, b - x >= 0 and h - y > 0."""
        x, one = (1, 0, 0), (0, 0, 0)
        raised = (0, 1, 0) if axis == "y" else (0, 0, 1)
        return (
            Constraint.of({x: 1, one: -self.low}),
            Constraint.of({x: -1, one: self.high}),
            Constraint.of({raised: -1, one: self.heights[axis]}, strict=True),
        )


@dataclass(frozen=True, slots=True)
class StretchEnd:
    """Where a stretch begins or ends: ``t`` isolates the parameter (equal ends: exactly), ``at`` says what is there."""

    t: Interval
    at: str
    included: bool


@dataclass(frozen=True, slots=True)
class Below:
    """A whole stretch of parameters on which a curve is in the strip and below a height."""

    curve: str
    axis: str
    begin: StretchEnd
    end: StretchEnd
    sample: tuple[Fraction, Any] | None
    """The curve's coordinate at a rational parameter of it; None when the stretch is a single irrational one."""


@dataclass(frozen=True, slots=True)
class Heights:
    """What was decided about a path; ``strip``: None when the problem has no positive height."""

    strip: Strip | None
    below: tuple[Below, ...]

    @property
    def hold(self) -> bool:
        """Whether the condition holds on the whole path."""
        return not self.below


def heights_of(strip: Strip | None, path: Path) -> Heights:
    """Decide the height condition on every curve of a path. Complete: it holds, or all stretches below are found."""
    if strip is None:
        return Heights(None, ())
    result = []
    for name, curve in path.curves.items():
        along = Along(curve)
        for axis in strip.heights:
            result += _below(name, along, strip, axis)
    return Heights(strip, tuple(result))


def _below(name: str, along: Along, strip: Strip, axis: str) -> list[Below]:
    outline = strip.outline(axis)
    forms = [along.form(c) for c in outline]
    events = events_of(forms)
    at = [_violated(outline, event.signs) for event in events]
    between = [
        _violated(outline, [sign(bs.value(f, (one.t[1] + two.t[0]) / 2)) for f in forms])
        for one, two in pairwise(events)
    ]
    return [
        Below(
            name,
            axis,
            _end(events[first], strip, axis, at[first]),
            _end(events[last], strip, axis, at[last]),
            _sample(along.curve, axis, events[first].t, events[last].t),
        )
        for first, last in _runs(at, between)
    ]


def _violated(outline: Sequence[Constraint], signs: Sequence[int]) -> bool:
    return all(c.holds(s) for c, s in zip(outline, signs, strict=True))


def _runs(at: Sequence[bool], between: Sequence[bool]) -> list[tuple[int, int]]:
    """Maximal runs of truth over the critical values and the gaps after them, as indices of their first and last."""
    flat = enumerate(chain.from_iterable(zip_longest(at, between, fillvalue=False)))
    runs = ([k for k, _ in group] for holds, group in groupby(flat, key=itemgetter(1)) if holds)
    return [(run[0] // 2, (run[-1] + 1) // 2) for run in runs]


def _end(event: Event, strip: Strip, axis: str, included: bool) -> StretchEnd:
    named = (f"x = {strip.low}", f"x = {strip.high}", f"{axis} = {strip.heights[axis]}")
    zero = [name for name, here in zip(named, event.signs, strict=True) if here == 0]
    return StretchEnd(event.t, " and ".join(zero) or "end of the curve", included)


def _sample(curve: Bezier, axis: str, first: Interval, last: Interval) -> tuple[Fraction, Any] | None:
    """The coordinate in the middle of a stretch, or at its only parameter."""
    if first == last and first[0] < first[1]:
        return None
    t = first[0] if first == last else (first[1] + last[0]) / 2
    return t, bs.value(curve.coordinate(AXES[axis]), t)


# --- for people and machines ----------------------------------------------------------------------------


def summary_lines(heights: Heights) -> list[str]:
    """One line for the whole path, and one for each stretch below."""
    if heights.strip is None:
        return []
    strip = heights.strip
    bounds = " and ".join(f"{axis} >= {brief(height)}" for axis, height in strip.heights.items())
    where = f"{bounds} wherever {brief(strip.low)} <= x <= {brief(strip.high)}"
    if heights.hold:
        return [f"heights: {where}: holds on all curves, for all t"]
    return [f"heights: {where}: DOES NOT HOLD", *(in_words(item) for item in heights.below)]


def in_words(item: Below) -> str:
    """A stretch below a height."""
    begin, end = (_parameter(side.t) for side in (item.begin, item.end))
    span = f"at t = {begin}" if item.begin.t == item.end.t else f"for t from {begin} to {end}"
    ends = item.begin.at if item.begin.t == item.end.t else f"{item.begin.at} to {item.end.at}"
    least = f"; at t = {brief(item.sample[0])} {item.axis} is {decimal_text(item.sample[1], 6)}" if item.sample else ""
    return f"{item.curve} is below the height in {item.axis} {span} ({ends}){least}"


def _parameter(t: Interval) -> str:
    if t[0] == t[1]:
        return brief(t[0])
    return f"about {float((t[0] + t[1]) / 2):.8g}"


def to_json(heights: Heights) -> dict[str, Any]:
    """The condition, whether it holds, and every stretch below with the roots at its ends, enclosed."""
    if heights.strip is None:
        return {"condition": None, "holds": True, "below": []}
    strip = heights.strip
    return {
        "condition": {
            "from_x": str(strip.low),
            "to_x": str(strip.high),
            "at_least": {axis: str(height) for axis, height in strip.heights.items()},
        },
        "holds": heights.hold,
        "below": [
            {"curve": item.curve, "axis": item.axis, "from": _stated(item.begin), "to": _stated(item.end)}
            for item in heights.below
        ],
    }


def _stated(end: StretchEnd) -> dict[str, Any]:
    value = {"exact": str(end.t[0])} if end.t[0] == end.t[1] else Enclosure(*end.t).to_json()
    return {"t": value, "where": end.at, "included": end.included}


START, END = (Fraction(0), Fraction(0)), (Fraction(1), Fraction(1))


def through_origin(curve: Bezier) -> tuple[Interval, ...]:
    """The parameters with P(t) = O, ascending, each isolated (equal ends: exactly)."""
    rows = [curve.coordinate(i) for i in range(curve.dimension)]
    if any({sign(c) for c in row} in ({1}, {-1}) for row in rows):
        return ()
    return tuple(event.t for event in events_of(rows) if not any(event.signs))


def remarks(path: Path) -> tuple[str, ...]:
    """A note for each place inside a curve where the path goes through O; given points in O have notes of their own."""
    result = []
    for name, curve in path.curves.items():
        for low, high in through_origin(curve):
            if (low, high) not in (START, END):
                t = str(low) if low == high else f"about {float((low + high) / 2):.8g}"
                result.append(f"the path goes through the origin O ({name} at t = {t}), which the paper excludes")
    return tuple(result)

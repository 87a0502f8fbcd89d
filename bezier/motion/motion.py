"""Quality of a planned path: lengths, curvatures, and the motion along it in time, with limits that are kept or not.

Without a motion the time is that of ``path.csv``: each curve takes its duration. With one it is in seconds, and the
curves composed with the time law are polynomials again: a trajectory, whose largest speed and acceleration are decided
as by ``bezier certify``. Irrational coordinates are replaced by rational numbers next to them (``BITS``).
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from itertools import accumulate
from math import ceil
from typing import Any

from bezier.curves import enclosure
from bezier.curves.curve import Bezier
from bezier.curves.scalar import Vector, add, decimal_text, described, is_zero, scale
from bezier.input.toml_table import Table
from bezier.motion.timelaw import TICK, Law, TimeLaw
from bezier.paths.path import Path
from bezier.trajectories.exact import by_control_points, composed
from bezier.trajectories.piecewise import Trajectory
from qe.exact.rational_poly import RationalPoly
from qe.extras import wanted

REL = Fraction(1, 10**6)
ROWS = 151
"""Rows of ``motion.csv``."""
BITS = 96
"""How near a rational number is to an irrational one in its place."""
ORDERS = {"max_speed": 1, "max_acceleration": 2}
"""The limits, and of which derivative they are."""
QUARTER = Fraction(1, 4)


@dataclass(frozen=True, slots=True)
class Timing:
    """What a problem asks of the motion."""

    law: Law
    ramp: Fraction
    duration: Fraction | None
    """None for the least one. Invariant: a duration or a limit."""
    limits: Mapping[str, Fraction] = field(default_factory=dict)

    def to_json(self) -> dict[str, str]:
        """The table of the problem file."""
        result = {"law": self.law.value, **{key: str(value) for key, value in self.limits.items()}}
        if self.law is Law.TRAPEZOID:
            result["ramp"] = str(self.ramp)
        if self.duration is not None:
            result["duration"] = str(self.duration)
        return result


def read_timing(table: Table) -> Timing | None:
    """The table [timing], None when there is none. Raises ``InputError`` naming the key."""
    if "timing" not in table.values:
        return None
    section = table.inner("timing")
    raw = section.values
    section.only(("law", "ramp", "duration", *ORDERS))
    law = section.choice("law", Law, Law.QUINTIC)
    if "ramp" in raw and law is not Law.TRAPEZOID:
        raise section.error("ramp", 'this key with law = "trapezoid" only', f'law = "{law.value}"')
    ramp = section.positive("ramp", QUARTER)
    if ramp > Fraction(1, 2):
        raise section.error("ramp", "at most 1/2", str(ramp))
    duration = section.positive("duration") if "duration" in raw else None
    limits = {key: section.positive(key) for key in ORDERS if key in raw}
    if law is Law.LEAST and duration is not None:
        raise section.error("duration", 'no such key with law = "least"', str(duration))
    if law is Law.LEAST and "max_acceleration" not in limits:
        raise section.error("max_acceleration", 'this limit with law = "least"', "none")
    if duration is None and not limits:
        raise section.error("duration", "a duration, max_speed or max_acceleration", "none of them")
    return Timing(law, ramp, duration, limits)


@dataclass(frozen=True, slots=True)
class Motion:
    """A path in time. ``rates``: the largest speed and acceleration, if it took one second; ``kept``: whether each
    limit is kept at all times, exactly."""

    timing: Timing
    duration: Fraction
    trajectory: Trajectory
    rates: Mapping[str, enclosure.Enclosure]
    kept: Mapping[str, bool]
    law: TimeLaw
    at_least: Fraction | None = None
    """Seconds that no motion along the path can beat, with the law of least time; ``rests``: none that rests where the
    path stands still."""
    rests: bool = False

    def __repr__(self) -> str:
        return f"Motion({float(self.duration):.6g} s, {'within' if self.keeps_limits else 'not within'} its limits)"

    @property
    def largest(self) -> dict[str, enclosure.Enclosure]:
        """The largest speed (mm/s) and acceleration (mm/s^2) over the whole time, by the names of their limits."""
        return {key: rate.scaled(self.duration ** -ORDERS[key]) for key, rate in self.rates.items()}

    @property
    def keeps_limits(self) -> bool:
        """Whether every limit is proved to be kept at all times."""
        return all(self.kept.values())

    @property
    def enough(self) -> Fraction:
        """A duration with which the same motion is proved to keep all limits."""
        return least_duration(self.rates, self.timing.limits)

    @property
    def reason(self) -> str:
        """Which limits are not kept, in words; empty when all are."""
        units = {"max_speed": "mm/s", "max_acceleration": "mm/s^2"}
        broken = [key for key, kept in self.kept.items() if not kept]
        parts = [f"{key} = {self.timing.limits[key]} {units[key]} is EXCEEDED" for key in broken]
        return f"in {self.duration} s the motion does not keep its limits: {', '.join(parts)}" if parts else ""

    @property
    def bound_in_words(self) -> str:
        """Where a bound of the time is known, what it is."""
        if self.at_least is None:
            return ""
        which = "every motion that rests where the path stands still" if self.rests else "every motion"
        return f"; {which} takes at least {decimal_text(self.at_least, 8)} s"

    @property
    def suggestion(self) -> str:
        """A line of the problem file with which all limits are kept."""
        return f'duration = "{self.enough}"'


@dataclass(frozen=True, slots=True)
class Quality:
    """Length (mm) and largest curvature (1/mm; None for a curve that is one point) of each curve, and the motion."""

    lengths: Mapping[str, enclosure.Enclosure]
    curvatures: Mapping[str, enclosure.Enclosure | None]
    motion: Motion | None

    def __repr__(self) -> str:
        return f"Quality(length {float(self.length.low):.6g} mm{'' if self.motion is None else f', {self.motion!r}'})"

    @property
    def length(self) -> enclosure.Enclosure:
        """The length of the whole path."""
        return sum(self.lengths.values(), enclosure.Enclosure(Fraction(0), Fraction(0)))

    @property
    def curvature(self) -> enclosure.Enclosure | None:
        """The largest one on the whole path."""
        bends = [bend for bend in self.curvatures.values() if bend is not None]
        tops = [bend.high for bend in bends if bend.high is not None]
        highest = max(tops) if tops and len(tops) == len(bends) else None
        return enclosure.Enclosure(max(bend.low for bend in bends), highest) if bends else None


def quality_of(path: Path, timing: Timing | None, rel: Fraction = REL) -> Quality:
    """Enclosures for every curve of the path."""
    lengths = {name: enclosure.length_enclosure(curve, rel) for name, curve in path.curves.items()}
    curvatures = {
        name: None if is_zero(lengths[name].low) else enclosure.curvature_enclosure(curve, rel)
        for name, curve in path.curves.items()
    }
    has_law = timing is not None and timing.law is not Law.LEAST
    return Quality(lengths, curvatures, motion_of(path, timing) if timing is not None and has_law else None)


def motion_of(path: Path, timing: Timing) -> Motion:
    """The motion that the timing asks for, which has a law with a formula."""
    return moving(path, timing, TimeLaw.of(timing.law, timing.ramp))


def moving(path: Path, timing: Timing, law: TimeLaw, shortest: Fraction = Fraction(0)) -> Motion:
    """The motion by a law in the time asked for, or in the least one, from ``shortest`` on, that keeps the limits.

    Taking one second it is decided; in another time, speed is divided by that, acceleration by its square.
    """
    with wanted():
        from bezier.trajectories.limits import Limit, decided

    places = in_time(path, None)
    total = RationalPoly.of([places.breaks[-1]])
    unit = composed(places, law.breaks, [total * share for share in law.shares])
    outcomes = decided(unit, [Limit(order, None, Fraction(1)) for order in ORDERS.values()], Fraction(0)).outcomes
    values = (enclosure.root_enclosure(*(max(v, Fraction(0)) for v in o.peak.value)) for o in outcomes)
    rates = dict(zip(ORDERS, values, strict=True))
    least = max(least_duration(rates, timing.limits), shortest)
    duration = least if timing.duration is None else timing.duration
    kept = dict[str, bool]()
    for key, limit in timing.limits.items():
        most = limit * duration ** ORDERS[key]
        known = rates[key].keeps(most)
        if known is None:  # it is reached, or nearly
            known = decided(unit, [Limit(ORDERS[key], None, most)], Fraction(0)).outcomes[0].is_kept
        kept[key] = known
    share = RationalPoly.of([0, 1 / duration])
    rows = tuple(tuple(p.compose(share) for p in row) for row in unit.pieces)
    moved = Trajectory(unit.names, tuple(duration * t for t in unit.breaks), rows)
    return Motion(timing, duration, moved, rates, kept, law)


def least_duration(rates: Mapping[str, enclosure.Enclosure], limits: Mapping[str, Fraction]) -> Fraction:
    """The least time in which the limits are kept, rounded up to a multiple of ``TICK``; ``rates``: for one second."""
    times = [Fraction(0)]
    for key, limit in limits.items():
        ratio = rates[key].finite[1] / limit
        times.append(ratio if ORDERS[key] == 1 else enclosure.root_above(ratio, bits=64))
    return ceil(max(times) / TICK) * TICK


def in_time(path: Path, motion: Motion | None) -> Trajectory:
    """The motion; without one each curve takes its duration."""
    if motion is not None:
        return motion.trajectory
    return joined("xyz", [(path.duration(name), curve) for name, curve in path.curves.items()])


def joined(names: str, parts: Sequence[tuple[Fraction, Bezier]]) -> Trajectory:
    """Curves one after the other, each with its duration; irrational coordinates become numbers next to them."""
    rows = [tuple(tuple(near(c) for c in point) for point in curve.points) for _, curve in parts]
    breaks = tuple(accumulate((length for length, _ in parts), initial=Fraction(0)))
    polys = [by_control_points(row, length) for row, (length, _) in zip(rows, parts, strict=True)]
    return Trajectory(tuple(names), breaks, tuple(polys))


def near(value: Any) -> Fraction:
    """The number if it is rational, else a rational one next to it."""
    low, high = enclosure.bounds(value, BITS)
    return (low + high) / 2


# --- files and words ----------------------------------------------------------------------------------

HEADER = """\
# Motion along the path, law "{law}", computed exactly and then rounded.
# time in s; x, y, z: position in mm; vx, vy, vz: velocity in mm/s; ax, ay, az: acceleration in mm/s^2;
# segment: the curve; u: its parameter, 0 to 1.
time,x,y,z,vx,vy,vz,ax,ay,az,segment,u
"""


def motion_csv(path: Path, motion: Motion) -> str:
    """``motion.csv``: the motion at equally spaced times."""
    rows = [HEADER.format(law=motion.timing.law.value)]
    for k in range(ROWS):
        tau = Fraction(k, ROWS - 1)
        name, u, vectors = state(path, motion, tau)
        numbers = [tau * motion.duration, *(c for vector in vectors for c in vector)]
        rows.append(f"{','.join(decimal_text(v, 10) for v in numbers)},{name},{decimal_text(u, 10)}\n")
    return "".join(rows)


def state(path: Path, motion: Motion, tau: Fraction) -> tuple[str, Fraction, tuple[Vector, Vector, Vector]]:
    """The curve, its parameter, and position, velocity and acceleration at the time tau * duration, exactly."""
    total = sum((path.duration(name) for name in path.curves), Fraction(0))
    value, slope, bend = (total * d for d in motion.law.derivatives(tau))
    begin, last = Fraction(0), list(path.curves)[-1]
    for name in path.curves:
        length = path.duration(name)
        if value <= begin + length or name == last:
            u, rate, growth = (value - begin) / length, slope / length, bend / length
            break
        begin += length
    curve = path.curves[name]
    first, second = curve.derivative(1, u), curve.derivative(2, u)
    velocity = scale(rate / motion.duration, first)
    acceleration = scale(1 / motion.duration**2, add(scale(rate * rate, second), scale(growth, first)))
    return name, u, (curve.point(u), velocity, acceleration)


def to_json(motion: Motion) -> dict[str, Any]:
    """``motion.json``: law, duration, rigorous extremes, and whether the limits are kept at all times."""
    bound = {} if motion.at_least is None else {"at_least": described(motion.at_least), "rests": motion.rests}
    return {
        "law": motion.timing.law.value,
        "duration": described(motion.duration),
        "largest_speed": motion.largest["max_speed"].to_json(),
        "largest_acceleration": motion.largest["max_acceleration"].to_json(),
        "limits": {key: str(value) for key, value in motion.timing.limits.items()},
        "kept": dict(motion.kept),
        "units": {"time": "s", "length": "mm"},
        **bound,
    }


def files(path: Path | None, quality: Quality | None) -> dict[str, str]:
    """The data files about the motion."""
    if path is None or quality is None or quality.motion is None:
        return {}
    text = json.dumps(to_json(quality.motion), indent=1) + "\n"
    return {"motion.csv": motion_csv(path, quality.motion), "motion.json": text}


def summary_lines(quality: Quality | None) -> list[str]:
    """The lines of the summary about quality and motion."""
    if quality is None:
        return []
    bent = {name: value for name, value in quality.curvatures.items() if value is not None}
    name = max(bent, key=lambda n: float(bent[n]), default=None)
    most = ""
    if name is not None:
        worst = f"{bent[name].shown()} 1/mm" if bent[name].is_bounded else "unbounded at a cusp"
        most = f", largest curvature {worst} ({name})"
    lines = [f"length {quality.length.shown()} mm{most}"]
    if quality.motion is not None:
        motion, said = quality.motion, {True: "kept", False: "EXCEEDED"}
        limits = "".join(f", {key.replace('_', ' ')} {said[kept]} at all times" for key, kept in motion.kept.items())
        fastest, hardest = map(_short, motion.largest.values())
        lines.append(
            f"motion: {motion.timing.law.value}, {decimal_text(motion.duration, 8)} s, at most {fastest} mm/s and"
            f" {hardest} mm/s^2{limits}{motion.bound_in_words}"
        )
        if not quality.motion.keeps_limits:
            lines.append(f"{quality.motion.reason}; kept at all times with {quality.motion.suggestion}")
    return lines


def _short(value: enclosure.Enclosure) -> str:
    """An upper bound in a few digits."""
    high = value.to_json(6)["high"]
    return high if high == "inf" else f"{Decimal(high).normalize():f}"


def json_entries(quality: Quality | None) -> dict[str, Any]:
    """The entries of the JSON summary about quality and motion."""
    if quality is None:
        return {}
    entries: dict[str, Any] = {
        "length": quality.length.to_json(),
        "lengths": {name: value.to_json() for name, value in quality.lengths.items()},
        "largest_curvatures": {n: None if v is None else v.to_json() for n, v in quality.curvatures.items()},
    }
    if quality.motion is not None:
        entries["motion"] = to_json(quality.motion)
    data: dict[str, Any] = {"quality": entries}
    if quality.motion is not None and not quality.motion.keeps_limits:
        data |= {"reason": quality.motion.reason, "suggestion": quality.motion.suggestion}
    return data

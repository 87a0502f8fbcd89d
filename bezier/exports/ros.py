"""ROS 2 ``trajectory_msgs`` as YAML, as ``ros2 topic pub`` takes it. Lengths in metres (REP 103), times in seconds."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from bezier.motion.track import Array, Track
from qe.arguments import shown, wrong
from qe.errors import InputError

ROWS = 101
NANO = 10**9
LONGEST = 2**31
"""Seconds; a duration has 32 bits for them."""
MOST_ROWS = 100_000
STILL = "{x: 0.0, y: 0.0, z: 0.0}"
UPRIGHT = "{x: 0.0, y: 0.0, z: 0.0, w: 1.0}"


def ros_trajectory(
    track: Track, *, frame: str = "base_link", joints: Sequence[str] | None = None, rows: int = ROWS
) -> str:
    """The motion at ``rows`` equally spaced times.

    Without ``joints`` a ``MultiDOFJointTrajectory`` of the end effector, which keeps the orientation of the frame; with
    three names a ``JointTrajectory`` of a gantry, whose prismatic joints are x, y and z.
    """
    names = ["end_effector"] if joints is None else _joints(joints)
    if not 2 <= rows <= MOST_ROWS:
        raise InputError(f"rows: a number from 2 to {MOST_ROWS} expected, {shown(rows)} found")
    ticks = [round(Fraction(k, rows - 1) * Fraction(track.end) * NANO) for k in range(rows)]
    if ticks[-1] // NANO >= LONGEST:
        raise InputError(f"to_ros: a motion of less than 2^31 s expected, one of {track.end:.3g} s found")
    if len(set(ticks)) < rows:
        raise InputError(f"rows: times that differ by a nanosecond expected, {rows} of them in {track.end:.3g} s found")
    lines = ["header:", "  stamp: {sec: 0, nanosec: 0}", f"  frame_id: {_quoted(frame)}"]
    lines += [f"joint_names: [{', '.join(map(_quoted, names))}]", "points:"]
    times = np.minimum(np.linspace(0.0, track.end, rows), track.end)
    found = (track.at(times), track.derivative.at(times), track.derivative.derivative.at(times))
    for k, tick in enumerate(ticks):
        place, velocity, acceleration = (vectors[k] / 1000 for vectors in found)
        lines += _free(place, velocity, acceleration) if joints is None else _gantry(place, velocity, acceleration)
        lines.append(f"  time_from_start: {{sec: {tick // NANO}, nanosec: {tick % NANO}}}")
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _joints(given: object) -> list[str]:
    if not isinstance(given, list | tuple) or not all(isinstance(j, str) for j in given) or len(set(given)) != 3:
        raise wrong("joints", "a list of the names of three joints", given)
    return list(given)


def _free(place: Array, velocity: Array, acceleration: Array) -> list[str]:
    return [
        "- transforms:",
        f"  - translation: {_vector(place)}",
        f"    rotation: {UPRIGHT}",
        *("  velocities:", f"  - linear: {_vector(velocity)}", f"    angular: {STILL}"),
        *("  accelerations:", f"  - linear: {_vector(acceleration)}", f"    angular: {STILL}"),
    ]


def _gantry(place: Array, velocity: Array, acceleration: Array) -> list[str]:
    rows = zip(("- positions", "  velocities", "  accelerations"), (place, velocity, acceleration), strict=True)
    return [f"{key}: [{', '.join(map(_number, row))}]" for key, row in rows] + ["  effort: []"]


def _vector(values: Array) -> str:
    return "{" + ", ".join(f"{axis}: {_number(v)}" for axis, v in zip("xyz", values, strict=True)) + "}"


def _number(value: float) -> str:
    """With a point and without an exponent, which YAML 1.1 would read as text."""
    return f"{value:.12f}" if round(value, 12) else "0.0"

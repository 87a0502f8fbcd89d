"""A motion as numpy arrays (``.npz``), as SciPy's piecewise polynomials, and as ROS 2 ``trajectory_msgs`` in YAML, as
``ros2 topic pub`` takes it (lengths in metres, REP 103; times in seconds).
"""

from __future__ import annotations

import io
import json
from collections.abc import Sequence
from fractions import Fraction
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from bezier.motion.track import Array, Track
from qe.arguments import shown, wrong
from qe.errors import InputError, Unable
from qe.extras import wanted

if TYPE_CHECKING:
    from scipy.interpolate import BSpline, PPoly


ROWS = 151


def npz(track: Track) -> bytes:
    """A file for ``numpy.load``, without pickles.

    ``time`` (ROWS,), ``position``, ``velocity``, ``acceleration`` (ROWS, 3), and the motion itself as Bézier pieces:
    ``breaks`` (n+1,) and ``control`` (n, d+1, 3).
    """
    time, file = np.linspace(0.0, track.end, ROWS), io.BytesIO()
    np.savez_compressed(
        file,
        time=time,
        position=track.at(time),
        velocity=track.derivative.at(time),
        acceleration=track.derivative.derivative.at(time),
        breaks=track.breaks,
        control=track.control,
    )
    return file.getvalue()


HIGH = 8
"""The degree that powers over a whole piece keep to about 14 digits; twice of it over each half."""


def bspline(track: Track) -> BSpline:
    """Degree d with d-fold inner knots: its coefficients are the control points, those at the joins once.

    A Bézier chain is a B-spline with knots of this multiplicity (Farin, "Curves and Surfaces for CAGD", chapter 8).
    """
    with wanted():
        from scipy.interpolate import BSpline
    degree = track.control.shape[1] - 1
    knots = np.concatenate([track.breaks[:1], np.repeat(track.breaks, degree), track.breaks[-1:]])
    points = np.concatenate([track.control[0, :1], track.control[:, 1:].reshape(-1, 3)])
    return BSpline(knots, points, degree, extrapolate=False)


def ppoly(track: Track) -> PPoly:
    """The same by powers of the time since the last break; long polynomials get breaks between, as high powers over
    a long time cancel each other in floating point. Raises ``Unable`` where floating point has none of them."""
    with wanted():
        from scipy.interpolate import PPoly
    parts = 1
    while track.control.shape[1] - 1 > HIGH * parts:
        track, parts = track.halved(), 2 * parts
    try:
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            # the highest power first: the coefficient of u^k is C(d, k) times the k-th difference
            degree, length = track.control.shape[1] - 1, np.diff(track.breaks)[:, None]
            differences = (np.diff(track.control, n=k, axis=1)[:, 0] / length**k for k in range(degree + 1))
            powers = np.array([comb(degree, k) * row for k, row in enumerate(differences)][::-1])
    except FloatingPointError:
        raise Unable("powers of times so long or short are outside floating point; to_bspline has none") from None
    return PPoly(powers, track.breaks, extrapolate=False)


NANO = 10**9
LONGEST = 2**31
"""Seconds; a duration has 32 bits for them."""
MOST_ROWS = 100_000
STILL = "{x: 0.0, y: 0.0, z: 0.0}"
UPRIGHT = "{x: 0.0, y: 0.0, z: 0.0, w: 1.0}"


def ros_trajectory(
    track: Track, *, frame: str = "base_link", joints: Sequence[str] | None = None, rows: int = 101
) -> str:
    """The motion at ``rows`` equally spaced times.

    Without ``joints`` a ``MultiDOFJointTrajectory`` of the end effector, which keeps the orientation of the frame; with
    three names a ``JointTrajectory`` of a gantry, whose prismatic joints are x, y and z.
    """
    is_list = joints is None or (isinstance(joints, list | tuple) and all(isinstance(j, str) for j in joints))
    if not is_list or (joints is not None and len(set(joints)) != 3):
        raise wrong("joints", "a list of the names of three joints", joints)
    names = ["end_effector"] if joints is None else joints
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
    result = (track.at(times), track.derivative.at(times), track.derivative.derivative.at(times))
    for k, tick in enumerate(ticks):
        place, velocity, acceleration = (vectors[k] / 1000 for vectors in result)
        lines += _free(place, velocity, acceleration) if joints is None else _gantry(place, velocity, acceleration)
        lines.append(f"  time_from_start: {{sec: {tick // NANO}, nanosec: {tick % NANO}}}")
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


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

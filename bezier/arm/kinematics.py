"""Forward kinematics: exact for exact values of the joints, with numpy for angles in floating point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from math import pi
from typing import TYPE_CHECKING, Any

from bezier.arm.model import Arm, in_field
from bezier.proofs.held_joint import slid, turned
from bezier.proofs.square_roots import carried, carried_with_rates, image, together
from qe.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

ZERO, ONE = Fraction(0), Fraction(1)


def pose(arm: Arm, values: Mapping[str, Any]) -> tuple[tuple[Any, ...], ...]:
    """The frame of the end effector (mm), exactly: the upper three of four rows.

    ``values``: for a revolute joint (cosine, sine), for a prismatic one its length in mm; rational numbers, elements of
    ``arm.field``, polynomials: whatever adds and multiplies. Raises ``InputError`` for a missing joint, or cosine and
    sine (as exact numbers) whose squares do not add up to 1.
    """
    whole, *links = arm.chain.in_numbers(lambda c: in_field(c, arm.field))
    names = [joint.name for joint in arm.joints]
    if not isinstance(values, Mapping) or not set(values) <= set(names):
        raise InputError(f"values: what the joints {', '.join(names)} are, by their names, expected")
    for joint, turns, link in zip(arm.joints, arm.chain.turns, links, strict=True):
        if joint.name not in values:
            raise InputError(f"values: a value for the joint {joint.name} expected")
        value = values[joint.name]
        parts = value if turns and isinstance(value, list | tuple) else [value]
        if len(parts) != 1 + turns or any(isinstance(part, str | bool | float | list | tuple) for part in parts):
            what = "cosine and sine" if turns else "a length"
            raise InputError(f"{joint.name}: {what} expected, as exact numbers, {value!r} found")
        if turns:
            c, s = parts
            if isinstance(c, int | Fraction) and isinstance(s, int | Fraction) and c * c + s * s != 1:
                raise InputError(f"{joint.name}: cosine {c} and sine {s} have squares that do not add up to 1")
        motion = turned(parts[0], parts[1], ZERO, ONE) if turns else slid(parts[0], ZERO, ONE)
        whole = together(together(whole, motion), link)
    return tuple((*row, o) for row, o in zip(*whole, strict=True))


def position(arm: Arm, values: Mapping[str, Any]) -> tuple[Any, Any, Any]:
    """The point of the end effector (mm), exactly; see ``pose``."""
    x, y, z = (row[3] for row in pose(arm, values))
    return x, y, z


@lru_cache(maxsize=64)
def floats(arm: Arm) -> list[Any]:
    """The constant motions in floating point."""
    return arm.chain.in_numbers(float)


def _rows(arm: Arm, q: Sequence[Sequence[float]] | Floats) -> Floats:
    """As an array of shape (N, joints). Raises ``InputError`` for another shape."""
    import numpy as np

    try:
        result = np.atleast_2d(np.asarray(q, dtype=float))
    except (TypeError, ValueError, OverflowError):
        raise InputError("joint positions: numbers, rad or mm, expected") from None
    if not np.isfinite(result).all():
        raise InputError("joint positions: finite numbers expected")
    if result.ndim != 2 or result.shape[1] != len(arm.joints):
        raise InputError(f"joint positions: rows of {len(arm.joints)} numbers expected, shape {result.shape} found")
    return result


def _values(arm: Arm, q: Sequence[Sequence[float]] | Floats) -> tuple[list[tuple[Floats, ...]], list[Floats]]:
    """Cosines and sines, or lengths, of all joints; and the point 0."""
    import numpy as np

    rows = _rows(arm, q)
    columns = zip(arm.chain.turns, rows.T, strict=True)
    return [(np.cos(v), np.sin(v)) if turns else (v,) for turns, v in columns], [np.zeros(len(rows))] * 3


def positions(arm: Arm, q: Sequence[Sequence[float]] | Floats) -> Floats:
    """The points (mm) for many joint positions: ``q`` of shape (N, joints), rad or mm; the result has shape (N, 3)."""
    import numpy as np

    base, *links = floats(arm)
    return np.stack(image(base, carried(links, *_values(arm, q))), axis=1)


def jacobians(arm: Arm, q: Sequence[Sequence[float]] | Floats) -> Floats:
    """The derivatives of the points by the joints, shape (N, 3, joints): mm per rad, or mm per mm."""
    import numpy as np

    base, *links = floats(arm)
    values, origin = _values(arm, q)
    _, rates = carried_with_rates(links, values, origin)
    columns = [np.stack([v + origin[0] for v in image(base, rate, False)], axis=1) for rate in rates]
    return np.stack(columns, axis=2)


def skeleton(arm: Arm, q: Sequence[float]) -> list[list[float]]:
    """The ends of the links (mm), from the base on, for one joint position (rad or mm), for pictures."""
    parts = ((part, [q[: len(part.joints)]]) for part in _parts(arm))
    return [[0.0, 0.0, 0.0], *(positions(part, values)[0].tolist() for part, values in parts)]


@lru_cache(maxsize=64)
def _parts(arm: Arm) -> tuple[Arm, ...]:
    return tuple(replace(arm, rows=arm.rows[:k]) for k in arm.ends[1:])


def wrapped(angle: float) -> float:
    """The same angle in (-pi, pi]."""
    rest = (angle + pi) % (2 * pi) - pi
    return pi if rest == -pi else rest

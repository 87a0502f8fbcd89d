"""Forward kinematics: exact for exact values of the joints, with numpy for angles in floating point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from math import pi
from typing import TYPE_CHECKING, Any

from bezier.arm.model import Arm, JointKind, Matrix, apply, motion, product
from qe.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

ORIGIN = (Fraction(0),) * 3


def pose(arm: Arm, values: Mapping[str, Any]) -> Matrix:
    """The frame of the end effector (mm), exactly.

    ``values``: for a revolute joint (cosine, sine), for a prismatic one its length in mm; rational numbers, elements of
    ``arm.field``, polynomials: whatever adds and multiplies. Raises ``InputError`` for a missing joint, or cosine and
    sine (as exact numbers) whose squares do not add up to 1.
    """
    chain = arm.chain
    whole = chain.constants[0]
    names = [joint.name for joint in chain.joints]
    if not isinstance(values, Mapping) or not set(values) <= set(names):
        raise InputError(f"values: what the joints {', '.join(names)} are, by their names, expected")
    for joint, constant in zip(chain.joints, chain.constants[1:], strict=True):
        if joint.name not in values:
            raise InputError(f"values: a value for the joint {joint.name} expected")
        value = values[joint.name]
        turns = joint.motion is JointKind.REVOLUTE
        parts = value if turns and isinstance(value, list | tuple) else [value]
        if len(parts) != 1 + turns or any(isinstance(part, str | bool | float | list | tuple) for part in parts):
            what = "cosine and sine" if turns else "a length"
            raise InputError(f"{joint.name}: {what} expected, as exact numbers, {value!r} found")
        if turns:
            c, s = parts
            if isinstance(c, int | Fraction) and isinstance(s, int | Fraction) and c * c + s * s != 1:
                raise InputError(f"{joint.name}: cosine {c} and sine {s} have squares that do not add up to 1")
        whole = product(product(whole, motion(joint, value)), constant)
    return whole


def position(arm: Arm, values: Mapping[str, Any]) -> tuple[Any, Any, Any]:
    """The point of the end effector (mm), exactly; see ``pose``."""
    x, y, z = apply(pose(arm, values), ORIGIN)
    return x, y, z


@lru_cache(maxsize=64)
def _constants(arm: Arm) -> tuple[Floats, ...]:
    return tuple(map(_floats, arm.chain.constants))


def _floats(m: Matrix) -> Floats:
    import numpy as np

    return np.array([*([float(v) for v in row] for row in m), [0.0, 0.0, 0.0, 1.0]])


def _motions(arm: Arm, q: Floats) -> list[Floats]:
    """One 4 x 4 matrix for each joint and each row of ``q``; shape of each (N, 4, 4)."""
    import numpy as np

    result = []
    for k, joint in enumerate(arm.joints):
        m = np.zeros((len(q), 4, 4))
        m[:, range(4), range(4)] = 1.0
        if joint.motion is JointKind.REVOLUTE:
            c, s = np.cos(q[:, k]), np.sin(q[:, k])
            m[:, 0, 0], m[:, 0, 1], m[:, 1, 0], m[:, 1, 1] = c, -s, s, c
        else:
            m[:, 2, 3] = q[:, k]
        result.append(m)
    return result


def _rows(arm: Arm, q: Sequence[Sequence[float]] | Floats) -> Floats:
    """As an array of shape (N, joints). Raises ``InputError`` for another shape."""
    import numpy as np

    try:
        result = np.atleast_2d(np.asarray(q, dtype=float))
    except (TypeError, ValueError):
        raise InputError("joint positions: numbers, rad or mm, expected") from None
    if result.ndim != 2 or result.shape[1] != len(arm.joints):
        raise InputError(f"joint positions: rows of {len(arm.joints)} numbers expected, shape {result.shape} found")
    return result


def _frames(arm: Arm, q: Sequence[Sequence[float]] | Floats) -> list[Floats]:
    """What stands before each joint, and the end, shape of each (N, 4, 4)."""
    import numpy as np

    angles, constants = _rows(arm, q), _constants(arm)
    result = [np.broadcast_to(constants[0], (len(angles), 4, 4))]
    for m, constant in zip(_motions(arm, angles), constants[1:], strict=True):
        result.append(result[-1] @ m @ constant)
    return result


def positions(arm: Arm, q: Sequence[Sequence[float]] | Floats) -> Floats:
    """The points (mm) for many joint positions: ``q`` of shape (N, joints), rad or mm; the result has shape (N, 3)."""
    return _frames(arm, q)[-1][:, :3, 3]


def jacobians(arm: Arm, q: Sequence[Sequence[float]] | Floats) -> Floats:
    """The derivatives of the points by the joints, shape (N, 3, joints): mm per rad, or mm per mm.

    The column of a revolute joint is z x (p - o) with its axis through o along z; that of a prismatic one is z.
    """
    import numpy as np

    *axes, tip = (frame[:, :3, 2:] for frame in _frames(arm, q))
    columns = [
        np.cross(axis[..., 0], tip[..., 1] - axis[..., 1]) if joint.motion is JointKind.REVOLUTE else axis[..., 0]
        for axis, joint in zip(axes, arm.joints, strict=True)
    ]
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

"""Arms from URDF files (the Unified Robot Description Format of ROS), read by yourdfpy: ``arm.urdf`` or
``arm.urdf#last_link``.

URDF holds decimals, an arm needs exact constants: lengths are taken as written to the nanometre, angles are the nearest
multiples of pi/12 and have to lie within ``CLOSE`` of them, and axes are coordinate axes. A joint with origin T(x, y,
z) Rz(yaw) Ry(pitch) Rx(roll) becomes rows of the modified convention, with Ry(p) = Rz(90°) Rx(p) Rz(-90°).
"""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

from bezier.arm.choices import MOST_RADIANS
from bezier.arm.model import STEP, Angle, Arm, Convention, Joint, JointKind, Row
from bezier.input.numbers import shorten
from bezier.input.toml_table import read_text
from qe.errors import InputError
from qe.extras import lacking

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

CLOSE = 1e-3
"""rad: 1.571 is pi/2."""

MOST_METRES = 20
"""Larger lengths may be millimetres, which URDF does not know."""
DIGITS = 9
TO_MM = 1000
QUARTER = STEP // 2
MOVING = {"revolute": JointKind.REVOLUTE, "continuous": JointKind.REVOLUTE, "prismatic": JointKind.PRISMATIC}


def load_urdf(name: str) -> Arm:
    """The arm of a file. Raises ``InputError``, and ``Unable`` where the parser is not installed."""
    file, _, tip = name.partition("#")
    text = read_text(Path(file))
    try:  # the parser repairs damaged files, and would read another arm from them
        ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise InputError(f"{file}: a robot in URDF expected, found no XML: {error}") from None
    if "<!DOCTYPE" in text:
        raise InputError(f"{file}: a robot in URDF expected, found a document type, which may refer to other files")
    try:
        import yourdfpy
    except ImportError as error:
        if (missing := lacking(error)) is not None:
            raise missing from None
        raise
    try:
        with warnings.catch_warnings():  # about numbers that are none, which are reported below
            warnings.simplefilter("ignore", RuntimeWarning)
            model = yourdfpy.URDF.load(file, build_scene_graph=False, load_meshes=False)
        joints = list(model.robot.joints)
    except (SyntaxError, ValueError, TypeError, KeyError, AttributeError) as error:
        said = f"found what its parser refuses: {shorten(str(error))}"
        raise InputError(f"{file}: a robot in URDF expected, {said}") from None
    rows = [row for joint in _path(file, joints, tip) for row in _rows(file, joint)]
    names = [row.joint.name for row in rows if row.joint is not None]
    if not names:
        raise InputError(f"{file}: a joint that moves expected, none found")
    if len(set(names)) < len(names):
        raise InputError(f"{file}: different names of joints expected, {shorten(', '.join(names))} found")
    return Arm(str(model.robot.name or file), Convention.MODIFIED, tuple(rows), file)


def _path(file: str, joints: list[Any], tip: str) -> list[Any]:
    """The joints from the base to a link: the last one, if there is no other."""
    above = {joint.child: joint for joint in joints}
    if len(above) != len(joints):
        raise InputError(f"{file}: links with one joint each above them expected")
    ends = sorted(set(above) - {joint.parent for joint in joints})
    if not ends:
        raise InputError(f"{file}: a tree of links expected, {'a circle' if joints else 'no joint'} found")
    if not tip and len(ends) != 1:
        raise InputError(
            f"{file}: a tree with the ends {shorten(', '.join(ends))}: one of them expected, as {file}#LINK"
        )
    link, result = tip or ends[0], list[Any]()
    if link not in above:
        raise InputError(f"{file}: a link below a joint expected, {shorten(link)} found")
    while link in above and len(result) <= len(joints):
        result.append(above[link])
        link = above[link].parent
    if link in above:
        raise InputError(f"{file}: a tree of links expected, a circle found")
    return result[::-1]


def _rows(file: str, joint: Any) -> Iterator[Row]:
    where = f"{file}: joint {joint.name}"
    if joint.type not in (*MOVING, "fixed") or getattr(joint, "mimic", None) is not None:
        kind = "one that mimics another" if joint.type in MOVING else joint.type
        raise InputError(f"{where}: one of {', '.join(MOVING)}, fixed expected, {kind} found")
    (x, y, z), (roll, pitch, yaw) = _origin(joint.origin, where)
    moving = None if joint.type == "fixed" else _joint(joint, where)
    tilt, about = (0, 0) if moving is None else _tilt(joint.axis, where)
    none = Fraction(0)
    rows = [
        Row(x, Angle(), z, Angle(QUARTER), is_within=bool(y)),
        Row(y, Angle(), none, Angle.of(yaw)),
        Row(none, Angle.of(pitch), none, Angle.of(-QUARTER)),
        Row(none, Angle.of(roll + tilt), none, Angle.of(QUARTER if about else 0), None if about else moving),
    ]
    if about:
        rows.append(Row(none, Angle.of(about), none, Angle(), moving))
    if tilt or about:
        rows.append(Row(none, Angle.of(-tilt - about), none, Angle.of(-QUARTER if about else 0)))
    yield from rows


def _tilt(axis: Any, where: str) -> tuple[int, int]:
    """What turns e_z to the axis: (about x, about y), in twelfths of pi."""
    known = {(0, 0, 1): (0, 0), (0, 0, -1): (STEP, 0), (0, 1, 0): (-QUARTER, 0), (0, -1, 0): (QUARTER, 0)}
    known |= {(1, 0, 0): (0, QUARTER), (-1, 0, 0): (0, -QUARTER)}
    values = [1.0, 0.0, 0.0] if axis is None else [float(v) for v in axis]
    nearest = tuple(round(v) if math.isfinite(v) else 0 for v in values)
    if nearest not in known or any(not abs(v - n) <= CLOSE for v, n in zip(values, nearest, strict=True)):
        raise InputError(f"{where}: an axis along x, y or z expected, {values} found")
    return known[nearest]


def _origin(matrix: Floats | None, where: str) -> tuple[tuple[Fraction, ...], tuple[int, ...]]:
    """The shift (mm), and roll, pitch, yaw in twelfths of pi."""
    if matrix is None:
        return (Fraction(0),) * 3, (0, 0, 0)
    entries = [[float(v) for v in row] for row in matrix]
    if not all(math.isfinite(v) for row in entries for v in row):
        raise InputError(f"{where}: finite numbers expected as origin, {entries[:3]} found")
    if max(abs(row[3]) for row in entries[:3]) > MOST_METRES:
        raise InputError(f"{where}: an origin in m expected, {[row[3] for row in entries[:3]]} found, which may be mm")
    shift = tuple(round(Fraction(repr(row[3])) * TO_MM, DIGITS - 3) for row in entries[:3])
    pitch = math.asin(max(-1.0, min(1.0, -entries[2][0])))
    if math.cos(pitch) > CLOSE:
        roll, yaw = math.atan2(entries[2][1], entries[2][2]), math.atan2(entries[1][0], entries[0][0])
    else:
        roll, yaw = 0.0, math.atan2(-entries[0][1], entries[1][1])
    turns = tuple(round(v / math.pi * STEP) for v in (roll, pitch, yaw))
    # an angle of exactly ±pi/2 about y is all that asin cannot tell well: it is compared as a matrix
    given = [value for row in entries[:3] for value in row[:3]]
    if any(abs(a - b) > CLOSE for a, b in zip(given, _turned(turns), strict=True)):
        angles = ", ".join(f"{v:.6g}" for v in (roll, pitch, yaw))
        raise InputError(f"{where}: angles that are multiples of pi/{STEP} expected, roll, pitch, yaw = {angles} found")
    return shift, turns


def _turned(twelfths: tuple[int, ...]) -> list[float]:
    """Rz(yaw) Ry(pitch) Rx(roll), row by row."""
    (a, b, c), (d, e, f) = ([g(k * math.pi / STEP) for k in twelfths] for g in (math.cos, math.sin))
    return [c * b, c * e * d - f * a, c * e * a + f * d, f * b, f * e * d + c * a, f * e * a - c * d, -e, b * d, b * a]


def _joint(joint: Any, where: str) -> Joint:
    motion = MOVING[joint.type]
    factor = 1 if motion is JointKind.REVOLUTE else TO_MM
    limit, limits, velocity = joint.limit, None, None
    if joint.type != "continuous":
        ends: list[Any] = [None if limit is None else getattr(limit, name) for name in ("lower", "upper")]
        if None in ends:
            raise InputError(f"{where}: limits lower and upper expected, as it is not continuous, found none")
        low, high = (_exact(float(v), where) for v in ends)
        if low >= high:
            raise InputError(f"{where}: a lower limit below the upper one expected, {low} and {high} found")
        unit, most = ("rad", MOST_RADIANS) if motion is JointKind.REVOLUTE else ("m", MOST_METRES)
        if max(-low, high) > most:
            raise InputError(f"{where}: limits in {unit} expected, {float(low):g} and {float(high):g} found")
        limits = (low * factor, high * factor)
    if limit is not None:
        velocity = _exact(float(limit.velocity), where) * factor if limit.velocity else None
        if velocity is not None and velocity < 0:
            raise InputError(f"{where}: a velocity above zero expected, {velocity} found")
    plain = re.sub(r"\W", "_", joint.name)  # a name as in TOML files
    return Joint(plain if plain.isidentifier() else f"_{plain}", motion, limits, velocity)


def _exact(value: float, where: str) -> Fraction:
    if not math.isfinite(value):
        raise InputError(f"{where}: a finite number expected, {value} found")
    return round(Fraction(repr(value)), DIGITS)

"""Arms and curves as certificates hold them."""

from __future__ import annotations

from bezier.arm.angles import Angle
from bezier.arm.model import Arm
from bezier.curves.curve import Bezier
from bezier.curves.scalar import exactly
from qe.proof.entry import Json


def arm_json(arm: Arm) -> Json:
    """The rows of an arm, exactly: angles as twelfths of pi or as [cosine, sine]."""
    rows: list[Json] = [
        {
            "a": str(row.a),
            "alpha": _angle(row.alpha),
            "d": str(row.d),
            "theta": _angle(row.theta),
            "joint": None if row.joint is None else row.joint.motion.value,
        }
        for row in arm.rows
    ]
    return {"convention": arm.convention.value, "rows": rows}


def _angle(angle: Angle) -> Json:
    return angle.twelfths if angle.twelfths is not None else [str(angle.cosine), str(angle.sine)]


def curve_json(curve: Bezier) -> Json:
    """The control points of a curve."""
    return [[str(exactly(c)) for c in point] for point in curve.points]

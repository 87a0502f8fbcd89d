"""Certificates of kind "branch" for the runs of a path, which ``qe.verify`` checks."""

from __future__ import annotations

from fractions import Fraction

from bezier.arm.angles import Angle
from bezier.arm.joint_path import JointPath, Run
from bezier.arm.model import Arm
from bezier.arm.motion_chain import Piece
from bezier.curves.curve import Bezier
from bezier.curves.scalar import exactly
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Json


def certificates(found: JointPath) -> list[tuple[str, Certificate]]:
    """A labelled certificate for every run."""
    return [
        (f"motion {run.number}" + (", the whole path" if run.covers(len(found.curves)) else ""), _of(found, run))
        for run in found.runs
    ]


def _of(found: JointPath, run: Run) -> Certificate:
    curves = list(found.curves.values())
    used = sorted({k for k, _ in run.parts})
    pieces: list[Json] = [_piece(k - used[0], p) for k, branch in run.parts for p in branch.pieces]
    listed: list[Json] = [_curve(curves[k]) for k in used]
    return Certificate(Kind("branch"), {"arm": arm_json(found.arm), "curves": listed, "pieces": pieces})


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


def _curve(curve: Bezier) -> Json:
    return [[str(exactly(c)) for c in point] for point in curve.points]


def _piece(curve: int, piece: Piece) -> Json:
    triples = {"centre": piece.centre, "slope": piece.slope, "radius": piece.radius}
    numbers: dict[str, Json] = {key: [str(Fraction(v)) for v in values] for key, values in triples.items()}
    return {"curve": curve, "low": str(piece.low), "high": str(piece.high), **numbers}

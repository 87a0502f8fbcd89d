"""Certificates of kind "branch" for the runs of a path, which ``qe.verify`` checks."""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction

from bezier.arm.arm_json import arm_json, curve_json
from bezier.arm.joint_path import JointPath, Run
from bezier.arm.limited_pieces import limited_pieces
from bezier.arm.motion_chain import Piece
from qe.errors import Unable
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Json


def certificates(found: JointPath) -> list[tuple[str, Certificate]]:
    """A labelled certificate for every run that keeps the limits of the joints; none where a joint comes closer to one
    than boxes tell."""
    listed = []
    for run in found.runs:
        label = f"motion {run.number}" + (", the whole path" if run.covers(len(found.curves)) else "")
        with suppress(Unable):
            listed += [] if run.excesses else [(label, _of(found, run))]
    return listed


def _of(found: JointPath, run: Run) -> Certificate:
    curves = list(found.curves.values())
    used = sorted({k for k, _ in run.parts})
    pieces: list[Json] = [_piece(k - used[0], p) for k, p in limited_pieces(found.arm, curves, run.parts, run.turns)]
    payload: dict[str, Json] = {
        "arm": arm_json(found.arm),
        "curves": [curve_json(curves[k]) for k in used],
        "limits": [None if j.limits is None else [str(v) for v in j.limits] for j in found.arm.joints],
        "pieces": pieces,
    }
    return Certificate(Kind("branch"), payload)


def _piece(curve: int, piece: Piece) -> Json:
    triples = {"centre": piece.centre, "slope": piece.slope, "radius": piece.radius}
    numbers: dict[str, Json] = {key: [str(Fraction(v)) for v in values] for key, values in triples.items()}
    return {"curve": curve, "low": str(piece.low), "high": str(piece.high), **numbers}

"""Certificates of kind "branch" for the runs of a path, and of all its motions, which ``qe.verify`` checks."""

from __future__ import annotations

from fractions import Fraction

from bezier.arm.arm_json import arm_json, curve_json
from bezier.arm.joint_path import JointPath, Run
from bezier.arm.motion_chain import Piece
from bezier.arm.motions_evidence import motions_certificate
from qe.errors import BudgetExceeded, Unable
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Json

ALL = "all continuous joint motions"


def certificates(found: JointPath) -> list[tuple[str, Certificate]]:
    """Labelled certificates: of every run, and of all continuous motions where their number is decided by signs."""
    runs = [
        (f"motion {run.number}" + (", the whole path" if run.covers(len(found.curves)) else ""), _of(found, run))
        for run in found.runs
    ]
    return runs + _of_all(found)


def _of_all(found: JointPath) -> list[tuple[str, Certificate]]:
    try:
        return [] if found.motions is None else [(ALL, motions_certificate(found.motions))]
    except Unable as error:
        if isinstance(error, BudgetExceeded):
            raise
        return []


def _of(found: JointPath, run: Run) -> Certificate:
    curves = list(found.curves.values())
    used = sorted({k for k, _ in run.parts})
    pieces: list[Json] = [_piece(k - used[0], p) for k, branch in run.parts for p in branch.pieces]
    listed: list[Json] = [curve_json(curves[k]) for k in used]
    return Certificate(Kind("branch"), {"arm": arm_json(found.arm), "curves": listed, "pieces": pieces})


def _piece(curve: int, piece: Piece) -> Json:
    triples = {"centre": piece.centre, "slope": piece.slope, "radius": piece.radius}
    numbers: dict[str, Json] = {key: [str(Fraction(v)) for v in values] for key, values in triples.items()}
    return {"curve": curve, "low": str(piece.low), "high": str(piece.high), **numbers}

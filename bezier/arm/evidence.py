"""Certificates of kind "branch" for the runs of a path, and of all its motions, which ``qe.verify`` checks."""

from __future__ import annotations

from fractions import Fraction
from functools import partial

from bezier.arm.arm_json import arm_json, curve_json
from bezier.arm.joint_path import JointPath, Run
from bezier.arm.limited_pieces import limited_pieces
from bezier.arm.motion_chain import Piece
from bezier.arm.motions_evidence import motions_certificate
from qe.errors import BudgetExceeded, Unable
from qe.kernel.verdict import Verdict
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Json

ALL = "all continuous joint motions"
Labelled = list[tuple[str, Certificate]]


def certificates(found: JointPath) -> Labelled:
    """Labelled certificates: of every run that keeps the limits of the joints, unless a joint comes closer to one than
    boxes tell; and of all continuous motions, limits left aside, where their number is decided by signs."""
    of_runs = ((_label(found, run), partial(_of, found, run)) for run in found.runs if not run.excesses)
    of_all = [] if found.motions is None else [(ALL, partial(motions_certificate, found.motions))]
    listed = Labelled()
    for label, made in (*of_runs, *of_all):
        try:
            listed.append((label, made()))
        except BudgetExceeded:
            raise
        except Unable:
            continue
    return listed


def without_certificate(found: JointPath, listed: Labelled) -> dict[str, str]:
    """The motions, by their numbers, that keep the limits of the joints without a certificate of that, and why."""
    labels = {label for label, _ in listed}
    runs = {run.number: run for run in found.runs if not run.excesses}
    close = "a joint comes closer to a limit than boxes tell"
    missing = {n: close for n, run in runs.items() if _label(found, run) not in labels}
    if found.arm.has_limits:
        boxless = "it goes where boxes do not: that it keeps the limits is decided, and not certified"
        missing |= dict.fromkeys(sorted(found.kept_numbers - {*runs}), boxless)
    return {str(n): why for n, why in missing.items()}


def in_words(found: JointPath, listed: Labelled, verdict: Verdict) -> list[str]:
    """What certificates there are, whether they are accepted, and what they claim and do not claim."""
    of_all = [label for label, _ in listed if label == ALL]
    limits = (", within the limits", ", limits left aside") if found.arm.has_limits else ("", "")
    told = f"{len(listed) - len(of_all) or 'none'} of motions held by boxes{limits[0]}; "
    told += f"one of the number of all motions{limits[1]}" if of_all else "none of the number of motions"
    state = "accepted" if verdict.accepted else f"REJECTED at {verdict.step}: {verdict.reason}"
    lines = [f"certificates of the joint motions: {f'{state} ({told})' if listed else 'none'}"]
    return lines + [f"  none of motion {n}: {why}" for n, why in without_certificate(found, listed).items()]


def _label(found: JointPath, run: Run) -> str:
    return f"motion {run.number}" + (", the whole path" if run.covers(len(found.curves)) else "")


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

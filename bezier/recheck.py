"""``bezier check``: verify a folder that ``bezier plan`` wrote, from the exact numbers in its files.

Beyond ``qe check`` on the certificates, this links the files: the certificates speak about this problem, the
points in ``path.json`` are the certified ones, and the path is proved again from its control points.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path as FilePath
from typing import Any

from bezier import stored
from bezier.curves.curve import Bezier
from bezier.curves.scalar import Vector, same
from bezier.methods import Claim, method_of
from bezier.motion.motion import motion_csv, motion_json, motion_of
from bezier.obstacles import survey
from bezier.optimal_path import durations
from bezier.outputs import path_csv
from bezier.path import Path, assemble
from bezier.plan import Outcome
from bezier.problem import PlanMethod, Problem, from_json
from qe.certify.verify import verify
from qe.errors import CertificateRejected, InputError
from qe.proof.certificate import Certificate, Kind
from qe.worker import Channel

TOLERANCE = 1e-9
"""Relative difference allowed between a decimal for people and the exact number beside it."""


def recheck(channel: Channel, folder: FilePath) -> list[str]:
    """Lines saying what was checked. Raises ``CertificateRejected`` naming the first entry that is wrong."""
    certificate = Certificate.from_json(stored.text(folder / "certificate.json"))
    verdict = verify(certificate)
    if not verdict.accepted:
        raise CertificateRejected(f"certificate.json: {verdict.step}", verdict.reason)
    summary = stored.table(folder / "summary.json")
    stated = stored.entry(summary, "problem", dict)
    problem = _problem(stated)
    claim = method_of(problem.method).claim(problem, certificate)
    if problem.method is PlanMethod.QUADRATIC:
        _check_region(certificate, folder)
    lines = ["certificate.json: accepted", *claim.lines]
    if claim.points is None:
        return [*lines, "no control point exists: the conditions contradict each other"]
    found = stored.table(folder / "path.json")
    if found.get("problem") != stated:
        raise CertificateRejected("problem", "path.json and summary.json state different problems")
    points = _points(found)
    _check_points(points, claim.points)
    path = assemble(_curves(found, points), points, problem.workspace, durations=durations(problem))
    _check_path(path, found, claim)
    _check_text(folder / "path.csv", path_csv(path))
    _check_summary(summary, found)
    lines += _check_clearance(path, problem, summary.get("status") == Outcome.BLOCKED.value)
    lines += _check_motion(path, problem, folder)
    joins = f"{path.smoothness.name} at every join, " if path.joins else ""
    return [*lines, f"path.json: {joins}every curve proved to lie in the workspace"]


def stored_path(found: Mapping[str, Any]) -> tuple[Problem, dict[str, Bezier]]:
    """The problem and the curves in the table of a ``path.json``."""
    return _problem(stored.entry(found, "problem", dict)), _curves(found, _points(found))


def _problem(table: Mapping[str, Any]) -> Problem:
    try:
        return from_json(table, "problem")
    except InputError as error:
        raise CertificateRejected("problem", str(error)) from None


def _points(found: Mapping[str, Any]) -> dict[str, Vector]:
    """The control points, each coordinate with its decimal compared to the exact number."""
    points = {}
    for name, listed in stored.entry(found, "points", dict).items():
        coordinates = []
        for i, entry in enumerate(listed):
            place = f"points.{name}[{i}]"
            if "in_field" in entry:
                value = stored.numbers([entry["in_field"]], stored.entry(found, "field", dict), place)[0]
                if str(value) != entry.get("exact"):
                    raise CertificateRejected(place, "exact text and coefficients differ")
            else:
                value = stored.rational(entry.get("exact"), place)
            difference = float(value) - float(stored.rational(entry.get("decimal"), place))
            if abs(difference) > TOLERANCE * max(1.0, abs(float(value))):
                raise CertificateRejected(place, "decimal and exact number differ")
            coordinates.append(value)
        points[name] = tuple(coordinates)
    return points


def _curves(found: Mapping[str, Any], points: Mapping[str, Vector]) -> dict[str, Bezier]:
    try:
        listed = stored.entry(found, "curves", dict).items()
        return {name: Bezier.of([points[p] for p in row]) for name, row in listed}
    except (KeyError, TypeError) as error:
        raise CertificateRejected("curves", f"unknown control point {error}") from None


def _check_points(points: Mapping[str, Vector], certified: Mapping[str, Vector]) -> None:
    for name, point in certified.items():
        if name not in points or not same(points[name], point):
            raise CertificateRejected(f"points.{name}", "not the point of the certificate")


def _check_path(path: Path, found: Mapping[str, Any], claim: Claim) -> None:
    if tuple(path.curves) != claim.curves:
        raise CertificateRejected("curves", f"expected the curves {', '.join(claim.curves)}")
    for proof in path.violations:
        raise CertificateRejected(f"curves.{proof.curve}", f"leaves the {proof.condition.name}")
    claimed = [entry.get("smoothness") for entry in stored.entry(found, "joins", list)]
    if claimed != [item.join.smoothness.name for item in path.joins] or path.smoothness < claim.smoothness:
        raise CertificateRejected("joins", "not as smooth as stated")


def _check_summary(summary: Mapping[str, Any], found: Mapping[str, Any]) -> None:
    """The control points of the summary are those of ``path.json``."""
    points = {
        name: [{key: entry.get(key) for key in ("exact", "decimal")} for entry in listed]
        for name, listed in found["points"].items()
    }
    if summary.get("points") != points:
        raise CertificateRejected("summary.json: points", "not the points of path.json")


def _check_text(file: FilePath, expected: str) -> None:
    """A file of numbers for machines says what follows from the exact path."""
    if stored.text(file) != expected:
        raise CertificateRejected(file.name, "not the numbers of this path")


def _check_region(certificate: Certificate, folder: FilePath) -> None:
    """``region.json`` is the region that was verified."""
    region = Certificate.from_json(stored.text(folder / "region.json"))
    if region.payload != stored.member(certificate, "region", Kind.CELLS):
        raise CertificateRejected("region.json", "not the region of certificate.json")


def _check_clearance(path: Path, problem: Problem, blocked: bool) -> list[str]:
    """The whole path is clear of every obstacle, proved again; or it meets one, as the summary says."""
    if not problem.obstacles:
        return []
    met = survey.contacts(survey.survey(path.curves, problem.obstacles, distances=False))
    if blocked and met:
        return [f"path.json: {survey.in_words(finding)}" for finding in met]
    for finding in met:
        raise CertificateRejected(f"curves.{finding.name}", survey.in_words(finding))
    return [f"path.json: every curve proved clear of every obstacle ({len(problem.obstacles)})"]


def _check_motion(path: Path, problem: Problem, folder: FilePath) -> list[str]:
    """``motion.json`` says of the motion what follows from the path and the problem."""
    if problem.timing is None:
        return []
    motion = motion_of(path, problem.timing)
    if stored.table(folder / "motion.json") != json.loads(motion_json(motion), parse_float=str):
        raise CertificateRejected("motion.json", "not the motion along this path")
    _check_text(folder / "motion.csv", motion_csv(path, motion))
    kept = [key.replace("_", " ") for key, value in motion.kept.items() if value]
    return [f"motion.json: {' and '.join(kept) or 'no limit'} proved to be kept at all times"]

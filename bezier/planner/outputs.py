"""Files: all of them or none. They are written into a folder beside the target and moved there at the end.

What an earlier run left in the target under the same names is replaced, and what it listed as its own and this run
does not write again is removed; other files stay.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

from bezier.curves.scalar import decimal_text, described, generator_of, rational, scale
from bezier.curves.sentences import dyadic_interval
from bezier.motion import motion
from bezier.paths import heights
from bezier.paths.path import Path
from bezier.planner import arm, avoid
from bezier.planner.table import method_for
from bezier.planner.words import why_not
from bezier.plans import Plan
from bezier.problem import to_json
from qe.errors import InputError

DERIVATION = re.compile(r"(compare_)?derivation_[1-9][0-9]*\.html")
"""The names of pages with derivations."""
SAMPLES = 51
"""Rows per curve in ``path.csv``."""
FIELD_BITS = 64
REPORT, SUMMARY, COMPARISON = "report.html", "summary.json", "compare.json"
PROBLEM, COMPARED = "problem.json", "compare_certificate.json"
DATA = ("certificate.json", PROBLEM, "path.json", "path.csv", "region.json", "motion.json", "motion.csv", *arm.FILES)
PICTURES = ("region.png", "path.png", "motion.png", "profile.png", "clearance.png")
LISTED_IN = {
    SUMMARY: (*DATA, REPORT, SUMMARY, *PICTURES),
    COMPARISON: ("compare.html", COMPARISON, COMPARED, "regions.png", "paths.png"),
}
"""All names that planning and comparing write, by the file in which a run lists those that it wrote."""


@contextlib.contextmanager
def all_or_none(target: FilePath) -> Iterator[FilePath]:
    """A fresh folder whose files replace those of the same names in ``target`` when the block succeeds.

    Raises ``InputError`` at once when ``target`` cannot be written, so that no work is done in vain. If the
    block fails, ``target`` is as before.
    """
    parent = next((folder for folder in target.absolute().parents if folder.exists()), target.absolute())
    if target.exists() and not target.is_dir():
        raise InputError(f"--out {target}: expected a folder, found a file")
    if not parent.is_dir() or not os.access(parent, os.W_OK | os.X_OK):
        raise InputError(f"--out {target}: expected a writable folder, found that {parent} is not writable")
    if target.is_dir() and not os.access(target, os.W_OK | os.X_OK):
        raise InputError(f"--out {target}: expected a writable folder, found one that is not")
    try:
        fresh = FilePath(tempfile.mkdtemp(prefix=f".{target.name}-", dir=parent))
    except OSError as error:
        raise InputError(f"--out {target}: expected a writable folder, found: {error.strerror}") from None
    try:
        yield fresh
        _move(fresh, target)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)


def _move(fresh: FilePath, target: FilePath) -> None:
    try:
        os.chmod(fresh, 0o755)
        if not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            os.replace(fresh, target)
            return
        stale = _stale(fresh, target)
        for file in sorted(fresh.iterdir()):
            os.replace(file, target / file.name)
        for name in stale:
            (target / name).unlink(missing_ok=True)
    except OSError as error:
        raise InputError(f"--out {target}: expected a writable folder, found: {error.strerror}") from None


def _stale(fresh: FilePath, target: FilePath) -> list[str]:
    """The files in ``target`` that an earlier run of the same command wrote, says so, and this one does not replace."""
    result = []
    for listing, names in LISTED_IN.items():
        if (fresh / listing).is_file():
            listed = _listed(target / listing)
            ours = {*names, *(name for name in listed if DERIVATION.fullmatch(name))}
            result += [name for name in sorted(ours & listed) if not (fresh / name).exists()]
    return result


def _listed(listing: FilePath) -> set[str]:
    """The names of the files that an earlier run says it wrote; none when it cannot be read."""
    try:
        files = json.loads(listing.read_bytes())["files"]
        return {FilePath(file).name for file in files}
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return set()


def summary(plan: Plan, files: list[str], seconds: float) -> dict[str, Any]:
    """The object that ``bezier plan --json`` prints: ``facts``, the files, and the time of each step."""
    times = {**{name: round(s, 6) for name, s in plan.seconds.items()}, "total": round(seconds, 6)}
    return {**facts(plan), "files": files, "seconds": times}


def facts(plan: Plan) -> dict[str, Any]:
    """What the summary says: all that ``bezier check`` finds again, but for what ``not_certified`` names."""
    problem, method = plan.problem, method_for(plan.problem)
    data: dict[str, Any] = {
        "status": plan.outcome.value,
        "method": problem.method.value,
        "workspace": problem.workspace.kind.value,
        "radius": {
            "exact": problem.workspace.radius_text,
            "decimal": f"{float(problem.workspace.radius_squared) ** 0.5:.12g}",
        },
        "objective": None if plan.objective is None else described(plan.objective),
        "points": {name: [described(c) for c in p] for name, p in plan.path.points.items()} if plan.path else {},
        "active": list(plan.active),
        "certified": plan.certified,
        **method.json_entries(plan),
        **motion.json_entries(plan.quality),
        **avoid.json_entries(plan),
        **arm.json_entries(plan),
        **({} if plan.radius_rule is None else {"radius_rule": plan.radius_rule.to_json()}),
        **({} if plan.heights is None else {"heights": heights.to_json(plan.heights)}),
        "problem": to_json(problem),
        "notes": [*problem.notes, *plan.remarks],
        "not_certified": list(plan.not_certified),
    }
    if plan.derivations:
        data["derivations"] = {name: list(item.rules) for name, item in plan.derivations.items()}
    if plan.bound is not None:
        data["bound"] = described(plan.bound)
    if not plan.outcome.is_success and not data.get("reason"):
        data["reason"] = why_not(plan)
    return data


def path_json(plan: Plan, path: Path) -> dict[str, Any]:
    """``path.json``: the problem and the exact control points, enough to check the path again.

    A coordinate is ``{"exact", "decimal"}``; an irrational one also has ``in_field``, its coefficients of
    1, theta, theta^2, ... for the theta described under ``field``.
    """
    theta = generator_of(c for point in path.points.values() for c in point)
    return {
        "format": "bezier-qe path",
        "version": 1,
        "unit": "mm",
        "problem": to_json(plan.problem),
        "field": None if theta is None else field_json(theta, FIELD_BITS),
        "points": {name: [_coordinate(c) for c in point] for name, point in path.points.items()},
        "curves": {
            name: [next(k for k, other in path.points.items() if other == p) for p in curve.points]
            for name, curve in path.curves.items()
        },
        "joins": [
            {
                "between": [item.first, item.second],
                "smoothness": item.join.smoothness.name,
                "same_direction": item.join.same_direction,
            }
            for item in path.joins
        ],
    }


def path_text(plan: Plan, path: Path) -> str:
    """The text of ``path.json``."""
    return json.dumps(path_json(plan, path), indent=1, ensure_ascii=False) + "\n"


def _coordinate(value: Any) -> dict[str, Any]:
    data: dict[str, Any] = described(value)
    if rational(value) is None and hasattr(value, "coefficients"):
        data["in_field"] = [str(c) for c in value.coefficients]
    return data


HEADER = """\
# Path of the end effector: three curves one after the other, positions in mm.
# t: time, the middle curve taking one unit; u: parameter of the curve, 0 to 1; segment: the curve;
# x, y, z: position in mm; vx, vy, vz: velocity, the derivative with respect to t, in mm per unit of time.
t,x,y,z,vx,vy,vz,segment,u
"""


def path_csv(path: Path) -> str:
    """``path.csv``: positions and velocities at equally spaced parameters, computed exactly and then rounded."""
    rows, begin = [HEADER], Fraction(0)
    for name, curve in path.curves.items():
        slope, duration = curve.hodograph(), path.duration(name)
        for k in range(SAMPLES):
            u = Fraction(k, SAMPLES - 1)
            values = [begin + duration * u, *curve.point(u), *scale(1 / duration, slope.point(u))]
            numbers = ",".join(decimal_text(v, 10) for v in values)
            rows.append(f"{numbers},{name},{decimal_text(u, 10)}\n")
        begin += duration
    return "".join(rows)


def data_texts(plan: Plan) -> dict[str, str]:
    """The files that carry exact data, by name."""
    problem = json.dumps(to_json(plan.problem), indent=1, ensure_ascii=False) + "\n"
    texts = {"certificate.json": plan.certificate.to_json(), PROBLEM: problem, **plan.files}
    if plan.path is not None:
        texts["path.json"] = path_text(plan, plan.path)
        texts["path.csv"] = path_csv(plan.path)
    return {**texts, **motion.files(plan.path, plan.quality), **arm.files(plan)}


def write_texts(folder: FilePath, texts: Mapping[str, str]) -> list[str]:
    """Files by their names, which it returns."""
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return list(texts)


def field_json(theta: Any, bits: int) -> dict[str, Any]:
    """An irrational theta by its minimal polynomial and an isolating interval of at least ``bits`` good bits.

    The interval depends on theta alone, not on what was computed with it before: its ends are neighbouring multiples
    of a power of 1/2. So whoever reads theta from a file and writes it again writes the same text.
    """
    # narrow enough for a checker to see at once that there is one root, and a simple one
    height = max(abs(c) for c in theta.minimal_polynomial).bit_length()
    low, high = dyadic_interval(theta, max(bits, 64 + height))
    return {"minimal_polynomial": [str(c) for c in theta.minimal_polynomial], "interval": [str(low), str(high)]}

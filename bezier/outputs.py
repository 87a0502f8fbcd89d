"""Files: all of them or none. They are written into a folder beside the target and moved there at the end."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import tempfile
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

from bezier.path import Path
from bezier.plan import Outcome, Plan
from bezier.problem import Problem
from bezier.scalar import decimal_text, described, rational
from qe.errors import InputError

SAMPLES = 51
"""Rows per curve in ``path.csv``."""


@contextlib.contextmanager
def all_or_none(target: FilePath) -> Iterator[FilePath]:
    """A fresh folder whose files replace those of the same names in ``target`` when the block succeeds.

    Raises ``InputError`` at once when ``target`` cannot be written, so that no work is done in vain. If the
    block fails, ``target`` is as before.
    """
    parent = _existing_parent(target)
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


def _existing_parent(target: FilePath) -> FilePath:
    parent = target.absolute().parent
    while not parent.exists() and parent != parent.parent:
        parent = parent.parent
    return parent


def _move(fresh: FilePath, target: FilePath) -> None:
    try:
        os.chmod(fresh, 0o755)
        if not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            os.replace(fresh, target)
            return
        for file in sorted(fresh.iterdir()):
            os.replace(file, target / file.name)
    except OSError as error:
        raise InputError(f"--out {target}: expected a writable folder, found: {error.strerror}") from None


def summary(plan: Plan, files: list[str], seconds: float) -> dict[str, Any]:
    """The object that ``bezier plan --json`` prints."""
    found: dict[str, Any] = {
        "status": plan.outcome.value,
        "method": plan.problem.method.value,
        "workspace": plan.problem.workspace.kind.value,
        "radius": {
            "exact": plan.problem.workspace.radius_text,
            "decimal": f"{float(plan.problem.workspace.radius_squared) ** 0.5:.12g}",
        },
        "objective": described(plan.optimum.value) if plan.optimum else None,
        "points": {name: [described(c) for c in p] for name, p in plan.path.points.items()} if plan.path else {},
        "active": list(plan.active),
        "certified": plan.certified,
        "leaves_hemisphere": {"allowed": plan.gap.can_leave, "chosen": bool(_dips(plan))},
        "problem": problem_json(plan.problem),
        "notes": list(plan.problem.notes),
        "files": files,
        "seconds": {**{name: round(s, 6) for name, s in plan.seconds.items()}, "total": round(seconds, 6)},
    }
    if plan.outcome is Outcome.INFEASIBLE:
        found["reason"] = reason(plan)
        found["suggestion"] = 'method = "cubic"'
    return found


def _dips(plan: Plan) -> list[str]:
    from bezier.containment import Leaves

    return [proof.curve for proof in plan.gap.chosen if isinstance(proof.outcome, Leaves)]


def reason(plan: Plan) -> str:
    """Why there is no control point, in one sentence with the numbers."""
    balls = plan.balls
    radius = plan.problem.workspace.radius_text
    if balls.meet:
        return (
            "no control point exists: the three balls meet, but nowhere do all control points also have z >= 0"
            " (the certificate shows it)"
        )
    shape = "acute" if balls.is_acute else "right or obtuse or flat"
    return (
        f"no control point exists: the balls of radius r = {_sized(radius, balls.radius_squared)} about O, 2 Q0 and"
        f" 2 R0 have no common point; the triangle O, Q0, R0 is {shape}, so r would have to be at least"
        f" {_sized(balls.needed_text, balls.needed_squared)}"
    )


def _sized(exact: str, square: Fraction) -> str:
    """An exact root with its decimal; the decimal alone when the exact text would fill the line."""
    decimal = f"{float(square) ** 0.5:.6g}"
    if len(exact) > 40:
        return f"about {decimal}"
    return exact if exact == decimal else f"{exact} (about {decimal})"


def path_json(plan: Plan, path: Path) -> dict[str, Any]:
    """``path.json``: the problem and the exact control points, enough to check the path again.

    A coordinate is ``{"exact", "decimal"}``; an irrational one also has ``in_field``, its coefficients of
    1, theta, theta^2, ... for the theta described under ``field``.
    """
    return {
        "format": "bezier-qe path",
        "version": 1,
        "unit": "mm",
        "problem": problem_json(plan.problem),
        "field": _field(path),
        "points": {name: [_coordinate(c) for c in point] for name, point in path.points.items()},
        "curves": {name: [_name(path, p) for p in curve.points] for name, curve in path.curves.items()},
        "joins": [
            {
                "between": [item.first, item.second],
                "smoothness": item.join.smoothness.name,
                "same_direction": item.join.same_direction,
            }
            for item in path.joins
        ],
    }


def _name(path: Path, point: Any) -> str:
    return next(name for name, other in path.points.items() if other == point)


def problem_json(problem: Problem) -> dict[str, Any]:
    """The problem in exact numbers."""
    return {
        "method": problem.method.value,
        "workspace": problem.workspace.kind.value,
        "radius_squared": str(problem.workspace.radius_squared),
        "start": [str(c) for c in problem.start],
        "via": [[str(c) for c in p] for p in problem.via],
        "goal": [str(c) for c in problem.goal],
    }


def _coordinate(value: Any) -> dict[str, Any]:
    found: dict[str, Any] = described(value)
    if rational(value) is None and hasattr(value, "coefficients"):
        found["in_field"] = [str(c) for c in value.coefficients]
    return found


def _field(path: Path) -> dict[str, Any] | None:
    for point in path.points.values():
        for value in point:
            if rational(value) is None and hasattr(value, "field"):
                low, high = value.field.theta.interval(64)
                return {
                    "minimal_polynomial": [str(c) for c in value.field.minimal_polynomial],
                    "interval": [str(low), str(high)],
                }
    return None


HEADER = """\
# Path of the end effector: three curves one after the other, positions in mm.
# t: time with one unit per curve; u: parameter of the curve, 0 to 1; segment: the curve;
# x, y, z: position in mm; vx, vy, vz: derivative with respect to u, in mm per unit of u.
t,x,y,z,vx,vy,vz,segment,u
"""


def path_csv(path: Path) -> str:
    """``path.csv``: positions and velocities at equally spaced parameters, computed exactly and then rounded."""
    rows = [HEADER]
    for index, (name, curve) in enumerate(path.curves.items()):
        slope = curve.hodograph()
        for k in range(SAMPLES):
            u = Fraction(k, SAMPLES - 1)
            values = [index + u, *curve.point(u), *slope.point(u)]
            numbers = ",".join(decimal_text(v, 10) for v in values)
            rows.append(f"{numbers},{name},{decimal_text(u, 10)}\n")
    return "".join(rows)


def write_data(plan: Plan, folder: FilePath) -> list[str]:
    """The files that carry exact data; returns their names."""
    texts = {"region.json": plan.region.to_json(), "certificate.json": plan.certificate.to_json()}
    if plan.path is not None:
        texts["path.json"] = json.dumps(path_json(plan, plan.path), indent=1, ensure_ascii=False) + "\n"
        texts["path.csv"] = path_csv(plan.path)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return list(texts)

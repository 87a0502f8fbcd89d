"""``bezier clearance``: curves from a folder, a problem or a file of curves, each examined against each obstacle."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

import qe
from bezier.check.stated import stored_path
from bezier.curves.curve import Bezier
from bezier.input import stored
from bezier.input.files import read_text
from bezier.input.numbers import describe
from bezier.input.toml_table import Table
from bezier.obstacles import survey
from bezier.obstacles.obstacle import Obstacle
from bezier.obstacles.reader import read_obstacles
from bezier.obstacles.survey import Finding
from bezier.planner import derivations
from bezier.planner.table import method_of
from bezier.plans import Clock, Plan
from bezier.problem import problem_of
from qe.errors import InputError, Unable
from qe.processes.channel import Channel

MAX_CONTROL_POINTS = 31
Curves = Mapping[str, Bezier]


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """``source``: a folder of ``bezier plan``, a problem, or a file with ``[[curve]]`` and ``[[obstacle]]`` tables.

    ``obstacles``: a file whose obstacles are taken instead. ``certificate``: where to write the certificates.
    """

    source: FilePath
    obstacles: FilePath | None = None
    certificate: FilePath | None = None
    json: bool = False
    timeout: float | None = None


def clearance(channel: Channel, request: Request) -> str:
    """What to print. Raises ``InputError`` for bad input, ``Unable`` when a problem has no path to examine."""
    clock = Clock(limit=request.timeout, listener=channel.event, note=channel.fact)
    curves, obstacles, answers = _read(request.source, clock)
    if request.obstacles is not None:
        obstacles = read_obstacles(Table.parse(read_text(request.obstacles), str(request.obstacles)))
    if not obstacles:
        raise InputError(f"{request.obstacles or request.source}: expected [[obstacle]] tables, found none")
    with clock.step("clearance"):
        findings = survey.survey(curves, obstacles)
    with clock.step("certificates"):
        members = survey.certificates(findings)
        if request.certificate is not None:
            derived, _ = derivations.proved({**answers, **derivations.of_obstacles(obstacles)}, clock)
            members += derivations.members(derived)
        certificate = qe.Certificate.bundle(members)
        verdict = qe.verify(certificate) if members else None
    if request.certificate is not None:
        _write(request.certificate, certificate.to_json())
    return _as_json(findings, verdict) if request.json else _in_words(findings, verdict)


def _write(path: FilePath, text: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InputError(f"--certificate {path}: expected a writable file, found: {error.strerror}") from None


def _read(source: FilePath, clock: Clock) -> tuple[Curves, Sequence[Obstacle], Mapping[str, Any]]:
    """The curves, the obstacles, and the engine's answers that the curves rest on."""
    if source.is_dir():
        problem, curves = stored_path(stored.table(source / "path.json"))
        return curves, problem.obstacles, {}
    table = Table.parse(read_text(source), str(source))
    if "curve" in table.values:
        table.only(("curve", "obstacle"))
        return _curves(table), read_obstacles(table), {}
    problem = problem_of(table)
    plan: Plan = method_of(problem.method).make(problem, clock)
    if plan.path is None:
        raise Unable(f"{source}: no path to examine: {method_of(problem.method).reason(plan)}")
    return plan.path.curves, problem.obstacles, plan.eliminations


def _curves(table: Table) -> dict[str, Bezier]:
    """``[[curve]]``: points, and optionally name."""
    found: dict[str, Bezier] = {}
    for i, entry in enumerate(table.tables("curve")):
        entry.only(("name", "points"))
        name = entry.values.get("name", f"curve {i + 1}")
        if not isinstance(name, str) or name in found:
            raise entry.error("name", "a name of its own for each curve", describe(name))
        raw = entry.required("points", "control points")
        if not isinstance(raw, list) or not 1 <= len(raw) <= MAX_CONTROL_POINTS:
            raise entry.error("points", f"1 to {MAX_CONTROL_POINTS} control points", describe(raw))
        found[name] = Bezier.of([entry.as_point(f"points[{k}]", p) for k, p in enumerate(raw)])
    return found


def _as_json(findings: Sequence[Finding], verdict: qe.Verdict | None) -> str:
    told: dict[str, Any] = {
        "status": "solved",
        "clear": not survey.contacts(findings),
        "findings": [survey.to_json(finding) for finding in findings],
        "certificates": "none" if verdict is None else "accepted" if verdict.accepted else "rejected",
    }
    return json.dumps(told, indent=1, ensure_ascii=False)


def _in_words(findings: Sequence[Finding], verdict: qe.Verdict | None) -> str:
    met = survey.contacts(findings)
    last = f"{len(met)} of {len(findings)} pairs meet" if met else f"all {len(findings)} pairs are clear"
    accepted = "none" if verdict is None else "accepted" if verdict.accepted else "REJECTED"
    return "\n".join([*map(survey.in_words, findings), f"{last}; certificates: {accepted}"])

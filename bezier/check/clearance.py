"""``bezier clearance``: curves from a folder, a problem or a file of curves, each examined against each obstacle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path as FilePath
from typing import Any

import qe
from bezier.arm.reader import curves_of
from bezier.check.agreement import stored_path
from bezier.curves.curve import Bezier
from bezier.input import stored
from bezier.input.toml_table import Table
from bezier.obstacles import survey
from bezier.obstacles.obstacle import Obstacle
from bezier.obstacles.reader import read_obstacles
from bezier.planner import derivations
from bezier.planner.table import method_of
from bezier.plans import Clock, Plan, make
from bezier.problem import problem_of
from qe.errors import InputError, Unable
from qe.processes.channel import Channel

Curves = Mapping[str, Bezier]


def clearance(
    channel: Channel,
    source: FilePath,
    other: FilePath | None = None,
    *,
    evidence: bool = False,
    timeout: float | None = None,
) -> tuple[dict[str, Any], list[str], str]:
    """What to print, as data and as lines, and the certificates where ``evidence`` is wanted. Raises ``InputError`` for
    bad input, ``Unable`` when a problem has no path to examine.

    ``source``: a folder of ``bezier plan``, a problem, or a file with ``[[curve]]`` and ``[[obstacle]]`` tables;
    ``other``: a file whose obstacles are taken instead.
    """
    clock = Clock(limit=timeout, listener=channel.event, note=channel.fact)
    curves, obstacles, answers = _read(source, clock)
    if other is not None:
        obstacles = read_obstacles(Table.load(other))
    if not obstacles:
        raise InputError(f"{other or source}: expected [[obstacle]] tables, found none")
    with clock.step("clearance"):
        findings = survey.survey(curves, obstacles)
    with clock.step("certificates"):
        members = survey.certificates(findings)
        if evidence:
            derived, _ = derivations.proved({**answers, **derivations.of_obstacles(obstacles)}, clock)
            members += derivations.members(derived)
        certificate = qe.Certificate.bundle(members)
        verdict = qe.verify(certificate) if members else None
    met = survey.contacts(findings)
    state = "none" if verdict is None else "accepted" if verdict.accepted else "rejected"
    data: dict[str, Any] = {"status": "solved", "clear": not met}
    data |= {"findings": [survey.to_json(finding) for finding in findings], "certificates": state}
    last = f"{len(met)} of {len(findings)} pairs meet" if met else f"all {len(findings)} pairs are clear"
    said = f"{last}; certificates: {state.replace('rejected', 'REJECTED')}"
    return data, [*map(survey.in_words, findings), said], certificate.to_json() if evidence else ""


def _read(source: FilePath, clock: Clock) -> tuple[Curves, Sequence[Obstacle], Mapping[str, Any]]:
    """The curves, the obstacles, and the engine's answers that the curves rest on."""
    if source.is_dir():
        problem, curves = stored_path(stored.table(source / "path.json"))
        return curves, problem.obstacles, {}
    table = Table.load(source)
    if "curve" in table.values:
        table.only(("curve", "obstacle"))
        return curves_of(table, least=1), read_obstacles(table), {}
    problem = problem_of(table)
    plan: Plan = make(method_of(problem.method), problem, clock)
    if plan.path is None:
        raise Unable(f"{source}: no path to examine: {method_of(problem.method).reason(plan)}")
    return plan.path.curves, problem.obstacles, plan.eliminations

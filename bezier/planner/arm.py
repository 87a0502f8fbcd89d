"""The arm of a planning problem: whether and how it follows the path that was found, and the files about that.

Control points of a planned path may be irrational. The joints are planned for the same curves with control points
rounded to multiples of ``GRAIN``; a Bézier curve moves by no more than its control points do: by at most ``AWAY`` mm.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from math import ceil, hypot
from pathlib import Path
from typing import Any

from bezier.arm import evidence
from bezier.arm import joint_plan as plans
from bezier.arm.evidence import Labelled, certificates, without_certificate
from bezier.arm.inverse import solve
from bezier.arm.joint_plan import JointPlan, joint_plan
from bezier.arm.model import Arm
from bezier.arm.reachable import reachable_set
from bezier.arm.reader import load_arm, shipped
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import bounds
from bezier.curves.scalar import rational
from bezier.curves.workspace import WorkspaceKind
from bezier.motion.timelaw import Law, TimeLaw
from bezier.plans import Outcome, Plan
from bezier.problem import Problem
from qe.certify.verify import verify
from qe.errors import BudgetExceeded, CertificateRejected, InputError, Unable
from qe.kernel.verdict import Verdict
from qe.processes.channel import Channel
from qe.proof.certificate import Certificate

GRAIN = Fraction(1, 1 << 34)
AWAY = "1e-10"
SAMPLES = 200
USUAL_DURATION = Fraction(50)
"""Seconds, where the problem does not say: that of arXiv 2305.12451."""
FILES, PAGE = ("joints.csv", "joints.json", "joints_certificate.json"), "joints.html"


def check_arm(problem: Problem) -> Problem:
    """The problem, in the ball that holds what the arm reaches where that is the workspace and no radius is given.

    Raises ``InputError`` for an arm that is not known, and for points that it does not reach: before any work is done.
    """
    if problem.arm is None:
        return problem
    if problem.arm.endswith(".toml"):
        raise InputError(f"{problem.source}: arm: expected one of {', '.join(shipped())}, found a file")
    try:
        arm = load_arm(problem.arm)
        return _within_reach(problem, arm) if problem.workspace.kind is WorkspaceKind.REACHABLE else problem
    except (InputError, Unable) as error:
        raise InputError(f"{problem.source}: {error}") from None


def _within_reach(problem: Problem, arm: Arm) -> Problem:
    points = {"start": problem.start, "via[0]": problem.via[0], "via[1]": problem.via[1], "goal": problem.goal}
    for name, point in points.items():
        if not solve(arm, point).allowed_count:
            text = ", ".join(map(str, point))
            raise InputError(f"{name}: a point that {arm.name} reaches expected, found ({text})")
    if not problem.radius_is_auto:
        return problem
    a, c, radius = reachable_set(arm).numbers
    outer = Fraction(ceil(hypot(a, c) + radius))
    return replace(problem, workspace=replace(problem.workspace, radius_squared=outer**2), radius_is_auto=False)


def with_joints(plan: Plan) -> Plan:
    """The plan with that of the joints, if the problem names an arm."""
    if plan.problem.arm is None or plan.path is None:
        return plan
    curves = {name: rounded(curve) for name, curve in plan.path.curves.items()}
    parts = {name: plan.path.duration(name) for name in curves}
    motion = None if plan.quality is None else plan.quality.motion
    law = TimeLaw.of(Law.QUINTIC) if motion is None else motion.law
    duration = USUAL_DURATION if motion is None else motion.duration
    try:
        result = joint_plan(load_arm(plan.problem.arm), curves, law, duration, SAMPLES, parts=parts)
    except Unable as error:
        if isinstance(error, BudgetExceeded):
            raise
        return replace(plan, remarks=(*plan.remarks, f"the joints are not planned: {error}"))
    outcome = plan.outcome
    if outcome.is_success and not result.is_followed:
        outcome = Outcome.OUT_OF_REACH
    elif outcome.is_success and result.motion is not None and not result.motion.keeps_limits:
        outcome = Outcome.TOO_FAST
    return replace(plan, joints=result, outcome=outcome)


def rounded(curve: Bezier) -> Bezier:
    """The curve with irrational control points rounded to multiples of ``GRAIN``."""

    def near(value: Any) -> Fraction:
        number = rational(value)
        return number if number is not None else round(sum(bounds(value), Fraction(0)) / 2 / GRAIN) * GRAIN

    return Bezier(tuple(tuple(map(near, point)) for point in curve.points))


def is_rounded(plan: Plan) -> bool:
    """Whether the joints are planned for a rounded path."""
    return plan.path is not None and any(rational(c) is None for p in plan.path.points.values() for c in p)


def files(plan: Plan) -> dict[str, str]:
    """The files about the joints, by name. Raises ``CertificateRejected`` where a certificate is not accepted."""
    return {} if plan.joints is None else dict(_texts(plan.joints, is_rounded(plan)))


@lru_cache(maxsize=2)
def _texts(plan: JointPlan, is_rounded: bool) -> tuple[tuple[str, str], ...]:
    texts, _, listed, verdict = _written(plan, lambda accepted: {"rounded": is_rounded})
    if listed and not verdict.accepted:
        raise CertificateRejected(f"{FILES[2]}: {verdict.step}", verdict.reason)
    return tuple(texts.items())


def _written(
    plan: JointPlan, more: Callable[[bool], Mapping[str, Any]]
) -> tuple[dict[str, str], dict[str, Any], Labelled, Verdict]:
    """The files about joints by name, what ``joints.json`` says, the certificates, and whether they are accepted."""
    table, summary, certificate = FILES
    listed = certificates(plan.path)
    bundle = Certificate.bundle(listed)
    verdict = verify(bundle)
    data = {**plans.to_json(plan), **more(verdict.accepted)}
    data["without_certificate"] = without_certificate(plan.path, listed)
    texts = {summary: json.dumps(data, indent=1, ensure_ascii=False) + "\n", certificate: bundle.to_json()}
    if plan.sequence is not None:
        texts[table] = plans.to_csv(plan)
    return texts, data, listed, verdict


def json_entries(plan: Plan) -> dict[str, Any]:
    """What the summary says of the joints."""
    if plan.joints is None:
        return {}
    result = plan.joints
    return {
        "joints": {
            "arm": result.path.arm.name,
            "reachable": result.path.is_reachable,
            "continuous_motions": result.path.allowed_count,
            "run": None if result.sequence is None else result.sequence.run,
            "limits": {} if result.motion is None else result.motion.kept,
            "rounded": is_rounded(plan),
        }
    }


def summary_lines(plan: Plan) -> list[str]:
    """The same for people."""
    if plan.joints is None:
        return []
    lines = [f"arm: {line}" for line in plans.in_words(plan.joints)]
    if is_rounded(plan):
        lines.append(f"arm: the joints follow the path with control points rounded: within {AWAY} mm of it")
    return lines


# --- bezier joints --------------------------------------------------------------------------------------------------


def joints(
    channel: Channel,
    arm: Arm,
    curves: Mapping[str, Bezier],
    *,
    law: TimeLaw,
    duration: Fraction,
    samples: int,
    file: str,
    folder: Path,
    target: Path,
) -> tuple[dict[str, Any], list[str], bool]:
    """Plan the joints along the curves of ``file``, write the files into ``folder``, whose place will be ``target``;
    what to print, as data and as lines, and whether the arm follows."""
    plan = plans.joint_plan(arm, curves, law, duration, samples)
    texts, data, listed, verdict = _written(plan, lambda accepted: {"certified": accepted})
    for name, text in {**texts, PAGE: render(plan, file)}.items():
        (folder / name).write_text(text, encoding="utf-8")
    lines = [*plans.in_words(plan), *evidence.in_words(plan.path, listed, verdict)]
    return data, [*lines, f"open {target / PAGE}"], plan.is_followed


def render(plan: JointPlan, file: str) -> str:
    """The page of ``bezier joints``: one file that needs nothing from elsewhere."""
    from bezier.report.html import document
    from bezier.report.joints import page

    return document(page(plan, file))

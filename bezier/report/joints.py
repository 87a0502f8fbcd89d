"""The joints of an arm on a page: what is proved about their motion, and the page of ``bezier joints``."""

from __future__ import annotations

from typing import Any

from bezier.arm import joint_plan as plans
from bezier.arm.joint_plan import JointPlan
from bezier.arm.model import JointKind
from bezier.arm.motion import JointMotion
from bezier.arm.path_report import excesses_in_words, number_in_words
from bezier.report import html
from bezier.report.first import scene_box
from bezier.report.html import Card, Page, Section, Text, toned

WORDS = {True: "kept", False: "EXCEEDED", None: "not proved"}


def moving(plan: JointPlan | None) -> dict[str, Any] | None:
    """The arm's frames for a scene; None where nothing moves."""
    return None if plan is None or plan.sequence is None else plans.animation(plan)


def section(plan: JointPlan) -> Section:
    """What is proved about the joints."""
    path = plan.path
    rows = [
        (name, f"{float(p.low):.9g}", f"{float(p.high):.9g}", str(p.count))
        for name, studied in zip(path.curves, path.studies, strict=True)
        for p in studied.stretches
    ]
    special = [
        f"{name}, s = {float(p.s):.12g}: {' and '.join(r.value for r in p.reasons)}."
        for name, studied in zip(path.curves, path.studies, strict=True)
        for p in studied.specials
        if p.reasons
    ]
    head = ("curve", "from s", "to s", "solutions for every s between")
    content: list[Text] = [html.table(head, rows, numbers=(1, 2)), *map(html.paragraph, special)]
    if plan.motion is not None:
        head = ("joint", "velocity at all times", "acceleration at all times", "limits")
        content.append(html.table(head, _extremes(plan.motion)))
        content.append(html.note("Proved over the whole path by interval enclosures of the joint velocities."))
    motions = f"{number_in_words(path)} from start to goal"
    if plan.sequence is not None and plan.sequence.run:
        motions += f"; motion {plan.sequence.run} has the least total change"
    content += [html.note(f"{line}.") for line in (motions, *excesses_in_words(path), *plan.remarks)]
    return Section("joints", f"The joints of {path.arm.name}", html.joined(*content), short="joints")


def page(plan: JointPlan, file: str) -> Page:
    """The page of ``bezier joints``."""
    verdict = "every point is reached, proved" if plan.path.is_reachable else "the path leaves what the arm can reach"
    if plan.path.is_reachable and plan.sequence is None:
        verdict += "; there is no joint sequence"
    arm, first = moving(plan), None
    if arm is not None:
        from bezier.pictures import scene

        words = f"{plan.path.arm.name} following the path"
        legend = [("the path", "var(--r)"), ("the arm", "var(--ink)")]
        first = scene_box(scene.text(scene.arm_scene(arm)), words, "", legend, moving=True)
    return Page(
        title=plan.path.arm.name,
        lead=f"{file}: {verdict}",
        first=first,
        cards=_cards(plan),
        sections=[section(plan)],
        footer=f"Made by bezier-qe {html.package_version()}.",
    )


def _cards(plan: JointPlan) -> list[Card]:
    reached = plan.path.is_reachable
    words = ("reached", "proved for all s in [0, 1]") if reached else ("not reached", "see below where it stops")
    result = [Card("path", words[0], html.tone(reached), words[1])]
    result.append(Card("duration asked for", f"{float(plan.duration):.6g} s"))
    if plan.sequence is None:
        result.append(Card("joint sequence", "none", "bad", "see below why"))
    else:
        count = len(plan.sequence.samples)
        result.append(Card("joint sequence", f"{count} positions", note=f"{len(plan.path.arm.joints)} joints"))
    if plan.motion is not None and plan.motion.kept:
        kept = plan.motion.keeps_limits
        said = "kept, proved" if kept else "not proved to be kept"
        result.append(Card("limits of the joints", said, html.tone(kept)))
    return result


def _extremes(motion: JointMotion) -> list[tuple[Text, ...]]:
    rows: list[tuple[Text, ...]] = []
    for joint, v, a in zip(motion.joints, motion.speeds, motion.accelerations, strict=True):
        keys = (f"{joint.name} velocity", f"{joint.name} acceleration")
        kept = [motion.kept[key] for key in keys if key in motion.kept]
        worst = next((k for k in (False, None) if k in kept), True)
        said = toned(WORDS[worst], worst is True) if kept else "none given"
        unit = "rad" if joint.motion is JointKind.REVOLUTE else "mm"
        tops = (float(bound.finite[1]) * (1 + 1e-5) for bound in (v, a))
        bounds = (f"at most {top:.5g} {unit}/{per}" for top, per in zip(tops, ("s", "s²"), strict=True))
        rows.append((joint.name, *bounds, said))
    return rows

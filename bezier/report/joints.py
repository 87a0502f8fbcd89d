"""The joints of an arm on a page: the moving picture, and what is proved about their motion."""

from __future__ import annotations

from typing import Any

from markupsafe import Markup

from bezier.arm import joint_plan as plans
from bezier.arm.joint_plan import JointPlan
from bezier.arm.motion import JointMotion

WORDS = {True: "kept", False: "EXCEEDED", None: "not proved"}


def sections(plan: JointPlan | None) -> dict[str, Any]:
    """What the templates about the joints show; ``arm_data`` is empty where nothing moves."""
    if plan is None:
        return {"arm_data": "", "joints": None}
    data = plans.animation(plan).replace("</", "<\\/") if plan.sequence is not None else ""
    path = plan.path
    intervals = [
        {"curve": name, "low": f"{float(p.low):.9g}", "high": f"{float(p.high):.9g}", "count": p.count}
        for name, studied in zip(path.curves, path.studies, strict=True)
        for p in studied.stretches
    ]
    special = [
        f"{name}, s = {float(p.s):.12g}: {' and '.join(r.value for r in p.reasons)}"
        for name, studied in zip(path.curves, path.studies, strict=True)
        for p in studied.specials
        if p.reasons
    ]
    facts = {
        "arm": path.arm.name,
        "intervals": intervals,
        "special": special,
        "extremes": [] if plan.motion is None else _extremes(plan.motion),
        "notes": [_motions(plan), *plan.remarks],
    }
    return {"arm_data": Markup(data), "joints": facts}


def _motions(plan: JointPlan) -> str:
    count, run = len(plan.path.whole_runs), plan.sequence.run if plan.sequence is not None else None
    told = f"{count} continuous joint motions lead from start to goal"
    return told + (f"; motion {run} has the least total change" if run else "")


def _extremes(motion: JointMotion) -> list[dict[str, str]]:
    rows = []
    for joint, v, a in zip(motion.joints, motion.speeds, motion.accelerations, strict=True):
        kept = [
            motion.kept[key] for key in (f"{joint.name} velocity", f"{joint.name} acceleration") if key in motion.kept
        ]
        worst = next((k for k in (False, None) if k in kept), True)
        rows.append(
            {
                "name": joint.name,
                "velocity": f"{float(v.high) * (1 + 1e-5):.5g}",
                "acceleration": f"{float(a.high) * (1 + 1e-5):.5g}",
                "limits": WORDS[worst] if kept else "none given",
                "tone": "bad" if worst is not True else "good" if kept else "",
            }
        )
    return rows

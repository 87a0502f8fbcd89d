"""``bezier joints``: a joint sequence for a path, with its time law, certificates and page."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from bezier.arm import evidence
from bezier.arm import joint_plan as plans
from bezier.arm.evidence import Labelled, certificates, without_certificate
from bezier.arm.joint_plan import JointPlan
from bezier.arm.model import Arm
from bezier.curves.curve import Bezier
from bezier.motion.timelaw import TimeLaw
from qe.certify.verify import verify
from qe.cli.shell import OK, UNABLE
from qe.kernel.verdict import Verdict
from qe.processes.channel import Channel
from qe.proof.certificate import Certificate

TABLE, DATA, EVIDENCE, PAGE = "joints.csv", "joints.json", "joints_certificate.json", "joints.html"


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What the command line asked for; ``folder`` is where the files are written first."""

    arm: Arm
    curves: Mapping[str, Bezier]
    file: str
    folder: Path
    target: Path
    law: TimeLaw
    duration: Fraction
    samples: int
    json: bool = False


def joints(channel: Channel, request: Request) -> tuple[str, int]:
    """Plan the joints, write the files; what to print, and the exit status."""
    plan = plans.joint_plan(request.arm, request.curves, request.law, request.duration, request.samples)
    data, listed, verdict = write(plan, request.folder)
    (request.folder / PAGE).write_text(render(plan, request.file), encoding="utf-8")
    code = OK if plan.is_followed else UNABLE
    if request.json:
        return json.dumps(data, indent=1, ensure_ascii=False), code
    lines = plans.in_words(plan)
    lines += evidence.in_words(plan.path, listed, verdict)
    lines.append(f"open {request.target / PAGE}")
    return "\n".join(lines), code


def render(plan: JointPlan, file: str) -> str:
    """The page of ``bezier joints``: one file that needs nothing from elsewhere."""
    from bezier.report.html import document
    from bezier.report.joints import page

    return document(page(plan, file))


def write(plan: JointPlan, folder: Path) -> tuple[dict[str, Any], Labelled, Verdict]:
    """Write data and certificates of the joints; these, and whether the certificates are accepted."""
    listed = certificates(plan.path)
    bundle, missing = Certificate.bundle(listed), without_certificate(plan.path, listed)
    verdict = verify(bundle)
    data = {**plans.to_json(plan), "certified": verdict.accepted, "without_certificate": missing}
    (folder / DATA).write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    (folder / EVIDENCE).write_text(bundle.to_json() + "\n", encoding="utf-8")
    if plan.sequence is not None:
        (folder / TABLE).write_text(plans.to_csv(plan), encoding="utf-8")
    return data, listed, verdict

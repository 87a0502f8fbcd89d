"""What the commands about arms print: in words, or as one JSON object."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import degrees
from typing import Any

from bezier.arm import evidence, path_report
from bezier.arm.choices import Choice, Edge, Value, spans
from bezier.arm.evidence import certificates, without_certificate
from bezier.arm.inverse import MOST_BITS, Inverse, Solution, separated, solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.joint_path import joint_path
from bezier.arm.model import Arm, Joint, JointKind
from bezier.arm.pose import rotation_of, solve_pose
from bezier.curves.curve import Bezier
from bezier.curves.scalar import brief, decimal_text, described
from qe.certify.verify import verify
from qe.errors import InputError
from qe.processes.channel import Channel
from qe.proof.certificate import Certificate

DIGITS = 15
FURTHER = 6
"""Decimal places more, again and again, while two solutions print alike."""
MOST_FOR_A_POINT = 3
"""Joints that a point alone can determine."""


def inverse(
    channel: Channel,
    arm: Arm,
    point: Sequence[Any],
    quaternion: Sequence[Any] | None = None,
    *,
    certified: bool = False,
) -> tuple[dict[str, Any], list[str], str]:
    """``bezier ik``: at a point, or at a pose. What to print, as data and as lines, and the certificate as text where
    one is asked for.

    Raises ``Unable`` where there is no certificate."""
    if quaternion is None and len(arm.joints) > MOST_FOR_A_POINT:
        raise InputError(f"{arm.name} has {len(arm.joints)} joints: --quaternion W X Y Z expected, the orientation")
    result = solve(arm, point) if quaternion is None else solve_pose(arm, point, rotation_of(quaternion))
    certificate = inverse_certificate(result).to_json() if certified else ""
    data = {"status": "solved", **to_json(result), **({"certified": True} if certified else {})}
    return data, [*in_words(result), *(["certificate: accepted"] if certified else [])], certificate


def certify(
    channel: Channel, arm: Arm, curves: Mapping[str, Bezier], *, certified: bool = False
) -> tuple[dict[str, Any], list[str], str, bool]:
    """``bezier certify-path``: what to print, as data and as lines, the certificates of the continuous joint motions as
    text, and whether there are any where they are asked for."""
    result = joint_path(arm, curves)
    listed = certificates(result)
    bundle = Certificate.bundle(listed)
    verdict = verify(bundle)
    proof, has_proof = bundle.to_json() if listed else "", bool(listed) or not certified
    data = {"status": "solved", **path_report.to_json(result), "certified": verdict.accepted}
    data["without_certificate"] = without_certificate(result, listed)
    lines = [*path_report.in_words(result), *evidence.in_words(result, listed, verdict)]
    return data, lines, proof, has_proof


def to_json(answer: Inverse) -> dict[str, Any]:
    """All solutions as JSON data.

    ``count``: of different solutions, null for infinitely many; then the joints in ``free`` can be chosen (null in the
    solutions). Each joint of a solution has its ``angle`` (rad), ``cos`` and ``sin``, or its ``length`` (mm), and a
    ``box`` that isolates the solution: exact rational bounds of these. A solution with ``choices`` is a family: for
    each joint that can be chosen (independently, if there are two), ``possible`` says for which values there are
    positions: "all", or intervals by the bounds of their ends (angles from ``low`` on the way round to ``high``).
    ``values``: those of them between the joint's limits, as numbers, exact where an end is a ``limit``; an end is null
    where there is none. ``follow``: the other joints without a value, whose limits are left aside.
    """
    return {
        "arm": answer.arm.name,
        "point": [described(c) for c in answer.point],
        "rotation": [[described(c) for c in row] for row in answer.rotation] or None,
        "count": answer.count,
        "count_within_limits": None if answer.free else sum(s.allowed for s in answer.solutions),
        "reachable": answer.is_reachable,
        "free": list(answer.free),
        "special": list(answer.cases),
        "solutions": [_solution(answer.arm, s) for s in separated(answer).solutions],
    }


def _solution(arm: Arm, solution: Solution) -> dict[str, Any]:
    joints: dict[str, Any] = {}
    for joint, value in zip(arm.joints, solution.values, strict=True):
        joints[joint.name] = None if value is None else _joint(value)
    result = {"joints": joints, "multiple": solution.multiple, "within_limits": solution.allowed}
    if solution.choices:
        result["choices"] = [_choice(arm.joints[choice.joint], choice) for choice in solution.choices]
        chosen = {choice.joint for choice in solution.choices}
        free = (k for k, value in enumerate(solution.values) if value is None and k not in chosen)
        result["follow"] = [arm.joints[k].name for k in free]
    return result


def _choice(joint: Joint, choice: Choice) -> dict[str, Any]:
    ends = [[None if end is None else _joint(end.value()) for end in arc] for arc in choice.arcs or ()]
    arcs: Any = "all" if choice.arcs is None else [{"low": low, "high": high} for low, high in ends]
    values = [{"low": _edge(low), "high": _edge(high)} for low, high in spans(joint, choice)]
    return {"joint": joint.name, "possible": arcs, "values": values}


def _edge(edge: Edge) -> Any:
    limit = None if edge.limit is None else str(edge.limit)
    return None if edge.value is None else {"value": edge.value, "limit": limit}


def _joint(value: Value) -> dict[str, Any]:
    if value.cosine is None or value.sine is None:
        return {"length": float(value), "box": {"length": [str(e) for e in value.ends]}}
    box = {"cos": [str(e) for e in value.cosine], "sin": [str(e) for e in value.sine]}
    cosine, sine = (decimal_text(sum(ends, Fraction(0)) / 2, DIGITS) for ends in (value.cosine, value.sine))
    return {"angle": float(value), "cos": cosine, "sin": sine, "box": box}


def in_words(answer: Inverse) -> list[str]:
    """The same for people."""
    where = ", ".join(brief(c) for c in answer.point)
    lines = [f"{answer.arm.name} at ({where}) mm" + (", turned" if answer.rotation else "")]
    lines += [f"special: {case}" for case in answer.cases]
    if not answer.is_reachable:
        what = "pose (proved: a square that has to be a root's is negative, or the pose is out of the arm's plane)"
        what = what if answer.rotation else "point (proved: the equation of the last joint has no real root)"
        return [*lines, f"no joint position reaches the {what}"]
    if answer.free:
        single = sum(None not in s.angles for s in answer.solutions)
        count = len(answer.solutions) - single
        families = f"{count} famil{'y' if count == 1 else 'ies'}"
        families += f" and {single} single solution{'s' if single != 1 else ''}" if single else ""
        lines.append(f"infinitely many solutions, {', '.join(answer.free)} free; {families}")
    else:
        lines.append(f"{len(answer.solutions)} solution{'s' if len(answer.solutions) != 1 else ''} (proved), in rad:")
    answer, further = separated(answer), 0
    while True:
        texts = [_positions(answer.arm, solution, further) for solution in answer.solutions]
        if len({*texts}) == len(texts) or answer.free or further > MOST_BITS:
            break
        further += FURTHER
    for k, (solution, positions) in enumerate(zip(answer.solutions, texts, strict=True), start=1):
        notes = ["two solutions meet"] * solution.multiple
        notes += ["outside the limits of the joints"] * (not solution.allowed)
        lines.append(f"  {k}. {positions}" + (f"  [{'; '.join(notes)}]" if notes else ""))
    return lines if answer.allowed_count else [*lines, "no joint position is within the limits of the joints"]


def _positions(arm: Arm, solution: Solution, further: int) -> str:
    """The joints of one solution, with so many further decimal places."""
    parts = [
        f"{joint.name} follows" if value is None else f"{joint.name} = {_value_text(value, further)}"
        for joint, value in zip(arm.joints, solution.values, strict=True)
    ]
    for choice in solution.choices:
        joint = arm.joints[choice.joint]
        parts[choice.joint] = f"{joint.name} {_range(joint, choice)}"
    return ", ".join(parts)


def _range(joint: Joint, choice: Choice) -> str:
    """Which values of a joint can be chosen."""
    listed = list(spans(joint, choice))
    if not listed:
        return "free, but not between its limits"
    if listed == [(Edge(), Edge())]:
        return "free"
    unit = "mm" if joint.motion is JointKind.PRISMATIC else "rad"
    texts = [_between(*(edge.value for edge in ends)) for ends in listed]
    return f"free {' and '.join(texts)} {unit}" + (" (its limits)" if choice.arcs is None else "")


def _between(low: float | None, high: float | None) -> str:
    if low == high and low is not None:
        return f"at {low:.9f}"
    if low is None or high is None:
        return f"up to {high:.9f}" if high is not None else f"from {low:.9f} on"
    return f"from {low:.9f} to {high:.9f}"


def _value_text(value: Value, further: int) -> str:
    if value.pair is None:
        return f"{value.fixed(9 + further)} mm"
    return f"{value.fixed(12 + further)} ({degrees(float(value)):.4f}°)"

"""Certificates of all joint positions at a point or at a pose, which ``qe.verify`` checks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from bezier.arm.choices import Choice, Value
from bezier.arm.elimination import TURNS
from bezier.arm.evidence import POSITIONS, arm_json, surd_json
from bezier.arm.inverse import Inverse, Solution, geometry_of, solve
from bezier.arm.model import JointKind
from bezier.arm.wrist import centre_at, wrist_of
from qe.errors import Unable
from qe.proof.certificate import Certificate
from qe.proof.entry import Json

ATTEMPTS = ((100, 30), (260, 90), (800, 300))
"""Binary places of t, and of the boxes: more where solutions lie close together."""

FAR = 8
"""t is at most about so large: else another φ is taken."""


def inverse_certificate(answer: Inverse) -> Certificate:
    """The certificate that these are all solutions, and all families of them, accepted by the checker.

    Raises ``Unable`` where there is none: a coordinate is not a sum of square roots, or the first of six joints with
    three parallel axes can be chosen.
    """
    listed: dict[str, Json] = {"arm": arm_json(answer.arm), "point": _triple(answer.point)}
    if answer.rotation:
        listed["rotation"] = [_triple(row) for row in answer.rotation]
    listed["count"] = answer.count
    attempts = (payload for bits, places in ATTEMPTS for payload in _payloads(answer, bits, places))
    return POSITIONS.accepted({**listed, **payload} for payload in attempts)


def _payloads(answer: Inverse, bits: int, places: int) -> Iterator[dict[str, Json]]:
    """What lists the solutions: over roots of the equation in t for one φ after the other, or alone."""
    wrist = wrist_of(answer.arm) if answer.rotation else None
    if answer.rotation and wrist is None:
        yield {"solutions": [_box(s, places) for s in answer.solutions]}
        return
    arm, place = (answer.arm, answer.point) if wrist is None else (wrist.first, centre_at(wrist, answer))
    positions = solve(arm, place).solutions if wrist is not None else answer.solutions
    if any(s.values[:3] == (None, None, None) for s in positions):
        yield from _over_marks(answer, positions[0], bits, places)
        return
    moves = geometry_of(arm).moves_last and arm.joints[2].motion is not JointKind.PRISMATIC
    turns = TURNS if moves else (None,)
    for turn in turns:
        t = [_parameter(s, turn, bits) for s in positions], [_parameter(s, turn, bits) for s in answer.solutions]
        if turn is None or all(abs(v) <= FAR for v in t[0]):
            written: Json = None if turn is None else [str(v) for v in turn]
            yield {"turn": written, "roots": list(_roots(*t, answer.solutions, bits, places))}


def _over_marks(answer: Inverse, family: Solution, bits: int, places: int) -> Iterator[dict[str, Json]]:
    """Where the third joint can be chosen alone: intervals around its ends, and around other zeros of m²."""
    width = Fraction(1, 1 << bits)
    for turn in TURNS:
        ends = [end for choice in family.choices for end in choice.zeros]
        t = sorted({round(_tangent(end.value(bits + 20), turn) / width) for end in ends})
        if all(abs(k) * width <= FAR for k in t):
            marks: list[Json] = [[str((k - 4) * width), str((k + 4) * width)] for k in t]
            solutions: list[Json] = [_box(s, places) for s in answer.solutions]
            yield {"turn": [str(v) for v in turn], "marks": marks, "solutions": solutions}


def _parameter(solution: Solution, turn: tuple[Fraction, Fraction] | None, bits: int) -> Fraction:
    """About t: tan((θ3 - φ)/2), the length of the third joint, or 0 where every angle of it will do."""
    value = solution.refined(2, bits + 20)
    if value is None:
        return Fraction(0)
    return sum(value.ends, Fraction(0)) / 2 if turn is None else _tangent(value, turn)


def _tangent(value: Value, turn: tuple[Fraction, Fraction]) -> Fraction:
    assert value.cosine is not None and value.sine is not None, "the joint turns"
    c, s = ((low + high) / 2 for low, high in (value.cosine, value.sine))
    cosine, sine = c * turn[0] + s * turn[1], s * turn[0] - c * turn[1]
    return sine / (1 + cosine) if 1 + cosine > Fraction(1, FAR**3) else Fraction(FAR * FAR)


def _roots(
    roots: Sequence[Fraction], t: Sequence[Fraction], solutions: Sequence[Solution], bits: int, places: int
) -> Iterator[Json]:
    """Intervals around the roots, each with the solutions whose t is there."""
    width, low = Fraction(1, 1 << bits), None
    for root in sorted(roots):
        if low is not None and root - low <= width:
            continue  # two with the same last joint
        low, middle = root, round(root * (1 << bits)) * width
        boxes: list[Json] = [_box(s, places) for s, v in zip(solutions, t, strict=True) if abs(v - root) <= width]
        yield {"low": str(middle - 4 * width), "high": str(middle + 4 * width), "solutions": boxes}


def _box(solution: Solution, places: int) -> Json:
    boxes: list[Json] = [
        None if known is None else _of(solution.refined(k, places + 20), places)
        for k, known in enumerate(solution.quotients)
    ]
    if not solution.choices:
        return boxes
    chosen: list[Json] = [[c.joint, _arcs(c, places)] for c in solution.choices]
    return {"box": boxes, "chosen": chosen}


def _arcs(choice: Choice, places: int) -> Json:
    if choice.arcs is None:
        return None
    if any(end is None for arc in choice.arcs for end in arc):
        raise Unable("certificates of joint positions are for ranges of angles")
    return [[_of(None if end is None else end.value(places + 20), places) for end in arc] for arc in choice.arcs]


def _of(value: Value | None, places: int) -> Json:
    assert value is not None, "the joint is not free"
    parts = [value.ends] if value.cosine is None or value.sine is None else [value.cosine, value.sine]
    return [_around(ends, places) for ends in parts]


def _around(ends: tuple[Fraction, Fraction], places: int) -> Json:
    unit = Fraction(1, 1 << places)
    middle = round(sum(ends) / 2 / unit)
    return [str((middle - 2) * unit), str((middle + 2) * unit)]


def _triple(numbers: Sequence[Any]) -> Json:
    return [surd_json(c) for c in numbers]

"""Certificates of all joint positions at a point or at a pose, which ``qe.verify`` checks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from bezier.arm.choices import Choice, Value
from bezier.arm.evidence import POSITIONS
from bezier.arm.inverse import Inverse, Solution
from bezier.arm.pose import first_three, is_family, motion_of
from bezier.arm.roots_of_squares import arm_json, roots_of, square_roots, surds
from bezier.proofs.arm_rows import read_circle
from bezier.proofs.inverse_pose import centre
from qe.errors import Unable
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry, Json

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
    chain, place, pose = answer.arm.chain, surds(answer.point), None
    boxes: list[Json] = [_box(s, places) for s in answer.solutions]
    if answer.rotation:
        pose = motion_of(answer.point, answer.rotation)
        if centre(chain) is None:
            yield {"solutions": boxes}
            return
    for written, positions in first_three(chain, place, pose):
        roots = roots_of(positions.equation) if positions.equation else []
        around = [_wider(root.around(bits + 20), bits) for root in roots]
        if written is not None and any(max(abs(v) for v in ends) > FAR for ends in around):
            continue
        if is_family(positions, roots):
            yield {"turn": written, "marks": [list(map(str, ends)) for ends in around], "solutions": boxes}
            continue
        turn = None if written is None else read_circle(Entry(written, "turn"))
        t = [_parameter(s, turn, bits) for s in answer.solutions]
        yield {"turn": written, "roots": _over(around, t, boxes)}


def _over(around: Sequence[tuple[Fraction, Fraction]], t: Sequence[Fraction], boxes: Sequence[Json]) -> Json:
    """The roots, each with the boxes of the solutions whose t is there."""
    held = ([box for box, v in zip(boxes, t, strict=True) if low <= v <= high] for low, high in around)
    return [{"low": str(a), "high": str(b), "solutions": s} for (a, b), s in zip(around, held, strict=True)]


def _wider(ends: tuple[Fraction, Fraction], bits: int, spare: int = 4) -> tuple[Fraction, Fraction]:
    """Short numbers around an interval."""
    middle = round(sum(ends) / 2 * (1 << bits))
    return Fraction(middle - spare, 1 << bits), Fraction(middle + spare, 1 << bits)


def _parameter(solution: Solution, turn: tuple[Fraction, Fraction] | None, bits: int) -> Fraction:
    """About t: tan((θ3 - φ)/2), the length of the third joint, or 0 where every angle of it will do."""
    value = solution.refined(2, bits + 20)
    if value is None:
        return Fraction(0)
    if turn is None:
        return sum(value.ends, Fraction(0)) / 2
    assert value.cosine is not None and value.sine is not None, "the joint turns"
    c, s = ((low + high) / 2 for low, high in (value.cosine, value.sine))
    cosine, sine = c * turn[0] + s * turn[1], s * turn[0] - c * turn[1]
    return sine / (1 + cosine) if 1 + cosine > Fraction(1, FAR**3) else Fraction(FAR * FAR)


def _box(solution: Solution, places: int) -> Json:
    boxes: list[Json] = [None if exact is None else _of(exact.value(places + 20), places) for exact in solution.exact]
    if not solution.choices:
        return boxes
    chosen: list[Json] = [[c.joint, _arcs(c, places)] for c in solution.choices]
    return {"box": boxes, "chosen": chosen}


def _arcs(choice: Choice, places: int) -> Json:
    if choice.arcs is None:
        return None
    if any(end is None for arc in choice.arcs for end in arc):
        raise Unable("certificates of joint positions are for ranges of angles")
    return [[_of(end.value(places + 20), places) for end in arc if end is not None] for arc in choice.arcs]


def _of(value: Value, places: int) -> Json:
    return [list(map(str, _wider(ball.ends, places, 2))) for ball in value.pair or (value.ball,)]


def _triple(numbers: Sequence[Any]) -> Json:
    """Sums of square roots as lists of [factor, number under the root]."""
    return [[[str(q), d] for d, q in sorted(square_roots(c).items()) if q] for c in numbers]

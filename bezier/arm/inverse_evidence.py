"""Certificates of kind "inverse" for all joint positions at a point or at a pose, which ``qe.verify`` checks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from bezier.arm.elimination import TURNS
from bezier.arm.evidence import arm_json
from bezier.arm.inverse import Inverse, Solution, solve
from bezier.arm.model import Motion
from bezier.arm.square_roots import square_roots
from bezier.arm.wrist import centre_at, wrist_of
from qe.certify.verify import verify
from qe.errors import Unable
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Json

ATTEMPTS = ((100, 30), (260, 90), (800, 300))
"""Binary places of t, and of the boxes: more where solutions lie close together."""

FAR = 8
"""t is at most about so large: else another φ is taken."""


def inverse_certificate(found: Inverse) -> Certificate:
    """The certificate that these are all solutions, accepted by the checker.

    Raises ``Unable`` where there is none: a joint is free, or a coordinate is not a sum of square roots.
    """
    if found.free:
        raise Unable("certificates of joint positions are for points and poses where no joint is free")
    listed: dict[str, Json] = {"arm": arm_json(found.arm), "point": _triple(found.point)}
    if found.rotation:
        listed["rotation"] = [_triple(row) for row in found.rotation]
    listed["count"] = len(found.solutions)
    verdict = None
    for bits, places in ATTEMPTS:
        for payload in _payloads(found, bits, places):
            certificate = Certificate(Kind.INVERSE, {**listed, **payload})
            verdict = verify(certificate)
            if verdict.accepted:
                return certificate
    raise Unable(
        f"no certificate was found: {verdict.reason if verdict is not None else 'the last joint is undetermined'}"
    )


def _payloads(found: Inverse, bits: int, places: int) -> Iterator[dict[str, Json]]:
    """What lists the solutions: over roots of the equation in t for one φ after the other, or alone."""
    wrist = wrist_of(found.arm) if found.rotation else None
    if found.rotation and wrist is None:
        yield {"solutions": [_box(s, places) for s in found.solutions]}
        return
    arm, place = (found.arm, found.point) if wrist is None else (wrist.first, centre_at(wrist, found))
    positions = found.solutions if wrist is None else solve(arm, place).solutions
    if arm.joints[2].motion is Motion.PRISMATIC:
        t = [_length(s, bits) for s in positions], [_length(s, bits) for s in found.solutions]
        yield {"turn": None, "roots": list(_roots(*t, found.solutions, bits, places))}
        return
    for turn in TURNS:
        t = [_tangent(s, turn, bits) for s in positions], [_tangent(s, turn, bits) for s in found.solutions]
        if all(abs(v) <= FAR for v in t[0]):
            yield {"turn": [str(v) for v in turn], "roots": list(_roots(*t, found.solutions, bits, places))}


def _length(solution: Solution, bits: int) -> Fraction:
    value = solution.refined(2, bits + 20)
    assert value is not None, "no joint is free"
    return sum(value.ends, Fraction(0)) / 2


def _tangent(solution: Solution, turn: tuple[Fraction, Fraction], bits: int) -> Fraction:
    """About tan((θ3 - φ)/2)."""
    value = solution.refined(2, bits + 20)
    assert value is not None and value.cosine is not None and value.sine is not None, "no joint is free"
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
    found: list[Json] = []
    for k in range(len(solution.values)):
        value = solution.refined(k, places + 20)
        assert value is not None, "no joint is free"
        parts = [value.ends] if value.cosine is None or value.sine is None else [value.cosine, value.sine]
        found.append([_around(ends, places) for ends in parts])
    return found


def _around(ends: tuple[Fraction, Fraction], places: int) -> Json:
    unit = Fraction(1, 1 << places)
    middle = round(sum(ends) / 2 / unit)
    return [str((middle - 2) * unit), str((middle + 2) * unit)]


def _triple(numbers: Sequence[Any]) -> Json:
    return [[[str(q), d] for d, q in sorted(square_roots(c).items()) if q] for c in numbers]

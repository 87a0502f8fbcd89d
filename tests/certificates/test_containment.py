"""Containment certificates of Bezier curves."""

from __future__ import annotations

from typing import Any

import pytest

from qe.certify.verify import verify
from qe.proof.certificate import Certificate, Kind

RATIONAL = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
SQRT2 = {"minimal_polynomial": ["-2", "0", "1"], "interval": ["1", "2"]}


def _curve(
    points: list[tuple[str, ...]], condition: dict[str, Any], *breaks: str, field: Any = RATIONAL
) -> Certificate:
    coordinates = [[[c] for c in p] for p in points]
    payload = {"field": field, "points": coordinates, "condition": condition, "breaks": ["0", *breaks, "1"]}
    return Certificate(Kind("containment"), payload)


def _ball(radius: str) -> dict[str, Any]:
    return {"centre": ["0", "0"], "radius_squared": [radius]}


ARCH = [("-1", "0"), ("0", "2"), ("1", "0")]  # y = 1 - x^2, at most 1 from the origin


@pytest.mark.parametrize(
    ("radius", "breaks", "accepted"),
    [("4", (), True), ("1", (), False), ("1", ("1/2",), True), ("99/100", (), False), ("99/100", ("1/2",), False)],
)
def test_an_arch_in_a_disc(radius: str, breaks: tuple[str, ...], accepted: bool) -> None:
    assert verify(_curve(ARCH, _ball(radius), *breaks)).accepted is accepted


def test_breaks_help() -> None:
    spike = [("0", "1"), ("1", "-1"), ("0", "1")]  # second coordinate 1 - 4t(1-t) >= 0 touches 0 at 1/2
    up = {"normal": ["0", "-1"], "offset": "0"}
    assert verify(_curve(spike, up)).step == "payload.breaks[1]"
    assert verify(_curve(spike, up, "1/2")).accepted
    lower = {"normal": ["0", "-1"], "offset": "-1/1000"}
    assert not verify(_curve(spike, lower, "1/2")).accepted


def test_numbers_of_a_field() -> None:
    point = Certificate(
        Kind("containment"),
        {
            "field": SQRT2,
            "points": [[["0", "1"], ["0"]], [["0"], ["0", "1"]]],  # from (sqrt 2, 0) to (0, sqrt 2)
            "condition": _ball("2"),
            "breaks": ["0", "1"],
        },
    )
    assert verify(point).accepted
    assert isinstance(point.payload, dict)
    assert not verify(Certificate(Kind("containment"), {**point.payload, "condition": _ball("199/100")})).accepted


@pytest.mark.parametrize("breaks", [["0"], ["0", "2", "1"], ["1", "0"], ["0", "1/2"], ["1/2", "1"], ["0", "1", "1"]])
def test_breaks_must_cover_the_curve(breaks: list[str]) -> None:
    certificate = _curve(ARCH, _ball("4"))
    assert isinstance(certificate.payload, dict)
    verdict = verify(Certificate(Kind("containment"), {**certificate.payload, "breaks": list(breaks)}))
    assert verdict.step == "payload.breaks"

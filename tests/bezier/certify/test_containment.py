"""Whole curves inside balls and half-spaces, by Bernstein coefficients on pieces."""

from __future__ import annotations

from typing import Any

import pytest

from bezier.certify.containment import check_containment
from qe.errors import CertificateRejected

RATIONAL = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
ARCH = [["-1", "0"], ["0", "2"], ["1", "0"]]


def payload(condition: Any, *breaks: str, points: Any = ARCH) -> dict[str, Any]:
    given = [[[c] for c in p] for p in points]
    return {"field": RATIONAL, "points": given, "condition": condition, "breaks": list(breaks or ("0", "1"))}


def ball(square: str, *centre: str) -> dict[str, Any]:
    return {"centre": list(centre or ("0", "0")), "radius_squared": [square]}


def side(offset: str, *normal: str) -> dict[str, Any]:
    return {"normal": list(normal), "offset": offset}


@pytest.mark.parametrize(
    ("condition", "breaks"),
    [
        (side("2", "0", "1"), ()),  # y <= 2, of the control points
        (side("1", "0", "1"), ("0", "1/2", "1")),
        (side("0", "0", "-1"), ()),
        (side("1", "1", "0"), ()),
        (ball("1"), ("0", "1/2", "1")),
        (ball("2", "0", "1"), ()),
    ],
)
def test_inside(condition: Any, breaks: tuple[str, ...]) -> None:
    check_containment(payload(condition, *breaks))


@pytest.mark.parametrize(
    ("condition", "breaks", "reason"),
    [
        (side("1", "0", "1"), (), "Bernstein coefficient"),
        (side("99/100", "0", "1"), ("0", "1/2", "1"), "Bernstein coefficient"),
        (side("0", "0", "1"), (), "Bernstein coefficient"),
        (side("0", "1", "0"), (), "Bernstein coefficient"),
        (ball("1"), (), "Bernstein coefficient"),
        (ball("1", "0", "1"), (), "Bernstein coefficient"),
        (side("1", "0", "1", "0"), (), "expected 2 numbers"),
        (ball("4", "0", "0", "0"), (), "expected 2 numbers"),
        (side("2", "0", "1"), ("0",), "ascending numbers"),
        (side("2", "0", "1"), ("0", "1/2"), "ascending numbers"),
        (side("2", "0", "1"), ("1/2", "1"), "ascending numbers"),
        (side("2", "0", "1"), ("0", "1/2", "1/2", "1"), "ascending numbers"),
        (side("2", "0", "1"), ("0", "2/3", "1/3", "1"), "ascending numbers"),
        (None, (), "expected an object"),
    ],
)
def test_what_is_refused(condition: Any, breaks: tuple[str, ...], reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        check_containment(payload(condition, *breaks))


def test_the_break_that_fails_is_named() -> None:
    with pytest.raises(CertificateRejected) as error:
        check_containment(payload(side("3/4", "0", "1"), "0", "1/4", "1"))
    assert error.value.step == "payload.breaks[2]"

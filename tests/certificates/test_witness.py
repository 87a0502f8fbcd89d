"""Witness certificates: accepted when the numbers satisfy the formula, rejected otherwise."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest

from qe.certify.verify import verify, verify_json
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.proof.certificate import Certificate, Root
from tests.certificates.mutation import PLACE, leaves, lists, replaced, without

NAMES = ("x", "y", "z")
ROOT2 = Root((-2, 0, 1), Fraction(1), Fraction(2))
ROOT8 = Root((-8, 0, 1), Fraction(2), Fraction(3))


def _witness(text: str, *values: Root | Fraction) -> Certificate:
    return Certificate.witness(convert(read(text), Ring.of(NAMES)), NAMES, values)


@pytest.mark.parametrize(
    ("text", "accepted"),
    [
        ("x*y = 4 and z > x", True),
        ("2*x = y", True),
        ("2*x /= y", False),
        ("2*x - y = 0 and x*y*z = 6", True),
        ("y > 2*x or not z = 3/2", False),
        ("x^2*y^2 = 16 -> z < 3/2", False),
        ("1000000*x > 1414213 and 1000000*x < 1414214", True),
    ],
)
def test_signs_at_the_point_decide(text: str, accepted: bool) -> None:
    assert verify(_witness(text, ROOT2, ROOT8, Fraction(3, 2))).accepted is accepted


def test_an_interval_must_isolate() -> None:
    for low, high in [(-2, 2), (2, 3), (3, 2)]:
        wide = _witness("x^2 = 2", Root((-2, 0, 1), Fraction(low), Fraction(high)), ROOT8, Fraction(1))
        assert verify(wide).step == f"{PLACE}.values[0].interval"


def test_every_altered_entry_is_rejected() -> None:
    whole = json.loads(_witness("x*y = 4 and z = 3/2", ROOT2, ROOT8, Fraction(3, 2)).to_json())
    assert verify_json(json.dumps(whole)).accepted
    for path, value in leaves(whole):
        for other in (f"{value}1", str(value)[1:], f"-{value}"):
            assert not verify_json(replaced(whole, path, other, signed=False)).accepted
            if "interval" not in path and path[0] != "digest":  # a wider interval may isolate the same root
                assert not verify_json(replaced(whole, path, other)).accepted, (path, other)
    for path, content in lists(whole):
        for index in range(len(content)):
            assert not verify_json(without(whole, path, index)).accepted

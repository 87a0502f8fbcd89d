"""One factor of a stack: few signs are looked at first, and what they do not show is named all the same."""

from __future__ import annotations

from fractions import Fraction

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.evaluate import holds_at
from qe.io.text import read
from qe.kernel.arithmetic.fibre import fibre, values
from qe.kernel.arithmetic.triangular import Point
from qe.kernel.line import roots_and_signs

SAMPLES = (0, Fraction(3, 2), 3, 4, 5, 11)


def seen(poly: str, listed: list[int]) -> list[int]:
    given = read(f"{poly} = 0", source="test")
    f = fibre(Point(), given.poly.convert(Ring.of(("x",))), 0)  # type: ignore[attr-defined]
    at = values(tuple(map(Fraction, SAMPLES)))
    return roots_and_signs(f, at, listed, CertificateRejected)[0]


@pytest.mark.parametrize(
    ("poly", "listed"), [("x^2 + 1", []), ("(x - 1)*(x - 2)*(x - 10)", [0, 1, 4]), ("(x - 1)^2*(x - 10)", [0, 4])]
)
def test_all_signs_are_the_true_ones(poly: str, listed: list[int]) -> None:
    signs = seen(poly, listed)
    assert signs == [sign for x in SAMPLES for sign in (-1, 1) if holds_at(read(f"{sign}*({poly}) > 0"), {"x": x})]


@pytest.mark.parametrize(
    ("poly", "listed", "step"),
    [
        ("(x - 1)*(x - 2)*(x - 10)", [4], "sections[0]"),  # a pair of roots between samples that are not looked at
        ("(2*x - 3)*(x - 10)*(x + 1)", [4], "sectors[1]"),  # such a sample is a root
        ("(x - 4)^2*(x - 10)", [4], "sectors[3]"),
        ("x - 10", [3], "sections[3]"),  # the root lies in a neighbouring section
        ("(x - 1)^2*(x - 10)", [4], "sections"),
        ("x^2 + 1", [2], "sections[2]"),
    ],
)
def test_what_is_wrong_is_named(poly: str, listed: list[int], step: str) -> None:
    with pytest.raises(CertificateRejected) as error:
        seen(poly, listed)
    assert error.value.step == step

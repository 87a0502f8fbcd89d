"""The degree shift inside elimination sets, recomputed."""

from __future__ import annotations

import pytest

from qe.errors import CertificateRejected
from qe.kernel.lowered_degree import lowered, lowered_poly
from qe.proof.entry import Entry
from tests.unit.certify.claims import RING, both, formula, poly

X = RING.index["x"]


def shifted(text: str, exponent: int) -> object:
    return lowered(formula(text), X, exponent, Entry(exponent, "exponent"))


@pytest.mark.parametrize(
    ("text", "exponent", "after"),
    [
        ("x^2 + a*x = 0", 1, ("x^2 + a*x = 0",)),
        ("x^6 + a*x^3 = 0", 3, ("x^2 + a*x = 0",)),
        ("x^3 < a and x > 0", 3, ("x < a", "x > 0")),
        ("x^4 + a < 0", 2, ("x^2 + a < 0", "x > 0")),  # an open set contains more than 0
        ("x^4 + a <= 0", 2, ("x^2 + a <= 0", "x >= 0")),
        ("x^4 < a and x^2 /= b and c <= 0", 2, ("x^2 < a", "x /= b", "c <= 0", "x > 0")),
        ("x^2 = a and x > 0", 2, ("x = a", "x > 0", "x >= 0")),
        ("x^2 < a and x >= 0", 2, ("x < a", "x >= 0")),
    ],
)
def test_exponents_are_divided(text: str, exponent: int, after: tuple[str, ...]) -> None:
    assert shifted(text, exponent) == both(*after)


@pytest.mark.parametrize(
    ("text", "exponent"),
    [
        ("x^3 = a", 2),
        ("x^4 + x^2 + a = 0", 4),
        ("x^2 = a and x < 0", 2),
        ("x^2 = a and x <= 0", 2),
        ("x^2 = a and (x > 0 or b > 0)", 2),  # it is no conjunct
        ("x^2 = a or x > 0", 2),
        ("x^2 = a and b*x > 0", 2),  # the sign of x is not known
        ("x^2 = 4 and x < root(1, x^2 - a)", 2),
        ("x^3 = 8 and x < root(1, x^3 - a)", 3),
        ("x^2 = a and y > root(1, y^2 - x)", 2),
    ],
)
def test_what_the_theorem_does_not_allow(text: str, exponent: int) -> None:
    with pytest.raises(CertificateRejected) as error:
        shifted(text, exponent)
    assert error.value.step == "exponent"


def test_root_atoms_without_the_variable_stay() -> None:
    assert shifted("x^2 = a and b > root(1, b^2 - c)", 2) == both("x = a", "b > root(1, b^2 - c)", "x >= 0")


def test_a_polynomial_is_evaluated_at_the_power() -> None:
    p = poly("a*x^6 - b*x^3 + c")
    assert lowered_poly(p, X, 3) == poly("a*x^2 - b*x + c")

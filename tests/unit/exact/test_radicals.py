"""Texts of algebraic numbers with radicals: read back, they are the number."""

from __future__ import annotations

from math import sqrt

import pytest
from flint import fmpz_poly
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.algebraic import real_roots
from qe.exact.radicals import format_number
from tests.tables import each


@each(
    ([1, 0, -10, 0, 1], ["-sqrt(2) - sqrt(3)", "sqrt(2) - sqrt(3)", "-sqrt(2) + sqrt(3)", "sqrt(2) + sqrt(3)"]),
    ([-2, 0, 1], ["-sqrt(2)", "sqrt(2)"]),
    ([-3, 2], ["3/2"]),
    ([-2, 0, 0, 1], ["root(1, x^3 - 2)"]),
)
def test_texts(coefficients: list[int], texts: list[str]) -> None:
    found = [format_number(r) for r in sorted(real_roots(fmpz_poly(coefficients)))]
    assert len(found) == len(texts)
    for text, expected in zip(found, texts, strict=True):
        if "root(" in expected:
            assert text.startswith("root(1, ")
        else:
            assert value(text) == pytest.approx(value(expected), abs=1e-12)
            assert text.count("sqrt") == expected.count("sqrt")


def value(text: str) -> float:
    return float(eval(text, {"sqrt": sqrt}))


@settings(max_examples=30)
@given(st.integers(1, 3), st.integers(-9, 9), st.integers(-9, 9), st.integers(-2, 2), st.integers(1, 2))
def test_biquadratic_numbers_mean_what_they_were(a: int, b: int, c: int, shift: int, scale: int) -> None:
    y = fmpz_poly([-shift, scale])
    p = a * y**4 + b * y**2 + c
    for root in real_roots(p):
        text = format_number(root)
        if "root(" not in text:
            assert value(text) == pytest.approx(float(root), abs=1e-9)
            minimal = " + ".join(f"({c})*x^{k}" for k, c in enumerate(root.minimal_polynomial))
            assert qe.decide(f"ex x. x = {text} and {minimal} = 0")
        elif root.degree == 4:
            pytest.fail(f"{text} has degree 4 and is biquadratic")

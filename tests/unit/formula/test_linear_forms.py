"""Polynomials in linear forms: what is written is the same polynomial, and not longer."""

from __future__ import annotations

import random

import pytest

from qe.exact.ring import Ring
from qe.formula.build import atom, convert
from qe.formula.syntax import Relation
from qe.io import formats
from qe.io.mathml import expression
from qe.io.text import read
from tests.tables import each


@each(
    ("(a - c)^2 + (b - d)^2 < 4", "(a - c)^2 + (b - d)^2 < 4"),
    ("4*c <= (a + b)^2", "(a + b)^2 - 4*c >= 0"),
    ("3 <= (a + b + c)^2", "(a + b + c)^2 >= 3"),
    ("(x + 2*y - 3*z)^2 < t", "t > (x + 2*y - 3*z)^2"),
    ("(a - b)*c > 1", "(a - b)*c > 1"),
    ("1 < (a - b)^2 and (a - b)^2 < 4", "1 < (a - b)^2 < 4"),
    ("(a - 1/2)^2 + (b + 2)^2 < 4", "(a - 1/2)^2 + (b + 2)^2 < 4"),
    ("9*x^2 + 9*y^2 - 18*x - 36*y + 44 <= 0", "(x - 1)^2 + (y - 2)^2 <= 1/9"),
    ("4 - (x - 1)^2 - (y - 1/3)^2 > 0", "(x - 1)^2 + (y - 1/3)^2 < 4"),
    ("x^2 + y^2 - x - y <= 0", "x^2 + y^2 - x - y <= 0"),
    ("x^2 - 2*x + y < 0", "x^2 - 2*x + y < 0"),
    ("b^2 - 4*a*c >= 0", "b^2 - 4*a*c >= 0"),
    ("2*x^2 + 4*y <= 3", "2*x^2 + 4*y <= 3"),
)
def test_how_they_are_written(given: str, written: str) -> None:
    assert str(read(given)) == written


@each(
    ("(x + y)^2 + (x + y) > 3", "(x + y)^2 + x + y - 3 > 0"),
    ("0 <= (x + y)^2 + (x + y) <= 1", "0 <= (x + y)^2 + x + y <= 1"),
    ("(x + 2*y)^3 + (x + 2*y) = z", "(x + 2*y)^3 + x + 2*y = z"),
    ("(x + y)^2 - (x + y) > 3", "(x + y)^2 - (x + y) - 3 > 0"),
)
def test_a_form_that_is_added_has_no_brackets(text: str, printed: str) -> None:
    """``(x + y)^2 + (x + y)`` was printed with all its brackets."""
    formula = read(text)
    assert str(formula) == printed and read(printed) == formula
    assert formats.read(formats.write(formula, "latex"), "latex") == formula


def test_mathml_has_the_same_forms() -> None:
    drawn = expression(read("(x - 1/2)^2 + (y + 2)^2 <= 4"))
    assert drawn.count("<msup>") == 2 and "<mfrac>" in drawn


@pytest.mark.parametrize("seed", range(60))
def test_what_is_written_is_read_as_the_same_polynomial(seed: int) -> None:
    rng = random.Random(seed)
    ring = Ring.of(("x", "y", "z", "w"))
    forms = [sum((rng.randint(-2, 2) * ring.gen(i) for i in range(4)), ring.constant(rng.randint(-2, 2))) for _ in "ab"]
    poly = sum((rng.choice((1, 1, -1, 3)) * f ** rng.randint(1, 3) for f in forms), ring.constant(rng.randint(-5, 5)))
    relation = rng.choice([*Relation])
    given = atom(poly, relation)
    assert convert(read(str(given)), ring) == given

"""Exact numbers as the command line prints them."""

from __future__ import annotations

from fractions import Fraction

from qe.cli.numbers import LONGEST, decimal, exact_and_decimal, shown
from qe.exact.algebraic import RealAlgebraic
from tests.tables import each

ROOT = RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@each(
    (None, "none"),
    (Fraction(3), "3"),
    (Fraction(-3), "-3"),
    (Fraction(1, 3), "1/3 (about 0.3333333333)"),
    (ROOT, "sqrt(2) (about 1.414213562)"),
    (Fraction(10**LONGEST, 1), f"about {float(10**LONGEST):.10g} (the exact text has {LONGEST + 1} characters)"),
    (Fraction(10 ** (LONGEST - 1), 1), str(10 ** (LONGEST - 1))),
)
def test_numbers_for_people(value: object, text: str) -> None:
    assert shown(value, "none") == text


def test_numbers_for_machines() -> None:
    assert exact_and_decimal(2) == {"exact": "2", "decimal": "2"}
    assert exact_and_decimal(Fraction(-1, 3)) == {"exact": "-1/3", "decimal": "-0.3333333333"}
    assert exact_and_decimal(ROOT) == {"exact": "sqrt(2)", "decimal": "1.414213562"}
    assert decimal(Fraction(123456789012345)) == "1.23456789e+14"

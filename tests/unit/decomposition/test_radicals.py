"""Roots with parameters as quotients and radicals."""

from __future__ import annotations

import qe
from qe.decomposition.radicals import radicals
from qe.exact.ring import Ring
from qe.formula.traverse import polynomials
from qe.io.text import read
from tests.tables import each

RING = Ring.of("abcx")


@each(
    ("a*x - b", 1, 1, 1, ["b/a"]),
    ("(b - a)*x + c", 1, 1, 1, ["c/(a - b)"]),
    ("x^2 - a", 1, 2, 1, ["-sqrt(a)"]),
    ("x^2 - a", 1, 1, 1, ["-sqrt(a)", "sqrt(a)", "0"]),
    ("a*x^2 + b*x + c", 1, 2, 1, ["(-b - sqrt(b^2 - 4*a*c))/(2*a)"]),
    ("a*x^2 + b*x + c", 1, 2, -1, ["(-b + sqrt(b^2 - 4*a*c))/(2*a)"]),
    ("x^2 - 2*a*x + b", 2, 2, 1, ["a + sqrt(a^2 - b)"]),
    ("a*x^3 - b", 1, 1, -1, ["cbrt(b/a)"]),
    ("x^5 - a", 1, 1, 1, []),
    ("x^6 - 2*a", 2, 2, 1, ["(2*a)^(1/6)"]),
    ("x^4 + a*x^2 + b", 2, 4, 1, ["-sqrt((-a - sqrt(a^2 - 4*b))/2)"]),
    ("x^4 + a*x^2 + b", 3, 3, 1, ["sqrt((-a + sqrt(a^2 - 4*b))/2)"]),
    ("x^4 + a*x^3 + b", 1, 2, 1, []),
)
def test_roots_in_radicals(text: str, k: int, count: int, lead: int, expected: list[str]) -> None:
    (poly,) = polynomials(read(f"{text} = 0"))
    assert [radical.text for radical in radicals(poly.convert(RING).coefficients(3), k, count, lead)] == expected


@each((1, -3, 1), (-1, -3, -1), (2, 5, 2), (1, -2, 1))
def test_they_are_the_roots_of_polynomials_with_numbers(a: int, b: int, c: int) -> None:
    solutions = qe.solve("a*x^4 + b*x^2 + c = 0", "x")
    at = f"a = {a} and b = {b} and c = {c}"
    assert qe.equivalent(f"({solutions}) and {at}", f"{a}*x^4 + {b}*x^2 + {c} = 0 and {at}")

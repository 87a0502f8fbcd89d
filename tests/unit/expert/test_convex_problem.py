"""Arithmetic of convex problems over a number field: values, gradients, tangents, weighted sums."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from qe.errors import CertificateRejected
from qe.expert import convex_problem as problems
from qe.expert.arithmetic.numbers import read_field
from qe.expert.arithmetic.residue import Residue, of_rationals
from qe.expert.convex_problem import Equation, Weighting, read_problem
from qe.proof.entry import Entry
from tests.tables import each

SQRT2 = read_field(Entry({"minimal_polynomial": ["-2", "0", "1"], "interval": ["1", "2"]}, "field"), None)
ROOT = of_rationals([Fraction(0), Fraction(1)])


def terms(*pairs: tuple[list[int], str]) -> list[Any]:
    return [[c, exponents] for exponents, c in pairs]


def problem(objective: Any, *constraints: tuple[Any, str], names: list[str] = ["x", "y"]) -> problems.Problem:
    listed = [{"terms": t, "relation": r} for t, r in constraints]
    return read_problem(Entry({"variables": names, "minimise": objective, "constraints": listed}, "problem"))


DISC = terms(([2, 0], "1"), ([0, 2], "1"), ([0, 0], "-4"))  # x^2 + y^2 - 4
SKEW = terms(([2, 0], "1"), ([1, 1], "1"), ([0, 2], "3"), ([1, 0], "-5"), ([0, 0], "7"))
LINE = terms(([1, 0], "1"), ([0, 1], "-2"), ([0, 0], "1"))  # x - 2 y + 1
SADDLE = terms(([1, 1], "1"))


def number(value: Residue) -> Fraction:
    return problems.as_fraction(value)


def test_values_and_gradients() -> None:
    form = problem(SKEW).objective
    at = problems.rational([Fraction(2), Fraction(-3, 2)])
    # 4 - 3 + 27/4 - 10 + 7 and (2x + y - 5, x + 6y)
    assert number(problems.value_at(form, at, SQRT2)) == Fraction(19, 4)
    assert [number(s) for s in problems.slope_at(form, at)] == [Fraction(-5, 2), -7]


def test_irrational_points() -> None:
    form = problem(DISC).objective
    assert number(problems.value_at(form, [ROOT, ROOT], SQRT2)) == 0
    assert problems.slope_at(form, [ROOT, ROOT]) == [of_rationals([Fraction(0), Fraction(2)])] * 2
    assert problems.along((Fraction(3), Fraction(0)), [ROOT, ROOT], Fraction(1)) == of_rationals(
        [Fraction(1), Fraction(3)]
    )


def test_tangents() -> None:
    """At (2, 0) the disc gives 2x = 4, 2y = 0 and 4x = 8; a value of 5 there moves the last one."""
    form, at = problem(DISC).objective, problems.rational([Fraction(2), Fraction(0)])
    found = problems.tangents(form, at, SQRT2)
    assert [([number(a) for a in e.row], number(e.rhs)) for e in found] == [([2, 0], 4), ([0, 2], 0), ([4, 0], 8)]
    moved = problems.tangents(form, at, SQRT2, of_rationals([Fraction(5)]))
    assert [number(e.rhs) for e in moved] == [4, 0, 3]


def weighting(*weights: int, equations: list[Equation] = [], extra: list[int] = []) -> Weighting:
    def made(values: Any) -> list[Residue]:
        return problems.rational([Fraction(v) for v in values])

    return Weighting(made(weights), equations, made(extra))


def equation(row: list[int], rhs: int) -> Equation:
    return Equation(tuple(problems.rational([Fraction(a) for a in row])), of_rationals([Fraction(rhs)]))


def test_stationary_points() -> None:
    """x + y on the disc of radius 2 is stationary at (-sqrt 2, -sqrt 2); here with weights over the rationals."""
    given = problem(terms(([1, 0], "4")), (DISC, "<="), (LINE, "="))
    at = problems.rational([Fraction(-2), Fraction(0)])
    problems.check_stationary(given, SQRT2, at, weighting(1, 0), "at", with_objective=True)
    with pytest.raises(CertificateRejected, match="coordinate 1"):
        problems.check_stationary(given, SQRT2, at, weighting(1, 0), "at")
    with pytest.raises(CertificateRejected, match="coordinate 1"):
        problems.check_stationary(given, SQRT2, at, weighting(2, 0), "at", with_objective=True)
    tilted = weighting(1, 0, equations=[equation([0, 1], 0)], extra=[1])
    with pytest.raises(CertificateRejected, match="coordinate 2"):
        problems.check_stationary(given, SQRT2, at, tilted, "at", with_objective=True)
    joined = weighting(1, 1, equations=[equation([-1, 2], 0)], extra=[1])
    problems.check_stationary(given, SQRT2, at, joined, "at", with_objective=True)
    empty = weighting(1, 0, equations=[equation([0, 0], 1)], extra=[1])
    with pytest.raises(CertificateRejected, match="an empty equation"):
        problems.check_stationary(given, SQRT2, at, empty, "at", with_objective=True)


def test_weighted_values() -> None:
    at = problems.rational([Fraction(3), Fraction(1)])
    total = weighting(2, 5, equations=[equation([1, 1], 1), equation([7, 7], 7)], extra=[10, 0])
    values = problems.rational([Fraction(1), Fraction(-2)])
    assert number(problems.weighted_value(SQRT2, at, values, total)) == 2 - 10 + 10 * 3


def test_signs_of_weights() -> None:
    given = problem(LINE, (DISC, "<="), (LINE, "="), (LINE, "<"))
    negative, zero = of_rationals([Fraction(1), Fraction(-1)]), of_rationals([Fraction(0)])  # 1 - sqrt 2
    problems.check_signs(given, SQRT2, [ROOT, negative, zero], "weights", "multiplier")
    for place, weights in enumerate(([negative, zero, zero], [zero, zero, negative])):
        with pytest.raises(CertificateRejected, match=r"a negative multiplier of an inequality") as error:
            problems.check_signs(given, SQRT2, weights, "weights", "multiplier")
        assert error.value.step == f"weights[{2 * place}]"


@each(
    (SADDLE, [], ["x", "y"], "the objective is not convex"),
    (LINE, [(SADDLE, "<=")], ["x", "y"], "a constraint that is not convex"),
    (LINE, [(DISC, "=")], ["x", "y"], "a nonlinear equation"),
    (LINE, [(DISC, ">=")], ["x", "y"], "expected <=, < or ="),
    (LINE, [], ["x", "x"], "distinct names"),
    (LINE, [], ["x", ""], "distinct names"),
)
def test_problems_that_are_not_convex(objective: Any, constraints: Any, names: list[str], reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        problem(objective, *constraints, names=names)


def test_numbers_and_rows_have_their_length() -> None:
    entry = Entry([["1"], ["0", "1"]], "point")
    assert problems.read_numbers(entry, SQRT2, 2) == [of_rationals([Fraction(1)]), ROOT]
    with pytest.raises(CertificateRejected, match="expected 3 numbers, found 2"):
        problems.read_numbers(entry, SQRT2, 3)
    assert problems.read_row(Entry(["1", "-2/3"], "row"), 2) == (1, Fraction(-2, 3))
    with pytest.raises(CertificateRejected, match="expected 1 numbers, found 2"):
        problems.read_row(Entry(["1", "2"], "row"), 1)

"""Arithmetic of convex problems over a number field: values, gradients, tangents, weighted sums."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from qe.errors import CertificateRejected
from qe.expert import convex_problem as problems
from qe.expert.arithmetic.field import RootField, constant
from qe.expert.convex_problem import Place, read_problem
from qe.expert.sentences import read_list
from qe.proof.entry import Entry
from tests.tables import each

SQRT2 = RootField(Entry({"minimal_polynomial": ["-2", "0", "1"], "interval": ["1", "2"]}, "field"))
ROOT = SQRT2.theta
HERE = Entry(None, "here")


def terms(*pairs: tuple[list[int], str]) -> list[Any]:
    return [[c, exponents] for exponents, c in pairs]


def problem(objective: Any, *constraints: tuple[Any, str], names: list[str] = ["x", "y"]) -> problems.Problem:
    listed = [{"terms": t, "relation": r} for t, r in constraints]
    return read_problem(Entry({"variables": names, "minimise": objective, "constraints": listed}, "problem"))


DISC = terms(([2, 0], "1"), ([0, 2], "1"), ([0, 0], "-4"))  # x^2 + y^2 - 4
SKEW = terms(([2, 0], "1"), ([1, 1], "1"), ([0, 2], "3"), ([1, 0], "-5"), ([0, 0], "7"))
LINE = terms(([1, 0], "1"), ([0, 1], "-2"), ([0, 0], "1"))  # x - 2 y + 1
SADDLE = terms(([1, 1], "1"))


def rational(*values: Fraction | int) -> list[Any]:
    return [constant(Fraction(v)) for v in values]


def at(given: problems.Problem, *values: Any) -> Place:
    return Place.of(given, SQRT2, [constant(Fraction(v)) if isinstance(v, Fraction | int) else v for v in values])


def test_values() -> None:
    """4 - 3 + 27/4 - 10 + 7, and the disc at (sqrt 2, sqrt 2)."""
    assert at(problem(LINE, (SKEW, "<=")), 2, Fraction(-3, 2)).values == rational(Fraction(19, 4))
    assert at(problem(LINE, (DISC, "<=")), ROOT, ROOT).values == rational(0)


def test_tangents() -> None:
    """At (2, 0) the disc gives 2x = 4, 2y = 0 and 4x = 8; a value of 5 there moves the last one."""
    place = at(problem(LINE, (DISC, "<="), (DISC, "<="), (LINE, "=")), 2, 0)
    found = [[SQRT2.reduced(c)[0] for c in e] for e in place.tangent(place.problem.forms[0], constant(Fraction(5)))]
    assert found == [[2, 0, -4], [0, 2, 0], [4, 0, -3]]
    assert len(place.tangents(rational(1, 0, 1))) == 3  # of what has no weight, and of equations, nothing is said


def test_stationary_points() -> None:
    """4*x on the disc of radius 2 is stationary at (-2, 0)."""
    place = at(problem(terms(([1, 0], "4")), (DISC, "<="), (LINE, "=")), -2, 0)

    def weighted(*weights: int, known: Any = (), objective: bool = True) -> Any:
        rows = [rational(*row) for row in known]
        return place.weighted(rational(*weights), rational(*[1] * len(known)), rows, HERE, with_objective=objective)

    weighted(1, 0)
    for wrong in (lambda: weighted(1, 0, objective=False), lambda: weighted(2, 0)):
        with pytest.raises(CertificateRejected, match="coordinate 1"):
            wrong()
    with pytest.raises(CertificateRejected, match="coordinate 2"):
        weighted(1, 0, known=[[0, 1, 0]])
    assert weighted(1, 1, known=[[-1, 2, 0]]) == rational(1)[0]  # of the line -1, and 2 of the equation
    with pytest.raises(CertificateRejected, match="an empty equation"):
        weighted(1, 0, known=[[0, 0, -1]])


def test_signs_of_weights() -> None:
    place = at(problem(LINE, (DISC, "<="), (LINE, "="), (LINE, "<")), 0, 0)
    negative = SQRT2.reduced(1 - ROOT)
    for where, weights in ((0, [negative, *rational(0, 0)]), (2, [*rational(0, 0), negative])):
        with pytest.raises(CertificateRejected, match="a negative weight of an inequality") as error:
            place.weighted(weights, [], [], HERE)
        assert error.value.step == f"here[{where}]"


@each(
    (SADDLE, [], ["x", "y"], "not convex"),
    (LINE, [(SADDLE, "<=")], ["x", "y"], "not convex"),
    (LINE, [(DISC, "=")], ["x", "y"], "a nonlinear equation"),
    (LINE, [(DISC, ">=")], ["x", "y"], "expected <=, < or ="),
    (LINE, [], ["x", "x"], "listed twice"),
    (LINE, [], ["x", ""], "without a name"),
)
def test_problems_that_are_not_convex(objective: Any, constraints: Any, names: list[str], reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        problem(objective, *constraints, names=names)


def test_numbers_and_rows_have_their_length() -> None:
    entry = Entry([["1"], ["0", "1"]], "point")
    assert read_list(entry, SQRT2.number, 2) == [*rational(1), ROOT]
    with pytest.raises(CertificateRejected, match="expected 3 numbers, found 2"):
        read_list(entry, SQRT2.number, 3)
    assert read_list(Entry(["1", "-2/3"], "row"), Entry.rational, 2) == [1, Fraction(-2, 3)]
    with pytest.raises(CertificateRejected, match="expected 1 numbers, found 2"):
        read_list(Entry(["1", "2"], "row"), Entry.rational, 1)

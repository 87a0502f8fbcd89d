"""The matrix by signs of factors: against the truth at points, however many levels are known."""

from fractions import Fraction

import pytest
from hypothesis import given, settings

from qe.decomposition.matrix import Test as Condition
from qe.decomposition.matrix import compile_matrix, join, mentioned, negate, specialise, strengthened
from qe.errors import InternalError
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj, convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import And, Formula
from qe.formula.traverse import polynomials
from qe.io.text import read
from tests.strategies import formulas, points
from tests.tables import each

NAMES = ("x", "y")
RING = Ring.of(NAMES)


def formula(text: str) -> Formula:
    return convert(read(text), RING)


def places_of(matrix: Formula) -> dict[Poly, tuple[int, int]]:
    """(level, index) of every factor."""
    found: dict[Poly, tuple[int, int]] = {}
    for p in polynomials(matrix):
        for f, _ in p.factors()[1]:
            found.setdefault(f, (f.level, sum(level == f.level for level, _ in found.values())))
    return found


def signs(places: dict[Poly, tuple[int, int]], point: dict[str, Fraction], level: int) -> dict[int, int]:
    values = {i: f.evaluate([point[n] for n in NAMES]) for f, (at, i) in places.items() if at == level}
    return {i: (v > 0) - (v < 0) for i, v in values.items()}


@settings(max_examples=80)
@given(formulas(names=NAMES, max_degree=3), points(NAMES))
def test_knowing_all_signs_is_knowing_the_truth(matrix: Formula, point: dict[str, Fraction]) -> None:
    places = places_of(matrix)
    node = compile_matrix(matrix, places)
    first = specialise(node, 0, signs(places, point, 0))
    assert not mentioned(first, 0)
    both = specialise(first, 1, signs(places, point, 1))
    assert both is holds_at(matrix, point)
    if isinstance(first, bool):
        assert first is both
    assert specialise(specialise(negate(node), 1, signs(places, point, 1)), 0, signs(places, point, 0)) is not both


def test_conditions_that_signs_cannot_decide_stay() -> None:
    matrix = formula("x*y^2 >= 0 and (x > 1 or y = 0)")
    places = places_of(matrix)
    node = compile_matrix(matrix, places)
    x, other = places[RING.gen(0)][1], places[formula("x = 1").poly][1]  # type: ignore[attr-defined]
    assert mentioned(node, 0) == {x, other} and mentioned(node, 1) == {0}
    assert specialise(node, 0, {x: 1, other: 1}) is True  # y^2 is not negative
    assert mentioned(specialise(node, 0, {x: -1, other: -1}), 1) == {0}
    assert specialise(node, 0, {}) == node


def test_an_even_power_alone() -> None:
    for text, known in (("y^2 >= 0", True), ("y^2 < 0", False)):
        matrix = formula(f"x*{text.split()[0]} {text.split()[1]} 0")
        places = places_of(matrix)
        assert specialise(compile_matrix(matrix, places), 0, {0: 1}) is known


def test_junctions_absorb() -> None:
    a, b = (Condition(((0, i, True),), frozenset((1,))) for i in (0, 1))
    assert join(True, (a, True, a)) == a and join(True, (a, False)) is False and join(True, ()) is True
    assert join(False, (a, True)) is True and join(False, (b, False)) == b and join(False, ()) is False
    assert join(True, (join(True, (a, b)), a)) == join(True, (a, b))


def test_what_is_no_matrix() -> None:
    with pytest.raises(InternalError):
        compile_matrix(read("ex x. x > y"), {})


@each(
    ("y^2 + x <= 0 and y > 1", "x <= 0"),
    ("y^2 + x < 0 and y > 1", "x < 0"),
    ("y^2 + x = 0 and y > 1", "x <= 0"),
    ("-y^2 + x >= 0 and y > 1", "x >= 0"),
    ("y^2 + x > 0 and y > 1", None),
    ("x*y^2 + 1 <= 0 and y > 1", None),  # the sign of the leading coefficient is not known
)
def test_discriminants_that_a_condition_implies(text: str, condition: str | None) -> None:
    matrix = formula(text)
    places = {RING.gen(0): (0, 0)}
    found = strengthened(matrix, (), places)
    assert found == (matrix if condition is None else conj((matrix, formula(condition))))
    assert strengthened(matrix, (), {}) == matrix  # only where its factors are listed


@settings(max_examples=40)
@given(formulas(names=NAMES, max_degree=2), points(NAMES))
def test_what_is_added_changes_no_truth(matrix: Formula, point: dict[str, Fraction]) -> None:
    everything = dict.fromkeys((RING.gen(0), RING.gen(0) + 1, RING.gen(0) - 1, RING.gen(0) + 2), (0, 0))
    found = strengthened(matrix, (), everything)
    assert holds_at(found, point) is holds_at(matrix, point)


def test_implied_equations_are_added() -> None:
    matrix = formula("y > 0 and y^3 = x")
    found = strengthened(matrix, (formula("y^2 + x = 0").poly,), {RING.gen(0): (0, 0)})  # type: ignore[attr-defined]
    assert isinstance(found, And)
    assert set(found.args) == {*matrix.args, formula("y^2 + x = 0"), formula("x <= 0")}  # type: ignore[attr-defined]

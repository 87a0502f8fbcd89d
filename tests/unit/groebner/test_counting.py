"""The number of real solutions as a function of the parameters, against isolation at points."""

from collections.abc import Callable
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.block_order import BlockOrder
from qe.exact.quotient import PositiveDimensional
from qe.exact.ring import Poly, Ring
from qe.formula.evaluate import holds_at, truth_under
from qe.formula.syntax import Relation
from qe.groebner.counting import SolutionCount
from qe.groebner.segment import Segment
from qe.groebner.signs import SignatureConditions
from qe.groebner.trace_form import row_scales
from qe.options import Budget
from tests.enough import sized
from tests.tables import each

ROOT_2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)


def test_the_cubic() -> None:
    found = qe.real_root_classification(["x^3 + p*x + q"], "x")
    assert [c.count for c in found] == [1, 2, 3]
    assert qe.equivalent(found.condition(3), "4*p^3 + 27*q^2 < 0")
    assert qe.equivalent(found.condition(2), "4*p^3 + 27*q^2 = 0 and p /= 0")


def test_a_circle_and_a_hyperbola() -> None:
    found = qe.real_root_classification(["x^2 + y^2 - r", "x*y - 1"], "x y")
    assert [(c.count, str(c.condition)) for c in found] == [(0, "r - 2 < 0"), (2, "r - 2 = 0"), (4, "r - 2 > 0")]


def test_degenerate_leading_coefficients() -> None:
    found = qe.real_root_classification(["a*x^2 + b*x + c"], "x")
    assert [c.count for c in found] == [0, 1, 2, None]
    assert found.at([0, 0, 0]) is None and found.at([0, 0, 1]) == 0 and found.at([0, 3, 1]) == 1
    assert found.at({"a": ROOT_2, "b": 2, "c": 1}) == 0 and found.at([1, 2 * ROOT_2, 2]) == 1
    with pytest.raises(qe.InputError, match="count"):
        found.condition(7)


def test_only_solutions_where_others_are_positive() -> None:
    found = qe.real_root_classification(["x^2 + b*x + c"], "x", positive=["x"])
    for b, c in product(range(-4, 5), repeat=2):
        expected = sum(r > 0 for r in _roots(b, c))
        assert found.at([b, c]) == expected


@each((["-1"], [0, 0]), (["0"], [0, 0]), (["-1", "1"], [0, 0]), (["2"], [0, 2]), (["2", "x"], [0, 1]))
def test_numbers_among_the_conditions_have_their_sign(positive: list[str], counts: list[int]) -> None:
    """-1 > 0 counted as if it held."""
    found = qe.real_root_classification(["x^2 - a"], "x", "a", positive=positive, process=False, check=True)
    assert [found.at([a]) for a in (-1, 4)] == counts


def _roots(b: int, c: int) -> set[float]:
    inside = b * b - 4 * c
    return set() if inside < 0 else {(-b + s * inside**0.5) / 2 for s in (1, -1)}


def test_constants_have_their_sign() -> None:
    found = qe.real_root_classification(["x^2 - w*a"], "x", constants={"w": -ROOT_2})
    assert [found.at([a]) for a in (-1, 0, 1)] == [2, 1, 0]


RING = Ring.of(("b", "a", "y", "x"))


@st.composite
def systems(draw: st.DrawFn) -> list[Poly]:
    """As many equations as variables, of degree 2, with a parameter here and there."""
    x, y, a, b = (RING.var(name) for name in "xyab")
    one = RING.constant(1)
    coefficients = st.sampled_from([one, -one, a, b, 2 * one, a - b, RING.constant(0)])
    first = x**2 + draw(coefficients) * y**2 + draw(coefficients) * y + draw(coefficients)
    second = draw(coefficients) * y**2 + draw(coefficients) * x * y + draw(coefficients) * y + x - draw(coefficients)
    return [first, second]


POINTS = [(Fraction(a, 2), Fraction(b)) for a in (-2, 0, 3) for b in (-1, 0, 3)]


@sized(4, 50, systems())
def test_the_count_is_that_of_isolation(polys: list[Poly]) -> None:
    """At every point exactly one class, with the number of solutions that are isolated there."""
    try:
        found = qe.real_root_classification(polys, "x, y", "a, b", process=False)
    except qe.Unable:
        return
    for point in POINTS:
        holding = [c.count for c in found if _holds(c.condition, found, point)]
        assert len(holding) == 1
        try:
            assert holding == [len(found.system.solutions_at(point))]
        except PositiveDimensional:
            assert holding == [None]


def _holds(condition: object, found: qe.RealRootClassification, point: tuple[Fraction, Fraction]) -> bool:
    from qe.formula.build import convert

    place = found.system.place(point)
    return bool(truth_under(convert(condition, place.ring), place.sign))  # type: ignore[arg-type]


@given(st.dictionaries(st.tuples(st.integers(0, 3), st.integers(0, 3)), st.integers(0, 5), max_size=8))
def test_rows_are_scaled_by_enough(powers: dict[tuple[int, int], int]) -> None:
    factor = RING.var("a")
    scales = row_scales({place: {factor: power} for place, power in powers.items()}, 4)
    for (i, j), power in powers.items():
        assert scales[i].get(factor, 0) + scales[j].get(factor, 0) >= power


ENTRIES = Ring.of(("z",))


@each(1, 2, 3, 4)
@settings(max_examples=10)
@given(data=st.data())
def test_sign_conditions_of_matrices(size: int, data: st.DataObject) -> None:
    """Any symmetric matrix, also with vanishing minors: the conditions hold for its signature alone."""
    from flint import fmpq_mat

    from qe.exact.quotient import signature

    numbers = data.draw(st.lists(st.integers(-1, 1), min_size=size * size, max_size=size * size))
    rows = [[numbers[min(i, j) * size + max(i, j)] for j in range(size)] for i in range(size)]
    matrix = fmpq_mat(size, size, [v for row in rows for v in row])
    minors = [fmpq_mat(k, k, [rows[i][j] for i in range(k) for j in range(k)]).det() for k in range(1, size + 1)]
    coefficients = list(reversed(matrix.charpoly().coeffs()))
    true = signature(matrix)
    for value in range(-size, size + 1):
        # the numbers stand behind powers of one variable, so that nothing is known in advance
        symbols = [ENTRIES.gen(0) ** (k + 1) for k in range(2 * size)]
        values = dict(zip(symbols, [*minors, *coefficients[1:]], strict=True))
        own, others = tuple(symbols[:size]), (ENTRIES.constant(1), *symbols[size:])
        conditions = SignatureConditions(own, lambda others=others: others)
        sign = {p: (v > 0) - (v < 0) for p, v in values.items()}
        assert truth_under(conditions.is_in({value}), lambda p, sign=sign: _sign_of(p, sign)) == (value == true)


def _sign_of(poly: Poly, signs: dict[Poly, int]) -> int:
    return signs[poly] if poly in signs else -signs[-poly]


CONDITIONS = [(Relation.GT, lambda v: v > 0), (Relation.GE, lambda v: v >= 0), (Relation.NE, lambda v: v != 0)]


@each(*CONDITIONS)
@pytest.mark.parametrize("a", range(-2, 4))
def test_solutions_with_a_condition(relation: Relation, holds: Callable[[int], bool], a: int) -> None:
    """x^2 = a^2 with x - 1 compared with 0: -|a| and |a|, one solution for a = 0."""
    ring = Ring.of(("a", "x"))
    segment = Segment(BlockOrder((1,), (0,)), (), (), (), (ring.var("x") ** 2 - ring.var("a") ** 2,))
    number = SolutionCount(segment, [(ring.var("x") - 1, relation)], Budget(60))
    expected = sum(holds(x - 1) for x in {-a, a})
    assert [k for k in range(number.most + 1) if holds_at(number.is_in({k}), {"a": a, "x": 0})] == [expected]
    assert holds_at(number.is_positive, {"a": a, "x": 0}) is (expected > 0)


def test_too_many_conditions_are_refused() -> None:
    ring = Ring.of(("a", "x"))
    x, a = ring.var("x"), ring.var("a")
    segment = Segment(BlockOrder((1,), (0,)), (), (), (), (x**3 - a,))
    with pytest.raises(qe.Unable, match="too many inequalities"):
        SolutionCount(segment, [(x - k, Relation.GT) for k in range(4)], Budget(60))

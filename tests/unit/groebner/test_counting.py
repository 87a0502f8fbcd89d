"""Counting real solutions, and the systems it goes through."""

import functools
import json
from collections.abc import Callable
from fractions import Fraction
from itertools import product
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_polynomial
from qe.exact.block_order import BlockOrder
from qe.exact.fglm import changed_order
from qe.exact.groebner import MonomialOrder, groebner_basis
from qe.exact.polynomial_system import LIMITS
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
from tests.unit.groebner.support import Place, places

# The number of real solutions as a function of the parameters, against isolation at points.

ROOT_2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)


def test_the_cubic() -> None:
    found = qe.real_root_classification(["x^3 + p*x + q"], "x")
    assert [c.count for c in found] == [1, 2, 3]
    assert qe.equivalent(found.condition(3), "4*p^3 + 27*q^2 < 0")
    assert qe.equivalent(found.condition(2), "4*p^3 + 27*q^2 = 0 and p /= 0")


def test_a_circle_and_a_hyperbola() -> None:
    found = qe.real_root_classification(["x^2 + y^2 - r", "x*y - 1"], "x y")
    assert [(c.count, str(c.condition)) for c in found] == [(0, "r < 2"), (2, "r = 2"), (4, "r > 2")]


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


# The arm of three joints whose comprehensive Groebner systems are published (arXiv 2305.12451): the same ideals.

LINES = {"F3": ("50 - 10*s", "25 + 75*s", "100 - 80*s"), "F4": ("10 + 30*s", "40 + 60*s", "80 - 60*s")}
VARIABLES = ("s7", "c7", "s4", "c4", "s1", "c1")
"""In this order the bases stay small: a tenth of a second, where the reverse takes a minute."""


@functools.cache
def system(
    length: int, line: tuple[str, str, str] | None, variables: tuple[str, ...] = VARIABLES, order: str = "grevlex"
) -> qe.ComprehensiveGroebnerSystem:
    x, y, z = line or ("x", "y", "z")
    polys = [
        f"{length}*c1*c4*s7 - 16*c1*c4 + {length}*c1*s4*c7 + 136*c1*s4 - 44*w*c1 + {x}",
        f"{length}*s1*c4*s7 - 16*s1*c4 + {length}*s1*s4*c7 + 136*s1*s4 - 44*w*s1 + {y}",
        f"-{length}*c4*c7 - 136*c4 + {length}*s4*s7 - 16*s4 - 104 - 44*w + {z}",
        *(f"c{k}^2 + s{k}^2 - 1" for k in (1, 4, 7)),
    ]
    return qe.comprehensive_groebner(polys, variables, order=order, constants={"w": ROOT_2})


def compared(ours: qe.ComprehensiveGroebnerSystem, published: list[dict[str, Any]]) -> int:
    """Points of the published segments: which segment of ours has them, and the leading monomials of the ideal there in
    the published order, c1 first. The number of points compared.
    """
    ring, block, random = ours.polys[0].ring, ours.block, Random(1)
    count = 0
    for entry in published:
        zero, nonzero = ([read(t, ours) for t in entry[key]] for key in ("Z", "N"))
        for place in places([*zero, ring.var("w") ** 2 - 2], [], nonzero, block.parameters, random)[:2]:
            (holding,) = [s for s in ours if place.satisfies(s.equal, s.nonzero, s.some)]
            one = ring.constant(0)
            assert place.ideal([*holding.basis, one], block) == place.ideal(ours.polys, block)
            assert leading(place, ours) == set(entry["leading_monomials"])
            count += 1
    return count


def read(text: str, ours: qe.ComprehensiveGroebnerSystem) -> Poly:
    ring = ours.polys[0].ring
    return read_polynomial(text, "entry", known=ring.names)[0].convert(ring)


def leading(place: Place, ours: qe.ComprehensiveGroebnerSystem) -> set[str]:
    """The leading monomials at a point in the lexicographic order with c1 first."""
    names = list(reversed(VARIABLES))
    special = place.ideal(ours.polys, ours.block)
    if len(special) == 1 and special[0].is_constant:
        return {"1"}
    inner = special[0].ring
    order = (*(inner.index[v] for v in names), 0)
    # it is one already: heavy variables before the generator of the field
    weights = (*(1033, 1031, 1021, 1019, 1013, 1009), 1)
    basis = groebner_basis(special, variables=order[-2::-1] + order[-1:], weights=weights, limits=LIMITS)
    assert basis is not None
    try:
        lex = changed_order(basis, MonomialOrder.LEX, order)
    except PositiveDimensional:
        direct = groebner_basis(special, variables=order, order=MonomialOrder.LEX, limits=LIMITS)
        assert direct is not None
        lex = direct
    heads = [lead[: len(names)] for lead in lex.leads]
    return {_name(e, names) for e in heads if any(e)}


def _name(exponents: tuple[int, ...], names: list[str]) -> str:
    parts = [n if k == 1 else f"{n}^{k}" for n, k in zip(names, exponents, strict=True) if k]
    return "*".join(parts)


@each(pytest.param("F3", marks=pytest.mark.deep), "F4")
def test_the_straight_lines(name: str, shared: Path) -> None:
    record = json.loads((shared / "corpora" / "ev3" / f"cgs_{name}_L120.json").read_text())
    assert compared(system(120, LINES[name]), record["segments"]) >= 3


@pytest.mark.deep
@each((120, "cgs_F1_L120"), (112, "cgs_F_L112"))
def test_the_whole_space(length: int, name: str, shared: Path) -> None:
    record = json.loads((shared / "corpora" / "ev3" / f"{name}.json").read_text())
    assert compared(system(length, None), record["segments"]) >= 10


def test_the_number_of_solutions_at_points(shared: Path) -> None:
    ours = system(120, LINES["F4"])
    assert [len(ours.solutions_at([s])) for s in (0, "1/3", 1)] == [4, 4, 4]
    assert ours.at(["-1/3"]).dimension == 0


PUBLISHED = tuple(reversed(VARIABLES))
MIXED = ["c1", "s7", "s1", "c7", "c4", "s4"]


@each(
    (PUBLISHED, "grevlex", LINES["F4"]),
    pytest.param(PUBLISHED, "lex", LINES["F4"], marks=pytest.mark.deep),
    pytest.param(PUBLISHED, "lex", None, marks=pytest.mark.deep),
    pytest.param(PUBLISHED, "grevlex", None, marks=pytest.mark.deep),
    pytest.param(MIXED, "grevlex", None, marks=pytest.mark.deep),
    pytest.param(VARIABLES, "lex", None, marks=pytest.mark.deep),
)
def test_other_orders_of_the_variables(variables: list[str], order: str, line: tuple[str, str, str] | None) -> None:
    """Out of reach for Buchberger's algorithm alone: the same solutions as in the order in which it is quick."""
    ours = system(120, line, variables, order)
    points: list[list[object]] = [["1/3"], [1]] if line else [[10, 40, 80], ["599/66", "824/33", "323/10"]]
    assert [len(ours.solutions_at(p)) for p in points] == [4, 4]
    for zero in ours.solutions_at(points[0]):
        values = [float(zero.values[name]) for name in ("c1", "s1")]
        assert values[0] ** 2 + values[1] ** 2 == pytest.approx(1)


@each(
    ("a > 0", {0: "b^2 < 4*a*c", 1: "b^2 = 4*a*c", 2: "b^2 > 4*a*c"}),
    ("a = 0 and b /= 0", {1: "true"}),
    ("a >= 1 and b^2 < 4*a*c", {0: "true"}),
    ("c = 0 and a*b > 0", {2: "true"}),
)
def test_a_classification_under_assumptions(known: str, classes: dict[int, str]) -> None:
    found = qe.real_root_classification(["a*x^2 + b*x + c"], "x", assuming=known, check=True)
    plain = qe.real_root_classification(["a*x^2 + b*x + c"], "x")
    assert {one.count for one in found} == {*classes} and qe.verify(found.certificate).accepted
    for one in found:
        assert qe.equivalent(one.condition, classes[one.count], assuming=known)
        assert qe.equivalent(one.condition, plain.condition(one.count), assuming=known)
    system = qe.comprehensive_groebner(["a*x^2 + b*x + c"], "x", assuming=known)
    assert len(system) == 1 and qe.decide(f"ex a, b, c. {known}")
    for wrong in ("x > 0", "ex y. y > a"):
        with pytest.raises(qe.InputError, match="assuming"):
            qe.comprehensive_groebner(["a*x^2 + b*x + c"], "x", assuming=wrong)

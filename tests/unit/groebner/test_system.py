"""Comprehensive Groebner systems as objects: points, membership, constants, faithful bases, forms, bad input."""

import json
import pickle
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.block_order import BlockOrder, parametric_basis
from qe.exact.groebner import MonomialOrder
from qe.exact.quotient import PositiveDimensional
from qe.exact.ring import Poly, Ring
from qe.formula.evaluate import holds_at
from qe.groebner.system import condition_of, exact_number
from tests.tables import each
from tests.unit.exact.ideal_membership import in_ideal
from tests.unit.groebner.support import Place, places

ROOT_2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)
TWO_LINES = ["a*x + y - 1", "x + a*y - 1"]


def test_two_lines() -> None:
    system = qe.comprehensive_groebner(TWO_LINES, "x, y", "a")
    assert system.at([1]).dimension == 1 and system.at([-1]).is_unit and system.at([5]).dimension == 0
    assert [str(p) for p in system.basis_at({"a": 1})] == ["Poly(y + x - 1)"]
    (zero,) = system.solutions_at([Fraction(1, 2)])
    assert zero.values["x"] == Fraction(2, 3) and zero.values["y"] == Fraction(2, 3)


def test_membership() -> None:
    system = qe.comprehensive_groebner(TWO_LINES, "x, y", "a")
    x, y = (system.polys[0].ring.var(name) for name in "xy")
    assert system.contains(x - y, [3]) and not system.contains(x - y, [1])
    assert system.contains(x + y - 1, [1]) and system.contains(x, [-1])


def test_membership_of_text_and_of_polynomials_of_other_rings() -> None:
    """The variables of a polynomial were taken for those that stand at the same places in the system."""
    system, other = qe.comprehensive_groebner(TWO_LINES, "x, y", "a"), Ring.of(("y", "x", "a"))
    assert system.contains(other.var("x") - other.var("y"), [3]) and not system.contains(2 * other.var("x"), [3])
    assert system.contains("(a^2 - 1)*x - a + 1", [3]) and not system.contains("x", [7])
    with pytest.raises(qe.InputError, match="q found"):
        system.contains("q*x", [7])


def test_a_constant_is_a_number() -> None:
    system = qe.comprehensive_groebner(["w*x - a", "x^2 - b"], "x", constants={"w": ROOT_2})
    assert system.parameters == ("a", "b")
    assert system.at([2, 2]).dimension == 0 and system.at([2, 3]).is_unit
    assert [z.values["x"] for z in system.solutions_at([2, 2])] == [ROOT_2]
    assert [z.values["x"] for z in system.solutions_at([-2, 2])] == [-ROOT_2]
    # an algebraic point that the constant alone cannot write
    cube_root = qe.RealAlgebraic.from_root([-2, 0, 0, 1], 1, 2)
    assert system.at([ROOT_2 * cube_root, cube_root * cube_root]).dimension == 0
    assert system.at([cube_root, cube_root]).is_unit


def test_dependent_irrational_numbers_at_a_point() -> None:
    # a = w: the leading coefficient a - w vanishes, though a^2 - 2 and w^2 - 2 alone would not say so
    system = qe.comprehensive_groebner(["(a - w)*x - 1"], "x", constants={"w": ROOT_2})
    assert system.at([ROOT_2]).is_unit and system.basis_at([ROOT_2])[0].is_constant
    (zero,) = system.solutions_at([-ROOT_2])
    assert float(zero.values["x"]) == pytest.approx(-1 / 8**0.5)


def test_a_factor_that_vanishes_for_conjugates_only() -> None:
    system = qe.comprehensive_groebner(["(a + w)*x + b"], "x", constants={"w": ROOT_2})
    assert [str(p) for p in system.basis_at([ROOT_2, 0])] == ["Poly(x)"]
    assert [z.values["x"].sign() for z in system.solutions_at([ROOT_2, 0])] == [0]
    with pytest.raises(PositiveDimensional):
        system.solutions_at([-ROOT_2, 0])


def test_faithful_elements_are_in_the_ideal_and_agree_on_the_segment() -> None:
    texts = ["a*x - b", "b*y - a", "c*x^2 - y", "c*y^2 - x"]
    system = qe.comprehensive_groebner(texts, "x y", faithful=True)
    for segment in system:
        assert segment.faithful is not None and len(segment.faithful) == len(segment.elements)
        for f, g in zip(segment.faithful, segment.elements, strict=True):
            assert in_ideal(f, system.polys)
            scale = _ratio(f, g)
            assert in_ideal(f - scale * g, segment.equal) if segment.equal else f == scale * g


def _ratio(f: Poly, g: Poly) -> int:
    """The integer s with f = s*g modulo the equations of a segment."""
    lead = max(g.terms())
    return dict(f.terms()).get(lead[0], lead[1]) // lead[1] or 1


def test_written_forms() -> None:
    system = qe.comprehensive_groebner(TWO_LINES, "x, y", "a", "lex")
    data = json.loads(system.to_json())
    assert data["order"] == "lex" and len(data["segments"]) == len(system) == 3
    assert data["segments"][0]["leading"] == ["y", "x"]
    assert system.to_latex().count(r"\hline") == 2
    assert "no solutions" in system.to_html() and "<math" in system.to_html()
    assert str(system).splitlines()[0].endswith(":")
    assert pickle.loads(pickle.dumps(system)).to_json() == system.to_json()


def test_a_system_that_was_used_can_be_sent_on() -> None:
    system = qe.comprehensive_groebner(["a*x^2 - 1", "a^2*x - 1"], "x")
    x = system.polys[0].ring.var("x")
    before = system.contains(x - 1, [1])
    assert pickle.loads(pickle.dumps(system)).contains(x - 1, [1]) == before


def test_conditions_on_the_parameters() -> None:
    system = qe.comprehensive_groebner(["a*x - 1"], "x", equal=["a^2 - 1"], nonzero=["a - 1"])
    assert len(system) == 1 and system.at([-1]).dimension == 0
    for nothing in (system, qe.real_root_classification(["a*x - 1"], "x", equal=["a^2 - 1"], nonzero=["a - 1"])):
        with pytest.raises(qe.InputError, match="none of `nonzero`"):
            nothing.at([1])


@each(
    (([], "x"), "at least one polynomial"),
    ((["x - a"], "x, a", "a"), "a found twice"),
    ((["x - a"], "x, x"), "x found twice"),
    ((["x - a"], "x", "b"), "a found"),
    ((["x - a"], []), "at least one variable"),
    ((["x - "], "x"), "a polynomial expected"),
    (("x - a", "x"), "polys: a list of polynomials"),
    ((5, "x"), "polys: a list of polynomials"),
)
def test_bad_input_is_named_in_one_line(arguments: tuple[object, ...], message: str) -> None:
    with pytest.raises(qe.InputError, match=message) as caught:
        qe.comprehensive_groebner(*arguments)  # type: ignore[arg-type]
    assert "\n" not in str(caught.value)


def test_the_argument_with_an_unknown_name_is_named() -> None:
    with pytest.raises(qe.InputError, match="positive: variables and parameters as listed expected, q found"):
        qe.real_root_classification(["x^2 - a"], "x", "a", positive=["q"])


def test_questions_at_a_point_take_a_limit() -> None:
    system, found = qe.comprehensive_groebner(["x - a"], "x"), qe.real_root_classification(["x - a"], "x")
    assert system.at([1], timeout=60).dimension == 0 and system.contains("x - a", [1], timeout=60)
    assert found.at([1], timeout=60) == 1
    for ask in (system.at, found.at):
        with pytest.raises(qe.InputError, match="timeout"):
            ask([1], timeout=0)


def test_bad_points() -> None:
    system = qe.comprehensive_groebner(["x - a"], "x")
    for point in ([], [1, 2], {"b": 1}, {"a": 1, "b": 2}, ["one"], [float("nan")]):
        with pytest.raises(qe.InputError, match="point"):
            system.at(point)


ORDERS = st.sampled_from(list(MonomialOrder))
RING = Ring.of(("b", "a", "y", "x"))


@st.composite
def systems(draw: st.DrawFn) -> list[Poly]:
    """Two or three sparse polynomials of low degree in x, y with parameters a, b."""
    exponents = st.tuples(*(st.integers(0, 1),) * 2, *(st.integers(0, 2),) * 2).filter(lambda e: sum(e) <= 3)
    terms = st.dictionaries(exponents, st.integers(-3, 3).filter(bool), min_size=1, max_size=3)
    found = draw(st.lists(terms, min_size=1, max_size=3))
    return [RING.from_terms(t) for t in found]


@settings(max_examples=20)
@given(systems(), ORDERS, st.randoms(use_true_random=False))
def test_segments_are_disjoint_cover_and_specialise(polys: list[Poly], order: MonomialOrder, random) -> None:
    name = {MonomialOrder.LEX: "lex", MonomialOrder.DEGLEX: "grlex"}.get(order, "grevlex")
    system = qe.comprehensive_groebner(polys, "x, y", "a, b", name, process=False)
    special = [p for s in system for p in places(s.equal, s.nonzero, s.some, system.block.parameters, random)[:1]]
    for place in [*special, *places([], [], [], system.block.parameters, random)]:
        (segment,) = [s for s in system if place.satisfies(s.equal, s.nonzero, s.some)]
        check(place, system, segment)


def check(place: Place, system: qe.ComprehensiveGroebnerSystem, segment: object) -> None:
    zero = system.polys[0].ring.constant(0)
    basis = segment.basis  # type: ignore[attr-defined]
    assert place.ideal([*basis, zero], system.block) == place.ideal(system.polys, system.block)
    assert set(segment.leads) == place.leads(system.polys, system.block)  # type: ignore[attr-defined]


def test_the_order_of_the_variables_is_checked_on_each_basis() -> None:
    x, y, a = RING.var("x"), RING.var("y"), RING.var("a")
    block = BlockOrder((RING.index["x"], RING.index["y"]), (RING.index["a"],), MonomialOrder.LEX)
    # y^40 < x in the lexicographic order, whatever weights would say
    basis = parametric_basis([x - a * y**40, y**41 - a], block)
    assert {block.lead(p)[0] for p in basis} == {(1, 0), (0, 41)}


def test_conditions_and_numbers() -> None:
    system = qe.comprehensive_groebner(TWO_LINES, "x, y", "a")
    assert {str(condition_of(s)) for s in system} == {str(system.condition(s)) for s in system}
    for a in range(-3, 4):
        assert [holds_at(condition_of(s), dict.fromkeys(system.polys[0].ring.names, a)) for s in system].count(
            True
        ) == 1
    assert exact_number(ROOT_2, "it") == ROOT_2 and exact_number(ROOT_2 * ROOT_2, "it") == Fraction(2)
    assert isinstance(exact_number(ROOT_2 * ROOT_2, "it"), Fraction) and exact_number("1/3", "it") == Fraction(1, 3)
    with pytest.raises(qe.InputError, match="it"):
        exact_number(object(), "it")

"""Control points: systems of conditions, and the statements of them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import qe
from bezier.curves.scalar import sign
from bezier.curves.workspace import HalfSpace, Workspace, WorkspaceKind
from bezier.methods.control.statements import (
    Statement,
    Term,
    at_most,
    atomic,
    bracketed,
    combined,
    difference,
    every,
    for_all,
    grouped,
    implies,
    minus,
    name,
    names,
    number,
    power,
    product,
    some,
    total,
)
from bezier.methods.control.statements import exists as some_values
from bezier.methods.control.terms import condition_terms, objective_terms
from bezier.methods.cubic import formula as cubic
from bezier.methods.quadratic import formula as quadratic
from bezier.problem import INNER, PlanMethod, PointCondition, Problem
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Relation
from qe.io import text
from qe.io.text import read, read_polynomial
from tests.bezier.made import points

POINT = points(3, st.integers(-3, 3).map(Fraction))
SYSTEMS = {PlanMethod.QUADRATIC: quadratic.system, PlanMethod.CUBIC: cubic.system}


@st.composite
def systems(draw):
    """A system with every kind of condition."""
    method = draw(st.sampled_from(sorted(SYSTEMS, key=str)))
    q0, r0, normal = draw(POINT), draw(POINT), draw(POINT.filter(any))
    extra = PointCondition(HalfSpace(normal, draw(st.integers(-4, 4).map(Fraction)), "half_space[0]"), INNER[method])
    cubic_only = {"ratio": draw(st.sampled_from([Fraction(1), Fraction(1, 2), Fraction(3)]))}
    if q0 != r0:
        cubic_only["join_speed"] = Fraction(1, 2)
    problem = Problem(
        method,
        Workspace(WorkspaceKind.HEMISPHERE, Fraction(draw(st.integers(1, 20)))),
        start=q0,
        via=(q0, r0),
        goal=r0,
        radius_is_auto=False,
        half_spaces=(extra,),
        **(cubic_only if method is PlanMethod.CUBIC else {}),
    )
    return SYSTEMS[method](problem)


CHOICE = st.lists(points(), min_size=2, max_size=2)


def at(system, choice):
    """All control points for as many free ones as there are, and their coordinates in order."""
    free = choice[: len(system.shape.free)]
    return system.points(free), [c for p in free for c in p]


def value(terms, coordinates):
    total = Fraction(0)
    for exponents, coefficient in terms.items():
        for c, k in zip(coordinates, exponents, strict=True):
            coefficient *= c**k
        total += coefficient
    return total


@given(systems(), CHOICE)
def test_polynomials_are_the_margins(system, choice):
    control, coordinates = at(system, choice)
    assert value(objective_terms(system), coordinates) == system.objective_at(control)
    for item in system.conditions:
        assert value(condition_terms(system, item), coordinates) == -item.condition.margin(control[item.point])


@given(systems(), CHOICE)
def test_the_text_says_the_same(system, choice):
    control, coordinates = at(system, choice)
    place = dict(zip(system.shape.variables, coordinates, strict=True))
    assert holds_at(text.read(str(system.in_free_points())), place) == (not system.violated(control))
    dependent = {f"{p.lower()}{a}": c for p in system.shape.follows for a, c in zip("xyz", control[p], strict=True)}
    assert holds_at(text.read(str(system.statement())).body, place | dependent) == (not system.violated(control))


@given(systems(), CHOICE)
def test_conditions_seen_by_a_free_point(system, choice):
    control, _ = at(system, choice)
    for free in system.shape.free:
        involved = [i for i in system.conditions if any(name == free for _, name in system.shape.combination(i.point))]
        seen = system.seen_by(free, control)
        assert [c.name for c in seen] == [item.label for item in involved]
        for condition, item in zip(seen, involved, strict=True):
            assert sign(condition.margin(control[free])) == sign(item.condition.margin(control[item.point]))


@pytest.mark.parametrize("method", SYSTEMS)
def test_labels_are_distinct_and_active_ones_are_on_the_boundary(method):
    up = (Fraction(0), Fraction(0), Fraction(1))
    origin = (Fraction(0),) * 3
    extra = PointCondition(HalfSpace(up, Fraction(0), "half_space[0]"), ("Q1",))
    workspace = Workspace(WorkspaceKind.HEMISPHERE, Fraction(4))
    system = SYSTEMS[method](Problem(method, workspace, up, (up, origin), up, False, half_spaces=(extra,)))
    labels = [item.label for item in system.conditions]
    assert len(set(labels)) == len(labels)
    control, _ = at(system, [(Fraction(2), Fraction(0), Fraction(0)), up])
    assert {"Q1", "Q1.z", "Q1.half_space[0]"} <= set(system.active(control))


NAMES = st.sampled_from(["q1x", "q1y", "r", "t"])
NUMBERS = st.fractions(min_value=-5, max_value=5, max_denominator=4)


def _larger(inner: st.SearchStrategy[Term]) -> st.SearchStrategy[Term]:
    several = st.lists(inner, min_size=1, max_size=3)
    return st.one_of(
        several.map(total),
        several.map(lambda parts: product(*parts)),
        inner.map(minus),
        inner.map(bracketed),
        st.builds(power, inner, st.integers(0, 3)),
    )


TERMS = st.recursive(st.one_of(NUMBERS.map(number), NAMES.map(name)), _larger, max_leaves=8)
ATOMS = st.builds(atomic, TERMS, st.sampled_from(Relation), TERMS)


def _joined(inner: st.SearchStrategy[Statement]) -> st.SearchStrategy[Statement]:
    several = st.lists(inner, min_size=1, max_size=3)
    bound = st.lists(NAMES, min_size=1, max_size=2, unique=True).map(tuple)
    return st.one_of(
        several.map(lambda parts: some(*parts)),
        several.map(lambda parts: grouped(*parts)),
        several.map(lambda parts: grouped(every(*parts))),
        st.builds(for_all, bound, inner),
        st.builds(some_values, bound, inner),
        st.builds(implies, inner, inner),
    )


STATEMENTS = st.recursive(ATOMS, _joined, max_leaves=6)


@given(TERMS)
def test_a_term_is_what_its_text_means(term: Term) -> None:
    poly, factor = term.polynomial
    read_poly, read_factor = read_polynomial(str(term))
    assert poly.ring.names == read_poly.ring.names, str(term)
    assert [(e, c * factor) for e, c in poly.terms()] == [(e, c * read_factor) for e, c in read_poly.terms()], str(term)


@given(STATEMENTS)
def test_a_statement_is_what_its_text_means(statement: Statement) -> None:
    found, meant = statement.formula, read(str(statement))
    assert found == meant, str(statement)
    assert (found.ring is None) == (meant.ring is None) and (found.ring is None or found.ring.names == meant.ring.names)


def test_how_people_read_it() -> None:
    x, y = names(("q1x", "q1y"))
    assert str(combined([(Fraction(2), number(3)), (Fraction(-1), x)])) == "2*3 - q1x"
    assert str(combined([(Fraction(-1), x), (Fraction(1, 2), y)])) == "-q1x + (1/2)*q1y"
    assert str(power(difference(x, number(-3)), 2)) == "(q1x - (-3))^2"
    assert str(bracketed(number(-3))) == "(-3)" and str(bracketed(number(3))) == "(3)"
    inside = at_most(x, number(1))
    assert str(implies(every(inside, inside), inside)) == "q1x <= 1 and q1x <= 1 -> q1x <= 1"


@pytest.mark.parametrize("pair", [("2*x", Fraction(1)), (1, 2), (1, 2, 3)])
def test_only_a_polynomial_with_a_rational_factor_is_a_pair(pair: Any) -> None:
    with pytest.raises(qe.InputError):
        qe.minimize(pair, "x >= 0")


@given(NUMBERS, st.integers(1, 5))
def test_the_least_value_of_a_polynomial_with_a_factor(place: Fraction, below: int) -> None:
    x = name("x")
    aim = product(number(Fraction(1, below)), power(difference(x, number(place)), 2))
    found = qe.minimize(aim.polynomial, at_most(x, number(place - 1)).formula)
    assert found.value == Fraction(1, below) == qe.minimize(str(aim), str(at_most(x, number(place - 1)))).value
    assert qe.verify(found.certificate).accepted


def test_a_sum_is_taken_away_as_a_whole() -> None:
    x, y, t = names(("x", "y", "t"))
    away = total((x, minus(total((y, t))), total((t, y))))
    assert str(away) == "x - (y + t) + (t + y)" and str(product(total((x, y)), minus(t))) == "(x + y)*(-t)"
    assert away.polynomial == (x.polynomial[0].convert(away.polynomial[0].ring), Fraction(1))


def test_bound_names_come_after_the_free_ones() -> None:
    x, r = names(("x", "r"))
    asked = some_values(("x",), every(at_most(x, number(1)), at_most(r, x)))
    assert asked.formula.ring.names == ("r", "x") == read(str(asked)).ring.names

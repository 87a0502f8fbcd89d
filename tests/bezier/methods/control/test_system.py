"""Control points that follow from free ones: text, polynomials and exact values say the same."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bezier.curves.scalar import sign
from bezier.curves.workspace import HalfSpace, Workspace, WorkspaceKind
from bezier.methods.control.terms import condition_terms, objective_terms
from bezier.methods.cubic import formula as cubic
from bezier.methods.quadratic import formula as quadratic
from bezier.problem import INNER, PlanMethod, PointCondition, Problem
from qe.formula.evaluate import holds_at
from qe.io import text
from tests.bezier.numbers import points

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

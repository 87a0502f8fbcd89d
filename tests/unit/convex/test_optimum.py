"""Small convex problems, one for each thing that can happen; the conditions of optimality; strict conditions."""

from fractions import Fraction
from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.certify.verify import verify
from qe.convex.kkt import Kkt, kkt_point, sign
from qe.convex.minimise import solve
from qe.convex.optimum import NotConvex, Optimum, OptimumStatus, maximize, minimize
from qe.convex.strict import settle_strict
from qe.convex.system import ConvexSystem, read_system
from qe.errors import BudgetExceeded, InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import NumberField
from qe.exact.kkt_system import Point
from qe.exact.quadratic_form import Quadratic
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.io.lowering import lower_term
from qe.io.text import read, read_term
from qe.options import Budget
from qe.proof.multipliers import FormRelation, OptimumEvidence
from tests.tables import each
from tests.unit.convex.quadratics import ball, diagonal, line

RING, OTHER = Ring.of(("x", "y", "z")), Ring.of(("b", "x"))


X, Y, Z = (RING.gen(i) for i in range(3))


LE, LT, EQ, GE, GT = Relation.LE, Relation.LT, Relation.EQ, Relation.GE, Relation.GT


def _all(*pairs) -> Formula:
    return conj(atom(p, relation) for p, relation in pairs)


def _solved(objective, constraints: Formula, **options) -> Optimum:
    """The optimum, with its certificate checked."""
    found = minimize(objective, constraints, **options)
    assert verify(found.certificate).accepted
    return found


BALL, SECOND = X * X + Y * Y - 1, (X - 2) * (X - 2) + Y * Y - 1


INFEASIBLE, UNBOUNDED = {"status": OptimumStatus.INFEASIBLE, "value": None}, {"status": OptimumStatus.UNBOUNDED}


@each(
    {
        "no constraints": (
            X * X + Y * Y - X,
            TRUE,
            {"point": {"x": F(1, 2), "y": 0}, "value": F(-1, 4), "unique": True},
        ),
        "redundant active constraints of a linear program": (
            X + Y,
            _all((X, GE), (Y, GE), (X + Y, GE), (X + 2 * Y, GE), (X - 4, LE)),
            {"value": 0, "point": {"x": 0, "y": 0}, "active": (0, 1, 2, 3)},
        ),
        "equations, eliminated exactly": (
            X * X + Y * Y + Z * Z,
            _all((X + Y + Z - 1, EQ), (X - 2 * Y, EQ)),
            {"point": {"x": F(3, 7), "y": F(3, 14), "z": F(5, 14)}, "value": F(5, 14), "unique": True},
        ),
        "contradictory equations": (X, _all((X - 1, EQ), (X + Y - 2, EQ), (X - Y - 1, EQ)), INFEASIBLE),
        "nothing satisfies false": (X * X, FALSE, INFEASIBLE),
        "disjoint balls: the point where the larger violation is least": (
            X,
            _all((BALL, LE), ((X - 3) * (X - 3) + Y * Y - 1, LE)),
            {**INFEASIBLE, "point": {"x": F(3, 2), "y": 0}},
        ),
        "one point between tangent balls": ((X - 5) * (X - 5) + Y * Y, _all((BALL, LE), (SECOND, LE)), {"value": 16}),
        "infeasible on a face": (Y, _all((BALL, LE), (SECOND, LE), (X + Y - 2, GE)), INFEASIBLE),
        "a strict constraint that does not matter": (
            X * X + Y * Y,
            _all((X - 1, GE), (Y - 1, LT)),
            {"attained": True, "value": 1},
        ),
        "strict bounds without a point": (X + Y, _all((X, LT), (X, GE)), INFEASIBLE),
        "an open ball that only touches": (X + Y, _all((BALL, LT), (SECOND, LE)), INFEASIBLE),
        "an equation against a strict bound": (X + Y, _all((X, EQ), (X, LT)), INFEASIBLE),
        "a strict bound that misses a single point": (X + Y, _all((X * X + Y * Y, LE), (X + Y, GT)), INFEASIBLE),
        "unbounded in a parabola": (X * X + Y, TRUE, UNBOUNDED),
        "unbounded without constraints": (X, TRUE, UNBOUNDED),
        "a ball of radius zero": (X + Y, _all((X * X + Y * Y, LE)), {"value": 0, "point": {"x": 0, "y": 0}}),
        "a tangent": (X, _all((BALL, LE), (Y - 1, EQ)), {"value": 0, "point": {"x": 0, "y": 1}}),
        "half-planes that meet in a line": (X, _all((Y, GE), (Y, LE), (X - 3, GE)), {"value": 3}),
        "an open half-line": (X, _all((X - 2, GT)), {"attained": False, "value": 2}),
        "bounds that exclude each other": (X, _all((X - 1, GT), (X - 1, LT)), INFEASIBLE),
        "objective and constraints of different rings": (
            X * X,
            conj((atom(OTHER.var("x") - OTHER.var("b"), GE), atom(OTHER.var("b") - 2, GE))),
            {"value": 4},
        ),
    }
)
def test_what_can_happen(objective: Poly, constraints: Formula, expected: dict[str, object]) -> None:
    found = _solved(objective, constraints)
    assert {name: getattr(found, name) for name in expected} == expected


def test_scale_and_maximum() -> None:
    assert minimize(X * X - X, TRUE, scale=F(2, 3)).value == F(-1, 6)
    found = maximize(2 * X + Y, _all((X * X + Y * Y - 5, LE)))
    assert found.value == 5 and found.point == {"x": 2, "y": 1}


def test_sides_of_a_constraint_may_be_given_either_way() -> None:
    below = _solved(Y, _all((X * X + Y * Y - 2, LE), (X - 1, GE)))
    above = _solved(Y, _all((2 - X * X - Y * Y, GE), (1 - X, LE)))
    assert below.point == above.point == {"x": 1, "y": -1}
    assert below.active == (0, 1) and below.constraints[1].startswith("x - 1")


def test_many_optimal_points() -> None:
    found = _solved(X, _all((X * X + Y * Y - 4, LE), (Z * Z - 2, LE)))
    assert found.value == -2 and found.unique is False
    assert found.point["x"] == -2 and found.point["z"] == 0


def test_tangent_balls_leave_one_point() -> None:
    across = _solved(Y, _all((BALL, LE), (SECOND, LE)))  # no multipliers: the gradients at (1, 0) are horizontal
    assert across.point == {"x": 1, "y": 0} and len(across.evidence.faces) == 1


def test_face_of_positive_dimension_and_an_irrational_optimum_on_it() -> None:
    found = _solved(Y + Z, _all((BALL, LE), (SECOND, LE), (Z * Z - 2, LE)))
    assert found.value == found.point["z"] and found.value * found.value == 2 and found.value < 0


def test_faces_of_faces() -> None:
    # x = 0 and y^2 <= x say x = y = 0 in one face; only then does z^2 <= y say z = 0
    found = _solved(X + Y + Z, _all((X, GE), (X, LE), (Y * Y - X, LE), (Z * Z - Y, LE)))
    assert found.value == 0 and found.point == {"x": 0, "y": 0, "z": 0}
    assert len(found.evidence.faces) == 2


def test_infimum_that_is_not_attained() -> None:
    found = _solved(X, _all((X * X + Y * Y - 1, LT)))
    assert found.status is OptimumStatus.OPTIMAL
    assert found.attained is False and found.value == -1
    inner = found.evidence.inner_point
    assert inner[0] * inner[0] + inner[1] * inner[1] < 1


def test_unbounded_along_a_ray() -> None:
    found = _solved(X, _all((Y - 1, LE), (Z - X, LE)))
    assert found.status is OptimumStatus.UNBOUNDED and found.direction["x"] < 0


def test_unbounded_along_a_parabola_only_is_not_guessed() -> None:
    with pytest.raises(Unable):
        minimize(X, _all((X * X - Y, LE)))


@each(
    (X * Y, TRUE),
    (-X * X, TRUE),
    (X**3, TRUE),
    (X, _all((X * X + Y * Y - 1, GE))),
    (X, _all((X * X + Y * Y - 1, EQ))),
    (X, _all((X**4 - 1, LE))),
    (X, atom(X, Relation.NE)),
    (X, disj((atom(X, GE), atom(Y, GE)))),
)
def test_what_is_not_convex_is_refused(objective, constraints: Formula) -> None:
    with pytest.raises(NotConvex):
        minimize(objective, constraints)


def test_budget_is_respected() -> None:
    with pytest.raises(BudgetExceeded):
        minimize(X * X, _all((X - 1, GE)), budget=Budget(0.0))


def least(objective: Quadratic, *forms: Quadratic) -> Kkt | None:
    return kkt_point(objective, forms, budget=Budget(60))


def proves(objective: Quadratic, forms: tuple[Quadratic, ...], found: Kkt) -> bool:
    """The theorem's conditions, with everything recomputed."""
    slope = objective.slope(found.point)
    for i, m in found.multipliers.items():
        slope = [a + m * b for a, b in zip(slope, forms[i].slope(found.point))]
    complementary = all(not sign(forms[i].value(found.point)) for i in found.multipliers)
    return (
        all(sign(m) > 0 for m in found.multipliers.values())
        and complementary
        and not any(map(sign, slope))
        and all(sign(g.value(found.point)) <= 0 for g in forms)
    )


def test_signs() -> None:
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    assert [sign(v) for v in (Fraction(-1, 3), Fraction(0), Fraction(2))] == [-1, 0, 1]
    assert [sign(v) for v in (root - 2, root - root, root - 1)] == [-1, 0, 1]


@each(
    (ball((3, 0), 0), (), 0, True),
    (ball((3, 0), 0), (ball((0, 0), 1),), 4, True),
    (line(1, 1), (ball((0, 0), 2),), -2, True),
    (line(1, 0), (line(-1, 0, constant=2),), 2, False),  # a whole line of minima
    (diagonal(1, 0), (line(0, 1, constant=-5),), 0, False),
    (line(1, 1), (line(-1, 0), line(0, -1)), 0, True),
    (line(1, 0), (line(-1, 0), line(-1, -1), line(-1, 1)), 0, None),  # three lines through the minimum
)
def test_least_values(objective: Quadratic, forms: tuple[Quadratic, ...], value: int, unique: bool | None) -> None:
    found = least(objective, *forms)
    assert found is not None and objective.value(found.point) == value
    assert proves(objective, forms, found)
    assert found.unique is unique or unique is None


def test_an_irrational_minimum() -> None:
    found = least(line(1, 1), ball((0, 0), 1))
    assert found is not None and found.field.degree == 2 and proves(line(1, 1), (ball((0, 0), 1),), found)
    value = line(1, 1).value(found.point).to_algebraic()  # type: ignore[union-attr]
    assert value == -RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@each(
    (line(1, 0), ()),  # unbounded
    (line(1, 0), (ball((0, 0), 1), ball((5, 0), 1))),  # infeasible
    (line(0, 1), (ball((0, 0), 1), ball((2, 0), 1))),  # one point, without multipliers
)
def test_what_has_no_multipliers(objective: Quadratic, forms: tuple[Quadratic, ...]) -> None:
    assert least(objective, *forms) is None


@settings(max_examples=15)
@given(st.integers(-4, 4), st.integers(-4, 4), st.integers(1, 9), st.integers(-3, 3), st.integers(-3, 3))
def test_the_nearest_point_of_a_disc(x: int, y: int, square: int, a: int, b: int) -> None:
    objective, disc = ball((a, b), 0), ball((x, y), square)
    found = least(objective, disc)
    assert found is not None and proves(objective, (disc,), found) and found.unique is True
    inside = sign(disc.value((Fraction(a), Fraction(b)))) <= 0
    assert (not found.multipliers) is inside or sign(disc.value((Fraction(a), Fraction(b)))) == 0


def system(objective: str, conditions: str) -> ConvexSystem:
    value = lower_term(read_term(objective), lambda message, at: InputError(message))
    return read_system(read(conditions), value.poly, scale=Fraction(1, value.den))


def settled(objective: str, conditions: str) -> tuple[ConvexSystem, OptimumEvidence]:
    given = system(objective, conditions)
    return given, settle_strict(given, solve(given, budget=Budget(60)), budget=Budget(60))


def satisfies(given: ConvexSystem, point: Point) -> bool:
    """Every constraint, the strict ones strictly."""
    allowed = {FormRelation.EQ: (0,), FormRelation.LE: (-1, 0), FormRelation.LT: (-1,)}
    return all(sign(f.value(point)) in allowed[r] for f, r in zip(given.forms, given.relations))


@each(
    ("x^2", "x > -1 and x < 1", 0),
    ("x", "x >= 0 and y > 0", 0),
    ("x", "x >= 0 and y > 0 and x + y < 1", 0),
    ("x + y", "x + y >= 2 and x > 0 and y > 0", 2),
    ("x^2 + y^2", "x = 3 and y > -1", 9),
    ("0*x", "x > 0 and x < 1/1000000", 0),
)
def test_attained(objective: str, conditions: str, value: int) -> None:
    given, found = settled(objective, conditions)
    assert found.status is OptimumStatus.OPTIMAL and found.attained is True
    assert satisfies(given, found.point) and given.objective.value(found.point) == value


@each(
    ("x", "x > 0", 0),
    ("x", "x > 0 and y^2 < 1", 0),
    ("x + y", "x + y > 2 and x > 0 and y > 0", 2),
    ("x", "x^2 + y^2 < 4", -2),
    ("y", "x^2 <= y and y > 0 and x <= 0", 0),
    ("x", "x >= 0 and x > 0 and x + y = 1", 0),
)
def test_only_approached(objective: str, conditions: str, value: int) -> None:
    given, found = settled(objective, conditions)
    assert found.status is OptimumStatus.OPTIMAL and found.attained is False
    assert given.objective.value(found.point) == value and not satisfies(given, found.point)
    assert satisfies(given, found.inner_point)


@each(
    "x > 0 and x < 0",
    "x >= 0 and x < 0",
    "x^2 + y^2 <= 1 and x > 1",
    "x^2 + y^2 < 1 and (x - 2)^2 + y^2 <= 1",
    "x + y = 1 and x > 0 and y > 1",
    "x >= 0 and x <= y and y <= x and x < y",
    "x^2 <= 0 and y^2 <= 0 and x + y > 0",
)
def test_empty_though_the_closed_problem_is_not(conditions: str) -> None:
    given = system("x", conditions)
    assert solve(given, budget=Budget(60)).status is OptimumStatus.OPTIMAL
    assert settled("x", conditions)[1].status is OptimumStatus.INFEASIBLE


def test_without_bound_from_a_point_inside() -> None:
    given, found = settled("x", "y > 0 and y < 1 and x < y")
    assert found.status is OptimumStatus.UNBOUNDED and satisfies(given, found.point)
    assert given.objective.value(found.direction) < 0


def test_an_empty_problem_stays_empty() -> None:
    given = system("x", "x > 1 and x < 0")
    evidence = solve(given, budget=Budget(60))
    assert settle_strict(given, evidence, budget=Budget(60)) is evidence

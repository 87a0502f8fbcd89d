"""Small convex problems, one for each thing that can happen."""

from __future__ import annotations

from fractions import Fraction as F

import pytest

from qe.certify.verify import verify
from qe.convex.optimum import NotConvex, Optimum, OptimumStatus, maximize, minimize
from qe.errors import BudgetExceeded, Unable
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.options import Budget

RING = Ring.of(("x", "y", "z"))
X, Y, Z = (RING.gen(i) for i in range(3))
LE, LT, EQ, GE, GT = Relation.LE, Relation.LT, Relation.EQ, Relation.GE, Relation.GT


def _all(*pairs) -> Formula:
    return conj(atom(p, relation) for p, relation in pairs)


def _solved(objective, constraints: Formula, **options) -> Optimum:
    """The optimum, with its certificate checked."""
    found = minimize(objective, constraints, **options)
    assert verify(found.certificate).accepted
    return found


def test_without_constraints() -> None:
    found = _solved(X * X + Y * Y - X, TRUE)
    assert found.point == {"x": F(1, 2), "y": 0} and found.value == F(-1, 4) and found.unique


def test_scale_and_maximum() -> None:
    assert minimize(X * X - X, TRUE, scale=F(2, 3)).value == F(-1, 6)
    found = maximize(2 * X + Y, _all((X * X + Y * Y - 5, LE)))
    assert found.value == 5 and found.point == {"x": 2, "y": 1}


def test_sides_of_a_constraint_may_be_given_either_way() -> None:
    below = _solved(Y, _all((X * X + Y * Y - 2, LE), (X - 1, GE)))
    above = _solved(Y, _all((2 - X * X - Y * Y, GE), (1 - X, LE)))
    assert below.point == above.point == {"x": 1, "y": -1}
    assert below.active == (0, 1) and below.constraints[1].startswith("x - 1")


def test_linear_program_with_redundant_active_constraints() -> None:
    found = _solved(X + Y, _all((X, GE), (Y, GE), (X + Y, GE), (X + 2 * Y, GE), (X - 4, LE)))
    assert found.value == 0 and found.point == {"x": 0, "y": 0}
    assert found.active == (0, 1, 2, 3)


def test_many_optimal_points() -> None:
    found = _solved(X, _all((X * X + Y * Y - 4, LE), (Z * Z - 2, LE)))
    assert found.value == -2 and found.unique is False
    assert found.point["x"] == -2 and found.point["z"] == 0


def test_equations_are_eliminated_exactly() -> None:
    found = _solved(X * X + Y * Y + Z * Z, _all((X + Y + Z - 1, EQ), (X - 2 * Y, EQ)))
    assert found.point == {"x": F(3, 7), "y": F(3, 14), "z": F(5, 14)}
    assert found.value == F(5, 14) and found.unique


def test_contradictory_equations() -> None:
    found = _solved(X, _all((X - 1, EQ), (X + Y - 2, EQ), (X - Y - 1, EQ)))
    assert found.status is OptimumStatus.INFEASIBLE and found.value is None


def test_false_has_no_optimum() -> None:
    assert _solved(X * X, FALSE).status is OptimumStatus.INFEASIBLE


def test_disjoint_balls() -> None:
    found = _solved(X, _all((X * X + Y * Y - 1, LE), ((X - 3) * (X - 3) + Y * Y - 1, LE)))
    assert found.status is OptimumStatus.INFEASIBLE
    assert found.point == {"x": F(3, 2), "y": 0}  # where the larger violation is least


def test_tangent_balls_leave_one_point() -> None:
    touching = _all((X * X + Y * Y - 1, LE), ((X - 2) * (X - 2) + Y * Y - 1, LE))
    across = _solved(Y, touching)  # no multipliers exist: the gradients at (1, 0) are horizontal
    assert across.point == {"x": 1, "y": 0} and len(across.evidence.faces) == 1
    assert _solved((X - 5) * (X - 5) + Y * Y, touching).value == 16


def test_face_of_positive_dimension_and_an_irrational_optimum_on_it() -> None:
    found = _solved(Y + Z, _all((X * X + Y * Y - 1, LE), ((X - 2) * (X - 2) + Y * Y - 1, LE), (Z * Z - 2, LE)))
    assert found.value == found.point["z"] and found.value * found.value == 2 and found.value < 0


def test_faces_of_faces() -> None:
    # x = 0 and y^2 <= x say x = y = 0 in one face; only then does z^2 <= y say z = 0
    found = _solved(X + Y + Z, _all((X, GE), (X, LE), (Y * Y - X, LE), (Z * Z - Y, LE)))
    assert found.value == 0 and found.point == {"x": 0, "y": 0, "z": 0}
    assert len(found.evidence.faces) == 2


def test_infeasible_on_a_face() -> None:
    found = _solved(Y, _all((X * X + Y * Y - 1, LE), ((X - 2) * (X - 2) + Y * Y - 1, LE), (X + Y - 2, GE)))
    assert found.status is OptimumStatus.INFEASIBLE


def test_strict_constraint_that_does_not_matter() -> None:
    found = _solved(X * X + Y * Y, _all((X - 1, GE), (Y - 1, LT)))
    assert found.attained and found.value == 1


def test_infimum_that_is_not_attained() -> None:
    found = _solved(X, _all((X * X + Y * Y - 1, LT)))
    assert found.status is OptimumStatus.OPTIMAL
    assert found.attained is False and found.value == -1
    inner = found.evidence.inner_point
    assert inner[0] * inner[0] + inner[1] * inner[1] < 1


@pytest.mark.parametrize(
    "constraints",
    [
        _all((X, LT), (X, GE)),
        _all((X * X + Y * Y - 1, LT), ((X - 2) * (X - 2) + Y * Y - 1, LE)),
        _all((X, EQ), (X, LT)),
        _all((X * X + Y * Y, LE), (X + Y, GT)),
    ],
)
def test_strict_constraints_without_a_point(constraints: Formula) -> None:
    assert _solved(X + Y, constraints).status is OptimumStatus.INFEASIBLE


def test_unbounded_along_a_ray() -> None:
    found = _solved(X, _all((Y - 1, LE), (Z - X, LE)))
    assert found.status is OptimumStatus.UNBOUNDED and found.direction["x"] < 0
    assert _solved(X * X + Y, TRUE).status is OptimumStatus.UNBOUNDED


def test_unbounded_along_a_parabola_only_is_not_guessed() -> None:
    with pytest.raises(Unable):
        minimize(X, _all((X * X - Y, LE)))


@pytest.mark.parametrize(
    ("objective", "constraints"),
    [
        (X * Y, TRUE),
        (-X * X, TRUE),
        (X**3, TRUE),
        (X, _all((X * X + Y * Y - 1, GE))),
        (X, _all((X * X + Y * Y - 1, EQ))),
        (X, _all((X**4 - 1, LE))),
        (X, atom(X, Relation.NE)),
        (X, disj((atom(X, GE), atom(Y, GE)))),
    ],
)
def test_what_is_not_convex_is_refused(objective, constraints: Formula) -> None:
    with pytest.raises(NotConvex):
        minimize(objective, constraints)


def test_objective_and_constraints_of_different_rings() -> None:
    other = Ring.of(("b", "x"))
    found = _solved(X * X, conj((atom(other.var("x") - other.var("b"), GE), atom(other.var("b") - 2, GE))))
    assert found.value == 4 and found.point["b"] == 2


def test_budget_is_respected() -> None:
    with pytest.raises(BudgetExceeded):
        minimize(X * X, _all((X - 1, GE)), budget=Budget(0.0))

"""The optima of formulas (7) and (8): the values that are known, exactly."""

from fractions import Fraction as F

from qe.certify.verify import verify
from qe.convex.optimum import OptimumStatus, maximize, minimize
from qe.exact.field import FieldElement
from qe.formula.build import atom, conj
from qe.formula.syntax import Relation
from tests.optimum_problems import CUBIC_LABELS, at_most_zero, cubic, quadratic
from tests.tables import each


def _decimals(value: object, digits: str) -> bool:
    """Whether a number is within one unit in the last place of a printed decimal, decided exactly."""
    unit = F(1, 10 ** len(digits.partition(".")[2]))
    return F(digits) - unit <= value <= F(digits) + unit  # type: ignore[operator]


@each(
    # Q0, R0, r^2, objective, Q1 and Q2, active
    ((-3, 2), (3, 2), 27, "13.036164", ("-1.3991", "2.2007", "1.3991", "2.2007"), "P1 R2"),
    ((-3, 2), (2, 2), 27, "8.608561", ("-1.6696", "2.1323", "0.3635", "2.0843"), "P1 R2"),
    ((-3, 2), (1, 2), 14, "7.080015", ("-2.5829", "2.4757", "-0.5333", "2.3237"), "P2 R2"),
    ((-4, 2), (3, 2), 21, "29.961225", ("-3.5528", "2.8944", "1.5515", "2.8994"), "P2 Q1 R1"),
    ((0, 3), (4, 3), 26, "6.894445", ("1.7779", "3.2501", "3.5558", "3.5001"), "R1"),
    ((-3, 4), (3, 4), 26, "21.36", ("-2.2", "4.6", "2.2", "4.6"), "P2 Q1 Q2 R1"),
    ((-1, 5), (4, 5), 44, "9.614010", ("1.0053", "5.3127", "3.0244", "5.6133"), "P1 R1"),
    (
        (-3, 1, 2),
        (2, 1, 2),
        15,
        "12.024396",
        ("-2.405", "1.3556", "2.7112", "0.4517", "1.3058", "2.6116"),
        "P2 R1",
    ),
)
def test_cubic_optima(q0, r0, r2, value, point, active) -> None:
    objective, forms, _ = cubic(q0, r0, r2)
    found = minimize(objective, at_most_zero(forms))
    assert found.status is OptimumStatus.OPTIMAL
    assert found.unique and found.attained
    assert _decimals(found.value, value)
    assert all(_decimals(c, d) for c, d in zip(found.point.values(), point, strict=True))
    assert {CUBIC_LABELS[i] for i in found.active} == set(active.split())
    assert verify(found.certificate).accepted


@each(
    ("2.6", "-.33333", "1.00000", "1.33333"),
    ("2.5", "-.34034", "1.00541", "1.33369"),
    ("2.3", "-.37671", "1.03322", "1.34683"),
    ("2.0", "-.43140", "1.07440", "1.40211"),
    ("1.8", "-.46796", "1.10151", "1.46268"),
    ("1.75", "-.46635", "1.15714", "1.48888"),
    ("1.7", "-.48433", "1.23010", "1.57603"),
    ("1.6", "-.55432", "1.31442", "1.82407"),
    ("1.5", "-.64645", "1.35355", "2.17157"),
)
def test_symmetric_family(radius: str, x: str, y: str, value: str) -> None:
    objective, forms, _ = cubic((-1, 1), (1, 1), F(radius) ** 2)
    found = minimize(objective, at_most_zero(forms))
    assert _decimals(found.point["a0"], x) and _decimals(found.point["a1"], y)
    assert found.point["b0"] == -found.point["a0"] and found.point["b1"] == found.point["a1"]
    assert _decimals(found.value, value)


def test_threshold_of_the_interior_solution() -> None:
    for r2, inside in ((F(58, 9), True), (F(57, 9), False)):
        objective, forms, _ = cubic((-1, 1), (1, 1), r2)
        found = minimize(objective, at_most_zero(forms))
        assert (found.value == F(4, 3)) is inside
        assert (found.active != ()) is (not inside or r2 == F(58, 9))


def test_hemisphere_condition_bites_at_radius_three_halves() -> None:
    objective, forms, _ = cubic((-1, 1), (1, 1), F(9, 4), hemisphere=True)
    found = minimize(objective, at_most_zero(forms))
    free = minimize(objective, at_most_zero(forms[:6]))
    assert 4 - 4 * free.point["a1"] + free.point["b1"] < 0  # P1 below the ground
    assert found.value > free.value
    assert 4 - 4 * found.point["a1"] + found.point["b1"] == 0


def test_planar_problem_in_space_has_the_planar_optimum() -> None:
    plane = minimize(*_problem(cubic((-3, 2), (2, 2), 27)))
    space = cubic((-3, F(6, 5), F(8, 5)), (2, F(6, 5), F(8, 5)), 27)
    turned = minimize(*_problem(space))
    assert turned.value == plane.value * space[2] ** 2  # the objective carries the square of the denominator
    assert turned.point["a0"] == plane.point["a0"]
    assert turned.point["a1"] * 4 == turned.point["a2"] * 3


def _problem(parts):
    return parts[0], at_most_zero(parts[1])


def test_formula_eight_interior_touching_and_degenerate() -> None:
    inside = minimize(*_problem(quadratic((-1, 3, 3), (1, 3, 3), 27)))
    assert inside.point == {"x": 0, "y": 3, "z": 3} and inside.active == () and inside.value == 2
    # the midpoint lies on two spheres at once, without being pressed against them
    touching = minimize(*_problem(quadratic((-1, 3, 3), (1, 3, 3), 22)))
    assert touching.active == (1, 2) and not any(touching.multipliers)
    # the via point R0 on the sphere leaves Q1 = R0 alone: no multipliers without facial reduction
    single = minimize(*_problem(quadratic((0, 1, 1), (1, 2, 1), 6)))
    assert single.point == {"x": 1, "y": 2, "z": 1} and len(single.evidence.faces) == 1
    assert verify(single.certificate).accepted


def test_formula_eight_with_irrational_optimum() -> None:
    found = minimize(*_problem(quadratic((-3, 1, 3), (1, 4, 3), 32, hemisphere=True)))
    assert isinstance(found.value, FieldElement) and found.field.degree == 2
    assert found.active == (1, 2)
    assert str(found.point["z"]).count("sqrt") == 1


def test_formula_eight_infeasible_as_the_enclosing_circle_says() -> None:
    q0, r0 = (-1, 3, 3), (1, 3, 3)
    # d^2 + k^2 <= r k with d = 1, k = sqrt(18): r^2 >= 361/18
    feasible = minimize(*_problem(quadratic(q0, r0, F(361, 18))))
    empty = minimize(*_problem(quadratic(q0, r0, F(360, 18))))
    assert feasible.status is OptimumStatus.OPTIMAL and empty.status is OptimumStatus.INFEASIBLE
    assert empty.value is None and all(m >= 0 for m in empty.multipliers)
    assert verify(feasible.certificate).accepted
    assert verify(empty.certificate).accepted


def test_exact_bounding_box_and_fibres_of_the_region() -> None:
    _, forms, _ = cubic((-3, 2), (2, 2), 27)
    region, ring = at_most_zero(forms), forms[0].ring
    box = {}
    for name in ring.names:
        low, high = minimize(ring.var(name), region), maximize(ring.var(name), region)
        assert verify(low.certificate).accepted
        assert verify(high.certificate).accepted
        box[name] = (low.value, high.value)
        assert low.point[name] == low.value < high.value == high.point[name]
    assert all(box[n][0] <= c <= box[n][1] for n, c in zip(ring.names, (-3, 2, 2, 2), strict=True))
    # the interval that is left for the next coordinate when the first is chosen, and nothing when it is outside
    chosen = conj((region, atom(ring.var("a0") + 2, Relation.EQ)))
    fibre = minimize(ring.var("a1"), chosen)
    assert fibre.point["a0"] == -2 and box["a1"][0] <= fibre.value < 2
    outside = conj((region, atom(ring.var("a0") - 10, Relation.EQ)))
    assert minimize(ring.var("a1"), outside).status is OptimumStatus.INFEASIBLE


def test_via_point_on_the_sphere_forces_its_neighbour() -> None:
    # |Q0| = r: Q1 and its mirror image in Q0 both lie in the ball, so Q1 = Q0
    objective, forms, _ = cubic((3, 2, 4), (2, -5, 0), 29)
    found = minimize(objective, at_most_zero(forms))
    assert [found.point[f"a{i}"] for i in range(3)] == [3, 2, 4]
    assert [found.point[f"b{i}"] for i in range(3)] == [2, -5, 0]
    assert len(found.evidence.faces) == 2
    assert verify(found.certificate).accepted


def test_field_of_high_degree_under_hemisphere_conditions() -> None:
    objective, forms, _ = cubic((5, -5, 3), (-5, 1, 5), 61, hemisphere=True)
    found = minimize(objective, at_most_zero(forms))
    assert found.field.degree == 14 and found.active == (1, 2, 4, 11)
    assert verify(found.certificate).accepted

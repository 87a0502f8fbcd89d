"""Formula (7): what is written, the exact optima, and what must hold for every problem."""

from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

import qe
from bezier.curves.curve import Smoothness
from bezier.curves.scalar import dot, scale, sign
from bezier.curves.workspace import HalfSpace, Workspace, WorkspaceKind
from bezier.methods.control.terms import named_multipliers
from bezier.methods.cubic import formula as cubic
from bezier.paths.path import speed_at_joins
from bezier.planner.planning import make_plan
from bezier.plans import Outcome, Stated
from bezier.problem import INNER, PlanMethod, PointCondition, Problem
from qe.errors import InputError
from qe.io import text
from tests.bezier.made import points
from tests.tables import each

COORDINATE = st.integers(-3, 3).map(Fraction)
POINT = points(3, COORDINATE)
RATIO = st.sampled_from([Fraction(1), Fraction(1, 2), Fraction(2, 3), Fraction(3, 2)])


def at(*coordinates):
    """An exact point."""
    return tuple(map(Fraction, coordinates))


def problem(q0, r0, r2, kind=WorkspaceKind.BALL, **more):
    q0, r0 = at(*q0), at(*r0)
    return Problem(PlanMethod.CUBIC, Workspace(kind, Fraction(r2)), at(0, 0, 0), (q0, r0), at(0, 0, 0), False, **more)


def embedded(x, k):
    """The point (x, k) of the plane through the x axis with the slope 4/3 in y, z."""
    return Fraction(x), Fraction(3, 5) * k, Fraction(4, 5) * k


def floor_at(height, *names):
    """z >= height for some control points."""
    up = (Fraction(0), Fraction(0), Fraction(1))
    return PointCondition(HalfSpace(up, -Fraction(height), "half_space[0]"), names)


# --- the formula -------------------------------------------------------------------------------------


def test_formula_7_as_printed():
    formula = cubic.system(problem((-1, 3, 3), (1, 3, 3), 27)).statement().formula
    assert formula.variables == tuple(f"{p}{a}" for p in ("p1", "p2", "r1", "r2") for a in "xyz")
    assert [part.relation.value for part in formula.body.args] == ["="] * 12 + ["<="] * 6
    assert len({part.poly.ring.names[i] for part in formula.body.args for i in part.poly.variables}) == 18


@given(POINT, POINT, points(), points())
def test_equal_durations_give_the_equations_of_the_paper(q0, r0, q1, q2):
    found = cubic.system(problem(q0, r0, 100)).points([q1, q2])
    for i in range(3):
        assert found["P1"][i] == 4 * q0[i] - 4 * q1[i] + q2[i] and found["P2"][i] == 2 * q0[i] - q1[i]
        assert found["R1"][i] == 2 * r0[i] - q2[i] and found["R2"][i] == q1[i] - 4 * q2[i] + 4 * r0[i]


@given(POINT, POINT, points(), points(), RATIO)
def test_joins_are_c2_in_time_for_any_choice(q0, r0, q1, q2, ratio):
    from bezier.methods.control.optimal_path import path_through

    asked = problem(q0, r0, 100, ratio=ratio)
    system = cubic.system(asked)
    path = path_through(asked, system, system.points([q1, q2]))
    assert path.smoothness is Smoothness.C2
    for item in path.joins:
        velocity = path.curves[item.first].derivative(1, Fraction(1))
        assert scale(1 / path.duration(item.first), velocity) == speed_at_joins(path)[f"{item.first}-{item.second}"]


def test_symbolic_formula_has_seven_parameters():
    formula = text.read(str(cubic.shape().symbolic()))
    used = {part.poly.ring.names[i] for part in formula.body.args for i in part.poly.variables}
    bound = set(cubic.shape().variables + cubic.shape().quantified)
    assert used - bound == {f"{p}0{a}" for p in "qr" for a in "xyz"} | {"r"}


# --- known optima ------------------------------------------------------------------------------------

ROWS = [  # Q0, R0, r^2, optimum, Q1, Q2, active: printed digits
    ((-3, 2), (3, 2), 27, "13.036164", ("-1.3991", "2.2007"), ("1.3991", "2.2007"), "P1 R2"),
    ((-3, 2), (2, 2), 27, "8.608561", ("-1.6696", "2.1323"), ("0.3635", "2.0843"), "P1 R2"),
    ((-3, 2), (1, 2), 14, "7.080015", ("-2.5829", "2.4757"), ("-0.5333", "2.3237"), "P2 R2"),
    ((-4, 2), (3, 2), 21, "29.961225", ("-3.5528", "2.8944"), ("1.5515", "2.8994"), "P2 Q1 R1"),
    ((0, 3), (4, 3), 26, "6.894445", ("1.7779", "3.2501"), ("3.5558", "3.5001"), "R1"),
    ((-3, 4), (3, 4), 26, "21.36", ("-2.2", "4.6"), ("2.2", "4.6"), "P2 Q1 Q2 R1"),
    ((-1, 5), (4, 5), 44, "9.614010", ("1.0053", "5.3127"), ("3.0244", "5.6133"), "P1 R1"),
    ((-1, 1), (1, 1), "169/25", "1.333333", ("-0.33333", "1"), ("0.33333", "1"), ""),
    ((-1, 1), (1, 1), "25/4", "1.33369", ("-0.34034", "1.00541"), ("0.34034", "1.00541"), "P1 R2"),
    ((-1, 1), (1, 1), "529/100", "1.34683", ("-0.37671", "1.03322"), ("0.37671", "1.03322"), "P1 R2"),
    ((-1, 1), (1, 1), "4", "1.40211", ("-0.43140", "1.07440"), ("0.43140", "1.07440"), "P1 R2"),
    ((-1, 1), (1, 1), "81/25", "1.46268", ("-0.46796", "1.10151"), ("0.46796", "1.10151"), "P1 R2"),
    ((-1, 1), (1, 1), "49/16", "1.48888", ("-0.46635", "1.15714"), ("0.46635", "1.15714"), "P1 P2 R1 R2"),
    ((-1, 1), (1, 1), "289/100", "1.57603", ("-0.48433", "1.23010"), ("0.48433", "1.23010"), "P2 R1"),
    ((-1, 1), (1, 1), "64/25", "1.82407", ("-0.55432", "1.31442"), ("0.55432", "1.31442"), "P2 R1"),
    ((-1, 1), (1, 1), "9/4", "2.17157", ("-0.64645", "1.35355"), ("0.64645", "1.35355"), "P2 Q1 Q2 R1"),
]


def agrees(value, printed):
    """Whether an exact number rounds to the printed decimal, give or take one unit in the last place."""
    unit = Fraction(1, 10 ** len(printed.partition(".")[2]))
    return sign(value - (Fraction(printed) - unit)) > 0 > sign(value - (Fraction(printed) + unit))


@each(*(pytest.param(row, id=f"{row[0]}-{row[1]}-{row[2]}") for row in ROWS), daily=2)
def test_the_printed_optima(row):
    q0, r0, squared, value, q1, q2, active = row
    plan = make_plan(problem(embedded(*q0), embedded(*r0), Fraction(squared)))
    assert plan.certified and plan.optimum.unique and plan.path.smoothness is Smoothness.C2
    assert agrees(plan.objective, value) and set(plan.active) == set(active.split())
    for name, (x, k) in (("Q1", q1), ("Q2", q2)):
        point = plan.path.points[name]
        assert agrees(point[0], x) and agrees(point[1] * Fraction(5, 3), k)
        assert sign(4 * point[1] - 3 * point[2]) == 0, "the optimum lies in the plane of O, Q0, R0"


def test_an_optimum_in_space():
    plan = make_plan(problem((-3, 1, 2), (2, 1, 2), 15))
    assert agrees(plan.objective, "12.024396") and set(plan.active) == {"P2", "R1"}
    printed = {"Q1": ("-2.4050", "1.3556", "2.7112"), "Q2": ("0.4517", "1.3058", "2.6116")}
    for name, decimals in printed.items():
        assert all(agrees(c, d) for c, d in zip(plan.path.points[name], decimals, strict=True))


def test_stationarity_with_the_named_multipliers():
    plan = make_plan(problem((-3, 1, 2), (2, 1, 2), 15))
    q0, r0 = plan.problem.via
    p = plan.path.points
    found = dict(named_multipliers(plan.system, plan.optimum))
    assert set(found) == {"P2", "R1"} and all(sign(m) > 0 for m in found.values())
    for i in range(3):  # of |Q1-Q0|^2 + |Q2-Q1|^2 + |R0-Q2|^2 + sum m (|.|^2 - r^2), with P2 = 2Q0-Q1, R1 = 2R0-Q2
        assert sign((p["Q1"][i] - q0[i]) - (p["Q2"][i] - p["Q1"][i]) - found["P2"] * p["P2"][i]) == 0
        assert sign((p["Q2"][i] - p["Q1"][i]) - (r0[i] - p["Q2"][i]) - found["R1"] * p["R1"][i]) == 0


# --- every problem -----------------------------------------------------------------------------------


def feasible_points(system, seed, count=6):
    """Rational choices of (Q1, Q2) that satisfy every condition, near the trivial one and far from it."""
    random, found = Random(seed), []
    q0, r0 = system.given["Q0"], system.given["R0"]
    for _ in range(60):
        spread = Fraction(random.randint(0, 12), 4)
        q1, q2 = (tuple(c + spread * Fraction(random.randint(-8, 8), 8) for c in p) for p in (q0, r0))
        candidate = system.points([q1, q2])
        if not system.violated(candidate):
            found.append(candidate)
        if len(found) == count:
            break
    return found


@settings(max_examples=5)
@given(POINT, POINT, st.integers(0, 8), st.sampled_from(WorkspaceKind), RATIO)
@example(at(3, 0, 0), at(3, 0, 0), 0, WorkspaceKind.BALL, Fraction(1))
@example(at(0, 0, 0), at(1, 2, 2), 0, WorkspaceKind.HEMISPHERE, Fraction(1))
@example(at(-1, -1, 0), at(2, 2, 0), 0, WorkspaceKind.BALL, Fraction(1))
def test_plans_are_proved_and_no_choice_is_better(q0, r0, more, kind, ratio):
    """Also for coinciding and collinear via points, one on the sphere, and the origin as via point."""
    if kind is WorkspaceKind.HEMISPHERE:
        q0, r0 = ((*p[:2], abs(p[2])) for p in (q0, r0))
    asked = problem(q0, r0, max(dot(q0, q0), dot(r0, r0), Fraction(1)) + more, kind, ratio=ratio)
    plan = make_plan(asked)
    assert plan.certified
    if plan.path is None:
        assert ratio > 1, "for outer curves that do not take longer, Q1 = Q0 and Q2 = R0 is always allowed"
        assert plan.trivial.violated
        return
    assert plan.path.smoothness is Smoothness.C2 and not plan.system.violated(plan.path.points)
    if ratio <= 1:
        assert not plan.trivial.violated
        assert sign(plan.objective - plan.system.objective_at(plan.trivial.path.points)) <= 0
    for other in feasible_points(plan.system, 1):
        assert sign(plan.system.objective_at(other) - plan.objective) >= 0


@settings(max_examples=4)
@given(POINT, POINT, st.integers(0, 6))
def test_a_numerical_solver_agrees(q0, r0, more):
    optimize = pytest.importorskip("scipy.optimize")
    assume(q0 != r0)
    asked = problem(q0, r0, max(dot(q0, q0), dot(r0, r0)) + more + 1)
    plan = make_plan(asked)
    a, b = ([float(c) for c in p] for p in (q0, r0))
    squared = float(asked.workspace.radius_squared)

    def split(v):
        return v[:3], v[3:]

    def cost(v):
        q1, q2 = split(v)
        return sum((q1 - a) ** 2) + sum((q2 - q1) ** 2) + sum((b - q2) ** 2)

    def margins(v):
        import numpy as np

        q1, q2 = split(v)
        q, r = np.array(a), np.array(b)
        listed = (4 * q - 4 * q1 + q2, 2 * q - q1, q1, q2, 2 * r - q2, q1 - 4 * q2 + 4 * r)
        return [squared - p @ p for p in listed]

    found = optimize.minimize(cost, [*a, *b], constraints={"type": "ineq", "fun": margins}, tol=1e-12)
    assert float(plan.objective) == pytest.approx(found.fun, abs=1e-5)


@settings(max_examples=2)
@given(POINT, POINT, st.integers(0, 6), st.sampled_from([Fraction(3), Fraction(1, 2)]))
def test_scaling_and_rotation(q0, r0, more, factor):
    asked = problem(q0, r0, max(dot(q0, q0), dot(r0, r0), Fraction(1)) + more)
    plan = make_plan(asked)

    def turned(p):  # a rotation about the z axis and a reflection of z
        return Fraction(3, 5) * p[0] - Fraction(4, 5) * p[1], Fraction(4, 5) * p[0] + Fraction(3, 5) * p[1], -p[2]

    larger = make_plan(problem(scale(factor, q0), scale(factor, r0), asked.workspace.radius_squared * factor * factor))
    other = make_plan(problem(turned(q0), turned(r0), asked.workspace.radius_squared))
    assert larger.objective == plan.objective * factor * factor and other.objective == plan.objective
    assert set(larger.active) == set(plan.active) == set(other.active)
    backwards = make_plan(problem(r0, q0, asked.workspace.radius_squared))
    assert backwards.objective == plan.objective


def test_a_via_point_on_the_sphere_leaves_only_the_cusp():
    plan = make_plan(problem((3, 0, 0), (1, 2, 2), 9))
    assert plan.certified and plan.path.points["Q1"] == (3, 0, 0) and plan.path.points["Q2"] == (1, 2, 2)
    assert plan.slowest["Q"].stops == ((0, 0), (1, 1)) and plan.slowest["P"].stops[-1] == (1, 1)


@pytest.mark.deep
@settings(max_examples=300)
@given(
    st.tuples(points(), points()).filter(lambda via: via[0] != via[1]),
    st.sampled_from([0, 0, 1, 2, 5]),
    st.sampled_from(WorkspaceKind),
    RATIO,
    st.sampled_from([0, 0, Fraction(1, 2), 2]),
    st.lists(st.tuples(POINT.filter(any), COORDINATE, st.sampled_from(INNER[PlanMethod.CUBIC])), max_size=2),
)
def test_many_plans_and_what_their_certificates_show(via, more, kind, ratio, speed, half_spaces):
    from bezier.methods.cubic.method import restore
    from qe.proof.certificate import Certificate

    if kind is WorkspaceKind.HEMISPHERE:
        via = tuple((*p[:2], abs(p[2])) for p in via)
        assume(via[0] != via[1])
    conditions = tuple(
        PointCondition(HalfSpace(normal, offset, f"half_space[{i}]"), (name,))
        for i, (normal, offset, name) in enumerate(half_spaces)
    )
    squared = max(*(dot(p, p) for p in via), Fraction(1)) + more
    asked = problem(*via, squared, kind, ratio=ratio, join_speed=Fraction(speed), half_spaces=conditions)
    plan = make_plan(asked)
    shown, _ = restore(asked, Certificate.from_json(plan.certificate.to_json()), Stated({}, None))
    assert plan.certified and (shown.path is None) == (plan.path is None)
    assert plan.path is None or shown.path.points == plan.path.points


# --- further conditions ------------------------------------------------------------------------------


def test_the_hemisphere_matters_for_a_tight_radius():
    asked = problem(embedded(-1, 1), embedded(1, 1), Fraction(9, 4))
    free = make_plan(asked)
    assert any(sign(p[2]) < 0 for p in free.path.points.values())
    upper = make_plan(replace(asked, workspace=replace(asked.workspace, kind=WorkspaceKind.HEMISPHERE)))
    assert upper.certified and {"P1.z", "R2.z"} <= set(upper.active)
    assert upper.objective > free.objective
    assert all(sign(p[2]) >= 0 for p in upper.path.points.values())


def test_a_half_space_lifts_the_middle_curve():
    asked = problem((-3, 1, 2), (2, 1, 2), 15)
    high = Fraction(14, 5)
    plan = make_plan(replace(asked, half_spaces=(floor_at(high, "Q1", "Q2"),)))
    assert plan.certified and "Q2.half_space[0]" in plan.active
    assert all(sign(plan.path.points[name][2] - high) >= 0 for name in ("Q1", "Q2"))
    assert plan.objective > make_plan(asked).objective
    below = make_plan(replace(asked, half_spaces=(floor_at(1, "Q1", "Q2"),)))
    proved = {(proof.curve, proof.condition.name) for proof in below.path.proofs}
    assert ("Q", "half_space[0]") in proved and ("P", "half_space[0]") not in proved


def test_a_redundant_condition_makes_multipliers_ambiguous_and_changes_nothing():
    asked = problem(embedded(-3, 4), embedded(3, 4), 26)
    plan = make_plan(asked)
    q2 = plan.path.points["Q2"]  # rational and on the sphere: the half-space touches the ball there
    tangent = PointCondition(HalfSpace(scale(-1, q2), Fraction(26), "half_space[0]"), ("Q2",))
    again = make_plan(replace(asked, half_spaces=(tangent,)))
    assert again.certified and again.objective == plan.objective == Fraction(534, 25)
    assert set(again.active) == {*plan.active, "Q2.half_space[0]"} and again.path.points == plan.path.points


def test_contradictory_half_spaces_are_refuted_with_a_certificate():
    down = PointCondition(HalfSpace((Fraction(0), Fraction(0), Fraction(-1)), Fraction(2), "half_space[1]"), ("Q1",))
    asked = problem((-3, 1, 2), (2, 1, 2), 15, half_spaces=(floor_at(3, "Q1"), down))
    plan = make_plan(asked)
    assert plan.outcome is Outcome.INFEASIBLE and plan.certified and plan.path is None
    used = {label for label, _ in named_multipliers(plan.system, plan.optimum)}
    assert used == {"Q1.half_space[0]", "Q1.half_space[1]"}


def test_a_half_space_beyond_the_ball_is_refuted():
    plan = make_plan(problem((-3, 1, 2), (2, 1, 2), 15, half_spaces=(floor_at(4, "R2"),)))
    assert plan.outcome is Outcome.INFEASIBLE and qe.verify(plan.certificate).accepted


def test_the_speed_asked_for_at_the_joins():
    asked, required = problem(embedded(-3, 2), embedded(2, 2), 27), Fraction(41, 10)
    slow, fast = make_plan(asked), make_plan(replace(asked, join_speed=required))
    # the chord has the direction of the x axis: that coordinate of the velocity at Q0 is what the condition is about
    assert speed_at_joins(slow.path)["P-Q"][0] < required == speed_at_joins(fast.path)["P-Q"][0]
    assert fast.certified and "Q1.speed" in fast.active and fast.objective > slow.objective
    assert all(dot(v, v) >= required**2 for v in speed_at_joins(fast.path).values())


@given(POINT, POINT, points(), points(), st.fractions(Fraction(1, 8), 4, max_denominator=8))
def test_the_join_speed_conditions_imply_the_speed(q0, r0, q1, q2, speed):
    assume(q0 != r0)
    asked = problem(q0, r0, 100, join_speed=speed)
    control = cubic.system(asked).points([q1, q2])
    holds = {item.point: item.condition.margin(control[item.point]) >= 0 for item in cubic.join_speed(asked)}
    for name, start, end in (("Q1", q0, q1), ("Q2", q2, r0)):
        velocity = scale(3, tuple(b - a for a, b in zip(start, end, strict=True)))
        if holds[name]:
            assert dot(velocity, velocity) >= speed**2


def test_join_speed_needs_a_direction():
    with pytest.raises(InputError, match="different via points"):
        cubic.system(problem((1, 1, 1), (1, 1, 1), 9, join_speed=Fraction(1)))


def test_too_much_speed_is_refuted():
    plan = make_plan(problem((3, 0, 0), (1, 2, 2), 9, join_speed=Fraction(1, 100)))
    assert plan.outcome is Outcome.INFEASIBLE and plan.certified


@each(Fraction(10**4), Fraction(10**9), Fraction(1, 10**12))
def test_the_unit_of_length_does_not_matter(unit):
    """In micrometres as in kilometres: the same active conditions, the optimum in the square of the unit."""
    q0, r0 = embedded(-3, 2), embedded(2, 2)
    plain, changed = (make_plan(problem(scale(u, q0), scale(u, r0), 27 * u**2)) for u in (Fraction(1), unit))
    assert plain.active == changed.active == ("P1", "R2") and changed.certified
    assert changed.objective == plain.objective * unit**2

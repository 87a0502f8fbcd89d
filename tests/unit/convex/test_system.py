"""Systems of linear and convex conditions: feasible points, frames, the simplex method."""

from fractions import Fraction
from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.convex import minimise
from qe.convex.frame import centred_frame, lies_far, plain_frame
from qe.convex.linear_point import LinearContradiction, linear_point
from qe.convex.optimum import decide
from qe.convex.simplex import Endless, Least, Nowhere, least_cost
from qe.convex.strict import feasible
from qe.convex.system import ConvexSystem, NotConvex, is_convex, read_system
from qe.exact.field import NumberField
from qe.exact.kkt_system import Flat
from qe.exact.quadratic_form import Quadratic
from qe.exact.ring import Ring
from qe.formula.build import conj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, Atom, Formula, Relation
from qe.io.substitution import over_one_ring
from qe.io.text import read
from qe.options import Budget
from qe.proof.multipliers import FormRelation, OptimumStatus
from tests.tables import each
from tests.unit.convex.quadratics import ball, diagonal, line


def system(text: str) -> ConvexSystem:
    return read_system(read(text))


def test_every_relation_is_read_as_at_most_less_or_equal() -> None:
    found = system("x <= 1 and x < 2 and x >= -1 and x > -2 and x + y = 0")
    le, lt, eq = FormRelation.LE, FormRelation.LT, FormRelation.EQ
    assert found.names == ("x", "y") and found.relations == (le, lt, le, lt, eq)
    at = [form.value((Fraction(3), Fraction(5))) for form in found.forms]
    assert at == [2, 1, -4, -5, 8]
    assert not found.is_weak and system("x <= 1 and x^2 <= 2").is_weak
    assert not any(found.objective.gradient) and found.objective.constant == 0


def test_only_variables_that_occur_are_read() -> None:
    ring = Ring.of("abc")
    atom = Atom(ring.var("b") ** 2 - 2, Relation.LT)
    assert read_system(atom).names == ("b",)
    objective = Ring.of("zc").var("z")
    assert read_system(atom, objective, scale=3).objective.gradient == (3, 0)


def test_constants() -> None:
    assert read_system(TRUE).forms == ()
    impossible = read_system(FALSE, Ring.of("x").var("x"))
    assert impossible.forms[0].constant == 1 and impossible.relations == (FormRelation.LE,)
    assert decide(FALSE, budget=Budget()).values is None and decide(TRUE, budget=Budget()).values == {}


@each(
    ("x > 0 and x^3 < 1", "constraint 2 has degree above 2"),
    ("x^2 = 1", "constraint 1 is a nonlinear equation"),
    ("x^2 >= 1", "constraint 1 does not describe a convex set"),
    ("x < 1 and x*y <= 1", "constraint 2 does not describe a convex set"),
    ("x /= 1", "constraint 1 is a disequation"),
    ("x > 1 or x < 0", "not a conjunction"),
)
def test_what_is_not_convex(text: str, reason: str) -> None:
    with pytest.raises(NotConvex, match=reason):
        system(text)


def test_objectives_that_are_not_convex() -> None:
    x = Ring.of("x").var("x")
    for objective, scale in ((x**2, -1), (-(x**2), 1), (x**3, 1)):
        with pytest.raises(NotConvex, match="objective"):
            read_system(TRUE, objective, scale=scale)
    assert read_system(TRUE, -(x**2), scale=-1).objective.hessian == ((2,),)


def test_convexity_of_a_condition() -> None:
    flat, bowl, saddle = ((0, 0), (0, 0)), ((1, 1), (1, 1)), ((1, 2), (2, 1))
    assert is_convex(flat, FormRelation.EQ) and not is_convex(bowl, FormRelation.EQ)
    for relation in (FormRelation.LE, FormRelation.LT):
        assert is_convex(flat, relation) and is_convex(bowl, relation) and not is_convex(saddle, relation)


@each(
    ("x^2 + y^2 <= 1 and x + y >= 1", True),
    ("x^2 + y^2 <= 1 and x + y >= 3/2", False),
    ("x^2 + y^2 <= 1 and x = 1", True),
    ("x^2 + y^2 < 1 and x = 1", False),
    ("x^2 + y^2 <= 2 and x + y >= 2", True),
    ("x^2 + y^2 < 2 and x + y >= 2", False),
    ("x < 1 and x > 1 - 10^-30 and y = 0", True),
)
def test_feasible(text: str, true: bool) -> None:
    formula = read(text.replace("10^-30", "1/10^30"))
    found = read_system(formula)
    assert feasible(found.forms, found.relations, budget=Budget()) is true
    assert (decide(formula, budget=Budget()).values is not None) is true


def point(text: str | Formula) -> dict[str, Fraction] | LinearContradiction | None:
    return linear_point(read(text) if isinstance(text, str) else text, budget=Budget(60))


@each(
    "x > 1 and x < 2",
    "x >= 1 and x <= 1",
    "2*x = 3 and y < x",
    "-3*x > 2 and -3*x < 3",
    "x + y > 1 and x - y > 1 and x + 2*y < 2",
    "x + y = 1 and x - y = 1/3 and z > x",
    "x < 10^40 and x > 10^40 - 1/10^40",
    "-2*x - 2*y >= 4 and x >= -1 and y >= -1",
    "3 - x > 0",
)
def test_points_satisfy_the_conditions(text: str) -> None:
    found = point(text)
    assert isinstance(found, dict) and holds_at(read(text), found)


@each(
    "x > 1 and x < 1",
    "x >= 1 and x < 1",
    "x > 1 and x <= 1",
    "2*x = 3 and x > 2",
    "x + y > 2 and x <= 1 and y <= 1",
    "x + y = 1 and x + y = 2",
    "x < y and y < z and z < x",
    "x <= y and y <= z and z <= x and x < z",
)
def test_conditions_that_contradict_each_other_add_up_to_a_number(text: str) -> None:
    found = point(text)
    assert isinstance(found, LinearContradiction)
    weight, poly = found.terms[0]
    total = sum((w * p for w, p in found.terms[1:]), weight * poly)
    assert total.constant_value() == found.total


@each(
    "x^2 < 1",
    "x /= 1",
    "x > 1 or x < 0",
    "true",
    "false",
)
def test_what_is_not_linear_is_not_answered(text: str) -> None:
    assert point(text) is None


ROWS = st.tuples(*[st.integers(-3, 3)] * 4, st.sampled_from(("<", "<=", "=", ">=", ">")))


@given(st.lists(ROWS, min_size=1, max_size=5), st.tuples(*[st.fractions(-4, 4, max_denominator=4)] * 3))
def test_conditions_that_a_known_point_satisfies(rows: list[tuple], at: tuple[Fraction, ...]) -> None:  # type: ignore[type-arg]
    """Every form is compared with its value at the point as the relation says, so a point is found."""
    parts = []
    for a, b, c, gap, relation in rows:
        value = a * at[0] + b * at[1] + c * at[2]
        shift = {"<": abs(gap) + 1, "<=": abs(gap), "=": 0, ">=": -abs(gap), ">": -abs(gap) - 1}[relation]
        parts.append(read(f"{a}*x + {b}*y + {c}*z {relation} {value + shift}"))
    conditions = conj(over_one_ring(*parts))
    found = point(conditions)
    if conditions.free:
        assert found is not None and holds_at(conditions, {**dict.fromkeys("xyz", Fraction(0)), **found})


WHOLE = Flat.whole(2)
HUGE = Fraction(2**40)


def unit(form: Quadratic, flat: Flat = WHOLE) -> Fraction:
    """The one factor of all directions of the plain frame."""
    framed = plain_frame(flat, [form])
    (factor,) = {a / b for new, old in zip(framed.basis, flat.basis) for a, b in zip(new, old) if b}
    assert framed.origin == flat.origin
    return factor


@each(
    (ball((0, 0), 1), 0),
    (ball((0, 0), 4**8), 0),  # a length of 2^8 is near 1
    (ball((0, 0), 4**12), 12),
    (ball((0, 0), Fraction(1, 4**20)), -20),
    (ball((2**30, 0), 1), 30),
    (line(2**40, 1, constant=2**50), 0),  # half-planes have no size
    (ball((0, 0), 0), 0),
)
def test_one_unit_of_length(form: Quadratic, exponent: int) -> None:
    assert abs(unit(form) / Fraction(2) ** exponent - Fraction(3, 4)) <= Fraction(5, 4)
    assert (unit(form) == 1) is (exponent == 0)


def test_the_size_nearest_to_one_counts() -> None:
    framed = plain_frame(WHOLE, [ball((0, 0), 4**30), ball((0, 0), 4)])
    assert framed.basis == WHOLE.basis


def test_the_centre_lies_amid_the_curved_constraints() -> None:
    far = [ball((HUGE, -HUGE), 1), ball((HUGE + 1, -HUGE), 1)]
    framed = centred_frame(WHOLE, far)
    assert framed.origin == (HUGE + Fraction(1, 2), -HUGE)
    assert all(q.restrict(framed.origin, framed.basis).value((Fraction(0), Fraction(0))) < 0 for q in far)


def test_each_direction_has_its_own_unit() -> None:
    thin = diagonal(1, 2**60, constant=-1)  # x^2 + (2^30 y)^2 <= 1
    framed = centred_frame(WHOLE, [thin])
    assert framed.origin == (0, 0)
    (a, _), (_, b) = framed.basis
    assert Fraction(1, 2) <= a <= 2 and Fraction(1, 2) <= b * 2**30 <= 2


def test_linear_constraints_follow_the_sizes_of_the_others() -> None:
    """y <= 2^40 x beside x^2 <= 1: y goes as far as 2^40."""
    framed = centred_frame(WHOLE, [diagonal(1, 0, constant=-1), line(-(2**40), 1)])
    (a, _), (_, b) = framed.basis
    assert Fraction(1, 2) <= a <= 2 and Fraction(1, 4) <= b / 2**40 <= 4


def test_where_only_lines_are_the_centre_is_near_all_of_them() -> None:
    framed = centred_frame(WHOLE, [line(1, 0, constant=-HUGE), line(0, 1, constant=3)])
    assert framed.origin == (HUGE, -3) and framed.basis == WHOLE.basis
    assert centred_frame(WHOLE, []).origin == (0, 0)


@each(
    ([ball((0, 0), 1)], False),
    ([ball((1000, 0), 1)], False),
    ([ball((2**30, 0), 1)], True),
    ([ball((2**25, 0), 4**24)], False),  # about as large as it is far off
    ([ball((2**30, 0), 4**30)], True),
    ([diagonal(1, 2**60, constant=-1)], True),
    ([line(2**40, 1)], False),
)
def test_what_lies_far(forms: list[Quadratic], far: bool) -> None:
    assert lies_far(WHOLE, forms) is far


def test_points_of_the_flat_stay_points_of_it() -> None:
    flat = WHOLE.cut([line(1, 1, constant=-1)])
    assert flat is not None
    for framed in (plain_frame(flat, [ball((2**30, 0), 1)]), centred_frame(flat, [ball((2**30, 0), 1)])):
        assert len(framed.basis) == 1
        for c in (Fraction(0), Fraction(1), Fraction(-7, 3)):
            x, y = framed.lift((c,))
            assert x + y == 1


ROOT = NumberField.from_root([-2, 0, 1], 1, 2).generator()


def steps() -> None:
    """No limit."""


def dot(a, b):
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


@st.composite
def problems(draw: st.DrawFn):
    height, count = draw(st.integers(1, 3)), draw(st.integers(1, 5))
    numbers = st.integers(-3, 3).map(Fraction)
    columns = [draw(st.lists(numbers, min_size=height, max_size=height)) for _ in range(count)]
    rhs = draw(st.lists(numbers, min_size=height, max_size=height))
    cost = draw(st.lists(numbers, min_size=count, max_size=count))
    if draw(st.booleans()):
        rhs = [ROOT * v for v in rhs]
    return columns, rhs, cost


@given(problems())
def test_every_outcome_proves_itself(problem) -> None:
    """Weak duality and Farkas: each of the three outcomes excludes the others."""
    columns, rhs, cost = problem
    found = least_cost(columns, rhs, cost, check=steps)
    if isinstance(found, Nowhere):
        assert all(dot(found.dual, column) <= 0 for column in columns)
        assert dot(found.dual, rhs) > 0
        return
    assert all(w > 0 for w in found.weights.values())
    for r, right in enumerate(rhs):
        total = sum((w * columns[j][r] for j, w in found.weights.items()), Fraction(0))
        assert total == (right if isinstance(found, Least) else 0)
    if isinstance(found, Endless):
        assert sum(w * cost[j] for j, w in found.weights.items()) < 0
        return
    for j, column in enumerate(columns):
        assert dot(found.dual, column) <= cost[j]
        if j in found.weights:
            assert dot(found.dual, column) == cost[j]


def test_a_known_least_cost() -> None:
    """w1 + w2 = 1, w1 - w2 + w3 = 0 with costs 1, 3, 1: w = (1/2, 1/2, 0) costs 2, w = (0, 1, 1) costs 4."""
    columns = [[Fraction(1), Fraction(1)], [Fraction(1), Fraction(-1)], [Fraction(0), Fraction(1)]]
    found = least_cost(columns, [Fraction(1), Fraction(0)], [Fraction(c) for c in (1, 3, 1)], check=steps)
    assert isinstance(found, Least)
    assert found.weights == {0: Fraction(1, 2), 1: Fraction(1, 2)}


def test_a_cycling_problem_ends() -> None:
    """Beale's example, on which the rule of the steepest descent runs in a circle."""
    rows = [["1/4", -60, "-1/25", 9], ["1/2", -90, "-1/50", 3], [0, 0, 1, 0]]
    columns = [[Fraction(row[j]) for row in rows] for j in range(4)]
    columns += [[Fraction(int(r == k)) for r in range(3)] for k in range(3)]
    cost = [Fraction(c) for c in ("-3/4", 150, "-1/50", 6, 0, 0, 0)]
    found = least_cost(columns, [Fraction(0), Fraction(0), Fraction(1)], cost, check=steps)
    assert isinstance(found, Least)
    assert sum(w * cost[j] for j, w in found.weights.items()) == Fraction(-1, 20)


def form(*coefficients: int) -> Quadratic:
    """A linear polynomial: the gradient, and the constant last."""
    *gradient, constant = map(Fraction, coefficients)
    size = len(gradient)
    return Quadratic(((Fraction(0),) * size,) * size, tuple(gradient), constant)


LINES = st.tuples(*[st.integers(-3, 3)] * 3)


@given(st.lists(LINES, min_size=1, max_size=5), LINES)
def test_linear_problems_in_the_plane(lines: list[tuple[int, int, int]], goal: tuple[int, int, int]) -> None:
    """Against all corners of the region, cut with a large square."""
    objective, forms = form(*goal), [form(*line) for line in lines]
    problem = ConvexSystem(("x", "y"), objective, tuple(forms), (FormRelation.LE,) * len(forms))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(minimise, "_least", lambda *given, **settings: None)  # floats propose nothing
        found = minimise.solve(problem, budget=Budget())
    if found.status is OptimumStatus.INFEASIBLE:
        assert found.multipliers is not None and all(w >= 0 for w in found.multipliers)
        total = [sum((w * Fraction(f[k]) for w, f in zip(found.multipliers, lines)), Fraction(0)) for k in range(3)]
        assert total[:2] == [0, 0] and total[2] > 0
        return
    assert all(f.value(found.point) <= 0 for f in forms)
    if found.status is OptimumStatus.UNBOUNDED:
        assert dot(objective.gradient, found.direction) < 0
        assert all(dot(f.gradient, found.direction) <= 0 for f in forms)
        return
    square = [form(1, 0, -100), form(-1, 0, -100), form(0, 1, -100), form(0, -1, -100)]
    least = min(objective.value(p) for p in corners([*forms, *square]))
    assert found.status is OptimumStatus.OPTIMAL and objective.value(found.point) == least


def corners(forms: list[Quadratic]) -> list[tuple[Fraction, Fraction]]:
    found = []
    for f, g in combinations(forms, 2):
        (a, b), (c, d) = f.gradient, g.gradient
        if det := a * d - b * c:
            p = (b * g.constant - d * f.constant) / det, (c * f.constant - a * g.constant) / det
            if all(h.value(p) <= 0 for h in forms):
                found.append(p)
    return found


def test_the_budget_is_looked_at() -> None:
    calls: list[int] = []

    def check() -> None:
        calls.append(1)
        raise TimeoutError

    with pytest.raises(TimeoutError):
        least_cost([[Fraction(1)]], [Fraction(1)], [Fraction(1)], check=check)
    assert calls

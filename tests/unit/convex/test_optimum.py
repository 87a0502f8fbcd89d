"""Convex problems, one for each thing that can happen: every answer proves itself, on each level that has a part in it.

A row is a problem as text, and what is expected of its optimum. For every row alike: the certificate is accepted; the
evidence about the closed problem is recomputed (multipliers, a contradiction, or a ray); conditions with strict
relations are satisfied strictly, or the value is shown to be approached only; the maximum of the negative is the same;
and where there are multipliers, the conditions of optimality give the same point.
"""

from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.certify.verify import verify
from qe.convex.kkt import Kkt, kkt_point
from qe.convex.minimise import evidence_about, rational_numbers, solve
from qe.convex.optimum import NotConvex, OptimumStatus, maximize, minimize
from qe.convex.simplex import sign
from qe.convex.strict import settle_strict
from qe.convex.system import ConvexSystem, read_system
from qe.errors import BudgetExceeded, InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.field import NumberField
from qe.exact.kkt_system import Point
from qe.exact.quadratic_form import Quadratic
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.io.lowering import lower_term
from qe.io.text import read, read_term
from qe.options import Budget
from qe.proof.multipliers import FormRelation, OptimumEvidence
from tests.tables import each
from tests.unit.convex.quadratics import ball, line

LE, LT, EQ = FormRelation.LE, FormRelation.LT, FormRelation.EQ
OPTIMAL, INFEASIBLE, UNBOUNDED = OptimumStatus.OPTIMAL, OptimumStatus.INFEASIBLE, OptimumStatus.UNBOUNDED


def problem(objective: str, conditions: str) -> tuple[Poly, F, Formula, ConvexSystem]:
    value = lower_term(read_term(objective), lambda message, at: InputError(message))
    formula = read(conditions)
    return value.poly, F(1, value.den), formula, read_system(formula, value.poly, scale=F(1, value.den))


def total(found: OptimumEvidence, start: list[object]) -> list[object]:
    """The gradient of the weighted sum of the forms at the point, and of what it starts with."""
    for m, form in zip(found.multipliers, found.forms):
        start = [t + m * s for t, s in zip(start, form.slope(found.point))]  # type: ignore[operator]
    return start


def proves_itself(found: OptimumEvidence) -> None:
    """What is said of the closed problem, where no face had to be looked at, from its definition."""
    pairs = list(zip(found.forms, found.relations))
    if found.status is UNBOUNDED:  # all of the ray is feasible, and the objective falls along it
        at = {k: [p + k * d for p, d in zip(found.point, found.direction)] for k in (0, 1, 100)}
        values = [(sign(form.value(at[k])), relation) for k in at for form, relation in pairs]
        assert all(v == 0 if relation is EQ else v <= 0 for v, relation in values)
        assert sign(found.objective.value(at[100]) - found.objective.value(at[0])) < 0
    if found.faces or found.status is UNBOUNDED:
        return
    assert all(sign(m) >= 0 for m, (_, relation) in zip(found.multipliers, pairs) if relation is not EQ)
    if found.status is INFEASIBLE:  # stationary and positive at the point: so everywhere
        assert not any(map(sign, total(found, [F(0)] * found.objective.size)))
        value = sign(sum((m * f.value(found.point) for m, f in zip(found.multipliers, found.forms)), F(0)))
        strict = any(sign(m) for m, (_, relation) in zip(found.multipliers, pairs) if relation is LT)
        assert value > 0 or (not value and strict)
        return
    assert not any(map(sign, total(found, list(found.objective.slope(found.point)))))
    for (form, relation), m in zip(pairs, found.multipliers):
        at_point = sign(form.value(found.point))
        assert at_point == 0 if relation is EQ else at_point <= 0 and not (at_point and sign(m))


def satisfies(given: ConvexSystem, point: Point) -> bool:
    """Every constraint, the strict ones strictly."""
    allowed = {EQ: (0,), LE: (-1, 0), LT: (-1,)}
    return all(sign(f.value(point)) in allowed[r] for f, r in zip(given.forms, given.relations))


def meets_kkt(objective: Quadratic, forms: tuple[Quadratic, ...], found: Kkt) -> bool:
    """The theorem's conditions, with everything recomputed."""
    slope = objective.slope(found.point)
    for i, m in found.multipliers.items():
        slope = [a + m * b for a, b in zip(slope, forms[i].slope(found.point))]
    return (
        all(sign(m) > 0 and not sign(forms[i].value(found.point)) for i, m in found.multipliers.items())
        and not any(map(sign, slope))
        and all(sign(g.value(found.point)) <= 0 for g in forms)
    )


def best(value: object, **more: object) -> dict[str, object]:
    return {"status": OPTIMAL, "value": value, "attained": True, **more}


def only_approached(value: object) -> dict[str, object]:
    return best(value, attained=False)


def at(*values: object) -> dict[str, object]:
    return dict(zip("xyz", values))


NOWHERE, ENDLESS = {"status": INFEASIBLE, "value": None}, {"status": UNBOUNDED}
TANGENT = "x^2 + y^2 <= 1 and (x - 2)^2 + y^2 <= 1"
APART = "x^2 + y^2 <= 1 and (x - 3)^2 + y^2 <= 1"


@each(
    {
        "no constraints": ("x^2 + y^2 - x", "true", best(F(-1, 4), point=at(F(1, 2), 0), unique=True)),
        "a scale": ("2/3*x^2 - 2/3*x", "true", best(F(-1, 6))),
        "redundant active constraints of a linear program": (
            "x + y",
            "x >= 0 and y >= 0 and x + y >= 0 and x + 2*y >= 0 and x <= 4",
            best(0, point=at(0, 0), active=(0, 1, 2, 3)),
        ),
        "two half-planes": ("x + y", "x >= 0 and y >= 0", best(0, unique=True)),
        "three lines through the minimum": ("x", "x >= 0 and x + y >= 0 and x - y >= 0", best(0)),
        "a whole line of minima": ("x + 0*y", "x >= 2 and y = y", best(2)),
        "a whole line of minima of a square": ("x^2 + 0*y", "y <= 5", best(0, unique=False)),
        "equations, eliminated exactly": (
            "x^2 + y^2 + z^2",
            "x + y + z = 1 and x = 2*y",
            best(F(5, 14), point=at(F(3, 7), F(3, 14), F(5, 14)), unique=True),
        ),
        "an equation": ("(x - 5)^2 + y^2", "x + y = 1", best(8)),
        "an equation and a bound": ("(x - 5)^2 + y^2", "x + y = 1 and x <= 1", best(16)),
        "equations of one point": ("x^2 + y^2", "x = 3 and y = -4", best(25)),
        "contradictory equations": ("x", "x = 1 and x + y = 2 and x - y = 1", NOWHERE),
        "parallel equations": ("x + y", "x + y = 1 and 2*x + 2*y = 3", NOWHERE),
        "an equation beyond a ball": ("x + y", "x = 5 and x^2 + y^2 <= 24", NOWHERE),
        "half-planes apart": ("x + y", "x <= 0 and x >= 1", NOWHERE),
        "a ball of no size": ("x + y", "x^2 + y^2 <= -1", NOWHERE),
        "disjoint balls: the point where the larger violation is least": (
            "x",
            APART,
            {**NOWHERE, "point": at(F(3, 2), 0)},
        ),
        "one point between tangent balls": ("(x - 5)^2 + y^2", TANGENT, best(16)),
        "tangent balls, without multipliers": ("y", TANGENT, best(0, point=at(1, 0), faces=1)),
        "infeasible on a face": ("y", f"{TANGENT} and x + y >= 2", NOWHERE),
        "infeasible on a face across": ("y", f"{TANGENT} and y >= 1", NOWHERE),
        "a line in a disc": ("x + y", "x^2 + y^2 <= 2", best(-2, unique=True)),
        "a disc from outside": ("(x - 3)^2 + y^2", "x^2 + y^2 <= 1", best(4, unique=True)),
        "a disc and a coordinate": ("x", "x^2 + y^2 <= 4", best(-2)),
        "a constant": ("0*x + 7", "x^2 + y^2 <= 1", best(7)),
        "a ball of radius zero": ("x + y", "x^2 + y^2 <= 0", best(0, point=at(0, 0))),
        "a tangent": ("x", "x^2 + y^2 <= 1 and y = 1", best(0, point=at(0, 1))),
        "half-planes that meet in a line": ("x", "y >= 0 and y <= 0 and x >= 3", best(3)),
        "a corner on a circle": ("y", "x^2 + y^2 <= 2 and x >= 1", best(-1, point=at(1, -1), active=(0, 1))),
        "the same, the other way round": ("y", "2 - x^2 - y^2 >= 0 and 1 - x <= 0", best(-1, point=at(1, -1))),
        "many optimal points": ("x", "x^2 + y^2 <= 4 and z^2 <= 2", best(-2, unique=False)),
        "far from the origin": ("x", f"(x - {10**15})^2 + (y + {10**15})^2 <= 1", best(10**15 - 1)),
        "faces of faces": (
            "x + y + z",
            "x >= 0 and x <= 0 and y^2 <= x and z^2 <= y",
            best(0, point=at(0, 0, 0), faces=2),
        ),
        "unbounded in a parabola": ("x^2 + y", "true", ENDLESS),
        "unbounded in a parabola beside a half-plane": ("x^2 + y", "x <= 0", ENDLESS),
        "unbounded below a parabola": ("x + y", "x^2 + y <= 0", ENDLESS),
        "unbounded without constraints": ("x", "true", ENDLESS),
        "unbounded along a line": ("x", "y = 0", ENDLESS),
        "unbounded along a ray": ("x", "y <= 1 and z <= x", ENDLESS),
        "unbounded from a point inside": ("x", "y > 0 and y < 1 and x < y", ENDLESS),
        "a strict constraint that does not matter": ("x^2 + y^2", "x >= 1 and y < 1", best(1)),
        "an open interval": ("x^2", "x > -1 and x < 1", best(0)),
        "an open half-plane beside": ("x", "x >= 0 and y > 0", best(0)),
        "an open triangle": ("x", "x >= 0 and y > 0 and x + y < 1", best(0)),
        "an open side": ("x + y", "x + y >= 2 and x > 0 and y > 0", best(2)),
        "an equation and a strict bound": ("x^2 + y^2", "x = 3 and y > -1", best(9)),
        "a narrow strict range": ("0*x", "x > 0 and x < 1/1000000", best(0)),
        "an open half-line": ("x", "x > 2", only_approached(2)),
        "an open strip": ("x", "x > 0 and y^2 < 1", only_approached(0)),
        "an open side that counts": ("x + y", "x + y > 2 and x > 0 and y > 0", only_approached(2)),
        "an open disc": ("x", "x^2 + y^2 < 4", only_approached(-2)),
        "a parabola without its vertex": ("y", "x^2 <= y and y > 0 and x <= 0", only_approached(0)),
        "a half-line twice, once open": ("x", "x >= 0 and x > 0 and x + y = 1", only_approached(0)),
        "strict bounds without a point": ("x + y", "x < 0 and x >= 0", NOWHERE),
        "bounds that exclude each other": ("x", "x > 1 and x < 1", NOWHERE),
        "strict bounds that exclude each other widely": ("x", "x > 1 and x < 0", NOWHERE),
        "an open ball that only touches": ("x + y", TANGENT.replace("<=", "<", 1), NOWHERE),
        "an equation against a strict bound": ("x + y", "x = 0 and x < 0", NOWHERE),
        "a strict bound that misses a single point": ("x + y", "x^2 + y^2 <= 0 and x + y > 0", NOWHERE),
        "a strict tangent": ("x", "x^2 + y^2 <= 1 and x > 1", NOWHERE),
        "a strict bound at the end of a segment": ("x", "x + y = 1 and x > 0 and y > 1", NOWHERE),
        "a strict bound on a line": ("x", "x >= 0 and x <= y and y <= x and x < y", NOWHERE),
        "a strict bound that misses the point of two squares": ("x", "x^2 <= 0 and y^2 <= 0 and x + y > 0", NOWHERE),
        "objective and constraints of different rings": ("x^2", "x >= b and b >= 2", best(4)),
    }
)
def test_what_can_happen(objective: str, conditions: str, expected: dict[str, object]) -> None:
    poly, scale, formula, given = problem(objective, conditions)
    found, most = minimize(poly, formula, scale=scale), maximize(-poly, formula, scale=scale)
    assert verify(found.certificate).accepted and verify(most.certificate).accepted
    seen = {"faces": len(found.evidence.faces)}
    assert {name: seen[name] if name in seen else getattr(found, name) for name in expected} == expected
    assert most.status is found.status and (found.value is None or most.value == -found.value)
    closed = solve(given, budget=Budget(60))
    proves_itself(closed)
    settled = settle_strict(given, closed, budget=Budget(60))
    assert settled.status is found.status and (settled is closed or not given.is_weak or closed.status is OPTIMAL)
    if found.status is OPTIMAL:
        assert given.objective.value(settled.point) == found.value
        assert satisfies(given, settled.point) is found.attained
        assert found.attained or satisfies(given, settled.inner_point)
    if found.status is UNBOUNDED:
        assert satisfies(given, settled.point) and given.objective.value(settled.direction) < 0
    if found.status is OPTIMAL and not closed.faces and EQ not in given.relations and found.value < 10**9:
        kkt = kkt_point(given.objective, given.forms, budget=Budget(60))
        assert kkt is not None and meets_kkt(given.objective, given.forms, kkt)
        assert given.objective.value(kkt.point) == found.value


def test_an_irrational_optimum_on_a_face_of_positive_dimension() -> None:
    poly, _, formula, _ = problem("y + z", f"{TANGENT} and z^2 <= 2")
    found = minimize(poly, formula)
    assert verify(found.certificate).accepted and len(found.evidence.faces) == 1
    assert found.value == found.point["z"] and found.value * found.value == 2 and found.value < 0


X, Y = (Ring.of(("x", "y")).var(name) for name in "xy")


def test_nothing_satisfies_false() -> None:
    assert minimize(X * X, FALSE).status is INFEASIBLE and minimize(X - X + 1, TRUE).value == 1


def test_unbounded_along_a_parabola_only_is_not_guessed() -> None:
    with pytest.raises(Unable):
        minimize(X, read("x^2 <= y"))


@each(
    (X * Y, TRUE),
    (-X * X, TRUE),
    (X**3, TRUE),
    (X, read("x^2 + y^2 >= 1")),
    (X, read("x^2 + y^2 = 1")),
    (X, read("x^4 <= 1")),
    (X, atom(X, Relation.NE)),
    (X, read("x >= 0 or y >= 0")),
)
def test_what_is_not_convex_is_refused(objective: Poly, constraints: Formula) -> None:
    with pytest.raises(NotConvex):
        minimize(objective, constraints)


def test_budget_is_respected() -> None:
    with pytest.raises(BudgetExceeded):
        minimize(X * X, read("x >= 1"), budget=Budget(0.0))


def test_signs_and_rational_numbers() -> None:
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    assert [sign(v) for v in (F(-1, 3), F(0), F(2))] == [-1, 0, 1]
    assert [sign(v) for v in (root - 2, root - root, root - 1)] == [-1, 0, 1]
    assert rational_numbers([F(1, 3), root - root + 2]) == (F(1, 3), 2)
    assert rational_numbers([F(1), root]) is None and rational_numbers([]) == ()


def test_an_irrational_minimum() -> None:
    objective, disc = line(1, 1), ball((0, 0), 1)
    found = kkt_point(objective, (disc,), budget=Budget(60))
    assert found is not None and found.field.degree == 2 and meets_kkt(objective, (disc,), found)
    value = objective.value(found.point).to_algebraic()  # type: ignore[union-attr]
    assert value == -RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@each(
    (line(1, 0), ()),  # unbounded
    (line(1, 0), (ball((0, 0), 1), ball((5, 0), 1))),  # infeasible
    (line(0, 1), (ball((0, 0), 1), ball((2, 0), 1))),  # one point, without multipliers
)
def test_what_has_no_multipliers(objective: Quadratic, forms: tuple[Quadratic, ...]) -> None:
    assert kkt_point(objective, forms, budget=Budget(60)) is None


@settings(max_examples=15)
@given(st.integers(-4, 4), st.integers(-4, 4), st.integers(1, 9), st.integers(-3, 3), st.integers(-3, 3))
def test_the_nearest_point_of_a_disc(x: int, y: int, square: int, a: int, b: int) -> None:
    objective, disc = ball((a, b), 0), ball((x, y), square)
    found = kkt_point(objective, (disc,), budget=Budget(60))
    assert found is not None and meets_kkt(objective, (disc,), found) and found.unique is True
    inside = sign(disc.value((F(a), F(b)))) <= 0
    assert (not found.multipliers) is inside or sign(disc.value((F(a), F(b)))) == 0


def test_evidence_starts_without_anything() -> None:
    given = problem("x", "x^2 + y^2 <= 1")[3]
    made = evidence_about(given, status=INFEASIBLE, point=(F(1),))
    assert (made.names, made.forms, made.status) == (given.names, given.forms, INFEASIBLE)
    assert made.faces == () and made.field == NumberField.rationals() and made.point == (1,)

"""Convex minimisation as a whole: every outcome with evidence that proves it, recomputed here."""

from fractions import Fraction

from qe.convex.kkt import sign
from qe.convex.minimise import evidence_about, rational_numbers, solve
from qe.convex.system import ConvexSystem
from qe.exact.field import NumberField
from qe.exact.quadratic_form import Quadratic
from qe.options import Budget
from qe.proof.multipliers import FormRelation, OptimumEvidence, OptimumStatus
from tests.tables import each
from tests.unit.convex.quadratics import ball, diagonal, line

LE, EQ = FormRelation.LE, FormRelation.EQ


def problem(objective: Quadratic, *constraints: tuple[Quadratic, FormRelation]) -> ConvexSystem:
    names = ("x", "y", "z")[: objective.size]
    return ConvexSystem(names, objective, tuple(f for f, _ in constraints), tuple(r for _, r in constraints))


def solved(objective: Quadratic, *constraints: tuple[Quadratic, FormRelation]) -> OptimumEvidence:
    return solve(problem(objective, *constraints), budget=Budget(60))


def gradient(found: OptimumEvidence, *, with_objective: bool) -> list[object]:
    """The gradient of the weighted sum at the point; without faces."""
    total = list(found.objective.slope(found.point)) if with_objective else [Fraction(0)] * found.objective.size
    for m, form in zip(found.multipliers, found.forms):
        total = [t + m * s for t, s in zip(total, form.slope(found.point))]
    return total


@each(
    (line(1, 0), [(ball((0, 0), 4), LE)], -2),
    (ball((5, 0), 0), [(line(1, 1, constant=-1), EQ)], 8),
    (ball((5, 0), 0), [(line(1, 1, constant=-1), EQ), (line(1, 0, constant=-1), LE)], 16),
    (line(1, 1), [(line(-1, 0), LE), (line(0, -1), LE)], 0),
    (line(0, 0, constant=7), [(ball((0, 0), 1), LE)], 7),
    (diagonal(1, 1), [(line(1, 0, constant=-3), EQ), (line(0, 1, constant=4), EQ)], 25),
)
def test_optimal(objective: Quadratic, constraints: list[tuple[Quadratic, FormRelation]], value: int) -> None:
    found = solved(objective, *constraints)
    assert found.status is OptimumStatus.OPTIMAL and objective.value(found.point) == value
    for (form, relation), m in zip(constraints, found.multipliers):
        at = sign(form.value(found.point))
        assert at == 0 if relation is EQ else at <= 0 <= sign(m) and not (at and sign(m))
    assert not any(gradient(found, with_objective=True))


@each(
    [(ball((0, 0), 1), LE), (ball((3, 0), 1), LE)],
    [(line(1, 0), LE), (line(-1, 0, constant=1), LE)],
    [(line(1, 1, constant=-1), EQ), (line(2, 2, constant=-3), EQ)],
    [(line(1, 0, constant=-5), EQ), (ball((0, 0), 24), LE)],
    [(line(0, 0, constant=1), LE)],
    [(ball((0, 0), -1), LE)],
)
def test_infeasible(constraints: list[tuple[Quadratic, FormRelation]]) -> None:
    """The weighted sum is stationary at the point, and positive there: so it is positive everywhere."""
    found = solved(line(1, 1), *constraints)
    assert found.status is OptimumStatus.INFEASIBLE and not found.faces
    assert not any(gradient(found, with_objective=False))
    total = sum((m * f.value(found.point) for m, f in zip(found.multipliers, found.forms)), Fraction(0))
    assert sign(total) > 0
    assert all(sign(m) >= 0 for m, (_, r) in zip(found.multipliers, constraints) if r is LE)


@each(
    (line(1, 0), []),
    (line(1, 0), [(line(0, 1), EQ)]),
    (line(1, 1), [(diagonal(1, 0, slope=(0, 1)), LE)]),  # y <= -x^2
    (diagonal(1, 0, slope=(0, 1)), [(line(1, 0), LE)]),
)
def test_unbounded(objective: Quadratic, constraints: list[tuple[Quadratic, FormRelation]]) -> None:
    """From the point, which is feasible, all of the ray is, and the objective falls along it."""
    found = solved(objective, *constraints)
    assert found.status is OptimumStatus.UNBOUNDED
    for k in (0, 1, 100):
        at = [p + k * d for p, d in zip(found.point, found.direction)]
        for form, relation in constraints:
            assert sign(form.value(at)) <= 0 if relation is LE else sign(form.value(at)) == 0
    far = [p + 1000 * d for p, d in zip(found.point, found.direction)]
    assert objective.value(far) < objective.value(found.point)


def test_a_set_without_interior_is_reduced_to_its_flat() -> None:
    """Two discs that touch in (1, 0): the least value is that of the point, proved on a face."""
    touching = [(ball((0, 0), 1), LE), (ball((2, 0), 1), LE)]
    found = solved(line(0, 1), *touching)
    assert found.status is OptimumStatus.OPTIMAL and found.faces and tuple(found.point) == (1, 0)
    empty = solved(line(0, 1), *touching, (line(0, -1, constant=1), LE))
    assert empty.status is OptimumStatus.INFEASIBLE and (empty.faces or any(empty.multipliers))


def test_problems_far_from_the_origin() -> None:
    far = Fraction(10**15)
    found = solved(line(1, 0), (ball((far, -far), 1), LE))
    assert found.status is OptimumStatus.OPTIMAL and found.point[0] == far - 1


def test_rational_numbers() -> None:
    field = NumberField.from_root([-2, 0, 1], 1, 2)
    root = field.generator()
    assert rational_numbers([Fraction(1, 3), root - root + 2]) == (Fraction(1, 3), 2)
    assert rational_numbers([Fraction(1), root]) is None and rational_numbers([]) == ()


def test_evidence_starts_without_anything() -> None:
    given = problem(line(1, 0), (ball((0, 0), 1), LE))
    made = evidence_about(given, status=OptimumStatus.INFEASIBLE, point=(Fraction(1),))
    assert (made.names, made.forms, made.status) == (given.names, given.forms, OptimumStatus.INFEASIBLE)
    assert made.faces == () and made.field == NumberField.rationals() and made.point == (1,)

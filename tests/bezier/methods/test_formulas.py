"""Formulas of the quadratic and the cubic method, and cubic plans near others."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from fractions import Fraction as F
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import qe
from bezier.check.recheck import recheck
from bezier.curves.curve import Smoothness
from bezier.curves.scalar import dot, scale, sign, subtract
from bezier.curves.workspace import Ball, Workspace, WorkspaceKind
from bezier.methods.quadratic import formula as quadratic
from bezier.paths.path import assemble
from bezier.planner.command import plan
from bezier.problem import PlanMethod, Problem, read_problem
from qe.api.input import read_formula
from qe.errors import CertificateRejected
from qe.formula.build import convert
from qe.io import text
from tests.bezier.folder_mutation import Quiet
from tests.bezier.made import points, small
from tests.tables import each


def problem(q0, r0, r2, kind=WorkspaceKind.BALL):
    q0, r0 = (tuple(map(Fraction, p)) for p in (q0, r0))
    start, goal = (Fraction(1), Fraction(0), Fraction(0)), (Fraction(0), Fraction(1), Fraction(0))
    return Problem(PlanMethod.QUADRATIC, Workspace(kind, Fraction(r2)), start, (q0, r0), goal, False)


MAIN = problem((-1, 3, 3), (1, 3, 3), 27)


def test_formula_8_as_printed():
    formula = text.read(str(quadratic.printed(MAIN).statement()))
    assert formula.variables == quadratic.QUANTIFIED and len(formula.variables) == 6
    relations = [part.relation.value for part in formula.body.args]
    assert relations == ["="] * 6 + ["<="] * 3
    names = {part.poly.ring.names[i] for part in formula.body.args for i in part.poly.variables}
    assert names == set(quadratic.FREE + quadratic.QUANTIFIED)


def test_the_hemisphere_adds_three_conditions():
    upper = problem((-1, 3, 3), (1, 3, 3), 27, WorkspaceKind.HEMISPHERE)
    above = " and p1z >= 0 and q1z >= 0 and r1z >= 0"
    assert str(quadratic.system(upper).statement()) == str(quadratic.printed(upper).statement()) + above
    assert str(quadratic.system(MAIN).statement()) == str(quadratic.printed(MAIN).statement())
    assert str(quadratic.corrected(MAIN).statement()) == str(quadratic.system(upper).statement())


def test_symbolic_formula_has_seven_parameters():
    formula = text.read(str(quadratic.SHAPE.symbolic()))
    used = {part.poly.ring.names[i] for part in formula.body.args for i in part.poly.variables}
    assert used - set(quadratic.QUANTIFIED) - set(quadratic.FREE) == {f"{p}0{a}" for p in "qr" for a in "xyz"} | {"r"}


def test_leaving_formula_is_a_sentence():
    formula = text.read(str(quadratic.leaving(MAIN)))
    assert set(formula.variables) == set(quadratic.FREE + quadratic.QUANTIFIED)


@given(points(), points(), points(), st.sampled_from(list(WorkspaceKind)))
def test_the_conditions_on_q1_are_those_on_the_control_points(q0, r0, q1, kind):
    system = quadratic.system(problem(q0, r0, 5, kind))
    control = system.points([q1])
    moved = quadratic.as_conditions_on_q1(system)
    for direct, on_q1 in zip(system.conditions, moved, strict=True):
        assert direct.label == on_q1.name
        assert direct.condition.margin(control[direct.point]) == on_q1.margin(q1)


@given(points(), points(), points())
def test_the_curves_are_c1_and_their_names_fit(q0, r0, q1):
    system = quadratic.system(problem(q0, r0, 100))
    control = system.points([q1])
    path = assemble(system.curves(control), control, MAIN.workspace)
    assert path.smoothness >= Smoothness.C1
    assert path.points["P2"] == path.points["Q0"] == q0 and path.points["Q2"] == path.points["R0"] == r0


@given(points(), points(), points(), small)
def test_the_objective_is_least_at_the_midpoint(q0, r0, q1, shift):
    system = quadratic.system(problem(q0, r0, 100))
    middle = scale(Fraction(1, 2), tuple(a + b for a, b in zip(q0, r0, strict=True)))
    away = subtract(q1, middle)
    expected = system.objective_at(system.points([middle])) + 2 * dot(away, away)
    assert system.objective_at(system.points([q1])) == expected


def test_active_conditions_are_exact():
    system = quadratic.system(problem((0, 1, 1), (0, 2, 1), 4, WorkspaceKind.HEMISPHERE))
    assert system.active(system.points([(Fraction(0), Fraction(2), Fraction(0))])) == ("P1", "Q1", "Q1.z")
    near = (Fraction(0), Fraction(2) - Fraction(1, 10**20), Fraction(0))
    assert system.active(system.points([near])) == ("Q1.z",)


def meet_numerically(q0, r0, r2):
    """The largest violation at the best point of a fine search is <= 0: an independent look at the three balls."""
    centres = [(0.0,) * 3, tuple(2 * float(c) for c in q0), tuple(2 * float(c) for c in r0)]
    point, step = [sum(c[i] for c in centres) / 3 for i in range(3)], 2.0
    for _ in range(4000):
        far = max(centres, key=lambda c: sum((a - b) ** 2 for a, b in zip(c, point, strict=True)))
        gap = sum((a - b) ** 2 for a, b in zip(far, point, strict=True)) ** 0.5 or 1.0
        point = [p + (f - p) / gap * step for p, f in zip(point, far, strict=True)]
        step *= 0.996
    return max(sum((a - b) ** 2 for a, b in zip(c, point, strict=True)) for c in centres) - float(r2)


@given(points(), points(), st.fractions(min_value=1, max_value=60, max_denominator=3))
def test_three_ball_condition(q0, r0, r2):
    found = quadratic.three_balls(problem(q0, r0, r2))
    difference = float(found.needed_squared - found.radius_squared)
    assume(abs(difference) > 0.05)
    assert found.meet == (meet_numerically(q0, r0, r2) <= 0) == (difference < 0)


@each((1, 3, Fraction(10, 3)), (1, 2, Fraction(5, 2)), (2, 3, Fraction(13, 3)))
def test_symmetric_threshold(d, k, r):
    # Q0 = (-d, k), R0 = (d, k) with k > d: feasible iff d^2 + k^2 <= r k
    at = quadratic.three_balls(problem((-d, k, 0), (d, k, 0), r * r))
    below = quadratic.three_balls(problem((-d, k, 0), (d, k, 0), r * r - Fraction(1, 10**12)))
    assert at.meet and at.is_acute and not below.meet


def test_a_flat_triangle_needs_its_longest_side():
    found = quadratic.three_balls(problem((-3, 1, 1), (3, 1, 1), 14))
    assert not found.meet and not found.is_acute and found.needed_text == "6"


def test_conditions_can_be_told_apart():
    labels = [item.name for item in quadratic.as_conditions_on_q1(quadratic.system(MAIN))]
    assert labels == ["P1", "Q1", "R1"]
    first = quadratic.as_conditions_on_q1(quadratic.system(MAIN))[0]
    assert isinstance(first, Ball) and first.centre == (-2, 6, 6) and sign(first.margin((0, 3, 3))) > 0


AXES = "xyz"


def printed(q0: Sequence[object], r0: Sequence[object], radius_squared: str) -> str:
    """(7): the quantified control points are P1, P2, R1, R2; 4 equations per axis, 6 norms."""
    n = len(q0)
    points = {name: [f"{name}{a}" for a in AXES[:n]] for name in ("p1", "p2", "q1", "q2", "r1", "r2")}
    p1, p2, q1, q2, r1, r2 = points.values()
    parts = []
    for i in range(n):
        a, b = f"({q0[i]})", f"({r0[i]})"
        parts += [f"{p1[i]} = 4*{a} - 4*{q1[i]} + {q2[i]}", f"{p2[i]} = 2*{a} - {q1[i]}"]
        parts += [f"{r1[i]} = 2*{b} - {q2[i]}", f"{r2[i]} = {q1[i]} - 4*{q2[i]} + 4*{b}"]
    parts += [" + ".join(f"{c}^2" for c in point) + f" <= {radius_squared}" for point in points.values()]
    return f"ex {', '.join(p1 + p2 + r1 + r2)}. " + " and ".join(parts)


def six_norms(q0: Sequence[object], r0: Sequence[object], radius_squared: str) -> str:
    """The answer worked out by hand: six norms of linear combinations of Q0, R0, Q1, Q2."""
    forms = ((4, 0, -4, 1), (2, 0, -1, 0), (0, 0, 1, 0), (0, 0, 0, 1), (0, 2, 0, -1), (0, 4, 1, -4))
    norms = []
    for a, b, c, d in forms:
        squares = [f"({a}*({q0[i]}) + {b}*({r0[i]}) + {c}*q1{x} + {d}*q2{x})^2" for i, x in enumerate(AXES[: len(q0)])]
        norms.append(f"{' + '.join(squares)} <= {radius_squared}")
    return " and ".join(norms)


def symbols(name: str, n: int) -> list[str]:
    return [f"{name}{a}" for a in AXES[:n]]


@each(
    ((-1, 3, 3), (1, 3, 3), "27"),
    (("1/2", "-3/7", 2), (0, 0, "5/3"), "9"),
    (symbols("q0", 3), symbols("r0", 3), "r^2"),
    (symbols("q0", 2), symbols("r0", 2), "r^2"),
)
def test_answer_as_printed(q0: Sequence[object], r0: Sequence[object], square: str) -> None:
    answer = qe.eliminate(printed(q0, r0, square))
    assert answer.formula is not None
    expected = read_formula(six_norms(q0, r0, square))
    ring = expected.ring
    assert set(convert(answer.formula, ring).args) == set(expected.args)


def existence(n: int, *, factor: int = 1) -> str:
    """For all Q0, R0 in the ball of radius r (or ``factor`` times as far out): (7) has a solution."""
    q0, r0 = symbols("q0", n), symbols("r0", n)
    inside = [" + ".join(f"{c}^2" for c in point) + f" <= {factor}*r^2" for point in (q0, r0)]
    chosen = symbols("q1", n) + symbols("q2", n)
    formula = f"ex {', '.join(chosen)}. {printed(q0, r0, 'r^2')}"
    return f"all {', '.join(q0 + r0)}, r. {' and '.join(inside)} and r >= 0 -> ({formula})"


@each(2, 3)
def test_existence_theorem_is_found(n: int) -> None:
    answer = qe.eliminate(existence(n), timeout=120)
    assert answer.truth is True
    told = " ".join(answer.stats["plan"])
    assert f"q1{AXES[n - 1]} = q0{AXES[n - 1]}" in told and "q2x = r0x" in told


def test_existence_theorem_with_an_offered_witness() -> None:
    right = {f"q1{a}": f"q0{a}" for a in "xy"} | {f"q2{a}": f"r0{a}" for a in "xy"}
    assert qe.check_witness(existence(2), right) is True
    assert qe.check_witness(existence(2), right | {"q1x": "(q0x + r0x)/2"}) is False


def test_no_existence_outside_the_ball() -> None:
    """Via points beyond the radius: 2 Q0 - Q1 and Q1 cannot both be inside, and no witness is found for it."""
    from qe.elimination.witness import find
    from qe.options import Budget

    assert find(read_formula(existence(2, factor=2)), budget=Budget(20)) is None


NEAR = """
method="cubic"
start=["0","-1/10","0"]
goal=["0","1/10","-1/20"]
via=[
  ["-164593/50000","619/2000","118817/100000"],
  ["36623/25000","3991/20000","120477/100000"]]
radius="448381/100000"
"""


def summary(text: str, folder: Path) -> dict:
    folder.mkdir()
    assert plan(Quiet(), read_problem(text), folder, folder, plots=False)[1]  # type: ignore[arg-type]
    recheck(Quiet(), folder)  # type: ignore[arg-type]
    return json.loads((folder / "summary.json").read_text())


def test_five_digits_end_in_a_path_and_a_bound(tmp_path: Path) -> None:
    told = summary(NEAR, tmp_path / "out")
    value, bound = (F(told[key]["exact"]) for key in ("objective", "bound"))
    assert told["status"] == "near-optimal" and told["certified"] and 0 < value - bound <= F(1, 10**9) * value
    assert told["active"] and any("10^-9" in note for note in told["notes"])
    page = (tmp_path / "out" / "report.html").read_text()
    assert "no choice has less than" in page and "near the optimum" in page
    file = tmp_path / "out" / "summary.json"
    file.write_text(file.read_text().replace(told["bound"]["exact"], told["objective"]["exact"]))
    with pytest.raises(CertificateRejected):
        recheck(Quiet(), tmp_path / "out")  # type: ignore[arg-type]

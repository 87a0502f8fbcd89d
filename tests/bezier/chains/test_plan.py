"""Chains through via points: optima between two proved numbers, conflicts, repairs; floating point is not believed."""

from __future__ import annotations

import json
import random
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

import bezier
import qe
from bezier.chains import plan, proof, proposals
from bezier.chains.chain import Chain, Ends, Objective, objective_form, requirements
from bezier.chains.checking import checked
from bezier.chains.proof import Contradiction
from bezier.chains.repair import changed
from bezier.curves.curve import Bezier
from qe.errors import InputError, Unable
from tests.tables import each

PLANE = [[0, 0], [2, 1], [3, 3], [5, 2]]
SPACE = [["3/2", 5, 3], [-3, -2, 4], [-6, 4, 4], [0, -2, -3]]
CROWDED = [[1, -5, -1], [-2, -4, 4], [-1, 6, 1], [1, 2, 2], [-4, -1, -3]]
KINDS = ((2, 1, "legs"), (3, 1, "legs"), (3, 2, "legs"), (3, 2, "acceleration"), (5, 2, "jerk"), (5, 2, "snap"))


def chain(points: Any, **given: Any) -> Any:
    return bezier.chain(**{"start": points[0], "via": points[1:-1], "goal": points[-1], **given})


def derivative(curve: Bezier, order: int, at: int, time: Fraction) -> list[Fraction]:
    """At the beginning (0) or the end (1), in time."""
    points, degree, scale = [list(p) for p in curve.points], len(curve.points) - 1, Fraction(1)
    for k in range(order):
        points = [[b - a for a, b in zip(p, q, strict=True)] for p, q in pairwise(points)]
        scale *= Fraction(degree - k) / time
    return [c * scale for c in points[-at]]


@each(*KINDS)
@pytest.mark.parametrize("points", [PLANE, SPACE])
def test_it_passes_all_points_smoothly_in_time_and_is_proved(points: Any, degree: int, c: int, objective: str) -> None:
    times = [Fraction(1), Fraction(3, 2), Fraction(1, 2)]
    best = chain(points, degree=degree, continuity=c, objective=objective, durations=times, radius=30)
    assert best.feasible and best.bound <= best.value <= best.bound * (1 + Fraction(1, 10**9))
    assert qe.verify(best.certificate, core=False).accepted and len(best.curves) == 3
    for order in range(c + 1):
        for (one, s), (two, t) in pairwise(zip(best.curves, times, strict=True)):
            assert derivative(one, order, 1, s) == derivative(two, order, 0, t)
    ends = [best.curves[0].points[0], *(curve.points[-1] for curve in best.curves)]
    assert [tuple(map(Fraction, p)) for p in points] == [tuple(p) for p in ends]


def test_closed_chains_and_rest_at_the_ends() -> None:
    ring = bezier.chain(start=PLANE[0], via=PLANE[1:], closed=True, radius=10)
    assert len(ring.curves) == 4 and derivative(ring.curves[-1], 2, 1, Fraction(1)) == derivative(
        ring.curves[0], 2, 0, Fraction(1)
    )
    still = chain(PLANE, degree=5, ends="zero", objective="jerk")
    assert derivative(still.curves[0], 1, 0, Fraction(1)) == [0, 0] == derivative(still.curves[-1], 2, 1, Fraction(1))


def test_what_excludes_what_and_the_radius_that_repairs_it() -> None:
    none = chain(CROWDED, radius="13/2")
    assert not none.feasible and none.curves == () and none.conflict.smallest and none.repair is not None
    for certificate in (none.certificate, none.conflict.certificate, none.repair.certificate):
        assert qe.verify(certificate).accepted
    assert none.repair.too_small < none.repair.radius < none.repair.too_small * (1 + Fraction(1, 10**6))
    assert chain(CROWDED, radius=none.repair.radius * Fraction(1001, 1000)).feasible
    assert not chain(CROWDED, radius=none.repair.too_small).feasible
    assert "exclude each other" in str(none)


@pytest.mark.parametrize("seed", range(6))
def test_values_are_those_of_another_optimiser(seed: int) -> None:
    chance = random.Random(seed)
    points = [[Fraction(chance.randint(-50, 50), 10) for _ in range(2)] for _ in range(4)]
    given = Chain(
        tuple(map(tuple, points)), objective=Objective.LEGS, centre=(Fraction(0),) * 2, radius_squared=Fraction(64)
    )
    solved = given.solved
    assert solved is not None
    rows, form = requirements(given, solved), objective_form(given, solved)

    def value(x: Any, of: Any) -> float:
        free = [tuple(map(Fraction, p)) for p in np.reshape(x, (solved.size, 2)).tolist()]
        return float(of.value(free))

    conditions = [{"type": "ineq", "fun": lambda x, row=row: -value(x, row.form)} for row in rows]
    other = minimize(value, np.zeros(2 * solved.size), (form,), "SLSQP", constraints=conditions)
    best = plan.planned(given)
    if best.feasible:
        assert float(best.value or 0) == pytest.approx(other.fun, rel=1e-4)
    else:
        assert not other.success or max(value(other.x, row.form) for row in rows) > 1e-6


@cache
def honest_chains() -> tuple[Any, Any]:
    """One that there is, and one that there is not."""
    return chain(PLANE, radius=6), chain(CROWDED, radius="13/2")


@each(*range(8), daily=2)
def test_a_broken_proposer_never_proves_anything_false(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    chance, right = random.Random(seed), honest_chains()
    honest = proposals.best

    def broken(*given: Any, **named: Any) -> Any:
        answer = honest(*given, **named)
        assert answer is not None
        point = tuple(tuple(c + chance.choice((0, 0, 1, -3)) for c in p) for p in answer.point)
        weights = tuple(w * chance.choice((0, 1, 1, 7, -1)) for w in answer.weights)
        return replace(answer, point=point, weights=weights, excess=answer.excess * chance.choice((1, -1)))

    monkeypatch.setattr(proposals, "best", broken)
    for known, points, radius in zip(right, (PLANE, CROWDED), (6, "13/2"), strict=True):
        try:
            found = chain(points, radius=radius)
        except Unable:
            continue
        assert found.feasible is known.feasible
        if known.feasible:
            assert found.bound <= known.value and known.bound <= found.value


def test_a_thousand_false_claims_are_refused() -> None:
    """Contradictions of conditions that a chain keeps, and bounds above its value: random multipliers prove none."""
    given = Chain(tuple(tuple(map(Fraction, p)) for p in PLANE), centre=(Fraction(0),) * 2, radius_squared=Fraction(36))
    solved, chance = given.solved, random.Random(1)
    assert solved is not None
    rows = [row for row in requirements(given, solved) if not row.form.is_constant]
    inside = proof.decided(given, solved, rows)
    assert not isinstance(inside, Contradiction)
    least = proof.best(given, solved, rows, inside).value
    accepted = 0
    for _ in range(500):
        weights = {row.label: Fraction(chance.choice([0, 1, 7, -1, 40]), chance.randint(1, 9)) for row in rows}
        with pytest.raises(Unable):
            proof.contradiction(given, solved.size, weights, rows)
        moved = [tuple(c + Fraction(chance.randint(-9, 9), 30) for c in p) for p in inside]
        try:
            claimed = proof.bounded(given, solved, rows, moved, weights, Fraction(chance.choice([0, 1, 9]), 10))
        except Unable:
            continue
        accepted += 1
        assert claimed.bound <= least <= claimed.value
    assert accepted < 500


@each(((3, 2), [1, 2], [3, -1]), ((5, 2), [0, 1], [0, 0]), ((3, 1), [2, 0], [1, 1]), ((2, 1), [1, 3], None))
def test_velocities_at_the_ends(kind: tuple[int, int], first: Any, last: Any) -> None:
    times = [Fraction(2), Fraction(1), Fraction(3)]
    named = {"degree": kind[0], "continuity": kind[1], "durations": times}
    if last is None:
        none = chain(PLANE, velocities=[first, first], **named).with_repairs()
        assert none.conflict.smallest and len(none.conflict.conditions) == 4
        assert len(checked(none.chain, none.proof)) > 5 and [r.change for r in none.repairs][-1].startswith(
            "velocities"
        )
        for repair in none.repairs:
            assert plan.planned(changed(none.chain, repair.change, repair.value)).feasible
        return
    made = chain(PLANE, velocities=[first, last], **named)
    assert derivative(made.curves[0], 1, 0, times[0]) == first
    assert derivative(made.curves[-1], 1, 1, times[-1]) == last


def test_multipliers_that_prove_nothing_are_refused() -> None:
    given = Chain(tuple(tuple(map(Fraction, p)) for p in PLANE), centre=(Fraction(0),) * 2, radius_squared=Fraction(36))
    solved = given.solved
    assert solved is not None
    rows = requirements(given, solved)
    inside = proof.decided(given, solved, rows)
    assert not isinstance(inside, Contradiction)
    for weights in ({rows[0].label: Fraction(1)}, {rows[0].label: Fraction(-1)}):
        with pytest.raises(Unable):
            proof.contradiction(given, solved.size, weights, rows[:1])
    with pytest.raises(Unable):
        proof.bounded(given, solved, rows, inside, {"no such condition": Fraction(1)})


def test_the_goal_moves_to_a_place_where_there_is_a_chain() -> None:
    """The repair "goal" named the place of the first via point."""
    none = chain(PLANE, radius=5).with_repairs()
    goal = none.repairs[1]
    assert (
        goal.change == "goal" and 0.148 < sum((a - b) ** 2 for a, b in zip(goal.value, PLANE[3], strict=True)) < 0.149
    )
    assert plan.planned(replace(changed(none.chain, "goal", goal.value), radius_squared=Fraction("25.00001"))).feasible
    assert [what for what, _ in none.excluded] == ["another duration"] and checked(none.chain, none.proof)
    for said, other in (("impossible with", "possible with"), ("[0] free", "[9] free")):  # claims about such chains
        labels = [(label.replace(said, other), c.certificate) for label, c in none.excluded[0][1]]
        with pytest.raises(qe.CertificateRejected):
            checked(none.chain, qe.Certificate.bundle(labels))


def test_slopes_and_distances_are_those_of_the_convex_problem() -> None:
    """Repairs of 50 via points took 19 s: each candidate was a chain of its own. Slopes say which are worth a look."""
    given = chain(CROWDED, radius="6.6", half_spaces=[([0, 0, 1], -4)]).chain
    start, step = proposals.loosened(given), 1e-4
    rows = requirements(given, given.solved)
    known = proposals.best(given, given.solved.size, [row for row in rows if not row.form.is_constant])
    assert start is not None and known is not None and start.excess > 0
    assert start.excess == pytest.approx(known.excess, abs=1e-6)
    for k, name in enumerate(given.paces):
        times = tuple(t * (1 + Fraction(step) * (i == k)) for i, t in enumerate(given.times))
        slower = proposals.loosened(replace(given, durations=times))
        assert slower is not None and (start.excess - slower.excess) / step == pytest.approx(
            start.slopes[name], abs=1e-3
        )
    for name in given.point_names:
        moved = proposals.loosened(given, name)
        assert moved is None or moved.excess >= start.change(name) * (1 - 1e-6)


def test_a_least_value_that_many_chains_have_is_exact() -> None:
    """With a jerk of zero, and no middle legs, no share of the value could be proved."""
    flat = chain(PLANE, continuity=1, objective="jerk", half_spaces=[([1, 0], "-0.1")], radius=8)
    none = chain(PLANE[:3], degree=5, objective="middle legs", velocities=[[0, 0], [-1, -3]], radius=6)
    assert flat.value == flat.bound == 0 == none.value == none.bound
    assert str(flat) == "3 curves, objective 0, proved to a billionth"  # ended in a division by zero


def test_a_chain_that_is_determined_has_a_certificate() -> None:
    """A witness without variables was refused."""
    made = chain(PLANE, ends="zero", radius=9)
    assert len(checked(made.chain, made.certificate)) == 2


@each(
    ({"degree": 4}, "degree"),
    ({"radius": 0}, "radius"),
    ({"radius": "a"}, "radius"),
    ({"durations": [1]}, "durations"),
    ({"objective": "length"}, "objective"),
    ({"objective": "snap"}, "degree"),
    ({"ends": "stop"}, "ends"),
    ({"centre": [0]}, "centre"),
    ({"closed": True}, "goal"),
    ({"half_spaces": 3}, "half_spaces"),
    ({"half_spaces": [([0, 1], None)]}, "offset"),
    ({"via": 3}, "via"),
    ({"start": "ab"}, "start"),
    ({"velocities": [[1, 2]]}, "velocities"),
    ({"timeout": -1}, "timeout"),
)
def test_bad_input_is_one_line(given: dict[str, Any], word: str) -> None:
    with pytest.raises(InputError, match=word) as refused:
        chain(PLANE, **given)
    assert "\n" not in str(refused.value) and isinstance(Ends("free"), Ends)


@each(6, pytest.param(12, marks=pytest.mark.deep))
def test_the_chains_of_the_corpus(points: int, shared: Path) -> None:
    """Values within 1e-8 of another solver's; what is infeasible has a smallest conflict and a repair that works."""
    for record in json.loads((shared / "corpora" / "scenes" / "chains.json").read_text()):
        if record["via"] > points:
            continue
        made = chain(record["points"], radius=record["radius"])
        assert made.feasible is (record["status"] == "optimal")
        assert qe.verify(made.certificate).accepted
        if made.feasible:
            assert float(made.value) == pytest.approx(record["objective"], rel=1e-8)
        else:
            assert made.conflict.smallest and made.repair is not None and qe.verify(made.repair.certificate).accepted
            assert len(made.with_repairs().repairs) == 3
            assert chain(record["points"], radius=made.repair.radius * Fraction(101, 100)).feasible

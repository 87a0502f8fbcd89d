"""Bounds on length and curvature, durations that are picked, optima that are exact, against independent numbers."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import bezier
import qe
from bezier.chains import limits, proposals
from bezier.chains.checking import checked
from bezier.curves.curve import Bezier
from qe.errors import CertificateRejected, Unable
from qe.proof.certificate import Certificate, Labelled
from tests.tables import each

PLANE = [[0, 0], [2, 1], [3, 3], [5, 2], [6, 4]]
SPACE = [[x, y, k % 3] for k, (x, y) in enumerate(PLANE)]


def chain(points: Any = PLANE, **given: Any) -> Any:
    return bezier.chain(**{"start": points[0], "via": points[1:-1], "goal": points[-1], "radius": 9, **given})


def sampled(curve: Bezier, count: int = 4001) -> tuple[float, float]:
    """Length and largest curvature, by sums and differences of floats."""
    points, t = np.array([[float(c) for c in p] for p in curve.points]), np.linspace(0, 1, count)
    power = [
        np.polynomial.Polynomial.fit(t, limits._values(points, t)[:, k], len(points) - 1)
        for k in range(points.shape[1])
    ]
    v, a = (np.array([p.deriv(k)(t) for p in power]).T for k in (1, 2))
    speed = np.linalg.norm(v, axis=1)
    area = np.sqrt(np.maximum((v * v).sum(1) * (a * a).sum(1) - (v * a).sum(1) ** 2, 0))
    return float(np.trapezoid(speed, t)), float((area / np.maximum(speed, 1e-12) ** 3).max())


@each(
    (PLANE, {"max_length": 9.2}),
    (PLANE[:4], {"max_curvature": "3/2", "max_length": 8, "degree": 5}),
    pytest.param(PLANE, {"max_length": 9.1, "degree": 5}, marks=pytest.mark.deep),
    pytest.param(PLANE, {"max_curvature": 2, "degree": 5}, marks=pytest.mark.deep),
    pytest.param(SPACE, {"max_curvature": 2, "degree": 5}, marks=pytest.mark.deep),
)
def test_bounds_hold_for_all_t_and_the_value_has_two_sides(points: Any, given: Any) -> None:
    made, free = chain(points, **given), chain(points, **{k: v for k, v in given.items() if k == "degree"})
    measured = [sampled(curve) for curve in made.curves]
    if "max_length" in given:
        assert sum(length for length, _ in measured) <= float(given["max_length"]) + 1e-6
    if "max_curvature" in given:
        assert max(bend for _, bend in measured) <= float(Fraction(given["max_curvature"])) + 1e-6
    assert free.bound <= made.value and made.bound <= made.value <= made.bound * Fraction(5, 4)
    assert len(checked(made.chain, made.proof)) == 2


def test_what_is_too_short_is_refuted_and_what_is_not_known_is_said() -> None:
    none = chain(max_length=8.9)  # the corners are 8.944 apart
    assert not none.feasible and none.conflict.conditions == ("length",) and none.conflict.smallest
    assert checked(none.chain, none.proof)
    both = chain(max_length=9)
    assert not both.feasible and checked(both.chain, both.proof) and both.with_repairs().repairs == ()
    with pytest.raises(Unable, match="curvature"):
        chain(max_curvature="1/5")


def test_a_bound_that_the_witness_breaks_is_refused() -> None:
    made = chain(max_length=9.2)
    members = [m for m in made.proof.payload if isinstance(m, Labelled)]
    longer = [m for m in chain().proof.payload if isinstance(m, Labelled)]
    with pytest.raises(CertificateRejected, match="length"):
        checked(made.chain, Certificate.bundle([(m.label, m.certificate) for m in longer]))
    stretched = members[0].label.replace("with chords ", "with chords 1")
    with pytest.raises(CertificateRejected):
        checked(made.chain, Certificate.bundle([(stretched, members[0].certificate)]))


def test_bounds_hold_without_a_ball_or_half_spaces() -> None:
    for given in ({"max_length": 14}, {"max_curvature": 1}, {"max_length": 14, "degree": 5}):
        made = bezier.chain(start=[0, 0], via=[[4, 3], [6, 1]], goal=[8, 0], **given)
        assert made.feasible and checked(made.chain, made.proof)
        assert not limits.keeps_limits(made.chain, made.curves)
    assert not bezier.chain(start=[0, 0], via=[[4, 3], [6, 1]], goal=[8, 0], max_length=9).feasible


def test_a_witness_that_is_none_is_refused_where_a_bound_has_to_be_kept() -> None:
    made = chain(max_length=14)
    (below, above) = made.proof.payload
    step = dict(above.certificate.payload)
    step["steps"] = [{**step["steps"][0], "rule": "signs"}]
    other = Certificate.bundle(
        [(below.label, below.certificate), (above.label, replace(above.certificate, payload=step))]
    )
    with pytest.raises(CertificateRejected, match="expected a witness"):
        checked(made.chain, other)


def test_a_broken_proposer_breaks_no_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    honest, chance = proposals.best, np.random.default_rng(7)

    def broken(*given: Any) -> Any:
        answer = honest(*given)
        if answer is None:
            return None
        point = tuple(tuple(c + float(chance.choice([0, 0, 0, 0.1, -1])) for c in p) for p in answer.point)
        return proposals.Proposal(
            point, tuple(w * float(chance.choice([1, 1, 0, -1, 9])) for w in answer.weights), -1.0
        )

    monkeypatch.setattr(proposals, "best", broken)
    accepted = 0
    for k in range(3):
        most = 6.9 + k / 50
        try:
            made = chain(PLANE[:4], max_length=most, max_curvature=3, degree=5)
        except Unable:
            continue
        accepted += 1
        assert made.feasible and checked(made.chain, made.proof)
        assert sum(sampled(curve)[0] for curve in made.curves) <= most + 1e-6
    assert accepted < 3


def test_free_durations_are_no_worse_than_equal_ones() -> None:
    equal, free = (chain(degree=5, objective="jerk", durations=times) for times in ((), "free"))
    assert sum(free.chain.times) == 4 and free.searched and free.value < equal.value * Fraction(9, 10)
    again = chain(degree=5, objective="jerk", durations=free.chain.times)
    assert again.value == free.value
    slow = chain(degree=5, objective="jerk", durations="free", total=8)
    assert sum(slow.chain.times) == 8 and float(slow.value) == pytest.approx(float(free.value) / 32, rel=1e-3)


@each(
    ({}, "395/42"),
    ({"radius": "29/4"}, None),
    ({"half_spaces": [([0, -1], -4.05)]}, None),
)
def test_optima_with_few_active_conditions_are_exact(given: Any, value: str | None) -> None:
    made = chain(**given)
    assert made.exactly() is made.exact is not None and qe.verify(made.exact.certificate).accepted
    assert made.bound <= made.exact.value <= made.value
    assert value is None or made.exact.value == Fraction(value)
    assert made.exact.curves[0].points[0] == made.curves[0].points[0]


def test_two_active_conditions_on_demand() -> None:
    points = [[-4, 0], [-3, 2], [-1, 3], [1, 1.5], [2, 2.5], [3.5, 1], [4, -1]]
    made = chain(points, radius="17/4", durations=[1, 1, 1.2, 0.8, 1, 1], half_spaces=[([0, -1], -3.05)])
    exact = made.exactly()
    assert made.exact is None and exact is not None and qe.verify(exact.certificate).accepted
    assert made.bound <= exact.value <= made.value

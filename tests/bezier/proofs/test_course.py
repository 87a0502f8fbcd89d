"""Arms along curves in balls, and joint positions at a point: what the checkers compute."""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from flint import arb

from bezier.arm.motion_chain import solved
from bezier.proofs.arm_rows import ArmChain
from bezier.proofs.course import Course, Lines, around, radius_above, strictly_within
from bezier.proofs.course import ball as ball_of
from bezier.proofs.inverse_position import check_positions
from bezier.proofs.square_roots import ONE, STILL, ZERO, Surd, turn
from qe.errors import BudgetExceeded, CertificateRejected
from qe.proof.entry import Entry
from tests.certificates.test_joint_positions import payload_of
from tests.tables import each
from tests.unit.certify.claims import limits

HALF = (Surd.of([(3, Fraction(1, 2))]), Surd.rational(Fraction(1, 2)))
LONG = (ZERO, ZERO, Surd.rational(3))
BENT = turn((1, 2), HALF, (Surd.rational(2), ONE, ZERO))
CHAINS = {
    "turns": ArmChain((BENT, turn((0, 1), HALF, LONG), BENT, (STILL[0], LONG)), (True, True, True)),
    "slides": ArmChain((BENT, BENT, turn((0, 1), HALF, LONG), BENT), (True, False, True)),
    "slides first": ArmChain((STILL, BENT, BENT, BENT), (False, True, True)),
}
CURVE = [[Fraction(1), Fraction(2)], [Fraction(3), Fraction(0), Fraction(1, 2)], [Fraction(-1, 3)]]
Q, RATES = (0.3, -0.7, 1.1), (0.5, 0.2, -0.4)


def tip(chain: ArmChain, q: Sequence[float]) -> np.ndarray:
    """The end point seen from the base, by products of matrices."""
    whole = np.eye(4)
    for turns, value, (rows, shift) in zip(chain.turns, q, chain.in_numbers(float)[1:]):
        c, s, d = (math.cos(value), math.sin(value), 0.0) if turns else (1.0, 0.0, value)
        link = np.array([*([*row, o] for row, o in zip(rows, shift)), [0, 0, 0, 1]])
        whole = whole @ [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]] @ link
    return whole[:3, 3]


def target(chain: ArmChain, s: float, first: float) -> np.ndarray:
    """The curve seen from what the first joint carries."""
    rows, shift = (np.array(part) for part in chain.in_numbers(float)[0])
    x, y, z = rows.T @ (np.array([sum(float(c) * s**k for k, c in enumerate(row)) for row in CURVE]) - shift)
    c, s = math.cos(first), math.sin(first)
    return np.array([c * x + s * y, c * y - s * x, z] if chain.turns[0] else [x, y, z - first])


def lines(rates: Sequence[float] = RATES) -> Lines:
    return Lines(arb(0.25), [arb(v) for v in Q], [arb(v) for v in rates])


@pytest.mark.parametrize("name", CHAINS)
def test_ends_and_targets_with_their_derivatives(name: str) -> None:
    chain, h = CHAINS[name], 1e-4
    here = Course(chain, CURVE)
    point, jacobian = here.tip([arb(v) for v in Q])
    assert [float(v) for v in point] == pytest.approx(list(tip(chain, Q)))
    for j in range(3):
        ahead, behind = ([v + (k == j) * d for k, v in enumerate(Q)] for d in (h, -h))
        column = [float(jacobian[i, j]) for i in range(3)]
        assert column == pytest.approx(list((tip(chain, ahead) - tip(chain, behind)) / (2 * h)), abs=1e-6)
    ends = here.tip_along([arb(v) for v in Q], [arb(v) for v in RATES], 2)
    goals = here.target(lines(), arb(0), 2)
    for jet, f in (
        (ends, lambda t: tip(chain, [v + r * t for v, r in zip(Q, RATES)])),
        (goals, lambda t: target(chain, 0.25 + t, Q[0] + RATES[0] * t)),
    ):
        a, b, c = f(-h), f(0), f(h)
        assert list(map(float, jet[0])) == pytest.approx(list(b))
        assert list(map(float, jet[1])) == pytest.approx(list((c - a) / (2 * h)), abs=1e-6)
        assert list(map(float, jet[2])) == pytest.approx(list((c - 2 * b + a) / h**2), abs=1e-5)


@pytest.mark.parametrize("name", CHAINS)
def test_the_error_holds_for_every_parameter(name: str) -> None:
    chain, half = CHAINS[name], Fraction(1, 10)
    found = Course(chain, CURVE).error(lines(), arb(0), around(half))
    for k in range(-5, 6):
        t = k / 50
        q = [0.0, *(v + r * t for v, r in zip(Q[1:], RATES[1:]))]
        error = tip(chain, q) - target(chain, 0.25 + t, Q[0] + RATES[0] * t)
        assert all((ball + arb(0, 1e-12)).contains(arb(v)) for ball, v in zip(found, error))


RADII = [Fraction(1, 10), Fraction(1, 10), Fraction(1, 10)]
FLAT = ArmChain(
    (STILL, (STILL[0], (Surd.rational(2), ZERO, ZERO)), (STILL[0], (Surd.rational(2), ZERO, ZERO)), STILL),
    (True, True, False),
)


def test_the_image_of_krawczyk_holds_the_solution_for_every_parameter() -> None:
    """Two links in the plane, and a slide across it, along (3 + s/10, 1/2, 1 - s)."""
    here = Course(FLAT, [[Fraction(3), Fraction(1, 10)], [Fraction(1, 2)], [Fraction(1), Fraction(-1)]])
    start = solved(here, Fraction(0), (-0.5, 1.2, 1.0))
    assert start is not None
    centre = list(map(Fraction, start))
    found = here.image(Lines.of(Fraction(0), centre, [Fraction(0)] * 3), Fraction(0), Fraction(1, 80), RADII)
    assert found is not None and strictly_within(found, RADII)
    for k in range(-4, 5):
        position = solved(here, Fraction(k, 320), start)
        assert position is not None
        assert all((x + arb(0, 1e-12)).contains(arb(v - c)) for x, v, c in zip(found, position, start))
    away = here.image(
        Lines.of(Fraction(0), [c + 1 for c in centre], [Fraction(0)] * 3), Fraction(0), Fraction(0), RADII
    )
    assert away is not None and not strictly_within(away, RADII)


def test_a_singular_matrix_has_no_image() -> None:
    here = Course(FLAT, [[Fraction(4)], [Fraction(0)], [Fraction(0)]])
    stretched = Lines.of(Fraction(0), [Fraction(0)] * 3, [Fraction(0)] * 3)
    assert here.image(stretched, Fraction(0), Fraction(0), RADII) is None


def test_bounds_of_balls() -> None:
    ball = ball_of(Fraction(1, 3)) + around(Fraction(1, 3))
    assert Fraction(2, 3) <= radius_above(ball) < Fraction(667, 1000)
    assert radius_above(-ball) == radius_above(ball)
    assert not strictly_within([ball], [Fraction(2, 3)])
    assert strictly_within([ball], [Fraction(667, 1000)])
    assert not strictly_within([ball, arb("nan")], [Fraction(1)] * 2)


@pytest.fixture(scope="module")
def right() -> dict[str, Any]:
    return json.loads(json.dumps(payload_of("four at a point")))


def test_it_is_accepted(right: dict[str, Any]) -> None:
    check_positions(Entry(right, "payload"), limits())


@each(
    {
        "one more": (lambda p: p.update(count=p["count"] + 1), "payload.count", "not the number of solutions"),
        "a root less": (
            lambda p: p.update(roots=p["roots"][1:], count=p["count"] - len(p["roots"][0]["solutions"])),
            "payload.roots",
            "not all roots with a solution are listed",
        ),
        "another order": (lambda p: p["roots"].reverse(), "payload.roots[1]", "in ascending order"),
        "an overlap": (
            lambda p: p["roots"][1].update(low=p["roots"][0]["low"]),
            "payload.roots[1]",
            "in ascending order",
        ),
        "a common end": (lambda p: p["roots"][1].update(low=p["roots"][0]["high"]), "payload.roots[1]", "ascending"),
        "an empty interval": (
            lambda p: p["roots"][0].update(low=p["roots"][0]["high"]),
            "payload.roots[0]",
            "ascending",
        ),
        "a solution less": (lambda p: p["roots"][0]["solutions"].pop(), "payload.roots[0].solutions", "not the number"),
        "the boxes of another root": (
            lambda p: p["roots"][0].update(solutions=p["roots"][1]["solutions"]),
            "payload.roots[0].solutions",
            "not proved to lie in a box of its own",
        ),
        "no rotation": (lambda p: p.update(rotation=[[[["1", 1]]] * 3] * 3), "payload.rotation", "rows of a rotation"),
    }
)
def test_the_wrong_entry_is_named(change: Any, where: str, reason: str, right: dict[str, Any]) -> None:
    wrong = copy.deepcopy(right)
    change(wrong)
    with pytest.raises(CertificateRejected, match=reason) as refused:
        check_positions(Entry(wrong, "payload"), limits())
    assert refused.value.step == where


def test_a_budget_ends_it(right: dict[str, Any]) -> None:
    with pytest.raises(BudgetExceeded):
        check_positions(Entry(right, "payload"), limits(0))

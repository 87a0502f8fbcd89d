"""Duals, and joint positions at a point: what the checkers compute."""

from __future__ import annotations

import copy
import json
import math
from fractions import Fraction
from typing import Any

import pytest
from flint import arb

from bezier.proofs import duals
from bezier.proofs.duals import Dual
from bezier.proofs.inverse_position import check_positions
from bezier.proofs.square_roots import ONE, ZERO, Surd, turn
from qe.errors import BudgetExceeded, CertificateRejected
from qe.proof.entry import Entry
from tests.certificates.test_joint_positions import payload_of
from tests.tables import each
from tests.unit.certify.claims import limits


def floats(d: Dual) -> tuple[float, ...]:
    return float(d.value), *map(float, d.slope)


def variables(*values: Fraction) -> list[Dual]:
    return [duals.seed(duals.ball(v), k, len(values)) for k, v in enumerate(values)]


def test_values_and_derivatives_of_sums_products_and_angles() -> None:
    x, y = variables(Fraction(1, 3), Fraction(2))
    assert floats(x * y + x) == pytest.approx((1, 3, 1 / 3))
    assert floats(x - y * y) == pytest.approx((1 / 3 - 4, 1, -4))
    sine, cosine = (x * y).sine_cosine()
    at = 2 / 3
    assert floats(sine) == pytest.approx((math.sin(at), 2 * math.cos(at), math.cos(at) / 3))
    assert floats(cosine) == pytest.approx((math.cos(at), -2 * math.sin(at), -math.sin(at) / 3))
    assert floats(duals.number(Fraction(5, 2), 2)) == (2.5, 0, 0)


def test_motions() -> None:
    x, y, z = variables(Fraction(1), Fraction(2), Fraction(3))
    half = turn((1, 2), (Surd.of([(3, Fraction(1, 2))]), Surd.rational(Fraction(1, 2))), (ONE, ZERO, ZERO))
    root = math.sqrt(3) / 2
    found = [floats(v) for v in duals.rigid(half)([x, y, z])]
    expected = [(2, 1, 0, 0), (2 * root - 1.5, 0, root, -0.5), (1 + 3 * root, 0, 0.5, root)]
    assert [v for row in found for v in row] == pytest.approx([v for row in expected for v in row])
    assert [floats(v) for v in duals.moved(False, x, [x, y, z])] == [floats(x), floats(y), floats(z + x)]
    turned = [floats(v)[0] for v in duals.moved(True, x, [x, y, z])]
    c, s = math.cos(1), math.sin(1)
    assert turned == pytest.approx([c - 2 * s, s + 2 * c, 3])
    assert [floats(-v)[0] for v in (x, y)] == [-1, -2] and floats(-x)[1:] == (-1, 0, 0)


RADII = [Fraction(1, 4), Fraction(1, 4), Fraction(1, 2)]


def system(half: Fraction, radii: list[Fraction], middle: Fraction) -> list[arb] | None:
    """Krawczyk's image for r1 = middle + sigma, r2 = r1^2, r3 = r1 + r2, for |sigma| <= half, around r = 0."""

    def f(sigma: arb, r: list[arb]) -> list[Dual]:
        s = duals.seed(sigma, 0, 4)
        x, y, z = (duals.seed(v, j + 1, 4) for j, v in enumerate(r))
        return [x - s - duals.number(middle, 4), y - x * x, z - x - y]

    zero = [duals.ball(Fraction(0))] * 3
    wide, box = duals.around(half), [duals.around(r) for r in radii]
    return duals.krawczyk(f(zero[0], zero), f(wide, zero), f(wide, box), wide, box)


def test_the_image_of_krawczyk_holds_the_solution_for_every_parameter() -> None:
    image = system(Fraction(1, 20), RADII, Fraction(1, 10))
    assert image is not None
    assert duals.strictly_within(image, RADII)
    for k in range(-4, 5):
        x = Fraction(1, 10) + Fraction(k, 80)
        for value, ball in zip((x, x * x, x + x * x), image, strict=True):
            assert ball.contains(duals.ball(value))
    far = system(Fraction(1, 20), RADII, Fraction(1))  # the solution lies outside the box
    assert far is not None
    assert not duals.strictly_within(far, RADII)


def test_a_singular_matrix_has_no_image() -> None:
    zero = [duals.seed(duals.ball(Fraction(0)), 0, 4)] * 3
    assert duals.krawczyk(zero, zero, zero, arb(0), [arb(0)] * 3) is None


def test_bounds_of_balls() -> None:
    ball = duals.ball(Fraction(1, 3)) + duals.around(Fraction(1, 3))
    assert Fraction(2, 3) <= duals.radius_above(ball) < Fraction(667, 1000)
    assert duals.radius_above(-ball) == duals.radius_above(ball)
    assert not duals.strictly_within([ball], [Fraction(2, 3)])
    assert duals.strictly_within([ball], [Fraction(667, 1000)])
    assert not duals.strictly_within([ball, arb("nan")], [Fraction(1)] * 2)


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

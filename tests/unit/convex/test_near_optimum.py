"""Optima whose exact numbers need a field of high degree: rational numbers on both sides of them, with proofs."""

import json
from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.convex.near_optimum import GAP
from qe.convex.optimum import Optimum, OptimumStatus

BALLS = (
    "(3*x-9)^2 + (2*y+1)^2 + (2*z-6)^2 + (8*w-6)^2 <= 316",
    "(7*x+3)^2 + (2*y-6)^2 + (z-3)^2 + (7*w+9)^2 <= 328",
    "(8*x+1)^2 + (4*y-9)^2 + (2*z-1)^2 + (w+9)^2 <= 156",
    "(9*x+9)^2 + (7*y+3)^2 + (7*z+9)^2 + (9*w+2)^2 <= 345",
)
OBJECTIVE, LEAST = "x + 2*y - 3*z + w", F("-4.6756087035")


def proved(found: Optimum, sign: int = 1) -> None:
    """Both sides are proved, and as close as they are said to be."""
    assert found.status is OptimumStatus.NEAR_OPTIMAL and found.bound is not None and found.value is not None
    assert 0 < sign * (found.value - found.bound) <= GAP * abs(found.value)
    assert all(isinstance(v, F) for v in (found.value, found.bound, *found.point.values(), *found.multipliers))
    verdict = qe.verify(found.certificate)
    assert verdict.accepted, verdict


def test_a_degree_beyond_the_limit_is_no_longer_the_end() -> None:
    """Four ellipsoids: "the exact optimum seems to need a number field of degree above 40"."""
    found = qe.minimize(OBJECTIVE, BALLS, method="convex", check=True)
    proved(found)
    assert found.guarantee is qe.Guarantee.CHECKED and not found.reason
    assert found.bound <= LEAST + F(1, 10**9) and abs(found.value - LEAST) < F(1, 10**8)
    assert found.active and found.attained is None and found.unique is None
    assert "near" in repr(found) and r"\approx" in found._repr_latex_()


@pytest.mark.parametrize(
    ("objective", "conditions"),
    [
        (f"{OBJECTIVE} + v", (*BALLS, "v = 3*x - 2*y + 1/7")),
        (OBJECTIVE, tuple(ball.replace("<=", "<") for ball in BALLS)),
        (f"{OBJECTIVE} + v", (*BALLS, "v^2 <= 0")),
        (f"{OBJECTIVE} + v", (*BALLS, "v >= x - y", "v >= -100")),
        (f"10^30*({OBJECTIVE})", BALLS),
        (f"({OBJECTIVE})/10^40", BALLS),
        (f"{OBJECTIVE} + {F('4.675608703')}", BALLS),
        (OBJECTIVE, tuple(ball.replace("x", "(x - 10^9)") for ball in BALLS)),
        (OBJECTIVE, tuple(ball.replace("y", "(10^6*y)").replace("z", "(10^6*z)") for ball in BALLS)),
    ],
    ids=["equation", "strict", "face", "linear", "huge", "tiny", "near zero", "far", "thin"],
)
def test_neither_equations_nor_sizes_are_in_the_way(objective: str, conditions: tuple[str, ...]) -> None:
    proved(qe.minimize(objective, conditions, method="convex"))


def test_a_maximum_is_bounded_from_above() -> None:
    most, least = qe.maximize(f"-({OBJECTIVE})", BALLS, method="convex"), qe.minimize(OBJECTIVE, BALLS)
    proved(most, -1)
    assert isinstance(least, Optimum) and (most.value, most.bound) == (-least.value, -least.bound)  # type: ignore[operator]


def test_where_no_point_has_room_exact_numbers_are_tried_as_before() -> None:
    """Without interior points there is no room for rational numbers."""
    found = qe.minimize(OBJECTIVE, (*BALLS, "(u - v)^2 + (u - 2)^2 <= 0"), method="convex", timeout=60)
    assert found.is_optimal and found.bound is None


def test_a_bound_that_is_too_good_is_rejected() -> None:
    found = qe.minimize(OBJECTIVE, BALLS, method="convex")
    known = json.loads(found.certificate.to_json())
    text = json.dumps(known)

    def altered(change: object) -> bool:
        data = json.loads(text)
        change(data)  # type: ignore[operator]
        return qe.verify(qe.Certificate.from_json(json.dumps(data))).accepted

    def raised(data: dict) -> None:  # the last condition is f - bound < 0
        constant = data["certificates"][0]["payload"]["steps"][0]["evidence"]["problem"]["constraints"][-1]["terms"][0]
        constant[0] = str(F(constant[0]) - F(1, 10**7))

    def nearer(data: dict) -> None:  # the value that the point is said to reach
        values = data["certificates"][1]["payload"]["steps"][0]["evidence"]["values"]
        values[0] = str(F(values[0]) + F(1, 10**6))

    assert altered(lambda data: None) and not altered(raised) and not altered(nearer)


weights = st.lists(st.integers(1, 9), min_size=4, max_size=4)
centres = st.lists(st.integers(-9, 9), min_size=4, max_size=4)


@settings(max_examples=12, deadline=None)
@given(st.lists(st.tuples(weights, centres, st.integers(250, 400)), min_size=4, max_size=4), weights)
def test_every_convex_problem_with_room_gets_an_answer(ellipsoids: list, goal: list[int]) -> None:
    conditions = [
        " + ".join(f"({a}*{name} + {c})^2" for a, c, name in zip(slopes, middle, "xyzw", strict=True)) + f" <= {size}"
        for slopes, middle, size in ellipsoids
    ]
    found = qe.minimize(" + ".join(f"{c}*{n}" for c, n in zip(goal, "xyzw", strict=True)), conditions, method="convex")
    if found.status is OptimumStatus.NEAR_OPTIMAL:
        proved(found)
    else:
        assert found.status in (OptimumStatus.OPTIMAL, OptimumStatus.INFEASIBLE)

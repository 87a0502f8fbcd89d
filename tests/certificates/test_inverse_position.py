"""Certificates of all joint positions at a point; right ones are accepted, changed ones are not."""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from math import sqrt
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm.inverse import solve
from bezier.arm.inverse_evidence import _box, _over, _parameter, _wider, inverse_certificate
from bezier.arm.kinematics import position
from bezier.arm.reader import load_arm, read_arm, read_exact
from bezier.arm.roots_of_squares import square_roots
from bezier.certify import square_roots as sr
from bezier.certify.square_roots import ONE, Polynomial, Surd
from qe.certify.verify import verify, verify_json
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from tests.certificates.mutation import leaves
from tests.certificates.restated import evidence_of, verdict_by

POINT = ("599/66", "824/33", "323/10")
EDGES = {
    "outer border": (("44*sqrt(2) + 8*sqrt(293) + 120", "0", "104 + 44*sqrt(2)"), 1),
    "inner border": (("44*sqrt(2) + 8*sqrt(293) - 120", "0", "104 + 44*sqrt(2)"), 3),
    "inner border, written otherwise": (("-44*sqrt(2) + 8*sqrt(293) - 120 + 2*44*sqrt(2)", "0", "104 + 44*sqrt(2)"), 3),
    "axis, out of reach": (("0", "0", "500"), 0),
    "circle of the shoulder": (("44*sqrt(2)", "0", "104 + 44*sqrt(2)"), 2),
    "outer border from above": (("0", "44*sqrt(2)", "104 + 44*sqrt(2) + 8*sqrt(293) + 120"), 1),
    "y = 0": (("100", "0", "100"), 4),
    "z = 104 + 44 sqrt 2": (("100", "50", "104 + 44*sqrt(2)"), 4),
    "far away": (("1000", "1/7", "-3"), 0),
}
SKEW = """convention = "modified"
[[row]]
joint = "t1"
alpha = {cos = "4/5", sin = "3/5"}
a = 5
d = 3
[[row]]
joint = "t2"
a = 20
alpha = {cos = "5/13", sin = "12/13"}
d = 7
theta = "pi/4"
[[row]]
joint = "t3"
a = 30
alpha = {cos = "3/5", sin = "4/5"}
d = 4
[[row]]
a = 25
"""


def made(arm: str, point: tuple[str, ...]) -> dict[str, Any]:
    return evidence_of(inverse_certificate(solve(load_arm(arm), [read_exact(c) for c in point])))


def accepted(payload: Any) -> bool:
    verdict = verdict_by("joint positions", payload)
    assert verdict.decided and (verdict.accepted or verdict.step.startswith("payload"))
    return verdict.accepted


@pytest.mark.parametrize("name", EDGES)
def test_borders_and_degenerate_points(name: str) -> None:
    point, count = EDGES[name]
    payload = made("ev3-120", point)
    assert payload["count"] == count
    assert accepted(payload)
    assert not accepted({**payload, "count": count + 1})
    moved = [
        [["1/1000000000000000000000", 1]] if not c else [[c[0][0], c[0][1]], ["1/1000000000000000000000", 3]]
        for c in payload["point"]
    ]
    if name == "outer border":
        assert not accepted({**payload, "point": moved}), "no double root there"


def test_two_solutions_for_one_last_joint() -> None:
    """Axes 1 and 2 meet: each root of the equation has two solutions, on the border one."""
    for point, counts in (
        (("100", "50", "120"), [2, 2]),
        (("210", "0", "100"), [2]),
        (("-50", "1/3*sqrt(5)", "130"), [2, 2]),
    ):
        payload = made("shoulder-3r", point)
        found = [len(root["solutions"]) for root in payload["roots"]]
        assert sum(found) == payload["count"] and accepted(payload), (found, counts)
        if payload["count"] == 4:
            assert found == counts
            payload["roots"][0]["solutions"].append(payload["roots"][0]["solutions"].pop(0))
            assert accepted(payload), "their order says nothing"
            payload["roots"][0]["solutions"][0] = payload["roots"][0]["solutions"][1]
            assert not accepted(payload)


def test_axes_askew() -> None:
    arm = read_arm(SKEW)
    assert verify(inverse_certificate(solve(arm, (3, 50, 30)))).accepted  # made only where the checker accepts


@pytest.fixture(scope="module")
def payload() -> dict[str, Any]:
    return made("ev3-120", POINT)


CHANGES: dict[str, Callable[[dict[str, Any]], object]] = {
    "another arm": lambda p: p["arm"]["rows"][7].update(a="121"),
    "another convention": lambda p: p["arm"].update(convention="standard"),
    "another angle": lambda p: p["arm"]["rows"][1].update(theta=4),
    "a joint that slides": lambda p: p["arm"]["rows"][0].update(joint="prismatic"),
    "two joints": lambda p: p["arm"]["rows"][0].update(joint=None),
    "another point": lambda p: p["point"].__setitem__(0, [["599/67", 1]]),
    "two coordinates": lambda p: p["point"].pop(),
    "a square under the root": lambda p: p["point"].__setitem__(0, [["599/132", 4]]),
    "no turn": lambda p: p.update(turn=["1", "1"]),
    "a root left out": lambda p: p["roots"].pop(),
    "a root left out, and the count": lambda p: (p["roots"].pop(), p.update(count=3)),
    "no solution": lambda p: p.update(count=0, roots=[]),
    "a root twice": lambda p: p["roots"].insert(1, p["roots"][0]),
    "a wider interval": lambda p: p["roots"][0].update(low="-100"),
    "all roots in one": lambda p: p.update(roots=[{**p["roots"][0], "low": "-100", "high": "100"}]),
    "boxes exchanged": lambda p: p["roots"][0].update(solutions=p["roots"][1]["solutions"]),
    "two boxes": lambda p: p["roots"][0]["solutions"].append(p["roots"][1]["solutions"][0]),
    "large boxes": lambda p: [r.update(solutions=[[[["-1", "1"]] * 2] * 3]) for r in p["roots"]],
    "a joint less": lambda p: p["roots"][0]["solutions"][0].pop(),
    "a float": lambda p: p["roots"][0].update(low=0.5),
    "another field": lambda p: p.update(more=1),
}


@pytest.mark.parametrize("what", CHANGES)
def test_changed_certificates_are_rejected(payload: dict[str, Any], what: str) -> None:
    changed = json.loads(json.dumps(payload))
    assert accepted(changed)
    CHANGES[what](changed)
    assert not accepted(changed)


def test_boxes_and_intervals_may_not_lose_their_solution(payload: dict[str, Any]) -> None:
    ends = [path for path, _ in leaves(payload) if path[0] == "roots"]
    for path in ends[::9]:
        changed = json.loads(json.dumps(payload))
        node: Any = changed
        for key in path[:-1]:
            node = node[key]
        inwards = Fraction(1, 10) if path[-1] in (0, "low") else Fraction(-1, 10)
        node[path[-1]] = str(Fraction(node[path[-1]]) + inwards)
        assert not accepted(changed), path


def test_the_angle_that_t_misses_cannot_hide_a_solution() -> None:
    """θ7 = pi is a solution, but no t: without it the other three and their intervals are right."""
    arm = load_arm("ev3-120")
    point = position(arm, {"theta1": (1, 0), "theta4": (Fraction(3, 5), Fraction(4, 5)), "theta7": (-1, 0)})
    found = solve(arm, point)
    payload = evidence_of(inverse_certificate(found))
    assert payload["turn"] != ["1", "0"] and payload["count"] == 4
    others = [s for s in found.solutions if abs(s.angles[2] or 0) < 3.1]
    turn = (Fraction(1), Fraction(0))
    t = sorted(_parameter(s, turn, 100) for s in others)
    around = [_wider((v, v), 100) for v in t]
    roots = _over(around, [_parameter(s, turn, 100) for s in others], [_box(s, 30) for s in others])
    assert len(roots) == 3 and all(root["solutions"] for root in roots)
    assert not accepted({**payload, "turn": ["1", "0"], "count": 3, "roots": roots})


def test_as_text() -> None:
    certificate = inverse_certificate(solve(load_arm("ev3-112"), (0, 60, 250)))
    assert verify_json(certificate.to_json()).accepted
    assert not verify_json(certificate.to_json().replace('"112"', '"113"')).accepted


def test_what_has_no_certificate() -> None:
    cubic = read_exact("0") + solve(load_arm("ev3-120"), (1, 2, 3)).point[0]
    assert cubic == 1
    root = RealAlgebraic.from_root([-2, 0, 0, 1], 1, 2)
    with pytest.raises(Unable, match="certificates of joint positions"):
        inverse_certificate(solve(load_arm("ev3-120"), (root, 0, 100)))


# --- the arithmetic ----------------------------------------------------------------------------------------------
SURDS = st.lists(
    st.tuples(st.sampled_from([1, 2, 3, 5, 6, 10, 15, 293]), st.fractions(-9, 9, max_denominator=7)), max_size=4
)


@settings(max_examples=25)
@given(SURDS, SURDS)
def test_numbers(one: list[tuple[int, Fraction]], other: list[tuple[int, Fraction]]) -> None:
    a, b = Surd.of(one), Surd.of(other)
    x, y = (sum(float(q) * sqrt(d) for d, q in pairs) for pairs in (one, other))
    for exact, near in ((a + b, x + y), (a - b, x - y), (a * b, x * y)):
        low, high = exact.interval(80)
        assert float(low) - 1e-9 <= near <= float(high) + 1e-9
    if a:
        assert a * a.inverse() == ONE
        assert a.sign() == (1 if x > 0 else -1) or abs(x) < 1e-9
    assert (a - a).sign() == 0 and (a * b).sign() == a.sign() * b.sign()


def test_a_sign_that_is_hard_to_see() -> None:
    """sqrt 2 against a convergent of its continued fraction."""
    p, q = 1, 1
    for _ in range(120):
        p, q = p + 2 * q, p + q
    gap = Surd.of([(2, Fraction(1)), (1, -Fraction(p, q))])
    assert gap.sign() == (1 if p * p < 2 * q * q else -1)


@settings(max_examples=15)
@given(st.lists(st.integers(-4, 4), min_size=1, max_size=4), st.lists(st.integers(-4, 4), min_size=1, max_size=3))
def test_tarskis_query(roots: list[int], other: list[int]) -> None:
    p, s = Polynomial((ONE,)), Polynomial((ONE,))
    for r in roots:
        p = p * Polynomial((Surd.rational(-r), ONE))
    for r in other:
        s = s * Polynomial((Surd.of([(2, Fraction(-r))]), ONE))

    def sign(x: int) -> int:
        values = [x - r * sqrt(2) for r in other]
        return 0 if 0 in values else (-1) ** sum(v < 0 for v in values)

    assert sr.tarski(p, s) == sum(map(sign, set(roots)))
    inside = {r for r in roots if r > -1}
    half = Fraction(-1, 2), Fraction(9, 2)
    assert sr.tarski(p, s, half) == sum(map(sign, inside))
    assert sr.tarski(p * Polynomial((ONE, Surd(()), ONE)), Polynomial((ONE,))) == len(set(roots))


def test_a_large_square_under_a_square_root() -> None:
    """Three times the square of a large prime was not recognised: there was no certificate."""
    for large in (2**61 - 1, (2**61 - 1) * (2**89 - 1), 10**40 + 121):
        for d in (2, 3, 6):
            root = RealAlgebraic.from_root([-d * large * large, 0, 7], 0, large * 3)
            assert square_roots(root) == {7 * d: Fraction(large, 7)}


def test_coordinates_as_square_roots() -> None:
    assert square_roots(read_exact("44*sqrt(2) + 8*sqrt(293) + 120")) == {1: 120, 2: 44, 293: 8}
    assert square_roots(read_exact("1/3*sqrt(8) - 1/7")) == {1: Fraction(-1, 7), 2: Fraction(2, 3)}
    assert square_roots(read_exact("sqrt(2) + sqrt(3)/2 + sqrt(5) + 90")) == {1: 90, 2: 1, 3: Fraction(1, 2), 5: 1}
    quotient = square_roots(read_exact("1/(sqrt(2) + sqrt(3) + 1)"))
    assert quotient == {1: Fraction(1, 2), 2: Fraction(1, 4), 6: Fraction(-1, 4)}


@pytest.mark.parametrize(
    "coefficients", [[-2, 0, 0, 1], [2, 0, -4, 0, 1], [1, -3, 0, 1], [-2, 0, 0, 0, 1], [-1, -1, 0, 0, 1]]
)
def test_numbers_that_are_no_sums_of_square_roots(coefficients: list[int]) -> None:
    """A number without other real conjugates is no empty sum."""
    with pytest.raises(Unable, match="sums of square roots"):
        square_roots(RealAlgebraic.by_index(coefficients, 0))

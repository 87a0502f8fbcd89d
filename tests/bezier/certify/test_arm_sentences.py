"""Sentences about arms: the equations hold where the arm is, in floats of a chain of its own, and nowhere beside it."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import product
from math import cos, isclose, pi, sin
from typing import Any

import pytest

import qe
from bezier.arm.inverse import solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.reader import read_arm
from bezier.certify.arm_rows import ArmChain, read_chain
from bezier.certify.arm_sentences import ArmEquations, constant, ring_of, with_roots
from bezier.certify.square_roots import Motion, Surd
from qe.exact.ring import Ring
from qe.formula.build import conj
from qe.formula.evaluate import substituted
from qe.formula.syntax import FALSE, TRUE
from qe.proof.entry import Entry

Matrix = list[list[float]]


def chain_of(rng: random.Random, joints: int) -> ArmChain:
    """An arm with angles of twelfths of pi, and others."""
    rows: list[Any] = [
        {
            "a": str(rng.choice((0, 1, 2, "1/2"))),
            "alpha": rng.choice((0, 3, 6, -6, 4, ["3/5", "4/5"])),
            "d": str(rng.choice((0, 1, "1/3"))),
            "theta": rng.choice((0, 2, 6, ["3/5", "-4/5"])),
            "joint": rng.choice(("revolute", "revolute", "prismatic")),
        }
        for _ in range(joints)
    ]
    arm = {"convention": rng.choice(("modified", "standard")), "rows": [*rows, {**rows[0], "joint": None}]}
    return read_chain(Entry(arm, "arm"))


def as_float(value: Surd) -> float:
    return sum(float(q) * d**0.5 for d, q in value.terms)


def times(a: Matrix, b: Matrix) -> Matrix:
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def matrix(motion: Motion) -> Matrix:
    rows, shift = motion
    return [[*(as_float(c) for c in row), as_float(o)] for row, o in zip(rows, shift)] + [[0.0, 0.0, 0.0, 1.0]]


def moved(turns: bool, q: float) -> Matrix:
    if not turns:
        return [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, q], [0, 0, 0, 1]]
    return [[cos(q), -sin(q), 0, 0], [sin(q), cos(q), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def whole(chain: ArmChain, joints: list[float]) -> Matrix:
    result = matrix(chain.constants[0])
    for turns, q, constant_part in zip(chain.turns, joints, chain.constants[1:]):
        result = times(times(result, moved(turns, q)), matrix(constant_part))
    return result


def values(equations: ArmEquations, chain: ArmChain, joints: list[float]) -> list[float]:
    """Of the expressions at joint values."""
    named: dict[str, float] = {}
    for names, turns, q in zip(equations.names, chain.turns, joints):
        named |= dict(zip(names, (cos(q), sin(q)) if turns else (q,)))
    found = []
    for expression in equations.expressions:
        total = 0.0
        for variables, c in expression.items():
            term = as_float(c)
            for name in variables:
                term *= named[name]
            total += term
        found.append(total)
    return found


@pytest.mark.parametrize("seed", range(12))
def test_the_end_point_is_where_the_equations_say(seed: int) -> None:
    rng = random.Random(seed)
    chain = chain_of(rng, 3)
    joints = [rng.uniform(-3, 3) for _ in range(3)]
    place = [row[3] for row in whole(chain, joints)[:3]]
    at_origin = ArmEquations.at_point(chain, [{}, {}, {}])
    assert all(isclose(a, b, abs_tol=1e-9) for a, b in zip(values(at_origin, chain, joints), place))
    somewhere = ArmEquations.at_point(chain, [constant(Surd.rational(k)) for k in (1, 2, 3)])
    found = values(somewhere, chain, joints)
    assert all(isclose(a + k, b, abs_tol=1e-9) for k, a, b in zip((1, 2, 3), found, place))


QUARTERS = (0, pi / 2, pi, -pi / 2)


@pytest.mark.parametrize("size", [3, 5, 6])
def test_a_pose_holds_for_its_joints_and_not_for_others(size: int) -> None:
    """The pose is that of an arm at quarter turns, whose numbers are exact."""
    rng = random.Random(size)
    for _ in range(4):
        chain = chain_of(rng, size)
        quarters = [rng.randrange(4) for _ in range(size)]
        joints = [QUARTERS[k] if turns else float(k) for k, turns in zip(quarters, chain.turns)]
        equations = ArmEquations.at_pose(chain, exact_pose(chain, quarters))
        assert all(abs(v) < 1e-9 for v in values(equations, chain, joints))
        for i in range(size):
            other = [q + (0.3 if k == i else 0.0) for k, q in enumerate(joints)]
            assert any(abs(v) > 1e-3 for v in values(equations, chain, other)), (quarters, i)


def exact_pose(chain: ArmChain, quarters: list[int]) -> Motion:
    from bezier.certify.square_roots import ZERO, together, turn

    pose = chain.constants[0]
    for turns, k, constant_part in zip(chain.turns, quarters, chain.constants[1:], strict=False):
        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[k]
        angle = (Surd.rational(c), Surd.rational(s)) if turns else (Surd.rational(1), ZERO)
        joint = turn((0, 1), angle, (ZERO, ZERO, ZERO if turns else Surd.rational(k)))
        pose = together(together(pose, joint), constant_part)
    return pose


QUARTER = 'alpha = "pi/2"'
SLIDES = 'convention = "modified"\n' + "\n".join(
    f'[[row]]\njoint = "q{k}"\nkind = "prismatic"\n{body}'
    for k, body in enumerate(("", f'{QUARTER}\ntheta = "pi/2"', QUARTER))
)


def test_the_sentence_of_three_slides_is_true_by_elimination_too() -> None:
    """Nothing turns: the engine decides what the checker says, and that there is no second position."""
    certificate = inverse_certificate(solve(read_arm(SLIDES), (1, 2, 3)))
    claim = qe.certify.claims.claim_of(certificate)
    assert claim.equivalence is not None and claim.words[1:] == ("is true", "by joint positions")
    assert qe.decide(claim.equivalence[0], timeout=20) is True


CORNER = ArmEquations((("c1", "s1"),), ({("c1",): Surd.rational(1)},))
"""One joint whose cosine is 0."""


@pytest.mark.parametrize("count", range(4))
def test_exactly_so_many(count: int) -> None:
    ring = ring_of([CORNER], count)
    sentence = with_roots(ring, [CORNER], CORNER.exactly(ring, count))
    assert qe.decide(sentence, timeout=60) is (count == 2)


HALF, ONE = Fraction(1, 2), Fraction(1)
EVERY = ArmEquations((("c1", "s1"),), ())
"""One joint, and nothing that is asked of it."""


@pytest.mark.parametrize("low", [(1, 0), (0, 1), (-1, 0), (0, -1), (3, 4)])
@pytest.mark.parametrize("high", [(1, 0), (0, 1), (-1, 0), (0, -1), (3, 4)])
def test_arcs_are_the_way_round_from_one_end_to_the_other(low: Any, high: Any) -> None:
    """With ends at quarter turns: which of the angles between belong to the arc."""
    from bezier.certify.arm_sentences import _in_arc

    if low == high:
        return
    names = ("c", "s", "a", "b", "e", "f")
    ring = Ring.of(names)
    formula = _in_arc(ring, names[:2], names[2:4], names[4:])
    points = [(5, 0), (4, 3), (3, 4), (0, 5), (-3, 4), (-5, 0), (-3, -4), (0, -5), (3, -4)]
    scale = {(3, 4): 1}
    a, b = (tuple(Fraction(x) for x in (p if p in scale else (5 * p[0], 5 * p[1]))) for p in (low, high))
    order = points.index(a)  # type: ignore[arg-type]
    until = (points.index(b) - order) % len(points)  # type: ignore[arg-type]
    for k, place in enumerate(points):
        at = dict(zip(names, (*map(Fraction, place), *a, *b), strict=True))
        assert substituted(formula, at) == (TRUE if (k - order) % len(points) <= until else FALSE), place


def test_boxes_of_free_joints_say_nothing() -> None:
    ring = ring_of([EVERY])
    assert EVERY.within(ring, [None]) == TRUE
    box = EVERY.within(ring, [((HALF, ONE), (Fraction(0), HALF))])
    inside = [
        (c, s)
        for c, s in product((Fraction(0), HALF, ONE), repeat=2)
        if substituted(conj((box,)), {"c1": c, "s1": s}) == TRUE
    ]
    assert inside == [(HALF, Fraction(0)), (HALF, HALF), (ONE, Fraction(0)), (ONE, HALF)]

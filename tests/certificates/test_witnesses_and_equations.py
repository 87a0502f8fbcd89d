"""Witnesses, and steps by equations: accepted where the numbers or the equations show the claim, rejected otherwise."""

from __future__ import annotations

import json
import random
from fractions import Fraction
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.certify.verify import verify, verify_json
from qe.elimination.protocol import Context
from qe.engine.untangle import untangled
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, exists
from qe.formula.syntax import Relation
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.certificate import Certificate, Root
from qe.proof.derivation import moved
from qe.proof.entry import poly_to_text
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from tests.certificates.mutation import PLACE, leaves, lists, replaced, without
from tests.certificates.test_steps_by_hand import accepted

NAMES = ("x", "y", "z")
ROOT2 = Root((-2, 0, 1), Fraction(1), Fraction(2))
ROOT8 = Root((-8, 0, 1), Fraction(2), Fraction(3))


def _witness(text: str, *values: Root | Fraction) -> Certificate:
    return Certificate.witness(convert(read(text), Ring.of(NAMES)), NAMES, values)


@pytest.mark.parametrize(
    ("text", "accepted"),
    [
        ("x*y = 4 and z > x", True),
        ("2*x = y", True),
        ("2*x /= y", False),
        ("2*x - y = 0 and x*y*z = 6", True),
        ("y > 2*x or not z = 3/2", False),
        ("x^2*y^2 = 16 -> z < 3/2", False),
        ("1000000*x > 1414213 and 1000000*x < 1414214", True),
    ],
)
def test_signs_at_the_point_decide(text: str, accepted: bool) -> None:
    assert verify(_witness(text, ROOT2, ROOT8, Fraction(3, 2))).accepted is accepted


def test_an_interval_must_isolate() -> None:
    for low, high in [(-2, 2), (2, 3), (3, 2)]:
        wide = _witness("x^2 = 2", Root((-2, 0, 1), Fraction(low), Fraction(high)), ROOT8, Fraction(1))
        assert verify(wide).step == f"{PLACE}.values[0].interval"


def test_every_altered_entry_is_rejected() -> None:
    whole = json.loads(_witness("x*y = 4 and z = 3/2", ROOT2, ROOT8, Fraction(3, 2)).to_json())
    assert verify_json(json.dumps(whole)).accepted
    for path, value in leaves(whole):
        for other in (f"{value}1", str(value)[1:], f"-{value}"):
            assert not verify_json(replaced(whole, path, other, signed=False)).accepted
            if "interval" not in path and path[0] != "digest":  # a wider interval may isolate the same root
                assert not verify_json(replaced(whole, path, other)).accepted, (path, other)
    for path, content in lists(whole):
        for index in range(len(content)):
            assert not verify_json(without(whole, path, index)).accepted


CONTROL = (
    "ex px, py, rx, ry. px = 2*ax - qx and py = 2*ay - qy and 3*rx + 3*qx = 4 and -2*ry = 2*qy - by"
    " and px^2 + py^2 <= r^2 and rx^2 + ry^2 <= r^2 and qx^2 + qy^2 < r^2"
)


def test_every_altered_entry_of_solved_equations_is_rejected() -> None:
    answer = qe.eliminate(CONTROL)
    assert answer.certificate is not None
    whole = json.loads(answer.certificate.to_json())
    assert whole["payload"]["steps"][0]["rule"] == "linear equation solved" and verify_json(json.dumps(whole)).accepted
    for path, value in leaves(whole):
        for other in (f"{value}1", str(value)[1:], f"-{value}", f"{value} + 1", None):
            assert not verify_json(replaced(whole, path, other, signed=False)).accepted
            if path[0] != "digest":
                assert not verify_json(replaced(whole, path, other)).accepted, (path, other)
    for path, content in lists(whole):
        for index in range(len(content)):
            assert not verify_json(without(whole, path, index)).accepted, (path, index)


@pytest.mark.parametrize(
    ("matrix", "solved", "answer"),
    [
        ("a*x = 1 and a < 2", "a*x - 1", "a < 2"),  # the pivot is no constant: x = 1/a has no value at a = 0
        ("x^2 = a and a < 2", "x^2 - a", "a < 2"),  # the equation is quadratic
        ("x = a or a < 2", "x - a", "true"),  # the equation is under a disjunction
        ("x <= a and a < 2", "x - a", "a < 2"),  # an inequation is no equation
    ],
)
def test_unsound_steps_are_rejected(matrix: str, solved: str, answer: str) -> None:
    ring = Ring.of(("a", "x"))
    body, claimed = (convert(read(text), ring) for text in (matrix, answer))
    poly = convert(read(f"{solved} = 0"), ring).poly  # type: ignore[attr-defined]
    theory = {"polynomials": [], "lemmas": [], "cases": []}
    for sign in (1, -1, 0, None):
        evidence = {"solved": [["x", poly_to_text(poly), sign]], "theory": theory}
        made = qe.Certificate.step("linear equation solved", ring.names, exists(("x",), body), claimed, evidence)
        verdict = qe.verify(made)
        assert not verdict.accepted and verdict.step.startswith("payload.steps[0]"), verdict


def test_a_negative_multiple_turns_no_inequality_round() -> None:
    answer = qe.eliminate("ex x. 2*x + a = 0 and x^3 < b and x >= c")
    assert qe.equivalent(answer.formula, "-a^3 < 8*b and -a >= 2*c")
    assert answer.certificate is not None and qe.verify(answer.certificate).accepted


RING = Ring.of(("a", "b", "x", "y", "z", "u", "v", "w"))


@settings(deadline=None, max_examples=15, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_equations_of_answers(seed: int) -> None:
    """Linear equations and products, as they come out of eliminations: each small step has evidence."""
    rng, ring, log = random.Random(seed), Ring.of(("a", "b", "c")), RunLog()
    lines = [ring.gen(i) * rng.choice((1, 2)) - ring.gen(j) * rng.choice((0, 1)) for i, j in combinations(range(3), 2)]
    cases = disj((atom(rng.choice(lines), Relation.NE), atom(rng.choice(lines), Relation.EQ)))
    equation = atom(rng.choice(lines) * rng.choice((*lines, ring.constant(1))), Relation.EQ)
    untangled(conj((equation, cases, atom(rng.choice(lines), Relation.EQ))), Context(Options(), Budget(), log))
    assert all(map(accepted, log.steps()))


@pytest.mark.parametrize(
    ("inside", "proved"),
    [
        ("x - 1 = 0 or x - y > 0", True),
        ("x - 1 = 0 or x - y >= 0", False),
        ("x + 1 = 0 or x - y > 0", False),
        ("x - 1 = 0 or y - x > 0", False),
    ],
)
def test_equations_together_reduce_what_stands_in_disjunctions(inside: str, proved: bool) -> None:
    circles = "x^2 + y^2 = 1 and z^2 + w^2 = 1"
    before = f"ex x, y, z, w. {circles} and (x^2 + y^2 - 2*x + 1 = 0 or x*z^2 + x*w^2 - x^2*y - y^3 > 0)"
    sides = (moved(read_formula(text), RING) for text in (before, f"ex x, y, z, w. {circles} and ({inside})"))
    assert accepted(Step("Groebner basis of the equations", *sides)) is proved

"""Blocks that are their own mirror image and convex: only the fixed points are looked at, and the steps are checked."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.rules.mirror as mirror
from qe.api.input import read_formula
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, iff
from qe.formula.syntax import Formula, Relation
from qe.proof.derivation import moved
from qe.proof.step import Step
from qe.rules.step import StepKind
from tests.certificates.test_steps_by_hand import accepted
from tests.tables import each
from tests.unit.rules.applied import steps_of

CHEBYSHEV = "ex p, q. all x. x < -1 or x > 1 or (x^3 + p*x + q <= m and x^3 + p*x + q >= -m)"
RING = Ring.of(("a", "p", "q", "x"))


def test_best_approximation_of_an_odd_function_is_odd() -> None:
    answer = qe.eliminate(CHEBYSHEV, check=True)
    assert str(answer.formula) == "m >= 1/4"
    assert StepKind.MIRROR.value in [step.rule for step in answer.derivation.steps]
    assert not answer.unchecked_steps


def test_values_come_back() -> None:
    """Of two variables that are exchanged one is put in for the other."""
    found = qe.find_instance("p > 1 and q > 1 and all x. p*x + q*x <= x^2 + 9")
    assert found is not None
    assert found["p"] == found["q"]
    assert 1 < found["p"] <= 3


@each(
    "ex p. p^2 = a",  # two points are not convex
    "ex p. p /= 0 and a > 1",
    "ex p. p > 1 or p < -1",
    "ex p. p > a and p < 1",  # not its own image
    "ex p. all x. x^2 + p*x > a or p*x > 1",
    "all p. p < 1 and p > -1",
)
def test_nothing_is_done(text: str) -> None:
    assert not steps_of(read_formula(text), StepKind.MIRROR)


def symmetric(rng: random.Random) -> Formula:
    """A block with a condition and its image, quantified inside or not, and sometimes a condition that spoils it."""

    def term(power: int) -> Poly:
        names = rng.choice((("p",), ("p", "x"), ("q", "x"), ("p", "q"), ("a", "p"), ("x",)))
        found = RING.constant(rng.choice((1, -1, 2)))
        for name in names:
            found = found * RING.var(name) ** (power if name == "x" else 1)
        return found

    poly = term(1) + term(rng.choice((1, 2))) + RING.var("a") * rng.choice((0, 1))
    kind = rng.choice(({"p": ("p", -1), "x": ("x", -1)}, {"p": ("p", -1)}, {"p": ("q", 1), "q": ("p", 1)}))
    places = {RING.index[name]: RING.var(image) * sign for name, (image, sign) in kind.items()}
    relation = rng.choice(tuple(Relation))
    parts = [atom(poly, relation), atom(poly.compose(places), relation), atom(RING.var("x") ** 2 - 1, Relation.GT)]
    body = rng.choice((conj, disj))(parts if rng.random() < 0.5 else parts[:2])
    inner = rng.choice((exists, forall))(("x",), body)
    extra = atom(RING.var("p") - RING.var("a"), Relation.GT) if rng.random() < 0.2 else atom(RING.var("a"), Relation.LT)
    return rng.choice((exists, forall))(("p", "q"), rng.choice((conj, disj))((inner, extra)))


@settings(deadline=None, max_examples=40, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_what_the_rule_does_is_right(seed: int) -> None:
    """Some steps no elaborator makes of the kernel's: a decomposition takes their place in a proof, and here."""
    for step in steps_of(symmetric(random.Random(seed)), StepKind.MIRROR):
        said = iff(step.before, step.after)
        assert accepted(step) or qe.decide(forall(said.free, said), without=("symmetry",)), (step.before, step.after)


def test_some_steps_are_made_of_those_of_the_kernel() -> None:
    listed = [step for seed in range(80) for step in steps_of(symmetric(random.Random(seed)), StepKind.MIRROR)]
    assert sum(map(accepted, listed)) >= len(listed) / 8


def test_the_rule_finds_something_to_do() -> None:
    assert sum(len(steps_of(symmetric(random.Random(seed)), StepKind.MIRROR)) for seed in range(80)) >= 8


@each(
    ("is_convex", lambda formula, moved: True, "ex p. p > 1 or p < -1"),
    ("is_convex", lambda formula, moved: True, "ex p. p /= 0 and a*p /= 1 and a*p /= -1"),
    ("_shape", lambda formula, mirror: ("", ""), "ex p. all x. p*x > a or x >= 1 or x < -1"),
    ("_shape", lambda formula, mirror: ("", ""), "ex p, q. p > a and q < 1 and 2*p + q > 1 and p < 3"),
)
def test_a_broken_producer_is_refused(name: str, value: object, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mirror, name, value)
    broken = steps_of(read_formula(text), StepKind.MIRROR)
    assert broken
    assert not accepted(broken[0])


def claimed(before: str, after: str, *moves: tuple[str, str, int]) -> bool:
    given_ = read_formula(before)
    assert given_.ring is not None
    proof = {"mirror": [list(move) for move in moves]}
    return accepted(
        Step(StepKind.MIRROR.value, given_, moved(read_formula(after), given_.ring), evidence={"proof": proof})
    )


def test_altered_entries_are_refused() -> None:
    before, after = "ex p, q. p + q > a and p < b and q < b", "ex q. 2*q > a and q < b"
    assert claimed(before, after, ("p", "q", 1), ("q", "p", 1))
    assert not claimed(before, after, ("p", "q", 1))
    assert not claimed(before, after, ("p", "q", 1), ("q", "p", -1))
    assert not claimed(before, after, ("p", "q", 1), ("q", "q", 1))
    assert not claimed(before, "ex q. 2*q > a and q <= b", ("p", "q", 1), ("q", "p", 1))
    assert not claimed(before, "ex p. 2*p > a and p < b and p < 0", ("p", "q", 1), ("q", "p", 1))


def test_variables_of_different_quantifiers_are_not_exchanged() -> None:
    before = "ex p. all x. p*x + p + x > a"
    assert not claimed(before, "all x. x^2 + 2*x > a", ("p", "x", 1), ("x", "p", 1))


def test_universal_blocks_by_their_negation() -> None:
    before = "all p. p >= a or p <= -a"
    assert claimed(before, "0 >= a", ("p", "p", -1)) or claimed(before, "a <= 0", ("p", "p", -1))
    assert not claimed("all p. p >= a and p <= -a", "a <= 0", ("p", "p", -1))

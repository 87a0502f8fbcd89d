"""Two variables that can be exchanged: sum and product in their place, values on the way back, forgeries refused."""

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Exists, ForAll, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.kernel.step import Claim
from qe.proof.entry import Entry
from qe.rules.exchange import symmetric
from qe.rules.lift import holds_at
from qe.rules.step import StepKind
from tests.tables import each
from tests.unit.proving.elaborated import refused
from tests.unit.rules.applied import steps_of

TRIANGLE = "ex b, c. 1 + b > c and b + c > 1 and c + 1 > b and b^3 + c^3 + 1 = m*(b*c + b + c)"
WITH_VALUES = [
    "ex x, y. x^3 + y^3 = 9 and x*y = 2",
    "ex x, y. x^3 + y^3 = 1 and x < 2 and y < 2 and x /= 1 and y /= 1 and x /= y",
    "ex x, y. x^4 + y^4 = 1 and x + y > 1 and (x*y > 1 or 3*x*y < 1)",
    "all x, y. x^3 + y^3 /= 3 or x <= 1 or y <= 1",
]


@settings(deadline=None, max_examples=30, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_symmetric_polynomials_by_sum_and_product(seed: int) -> None:
    rng, ring = random.Random(seed), Ring.of(("a", "x", "y"))
    x, y = ring.var("x"), ring.var("y")
    poly = ring.constant(rng.randint(-3, 3))
    for _ in range(3):
        m, n = rng.randint(0, 4), rng.randint(0, 4)
        poly = poly + (x**m * y**n + x**n * y**m) * ring.var("a") ** rng.randint(0, 1) * rng.randint(-3, 3)
    assert symmetric(poly, 1, 2).compose({1: x + y, 2: x * y}) == poly


@pytest.mark.parametrize("text", WITH_VALUES)
def test_the_way_back_gives_values(text: str) -> None:
    assert steps_of(text, StepKind.EXCHANGE)
    answer = qe.eliminate(text)
    assert answer.formula == qe.eliminate(text, without=("exchange",)).formula
    sentence = read(text)
    assert isinstance(sentence, Exists | ForAll) and answer.witness is not None
    assert holds_at(sentence.body, answer.witness) is isinstance(sentence, Exists)


@each(
    "ex x, y. x^3 + y^3 = a and x > 1",
    "ex x, y. x^3 + 2*y^3 = a and x*y > 1",
    "ex x, y. x^3 + y^3 = a and (x > 1 or y > 2)",
    "ex x, y. x^3 + y^3 = a and (x + y > 1 or y > 2)",
    "ex x, y. x^3 + y^3 = a and (x > y or x*y > 1)",
    "ex x, y. x^3 + y^3 = a and (all y. y^2 > x)",
    "ex x, y. x^2 + y^2 < a and x + y > b",
    "ex x, y. x*y = a and x + y > b",
    "ex x, y. x^3 + y^3 = a and x /= 1",
    "ex x, y. x^3 + y^3 = a and x + 2*y = 1",
)
def test_what_changes_or_is_easy_anyway_is_left_alone(text: str) -> None:
    assert not steps_of(text, StepKind.EXCHANGE)


def test_a_triangle_inequality_has_the_same_answer() -> None:
    answer = qe.eliminate(TRIANGLE)
    assert qe.equivalent(answer.formula, qe.eliminate(TRIANGLE, without=("exchange",)).formula)
    assert "two variables exchanged: b + c, b*c" in str(answer.stats["preparation"])


@pytest.fixture
def right() -> Claim:
    (step,) = steps_of(TRIANGLE, StepKind.EXCHANGE)
    assert step.before.ring is not None
    proof = Entry({"variables": ["b", "c"]}, "step")
    return Claim(step.rule, step.before, step.after, step.before.ring, proof, "step")


def test_forged_steps_are_refused(right: Claim) -> None:
    evidence = right.evidence.value
    assert refused(right.rule, right.before, right.after, evidence) == ""
    assert isinstance(right.after, Exists)
    names, ring, parts = right.after.variables, right.ring, conjuncts(right.after.body)
    forged = [exists(names, conj(p for p in parts if p != part)) for part in parts]
    more = atom(ring.var("b") - 7, Relation.GT)
    forged += [exists(names, conj((*parts, more))), exists(names[:1], right.after.body)]
    for after in forged:
        assert refused(right.rule, right.before, after, evidence)

"""Branch and bound: what it refutes the kernel accepts, a point that it gives holds, and else it says nothing."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

import qe
from experiments.suites.families import packing
from qe.api.input import read_formula
from qe.elimination.branching import BranchAndBound
from qe.elimination.protocol import Context, Outcome
from qe.errors import InternalError
from qe.exact.linear_bounds import LinearBounds
from qe.formula.block import Block
from qe.formula.evaluate import holds_at
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.tables import each

BOXED = "0 <= a and a <= 1 and -1 <= b and b <= 1 and 0 <= c and c <= 2 and -2 <= d and d <= 1 and a + c <= 1"


def branched(text: str, work: int = 4_000) -> Outcome | None:
    """What the method alone says."""
    block = Block.of(read_formula(text))
    assert block is not None
    return BranchAndBound().run(block, Context(Options(), Budget(work=work), RunLog()))


@each(
    packing(3, "0.05"),
    packing(4, "0.05"),
    f"ex a, b, c, d. {BOXED} and a*b + c*d > 5/4",
    f"ex a, b, c, d. {BOXED} and a^2*b + c*b*d^2 > 9/2",
    f"ex a, b, c, d. {BOXED} and (a*b + c*d > 5/4 or a*b*d - c*d^2 > 9/2)",
    f"ex a, b, c, d. {BOXED} and a*b + c*d /= 1 and a*b + c*d >= 1 and (a*b + c*d)^2 + b <= 0",
    f"all a, b, c, d. {BOXED} -> a*b + c*d < 5/4",
    "all a, b, c, d. 0 <= a and a <= 1 and b^2 + c^2 + d^2 + a^2 <= 1 -> b*c + c*d + d*b + a*b + a*c + a*d < 8/5",
)
def test_what_is_refuted_is_proved(text: str) -> None:
    answer = qe.eliminate(text, check=True, without=("samples", "squares", "ranges", "convex", "symmetry"))
    assert answer.truth is text.startswith("all")
    assert "branch and bound" in {step.rule for step in answer.derivation.steps}
    assert not answer.unchecked_steps
    assert answer.certificate is not None
    assert qe.verify(answer.certificate).accepted


@each(
    packing(2, "0"),
    packing(5, "0"),
    f"ex a, b, c, d. {BOXED} and a*b + c*d > 1/2 and b*d < 0",
    "all x, y. x*y < 3 or x < 0 or x > 2",
)
def test_a_point_holds(text: str) -> None:
    block = Block.of(read_formula(text))
    outcome = branched(text)
    assert block is not None
    assert outcome is not None
    assert outcome.witness is not None
    assert holds_at(block.positive, {name: Fraction(str(v)) for name, v in outcome.witness.items()})


@each("ex x, y. 0 <= x and x <= 1 and x^2 = 1/2 and y^2 = x", "ex x, y. x*y >= 1 and x < 0 and y > 0 and x*y^3 > -1")
def test_where_pieces_do_not_get_small_nothing_is_said_or_it_is_right(text: str) -> None:
    outcome = branched(text, 300)
    assert outcome is None or outcome.formula == qe.eliminate(text).formula


def test_a_combination_that_is_no_number_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """As nobody looks at the identities where no certificate is asked for."""
    whole = LinearBounds.contradiction
    monkeypatch.setattr(LinearBounds, "contradiction", lambda bounds: whole(bounds)[1:])
    with pytest.raises(InternalError, match="no number"):
        branched(packing(3, "0.05"))


def sentence(rng: random.Random, names: str) -> str:
    """Conditions between bounds, some of them disjunctions or inequations."""

    def atom() -> str:
        terms = (f"{rng.randint(-4, 4)}*{'*'.join(rng.choices(names, k=rng.randint(1, 3)))}" for _ in range(3))
        return f"{' + '.join(terms)} {rng.choice(('<', '>', '<=', '>=', '/='))} {rng.randint(-4, 6)}"

    bounds = (f"{-rng.randint(0, 2)} <= {v} and {v} <= {rng.randint(1, 2)}" for v in names)
    parts = (atom() if rng.random() < 0.6 else f"({atom()} or {atom()})" for _ in range(rng.randint(2, 5)))
    return f"ex {', '.join(names)}. {' and '.join((*bounds, *parts))}"


@each(12, pytest.param(200, marks=pytest.mark.deep))
def test_as_decomposition_says(count: int) -> None:
    rng = random.Random(2027)
    decided = 0
    for _ in range(count):
        text = sentence(rng, "xyz"[: rng.randint(2, 3)])
        outcome = branched(text, 2_000)
        if outcome is not None:
            decided += 1
            assert outcome.formula == qe.eliminate(text, without=("branching", "samples")).formula, text
    assert decided > count / 2

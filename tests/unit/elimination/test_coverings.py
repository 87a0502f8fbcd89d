"""Coverings as a method: any prefix, with values of sentences, answers over parameters, and a proof."""

from fractions import Fraction

import pytest

from qe.certify.verify import verify
from qe.elimination.coverings import Coverings
from qe.elimination.protocol import Context, Outcome, witness_of
from qe.errors import BudgetExceeded
from qe.formula.block import Block
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.on_demand import OnDemand
from qe.proof.run_log import RunLog
from tests.tables import each

METHOD = Coverings()


def problem(text: str) -> Block:
    found = Block.of(read(text))
    assert found is not None
    return found


def run(text: str, options: Options, budget: Budget | None = None) -> tuple[Outcome, RunLog]:
    log = RunLog()
    return METHOD.run(problem(text), Context(options, budget or Budget(), log)), log


@each("ex x. x^2 = 2", "all x. x^2 > 2", "ex x. x^2 = a", "ex x. all y. x < y^2")
def test_everything_suits(text: str) -> None:
    assert METHOD.suits(problem(text), Options())


@each(
    ("ex x. x^2 + b*x + c = 0", "b^2 - 4*c >= 0"),
    ("all x. x^2 + a*x + b > 0", "a^2 - 4*b < 0"),
    ("ex x. all y. y^2 > x and x > a", "a < 0"),
    ("all x. ex y. x^2 + y^2 = a*x*y + b", "b >= 0 and (a - 2 >= 0 or a + 2 <= 0)"),
    ("ex x. x < a or x > a", "true"),
    ("all x. ex y. x*y = a", "a = 0"),
)
def test_answers_over_parameters(text: str, answer: str) -> None:
    found, log = run(text, Options(certify=True))
    assert (
        found.formula == convert(read(answer), found.formula.ring)
        if found.formula.ring
        else str(found.formula) == answer
    )
    assert next(log.steps()).rule == "covering"


@pytest.mark.parametrize("order", [("a", "b"), ("b", "a"), ("y", "b")])
def test_the_largest_root_needs_signs_of_derivatives(order: tuple[str, ...]) -> None:
    """The answer, in which a stands for three roots of a cubic, has signs that tell these apart."""
    text = "ex y. y^3 - 3*y = a and y >= b"
    found, _ = run(text, Options(order=order))
    for a, b, truth in (
        (0, 2, False),
        (0, 1, True),
        (0, -1, True),
        (1, 2, False),
        (3, 2, True),
        (-3, -2, False),
        (2, 2, True),
    ):
        assert holds_at(found.formula, {"a": Fraction(a), "b": Fraction(b)}) is truth


def test_values_of_the_first_block_of_a_sentence() -> None:
    found, _ = run("ex x. all y. x < y^2 and x^3 > -8", Options())
    assert found.witness is not None and -2 < found.witness["x"] < 0
    assert run("all x. ex y. y^2 > x", Options())[0].witness is None


@each("ex x, y. x^2 + y^2 = 4 and x*y > 1", "all x, y. x^2 + y^2 /= 4 or x*y <= 1")
@pytest.mark.parametrize("order", [None, ("y", "x"), ("y",)])
def test_values(text: str, order: tuple[str, ...] | None) -> None:
    found, _ = run(text, Options(order=order))
    assert found.formula == (TRUE if text[0] == "e" else FALSE) and found.witness is not None
    assert verify(witness_of(problem(text), found.witness)).accepted


@each("ex x, y. x^2 + y^2 < 1 and x*y > 1", "all x, y. x^2 + y^2 >= 1 or x*y <= 1")
def test_a_covering_is_evidence_where_it_is_asked_for(text: str) -> None:
    for certify in (True, False):
        found, log = run(text, Options(certify=certify))
        assert found.formula == (FALSE if text[0] == "e" else TRUE) and found.witness is None
        (step,) = log.steps()
        assert step.rule == "covering" and isinstance(step.evidence["proof"], OnDemand) is not certify


def test_no_condition_and_no_work() -> None:
    context = Context(Options(), Budget(), RunLog())
    assert [METHOD.run(Block(("x",), c), context).witness for c in (TRUE, FALSE)] == [{}, None]
    with pytest.raises(BudgetExceeded):
        run("ex x, y. x^2 + y^2 < 1 and x*y > 1", Options(), Budget(0.0))

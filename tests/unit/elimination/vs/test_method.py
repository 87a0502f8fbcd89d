"""Virtual substitution as a method: what suits it, its answers, what it leaves, and values that it finds."""

from qe.certify.verify import verify
from qe.elimination.protocol import Context, Outcome, witness_of
from qe.elimination.vs.method import VirtualSubstitution
from qe.formula.block import Block
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.tables import each

METHOD = VirtualSubstitution()


def problem(text: str) -> Block:
    found = Block.of(read(text))
    assert found is not None
    return found


def run(text: str) -> tuple[Outcome, RunLog]:
    log = RunLog()
    return METHOD.run(problem(text), Context(Options(), Budget(), log)), log


def test_what_suits() -> None:
    assert METHOD.suits(problem("ex x. x^2 = a"), Options()) and METHOD.suits(problem("all x. x^2 > a"), Options())
    assert METHOD.suits(problem("ex x. all y. x < y^2"), Options()) is None


@each(("ex x. x > a and x < b", "a < b"), ("all x. x < a or x > b", "a > b"), ("all x. x^2 > a", "a < 0"))
def test_answers_with_parameters(text: str, answer: str) -> None:
    found, log = run(text)
    assert str(found.formula) == answer and found.witness is None
    (step,) = log.steps()
    assert (step.rule, str(step.after)) == ("elimination set", answer)


def test_a_true_sentence_comes_with_values_and_a_false_universal_one_too() -> None:
    for text in ("ex x, y. x^2 + y^2 = 4 and y > x", "all x, y. x^2 + y^2 /= 4 or y <= x"):
        found, _ = run(text)
        assert found.witness is not None and str(found.formula) == ("true" if text[0] == "e" else "false")
        assert verify(witness_of(problem(text), found.witness)).accepted
    assert run("ex x. x^2 < 0")[0].witness is None


def test_higher_degrees_stay_quantified() -> None:
    found, _ = run("ex x, y. x^5 + x = a and y = x + b")
    assert not found.formula.is_quantifier_free and found.formula.free == ("a",) and found.witness is None

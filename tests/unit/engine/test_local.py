"""Local variables first: what is left is equivalent, its values are completed, the derivation is checked."""

import random

import pytest

import qe
from qe.elimination.protocol import Outcome
from qe.engine.local import WORK, without_locals
from qe.engine.run import outcome_for, solve
from qe.errors import Unable
from qe.formula.block import Block
from qe.formula.build import forall
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Exists, Formula
from qe.formula.traverse import atoms
from qe.io.text import read
from qe.options import Budget, Options, Stage
from qe.proof.step import Nested
from qe.rules.lift import holds_at

pytest.importorskip("pysat")

WITHOUT = Options(without=frozenset({Stage.MINISCOPING}))


def diamonds(count: int, last: str) -> Exists:
    """x0 < x1 < ... by way of y or z each time."""
    choices = [f"((x{k} < y{k} and y{k} < x{k + 1}) or (x{k} < z{k} and z{k} < x{k + 1}))" for k in range(count)]
    names = [*(f"x{k}" for k in range(count + 1)), *(f"{v}{k}" for v in "yz" for k in range(count))]
    found = read(f"ex {', '.join(names)}. {' and '.join(choices)} and {last}")
    assert isinstance(found, Exists)
    return found


def eliminated(block: Formula) -> Nested | None:
    try:
        return outcome_for(block, Options(without=frozenset({Stage.SHORTENING})), Budget(60, work=WORK)).nested(block)
    except Unable:
        return None


def without(sentence: Formula) -> Formula | None:
    problem = Block.of(sentence)
    assert problem is not None
    found = without_locals(problem, Options(), eliminated)
    return None if found is None else found.formula


def test_the_cases_of_a_diamond_are_gone() -> None:
    found = without(diamonds(14, "x14 < x0"))
    assert isinstance(found, Exists)
    assert set(found.variables) == {f"x{k}" for k in range(15)}
    assert sum(1 for _ in atoms(found)) == 15


def test_fourteen_diamonds_are_refuted_and_the_derivation_is_checked() -> None:
    sentence = diamonds(14, "x14 < x0")
    answer = qe.eliminate(sentence, check=True, timeout=120)
    assert (answer.truth, answer.unchecked_steps, answer.guarantee) == (False, (), qe.Guarantee.CHECKED)
    assert answer.certificate is not None
    assert qe.verify(answer.certificate, formula=sentence).accepted


def test_values_of_local_variables_satisfy_their_conditions() -> None:
    sentence = diamonds(14, "x14 < x0 + 1 and x3 = 1/2")
    answer = qe.eliminate(sentence, timeout=120)
    assert answer.truth and answer.witness is not None
    assert holds_at(sentence.body, answer.witness)


def test_a_universal_sentence_by_its_negation() -> None:
    sentence = diamonds(12, "x12 < x0")
    question = forall(sentence.variables, nnf(sentence.body, negate=True))
    answer = qe.eliminate(question, check=True, timeout=120)
    assert (answer.truth, answer.unchecked_steps) == (True, ())
    assert answer.certificate is not None and qe.verify(answer.certificate, formula=question).accepted


def test_one_impossible_condition_refutes_the_sentence() -> None:
    sentence = diamonds(12, "x12 < x0 and (y0 < 0 and y0 > 1 or z0 > x1 and z0 < x1)")
    answer = qe.eliminate(sentence, check=True, timeout=120)
    assert (answer.truth, answer.unchecked_steps) == (False, ())


def test_nothing_is_done_without_cases_or_without_local_variables() -> None:
    assert without(diamonds(3, "x3 < x0")) is None
    everywhere = " and ".join(f"(y{k} > 0 or z{k} > 0)" for k in range(14))
    sentence = diamonds(14, f"x14 < x0 and {everywhere}")
    assert without(sentence) is None


def random_sentence(rng: random.Random) -> Exists:
    """Twelve cases over three shared variables, each with one of its own."""
    parts, names = [], ["a", "b", "c"]
    for k in range(12):
        names.append(f"y{k}")

        def comparison() -> str:
            form = " + ".join(f"{rng.randint(-2, 2)}*{v}" for v in rng.sample(["a", "b", "c"], 2))
            left = f"{rng.choice((-1, 1, 2))}*{rng.choice((f'y{k}', 'a'))} + {form}"
            return f"{left} {rng.choice(('<', '<=', '=', '/='))} {rng.randint(-2, 2)}"

        parts.append(f"(({comparison()} and {comparison()}) or {comparison()})")
    found = read(f"ex {', '.join(names)}. {' and '.join(parts)}")
    assert isinstance(found, Exists)
    return found


@pytest.mark.parametrize("seed", range(6))
def test_answers_are_those_without_it(seed: int) -> None:
    sentence = random_sentence(random.Random(seed))
    found, other = (solve(sentence, options, Budget(60)) for options in (Options(), WITHOUT))
    assert found.formula == other.formula in (TRUE, FALSE)
    if found.formula == TRUE:
        assert found.witness is not None and holds_at(sentence.body, found.witness)


def test_no_values_where_the_sentence_has_none() -> None:
    sentence = diamonds(12, "x12 < x0")
    problem = Block.of(sentence)
    assert problem is not None
    found = without_locals(problem, Options(), eliminated)
    assert found is not None
    assert found.values(Outcome(FALSE), lambda inner: outcome_for(inner, Options(), Budget(60))) is None
    assert found.values(Outcome(TRUE), lambda inner: outcome_for(inner, Options(), Budget(60))) is None


def test_a_long_chain_of_diamonds_is_not_searched_before_its_local_variables_are_gone() -> None:
    """30 of them have 2^30 paths."""
    diamonds = [f"((x{i} < y{i} and y{i} < x{i + 1}) or (x{i} < u{i} and u{i} < x{i + 1}))" for i in range(30)]
    names = [f"x{i}" for i in range(31)] + [f"{letter}{i}" for letter in "yu" for i in range(30)]
    answer = qe.eliminate(f"ex {', '.join(names)}. {' and '.join(diamonds)} and x30 < x0", process=False, timeout=10)
    assert answer.truth is False

"""Derivations replay from the question to the answer, and every step is an equivalence."""

import pickle
import random
import xml.etree.ElementTree as ET

import pytest

import qe
from qe.formula.syntax import FALSE, TRUE, ForAll, Formula, Not
from qe.io import formats
from qe.proof.derivation import put_together
from qe.proof.step import Step
from qe.proof.writing import RULES
from tests.differential.generate import NESTED, SMALL, random_formula


def read(text: str) -> Formula:
    return formats.read(text, "text")


def step(before: str, after: str) -> Step:
    both = read(f"({before}) or ({after})")  # one ring for both
    assert both is not None
    return Step("test", read(before), read(after))


def test_a_step_is_placed_wherever_its_formula_stands() -> None:
    start = read("(x > 0 and y > 0) or (x > 0 and z = 0)")
    found = put_together(start, [step("x > 0", "x - 1 > 0")], read("(x > 1 and y > 0) or (x > 1 and z = 0)"))
    assert found.is_complete and found.steps[0].places == ((0, 0), (1, 0))


def test_a_step_may_replace_a_part_of_a_conjunction() -> None:
    start = read("x > 0 and y > 0 and x*y < 1")
    found = put_together(
        start, [step("x > 0 and x*y < 1", "x*y < 1 and 2 > 1 and x > 3")], read("y > 0 and x*y < 1 and x > 3")
    )
    assert found.is_complete and found.steps[0].places == ((),)


def test_steps_of_attempts_that_were_given_up_are_left_out() -> None:
    start = read("x > 0")
    found = put_together(start, [step("y > 0", "true"), step("x > 0", "x >= 1")], read("x >= 1"))
    assert [s.before for s in found.steps] == [found.start] and found.is_complete


def test_an_incomplete_derivation_says_so() -> None:
    assert not put_together(read("x > 0"), [], read("x >= 0")).is_complete


def test_quantified_places_and_negations() -> None:
    start = read("all y. not (ex x. x^2 = y)")
    last = Step("end", ForAll(("y",), Not(read("y >= 0"))), FALSE)
    found = put_together(start, [step("ex x. x^2 = y", "y >= 0"), last], FALSE)
    assert found.is_complete and found.steps[0].places == ((0, 0),)


@pytest.mark.parametrize("seed", range(30))
def test_answers_replay_and_every_step_is_an_equivalence(seed: int) -> None:
    formula = random_formula(random.Random(9000 + seed), (*SMALL, *NESTED)[seed % 8])
    answer = qe.eliminate(formula)
    derivation = answer.derivation
    assert derivation.is_complete, str(formula)
    assert {s.rule for s in derivation.steps} <= set(RULES)
    for taken in derivation.steps:
        if taken.context == TRUE:
            names = dict.fromkeys((*taken.before.free, *taken.after.free))
            if len(names) <= 2:
                assert qe.equivalent(taken.before, taken.after), taken


def test_the_counterexample_of_a_universal_sentence_keeps_its_derivation() -> None:
    answer = qe.eliminate("all x, y. x^2 + y > 0")
    assert answer.truth is False and answer.derivation.is_complete
    assert isinstance(answer.derivation.start, ForAll)


def test_derivations_are_printed_and_pickled() -> None:
    answer = qe.eliminate("ex x, y. x + y = a and x^2 < b")
    derivation = pickle.loads(pickle.dumps(answer)).derivation
    assert derivation == answer.derivation
    assert derivation.to_latex().count(r"\Longleftrightarrow") == len(derivation.steps)
    page = derivation.to_html()
    assert page.count('<li id="step-') == len(derivation.steps)
    ET.fromstring(page[page.index("<ol>") : page.rindex("</ol>") + 5].replace("&nbsp;", " "))


def test_a_page_has_theorems_and_evidence() -> None:
    page = qe.eliminate("ex x, y. a - b = 0 and (a + b)*x = c and y^2 < 1").derivation.to_html()
    assert "Gauss" in page and "Theorem (Loos, Weispfenning 1993). Let a, b be polynomials without x" in page
    assert "<summary>theorem</summary>" in page and "<summary>evidence</summary>" in page
    assert "solved: [[x, " in page
    assert "<details><summary>evidence</summary><ol>" in page  # the small steps of "equations taken apart"
    ET.fromstring(page[page.index("<ol>") : page.rindex("</ol>") + 5])


def test_names_in_a_page_are_no_markup() -> None:
    page = qe.eliminate("ex x. x + `<script>` = 1 and x > `a&b`").derivation.to_html()
    assert "<script>" not in page
    ET.fromstring(page[page.index("<body>") : page.index("</body>") + 7])


def test_no_derivation_without_an_answer() -> None:
    with pytest.raises(qe.Unable, match="no derivation"):
        _ = qe.eliminate("ex x. x^5 + a*x + b = 0 and x < b", method="vs").derivation

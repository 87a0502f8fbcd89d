"""Coverings with parameters and alternation: accepted, altered, and by producers that forget a side condition."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator

import pytest

from qe.decomposition import cover
from qe.decomposition import line as lines
from qe.decomposition.cover import Search
from qe.decomposition.line import Cover
from qe.elimination.cad import decomposed
from qe.errors import InternalError, NotWellOriented, Unable
from qe.exact.ring import Poly
from qe.formula.build import conj, disj, forall, neg
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, And, Constant, Exists, ForAll, Formula, Or
from qe.io import formats
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.certificates.coverings import (
    QUESTIONS,
    about,
    altered,
    answered,
    interval,
    judged,
    line,
    places,
    projected,
    random_question,
    read,
)


@pytest.mark.parametrize("text", QUESTIONS)
def test_coverings_with_any_prefix_and_parameters_are_accepted(text: str) -> None:
    question = formats.read(text, "text")
    answer, given = answered(question, Budget())
    assert judged(question, answer, given) == ""
    other = nnf(neg(answer))
    assert judged(question, other, given) and judged(question, TRUE if answer == FALSE else FALSE, given)


@pytest.mark.parametrize("seed", range(80))
def test_random_questions_are_answered_as_by_decomposition_and_accepted(seed: int) -> None:
    question = random_question(random.Random(seed))
    if not isinstance(question, Exists | ForAll) or question.ring is None:
        return
    try:
        answer, given = answered(question, Budget(None, 1500))
    except (NotWellOriented, Unable, StopIteration, AssertionError):
        return  # too large, or decided by values
    assert judged(question, answer, given) == ""
    try:
        expected = decomposed(question, Options(), Budget(None, 4000), RunLog()).formula
    except Unable:
        return
    same = conj((disj((neg(answer), expected)), disj((neg(expected), answer))))
    if isinstance(same, Constant):
        assert same == TRUE
    else:
        assert decomposed(forall(same.free, nnf(same)), Options(), Budget(None, 8000), RunLog()).formula == TRUE


# --- the evidence altered -----------------------------------------------------------------------------
@pytest.mark.parametrize("text", QUESTIONS)
def test_altered_evidence_with_parameters_never_proves_another_answer(text: str) -> None:
    question, rng = formats.read(text, "text"), random.Random(text)
    answer, given = answered(question, Budget())
    wrong = [f for f in others(answer) if judged(question, f, given)]
    assert wrong
    listed = [p for p in places(given) if p[0] != "matrix"]
    rejected = 0
    for path in rng.sample(listed, min(len(listed), 25)):
        changed = altered(given, path, rng)
        rejected += bool(judged(question, answer, changed))
        assert all(judged(question, f, changed) for f in wrong)
    assert rejected > 10


def others(answer: Formula) -> list[Formula]:
    """Formulas that are not equivalent to an answer: its negation, and the answer with one relation changed."""
    found = [nnf(neg(answer)), TRUE if answer != TRUE else FALSE]
    if isinstance(answer, And | Or):
        found += list(answer.args)
    return found


# --- producers that forget a side condition ----------------------------------------------------------
def questions() -> Iterator[tuple[Formula, str]]:
    """What the checker says of what the producer makes of many questions."""
    listed = [formats.read(text, "text") for text in QUESTIONS]
    listed += [random_question(random.Random(seed)) for seed in range(300, 380)]
    for question in listed:
        if question.ring is None or question.is_quantifier_free:
            continue
        try:
            answer, given = answered(question, Budget(None, 1500))
        except (NotWellOriented, AssertionError, Unable, InternalError, StopIteration):
            continue
        yield question, judged(question, answer, given)


@pytest.mark.parametrize("left_out", ["leading coefficient", "discriminant", "resultant"])
def test_with_parameters_a_projection_without_a_part_is_rejected(
    left_out: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def project(polys: Iterable[Poly], level: int, operator: object) -> Iterator[Poly]:
        return (p for kind, p in projected(polys, level) if kind != left_out)

    monkeypatch.setattr(cover, "project", project)
    assert any(why for _, why in questions())


def test_an_interval_of_a_quantifier_that_is_not_known_to_last_is_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    """A producer that takes every quantifier for one whose value nobody asks beside the sample."""
    monkeypatch.setattr(Search, "is_leading", lambda self, level: True)
    assert any(why for _, why in questions())


def test_a_line_known_over_a_point_only_and_used_beside_it_is_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Cover, "is_pinned", False)
    question = formats.read("ex x, y, z. all u. ex t. y = 0 and z = 0 and t^2 = z*u + y and t > x^2", "text")
    assert "may change its sign or order" in judged(question, *answered(question, Budget()))


def test_an_order_over_a_line_that_is_taken_for_known_is_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    """a^2 + b*z has order 1 over a = b = 0, but at z = 0 order 2."""
    question = formats.read("all z. ex t. t^2 = a^2 + b*z", "text")
    assert judged(question, *answered(question, Budget())) == ""
    monkeypatch.setattr(lines, "_delineating", lambda point, poly: poly.derivative(0))
    assert "may change its sign or order" in judged(question, *answered(question, Budget()))


# --- evidence forged by hand ---------------------------------------------------------------------------
def test_one_true_interval_is_not_enough_for_all_values() -> None:
    body = read("x > 0")
    first = line([0], ["-1", "1"], [[0]], interval(2, 2, 2, [0]))
    given = about(body, [["x"]], first, "A")
    assert "not covered" in judged(forall(("x",), body), TRUE, given)


def test_values_beside_a_sample_are_asked_where_the_quantifier_changes() -> None:
    """For all x there is a y with x*y = 1, if only the sample x = 1 were looked at."""
    body = read("x*y = 1")
    above = line([0], ["0", "2"], [[0]], interval(1, 1, 1, None))
    first = line([], ["1"], [], interval(0, 0, 0, [], above))
    given = about(body, [[], ["x*y - 1"]], first, "AE")
    assert "beside the sample" in judged(formats.read("all x. ex y. x*y = 1", "text"), TRUE, given)


def test_an_answer_whose_signs_are_not_known_on_a_cell_is_rejected() -> None:
    question = formats.read("ex x. x^2 + b*x + c = 0", "text")
    answer, given = answered(question, Budget())
    stronger = formats.read("b^2 - 4*c >= 0 and (b > 0 or b <= 0)", "text")
    assert judged(question, answer, given) == ""
    assert "not a product of listed factors" in judged(question, stronger, given)

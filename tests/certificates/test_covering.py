"""Coverings, with parameters and alternation too: accepted, altered, and by producers that forget a side condition."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator

import pytest

import qe
from qe.decomposition import cover
from qe.decomposition import line as lines
from qe.decomposition.cover import Search
from qe.decomposition.line import Cover
from qe.elimination.cad import decomposed
from qe.errors import InternalError, NotWellOriented, Unable
from qe.exact.ring import Poly
from qe.formula.build import conj, disj, exists, forall, neg
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, ForAll, Formula, Or
from qe.io import formats
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from tests.certificates.coverings import (
    BODIES,
    QUESTIONS,
    about,
    altered,
    answered,
    forged,
    interval,
    judged,
    line,
    projected,
    proof,
    random_question,
    read,
    verdict,
)
from tests.certificates.mutation import paths
from tests.unit.decomposition.test_cover import random_body


@pytest.mark.parametrize("text", BODIES)
def test_coverings_are_accepted(text: str) -> None:
    body = read(text)
    assert verdict(body, proof(body, body.free)) == ""
    assert verdict(body, proof(body, body.free[::-1])) == ""


@pytest.mark.parametrize("seed", range(80))
def test_coverings_of_random_bodies_are_accepted(seed: int) -> None:
    body = random_body(random.Random(seed))
    if body.ring is None or (body.is_quantifier_free and not body.free):
        return
    try:
        given = proof(body, body.free)
    except (NotWellOriented, AssertionError, Unable):
        return
    assert verdict(body, given) == ""


# --- the evidence altered -----------------------------------------------------------------------------
@pytest.mark.parametrize("text", BODIES[:4])
def test_altered_evidence_never_proves_more(text: str) -> None:
    """Rejected, or still a proof of this claim: the same evidence never serves for a body with solutions."""
    body, rng = read(text), random.Random(text)
    given = proof(body, body.free)
    listed = list(paths(given))
    satisfiable = [f for f in relaxed(body) if qe.eliminate(exists(f.free, f), process=False).truth]
    rejected = 0
    for path in rng.sample(listed, min(len(listed), 30)):
        changed = altered(given, path, rng)
        rejected += bool(verdict(body, changed))
        for weaker in satisfiable[:3]:
            assert verdict(weaker, changed)
    assert rejected > 15


def relaxed(body: Formula) -> list[Formula]:
    """The body with one of its parts left out, or with one atom negated."""
    if not isinstance(body, And | Or):
        return []
    found: list[Formula] = []
    for k, arg in enumerate(body.args):
        rest = [*body.args[:k], *body.args[k + 1 :]]
        for other in (nnf(arg, negate=True), TRUE):
            parts = tuple(p for p in (*rest, other) if p != TRUE)
            found.append(parts[0] if len(parts) == 1 else type(body)(parts))
    return [f for f in found if isinstance(f, And | Or | Atom) and set(f.free) == set(body.free)]


@pytest.mark.parametrize("seed", range(40))
def test_evidence_for_one_body_proves_no_satisfiable_other(seed: int) -> None:
    body = random_body(random.Random(1000 + seed))
    try:
        given = proof(body, body.free)
    except (NotWellOriented, AssertionError, Unable):
        return
    for other in relaxed(body):
        if verdict(other, given) == "":
            assert qe.eliminate(exists(other.free, other), method="cad", process=False).truth is False


# --- producers that forget a side condition ----------------------------------------------------------
@pytest.mark.parametrize("left_out", ["leading coefficient", "discriminant", "resultant"])
def test_a_projection_without_a_part_is_rejected(left_out: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def project(polys: Iterable[Poly], level: int, operator: object) -> Iterator[Poly]:
        return (p for kind, p in projected(polys, level) if kind != left_out)

    monkeypatch.setattr(cover, "project", project)
    assert any_rejected()


def test_neighbours_without_their_resultant_are_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cover, "pairwise", lambda intervals: ())
    assert any_rejected()


def test_factors_of_lower_level_that_are_forgotten_are_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = cover.characterization

    def without(found: Cover) -> object:
        for known in found.intervals:
            object.__setattr__(known, "below", ())  # what the atoms say about the lines below
        return whole(found)

    monkeypatch.setattr(cover, "characterization", without)
    assert any_rejected()


def any_rejected() -> bool:
    """Whether the checker rejects what the producer makes of some of many bodies."""
    bodies = [read(text) for text in BODIES] + [random_body(random.Random(seed)) for seed in range(200, 260)]
    for body in (b for b in bodies if not isinstance(b, Constant)):
        try:
            given = proof(body, body.free)
        except (NotWellOriented, AssertionError, Unable, InternalError):
            continue
        if verdict(body, given):
            return True
    return False


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("ex x, y. x^2 + y^2 < 1 and x*y > 1", TRUE, "follows to be False"),
        ("ex x. x^2 + y^2 < 1 and x*y > 1", FALSE, "about another formula"),
        ("x^2 + y^2 < 1 and x*y > 1", FALSE, "about another formula"),
        ("all x, y. x^2 + y^2 < 1 and x*y > 1", FALSE, "about another formula"),
        ("ex x. all y. x^2 + y^2 < 1 and x*y > 1", FALSE, "about another formula"),
        ("ex x, y. x^2 + y^2 <= 1 and x*y > 1", FALSE, "about another formula"),
    ],
)
def test_evidence_is_about_one_formula(before: str, after: Formula, message: str) -> None:
    body = read(BODIES[0])
    assert message in judged(formats.read(before, "text"), after, proof(body, body.free))


# --- evidence forged by hand for sentences that are true ----------------------------------------------
def test_an_interval_over_a_root_of_its_factor_is_rejected() -> None:
    body = read("x^2 < 1")
    whole = interval(0, 4, 4, [0, 1])
    assert "contains a root" in forged(body, [["x - 1", "x + 1"]], line([0, 1], ["-2", "0", "2"], [[1], [0]], whole))


@pytest.mark.parametrize(("own", "reason"), [([], "does not follow from the signs"), ([0], "contains a root")])
def test_a_factor_of_lower_level_that_changes_its_sign_says_nothing(own: list[int], reason: str) -> None:
    body = read("x > 0 and y > x")
    above = line([], ["0"], [], interval(0, 0, 0, []))
    first = line([0], ["-1", "1"], [[0]], interval(0, 2, 0, own, above))
    assert reason in forged(body, [["x"], ["-x + y"]], first)


def test_neighbours_whose_resultant_changes_its_sign_need_not_meet_around_the_sample() -> None:
    """Over x = 1 the rays y < x and y > -x cover the line; over x = -1 they do not."""
    body = read("y >= x and y <= -x")
    above = line([0, 1], ["-2", "0", "2"], [[1], [0]], interval(0, 2, 2, [0]), interval(2, 4, 4, [1]))
    first = line([0], ["-1", "1"], [[0]], interval(0, 2, 2, [], above))
    assert "need not meet around" in forged(body, [["x"], ["-x + y", "x + y"]], first)


def test_a_factor_that_is_zero_on_a_line_beside_the_sample_is_rejected() -> None:
    """x*z + y has no root over (0, 1), and is zero on the whole line over (0, 0)."""
    body = read("x = 0 and x*z + y = 0")
    top = line([0], ["0"], [], interval(0, 0, 0, [0]))
    middle = line([], ["1"], [], interval(0, 0, 0, [], top))
    parts = (
        interval(0, 0, 0, [0]),
        interval(1, 1, 1, [0], middle),
        interval(2, 2, 2, [0]),
    )
    assert "may vanish identically" in forged(body, [["x"], [], ["x*z + y"]], line([0], ["-1", "1"], [[0]], *parts))


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
    listed = [p for p in paths(given) if p[0] != "matrix"]
    rejected = 0
    for path in rng.sample(listed, min(len(listed), 13)):
        changed = altered(given, path, rng)
        rejected += bool(judged(question, answer, changed))
        assert all(judged(question, f, changed) for f in wrong)
    assert rejected > 5


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
    assert "around the sample" in judged(formats.read("all x. ex y. x*y = 1", "text"), TRUE, given)


def test_an_answer_whose_signs_are_not_known_on_a_cell_is_rejected() -> None:
    question = formats.read("ex x. x^2 + b*x + c = 0", "text")
    answer, given = answered(question, Budget())
    stronger = formats.read("b^2 - 4*c >= 0 and (b > 0 or b <= 0)", "text")
    assert judged(question, answer, given) == ""
    assert "not a product of listed factors" in judged(question, stronger, given)

"""Coverings are checked by separate code: each side condition of the theorem, each entry, and claims that are false."""

from __future__ import annotations

import copy
import random
from collections.abc import Iterable, Iterator
from typing import Any

import pytest

import qe
from qe.certify.covering import check_covering
from qe.certify.derivation import limits_of
from qe.certify.registry import RULES
from qe.certify.step import Claim
from qe.certify.verify import check_certificate
from qe.coverings import cover
from qe.coverings import line as lines
from qe.coverings.cover import Search
from qe.coverings.evidence import evidence
from qe.coverings.line import Cover
from qe.elimination.cad import decomposed
from qe.elimination.coverings import Coverings
from qe.elimination.protocol import Context, Problem
from qe.errors import CertificateRejected, InternalError, NotWellOriented, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall, neg
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, ForAll, Formula, Or, Relation
from qe.io import formats
from qe.options import Budget, Options
from qe.proof.entry import Entry, formula_to_json
from qe.proof.run_log import RunLog
from qe.proving.prover import Prover
from tests.differential.generate import random_poly
from tests.unit.coverings.test_cover import random_body

BODIES = [
    "x^2 + y^2 < 1 and x*y > 1",
    "x^2 + y^2 + z^2 < 1 and x + y + z > 2",
    "(x^2 - 2)*(y^2 - x) = 0 and x^2 + y^2 < 1 and y^3 > 1/2 and x > 1",
    "x^2 = 2 and y^2 = x and x*y > 3",
    "x^3 + y^3 + z^3 = x*y*z + 1 and x^2 + y^2 + z^2 < 1/4",
    "x*y > 1 and (x + y < 0 or x*y < 1/2) and (x > 0 or y > 0)",
]


def proof(body: Formula, order: tuple[str, ...]) -> dict[str, Any]:
    """The evidence that a body has no solution, as it stands in a certificate."""
    assert body.ring is not None
    ring, kinds = Ring.of(order), "E" * len(order)
    moved = convert(body, ring)
    found = Search(moved, ring, kinds, Budget(None, 20_000)).run()
    assert found.truth is False
    return Prover(body.ring, Options(), Budget())._plain(evidence(found, kinds, moved))


def verdict(body: Formula, given: dict[str, Any], after: Formula = FALSE) -> str:
    """Empty where the checker accepts that the body has no solution; the evidence is said to be about this body."""
    assert body.ring is not None
    about = {**given, "matrix": formula_to_json(body)} if isinstance(given, dict) and "matrix" in given else given
    return judged(exists(body.ring.names, body), after, about)


def judged(before: Formula, after: Formula, given: object) -> str:
    """Empty where the checker accepts the step."""
    ring = before.ring
    assert ring is not None
    claim = Claim("covering", before, after, ring, Entry(given, "evidence"), "step")  # type: ignore[arg-type]
    try:
        check_covering(claim, (), limits_of(Budget(60), RULES, check_certificate))
    except CertificateRejected as error:
        return str(error)
    return ""


QUESTIONS = [
    "ex x. x^2 + b*x + c = 0",
    "ex x. a*x^2 + b*x + c = 0",
    "all x. ex y. x^2 + y^2 = a*x*y + b",
    "ex x. all y. y^2 > x and x > a or y < a",
    "all x. ex y. y^4 = x^2 + x*y + 1 and y > 0",
    "ex x. all y. x < y^2 and x^2 > 2",
    "(ex x. x^2 = a) and not (all y. y^2 > b)",
    "ex y. y^3 - 3*y = a and y >= b",
]


def answered(formula: Formula, budget: Budget) -> tuple[Formula, dict[str, Any]]:
    """What the method answers, and its evidence."""
    problem, log = Problem.of(formula), RunLog()
    if problem is None:
        problem = Problem((), formula)
    Coverings().run(problem, Context(Options(certify=True), budget, log))
    step = next(s for s in log.steps() if s.rule == "covering")
    assert formula.ring is not None and "proof" in step.evidence
    return step.after, Prover(formula.ring, Options(), Budget())._plain(step.evidence["proof"])  # type: ignore[arg-type]


def random_question(rng: random.Random) -> Formula:
    """A formula with up to two parameters and up to two quantifiers of any kinds."""
    free = rng.choice([(), ("a",), ("a",), ("a", "b")])
    ring = Ring.of((*free, "x", "y"))

    def part(depth: int) -> Formula:
        if depth == 0 or rng.random() < 0.15:
            return atom(random_poly(rng, ring, ring.names, rng.choice([1, 2, 2, 3])), rng.choice(list(Relation)))
        return (conj if rng.random() < 0.6 else disj)([part(depth - 1) for _ in range(2)])

    found = nnf(part(rng.choice([1, 2, 2])))
    for name in ("y", "x"):
        found = rng.choice([exists, forall])((name,), found)
    return found


def read(text: str) -> Formula:
    return nnf(formats.read(text, "text"))


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


def test_an_answer_by_coverings_is_checked() -> None:
    for text, truth in (("x^3 + y^3 < 1 and x*y > 2 and x > 0", "false"), ("x^4 + y^4 + x*y + 1 < 0", "false")):
        body = read(text)
        for formula, expected in (
            (exists(body.free, body), truth),
            (forall(body.free, nnf(body, negate=True)), "true"),
        ):
            answer = qe.eliminate(formula, method="coverings", check=True, process=False)
            assert str(answer.formula) == expected and answer.guarantee is qe.Guarantee.CHECKED
            assert [step.rule for step in answer.derivation.steps if step.rule == "covering"]


@pytest.mark.parametrize("text", QUESTIONS)
def test_an_answer_with_parameters_is_checked(text: str) -> None:
    answer = qe.eliminate(text, method="coverings", check=True, process=False)
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps
    assert "covering" in [step.rule for step in answer.derivation.steps]


# --- the evidence altered -----------------------------------------------------------------------------
def places(value: object, path: tuple[object, ...] = ()) -> Iterator[tuple[object, ...]]:
    if isinstance(value, dict | list):
        for key, part in value.items() if isinstance(value, dict) else enumerate(value):
            yield (*path, key)
            yield from places(part, (*path, key))


def altered(given: Any, path: tuple[Any, ...], rng: random.Random) -> Any:
    found = copy.deepcopy(given)
    part = found
    for key in path[:-1]:
        part = part[key]
    old, key = part[path[-1]], path[-1]
    if isinstance(old, bool) or old is None:
        part[key] = rng.choice([0, 1])
    elif isinstance(old, int):
        part[key] = old + rng.choice([-1, 1, 2])
    elif isinstance(old, str):
        part[key] = rng.choice(["0", "-1/2", "x", "x - y", "17", "", "E", "A"])
    elif isinstance(old, list) and old:
        change = rng.choice(["pop", "reverse", "repeat"])
        if change == "repeat":
            old.append(old[0])
        else:
            getattr(old, change)()
    elif isinstance(old, dict):
        old.pop(rng.choice(sorted(old)))
    else:
        part[key] = [0]
    return found


@pytest.mark.parametrize("text", BODIES[:4])
def test_altered_evidence_never_proves_more(text: str) -> None:
    """Rejected, or still a proof of this claim: the same evidence never serves for a body with solutions."""
    body, rng = read(text), random.Random(text)
    given = proof(body, body.free)
    listed = list(places(given))
    satisfiable = [f for f in relaxed(body) if qe.eliminate(exists(f.free, f), process=False).truth]
    rejected = 0
    for path in rng.sample(listed, min(len(listed), 60)):
        changed = altered(given, path, rng)
        rejected += bool(verdict(body, changed))
        for weaker in satisfiable[:3]:
            assert verdict(weaker, changed)
    assert rejected > 30


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
def projected(polys: Iterable[Poly], level: int) -> Iterator[tuple[str, Poly]]:
    listed = list(polys)
    for i, f in enumerate(listed):
        yield "leading coefficient", f.leading(level)
        if f.degree(level) > 1:
            yield "discriminant", f.discriminant(level)
        yield from (("resultant", f.resultant(g, level)) for g in listed[:i])


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
        for interval in found.intervals:
            object.__setattr__(interval, "below", ())  # what the atoms say about the lines below
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
        ("ex x, y. x^2 + y^2 < 1 and x*y > 1", TRUE, "says False"),
        ("ex x. x^2 + y^2 < 1 and x*y > 1", FALSE, "other variables"),
        ("x^2 + y^2 < 1 and x*y > 1", FALSE, "other variables"),
        ("all x, y. x^2 + y^2 < 1 and x*y > 1", FALSE, "no prenex form"),
        ("ex x. all y. x^2 + y^2 < 1 and x*y > 1", FALSE, "no prenex form"),
        ("ex x, y. x^2 + y^2 <= 1 and x*y > 1", FALSE, "no prenex form"),
    ],
)
def test_evidence_is_about_one_formula(before: str, after: Formula, message: str) -> None:
    body = read(BODIES[0])
    assert message in judged(formats.read(before, "text"), after, proof(body, body.free))


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
    assert "over a point only" in judged(question, *answered(question, Budget()))


def test_an_order_over_a_line_that_is_taken_for_known_is_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    """a^2 + b*z has order 1 over a = b = 0, but at z = 0 order 2."""
    question = formats.read("all z. ex t. t^2 = a^2 + b*z", "text")
    assert judged(question, *answered(question, Budget())) == ""
    monkeypatch.setattr(lines, "_delineating", lambda point, poly: poly.derivative(0))
    assert "its order" in judged(question, *answered(question, Budget()))


# --- evidence forged by hand for sentences that are true ----------------------------------------------
def interval(first: int, last: int, at: int, own: list[int], ends: tuple[int | None, int | None], **reason: Any) -> Any:
    return {"first": first, "last": last, "at": at, "own": own, "lower": ends[0], "upper": ends[1], **reason}


def line(used: list[int], sectors: list[str], sections: list[list[int]], *intervals: Any) -> Any:
    return {"used": used, "sectors": sectors, "sections": sections, "intervals": list(intervals)}


def forged(body: Formula, factors: list[list[str]], first: Any) -> str:
    return verdict(body, about(body, factors, first))


def about(body: Formula, factors: list[list[str]], first: Any, kinds: str = "") -> dict[str, Any]:
    names = sorted(body.free)
    asked = {"order": names, "quantifiers": list(kinds or "E" * len(names)), "matrix": formula_to_json(body)}
    return {**asked, "factors": factors, "line": first}


def one(text: str, body: Formula) -> list[Any]:
    assert body.ring is not None
    return [formula_to_json(convert(read(text), body.ring))]


def test_an_interval_over_a_root_of_its_factor_is_rejected() -> None:
    body = read("x^2 < 1")
    whole = interval(0, 4, 4, [0, 1], (None, None), atoms=one("x^2 < 1", body))
    assert "contains a root" in forged(body, [["x - 1", "x + 1"]], line([0, 1], ["-2", "0", "2"], [[1], [0]], whole))


def test_a_factor_of_lower_level_that_is_left_out_is_missed() -> None:
    body = read("x > 0 and y > x")
    above = line([], ["0"], [], interval(0, 0, 0, [], (None, None), atoms=one("x > 0", body)))
    first = line([], ["-1"], [], interval(0, 0, 0, [], (None, None), line=above))
    assert "own" in forged(body, [["x"], []], first)


def test_a_factor_that_is_zero_on_a_line_beside_the_sample_is_rejected() -> None:
    """x*z + y has no root over (0, 1), and is zero on the whole line over (0, 0)."""
    body = read("x = 0 and x*z + y = 0")
    top = line([0], ["0"], [], interval(0, 0, 0, [0], (None, None), atoms=one("x*z + y = 0", body)))
    middle = line([], ["1"], [], interval(0, 0, 0, [], (None, None), line=top))
    outside = one("x = 0", body)
    parts = (
        interval(0, 0, 0, [0], (None, 0), atoms=outside),
        interval(1, 1, 1, [0], (0, 0), line=middle),
        interval(2, 2, 2, [0], (0, None), atoms=outside),
    )
    assert "whole line" in forged(body, [["x"], [], ["x*z + y"]], line([0], ["-1", "1"], [[0]], *parts))


def test_one_true_interval_is_not_enough_for_all_values() -> None:
    body = read("x > 0")
    first = line([0], ["-1", "1"], [[0]], interval(2, 2, 2, [0], (0, None), atoms=one("x > 0", body)))
    given = about(body, [["x"]], first, "A")
    assert "gap" in judged(forall(("x",), body), TRUE, given)


def test_values_beside_a_sample_are_asked_where_the_quantifier_changes() -> None:
    """For all x there is a y with x*y = 1, if only the sample x = 1 were looked at."""
    body = read("x*y = 1")
    above = line(
        [0], ["0", "2"], [[0]], {**interval(1, 1, 1, [], (None, None), atoms=one("x*y = 1", body)), "own": None}
    )
    first = line([], ["1"], [], interval(0, 0, 0, [], (None, None), line=above))
    given = about(body, [[], ["x*y - 1"]], first, "AE")
    assert "beside the sample" in judged(formats.read("all x. ex y. x*y = 1", "text"), TRUE, given)


def test_an_answer_whose_signs_are_not_known_on_a_cell_is_rejected() -> None:
    question = formats.read("ex x. x^2 + b*x + c = 0", "text")
    answer, given = answered(question, Budget())
    stronger = formats.read("b^2 - 4*c >= 0 and (b > 0 or b <= 0)", "text")
    assert judged(question, answer, given) == "" and "does not follow" in judged(question, stronger, given)

"""Steps of methods: by elimination sets, by counted solutions, by signs of minors; altered ones are rejected."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
import qe.elimination.cgs as cgs
from qe.api.input import read_formula
from qe.elimination.protocol import Context
from qe.elimination.rootsigns import method, question
from qe.elimination.vs import plan
from qe.errors import InternalError
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, disj, neg
from qe.formula.evaluate import substituted
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, Formula, Or, Relation
from qe.io.text import read
from qe.kernel.elimination_points import implies
from qe.kernel.step import Claim
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.entry import Entry, Json
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.proving.prover import Prover
from tests.certificates.elimination_claims import (
    RING,
    accepted,
    claimed,
    evidence_for,
    examined,
)


def test_points_that_two_equations_share_have_the_guards_with_which_they_were_tried(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """0 and infinity are tried for more than one reason, of which the engine needed another than the checker first."""
    monkeypatch.setattr(Prover, "_tabulated", lambda self, step: None)
    both, neither = "f*x = c and f*x = 0 and d > 0", "(f*x /= c or f*x /= 0 or d <= 0)"
    text = f"ex x. (a <= 0 or b = 0) and (x <= g and {neither} or {both} and x > g)"
    answer = qe.eliminate(f"{text} or a > 0 and (x > g or {both}) and ({neither} or x <= g) and b /= 0", check=True)
    assert answer.unchecked_steps == ()


def test_a_shifted_variable_that_is_positive_is_not_said_to_be_nonnegative() -> None:
    formula = convert(read("x > 0 and x^2 - a /= 0 and b >= 0"), RING)
    found = plan.choose(formula, frozenset({RING.index["x"]}), strict=False)
    assert found is not None
    assert found.exponent == 2
    assert found.formula == convert(read("x > 0 and x - a /= 0 and b >= 0"), RING)


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 10**6))
def test_what_is_accepted_is_true_and_what_is_produced_is_accepted(seed: int) -> None:
    examined(seed, 2)


@pytest.mark.deep
def test_no_altered_claim_that_is_false_is_accepted() -> None:
    looked, right = examined(20_260, 3_600)
    assert looked > 10_000
    assert right < looked / 2


def over_ring(text: str) -> Formula:
    return convert(read(text), RING)


def _set_of(text: str) -> tuple[Formula, Formula, dict[str, Any]]:
    found = evidence_for(over_ring(text))
    assert found is not None
    return found["body"], claimed(found["body"], found["evidence"]), found["evidence"]


def test_the_answer_must_be_the_disjunction_of_the_points() -> None:
    body, after, evidence = _set_of("a*x + b > 0 and x < 1")
    assert accepted(body, after, evidence)
    assert not accepted(body, disj((after, over_ring("a = 3"))), evidence)
    assert not accepted(body, conj((after, over_ring("a < 3"))), evidence)


@pytest.mark.parametrize("text", ["x^2 + a*x + b < 0 and x > a", "x^2 = a and x > 1", "x >= a and x <= b"])
def test_no_point_can_be_left_out_that_is_needed(text: str) -> None:
    body, after, evidence = _set_of(text)
    assert accepted(body, after, evidence)
    rejected = 0
    for k in range(len(evidence["points"])):
        fewer = {**evidence, "points": evidence["points"][:k] + evidence["points"][k + 1 :]}
        rejected += not accepted(body, claimed(body, fewer), fewer)
    assert rejected == len(evidence["points"])


@pytest.mark.parametrize(
    ("strong", "weak", "expected"),
    [
        ("a > 0 and b > 0", "a > 0", True),
        ("a > 0", "a > 0 or b > 0", True),
        ("(a > 0 or b > 0) and a < 2", "b > 0 or a > 0", True),
        ("a > 0 and (b > 0 or a > 2)", "a > 0 and b > 0 or a > 2", False),
        ("a > 0 or b > 0", "a > 0", False),
        ("a >= 0", "a > 0", False),
    ],
)
def test_implication_by_shape(strong: str, weak: str, expected: bool) -> None:
    assert implies(over_ring(strong), over_ring(weak)) is expected


def test_an_equation_of_high_degree_before_one_that_is_solved_is_no_hindrance() -> None:
    text = "x^3 + b*x - a = 0 and 2*x^2 + a*x + b = 0"
    found = evidence_for(moved(read(text), RING))
    assert found is not None
    body, evidence = found["body"], found["evidence"]
    assert accepted(body, claimed(body, evidence), evidence)
    for k in range(len(evidence["points"])):
        fewer = {**evidence, "points": evidence["points"][:k] + evidence["points"][k + 1 :]}
        assert not accepted(body, claimed(body, fewer), fewer)


QUESTIONS = {
    "one inequality": "ex x. x^2 + a*x + b = 0 and x > 0",
    "closed": "ex x. x^2 = a and x >= b",
    "inequation": "ex x. x^3 + a*x = 0 and x /= 0",
    "two cases": "ex x. a*x^2 + b*x + 1 = 0 and a < b",
    "no Hankel matrix": "ex x, y. x^2 + y^2 = r and x*y = 1",
    "two conjunctions": "ex x. x^2 = a and x > 0 or x^2 = b and x < 1",
    "universal": "all x. x^2 /= a or x < b",
    "no solution": "ex x. x^2 + 1 = 0 and a*x = 1",
    "a line of solutions": "ex x, y. a*x + b*y = 0 and x^2 + y^2 = 1 and x > 0",
    "a curve of solutions": "ex x, y. x*y = a and x > 0",
    "nothing bound": "ex x. a*x = 0 and x > b",
    "no equation": "ex x. x^2 + a*x + 1 < 0 and x > 0",
}


def step(text: str) -> Claim:
    """What the method says about a block, without its evidence."""
    log, problem = RunLog(), Block.of(read_formula(text))
    assert problem is not None
    cgs.ComprehensiveGroebner().run(problem, Context(Options(), Budget(60), log))
    (found,) = log.steps()
    ring = Ring.of(found.before.ring.names)  # type: ignore[union-attr]
    return claim(found.rule, moved(found.before, ring), moved(found.after, ring), ring)


def claim(rule: str, before: Formula, after: Formula, ring: Ring, evidence: Json = None) -> Claim:
    return Claim(rule, before, after, ring, Entry(evidence, "evidence"), "step")


def proved(said: Claim) -> Json | None:
    """The evidence of a step, which the checker has accepted."""
    prover = Prover(said.ring, Options(), Budget(60))
    found = prover.own(Step(said.rule, said.before, said.after), ())
    return None if found is None else found[1]


@pytest.mark.parametrize("text", QUESTIONS.values(), ids=QUESTIONS)
def test_right_steps_are_proved_and_others_are_not(text: str) -> None:
    said = step(text)
    if not said.after.is_quantifier_free:  # a variable is left; then the whole question is decomposed
        assert not is_proved(said) and qe.eliminate(text, method="cgs", check=True).guarantee is qe.Guarantee.CHECKED
        return
    assert proved(said) is not None
    for wrong in (neg(said.after), FALSE, TRUE):
        if wrong != said.after:
            assert not is_proved(replace(said, after=wrong))


def test_a_step_about_something_else() -> None:
    said, other = step(QUESTIONS["closed"]), step(QUESTIONS["one inequality"])
    wrong = replace(said, before=other.before, ring=other.ring)
    assert not is_proved(replace(wrong, after=moved(said.after, wrong.ring)))
    free = moved(read_formula("x > 0"), said.ring)
    assert not is_proved(replace(said, after=conj([said.after, free])))


def is_proved(said: Claim) -> bool:
    """Whether a step has accepted evidence; a decomposition may contradict it, too."""
    try:
        return proved(said) is not None
    except InternalError:
        return False


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("ex x, y. x^2 + y^2 = a and x*y = b", "2*b <= a and -2*b <= a"),
        ("ex x, y. x^2 + y^2 = a and y > b", "b^2 < a or a >= 0 and b < 0"),
        ("ex x, y, u, v. x + u = a and y + v = 0 and x^2 + y^2 = 1 and u^2 + v^2 = 1", "a^2 <= 4"),
    ],
)
def test_answers_with_parameters_are_checked(text: str, expected: str) -> None:
    found = qe.eliminate(text, method="cgs", check=True, process=False)
    assert found.guarantee is qe.Guarantee.CHECKED and qe.equivalent(found.formula, expected)


FORMS = (
    "ex x. x > 0 and x^4 + a*x^2 + b*x + c = 0",
    "all x. x^4 + a*x^2 + b*x + c >= 0",
    "ex x. a*x^3 + c*x + d <= 0 and x >= 0 and x <= 1",
)


def claimed_by_signs(before: Formula, after: Formula) -> bool:
    """Whether the step is made of steps of the kernel that are accepted."""
    names = dict.fromkeys((*before.ring.names, *(after.ring.names if after.ring else ())))
    ring = Ring.of(names)
    prover = Prover(ring, Options(), Budget(60))
    found = prover.own(Step("roots by signs", convert(before, ring), convert(after, ring)), ())
    return found is not None


def produced(before: Formula) -> Formula:
    problem = Block.of(before)
    assert problem is not None
    x = problem.body.ring.index[problem.variables[0]]
    asked = question.read(problem.dual.body, x)
    assert asked is not None
    return problem.asked(method.answer(asked, x, Budget()))


def altered(formula: Formula) -> Iterator[Formula]:
    """One comparison with another relation or other side, or one part left out."""
    match formula:
        case Atom(poly, relation):
            yield from (Atom(poly, r) for r in Relation if r is not relation)
            yield from (atom(poly + k, relation) for k in (1, -1))
        case And(args) | Or(args):
            join = conj if isinstance(formula, And) else disj
            for k, arg in enumerate(args):
                yield join((*args[:k], *args[k + 1 :]))
                yield from (join((*args[:k], other, *args[k + 1 :])) for other in altered(arg))
        case Exists(variables, body):
            yield from (Exists(variables, other) for other in altered(body) if other not in (TRUE, FALSE))


@pytest.mark.parametrize("text", [*FORMS[:2], "ex x. a*x^4 + b*x + 1 <= 0 and x > 1"])
def test_an_altered_claim_is_accepted_only_where_it_is_the_same_on_all_rows(text: str) -> None:
    """Some alterations change nothing (p <= 0 for p < 0 where 0 is met elsewhere): those are checked at numbers."""
    before = read(text)
    after = produced(before)
    assert claimed_by_signs(before, after)
    rng, right, wrong = random.Random(text), [], 0
    for other in list(altered(after))[rng.randrange(8) :: 16]:
        if claimed_by_signs(before, other):
            right.append(other)
        else:
            wrong += 1
    assert wrong > 2 * len(right)
    for other in right:
        for _ in range(3):
            values = {name: rng.randint(-3, 3) for name in before.free}
            here, there = (qe.decide(substituted(f, values), without="roots", process=False) for f in (before, other))
            assert here is there, (other, values)


def polynomial(rng: random.Random, degree: int) -> str:
    terms = [f"{rng.choice(('a', 1, 2, -1, 0))}*x^{k}" for k in range(degree)]
    return " + ".join([*terms, f"{rng.choice((1, -1, 'a'))}*x^{degree}"])


@settings(max_examples=6, deadline=None)
@given(st.integers(0, 10**6))
def test_what_is_produced_is_accepted(seed: int) -> None:
    rng = random.Random(seed)
    relation = rng.choice(("=", "<", "<=", ">", ">="))
    beside = rng.choice(("", "and x > a", "and x <= 2", "and x > 0 and x <= b", "and x >= 0 and x <= 1", "g"))
    if beside == "g":
        relation, beside = "=", f"and {polynomial(rng, 2)} {rng.choice(('>', '>=', '/=', '<'))} 0"
    before = read(f"ex x. {polynomial(rng, rng.choice((3, 3, 4)))} {relation} 0 {beside}")
    if not isinstance(before, Exists) or question.read(before.body, before.ring.index["x"]) is None:
        return
    assert claimed_by_signs(before, produced(before))

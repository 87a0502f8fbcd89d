"""Elimination sets: what virtual substitution does is accepted; altered evidence and broken producers are rejected."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.elimination.vs import block, candidates, plan, radical_free, substitute
from qe.formula.build import conj, convert, disj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, Formula, Or
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.kernel.elimination_points import implies
from qe.proof.derivation import moved
from qe.proving.prover import Prover
from tests.certificates.elimination_claims import (
    RING,
    accepted,
    claimed,
    evidence_for,
    examined,
    unchecked,
)

EXAMPLES = [
    "ex x. a*x^2 + b*x + c = 0",
    "ex x. a*x + b = 0 and c*x + d > 0",
    "ex x, y. x^2 + y^2 = 1 and y = a*x + b",
    "ex x. ((a*x = b and x > 1 and x < 2 or x = 5) and x < c)",
    "ex x, y. x > a and y > x and y < b and x*y > 1",
    "ex x. x^4 + a*x^2 + b <= 0",
    "ex x. x^2 - a < 0 and x^2 - 2*x + b < 0",
    "ex x. (x - a)^2 <= 1 and (x - b)^2 <= 1 and x > c",
    "ex x, y. c > 0 and x*c > 1 and y^2 < c and x + y = 0",
    "ex x, y. x*y - 2*a + 3 < 0",
    "all x. x^2 + a*x + b > 0",
    "ex x. x^4 - a*x^2 < 0 and b*x^2 > 1",
]


@pytest.mark.parametrize("text", EXAMPLES)
def test_every_step_of_virtual_substitution_is_checked(text: str) -> None:
    plain = qe.eliminate(text, method="vs", without="distribution")  # so that substitution sees the whole
    answer = qe.eliminate(text, method="vs", without="distribution", check=True)
    assert answer.formula == plain.formula
    assert answer.unchecked_steps == ()
    assert answer.certificate is not None
    assert qe.verify(qe.Certificate.from_json(answer.certificate.to_json())).accepted


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
    looked, right = examined(20_260, 1_200)
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


Break = Callable[[pytest.MonkeyPatch], None]


def _no_degenerate_case(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(candidates, "vanishing", lambda f, x, facts: FALSE)


def _no_infinity(patch: pytest.MonkeyPatch) -> None:
    whole = plan._with_bounds

    def without(*args: Any) -> Any:
        found = whole(*args)
        return None if found is None else replace(found, infinities=())

    patch.setattr(plan, "_with_bounds", without)


def _wrong_direction(patch: pytest.MonkeyPatch) -> None:
    points = candidates._roots
    patch.setattr(candidates, "_roots", lambda g, f, e, c, d, *others: points(g, f, e, c, -d, *others))


def _no_epsilon(patch: pytest.MonkeyPatch) -> None:
    points = candidates._roots
    patch.setattr(candidates, "_roots", lambda g, f, e, *others: points(g, f, 0, *others))


def _one_branch(patch: pytest.MonkeyPatch) -> None:
    points = candidates._roots
    patch.setattr(candidates, "_roots", lambda *args: list(points(*args))[:1])


def _everything_settled(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(
        block,
        "in_order",
        lambda found: (
            (c, frozenset(a for a in conjuncts(c.formula) if a.relation.is_strict) if c.point.epsilon else frozenset())
            for c in found
        ),
    )


def _other_conjuncts_forgotten(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(candidates, "disjuncts", lambda formula: ())


def _any_quadratic_is_lone(patch: pytest.MonkeyPatch) -> None:
    def found(formula: Formula, x: int) -> Any:
        parts = (f for a in radical_free.atoms(formula) for f, _ in radical_free.factor_list(a.poly))
        return next((f for f in parts if f.degree(x) == 2), None)

    patch.setattr(radical_free, "lone_quadratic", found)


def _wrong_table(patch: pytest.MonkeyPatch) -> None:
    table = substitute.root_condition
    patch.setattr(substitute, "root_condition", lambda a, b, d, relation, make: table(a, b, -d, relation, make))


def _always_open(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(block, "is_open", lambda formula, inside: True)


def _one_disjunct(patch: pytest.MonkeyPatch) -> None:
    whole = block._Run._solve

    def first(self: Any, formula: Formula, inside: Any) -> Any:
        return whole(self, formula.args[0] if isinstance(formula, Or) else formula, inside)

    patch.setattr(block._Run, "_solve", first)


def _every_part_alone(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(block, "connected", lambda parts, names: ((), [(frozenset(), (p,)) for p in parts]))


def _any_number(patch: pytest.MonkeyPatch) -> None:
    def found(formula: Formula, variable: str, known: object) -> Fraction:
        return next(v for v in map(Fraction, range(99)) if not holds_at(formula, {variable: v}))

    patch.setattr(block, "solution", found)
    patch.setattr(Prover, "_tabulated", lambda self, step: None)  # by which the right answer is proved all the same


BROKEN = [
    (_one_disjunct, "ex x. x^2 = a and x > b or x < a and x > 3"),
    (_every_part_alone, "ex x. a*x > b and x < c"),
    (_any_number, "ex x, y. x*y > 1 and x^2 > y^2 + 5*x"),
    (_no_degenerate_case, "ex x. a*x = b and x > a"),
    (_no_infinity, "ex x. a*x > b and x < a"),
    (_wrong_direction, "ex x. a*x > b and x < a"),
    (_no_epsilon, "ex x. x > a and x < b and a*x /= 1"),
    (_one_branch, "ex x. x^2 = a and x > b"),
    (_everything_settled, "ex x. x^2 > a and x*a > b and x < 1"),
    (_other_conjuncts_forgotten, "ex x. (a*x = b and x > 1 and x < 2 or x = 5) and x < c"),
    (_any_quadratic_is_lone, "ex x. (x^2 >= a or x < b) and x^2 <= a"),
    (_wrong_table, "ex x. x^2 = a and x > b"),
    (_always_open, "ex x, y. x + a*y = 1 and x - b*y = a and x > 3"),
]


@pytest.mark.parametrize(("breaking", "text"), BROKEN, ids=[b.__name__ for b, _ in BROKEN])
def test_a_broken_producer_is_caught(breaking: Break, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each side condition switched off: its steps are accepted no more."""
    assert unchecked(text) == ()
    breaking(monkeypatch)
    assert unchecked(text) != ()


def test_a_point_met_under_conditions_that_contradict_themselves_stays_real():
    """They left the point without the condition that it is one (a plane that meets a ball was not proved)."""
    text = "ex x, y. c^2*(x - p)^2 + c^2*(y - q)^2 + (c*s - d)^2 <= c^2*r^2"
    answer = qe.eliminate(text, method="vs", check=True, process=False)
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps


def test_an_equation_of_high_degree_before_one_that_is_solved_is_no_hindrance() -> None:
    text = "x^3 + b*x - a = 0 and 2*x^2 + a*x + b = 0"
    found = evidence_for(moved(read(text), RING))
    assert found is not None
    body, evidence = found["body"], found["evidence"]
    assert accepted(body, claimed(body, evidence), evidence)
    for k in range(len(evidence["points"])):
        fewer = {**evidence, "points": evidence["points"][:k] + evidence["points"][k + 1 :]}
        assert not accepted(body, claimed(body, fewer), fewer)

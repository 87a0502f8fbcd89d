"""Refutations by Boolean search: those made are accepted; altered ones, and those of a broken search, are not."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.elimination.protocol import Context, Outcome
from qe.elimination.search.clauses import Clauses
from qe.elimination.search.method import RULE, BooleanSearch
from qe.elimination.search.theory import Theory
from qe.engine.run import outcome_for
from qe.errors import InternalError
from qe.exact.difference_graph import DifferenceGraph
from qe.formula.block import Block
from qe.formula.build import conj, exists, forall
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Constant, Formula
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.on_demand import completed
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.proving.prover import Prover
from tests.unit.certify.claims import NO_LEMMAS, objection
from tests.unit.elimination.search.test_method import FORMULAS, RING, WITHOUT, many

pytest.importorskip("pysat")

CASES = "ex x, y. (x > 1 or x*y > 1) and (x > 1 or x*y < 0) and (x < 0 or y > 2) and (x < 0 or y^2 < 1)"


def decide(sentence: Formula, options: Options, budget: Budget) -> Outcome:
    """As the engine decides for the search."""
    return outcome_for(sentence, WITHOUT.with_(certify=True), budget)


def step_of(sentence: Formula) -> Step:
    """The step of a search that decides the sentence."""
    problem, log = Block.of(sentence), RunLog()
    assert problem is not None
    BooleanSearch().run(problem, Context(Options(certify=True), Budget(120), log, decide))
    return next(step for step in log.steps() if step.rule == RULE)


def evidence(step: Step) -> Any:
    """Its evidence, accepted; None where none is found."""
    assert step.before.ring is not None
    found = Prover(step.before.ring, Options(certify=True), Budget(120)).own(completed(step, Budget(120)), ())
    return None if found is None else found[1]


def parts(evidence: Any) -> Any:
    """Its conflicts and clauses."""
    return evidence["theory"]


def example() -> tuple[Formula, Any]:
    sentence = read(CASES)
    return sentence, evidence(step_of(sentence))


@settings(max_examples=15, deadline=None)
@given(st.lists(FORMULAS, min_size=2, max_size=5).map(conj), st.booleans())
def test_random_refutations_are_accepted(body: Formula, universal: bool) -> None:
    if isinstance(body, Constant):
        return
    names = RING.names
    sentence = forall(names, nnf(body, negate=True)) if universal else exists(names, body)
    found = step_of(sentence)
    if found.after == (FALSE if universal else TRUE):
        return  # a point is the proof
    assert found.after == (TRUE if universal else FALSE)
    assert evidence(found) is not None


def test_the_whole_answer_is_a_derivation() -> None:
    sentence = many(14, "x + y < 2 and x - y < 1 and y - x < 1 and z = 1")
    answer = qe.eliminate(sentence, check=True, timeout=120)
    assert (answer.truth, answer.unchecked_steps, answer.guarantee) == (False, (), qe.Guarantee.CHECKED)
    assert [plan.split()[0] for plan in answer.stats["plan"]] == ["search"]
    assert answer.certificate is not None
    again = qe.Certificate.from_json(answer.certificate.to_json())
    assert again.payload["steps"][0]["rule"] == "signs"  # type: ignore[call-overload,index]
    assert qe.verify(again, formula=sentence).accepted


ALTERED: dict[str, tuple[Callable[[Any], object], str]] = {
    "no conflict": (lambda e: parts(e)["refuted"].clear(), "cases"),
    "one conflict less": (lambda e: parts(e)["refuted"].pop(), "do not exclude"),
    "a conflict without its refutation": (
        lambda e: parts(e)["refuted"][0]["steps"].clear(),
        "evidence.theory.refuted[0].steps",
    ),
    "atoms that hold together": (lambda e: parts(e)["refuted"][0]["atoms"].pop(), "evidence.theory.refuted[0].steps"),
    "no atoms": (lambda e: parts(e)["refuted"][0]["atoms"].clear(), "evidence.theory.refuted[0].steps"),
    "no comparison": (lambda e: parts(e)["refuted"][0].update(atoms=[True]), "evidence.theory.refuted[0].atoms[0]"),
    "a literal of nothing": (lambda e: parts(e)["cases"].insert(0, [0, [9999]]), "evidence.theory.cases[0][1]"),
    "a negative literal": (lambda e: parts(e)["cases"].insert(0, [0, [-4]]), "evidence.theory.cases[0][1][0]"),
    "a literal without signs": (lambda e: parts(e)["cases"].insert(0, [0, [8]]), "evidence.theory.cases[0]"),
    "no such goal": (lambda e: parts(e)["cases"].insert(0, [2, []]), "evidence.theory.cases[0][0]"),
    "a clause from nowhere": (lambda e: parts(e)["cases"].insert(0, [0, [4]]), "evidence.theory.cases[0]"),
    "the empty clause at once": (lambda e: parts(e)["cases"].insert(0, [0, []]), "evidence.theory.cases[0]"),
}


@pytest.mark.parametrize("name", ALTERED)
def test_altered_entries_are_named(name: str) -> None:
    sentence, made = example()
    assert objection("signs", sentence, FALSE, made) == ""
    changed = copy.deepcopy(made)
    alter, place = ALTERED[name]
    alter(changed)
    assert place in objection("signs", sentence, FALSE, changed)


def test_other_claims() -> None:
    sentence, made = example()
    assert objection("signs", sentence, TRUE, made)
    assert objection("signs", "ex x, y. x > 1 or y > a", FALSE, made)
    assert objection("signs", sentence, FALSE, {"theory": {**NO_LEMMAS, "refuted": []}})


def test_every_true_sentence_is_refused() -> None:
    """Evidence of a false sentence for one with a solution: the checks of conflicts and clauses do not depend on it."""
    for old, new in (("x > 1", "x < 1"), ("x*y < 0", "x*y > 0"), ("y > 2", "y > 0")):
        assert old in CASES
        sentence = CASES.replace(old, new)
        assert qe.decide(sentence)
        assert objection("signs", sentence, FALSE, example()[1])


# --- broken producers -----------------------------------------------------------------------------
def everything_conflicts(m: pytest.MonkeyPatch) -> None:
    """The first conjunction that is looked at is taken for refuted."""
    m.setattr(Theory, "look", lambda self, atoms: [list(atoms)])


def curves_never_meet(m: pytest.MonkeyPatch) -> None:
    """Whatever the engine is asked about counts as refuted."""
    m.setattr(Theory, "_part", lambda self, part, work=None: None)


def wrong_order(m: pytest.MonkeyPatch) -> None:
    """Bounds of one form exclude each other the wrong way round."""
    import qe.elimination.search.clauses as clauses

    excluded = clauses._excluded
    m.setattr(clauses, "_excluded", lambda lower, higher: excluded(higher, lower))


def half_a_path(m: pytest.MonkeyPatch) -> None:
    """Of the differences on a path one is forgotten."""
    reasons = DifferenceGraph.reasons
    m.setattr(DifferenceGraph, "reasons", lambda self, *path: reasons(self, *path)[1:])


def nothing_asserted(m: pytest.MonkeyPatch) -> None:
    """A contradiction among the clauses that does not come from the formula."""
    order = Clauses._order
    m.setattr(Clauses, "_order", lambda self: (order(self), self.clauses.append([])))


@pytest.mark.parametrize(
    "broken", [everything_conflicts, curves_never_meet, wrong_order, half_a_path, nothing_asserted]
)
def test_a_broken_search_is_found_out(broken: Callable[[pytest.MonkeyPatch], None]) -> None:
    """Sentences that have solutions, which the broken search calls false."""
    true = [
        "ex x, y. (x > 1 or y > 1) and (x > 2 or y > 2) and (x < 1 or y < 3) and x + y < 4",
        "ex x, y. (x > 1 or x > 2 or x > 3) and (y > 1 or x > 4)",
        "ex x, y. (x < 1 or x < 2) and (x > 0 or x > 1) and (x*y > 1 or x*y > 2)",
        "ex x, y, z. (x < y or y < z + 3) and z < x and (x < z + 1 or z < x - 1) and (y < z - 1 or y < z) and "
        "(y < x + 3 or x < z - 1) and (x < y or y < x + 1) and (y < x + 3 or x < z)",
    ]
    with pytest.MonkeyPatch.context() as m:
        broken(m)
        steps = [step_of(read(text)) for text in true]
    false = [step for step in steps if step.after == FALSE]
    assert false
    for step in false:
        try:
            assert evidence(step) is None
        except InternalError as error:  # a decomposition that was to help saw it
            assert "a decomposition says True" in str(error)


def test_a_conjunction_of_few_variables_of_many_is_refuted_in_their_own_ring() -> None:
    """Of thirty variables three are in a curved contradiction; the whole stays one derivation."""
    cases = " and ".join(f"(a{k} > {k} or a{k} < -x - {k} or a{k}*x > y)" for k in range(1, 28))
    names = ", ".join(f"a{k}" for k in range(1, 28))
    sentence = read(f"ex {names}, x, y, z. {cases} and x > 1 and y > 1 + z^2 and x*y < 1")
    problem = Block.of(sentence)
    assert problem is not None and sentence.ring is not None and sentence.ring.is_wide
    asked: list[Formula] = []

    def noted(part: Formula, options: Options, budget: Budget) -> Outcome:
        asked.append(part)
        return decide(part, options, budget)

    log = RunLog()
    found = BooleanSearch().run(problem, Context(Options(certify=True), Budget(120), log, noted))
    assert found is not None and found.formula == FALSE
    assert asked and not any(part.ring is not None and part.ring.is_wide for part in asked)
    assert evidence(next(step for step in log.steps() if step.rule == RULE)) is not None

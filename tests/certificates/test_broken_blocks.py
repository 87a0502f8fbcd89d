"""Rules about whole blocks with a side condition switched off in the producer: their steps are not accepted."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import pytest

import qe.elimination.critical.degenerate as degenerate
import qe.elimination.vs.infinity_first as infinity_first
import qe.elimination.witness as witness
import qe.engine.run as run
import qe.formula.counting as counting
from qe.api.input import read_formula
from qe.elimination.critical.method import ConvexUniversal
from qe.elimination.protocol import Context, Outcome
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.syntax import FALSE, TRUE, ForAll, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.options import Budget, Options
from qe.proof.derivation import moved, put_together
from qe.proof.run_log import RunLog
from qe.proof.step import Nested, Step
from qe.proving.nested import names_within
from qe.proving.prover import Prover
from tests.certificates.derivations import CASES, data
from tests.certificates.test_derivation_rejected import altered, at, entries, others, refused
from tests.tables import each

Patch = Callable[[pytest.MonkeyPatch], None]


def unproved(given: Formula, log: RunLog, answer: Formula) -> set[str]:
    """The rules of the steps from a formula to an answer for which no evidence is accepted, decompositions apart."""
    derivation = put_together(given, log.steps(), answer)
    rings = [f.ring for f in (derivation.start, *(s.before for s in derivation.steps)) if f.ring is not None]
    ring = Ring.of(dict.fromkeys((*rings[0].names, *names_within(list(derivation.steps)))))
    prover = Prover(ring, Options(), Budget(), tables=False)
    prover.whole(derivation, moved(derivation.start, ring), moved(answer, ring))
    return set(prover.unchecked)


def infinity(text: str) -> set[str]:
    """By the rule "infinity first" alone."""
    given, log = read_formula(text), RunLog()
    problem = Block.of(given)
    assert problem is not None
    found = infinity_first.InfinityFirst().run(problem, Context(Options(), Budget(), log))
    assert found is not None
    return unproved(given, log, found.formula)


def terms(text: str) -> set[str]:
    """By the rule "witness in the parameters" alone."""
    given, log = read_formula(text), RunLog()
    problem = Block.of(given)
    assert problem is not None
    found = witness.PolynomialWitnesses().run(problem, Context(Options(), Budget(), log))
    assert found is not None
    return unproved(given, log, found.formula)


def roots(text: str) -> set[str]:
    """By the rule "roots counted" alone."""
    given, log = read_formula(text), RunLog()
    plain = log.step("roots counted", given, counting.without_root_atoms(given))
    return unproved(given, log, plain)


def thin(text: str) -> set[str]:
    """By the rule "degenerate truth set" alone."""
    given, log = read_formula(text), RunLog()
    problem = Block.of(given)
    assert problem is not None
    found = ConvexUniversal().run(problem, Context(Options(), Budget(), log))
    assert found is not None
    return unproved(given, log, found.formula)


def whole(text: str, *, certify: bool = False) -> set[str]:
    """The whole engine; with ``certify`` it keeps the evidence of tables."""
    given = read_formula(text)
    found = run.solve(given, Options(certify=certify), Budget())
    return unproved(given, found.log, found.formula)


def no_other_sign(m: pytest.MonkeyPatch) -> None:
    """Nothing is left where the leading coefficient is not 0, whatever the truth."""
    prepared = infinity_first._prepared

    def careless(block: Formula, budget: Budget) -> Nested:
        found = prepared(block, budget)
        equation = any(getattr(a, "relation", None) is Relation.EQ for a in conjuncts(block.body))  # type: ignore[attr-defined]
        return found if equation else Nested(block, (), FALSE)

    m.setattr(infinity_first, "_prepared", careless)


def one_end(m: pytest.MonkeyPatch) -> None:
    """What holds far on the right counts for nothing, and it is forgotten that it may."""
    no_other_sign(m)
    m.setattr(infinity_first, "disj", lambda parts: next(iter(parts)))


def believed(m: pytest.MonkeyPatch) -> None:
    """The first candidate is taken."""
    m.setattr(witness, "simplify", lambda formula, known=TRUE, **_: TRUE)
    m.setattr(witness, "_probes", lambda known, names: iter(()))


def weakly(m: pytest.MonkeyPatch) -> None:
    """Roots before a place and roots up to it are not told apart."""
    at_least = counting._at_least

    def careless(poly: Any, x: int, names: list[int], relation: Relation | None) -> Formula:
        return at_least(poly, x, names, Relation.LE if relation is Relation.LT else relation)

    m.setattr(counting, "_at_least", careless)


def never_zero(m: pytest.MonkeyPatch) -> None:
    """That the polynomial does not vanish identically is left out."""
    m.setattr(counting, "disj", lambda parts: TRUE)


def one_root_fewer(m: pytest.MonkeyPatch) -> None:
    """Too few roots are counted."""
    counted = counting.counted_roots
    m.setattr(counting, "counted_roots", lambda found, names: counted(replace(found, k=1), names))


def no_exception(m: pytest.MonkeyPatch) -> None:
    """Every sentence that is asked on the way is false."""
    m.setattr(run, "outcome_for", lambda sentence, options, budget: Outcome(FALSE))
    m.setattr("qe.engine.constant._at", lambda formula, names, pattern: False)
    m.setattr("qe.engine.constant.holds_at", lambda formula, point: False)


def no_solution(m: pytest.MonkeyPatch) -> None:
    """The necessary conditions count as contradictory."""
    m.setattr(ConvexUniversal, "run", _thin_run)
    m.setattr(degenerate, "implied_equations", lambda conditions, budget: None)


def another_equation(m: pytest.MonkeyPatch) -> None:
    """An equation counts as implied that is not."""
    m.setattr(ConvexUniversal, "run", _thin_run)
    m.setattr(
        degenerate,
        "implied_equations",
        lambda conditions, budget: [conditions.ring.var("x") + conditions.ring.var("y")],
    )


def _thin_run(self: ConvexUniversal, problem: Block, context: Context) -> Outcome | None:
    """As if the set had no interior points."""
    block = problem.formula
    assert isinstance(block, ForAll)
    found = degenerate.thin_universal(block, problem.positive, problem.free, context.budget)
    assert found is not None
    proof = {"proof": found.evidence}
    return Outcome(context.log.step("degenerate truth set", block, found.formula, evidence=proof))


BROKEN: dict[str, tuple[Patch, Callable[[str], set[str]], str, str]] = {
    "no other sign": (no_other_sign, infinity, "ex x. a*x^4 + b*x + c < 0 and x > d", "infinity first"),
    "one end": (one_end, infinity, "ex x. a*x^3 + b*x^2 + c < 0", "infinity first"),
    "terms": (believed, terms, "all a, b. ex x. (x - a)^2 <= (a - b)^2 and x < a", "witness in the parameters"),
    "weakly": (weakly, roots, "x > root(1, x^2 - y)", "roots counted"),
    "vanishing": (never_zero, roots, "x > root(1, a*x^2 - y)", "roots counted"),
    "fewer": (one_root_fewer, roots, "x <= root(2, x^2 - y)", "roots counted"),
    "no solution": (no_solution, thin, "all t. 0 <= t and t <= 1 -> x^2 + (y - t)^2 <= 1/4", "degenerate truth set"),
    "equation": (another_equation, thin, "all t. 0 <= t and t <= 1 -> x^2 + (y - t)^2 <= 1/4", "degenerate truth set"),
    "constant": (no_exception, whole, "a^2 + b^2 < 1 and a^4 + b > 0", "constant"),
}


THIN = ("all t. 0 <= t and t <= 1 -> x^2 + (y - t^3)^2 <= 1/4", "all t. 0 <= t and t <= 1 -> x^2 + y^2 + t^3 <= t - 1")


@pytest.mark.parametrize("text", THIN)
def test_every_entry_of_the_evidence_of_a_thin_set(text: str) -> None:
    made = data(text)
    k = next(k for k, step in enumerate(made["payload"]["steps"]) if "no exception" in json.dumps(step))
    inner = made["payload"]["steps"][k]["evidence"]["steps"]
    for j, step in enumerate(inner):
        for name in ("before", "after", "evidence"):
            for other in (None, "x", 3, [], True, ["x", "x + y"]):
                if other == step[name]:
                    continue

                def change(payload: dict[str, Any], j: int = j, name: str = name, other: object = other) -> None:
                    payload["steps"][k]["evidence"]["steps"][j][name] = other

                refused(altered(made, change), k)


@pytest.mark.parametrize("name", BROKEN)
def test_the_step_is_not_accepted(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    patch, rules, text, rule = BROKEN[name]
    patch(monkeypatch)
    assert rule in rules(text)


def test_with_their_side_conditions_they_are() -> None:
    assert infinity("ex x. a*x^3 + b*x + c < 0") == set()
    assert infinity("all x. a*x^5 + b*x^2 + c > 0 or x = d") == set()
    assert terms("all a, b. ex x. 4*(x - a)^2 <= (a - b)^2 and 4*(x - b)^2 <= (a - b)^2") == set()
    for relation in ("=", "/=", "<", "<=", ">", ">="):
        for k in (1, 2, -1, -2):
            poly = "x^3 - a*x + y" if relation == "<=" else "x^2 - a*x + y"
            assert roots(f"ex a. not x {relation} root({k}, {poly}) or a = 1") == set()
    assert thin("all t. 0 <= t and t <= 1 -> x^2 + y^2 + t^3 <= t - 1") == set()
    assert thin("all t. 0 <= t and t <= 1 -> x^2 + (y - t^3)^2 <= 1/4") == set()
    assert whole("a^2 + b^2 < 1 and a*b > 1", certify=True) == set()


@each(24, pytest.param(4, marks=pytest.mark.deep))
def test_steps_inside_the_evidence(step: int) -> None:
    """Steps from infinity, and from what remains, may not be altered either."""
    made = data(CASES["infinity"])
    k = next(k for k, step in enumerate(made["payload"]["steps"]) if step["rule"] == "steps")
    for path, value in _few(entries(made["payload"]["steps"][k]["evidence"]))[::step]:
        for other in others(value):

            def change(payload: dict[str, Any], path: Any = path, other: object = other) -> None:
                at(payload["steps"][k]["evidence"], path[:-1])[path[-1]] = other

            refused(altered(made, change), k)


def _few(found: Iterator[tuple[Any, Any]]) -> list[tuple[Any, Any]]:
    return [entry for entry in found if "samples" not in entry[0]]


def test_names_inside_the_evidence() -> None:
    """Variables that occur in nested derivations alone belong to the ring too."""
    given = read_formula("ex x. a*x^3 + b*x + c < 0")
    inner = Nested(given, (Step("renaming", given, read_formula("ex t. a*t^3 + b*t + c < 0")),), TRUE)
    assert set(names_within({"proof": [inner]})) == {"a", "b", "c", "x", "t"}

"""Rule "comprehensive Gröbner system" with parameters: right steps are proved, wrong ones contradict one of the cases
into which the checker divides the parameter space, and evidence belongs to its cases."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

import qe
import qe.elimination.cgs as cgs
import qe.groebner.counting as counting
import qe.groebner.trace_form as trace_form
from qe.api.input import read_formula
from qe.certify.registry import RULES
from qe.elimination.protocol import Context
from qe.errors import CertificateRejected, InternalError, Unable
from qe.exact.ring import Ring
from qe.expert.counted_solutions import check_counted_solutions, sentences
from qe.formula.block import Block
from qe.formula.build import conj, neg
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.groebner.counting import SolutionCount
from qe.groebner.signs import SignatureConditions
from qe.kernel.derivation import limits_of
from qe.kernel.step import Claim
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.entry import Entry, Json
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.proving.prover import Prover

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


def limits() -> Any:
    return limits_of(Budget(60), RULES)


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


def is_contradicted(said: Claim) -> bool:
    """Whether a case shows that the step is wrong."""
    return not all(qe.decide(s, process=False) for s in sentences(said, lambda: None))


def refused(said: Claim, evidence: Json) -> None:
    with pytest.raises(CertificateRejected):
        check_counted_solutions(replace(said, evidence=Entry(evidence, "evidence")), (), limits())


@pytest.mark.parametrize("text", QUESTIONS.values(), ids=QUESTIONS)
def test_right_steps_are_proved_and_others_are_not(text: str) -> None:
    said = step(text)
    evidence: Any = proved(said)
    proofs = evidence["proofs"]
    assert isinstance(proofs, list)
    refused(said, {"proofs": [*proofs, {"theory": {"polynomials": [], "lemmas": [], "cases": []}}]})
    for k in range(len(proofs)):
        refused(said, {"proofs": proofs[:k] + proofs[k + 1 :]})
        refused(said, {"proofs": [*proofs[:k], {"kind": "bundle", "certificates": []}, *proofs[k + 1 :]]})
    for wrong in (neg(said.after), FALSE, TRUE):
        if wrong != said.after:
            refused(replace(said, after=wrong), evidence)


def test_a_step_about_something_else() -> None:
    said = step(QUESTIONS["closed"])
    evidence = proved(said)
    other = step(QUESTIONS["one inequality"])
    for wrong in (replace(said, before=other.before, ring=other.ring), replace(said, before=said.after)):
        refused(replace(wrong, after=moved(said.after, wrong.ring)), evidence)
    free = moved(read_formula("x > 0"), said.ring)
    refused(replace(said, after=conj([said.after, free])), evidence)


Patch = Callable[[pytest.MonkeyPatch], None]


def not_strict(m: pytest.MonkeyPatch) -> None:
    """Solutions at which a polynomial is 0 count as those at which it is positive."""
    m.setitem(counting._WEIGHTS, Relation.GT, counting._WEIGHTS[Relation.GE])


def no_condition(m: pytest.MonkeyPatch) -> None:
    """The basis of one segment is used everywhere."""
    m.setattr(cgs, "condition_of", lambda segment: TRUE)


def none_is_some(m: pytest.MonkeyPatch) -> None:
    """No solution is enough."""
    m.setattr(SolutionCount, "is_positive", property(lambda self: self.is_in(range(self.most + 1))))


def at_most_one(m: pytest.MonkeyPatch) -> None:
    """Two solutions are not counted."""
    m.setattr(SolutionCount, "is_positive", property(lambda self: self.is_in({1})))


def never_negative(m: pytest.MonkeyPatch) -> None:
    """Signatures are taken to be as for squares."""
    m.setattr(trace_form, "_is_square", lambda poly: True)


def always_hankel(m: pytest.MonkeyPatch) -> None:
    """Minors are read as those of forms in the powers of one variable."""

    def read(minors: Any, coefficients: Any, is_hankel: bool, *rest: Any) -> SignatureConditions:
        return SignatureConditions(minors, coefficients, True, *rest)

    m.setattr(trace_form, "SignatureConditions", read)


def no_curves(m: pytest.MonkeyPatch) -> None:
    """Segments with infinitely many solutions are left out."""
    own = cgs._Conjunction._of_segment
    m.setattr(
        cgs._Conjunction,
        "_of_segment",
        lambda self, segment, *rest: own(self, segment, *rest) if segment.dimension == 0 else FALSE,
    )


def nothing_beside(m: pytest.MonkeyPatch) -> None:
    """Conditions on the parameters alone are forgotten."""
    own = cgs._Conjunction.of
    m.setattr(cgs._Conjunction, "of", staticmethod(lambda *args: replace(own(*args), outside=())))


def one_end(m: pytest.MonkeyPatch) -> None:
    """The line has one end."""
    own = cgs._at_end
    m.setattr(cgs, "_at_end", lambda g, relation, x, side: own(g, relation, x, 1))


def no_points_between(m: pytest.MonkeyPatch) -> None:
    """Bounded intervals are forgotten."""
    m.setattr(cgs._Conjunction, "_at_zeros", lambda *args: FALSE)


BROKEN: list[tuple[Patch, str]] = [
    (not_strict, "ex x. x^2 = a and x > b"),
    (no_condition, "ex x. a*x^2 + b*x + 1 = 0"),
    (none_is_some, QUESTIONS["one inequality"]),
    (at_most_one, "ex x. x^2 = a"),
    (never_negative, QUESTIONS["one inequality"]),
    (always_hankel, "ex x, y. x^2 = a and y^2 = b"),
    (no_curves, QUESTIONS["nothing bound"]),
    (nothing_beside, QUESTIONS["two cases"]),
    (one_end, "ex x. x < a"),
    (no_points_between, QUESTIONS["no equation"]),
]


@pytest.mark.parametrize(("broken", "text"), BROKEN)
def test_a_side_condition_switched_off_is_noticed(broken: Patch, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert not is_contradicted(step(text))
    broken(monkeypatch)
    said = step(text)
    assert is_contradicted(said)
    with pytest.raises(InternalError, match="where the answer is true"):
        proved(said)


@pytest.mark.parametrize("text", ["ex x. x^12 + a*x + 1 = 0", "ex x. x^9 + a*x + 1 = 0 and x > 0"])
def test_many_solutions(text: str) -> None:
    """Nine and twelve complex ones; more than eight were beyond the checker."""
    said = step(text)
    evidence: Any = proved(said)
    check_counted_solutions(replace(said, evidence=Entry(evidence, "evidence")), (), limits())
    assert evidence["proofs"] and is_contradicted(replace(said, after=neg(said.after)))
    refused(replace(said, after=neg(said.after)), evidence)


def test_beyond_the_limits() -> None:
    said = replace(step("ex x. x^16 = a"), before=moved(read_formula("ex x. x^17 = a"), Ring.of(("a", "x"))))
    with pytest.raises(Unable, match="complex solutions"):
        list(sentences(said, lambda: None))


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

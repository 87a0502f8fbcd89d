"""Rule "comprehensive Gröbner system" with parameters: its steps are proved by decompositions, wrong ones are not."""

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
from qe.elimination.protocol import Context
from qe.errors import InternalError
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import conj, neg
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.groebner.counting import SolutionCount
from qe.groebner.signs import SignatureConditions
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
    assert is_proved(step(text))
    broken(monkeypatch)
    assert not is_proved(step(text))


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

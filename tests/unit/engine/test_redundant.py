"""Parts of answers that make no difference: which are dropped, that nothing changes, and that each step is proved."""

import random
from dataclasses import replace
from fractions import Fraction
from itertools import permutations

import pytest

import qe
import qe.engine.redundant as redundant
from qe.api.input import read_formula
from qe.elimination.protocol import Context, Outcome
from qe.engine.redundant import without_part, without_redundant_parts
from qe.formula.build import conj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, Formula
from qe.formula.traverse import conjuncts
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.run_log import RunLog
from tests.certificates.test_steps_by_hand import accepted

LYAPUNOV = (
    "ex p, q, r. p > 0 and p*r - q^2 > 0 and a*p + c*q < 0 and 4*(a*p + c*q)*(b*q + d*r) > (b*p + (a + d)*q + c*r)^2"
)

SHORT = {
    "c = 0 and a + b < 0 or c /= 0 and (a + b + c^2 < 0 or a + b < 0)": "a + b < 0",
    "a = 0 and b*c < 0 or b*c < a^2": "b*c < a^2",
    "a > 0 and b > 0 and 3*a > b": "3*a > b and b > 0",
    "2*(2*a - 1)^3 > 27*b^2 and a > 1/2": "16*a^3 - 24*a^2 - 27*b^2 + 12*a - 2 > 0",
    "a < 1 and b < 1 and a + b < 2": "a < 1 and b < 1",
    "p*q < 0 and q /= 0 or p = 0 and q = 0": "p*q < 0 or p = 0 and q = 0",
    "b < 1 and a - b < 1 and a + b > -1 and a <= 2 and a >= -2": "b < 1 and a - b < 1 and a + b > -1",
    "a < 0 or b < 0 or a + b < 0 or a + b < 1": "a + b < 1 or a < 0 or b < 0",
    "(a > 0 or a = 0 and b > 0) and (c > 0 or d > 0) or (a < 0 or a = 0 and b < 0) and (c > 0 or d > 0)": (
        "(a /= 0 or b /= 0) and (c > 0 or d > 0)"
    ),
    LYAPUNOV: "a + d < 0 and a*d - b*c > 0",
}


def shorter(formula: Formula, log: RunLog | None = None) -> Formula:
    """By this rule alone."""
    return without_redundant_parts(formula, asked(log or RunLog()))


def asked(log: RunLog) -> Context:
    """Sentences are decided by the engine."""

    def decide(sentence: Formula, options: Options, budget: Budget) -> Outcome:
        answer = qe.eliminate(sentence, process=False)
        assert answer.formula is not None
        return Outcome(answer.formula, answer.witness, log=answer.log or RunLog())

    return Context(Options(), Budget(), log, decide)


LONG = "x*y - u*v + w*p - q*r + s*t - a^2*b^2*c^2*d^2 - a*x - b*y + u"
LARGE = f"{LONG} <= 0 and (g >= 0 and h <= 0 or a = 0) or {LONG} <= 0 and (g <= 0 or h <= 0)"


def test_large_answers_with_long_conditions_are_left_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """A variant of Steiner-Lehmus took 6 s, 4 of them for conditions with 300000 terms."""
    monkeypatch.setattr(redundant, "MOST_TERMS_ALONE", 0)
    question = read_formula(LARGE)
    assert shorter(question) == question


def test_signs_alone_leave_parts_out_of_large_answers() -> None:
    """A distance from a ray, whose nine parameters and long polynomials are too many for sentences about them."""
    log = RunLog()
    question = read_formula(LARGE)
    found = shorter(question, log)
    assert str(found).count(" and ") == 1 + str(found).count("a = 0") and len(str(found)) < len(str(question))
    steps = [step for step in log.steps() if step.rule == "redundant part"]
    assert steps and all(map(accepted, steps))
    rng = random.Random(4)
    for _ in range(200):
        point = {name: Fraction(rng.choice((0, 0, 1, -1, 2))) for name in question.free}
        assert holds_at(found, point) is holds_at(question, point)


@pytest.mark.parametrize("text", SHORT)
def test_parts_without_effect_are_dropped(text: str) -> None:
    found = qe.eliminate(text).formula
    assert found is not None
    expected = read_formula(SHORT[text])
    assert len(str(found)) <= len(str(expected))
    assert qe.decide(f"all a, b, c, d, p, q. ({found}) <-> ({expected})")


def test_cases_that_linear_conditions_beside_them_imply_are_dropped() -> None:
    """``abs(x - a) + abs(x - b) + abs(x - c) <= 1``, with the order of a, b, c and the lowest point told apart."""
    beside = "a - c <= 1 and a - c >= -1 and a - b <= 1 and a - b >= -1 and b - c <= 1 and b - c >= -1"
    lowest = "a + b - 2*c <= 1 and a <= c and b <= c"
    cases = " or ".join(f"{v} <= {u} and {u} <= {w} and {w} - {v} <= 1" for v, u, w in permutations("abc"))
    log, question = RunLog(), read_formula(f"{beside} and ({cases} or {lowest})")
    assert {*conjuncts(shorter(question, log))} == {*conjuncts(read_formula(beside))}
    assert all(accepted(step) for step in log.steps() if step.rule == "redundant part")


def test_an_answer_of_virtual_substitution_is_as_short_as_the_theorem() -> None:
    """Lyapunov's condition for a matrix of two rows had 388 characters: cases that need no telling apart."""
    assert len(str(qe.eliminate(LYAPUNOV).formula)) < 30
    assert len(str(qe.eliminate(LYAPUNOV, without="redundant").formula)) > 100


@pytest.mark.parametrize("seed", range(12))
def test_nothing_changes_at_any_point(seed: int) -> None:
    chosen = random.Random(seed)

    def text(depth: int) -> str:
        if not depth:
            sides = chosen.choice(("x", "y", "x + y", "x - 1", "x^2 - y", "x*y")), chosen.choice(("<", ">=", "=", "/="))
            return f"{sides[0]} {sides[1]} {chosen.randint(-1, 1)}"
        return "(" + chosen.choice((" and ", " or ")).join(text(depth - 1) for _ in range(2 + depth % 2)) + ")"

    formula = read_formula(text(3))
    found = shorter(formula)
    for i in range(-6, 7):
        for j in range(-6, 7):
            point = {"x": Fraction(i, 2), "y": Fraction(j, 2)}
            assert holds_at(formula, point) is holds_at(found, point), point


def test_what_is_beside_the_way_is_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """A step whose sentence leaves out a condition of the place is not accepted; as it is, it is."""
    question = read_formula("a < 1 and (b < 1 or a < 2)")
    log = RunLog()
    shorter(question, log)
    steps = [step for step in log.steps() if step.rule == "redundant part"]
    assert steps and all(map(accepted, steps))
    proof = steps[0].evidence["proof"]
    assert isinstance(proof, dict)
    for at in ([], [0], [1], [1, 1], [1, 0, 0], [2], [1, 2], [7]):
        if at != proof["at"]:
            assert not accepted(replace(steps[0], evidence={"proof": {**proof, "at": at}}))
    assert not accepted(replace(steps[0], after=FALSE))

    def careless(sentence: Formula, options: Options, budget: Budget) -> Outcome:
        return Outcome(FALSE)

    log = RunLog()
    without_redundant_parts(
        read_formula("a^2 + b^2 < 1 and (a > 5 or b < 100)"), Context(Options(), Budget(), log, careless)
    )
    (broken,) = [step for step in log.steps() if step.rule == "redundant part"]
    assert not accepted(broken)


def test_what_is_left_keeps_its_connective() -> None:
    """Of three conditions two are left together, not one or the other."""
    for text, wrong in (
        ("a < 1 and b < 1 and a + b < 2 or c > 0", "(a < 1 or b < 1) and c > 0"),
        ("(a < 1 or b < 1 or a + b < 2) and c > 0", "a < 1 and b < 1 or c > 0"),
    ):
        log = RunLog()
        without_redundant_parts(read_formula(text), asked(log))
        (step,) = [step for step in log.steps() if step.rule == "redundant part"]
        ring = step.before.ring
        assert ring is not None and accepted(step)
        assert not accepted(replace(step, after=moved(read_formula(wrong), ring)))


def test_a_region_of_balls_in_space_is_not_looked_at_for_minutes() -> None:
    """The region of a plan, six parameters and conditions of nine terms, took minutes: no unit of work is that long."""

    def decide(sentence: Formula, options: Options, budget: Budget) -> Outcome:
        raise AssertionError("asked about a long sentence in six variables")

    distance = "(x - u)^2 + (y - v)^2 + (z - w)^2"
    region = f"x^2 + y^2 + z^2 <= 9 and u^2 + v^2 + w^2 <= 9 and {distance} <= 9 and 4*({distance}) <= 37"
    formula = read_formula(region)
    context = Context(Options(), Budget(), RunLog(), decide)
    assert without_redundant_parts(formula, context) == conj(conjuncts(formula)[:3])  # 36 <= 37, by signs


def test_the_part_at_a_place() -> None:
    formula = read_formula("a < 1 and (b < 1 or c < 2)")
    assert str(without_part(formula, (1, 0))) == "a < 1 and c < 2"
    assert str(without_part(formula, (0,))) == "b < 1 or c < 2"


def test_large_answers_are_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    formula = read_formula("a^2 + a*b + b^2 < 1 and a < 2 and b < 2")
    monkeypatch.setattr(redundant, "MOST_ATOMS", 2)
    assert shorter(formula) == formula


def test_few_points_are_looked_at_for_parts_that_are_worth_no_question() -> None:
    """Hong 1993: an equation of degree 5 stands beside every part, so that hardly any point tells what matters."""
    text = "u /= 0 and u^5 - u^3*v*w + v^3*w + v^2 = 0 and (u*v - v*w >= 0 and u*v*w + w <= 0 or u - v*w^2 <= 0)"
    points = redundant.Points(("u", "v", "w"), Budget().check)
    assert not list(redundant._unsettled(read_formula(text.replace("u^5", "u^13")), points, set()))
    assert len(points.listed) == redundant.FIRST + 6


def test_the_checkers_accept_an_answer_without_parts_that_matter_nowhere() -> None:
    answer = qe.eliminate("ex x. a*x^2 + b*x + c = 0", check=True)
    assert answer.log is not None
    dropped = [step for step in answer.log.steps() if step.rule == "redundant part"]
    (inner,) = dropped[0].evidence["proof"]["steps"].steps  # type: ignore[index]
    assert (len(dropped), inner.rule) == (1, "standard simplification")
    assert answer.certificate is not None
    assert qe.verify(answer.certificate).accepted
    assert answer.unchecked_steps == ()

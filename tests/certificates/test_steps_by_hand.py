"""Steps made by hand or by a careless producer: accepted where they are right, and only there."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

import qe.engine.untangle as untangle
import qe.rules.rotation as rotation
import qe.rules.symmetry as symmetry
from qe.api.input import read_formula
from qe.elimination.protocol import Context
from qe.exact.ring import Ring
from qe.formula.build import conj
from qe.formula.normal import rename_apart
from qe.formula.syntax import FALSE, TRUE, Exists, Formula
from qe.formula.traverse import clashes, conjuncts
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.proving.nested import names_within
from qe.proving.prover import Prover
from qe.rules import preparation
from qe.rules.step import StepKind
from qe.simplifier.simplify import simplify


def accepted(step: Step) -> bool:
    """Whether evidence is found for a step, decompositions apart."""
    given = step.before.ring or step.after.ring
    if given is None:  # between constants
        return step.before == step.after
    ring = Ring.of(dict.fromkeys((*given.names, *names_within(step))))
    before, after, context = (moved(f, ring) for f in (step.before, step.after, step.context))
    known = tuple(conjuncts(context)) if context != TRUE else ()
    prover = Prover(ring, Options(), Budget(20), tables=False, known=known)
    if clashes(before):  # certificates begin after other names for its bound variables
        return prover.evidence(replace(step, before=before, after=after), known) is not None
    led = prover.taken(replace(step, before=before, after=after, context=context, places=((),)), before)
    return led == after and not prover.unchecked


def steps_of(text: str, kind: StepKind) -> list[Step]:
    """The steps of one rule alone."""
    log = RunLog()
    preparation.prepare(read_formula(text), enabled={kind}, log=log)
    return [step for step in log.steps() if step.rule == kind.value]


def test_a_coefficient_that_conjuncts_with_the_variable_keep_from_zero() -> None:
    """1 + a*x <= 0 implies a /= 0, but what the substitution makes of it does not."""
    before = read_formula("ex x. a*x + b = 0 and 1 + a*x <= 0")
    after = read_formula("a^2*(b - 1) >= 0")
    assert isinstance(before, Exists)
    equation = conjuncts(before.body)[0]
    evidence = {"proof": {"solved": [("x", equation.poly, 0)]}}  # type: ignore[attr-defined]
    ring = before.ring
    assert ring is not None

    assert not accepted(Step("linear equation solved", before, moved(after, ring), TRUE, evidence))


def test_a_name_that_captures() -> None:
    given = read_formula("(ex x. x > a) and (ex x. x < b)")
    right = rename_apart(given)
    assert accepted(Step("renaming", given, right))
    wrong = read_formula("(ex a. a > a + 0*x) and (ex x. x < b)")
    assert not accepted(Step("renaming", given, wrong if wrong.ring else FALSE))


@pytest.mark.parametrize("careless", [False, True])
def test_signs_of_variables_that_move(careless: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """The second turn moves x, whose sign the first one has chosen; it chooses that of u."""
    one = Fraction(1)
    first = rotation.Turn("x", "y", frozenset("xyuv"), (("x", "y", one), ("u", "v", one)))
    second = rotation.Turn("u", "w", frozenset("xzuw"), (("x", "z", one), ("u", "w", one)))
    turns = iter([first, replace(second, moved=frozenset()) if careless else second])
    monkeypatch.setattr(symmetry, "invariant_plane", lambda *_: next(turns, None))
    dot = "ex x, y, z, u, v, w. x^2 + y^2 + z^2 = a and u^2 + v^2 + w^2 = b and x*u + y*v + z*w > c"
    (step,) = steps_of(dot, StepKind.ROTATION)
    assert accepted(step) is not careless


def made_by_hand(kind: StepKind, before: str, after: str, proof: dict[str, object]) -> bool:
    """Whether a step made by hand is accepted."""
    given = read_formula(before)
    assert given.ring is not None
    return accepted(Step(kind.value, given, moved(read_formula(after), given.ring), evidence={"proof": proof}))


def turned(zero: str, half: str, *pairs: str) -> dict[str, object]:
    """The evidence of one turn that joins these pairs of variables with the number 1."""
    return {"turns": [{"zero": zero, "half": half, "plane": [(a, b, Fraction(1)) for a, b in map(tuple, pairs)]}]}


def test_variables_of_different_quantifiers() -> None:
    """All polynomials are constant along the rotations, but the inner variable cannot be chosen with the outer one."""
    lengths = "ex x. all y. x^2 + y^2 > a or x^2 + y^2 < b"
    assert not made_by_hand(StepKind.ROTATION, lengths, "ex x. x >= 0 and (x^2 > a or x^2 < b)", turned("y", "x", "xy"))
    inside, after = "ex u, v, x. (all y. u*x + v*y > a)", "ex u, x. u >= 0 and (all y. u*x > a)"
    assert not made_by_hand(StepKind.ROTATION, inside, after, turned("v", "u", "uv", "xy"))
    together, after = "ex u, v, x, y. u*x + v*y > a", "ex u, x, y. u >= 0 and u*x > a"
    assert made_by_hand(StepKind.ROTATION, together, after, turned("v", "u", "uv", "xy"))


def test_an_equation_that_is_not_constant() -> None:
    """Equations side by side count by the sum of their squares, which one of them alone does not keep constant."""
    for left, right in (("x - y = 0 and x + y = 0", "x = 0"), ("x - y = 0", "x = 0")):
        before, after = f"ex x, y. {left} and x^2 + y^2 > b", f"ex x. x >= 0 and {right} and x^2 > b"
        assert made_by_hand(StepKind.ROTATION, before, after, turned("y", "x", "xy")) is ("and" in left)


def test_one_name_bound_twice_or_free_and_bound() -> None:
    body, turn = "u^2 + v^2 < a and (ex x, y. x^2 + y^2 > b) and (ex {}. {}^2 + {}^2 > b)", turned("v", "u", "uv")
    half = body.replace("u^2 + v^2", "u^2")
    for names, right in (("z", "w"), True), (("y", "z"), False), (("a", "z"), False):
        inner = [", ".join(names), names[0], names[1]]
        before, after = f"ex u, v. {body.format(*inner)}", f"ex u. u >= 0 and {half.format(*inner)}"
        assert made_by_hand(StepKind.ROTATION, before, after, turn) is right, names


def test_a_variable_of_two_conjuncts_takes_no_value() -> None:
    met: dict[str, object] = {"variable": "x"}
    assert made_by_hand(StepKind.TAKES_VALUE, "ex x. x^3 + x = a and b > 0", "b > 0", met)
    assert not made_by_hand(StepKind.TAKES_VALUE, "ex x. x^3 + x = a and b > 0 and x > b", "b > 0", met)
    assert not made_by_hand(StepKind.TAKES_VALUE, "ex x. (x^3 + x = a or x > b) and b > 0", "b > 0", met)


def test_equations_of_which_one_is_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    given = read_formula("a - b = 0 and (a + b /= 0 or c = 0)")
    assert accepted(untangling(given))
    monkeypatch.setattr(untangle, "simplify", lambda formula, **_: conj(simplify(formula).args[:1]))  # type: ignore[attr-defined]
    assert not accepted(untangling(given))


def untangling(given: Formula) -> Step:
    """The step of the rule that takes the equations of an answer apart."""
    log = RunLog()
    untangle.untangled(given, Context(Options(), Budget(20), log))
    (step,) = log.steps()
    assert step.rule == "equations taken apart"
    return step


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("ex x. x > u and (ex u. u > x)", StepKind.TRANSLATION),
        ("ex x, y. x^2 > u*y and (ex u. u^2 > x*y and u > 0)", StepKind.SCALING),
        ("ex x, y. x^2 + y^2 < 2 and x*u - y*v > 1 and (all u, v. x*u > y*v + 1)", StepKind.ROTATION),
    ],
)
def test_a_free_name_that_is_bound_elsewhere_is_not_moved(text: str, kind: StepKind) -> None:
    assert not steps_of(text, kind)

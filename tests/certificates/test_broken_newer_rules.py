"""Side conditions of the rules about gathering, rotations, cases and values, switched off: the steps are refused."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from fractions import Fraction

import pytest

import qe.engine.untangle as untangle
import qe.rules.cancelling as cancelling
import qe.rules.exchange as exchange
import qe.rules.gather as gather
import qe.rules.rotation as rotation
import qe.rules.structural as structural
import qe.rules.symmetry as symmetry
import qe.rules.takes_value as takes_value
from qe.api.input import read_formula
from qe.elimination.protocol import Context
from qe.exact.ring import Poly
from qe.formula.build import conj
from qe.formula.syntax import And, Atom, Formula, Or, Relation
from qe.formula.traverse import conjuncts
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from qe.rules.tree import Any, Node
from tests.certificates.test_broken_producers import Patch, accepted

GATHERED, TURNED, APART, TAKEN, CANCELLED, EXCHANGED = (
    StepKind.GATHERING,
    StepKind.ROTATION,
    StepKind.DISTRIBUTION,
    StepKind.TAKES_VALUE,
    StepKind.CANCELLING,
    StepKind.EXCHANGE,
)


def steps_of(text: str, kind: StepKind) -> list[Step]:
    """The steps of one rule alone."""
    log = RunLog()
    prepare(read_formula(text), enabled={kind}, log=log)
    return [step for step in log.steps() if step.rule == kind.value]


def captured(m: pytest.MonkeyPatch) -> None:
    """Nobody looks whether a name is free beside the block that is opened."""
    m.setattr(gather, "_names", lambda formula: set())


def under_or(m: pytest.MonkeyPatch) -> None:
    """Blocks inside a disjunction are opened as if it were a conjunction."""
    m.setattr(gather, "conjuncts", lambda formula: formula.args if isinstance(formula, And | Or) else (formula,))


def one_rotation(m: pytest.MonkeyPatch) -> None:
    """Every polynomial counts as constant along a rotation."""
    m.setattr(rotation, "rotations", lambda polys, pairs, *_: [{pairs[0]: Fraction(1)}])


def no_plane(m: pytest.MonkeyPatch) -> None:
    """Nobody looks whether the two variables are joined to others."""

    def none(values: Iterable[object], start: object = 0) -> object:
        return start

    m.setattr(rotation, "sum", none, raising=False)


def all_equations(m: pytest.MonkeyPatch) -> None:
    """Inequalities side by side count as the components of a vector."""
    m.setattr(rotation, "_sums", lambda formula: [_norm(a.poly for a in formula.args)])


def _norm(polys: Iterable[Poly]) -> Poly:
    first, *more = polys
    return sum((p * p for p in more), first * first)


def fewer_cases(m: pytest.MonkeyPatch) -> None:
    """The last case is forgotten."""

    def fewer(nodes: tuple[Node, ...]) -> Node:
        return Any(nodes[:-1])

    m.setattr(structural, "Any", fewer)


def no_rest(m: pytest.MonkeyPatch) -> None:
    """What stands beside the disjunction is forgotten."""
    m.setattr(structural, "conj", lambda parts: conj(list(parts)[-1:]))


def always_met(m: pytest.MonkeyPatch) -> None:
    """Neither degrees nor leading coefficients are looked at."""
    m.setattr(takes_value, "_is_met", lambda found, name, others, context: True)


def any_sign(m: pytest.MonkeyPatch) -> None:
    """A leading coefficient has the sign that is wanted as soon as it has one."""
    m.setattr(takes_value, "_WANTED", {relation: sign for relation in Relation for sign in (1,)})


def only_equations(m: pytest.MonkeyPatch) -> None:
    """Only equations count as conditions on the variable."""

    def looked_at(variables: tuple[str, ...], body: Formula) -> Iterator[tuple[object, ...]]:
        parts = conjuncts(body)
        for k, part in enumerate(parts):
            if isinstance(part, Atom) and part.relation is Relation.EQ:
                yield next(v for v in variables if v in part.free), part, parts[:k], parts[k + 1 :]

    m.setattr(takes_value, "looked_at_once", looked_at)


def wrong_side(m: pytest.MonkeyPatch) -> None:
    """The sign of what remains is not looked at."""
    real = cancelling.difference

    def flipped(poly: Poly, equation: Poly) -> tuple[int, int, Poly] | None:
        known = real(poly, equation)
        return None if known is None else (known[0], known[1], -known[2])

    m.setattr(cancelling, "difference", flipped)


def equation_lost(m: pytest.MonkeyPatch) -> None:
    """The equation that was subtracted does not stay."""
    m.setattr(cancelling, "conj", lambda parts: conj(parts[1:]))


def sum_alone(m: pytest.MonkeyPatch) -> None:
    """Of two conditions that change places only the sum is kept."""
    real = exchange._both
    m.setattr(exchange, "_both", lambda p, q, relation, i, j: real(p, q, relation, i, j)[:1])


def any_numbers(m: pytest.MonkeyPatch) -> None:
    """Any two numbers count as the sum and the product of real ones."""
    m.setattr(exchange, "conj", lambda parts: next(iter(parts)))


def always_symmetric(m: pytest.MonkeyPatch) -> None:
    """Nobody looks whether conditions change."""
    m.setattr(exchange, "_symmetry", lambda poly, i, j, sign=1: True)


CASES: dict[str, tuple[Patch, str, StepKind]] = {
    "wrong side": (wrong_side, "ex x, y. x^3 + a*x + b = 0 and y^3 + a*y + b > 0", CANCELLED),
    "equation lost": (equation_lost, "ex x, y. x^3 + a*x + b = 0 and y^3 + a*y + b = 0", CANCELLED),
    "sum alone": (sum_alone, "ex x, y. x^3 + y^3 = a and x > b and y > b", EXCHANGED),
    "any numbers": (any_numbers, "ex x, y. x^3 + y^3 = a and x*y > 1", EXCHANGED),
    "not symmetric": (always_symmetric, "ex x, y. x^3 + y^3 = a and x > 1", EXCHANGED),
    "captured": (captured, "ex x. x > y and ex y. x*y > 1", GATHERED),
    "captured, dual": (captured, "all x. x > y or (all y. x*y > 1)", GATHERED),
    "disjunction": (under_or, "ex x. x > a or ex y. x*y > 1", GATHERED),
    "not constant": (one_rotation, "ex x, y. x^2 + 2*y^2 + x + y < a", TURNED),
    "not constant, dual": (one_rotation, "all x, y. x^2 + 2*y^2 > a or x*y > b", TURNED),
    "axis": (no_plane, "ex x, y, z. x^2 + y^2 + z^2 < a and x + y + z > b", TURNED),
    "inequalities": (all_equations, "ex x, y. x^2 + 2*x*y - y^2 > 0 and x^2 - 2*x*y - y^2 > 0", TURNED),
    "cases": (fewer_cases, "ex x. x > a and (x = b or x = c)", APART),
    "rest": (no_rest, "ex x. x > a and (x = b or x = c)", APART),
    "even": (always_met, "ex x. x^2 = a and b > 0", TAKEN),
    "vanishing": (always_met, "ex x. a*x^3 + x^2 + 1 = 0 and b > 0", TAKEN),
    "sign": (always_met, "ex x. b*x^2 + x > a", TAKEN),
    "other sign": (any_sign, "ex x. x^2 + x < a", TAKEN),
    "constant": (always_met, "ex x. a*x^2 + a*x + b /= 0", TAKEN),
    "twice": (only_equations, "ex x. x^3 + x = a and x > b", TAKEN),
}


@pytest.mark.parametrize("name", CASES)
def test_the_step_is_not_accepted(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    patch, text, kind = CASES[name]
    assert all(map(accepted, steps_of(text, kind)))
    patch(monkeypatch)
    broken = steps_of(text, kind)
    assert broken
    assert not any(map(accepted, broken))


@pytest.mark.parametrize("careless", [False, True])
def test_signs_of_variables_that_move(careless: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """The second turn moves x, whose sign the first one has chosen; it chooses that of u."""
    one = Fraction(1)
    first = rotation.Turn("x", "y", frozenset("xyuv"), (("x", "y", one), ("u", "v", one)))
    second = rotation.Turn("u", "w", frozenset("xzuw"), (("x", "z", one), ("u", "w", one)))
    turns = iter([first, replace(second, moved=frozenset()) if careless else second])
    monkeypatch.setattr(symmetry, "invariant_plane", lambda *_: next(turns, None))
    dot = "ex x, y, z, u, v, w. x^2 + y^2 + z^2 = a and u^2 + v^2 + w^2 = b and x*u + y*v + z*w > c"
    (step,) = steps_of(dot, TURNED)
    assert accepted(step) is not careless


def claimed(kind: StepKind, before: str, after: str, proof: dict[str, object]) -> bool:
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
    assert not claimed(TURNED, lengths, "ex x. x >= 0 and (x^2 > a or x^2 < b)", turned("y", "x", "xy"))
    inside, after = "ex u, v, x. (all y. u*x + v*y > a)", "ex u, x. u >= 0 and (all y. u*x > a)"
    assert not claimed(TURNED, inside, after, turned("v", "u", "uv", "xy"))
    together, after = "ex u, v, x, y. u*x + v*y > a", "ex u, x, y. u >= 0 and u*x > a"
    assert claimed(TURNED, together, after, turned("v", "u", "uv", "xy"))


def test_an_equation_that_is_not_constant() -> None:
    """Equations side by side count by the sum of their squares, which one of them alone does not keep constant."""
    for left, right in (("x - y = 0 and x + y = 0", "x = 0"), ("x - y = 0", "x = 0")):
        before, after = f"ex x, y. {left} and x^2 + y^2 > b", f"ex x. x >= 0 and {right} and x^2 > b"
        assert claimed(TURNED, before, after, turned("y", "x", "xy")) is ("and" in left)


def test_one_name_bound_twice_or_free_and_bound() -> None:
    body, turn = "u^2 + v^2 < a and (ex x, y. x^2 + y^2 > b) and (ex {}. {}^2 + {}^2 > b)", turned("v", "u", "uv")
    half = body.replace("u^2 + v^2", "u^2")
    for names, right in (("z", "w"), True), (("y", "z"), False), (("a", "z"), False):
        inner = [", ".join(names), names[0], names[1]]
        before, after = f"ex u, v. {body.format(*inner)}", f"ex u. u >= 0 and {half.format(*inner)}"
        assert claimed(TURNED, before, after, turn) is right, names


def test_a_variable_of_two_conjuncts_takes_no_value() -> None:
    met: dict[str, object] = {"variable": "x"}
    assert claimed(TAKEN, "ex x. x^3 + x = a and b > 0", "b > 0", met)
    assert not claimed(TAKEN, "ex x. x^3 + x = a and b > 0 and x > b", "b > 0", met)
    assert not claimed(TAKEN, "ex x. (x^3 + x = a or x > b) and b > 0", "b > 0", met)


def test_equations_of_which_one_is_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    given = read_formula("a - b = 0 and (a + b /= 0 or c = 0)")
    assert accepted(untangling(given))
    from qe.simplify.simplify import simplify

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
        ("ex x, y. x^2 + y^2 < 2 and x*u - y*v > 1 and (all u, v. x*u > y*v + 1)", TURNED),
    ],
)
def test_a_free_name_that_is_bound_elsewhere_is_not_moved(text: str, kind: StepKind) -> None:
    assert not steps_of(text, kind)

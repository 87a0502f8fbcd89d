"""Blocks gathered, equations that reach inside, disjuncts with equations apart: what changes and what must not."""

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.ring import Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import Exists, ForAll, Formula, Relation
from qe.formula.traverse import atoms, subformulas
from qe.io.text import read
from qe.rules.equations import reduce_by_equations
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.tables import each

GATHER = frozenset({StepKind.GATHERING})


def blocks(formula: Formula) -> list[tuple[str, ...]]:
    return [f.variables for f in subformulas(formula) if isinstance(f, Exists | ForAll)]


@each(
    ("ex x. x > a and ex y. x*y = 1 and ex z. z^2 = y", [("x", "y", "z")]),
    ("all x. x > a or (all y. x*y > 1)", [("x", "y")]),
    ("ex x. x > a and (all y. x*y > 1)", [("x",), ("y",)]),
    ("ex x. x > a or ex y. x*y > 1", [("x",), ("y",)]),
    ("ex x. (all y. x*y > 1) and ex z. x*z^3 > a", [("x",), ("y",), ("z",)]),  # inner blocks go first
    ("ex x. (all y. x*y > 1) and ex z. x*z^3 = a", [("x", "z"), ("y",)]),  # but for an equation to solve
    ("all x. (ex y. x*y > 1) or (all z. x*z^3 = a)", [("x",), ("y",), ("z",)]),
    ("all x. (ex y. x*y > 1) or (all z. x*z^3 /= a)", [("x", "z"), ("y",)]),
    ("ex x. x^3 = 1 and (all y. x*y > 1) and ex z. z > a", [("x", "z"), ("y",)]),
    ("ex x. a^3 = 1 and (all y. x*y > 1) and ex z. z > a", [("x",), ("y",), ("z",)]),
)
def test_blocks_of_one_kind_are_one_block(text: str, left: list[tuple[str, ...]]) -> None:
    assert blocks(prepare(read(text), enabled=GATHER).formula) == left


def test_a_name_that_would_be_captured_stays_inside() -> None:
    ring = Ring.of(("x", "y"))
    outside, inner = atom(ring.var("y") - ring.var("x"), Relation.GT), atom(ring.var("y") ** 3 - 1, Relation.GT)
    clash = Exists(("x",), conj((outside, Exists(("y",), inner))))
    assert blocks(prepare(clash, enabled=GATHER).formula) == [("x",), ("y",)]


def test_equations_outside_reduce_what_is_inside() -> None:
    text = "ex x. x^2 = 3 and x > 0 and all y. x^6 + x^4*y^2 + y > a"
    left = prepare(read(text), enabled={StepKind.GROEBNER}).formula
    assert max(a.poly.total_degree for a in atoms(left)) <= 2
    dual = prepare(
        read("all x. x^2 /= 3 or x <= 0 or ex y. x^6 + x^4*y^2 + y <= a"), enabled={StepKind.GROEBNER}
    ).formula
    assert max(a.poly.total_degree for a in atoms(dual)) <= 2


def test_equations_do_not_reach_a_variable_of_the_same_name() -> None:
    equation = read("x^2 - 3 = 0")
    inner = read("ex x. x^4 > 10")
    assert reduce_by_equations((equation,), (equation, inner)) == (equation, inner)


def test_disjuncts_with_equations_are_solved_apart() -> None:
    text = "ex x. x >= 0 and x <= 1 and (a*x = b and x^3 > c or x = c and x^3 - b*x < a)"
    left = prepare(read(text), enabled={StepKind.DISTRIBUTION, StepKind.LINEAR, StepKind.GUARDED_LINEAR}).formula
    assert all("x" not in names or len(names) == 1 for names in blocks(left))
    assert (qe.eliminate(text).formula).is_quantifier_free  # type: ignore[arg-type]
    only = "ex x. x >= 0 and (a*x = b and x^3 > c or x^3 - b*x < a)"
    assert prepare(read(only), enabled={StepKind.DISTRIBUTION}).formula == prepare(read(only), enabled=()).formula


@st.composite
def nested(draw: st.DrawFn) -> str:
    """Two nested blocks with equations outside, inside, and in disjunctions; one parameter value is put in."""
    linear = ["x + y - 1", "2*x - y", "x*y - 1", "x - 1", "x^2 - 2", "y - x^2", "x*y - k", "y^2 - k"]

    def some() -> str:
        return f"{draw(st.sampled_from(linear))} {draw(st.sampled_from(['=', '=', '<', '>=', '/=']))} 0"

    outer, inner = draw(st.sampled_from([("ex", "ex"), ("all", "all"), ("ex", "all"), ("all", "ex")]))
    joints = [draw(st.sampled_from(["and", "or"])) for _ in range(4)]
    first = f"{draw(st.sampled_from(['x^2 - 2', 'x - 1', 'x^2 - k']))} {draw(st.sampled_from(['=', '/=', '>']))} 0"
    return (
        f"{outer} x. {first} {joints[0]} ({inner} y. ({some()} {joints[1]} {some()}) {joints[2]}"
        f" ({some()} {joints[3]} {some()}))"
    )


RULES_OFF = ("equations", "symmetry")


@settings(max_examples=15, deadline=None)
@given(nested(), st.sampled_from(["0", "1", "-1", "2", "1/2"]))
def test_decisions_are_those_of_decomposition(text: str, value: str) -> None:
    text = text.replace("k", f"({value})")
    found = qe.eliminate(text, timeout=3).formula
    plain = qe.eliminate(text, timeout=3, method="cad", without=RULES_OFF).formula
    assert None in (found, plain) or found == plain, text

"""Preparation of whole formulas: the paper's formulas, geometry, switches, lifts."""

from collections.abc import Collection
from fractions import Fraction

import pytest

from qe.errors import BudgetExceeded, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, Formula, Relation
from qe.formula.traverse import atoms
from qe.io.text import read
from qe.options import Budget
from qe.rules.lift import holds_at
from qe.rules.preparation import prepare
from qe.rules.step import ALL_STEPS, StepKind
from qe.simplifier.simplify import simplify
from tests.property.prepare_support import prepared_with_rules
from tests.tables import each

BALL = "{0}1^2 + {0}2^2 + {0}3^2 - r^2 <= 0"


def formula_8(symbolic: bool) -> str:
    given = {"q": ["-1", "3", "3"], "s": ["1", "3", "3"]}
    points = {"q": ["q1", "q2", "q3"], "s": ["s1", "s2", "s3"]} if symbolic else given
    equations = [f"p{i} = 2*{points['q'][i - 1]} - x{i} and t{i} = 2*{points['s'][i - 1]} - x{i}" for i in (1, 2, 3)]
    balls = " and ".join(BALL.format(v) for v in "ptx")
    text = f"ex p1, p2, p3, t1, t2, t3. ({' and '.join(equations)} and {balls})"
    return text if symbolic else text.replace("r^2", "27")


@each(False, True)
def test_formula_8_becomes_three_balls(symbolic: bool) -> None:
    result = prepare(read(formula_8(symbolic))).formula
    assert result.is_quantifier_free
    assert len(list(atoms(result))) == 3
    assert all(a.relation in (Relation.LE, Relation.GE) and a.poly.total_degree == 2 for a in atoms(result))


def rules(formula: Formula, enabled: Collection[StepKind]) -> list[StepKind]:
    return prepared_with_rules(formula, enabled=enabled)[1]


def test_formula_8_lifts_to_the_control_points() -> None:
    formula = read(formula_8(False))
    prepared = prepare(formula)
    lifted = prepared.lift({"x1": Fraction(0), "x2": Fraction(4), "x3": Fraction(3)})
    assert (lifted["p1"], lifted["p2"], lifted["p3"], lifted["t1"]) == (-2, 2, 3, 2)
    assert holds_at(formula.body, lifted)  # type: ignore[attr-defined]


def test_formula_7_keeps_six_balls_in_six_variables() -> None:
    q, s = ("-1", "3", "3"), ("1", "3", "3")
    equations = [
        f"a{i} = 4*{q[i - 1]} - 4*x{i} + y{i} and b{i} = 2*{q[i - 1]} - x{i}"
        f" and c{i} = 2*{s[i - 1]} - y{i} and d{i} = x{i} - 4*y{i} + 4*{s[i - 1]}"
        for i in (1, 2, 3)
    ]
    block = ", ".join(f"{v}{i}" for v in "abcd" for i in (1, 2, 3))
    balls = " and ".join(BALL.format(v).replace("r^2", "27") for v in "abcdxy")
    result = prepare(read(f"ex {block}. ({' and '.join(equations)} and {balls})")).formula
    assert result.is_quantifier_free
    assert len(result.free) == 6
    assert len(list(atoms(result))) == 6


@each(
    ("ex x. x*y = 1", "y /= 0"),
    ("ex x. (x*y = 1 and x > 0)", "y > 0"),
    ("all x. (x*y /= 1 or x <= 0)", "y <= 0"),
    ("ex x. (a*x + b = 0)", "a /= 0 or b = 0"),
    ("ex x, y. (x + y = 1 and x - y = a and x*y > 0)", "a^2 < 1"),
    ("ex x, y. (x^2 + y^2 = 0 and a*x + b > y)", "b > 0"),
    ("ex x, y. (x*y = 0 and x = 1 and a > y)", "a > 0"),
    ("ex y. (x^2 + y = 0 and x > 0 and (y > 5 or y < -4))", "x > 2"),
    ("y > 0 and ex x. (x*y = 1 and x < 2)", "2*y > 1"),
    ("ex x. (a*x^3 + b*x + c /= 0)", "a /= 0 or b /= 0 or c /= 0"),
    ("ex x, y. (a*x*y + b*y^2 /= 0 and x - y /= b)", "a /= 0 or b /= 0"),
    ("ex x, y, z. (x + y + z = 0 and x*y + y*z + z*x = 0 and x*y*z = 1)", "false"),
)
def test_equations_disappear(text: str, expected: str) -> None:
    result = prepare(read(text)).formula
    assert result.is_quantifier_free
    if not result.free:
        assert str(result) == expected
        return
    ring = next(atoms(result)).poly.ring
    wanted = simplify(read(expected))
    for k in range(-40, 41):
        at = {name: Fraction(k * (3 + i) % 17 - 8, 4) for i, name in enumerate(ring.names)}
        assert holds_at(result, at) == holds_at(wanted, at)


def test_witness_through_a_degree_shift_is_a_root() -> None:
    formula = read("ex x. (x^4 - 2*x^2 - 1 = 0 and x^2 > 1)")
    prepared = prepare(formula, enabled={StepKind.DEGREE_SHIFT})
    golden = RealAlgebraic.from_root([-1, -2, 1], 2, 3)  # 1 + sqrt(2)
    lifted = prepared.lift({"x": golden})
    assert lifted["x"] ** 2 == golden
    assert holds_at(formula.body, lifted)  # type: ignore[attr-defined]


def test_sign_atoms_survive_a_degree_shift() -> None:
    prepared = prepare(read("ex x. (x >= 0 and x^4 - a*x^2 + 1 < 0)"), enabled={StepKind.DEGREE_SHIFT})
    assert max(p.poly.total_degree for p in atoms(prepared.formula)) == 2
    odd = prepare(read("ex x. (x > 0 and x^4 - a*x^2 + 1 < 0 and x^2*b < 1)"), enabled={StepKind.DEGREE_SHIFT})
    assert max(p.poly.total_degree for p in atoms(odd.formula)) == 2
    unsigned = read("ex x. ((x > 0 or a > 0) and x^4 - a*x^2 + 1 < 0)")
    assert not rules(unsigned, {StepKind.DEGREE_SHIFT})


def test_scaling_uses_known_signs() -> None:
    prepared = prepare(read("ex x, y, z. (x > 0 and x^2 + y^2 < z^2 and x*y > z^2)"), enabled={StepKind.SCALING})
    assert prepared.formula.free == ()
    assert str(prepared.formula).startswith("ex y, z.")


def test_independent_parts_separate() -> None:
    result = prepare(read("ex x, y. (x^2 < a and y^3 + y > b and c > 0)"), enabled={StepKind.MINISCOPE}).formula
    assert isinstance(result, And) and len(result.args) == 3
    assert sorted(f.variables for f in result.args if isinstance(f, Exists)) == [("x",), ("y",)]


def test_no_capture_by_inner_quantifiers() -> None:
    """x = y must not be put under a quantifier that binds y."""
    text = "ex x. (x = y and all y. (y^2 + 1 > x))"
    result = prepare(read(text), enabled={StepKind.LINEAR}).formula
    assert result == read(text)


def test_switches() -> None:
    formula = read("ex x. (2*x = a and x > b)")
    assert prepare(formula, enabled=()).formula == formula
    assert rules(formula, ()) == []
    solved = prepare(formula, enabled={StepKind.LINEAR})
    assert rules(formula, {StepKind.LINEAR}) == [StepKind.LINEAR]
    assert str(solved.formula) == str(simplify(read("a > 2*b")))


def test_budget_is_obeyed() -> None:
    budget = Budget(60.0)
    budget.cancel()
    with pytest.raises(BudgetExceeded):
        prepare(read("ex x. (2*x = a and x > b)"), budget=budget)


def test_lift_of_nothing_is_refused() -> None:
    prepared = prepare(
        read("ex x, y. (x*y = 1 and x^2*y^3 + y > 2 and x + y < 9 or x + y = 3 and x^5*y > 2 and x*y^3 > 1)")
    )
    with pytest.raises(Unable):
        prepared.lift({"x": Fraction(0), "y": Fraction(0)})


def test_closed_formulas_without_quantifier() -> None:
    assert prepare(TRUE).formula == TRUE
    assert prepare(FALSE).formula == FALSE
    assert prepare(read("x^2 < 0")).formula == FALSE


def test_inequations_stay_beside_closed_conditions() -> None:
    """x^2 <= 0 and x /= 0 is false: the rule needs an open body; the boundary is a case of its own."""
    assert prepare(read("ex x. (x^2 <= 0 and x /= 0)"), enabled={StepKind.GENERIC}).formula != TRUE
    assert rules(read("ex x. (a*x^3 <= 0 and x /= 0)"), {StepKind.GENERIC}) == []
    assert rules(read("ex x. (x^3 = a and x /= 0)"), {StepKind.GENERIC}) == []


def test_weak_bounds_are_split_to_get_rid_of_inequations() -> None:
    prepared, taken, _ = prepared_with_rules(read("ex x. (x >= a and b*x + c /= 0 and 1 - x >= a)"))
    assert StepKind.GENERIC in taken
    left = [a for a in atoms(prepared.formula) if isinstance(a, Atom) and a.relation is Relation.NE]
    assert left and all("x" not in {a.poly.ring.names[i] for i in a.poly.variables} for a in left)


def test_differences_lose_a_variable() -> None:
    question = read("ex x, y, z. ((x - y)^2 + (y - z)^2 < a and x - z > b)")
    prepared, taken, _ = prepared_with_rules(question, enabled={StepKind.TRANSLATION})
    assert taken == [StepKind.TRANSLATION]
    assert isinstance(prepared.formula, Exists) and len(prepared.formula.variables) == 2
    assert rules(read("ex x, y. (x - y > b and x*y > 1)"), {StepKind.TRANSLATION}) == []


def test_comparisons_for_zero_alone_do_not_hinder_a_degree_shift() -> None:
    """x = 0 iff x^2 = 0, so only the signs of x stand in the way of its squares."""
    both = prepare(
        read("ex x. (x /= 0 and x^4 - a*x^2 + 1 < 0 and b*x^2 > 1)"), enabled={StepKind.DEGREE_SHIFT}
    ).formula
    assert max(a.poly.degree(a.poly.ring.index["x"]) for a in atoms(both) if "x" in a.poly.ring.index) == 2
    assert not rules(read("ex x. (x <= 1 and x^4 - a*x^2 + 1 < 0)"), {StepKind.DEGREE_SHIFT})
    assert not rules(read("ex x. (x < 0 and x^4 - a*x^2 + 1 < 0)"), {StepKind.DEGREE_SHIFT})


def test_differences_of_equations_give_linear_ones() -> None:
    """A triangle by its sides: the coordinate that the difference of two circles gives is solved for, and the equation
    with the parameter keeps its degree, though the whole Groebner basis is large."""
    text = (
        "ex u, v, b, c. (v /= 0 and b > 0 and c > 0 and u^2 - 2*u + 1 + v^2 = b^2 and u^2 + v^2 = c^2"
        " and m*(b^3 + c^3 + 3*b*c + 1) = b^3 + b^2*c + b^2 + b*c^2 + b + c^3 + c^2 + c + 1)"
    )
    left = prepare(read(text), enabled=ALL_STEPS - {StepKind.EXCHANGE}).formula
    assert isinstance(left, Exists) and set(left.variables) == {"b", "c"}
    assert max(a.poly.degree(a.poly.ring.index["m"]) for a in atoms(left)) == 1

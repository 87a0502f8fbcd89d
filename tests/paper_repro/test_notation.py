"""Formulas as text for the engine, and LaTeX as MathML."""

from __future__ import annotations

from fractions import Fraction
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

import qe
from bezier.curves.curve import Bezier
from bezier.methods.control.system import Shape
from bezier.methods.cubic import formula as cubic
from bezier.methods.quadratic import formula as quadratic
from paper_repro import ask, tex
from paper_repro.written import EIGHT, SEVEN, Points, Printed, curve
from tests.tables import each

NUMBERS = st.fractions(min_value=-5, max_value=5, max_denominator=12)
HERE: Points = {"q0": (0, Fraction(1, 10)), "r0": (Fraction(1, 10), Fraction(1, 10))}


@given(points=st.lists(NUMBERS, min_size=2, max_size=6), t=NUMBERS)
def test_a_curve_as_text_is_definition_1(points: list[Fraction], t: Fraction) -> None:
    value = Bezier.of([[p] for p in points]).point(t)[0]
    assert qe.decide(f"{curve(points, f'({t})')} = {value}")


@pytest.mark.parametrize("printed", [SEVEN, EIGHT], ids=["seven", "eight"])
@each(False, True)
def test_substitution_is_what_elimination_gives(above: bool, printed: Printed) -> None:
    answer = qe.eliminate(printed.text("xy", HERE, 4, above=above))
    assert qe.equivalent(answer.formula, printed.substituted("xy", HERE, 4, above=above), timeout=120)
    without = printed.substituted("xy", HERE, 4, above=not above)
    assert not qe.equivalent(answer.formula, without, timeout=120)


@pytest.mark.parametrize(
    ("printed", "shape"), [(SEVEN, cubic.shape()), (EIGHT, quadratic.SHAPE)], ids=["seven", "eight"]
)
def test_the_planner_solves_the_same_formulas(printed: Printed, shape: Shape) -> None:
    letters = {point: [f"{point}{axis}" for axis in "xyz"] for point in ("q0", "r0")}
    text = printed.text("xyz", letters, "r^2")
    assert qe.equivalent(qe.eliminate(f"r >= 0 and ({text})").formula, qe.eliminate(shape.symbolic().formula).formula)


def test_an_answer_without_the_certificate_demanded_does_not_hold(monkeypatch: pytest.MonkeyPatch) -> None:
    without = qe.eliminate("all x. x^2 + 1 > 0")
    assert without.certificate is None
    monkeypatch.setattr(qe, "eliminate", lambda *args, **options: without)
    assert ask.decided("", "all x. x^2 + 1 > 0").holds
    assert not ask.decided("", "all x. x^2 + 1 > 0", proved=True).holds


@given(points=st.lists(st.tuples(st.integers(-1, 1), st.integers(-1, 1)), min_size=4, max_size=4))
def test_different_points_by_definition_1(points: list[tuple[int, int]]) -> None:
    given = dict(zip(("q0", "q1", "q2", "r0"), points))
    solved = {"p1": [4 * a - 4 * b + c for a, b, c in zip(*points[:3])], "p2": [2 * a - b for a, b in zip(*points[:2])]}
    rows = (("p1", "p2", "q0"), ("q0", "q1", "q2", "r0"))
    places = [[tuple((given | solved)[name]) for name in row] for row in rows]
    expected = all(len(set(row)) == len(row) for row in places)
    assert qe.decide(SEVEN.different(rows, "xy", given)) is expected


def test_objective_of_the_paper() -> None:
    assert EIGHT.objective("x", {"q0": (1,), "r0": (3,)}) == "(q1x - 1)^2 + (3 - q1x)^2"
    assert SEVEN.objective("x", {}) == "(q1x - q0x)^2 + (q2x - q1x)^2 + (r0x - q2x)^2"


@each(
    (r"P_1 = 2Q_0 - Q_1", "P1=2Q0−Q1"),
    (r"\hat Q_1 \in [0, 1]", "Q^1∈[0,1]"),
    (r"\frac{-1}{2} \le \sqrt{2}", "−12≤2"),
    (r"\text{true: x = 1/2}", "true: x = 1/2"),
    (r"\max\{\|P_0\|, \|R_2\|\}", "max{‖P0‖,‖R2‖}"),
    (r"P''(1) = Q''(0)", "P′′(1)=Q′′(0)"),
    (r"\begin{array}{rl} & x \leq 0 \\ \land\; & y > 0 \end{array}", "x≤0∧y>0"),
)
def test_tex(source: str, text: str) -> None:
    root = ElementTree.fromstring(tex.math(source))
    assert "".join(root.itertext()) == text


def test_structure_of_tex() -> None:
    assert "<mfrac><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow></mfrac>" in tex.math(r"\frac{1}{2}")
    assert "<msubsup>" in tex.math("x_1^2")
    assert "<munderover>" in tex.math(r"\sum_{i=0}^n i")
    assert 'form="prefix">−' in tex.math("(-1, 2)")
    assert 'form="prefix">−' not in tex.math("1 - 2")


@each(r"\unknown", "{x", r"\frac{1}", r"\begin{array}{rl} x")
def test_tex_outside_the_subset_is_refused(source: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        tex.math(source)


def test_running_text_is_escaped() -> None:
    assert tex.inline("a < b & `x<y` $x$").startswith("a &lt; b &amp; <code>x&lt;y</code> <math")


@each((Fraction(-3, 4), r"-\frac{3}{4}"), ("(4 - 3*sqrt(2))/4", r"\frac{4 - 3\,\sqrt{2}}{4}"), (2, "2"))
def test_numbers(value: object, shown: str) -> None:
    assert ask.number(value) == shown


def test_questions_that_are_answered_otherwise_do_not_hold() -> None:
    assert ask.decided("", "ex x. x^2 = 2").holds
    assert not ask.decided("", "ex x. x^2 = -1").holds
    assert ask.decided("", "ex x. x^2 = -1", expected=False).holds
    proved = ask.decided("", "all x. x^2 + 1 > 0", proved=True)
    assert proved.holds and proved.certificate is not None
    assert not ask.decided("", "all x. x^2 > 0", proved=True).holds
    assert ask.eliminated("", "ex x. x^2 + b*x + c = 0", "b^2 >= 4*c").holds
    assert ask.eliminated("", "ex x. x^2 + b*x + c = 0", "b^2 >= 4*c", "cgs").holds
    assert not ask.eliminated("", "ex x. x^2 + b*x + c = 0", "b^2 > 4*c").holds
    assert ask.optimised("", "x^2", "x >= 3/2", "9/4")[0].holds
    assert not ask.optimised("", "x^2", "x >= 3/2", "2")[0].holds

"""LaTeX in: what is printed in mathematics, and what is said about mistakes."""

from __future__ import annotations

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import qe
from qe.formula.traverse import polynomials
from qe.io import formats, latex
from qe.io.text import read
from qe.spelling import quoted
from tests.tables import each


@each(
    (r"\forall x\colon x^{2} \geq \frac{1}{2} \lor \sqrt{x} < 2 a b", "all x. x^2 >= 1/2 or sqrt(x) < 2*a*b"),
    (r"\exists x \in \mathbb{R}: a x^2 + b x + c = 0", "ex x. a*x^2 + b*x + c = 0"),
    (r"\exists x\; x^2 = 1", "ex x. x^2 = 1"),
    (r"\exists x \, \forall y \; x y \le 1 \wedge y > 0", "ex x. all y. x*y <= 1 and y > 0"),
    (r"b^2-4ac \ge 0", "b^2 - 4*a*c >= 0"),
    (r"\left| x - 1 \right| < \frac{x+1}{2y}", "|x - 1| < (x + 1)/(2*y)"),
    (r"\sqrt[3]{x} \neq y_{12} + x_1'", "cbrt(x) /= y12 + x1'"),
    (r"\sqrt[4]{x} < \sqrt[5]{y}", "x^(1/4) < sign(y)*abs(y)^(1/5)"),
    (r"\forall x \in \mathbb{R}, x^2 \ge a", "all x. x^2 >= a"),
    (r"\forall x, y, x_1 \in [0,1] : x + y > x_1", "all x, y, x1 in [0,1]. x + y > x1"),
    (r"\begin{cases} x > 0 \\ y \not= 1 \end{cases}", "x > 0 and y /= 1"),
    (r"\max\{x, y\} < 1 \land x \in \{1, 2\}", "max(x, y) < 1 and x in {1, 2}"),
    (r"\operatorname{sign}(x) = \mathrm{abs}(y) \lor \alpha^2 < \beta", "sign(x) = abs(y) or alpha^2 < beta"),
    (r"x\not\in\{1,2\} \land \nexists y : y^2 = x", "x not in {1, 2} and not ex y. y^2 = x"),
    (r"x \in [0,3] \cap [1,5] \setminus \{2\}", "x in [0,3] and x in [1,5] and x /= 2"),
    ("$x^2 > 1$", "x^2 > 1"),
    (r"x \in [0, \infty) \implies \lvert x \rvert = x", "x >= 0 -> |x| = x"),
    (r"\mathrm{speed} \leq 3 \text{ and } \alpha > 0", "speed <= 3 and alpha > 0"),
    (r"$x_{ij}^2 + (y)(z) \leq 1$", "x_ij^2 + y*z <= 1"),
    (r"\frac12 x \cdot 3 \le 1 \iff \top", "3/2*x <= 1 <-> true"),
    (r"2\sqrt{x}\max(x, y) \lt 1 \% no", "2*sqrt(x)*max(x, y) < 1"),
    (r"x > 0 /\ y > 0", "x > 0 and y > 0"),
    (r"a=0/\b=0", "a = 0 and b = 0"),
)
def test_meaning(source: str, text: str) -> None:
    source = source.replace(r"\% no", "")
    assert str(read(source)) == str(read(text))


@each(
    (r"\sin(x) < 1", "sin is not algebraic"),
    (r"\sin x < 1", "sin is not algebraic"),
    (r"1 \over x > 0", "over cannot be read"),
    (r"x \equiv 1", "equiv cannot be read"),
    (r"2\pi x > 1", "pi is no number"),
    (r"\begin{cases} x & x > 0 \\ y \end{cases}", "if c then a else b"),
    (r"\operatorname{area}(x) > 0", "unknown function area"),
    (r"\frac12 ½ x < 1", "cannot be read in LaTeX"),
    (r"2^{x} \le 1", "rational number"),
    (r"\frac{x}{2 \le 1", "never closed"),
    (r"x \le \mathrm{a b}", "cannot be read in LaTeX"),
    (r"x \le ", "too early"),
    (r"\frac{x}", "too early|expected|unbalanced"),
    (r"x @ \land y", "cannot be read in LaTeX"),
)
def test_mistakes_are_told_in_one_line(source: str, part: str) -> None:
    with pytest.raises(qe.ParseError, match=part) as caught:
        read(source)
    assert "\n" not in str(caught.value)


def test_letters_are_single_in_the_format_and_words_in_text() -> None:
    assert str(formats.read("ab < 1", "latex")) == "a*b - 1 < 0"
    assert str(formats.read("ab < 1")) == "ab - 1 < 0"


@each(
    ("x1^2 + 2*alpha*y' - 3/2 <= 0", r"2\,x_{1}^{2} + 4\,\alpha\,y' - 3 \leq 0"),
    ("speed /= `a_b#`", r"\mathrm{speed} - \mathrm{a\_b\#} \neq 0"),
    ("Omega > 0 and (x = 1 or not (y = root(1, y^2 - x)))", None),
    ("ex x, y. all z. x*y'^2 > z or z >= 1", None),
    ("true", r"\top"),
    ("false", r"\bot"),
)
def test_what_is_written_is_read(text: str, source: str | None) -> None:
    formula = read(text)
    written = latex.write(formula)
    assert source is None or written == source
    assert "root" in text or latex.read(written) == formula


def test_names_and_polynomials() -> None:
    names = {"x": "x", "x12": "x_{12}", "y''": "y''", "Gamma": r"\Gamma", "Alpha": r"\mathrm{Alpha}"}
    names |= {"pi2": r"\pi_{2}", "pi_2": r"\pi_{\mathrm{2}}", "pI": r"\mathrm{pI}", "or": r"\mathit{or}"}
    assert {name: latex.name(name) for name in names} == names
    assert latex.name("a b^") == r"\mathrm{a\ b\char94 }"
    poly = next(iter(polynomials(read("x^2*y - 1 > 0"))))
    assert latex.term(poly) == r"x^{2}\,y - 1"


def test_long_formulas_stand_in_lines() -> None:
    parts = " and ".join(f"(x{k} > {k} or x{k} < y)" for k in range(6))
    lines = latex.write(read(f"ex x0. {parts}")).splitlines()
    assert lines[0] == r"\exists x_{0}\colon \begin{array}{rl}" and lines[-1] == r"\end{array}" and len(lines) == 8
    assert lines[2] == r"\land\; & \left(x_{1} - 1 > 0 \lor y - x_{1} > 0\right) \\"
    assert "array" not in latex.write(read("ex x0. x0^2 > 1")) and latex.write(read(parts)).startswith(r"\begin{array}")
    either = latex.write(read(parts.replace(" and ", " # ").replace(" or ", " and ").replace(" # ", " or ")))
    assert either.count(r"\lor\; &") == 5 and r"\left" not in either


PLAIN = st.from_regex(r"[A-Za-z][A-Za-z0-9_#&^~{}]{0,4}'?", fullmatch=True)


@example("x1", "x_1")
@example("x_", "x")
@example("and", "a_b")
@given(PLAIN, PLAIN)
def test_two_names_stay_two_names(one: str, other: str) -> None:
    """``x1 > x_1`` was written with one variable, and read back as false."""
    formula = read(f"{quoted(one)} > 2*{quoted(other)} + 1")
    assert str(latex.read(latex.write(formula))) == str(formula)
    assert (latex.name(one) == latex.name(other)) == (one == other)


@each("and", "or", "implies")
def test_an_upright_connective_is_asked_back(word: str) -> None:
    with pytest.raises(qe.ParseError, match=rf"the connective is \\text\{{{word}\}}"):
        latex.read(rf"x > 0 \mathrm{{{word}}} y > 0")

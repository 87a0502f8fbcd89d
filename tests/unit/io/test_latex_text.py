"""LaTeX of printed texts: in the order in which they stand, with brackets where they are needed."""

import pytest

import qe
from qe.io.latex_text import formula_in_latex, term_in_latex
from tests.tables import each


@each(
    ("(4*c - b^2)/4", r"\frac{4\,c - b^{2}}{4}"),
    ("s - x", "s - x"),
    ("-cbrt(2187/256)", r"-\sqrt[3]{\frac{2187}{256}}"),
    ("(-b + sqrt(b^2 - 4*a*c))/(2*a)", r"\frac{-b + \sqrt{b^{2} - 4\,a\,c}}{2\,a}"),
    ("2*(x + 1)^2", r"2\,\left(x + 1\right)^{2}"),
    ("a^(1/4)", r"\sqrt[4]{a}"),
    ("sqrt(2)^2", r"\left(\sqrt{2}\right)^{2}"),
    ("-(a + b)", r"-\left(a + b\right)"),
    ("x - (a - b)", r"x - \left(a - b\right)"),
    ("|x - 1|", r"\left|x - 1\right|"),
    ("root(2, x^3 - a*x + 1, x)", r"\operatorname{root}_{2}\left(x^{3} - a\,x + 1, x\right)"),
    ("1/2*x1", r"\frac{1}{2}\,x_{1}"),
    ("alpha*(-3)", r"\alpha\,\left(-3\right)"),
)
def test_terms(text: str, source: str) -> None:
    assert term_in_latex(text) == source


@each(
    ("a >= 0 and (b < 1 or c /= 2)", r"a \geq 0 \land \left(b < 1 \lor c \neq 2\right)"),
    ("-sqrt(b) <= x < 2", r"-\sqrt{b} \leq x < 2"),
    ("true", r"\top"),
)
def test_formulas(text: str, source: str) -> None:
    assert formula_in_latex(text) == source


@pytest.mark.parametrize("text", ["max(x, y)", "sign(x)"])
def test_what_has_no_form_is_refused(text: str) -> None:
    with pytest.raises(qe.InputError, match="not known"):
        term_in_latex(text)

"""MathML: well-formed, with every part in its place."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest
from hypothesis import given

from qe.formula.syntax import Formula
from qe.io import mathml
from qe.io.text import read
from tests.strategies import formulas
from tests.tables import each


def plain(text: str) -> str:
    """The text of a formula's element, tags left out."""
    return "".join(ElementTree.fromstring(mathml.write(read(text))).itertext()).replace("\u2062", "*")


@each(
    ("x^2 - 2*x*y + 1 = 0", "x2−2*x*y+1=0"),
    ("-x < 1", "x+1>0"),
    ("x /= 1", "x−1≠0"),
    ("x <= 1 and y >= 1", "x−1≤0∧y−1≥0"),
    ("x > 0 and (y > 0 or z = 0)", "x>0∧(y>0∨z=0)"),
    ("not (ex y. y > x)", "¬(∃y:x−y<0)"),
    ("all x, y. x > y", "∀x,y:x−y>0"),
    ("x1 = 0", "x1=0"),
    ("alpha > 0", "α>0"),
    ("x' > 0", "x′>0"),
    ("true", "true"),
    ("x < root(-2, x^2 - y)", "x<root-2(x2−y)"),
    ("`a<b` > 0", "a<b>0"),
)
def test_what_is_drawn(text: str, drawn: str) -> None:
    assert plain(text) == drawn


def test_indices_powers_and_names() -> None:
    assert mathml.name("x12") == "<msub><mi>x</mi><mn>12</mn></msub>"
    assert mathml.name("omega_3''") == "<msub><mi>ω′′</mi><mn>3</mn></msub>"
    assert mathml.name("a b") == "<mi>a b</mi>" and "&lt;" in mathml.name("<")
    assert "<msup><mi>x</mi><mn>3</mn></msup>" in mathml.write(read("x^3 > 0"))
    assert mathml.polynomial([]) == "<mrow><mn>0</mn></mrow>"
    assert mathml.expression(read("x > 0"), draw=lambda name: f"<b>{name}</b>").startswith("<mrow><mrow><b>x</b>")


def test_much_is_written_in_rows() -> None:
    short = " and ".join(f"x > {k}" for k in range(6))  # two monomials each, the first one
    assert "mtable" not in mathml.write(read(short))
    long = ElementTree.fromstring(mathml.write(read(f"ex y. {short} and x > 6 and y > x")))
    rows = [row for row in long.iter() if row.tag.endswith("mtr")]
    assert len(rows) == 8 and "".join(rows[0][0].itertext()) == "" and "".join(rows[1][0].itertext()) == "∧"
    assert "".join(long.itertext()).startswith("∃y:")


@given(formulas(max_quantifiers=2, root_atoms=True))
def test_every_formula_is_well_formed(formula: Formula) -> None:
    root = ElementTree.fromstring(mathml.write(formula))
    shown = "".join(root.itertext())
    assert shown.count("(") == shown.count(")") and all(name in shown for name in formula.free)


def test_other_objects_are_refused() -> None:
    with pytest.raises(TypeError, match="not a formula"):
        mathml.expression("x > 0")  # type: ignore[arg-type]


@given(formulas())
def test_lines_change_nothing_that_is_said(formula: Formula) -> None:
    lines = ElementTree.fromstring(f"<m>{mathml.expression(formula, broken=True)}</m>")
    assert "".join(lines.itertext()) == "".join(
        ElementTree.fromstring(f"<m>{mathml.expression(formula)}</m>").itertext()
    )


def test_long_polynomials_stand_in_lines() -> None:
    """On paper the page of a derivation cut them off."""
    sums = " + ".join(f"{k}*a^{k}*b^{40 - k}" for k in range(1, 40))
    element = ElementTree.fromstring(mathml.write(read(f"x > 0 and (y > 0 or {sums} <= 0)")))
    lines = [
        "".join(row.itertext())
        for row in element.iter()
        if row.tag.endswith("mtr") and "mtable" not in {part.tag.rpartition("}")[2] for part in row.iter()}
    ]
    assert len(lines) > 5 and max(map(len, lines)) < 2 * mathml.LINE

"""QEPCAD, Redlog, JSON, LaTeX and MathML, and the door to all formats."""

from __future__ import annotations

import json

import pytest

from qe.errors import InputError, ParseError
from qe.exact.ring import Ring
from qe.formula.build import atom
from qe.formula.syntax import Relation
from qe.formula.traverse import ring_of
from qe.io import formats, qepcad, redlog
from qe.io.json import decode, encode
from qe.io.text import read as text
from tests.tables import each


@each(
    ("(E x)[ a x^2 + b x + c = 0 /\\ ~[x < 0] ]", "ex x. a*x^2 + b*x + c = 0 and x >= 0"),
    ("(A x)(E y)[ x < y ].", "all x. ex y. x - y < 0"),
    ("[2 (x+1)(y-1) /= 0]", "x*y - x + y - 1 /= 0"),
    ("[1/2 x^2 y - 3 >= 0]", "x^2*y - 6 >= 0"),
    ("[x > _root_-2 x^2 - 2 y \\/ y = 0]", "x > root(-2, x^2 - 2*y) or y = 0"),
    ("[x = 0 ==> y = 0]", "x /= 0 or y = 0"),
    ("[x = 0 <== y = 0]", "y /= 0 or x = 0"),
    ("[x = 0 <==> y = 0]", "(x /= 0 or y = 0) and (y /= 0 or x = 0)"),
    ("x > 0 /\\ TRUE", "x > 0"),
)
def test_qepcad(given: str, printed: str) -> None:
    assert str(qepcad.read(given)) == printed


def test_a_qepcad_session() -> None:
    session = "[ Quadratic. ]\n(b,a,x)\n2\n(E x)[ a x^2 + b >= 1/2 ].\nproj-op (m,m)\nfinish\n"
    formula = qepcad.read(session)
    assert str(formula) == "ex x. 2*a*x^2 + 2*b - 1 >= 0"
    assert ring_of(formula) is Ring.of(("b", "a", "x"))
    assert qepcad.write(formula) == "[]\n(b,a,x)\n2\n(E x)[2 a x^2 + 2 b - 1 >= 0].\nfinish\n"


@each(
    ("(F x)[x = 0]", "quantifier F"),
    ("[x = 1", "too early"),
    ("[]\n(a,x)\n1\n(E y)[x = 1].", "unknown variable|quantifiers for x"),
    ("[]\n(a,x)\n1\n[x = 1].", "quantifiers for x"),
    ("[]\n(a,x)\n2\n[x = y].", "unknown variable y"),
    ("[]\n(a,a)\n2\n[a = 0].", "twice"),
    ("[]\n(a,x)\n2\n[x = a].\nassume [a > 0]\nfinish", "assumptions"),
)
def test_qepcad_mistakes(given: str, part: str) -> None:
    with pytest.raises(ParseError, match=part):
        qepcad.read(given)


@each(
    ("ex(x, a*x**2 + b*x + c = 0)", "ex x. a*x^2 + b*x + c = 0"),
    ("phi := all({x,y}, x<>y impl not(x>0 and y geq 0));", "all x, y. x - y = 0 or not (x > 0 and y >= 0)"),
    ("x=1 repl y=2", "y - 2 /= 0 or x - 1 = 0"),
    ("ex(x, x = 1) and y = 2 $", "(ex x. x - 1 = 0) and y - 2 = 0"),
    ("x = 0 equiv y = 0", "(x /= 0 or y = 0) and (y /= 0 or x = 0)"),
    ("!A1 + a1 = 0 % comment", "A1 + a1 = 0"),
    ("x neq 1/2", "2*x - 1 /= 0"),
)
def test_redlog(given: str, printed: str) -> None:
    assert str(redlog.read(given)) == printed


@each(("e = 1", "constant"), ("ex x. x = 1", "unexpected"), ("x = ", "too early"))
def test_redlog_mistakes(given: str, part: str) -> None:
    with pytest.raises(ParseError, match=part):
        redlog.read(given)


def test_redlog_writing() -> None:
    assert redlog.write(text("(ex x, y. x /= y) and A > 0")) == "ex({x,y}, x - y <> 0) and !A > 0"


@each("e", "i", "pi", "and", "x'", "a b", "ä", "Ex")
@each("redlog", "qepcad")
def test_reserved_names_are_renamed_injectively(format_name: str, name: str) -> None:
    ring = Ring.of((name, "v", f"v{name}"))
    formula = atom(ring.gen(0) + 2 * ring.gen(1) + 3 * ring.gen(2), Relation.GT)
    again = formats.read(formats.write(formula, format_name), format_name)
    assert len(again.free) == 3


def test_json_is_readable_and_checked() -> None:
    formula = text("ex x. x^2 - y >= 0 and not (x < root(1, x^2 - y))")
    data = encode(formula)
    assert data["ring"] == ["y", "x"]
    assert decode(json.loads(json.dumps(data))) == formula


@each(
    {"format": "other"},
    {"version": 2},
    {"ring": ["x", "x"]},
    {"ring": "x"},
    {"ring": ["x", "a|b"]},
    {"ring": ["x", "y", "z"]},
    {"extra": 1},
    {"formula": None},
    {"formula": {"and": 1}},
    {"formula": {"atom": [["1", [1, 0]]], "relation": "=<"}},
    {"formula": {"atom": [["1.5", [1, 0]]], "relation": "="}},
    {"formula": {"atom": [["1", [1, -1]]], "relation": "="}},
    {"formula": {"atom": [["1", [1, 10**9]]], "relation": "="}},
    {"formula": {"atom": [["1", [1, 0]], ["2", [1, 0]]], "relation": "="}},
    {"formula": {"atom": [["1", [1, 0]]], "relation": "=", "more": 1}},
    {"formula": {"root": [["1", [1, 0]]], "relation": "=", "variable": "u", "k": 1}},
    {"formula": {"root": [["1", [1, 0]]], "relation": "=", "variable": "x", "k": 0}},
)
def test_json_that_is_no_formula_is_refused(change: dict[str, object]) -> None:
    data = {**encode(text("x^2 + y > 0")), **change}
    with pytest.raises(InputError):
        formats.read(json.dumps(data), "json")


@each("", "{", "[" * 100_000, '{"format": 1}', "1")
def test_json_texts_that_are_no_json(given: str) -> None:
    with pytest.raises(InputError, match="<text>"):
        formats.read(given, "json")


def test_latex() -> None:
    assert formats.write(text("ex x1. a*x1^2 /= alpha or x1 < 0"), "latex") == (
        r"\exists x_{1}\colon a\,x_{1}^{2} - \alpha \neq 0 \lor x_{1} < 0"
    )
    long = formats.write(text(" and ".join(f"(x - {k})^2 + y^2 + {k}*z <= 27" for k in range(1, 5))), "latex")
    assert long.count(r"\\") == 3 and r"\begin{array}" in long


def test_mathml() -> None:
    written = formats.write(text("ex x1. a*x1^2 < 2 or y > 0"), "mathml")
    assert written.startswith("<math") and "<mo>∃</mo>" in written and "&lt;" in written
    assert "<msubsup><mi>x</mi><mn>1</mn><mn>2</mn></msubsup>" in written


def test_the_door() -> None:
    assert set(formats.READABLE) == {"text", "smtlib", "qepcad", "redlog", "latex", "json"}
    assert str(formats.read("x > 0")) == "x > 0"
    with pytest.raises(InputError, match="only be written"):
        formats.read("x", "mathml")
    with pytest.raises(InputError, match="unknown format"):
        formats.write(text("x > 0"), "word")

"""LaTeX, MathML and the notations of other programs."""

import json
from xml.etree import ElementTree

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import qe
from qe.errors import InputError, ParseError
from qe.exact.ring import Ring
from qe.formula.build import atom
from qe.formula.syntax import Formula, Relation
from qe.formula.traverse import polynomials
from qe.io import formats, latex, mathml, qepcad, redlog
from qe.io.json import decode, encode
from qe.io.text import read
from qe.spelling import quoted
from tests.strategies import formulas
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
    assert str(formats.read("ab < 1", "latex")) == "a*b < 1"
    assert str(formats.read("ab < 1")) == "ab < 1"


@each(
    ("x1^2 + 2*alpha*y' - 3/2 <= 0", r"2\,x_{1}^{2} + 4\,\alpha\,y' \leq 3"),
    ("speed /= `a_b#`", r"\mathrm{speed} \neq \mathrm{a\_b\#}"),
    ("Omega > 0 and (x = 1 or not (y = root(1, y^2 - x)))", None),  # was read as a product with root1
    ("x1 >= root(-12, x1^13 + y*x1 - 2)", None),
    ("ex x, y. all z. x*y'^2 > z or z >= 1", None),
    ("true", r"\top"),
    ("false", r"\bot"),
)
def test_what_is_written_is_read(text: str, source: str | None) -> None:
    formula = read(text)
    written = latex.write(formula)
    assert source is None or written == source
    assert latex.read(written) == formula


def test_names_and_polynomials() -> None:
    names = {"x": "x", "x12": "x_{12}", "y''": "y''", "Gamma": r"\Gamma", "Alpha": r"\mathrm{Alpha}"}
    names |= {"pi2": r"\pi_{2}", "pi_2": r"\pi_{\mathrm{2}}", "pI": r"\mathrm{pI}", "or": r"\mathit{or}"}
    assert {name: latex.name(name) for name in names} == names
    assert latex.name("a b^") == r"\mathrm{a\ b\char94 }"
    poly = next(iter(polynomials(read("x^2*y > 1"))))
    assert latex.term(poly) == r"x^{2}\,y - 1"


def test_long_formulas_stand_in_lines() -> None:
    parts = " and ".join(f"(x{k} > {k} or x{k} < y)" for k in range(6))
    lines = latex.write(read(f"ex x0. {parts}")).splitlines()
    assert lines[0] == r"\exists x_{0}\colon \begin{array}{rl}" and lines[-1] == r"\end{array}" and len(lines) == 8
    assert lines[2] == r"\land\; & \left(x_{1} > 1 \lor y > x_{1}\right) \\"
    assert "array" not in latex.write(read("ex x0. x0^2 > 1")) and latex.write(read(parts)).startswith(r"\begin{array}")
    either = latex.write(read(parts.replace(" and ", " # ").replace(" or ", " and ").replace(" # ", " or ")))
    assert either.count(r"\lor\; &") == 5 and r"\left" not in either


@each("and", "or")
@each("not (ex x. x = 0)", "not (all x. x > y or z > x)", "(ex x. x = 0 and y > 1)", "(x > 1 and y > 1 or z = 0)")
def test_a_line_of_latex_had_no_brackets_around_a_quantifier_below_a_negation(first: str, operator: str) -> None:
    """The lines after it were read as more of its body."""
    formula = read(f"{first} {operator} {10**100}*y > 1")
    written = latex.write(formula)
    assert "array" in written and latex.read(written) == formula


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


def plain(text: str) -> str:
    """The text of a formula's element, tags left out."""
    return "".join(ElementTree.fromstring(mathml.write(read(text))).itertext()).replace("\u2062", "*")


@each(
    ("x^2 - 2*x*y + 1 = 0", "x2−2*x*y+1=0"),
    ("-x < 1", "x>−1"),
    ("x /= 1", "x≠1"),
    ("x <= 1 and y >= 1", "x≤1∧y≥1"),
    ("x > 0 and (y > 0 or z = 0)", "x>0∧(y>0∨z=0)"),
    ("not (ex y. y > x)", "¬(∃y:x<y)"),
    ("all x, y. x > y", "∀x,y:x>y"),
    ("x1 = 0", "x1=0"),
    ("alpha > 0", "α>0"),
    ("x' > 0", "x′>0"),
    ("true", "true"),
    ("x < root(-2, x^2 - y)", "x<root-2(x2−y)"),
    ("`a<b` > 0", "a<b>0"),
    ("x > 0 and 3*x <= 7 and y = 1", "0<x≤73∧y=1"),
)
def test_what_is_drawn(text: str, drawn: str) -> None:
    assert plain(text) == drawn


def test_indices_powers_and_names() -> None:
    assert mathml.name("x12") == "<msub><mi>x</mi><mn>12</mn></msub>"
    assert mathml.name("omega_3''") == "<msub><mi>ω′′</mi><mn>3</mn></msub>"
    assert mathml.name("a b") == "<mi>a b</mi>" and "&lt;" in mathml.name("<")
    assert "<msup><mi>x</mi><mn>3</mn></msup>" in mathml.write(read("x^3 > 0"))
    assert mathml.polynomial([]) == "<mrow><mn>0</mn></mrow>"
    assert mathml.expression(read("x > 0"), draw=lambda name: f"<b>{name}</b>").startswith("<mrow><b>x</b>")


def test_much_is_written_in_rows() -> None:
    short = " and ".join(f"x > {k}" for k in range(6))  # two monomials each, the first one
    assert "mtable" not in mathml.write(read(short))
    long = ElementTree.fromstring(mathml.write(read(f"ex y. {short} and x > 6 and y > 2*x")))
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
    lines = ElementTree.fromstring(f"<m>{mathml.in_rows(formula)}</m>")
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


@each(
    ("(E x)[ a x^2 + b x + c = 0 /\\ ~[x < 0] ]", "ex x. a*x^2 + b*x + c = 0 and x >= 0"),
    ("(Ex)(Ay)[ a x > y ]", "ex x. all y. y < a*x"),
    ("(A x)(E y)[ x < y ].", "all x. ex y. x < y"),
    ("[2 (x+1)(y-1) /= 0]", "(x + 1)*(y - 1) /= 0"),
    ("[1/2 x^2 y >= 3]", "x^2*y >= 6"),
    ("[x > _root_-2 x^2 - 2 y \\/ y = 0]", "x > root(-2, x^2 - 2*y) or y = 0"),
    ("[x = 0 ==> y = 0]", "x /= 0 or y = 0"),
    ("[x = 0 <== y = 0]", "y /= 0 or x = 0"),
    ("[x = 0 <==> y = 0]", "(x /= 0 or y = 0) and (y /= 0 or x = 0)"),
    ("x > 0 /\\ TRUE", "x > 0"),
)
def test_qepcad(given: str, printed: str) -> None:
    assert str(formats.read(given, "qepcad")) == printed


def test_a_qepcad_session() -> None:
    session = "[ Quadratic. ]\n(b,a,x)\n2\n(E x)[ a x^2 + b >= 1/2 ].\nproj-op (m,m)\nfinish\n"
    formula = formats.read(session, "qepcad")
    assert str(formula) == "ex x. 2*a*x^2 + 2*b >= 1"
    assert formula.ring is Ring.of(("b", "a", "x"))
    assert qepcad.write(formula) == "[]\n(b,a,x)\n2\n(E x)[2 a x^2 + 2 b - 1 >= 0].\nfinish\n"


@each(
    ("(X 30 x)[x = 0]", "at most 20"),
    ("[x = 1", "too early"),
    ("[]\n(a,x)\n1\n(E y)[x = 1].", "unknown variable|quantifiers for x"),
    ("[]\n(a,x)\n1\n[x = 1].", "quantifiers for x"),
    ("[]\n(a,x)\n2\n[x = y].", "unknown variable y"),
    ("[]\n(a,a)\n2\n[a = 0].", "twice"),
    ("[]\n(a,x)\n2\n[x = a].\nassume [b > 0]\nfinish", "variable of the session"),
    ("[]\n(a,x)\n2\n[x = a].\nassume [a >]\nfinish", "unexpected"),
)
def test_qepcad_mistakes(given: str, part: str) -> None:
    with pytest.raises(ParseError, match=part):
        formats.read(given, "qepcad")


@each(
    ("ex(x, a*x**2 + b*x + c = 0)", "ex x. a*x^2 + b*x + c = 0"),
    ("phi := all({x,y}, x<>y impl not(x>0 and y geq 0));", "all x, y. x = y or not (x > 0 and y >= 0)"),
    ("x=1 repl y=2", "y /= 2 or x = 1"),
    ("ex(x, x = 1) and y = 2 $", "(ex x. x = 1) and y = 2"),
    ("x = 0 equiv y = 0", "(x /= 0 or y = 0) and (y /= 0 or x = 0)"),
    ("!A1 + a1 = 0 % comment", "A1 + a1 = 0"),
    ("x neq 1/2", "x /= 1/2"),
)
def test_redlog(given: str, printed: str) -> None:
    assert str(formats.read(given, "redlog")) == printed


@each(("e = 1", "constant"), ("ex x. x = 1", "unexpected"), ("x = ", "too early"))
def test_redlog_mistakes(given: str, part: str) -> None:
    with pytest.raises(ParseError, match=part):
        formats.read(given, "redlog")


def test_redlog_writing() -> None:
    assert redlog.write(read("(ex x, y. x /= y) and A > 0")) == "ex({x,y}, x - y <> 0) and !A > 0"


@each("e", "i", "pi", "and", "x'", "a b", "ä", "Ex")
@each("redlog", "qepcad")
def test_reserved_names_are_renamed_injectively(format_name: str, name: str) -> None:
    ring = Ring.of((name, "v", f"v{name}"))
    formula = atom(ring.gen(0) + 2 * ring.gen(1) + 3 * ring.gen(2), Relation.GT)
    again = formats.read(formats.write(formula, format_name), format_name)
    assert len(again.free) == 3


def test_json_is_readable_and_checked() -> None:
    formula = read("ex x. y <= x^2 and not (x < root(1, x^2 - y))")
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
    data = {**encode(read("x^2 + y > 0")), **change}
    with pytest.raises(InputError):
        formats.read(json.dumps(data), "json")


@each("", "{", "[" * 100_000, '{"format": 1}', "1")
def test_json_texts_that_are_no_json(given: str) -> None:
    with pytest.raises(InputError, match="<text>"):
        formats.read(given, "json")


def test_latex() -> None:
    assert formats.write(read("ex x1. a*x1^2 /= alpha or x1 < 0"), "latex") == (
        r"\exists x_{1}\colon \alpha \neq a\,x_{1}^{2} \lor x_{1} < 0"
    )
    long = formats.write(read(" and ".join(f"(x - {k})^2 + y^2 + {k}*z <= 27" for k in range(1, 5))), "latex")
    assert long.count(r"\\") == 3 and r"\begin{array}" in long


def test_mathml() -> None:
    written = formats.write(read("ex x1. a*x1^2 < 2 or y > 0"), "mathml")
    assert written.startswith("<math") and "<mo>∃</mo>" in written and "&lt;" in written
    assert "<msubsup><mi>x</mi><mn>1</mn><mn>2</mn></msubsup>" in written


def test_the_door() -> None:
    assert set(formats.READABLE) == {"text", "smtlib", "qepcad", "redlog", "latex", "json"}
    assert str(formats.read("x > 0")) == "x > 0"
    with pytest.raises(InputError, match="only be written"):
        formats.read("x", "mathml")
    with pytest.raises(InputError, match="unknown format"):
        formats.write(read("x > 0"), "word")

"""Texts of any kind, formats, and damaged ones: read, or refused in one line."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from itertools import islice
from random import Random

import pytest
import sympy
from hypothesis import example, given
from hypothesis import strategies as st

from qe.errors import InputError
from qe.formula.build import exists
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Exists as ExistsNode
from qe.formula.syntax import ForAll as ForAllNode
from qe.formula.syntax import Formula
from qe.io import formats, qepcad, redlog, smtlib, text
from qe.io import json as json_format
from qe.io.latex_lexer import is_latex
from qe.io.sympy import Exists, ForAll, from_sympy, to_sympy
from qe.io.text import read
from tests import fuzz
from tests.strategies import formulas, points
from tests.universe import UNIVERSE, holds, same

WORDS = (
    *("x", "y", "E", "A", "ex", "all", "not", "and", "or", "->", "<->", "true", "(", ")", "+", "-", "*", "/", "^", "<"),
    *("=", "/=", ">=", ".", ",", "0", "2", "1/2", "0.5", "1e3", "root", "|a b|", "#", "\n", "~", "/\\", "\\/", "==>"),
    *("[", "]", "(E x)", "_root_1", "{", "}", "impl", "<>", "**", ":=", ";", "%", "|", '"', "!", ":named", "let"),
    *("assert", "(assert", "declare-const", "Real", "exists", "(check-sat)", "(declare-const x Real)", "((", "))"),
    *("²", "ite", "`a b`", "`", "`e`", "`a\\`", "\\u{a}", "pi", "e"),
)
token_texts = st.lists(st.sampled_from(WORDS), max_size=14).map(" ".join)


def check(text: str, name: str) -> None:
    try:
        formula = formats.read(text, name)
    except InputError as error:
        assert "\n" not in str(error)
    else:
        assert isinstance(formula, Formula)


@pytest.mark.parametrize("name", formats.READABLE)
@given(token_texts | st.text(max_size=12))
@example("")
@example("\x00")
@example("٣ > x")
@example("x > |" + "a" * 100)
@example("x > `" + "a" * 100)
@example("`\\u{110000}` > 0")
@example("`\\u{d800}` > 0")
@example("[" * 5000)
@example("(" * 5000)
@example("not " * 5000 + "x > 0")
@example("- " * 5000 + "x > 0")
def test_any_text(name: str, text: str) -> None:
    check(text, name)


@pytest.mark.parametrize("name", formats.READABLE)
@given(formulas(max_quantifiers=2), st.data())
def test_damaged_text(name: str, formula: Formula, data: st.DataObject) -> None:
    text = formats.write(formula, name)
    start = data.draw(st.integers(0, len(text)))
    stop = data.draw(st.integers(start, min(len(text), start + 6)))
    check(text[:start] + data.draw(st.sampled_from(("", " ", "(", ")", "x", "0", "=", "-"))) + text[stop:], name)


@pytest.mark.parametrize("seed", range(40))
def test_products_without_signs_are_read_as_with_them(seed: int) -> None:
    """At random: the signs of products left out between letters that are all names, at all levels of quantifiers."""
    rng = Random(seed)

    def monomial() -> str:
        powers = rng.sample("abcxy", rng.randint(1, 3))
        return "*".join((str(rng.randint(2, 9)), *powers[:-1], f"{powers[-1]}{rng.choice(('', '^2', '^3'))}"))

    def side() -> str:
        return rng.choice((" + ", " - ")).join(monomial() for _ in range(rng.randint(1, 3)))

    parts = [f"{side()} {rng.choice(('<', '<=', '=', '/='))} {side()}" for _ in range(rng.randint(1, 3))]
    body = rng.choice((" and ", " or ", " -> ")).join((*parts, "a + b + c < x + y"))
    typed = rng.choice(("", "ex x. ", "all x. ex y. ", "exists x, y: ", "for all a: ", "∀c ∃x: ")) + body
    bare = re.sub(r"(?<=[0-9a-z])\*(?=[a-z])", "", typed)
    assert bare != typed and "*" not in bare
    assert read(bare) == read(typed), bare


def test_damaged_texts_are_read_or_refused_in_one_line() -> None:
    for door, damaged in islice(fuzz.texts(11), 400):
        fuzz.examine(door, damaged)


def test_a_failing_reader_is_found(monkeypatch, capsys) -> None:
    def broken(text: str) -> None:
        raise KeyError(text[:1])

    monkeypatch.setitem(fuzz.DOORS, "prompt", broken)
    monkeypatch.setattr("sys.argv", ["fuzz", "--inputs", "500"])
    with pytest.raises(KeyError):
        fuzz.main()
    assert capsys.readouterr().out.startswith("prompt: ")


def test_the_number_of_texts(monkeypatch, capsys) -> None:
    monkeypatch.setattr("sys.argv", ["fuzz", "--inputs", "50"])
    assert fuzz.main() == 0 and capsys.readouterr().out == "50 texts read\n"


def test_a_line_break_in_a_word_of_latex() -> None:
    fuzz.examine("latex", "\\forall x \\lnot \\mathrm{a\nc} = x")


PLAIN = ("x", "y", "z")
STRANGE = ("x'", "not", "a b", "ä", "E", "1+1", "ex", "x₁")
places = st.fixed_dictionaries({name: st.sampled_from(UNIVERSE) for name in PLAIN})


@given(formulas(names=PLAIN, max_quantifiers=3, root_atoms=True))
def test_text(formula: Formula) -> None:
    written = text.write(formula)
    assert same(text.read(written), formula), written
    assert "\n" not in written


@given(formulas(names=STRANGE[:3], max_quantifiers=2, root_atoms=True), st.permutations(STRANGE))
def test_text_with_strange_names(formula: Formula, names: list[str]) -> None:
    renamed = json.loads(json_format.write(formula))
    table = dict(zip(STRANGE[:3], names, strict=False))
    strange = json_format.decode(rename_json(renamed, table))
    assert same(text.read(text.write(strange)), strange)
    assert json_format.read(json_format.write(strange)) == strange


def rename_json(node: object, table: dict[str, str]) -> object:
    match node:
        case dict():
            kept = ("format", "relation", "atom", "root")
            return {k: v if k in kept else rename_json(v, table) for k, v in node.items()}
        case list():
            return [rename_json(v, table) for v in node]
        case str():
            return table.get(node, node)
    return node


@given(formulas(names=PLAIN, max_quantifiers=2), st.sampled_from(("text", "redlog", "json", "smtlib", "qepcad")))
def test_writing_is_stable(formula: Formula, name: str) -> None:
    """Written, read and written again: the same text, for formats that bring no order of their own."""
    once = formats.read(formats.write(formula, name), name)
    again = formats.read(formats.write(once, name), name)
    assert same(once, again)


@given(formulas(names=PLAIN, max_quantifiers=3, root_atoms=True))
def test_json_is_exact(formula: Formula) -> None:
    again = json_format.read(json_format.write(formula))
    assert again == formula
    assert again.ring is formula.ring


@given(formulas(names=PLAIN, max_quantifiers=3))
def test_redlog(formula: Formula) -> None:
    assert same(formats.read(redlog.write(formula), "redlog"), formula)


@given(formulas(names=PLAIN, max_quantifiers=3))
def test_latex(formula: Formula) -> None:
    written = formats.write(formula, "latex")
    assert same(formats.read(written, "latex"), formula)
    if is_latex(written):
        assert same(text.read(written), formula)


@given(formulas(names=PLAIN, max_quantifiers=3), places)
def test_smtlib(formula: Formula, point: dict[str, Fraction]) -> None:
    """Bound variables may get new names, so the meaning is compared, with quantifiers over a finite universe."""
    again = smtlib.read(smtlib.write(formula))
    assert set(again.free) == set(formula.free)
    assert holds(again, point) == holds(formula, point)


@given(formulas(names=PLAIN))
def test_smtlib_without_quantifiers_keeps_the_tree(formula: Formula) -> None:
    assert same(smtlib.read(smtlib.write(formula)), formula)


@given(formulas(names=PLAIN, max_quantifiers=3, root_atoms=True), places)
def test_qepcad(formula: Formula, point: dict[str, Fraction]) -> None:
    """The writer makes the formula prenex, so the meaning is compared."""
    again = formats.read(qepcad.write(formula), "qepcad")
    assert holds(again, point) == holds(formula, point)
    body = again
    while isinstance(body, ExistsNode | ForAllNode):
        body = body.body
    assert body.is_quantifier_free
    assert set(again.free) <= set(formula.free)


@given(formulas(names=PLAIN), points(PLAIN))
def test_sympy_and_back(formula: Formula, point: dict[str, Fraction]) -> None:
    written = to_sympy(formula)
    expected = holds_at(formula, point)
    assert holds_at(from_sympy(written), point) is expected
    numbers = {sympy.Symbol(n): sympy.Rational(v.numerator, v.denominator) for n, v in point.items()}
    assert bool(written.subs(numbers)) is expected


@given(formulas(names=PLAIN), st.lists(st.sampled_from(PLAIN), min_size=1, unique=True), places)
def test_sympy_quantifiers(formula: Formula, names: list[str], point: dict[str, Fraction]) -> None:
    written = to_sympy(formula)
    assert holds(Exists(names, written).formula(), point) == holds(exists(names, formula), point)
    dual = ~Exists(names, sympy.Not(written))
    assert holds(ForAll(names, written).formula(), point) == holds(dual.formula(), point)


@given(formulas(names=PLAIN, max_quantifiers=3, root_atoms=True))
def test_latex_and_mathml_say_something(formula: Formula) -> None:
    import xml.etree.ElementTree as ElementTree

    source = formats.write(formula, "latex")
    assert source.count("{") == source.count("}")
    assert source.count(r"\left") == source.count(r"\right")
    ElementTree.fromstring(formats.write(formula, "mathml").replace("&#x2062;", ""))


@given(formulas(names=PLAIN, root_atoms=True, max_quantifiers=1))
def test_formats_without_roots_refuse_them(formula: Formula) -> None:
    if "root(" in str(formula):
        for name in ("smtlib", "redlog"):
            with pytest.raises(InputError, match="root"):
                formats.write(formula, name)

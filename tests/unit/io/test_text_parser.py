"""From tokens to surface trees: operators, the grammar against the plain way to write the same, names, depth."""

from collections.abc import Collection
from contextlib import nullcontext, suppress
from itertools import product

import pytest

import qe
from qe.errors import InputError, ParseError
from qe.formula.evaluate import holds_at
from qe.formula.relation import Relation
from qe.formula.syntax import Formula
from qe.io import formats
from qe.io import surface as s
from qe.io.lowering import lower
from qe.io.parser import INFIX, PREFIX, TERM, parsed
from qe.io.sharing import Names, chain
from qe.io.text_errors import Failing, SyntaxFailure
from qe.io.text_parser import LatexParser, TextParser, parser_of
from tests.tables import each


def test_sums_of_multiples_read_at_once_mean_what_their_tokens_mean() -> None:
    multiples = ("x", "2*x", "(-3) * y", "0*w", "7", "- y", "a_1", "x")
    for parts in product(multiples, multiples, ("+", "-")):
        side = f"{parts[0]} + z {parts[2]} {parts[1]}".replace("- -", "-").replace("+ -", "-")
        apart = side.replace("z", "(z)")  # brackets around a name: each token is read
        for text in ("{} <= 3", "x > 0 or ({})^2 < {} and true", "all x. 5 - x = {}"):
            assert formats.read(text.replace("{}", side)) == formats.read(text.replace("{}", apart)), side


@each(
    ("x > 0 and\n  y + > 1", (2, 7), "unexpected '>'", "a number, a variable or '('"),
    ("x > 0 and\nsin(y) > 1", (2, 1), "sin(y): sin is not algebraic", ""),
    ("x > 0 and\n y @ z", (2, 4), "unknown character '@'", ""),
)
def test_every_failure_becomes_one_error(text: str, place: tuple[int, int], said: str, expected: str) -> None:
    with pytest.raises(ParseError) as error:
        parsed(TextParser, text, Failing(text, "a file"))
    found = error.value
    assert (found.line, found.column, found.source, found.expected) == (*place, "a file", expected)
    assert said in str(found) and "\n" not in str(found)


DEEP = 5000


@each(
    ("(" * DEEP + "x > 0" + ")" * DEEP, "x > 0"),
    ("[" * DEEP + "x > 0" + "]" * DEEP, "x > 0"),
    ("(" * DEEP + "x" + ")" * DEEP + " > 0", "x > 0"),
    ("not " * DEEP + "x > 0", "x > 0"),
    ("-" * DEEP + "x > 0", "x > 0"),
    ("x" + "*1" * DEEP + " > 0", "x > 0"),
    ("(" * DEEP + "x" + " + 1)" * DEEP + " > 0", f"x + {DEEP} > 0"),
    ("(" * DEEP + "x > 0" + " and y > 0)" * DEEP, "x > 0 and y > 0"),
)
def test_brackets_signs_and_chains_may_be_as_deep_as_they_like(text: str, plain: str) -> None:
    assert formats.read(text) == formats.read(plain)


@each(
    "abs(" * DEEP + "x" + ")" * DEEP + " > 0",
    "If[x > 0, " * DEEP,
    "if " * DEEP,
    "ex x in [if " * DEEP,
    "ex x. " * DEEP + "x > 0",
    "x > 0 -> " * DEEP + "x > 0",
)
def test_what_is_nested_too_deeply_is_refused_in_one_line(text: str) -> None:
    with pytest.raises(ParseError) as error:
        formats.read(text)
    assert "nested more than 120 levels deep" in str(error.value)


def test_what_could_have_stood_there_is_exactly_what_can_be_read() -> None:
    """For every token behind some beginnings: the parser takes it if and only if it is among the expected."""
    shown = {"PLUS": "+", "MINUS": "-", "TIMES": "*", "POWER": "^", "RELATION": ">", "AND": "and", "OR": "or"}
    shown |= {"IMPLIES": "->", "IFF": "<->", "CLOSE": ")", "OPEN": "(", "NAME": "z", "NUMBER": "1", "NOT": "not"}
    shown |= {"COMMA": ",", "QUANTIFIER": "∃", "IF": "if", "RADICAL": "√", "IN": "∈", "LEFT": "[", "RIGHT": "]"}
    for text in ("x", "(x", "(x > 0", "x + (y", "x^2", "x^", "-", "not", "x > 0", "x > y <", "f(", "√", "[x"):
        expected = expected_behind(text)
        for kind, sign in shown.items():
            if text[-1].isalpha() and kind in ("OPEN", "LEFT"):
                continue  # behind a name they are a call, which no name can promise
            if text[-1].isalnum() and kind in ("OPEN", "NAME", "RADICAL"):
                continue  # a product without a sign, which is none for the parser
            parser = TextParser(f"{text} {sign}")
            with suppress(SyntaxFailure):
                parser.whole()
            taken = parser.token.at > len(text) + 1
            assert taken == (kind in expected), (text, sign, expected)


def expected_behind(text: str) -> set[str]:
    parser = TextParser(f"{text} else")  # which none of them goes on with
    kinds: set[str] = set()
    unexpected = parser.unexpected

    def noted(expected: Collection[str]) -> SyntaxFailure:
        kinds.update(expected)
        return unexpected(expected)

    parser.unexpected = noted  # type: ignore[method-assign]
    with pytest.raises(SyntaxFailure):
        parser.whole()
    return kinds


def test_tables() -> None:
    assert {"NAME", "NUMBER", "OPEN"} <= set(PREFIX) <= set(TextParser.prefix)
    assert all(operator.limit in (operator.level, operator.level + 1) for operator in INFIX.values())
    assert isinstance(TextParser("x > 0").whole(), s.Comparison)


def read(text: str) -> Formula:
    return lower(TextParser(text).whole(), lambda message, at: InputError(message))


@each(
    ("x in [0, 1)", "0 <= x and x < 1"),
    ("x in (0, 1]", "0 < x and x <= 1"),
    ("x in [-infinity, 1]", "x <= 1"),
    ("x in (0, infinity]", "0 < x"),
    ("x in {1, 2, y}", "x = 1 or x = 2 or x = y"),
    ("x in Reals", "true"),
    ("1/x in Reals", "x /= 0"),
    ("Element(x, Reals) and x > 0", "x > 0"),
    ("ex x in [0, 1]. x > y", "ex x. 0 <= x and x <= 1 and x > y"),
    ("all x in [0, 1]. x > y", "all x. 0 <= x and x <= 1 -> x > y"),
    ("ex x, z in [0, 1]. x*z > y", "ex x, z. (0 <= x and x <= 1) and (0 <= z and z <= 1) and x*z > y"),
    ("all x. ex z. x > z", "all x. (ex z. x > z)"),
    ("all x ex z. x > z", "all x. (ex z. x > z)"),
    ("ex x z. x > z", "ex x, z. x > z"),
    ("ex x (x > y)", "ex x. x > y"),
    ("ForAll[{x, z}, x > z]", "all x, z. x > z"),
    ("ForAll[x, x > 0, x > y]", "all x. x > 0 -> x > y"),
    ("Exists[x, x > 0, x > y]", "ex x. x > 0 and x > y"),
    ("Exists((x, z), x > z)", "ex x, z. x > z"),
    ("And(x > 0, y > 0, z > 0)", "x > 0 and y > 0 and z > 0"),
    ("Or(x > 0, y > 0)", "x > 0 or y > 0"),
    ("Not(x > 0)", "x <= 0"),
    ("Implies(x > 0, y > 0)", "x > 0 -> y > 0"),
    ("Equivalent(x > 0, y > 0)", "x > 0 <-> y > 0"),
    ("Less(x, y, z)", "x < y and y < z"),
    ("GreaterEqual[x, y]", "x >= y"),
    ("if x > 0 then y > 0 else z > 0", "(x > 0 -> y > 0) and (x > 0 or z > 0)"),
    ("|x - 1| > y", "abs(x - 1) > y"),
    ("√x > y", "sqrt(x) > y"),
    ("{x > 0, y > 0}", "x > 0 and y > 0"),
    ("ForAll x. x > y", "all x. x > y"),
    ("∃x. x > y", "ex x. x > y"),
    ("A x. x > y", "all x. x > y"),
    ("E x. x > y", "ex x. x > y"),
    ("x > 0 | y > 0", "x > 0 or y > 0"),
    ("x > 0||y > 0", "x > 0 or y > 0"),
    ("||x| - 1| > y", "abs(abs(x) - 1) > y"),
    ("|x| > 0 || |y| > 0", "abs(x) > 0 or abs(y) > 0"),
    ("(x > 0 | y > 0) & |x|*|y| < 1", "(x > 0 or y > 0) and abs(x)*abs(y) < 1"),
    ("Element[x | y, Reals] | |x| > 1", "true or abs(x) > 1"),
    ("2 x y^2 > z", "2*x*y^2 > z"),
    ("(x + 1) y > 0", "(x + 1)*y > 0"),
    ("(x + 1)(y - 1) > 0", "(x + 1)*(y - 1) > 0"),
    ("x (y + 1) > 0", "x*(y + 1) > 0"),
    ("x(y + 1) > 0", "x*(y + 1) > 0"),
    ("2(x - 1)y = x² y", "2*(x - 1)*y = x^2*y"),
    ("(3/4)x > x sqrt(2)", "(3/4)*x > x*sqrt(2)"),
    ("x/(2 y) > 2 alpha and alpha > 1", "x/(2*y) > 2*alpha and alpha > 1"),
    ("Piecewise((1, x < 1), (y, True)) > 1", "(if x < 1 then 1 else y) > 1"),
    ("x > 0, y > 1, z = 2", "x > 0 and y > 1 and z = 2"),
    ("x > 0, ex z. z^2 = x", "x > 0 and (ex z. z^2 = x)"),
    ("x, y, z > 0", "x > 0 and y > 0 and z > 0"),
    ("z = 1 and x, y > 0 or z = 2", "z = 1 and x > 0 and y > 0 or z = 2"),
    ("0 < x, y, z < 1", "0 < x and 0 < y and 0 < z and y < 1 and x < 1 and z < 1"),
    ("x^2 >= y for all x", "all x. x^2 >= y"),
    ("y > 0, x^2 >= y, for all real numbers x in [0, 1]", "all x. 0 <= x and x <= 1 -> y > 0 and x^2 >= y"),
    ("x^2 = y for some x", "ex x. x^2 = y"),
    ("for all x, y with x < y: x^3 < z*y", "all x, y. x < y -> x^3 < z*y"),
    ("for all x > 0 such that x < y: x^3 < z", "all x. x > 0 -> (x < y -> x^3 < z)"),
    ("x^3 < y^3 for all x, y with x < y", "all x, y. x < y -> x^3 < y^3"),
    ("{x, y} > z and x < 2", "x > z and y > z and x < 2"),
    ("for every real x: x^2 >= y", "all x. x^2 >= y"),
    ("ex x, with. x > with", "ex x, `with`. x > `with`"),
    ("there is a x with x^2 = a", "ex x. x^2 = a"),  # an article is no variable
    ("There exists a real number x such that x^2 = a", "ex x. x^2 = a"),
    ("there is a with a > x", "ex a. a > x"),
    ("there exists a in [0, x] such that a > 1", "ex a in [0, x]. a > 1"),
    ("there are no x, z with x*z = y", "not (ex x, z. x*z = y)"),  # "no" was a variable, and it said the opposite
    ("there are infinitely many x with x^2 < y", "infinitely many x. x^2 < y"),
    ("Reduce[{x > 0, x y > 1}, {x, y}, Reals]", "x > 0 and x*y > 1"),
)
def test_other_ways_to_write(text: str, plain: str) -> None:
    assert read(text) == read(plain)


@each(
    ("[x*y - 1, z^2 - x]", "x*y - 1 = 0 and z^2 - x = 0"),
    ("(x*y - 1, z^2 - x)", "x*y - 1 = 0 and z^2 - x = 0"),
    ("(x - 1)*(x + 1), (y - 1)*(y + 1)", "x^2 - 1 = 0 and y^2 - 1 = 0"),
    ("x^2 - 4", "x^2 - 4 = 0"),
)
def test_terms_alone_are_zero(text: str, plain: str) -> None:
    with pytest.warns(qe.DoubtfulInput, match="a term alone") if "[" not in text else nullcontext():
        assert qe.equivalent(text, plain)


@each("[x > 0, y]", "x, y", "x", "ex x. x^2 - 1", "x + 1 and y")
def test_terms_among_conditions_are_refused(text: str) -> None:
    with pytest.raises(ParseError):
        formats.read(text)


@each("(if x > 0 then y else z) > 1", "If[x > 0, y, z] > 1")
def test_case_distinctions_in_terms(text: str) -> None:
    formula = read(text)
    for x, y, z in product((0, 1), (1, 2), (1, 2)):
        assert holds_at(formula, {"x": x, "y": y, "z": z}) == ((y if x > 0 else z) > 1)


@each(1, 2, 3)
def test_exclusive_or(count: int) -> None:
    names = "xyz"[:count]
    formula = read(f"Xor({', '.join(f'{name} > 0' for name in names)})")
    for signs in product((0, 1), repeat=count):
        assert holds_at(formula, dict(zip(names, signs))) == bool(sum(signs) % 2)


def test_offsets_of_sets_and_functions() -> None:
    found = TextParser("x in (0, 1)").whole()
    x = s.Name("x", 0)
    low, high = s.Comparison([x, s.Number(0)], [Relation.GT], 2), s.Comparison([x, s.Number(1)], [Relation.LT], 2)
    assert found == s.Every([low, high])
    assert TextParser("1 + |x|").whole(TERM) == s.Sum([s.Number(1), s.Apply("abs", [s.Name("x", 5)], 4)])
    assert TextParser("∞").whole(TERM) == s.Infinity(0)


def test_one_grammar_for_text_and_latex() -> None:
    latex = r"\forall x \colon x^{2} \geq 0 \land \frac{1}{2} > y"
    fail = lambda message, at: InputError(message)  # noqa: E731
    assert parser_of(latex) is LatexParser and parser_of("x > 0 | y > 0") is TextParser
    assert lower(LatexParser(latex).whole(), fail) == read("all x. x^2 >= 0 and 1/2 > y")


def fail(message: str, at: int) -> InputError:
    return InputError(f"{message} at {at}")


def collected(text: str) -> tuple[list[str], list[str], list[str], int, list[tuple[str, int]]]:
    met: list[tuple[str, int]] = []
    names = Names(fail, lambda name, at: met.append((name, at)))
    names.part(TextParser(text).whole())
    return list(names.free), list(names.bound), names.all(), names.special, met


@each(
    ("y > 0 and x > z", "yxz", "", 0),
    ("ex x. x > a and (all y. y > b)", "ab", "xy", 0),
    ("x > 0 and (ex x. x > a)", "xa", "x", 0),
    ("(ex x. x > a) and x > 0", "ax", "x", 0),
    ("not (a > 0 -> b > 0) or (c > 0 <-> d > 0)", "abcd", "", 0),
    ("1/x + a/2 > -y^3", "xay", "", 1),  # a number below needs no name
    ("x^(1/2) + y^2 + z^(2/3) > 0", "xyz", "", 2),
    ("abs(x) + max(y, z, 1) > 0", "xyz", "", 2),
    ("(if a > 0 then b else c) > 0", "abc", "", 1),
    ("a < root(2, x^2 - b, x)", "axb", "", 1),
    ("ex x. a < root(2, x^2 - b, x)", "ab", "x", 1),
    ("true or a = 0", "a", "", 0),
)
def test_names_free_before_bound(text: str, free: str, bound: str, special: int) -> None:
    found = collected(text)
    assert ("".join(found[0]), "".join(found[1]), found[3]) == (free, bound, special)
    assert "".join(found[2]) == free + "".join(name for name in bound if name not in free)


def test_free_names_are_met_with_their_offsets() -> None:
    assert collected("x > y and ex y. y*x > 1")[4] == [("x", 0), ("y", 4), ("x", 18)]


def test_the_variable_of_a_root_counts_where_its_polynomial_lacks_it() -> None:
    assert collected("a < root(1, b, x)")[0] == ["a", "b", "x"]


def nested(depth: int) -> s.Node:
    node: s.Node = s.Comparison([s.Name("x", 0), s.Number(0)], [Relation.GT], 0)
    for _ in range(depth):
        node = s.Negation(node)
    return node


def deep_term(depth: int) -> s.Node:
    term: s.Term = s.Name("x", 0)
    for _ in range(depth):
        term = s.Minus(term)
    return s.Comparison([term], [], 0)


@each(nested, deep_term)
def test_depth_is_bounded(made: object) -> None:
    names = Names(fail, lambda name, at: None)
    names.part(made(s.MAX_DEPTH - 1))  # type: ignore[operator]
    with pytest.raises(InputError, match="nested more than 120 levels"):
        names.part(made(s.MAX_DEPTH))  # type: ignore[operator]


@each(
    lambda t: s.Sum([t, s.Number(1)]),
    lambda t: s.Product(s.Number(2), t, 0),
    lambda t: s.Power(t, s.Number(2), 0),
    lambda t: s.Power(s.Number(2), t, 0),
    lambda t: s.Apply("abs", [t], 0),
    lambda t: s.Root(s.Number(1), t, "x", 0),
    lambda t: s.Choice(s.Truth(True), t, None, 0),
    lambda t: s.Choice(s.Truth(True), s.Number(1), t, 0),
    lambda t: s.Choice(s.Comparison([t], [], 0), s.Number(1), s.Number(2), 0),
)
def test_every_kind_of_term_counts_a_level(step: object) -> None:
    term: s.Term = s.Name("x", 0)
    for _ in range(s.MAX_DEPTH + 1):
        term = step(term)  # type: ignore[operator]
    with pytest.raises(InputError, match="nested"):
        Names(fail, lambda name, at: None).part(term)


def test_long_chains_are_no_depth() -> None:
    """a*b/c… is one level however long it is, and is walked without recursion."""
    term: s.Term = s.Name("x", 0)
    links: list[s.Term] = []
    for k in range(5000):
        term = (s.Product if k % 2 else s.Quotient)(term, s.Name(f"y{k % 3}", k), k)
        links.append(term)
    first, found = chain(term)
    assert first == s.Name("x", 0) and [id(link) for link in found] == [id(link) for link in links]
    names = Names(fail, lambda name, at: None)
    names.part(term)
    assert names.all() == ["x", "y0", "y1", "y2"] and names.special == 2500


def test_a_chain_starts_at_what_is_known() -> None:
    inner = s.Product(s.Name("a", 0), s.Name("b", 1), 0)
    outer = s.Quotient(inner, s.Name("c", 2), 2)
    assert chain(outer, {id(inner)}) == (inner, [outer])
    assert chain(outer) == (s.Name("a", 0), [inner, outer])
    assert chain(s.Number(1)) == (s.Number(1), [])

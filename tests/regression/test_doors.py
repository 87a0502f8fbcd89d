"""What people put in and get out: every mistake here was once made by the toolkit and found from outside."""

from __future__ import annotations

import json
import re
import time
import warnings
from decimal import Decimal
from fractions import Fraction

import pytest
import sympy as sp
from sympy.abc import b, x, y

import qe
from qe.exact.field import NumberField
from qe.exact.ring import Ring
from qe.formula.build import atom
from qe.formula.syntax import Relation
from qe.io import formats, text
from qe.proof.entry import parse_poly, poly_to_text
from tests.tables import each

root2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)


# --- text ---------------------------------------------------------------------------------------------------
NO_NUMBER, RADICAL = "no number here", r"a radical is \S+\^\(1/[23]\)"
NO_DOT = "the condition of a quantifier ends with a dot"
"""The hint was "an operator is missing; a product is written 0*a"."""


@each(
    *((text, NO_NUMBER) for text in ("x > nan", r"x \leq e", "(all π. π > 0) or π = 1")),
    *((text, "pi is a number") for text in ("ForAll[{Pi}, Pi > 0]", "π = 1 or (all pi. pi > 0)")),
    # root(3, x) > 2 was false: the polynomial x has no third root
    *((text, RADICAL) for text in ("root(3, x) > 2", "Root[2, x] < y", "root(x, 3) > 2", "root(x - 1, 3) > 2")),
    *((text, NO_DOT) for text in ("∀t>0 a*t^2 > -1", "∀t>0a*t^2 > -1", "exists t >= 1/2 2*t = a", "all t>0 not a>t")),
)
def test_what_is_not_meant_as_it_reads_is_refused_with_a_hint(given: str, hint: str) -> None:
    with pytest.raises(qe.ParseError, match=hint):
        qe.eliminate(given)


def test_constants_may_be_names_where_that_is_meant() -> None:
    assert formats.read("`pi` > `e` and `e` = i").free == ("pi", "e", "i")
    assert qe.decide("all e. e > 0 -> ex d. d > 0 and d < e")
    answer = qe.eliminate(formats.read("(declare-const e Real)(assert (> (* e e) 2))", "smtlib"))
    assert qe.equivalent(str(answer), answer.formula)
    assert text.read("x > pi", known=("pi",)).free == ("x", "pi")


@each("e", "i", "E", "I")
def test_letters_are_variables_and_noted_where_their_neighbours_are_none(name: str) -> None:
    """``a*x^4 + b*x^3 + c*x^2 + d*x + e = 0`` was refused: "e is no number here"."""
    neighbours = chr(ord(name) - 1), chr(ord(name) + 1)
    with pytest.warns(qe.DoubtfulInput, match=f"^{name} is a variable here, no number$") as noted:
        assert qe.equivalent(qe.eliminate(f"ex x. x > 0 and {name}*x = 1"), f"{name} > 0")
    assert noted[0].filename == __file__
    assert noted_in(f"x^2 + 3{name} = 0") == [f"{name} is a variable here, no number"]
    for quiet in (f"ex {name}. {name}*x = 1", f"`{name}`*x = 1", *(f"{name}*x = {other}" for other in neighbours)):
        assert not noted_in(quiet), quiet
    with pytest.warns(qe.DoubtfulInput, match=f"{name} is a variable"):
        qe.minimize(f"({name} - 1)^2", "x >= 0")


def noted_in(given: object, format: str = "text") -> list[str]:
    """What is noted when this is read."""
    with warnings.catch_warnings(record=True) as noted:
        warnings.simplefilter("always")
        qe.eliminate(given, format=format)
    return [str(one.message) for one in noted if one.category is qe.DoubtfulInput]


@each(
    ("ex x. ax^2 + bx + c = 0", "text", "ax is read as the product a*x; bx is read as the product b*x"),
    ("all x. 2*ax² > b", "text", "ax is read as the product a*x"),
    ("ex x. x > 0 and ax = 1", "text", "ax is read as the product a*x"),
    ("ex x. x > 0 and ax = 2*x", "text", "ax is one name; a product is written a*x"),
    ("x^2 + kx + 9 >= 0 for all real x", "text", "kx is read as the product k*x"),
    ("ex x, y. a*x = 1", "text", "y does not occur"),
    ("a + b > ab", "text", "ab is read as the product a*b"),
    ("a + b > 2*ab", "text", "ab is one name; a product is written a*b"),
    (["a + b > 0", "ab = 1"], "text", "ab is read as the product a*b"),
    ("x^2 > k(x + 1)", "text", "k(…) is the product k*(…)"),
    ("all a. (ex x. a > 0)", "text", "x does not occur"),
    (["a > 0", "ex x. ax < 1"], "text", "ax is read as the product a*x"),
    ("ex x. b/ax > 0", "text", "x does not occur; did you mean a*x?"),
    (r"\exists x\colon a > 0", "latex", "x does not occur"),
    ("(E x)[a > 0]", "qepcad", "x does not occur"),
    ("ex({x}, a > 0)", "redlog", "x does not occur"),
    ("(declare-const a Real)(assert (exists ((x Real)) (> a 0)))", "smtlib", "x does not occur"),
    (qe.Exists(x, sp.Gt(b, 0)), "text", "x does not occur"),
    (qe.exists("x", qe.variables("b") > 0), "text", "x does not occur"),
)
def test_a_quantified_variable_that_does_not_occur_is_noted(given: object, format: str, note: str) -> None:
    """``ex x. ax^2 + bx + c = 0`` was answered by itself, at first without a word."""
    assert noted_in(given, format) == [note]


@each(
    ("∃x. ax^2 + bx + c > 0", "∃x. a*x^2 + b*x + c > 0"),
    ("exists x, y: xy = a and 2bx > 1", "exists x, y: x*y = a and 2*b*x > 1"),
    ("all x. sqrt(ax) <= b", "all x. sqrt(a*x) <= b"),
    ("ex x. x^2 + kx = 1", "ex x. x^2 + k*x = 1"),
    ("forall a, b, c > 0, a + b + c = 3 -> a*b*c <= d", "forall a, b, c > 0: a + b + c = 3 -> a*b*c <= d"),
    ("exists x > 0, y > 1, x + y = a", "exists x > 0: exists y > 1: x + y = a"),
    (r"\forall a,b > 0,\ a + b > c", "all a, b. a > 0 and b > 0 -> a + b > c"),
    ("x > 0 &and y > 0", "x > 0 and y > 0"),
    ("x^2 - 2mx + m + 2 > 0 for all x", "all x. x^2 - 2*m*x + m + 2 > 0"),
    ("2ax + ax > x and a > 1", "2*a*x + a*x > x and a > 1"),
    ("ex x. ax + 2x = 0", "ex x. a*x + 2*x = 0"),
    ("for all a, b with a > b, b > 0: a > c", "all a, b. a > b and b > 0 -> a > c"),
    ("ex x. A*x^2 + B < 0, where A = a + 1, B = 2*c", "ex x. (a + 1)*x^2 + 2*c < 0"),
    ("for all x: mx² + (m-1)x < 0", "for all x: m*x² + (m-1)*x < 0"),  # no sign of a product, all letters are names
    ("for all a, b, c > 0: ab + bc + ca <= abc", "for all a, b, c > 0: a*b + b*c + c*a <= a*b*c"),
    ("ex x, y. xy = x*y and xy > 1", "ex x, y. `xy` = x*y and `xy` > 1"),
    ("ex x, y, xy. xy > x + y", "ex x, y, `xy`. `xy` > x + y"),
    ("{ x ∈ ℝ | x² < a }", "x^2 < a"),
    ("{x ∈ {1, 2} | |x| > a}", "x ∈ {1, 2} and |x| > a"),
    ("{(x, y) ∈ ℝ² : x < y, y < 1}", "x < y and y < 1"),
    (r"\{ x \in [0, 1] \mid x^2 < a \}", "x ∈ [0, 1] and x^2 < a"),
    ("{x > 1 | x < a}", "x > 1 or x < a"),
    ("{x in {1, 2} || x > a}", "x in {1, 2} or x > a"),
    ("Reduce[2/3 a + 1/2 b > 0]", "4*a + 3*b > 0"),
    ("∃!x: x^2 = a", "exactly 1 x. x^2 = a"),
    (r"\exists! x: x^2 = a", "exactly 1 x. x^2 = a"),
    (r"x ∈ ℝ\{0}", "x /= 0"),
    (r"\forall a,b,c \geq 0 \;\; a+b+c \geq d", "all a, b, c. a >= 0 and b >= 0 and c >= 0 -> a + b + c >= d"),
    (r"\forall x\in[0,1]\quad x>a", "all x in [0, 1]: x > a"),
    (r"a + b + c \ge d \quad \forall a,b,c", "all a, b, c. a + b + c >= d"),
    ("D > 0 and d > 0\nwhere D = b^2 - 4*a*c", "b^2 - 4*a*c > 0 and d > 0"),
    ("forall positive a, b: a + b > c", "forall a, b > 0: a + b > c"),
    ("a*b > c for all nonnegative real numbers a and b", "all a, b. a >= 0 and b >= 0 -> a*b > c"),
    ("all negative x. ex nonzero y. x*y = a", "all x. x < 0 -> (ex y. y /= 0 and x*y = a)"),
    ("there is a positive x with x^2 = a", "ex x. x > 0 and x^2 = a"),
    ("ex positive. positive > a", "ex positive. a < positive"),
    ("for any real numbers x and y, x^2 + a >= axy", "all x, y. x^2 + a >= a*x*y"),
    ("for all x > 0 and y > 0, x + y > a", "all x. x > 0 -> (all y. y > 0 -> x + y > a)"),
    ("ex x. x > 0 and x < a", "ex x. (x > 0 and x < a)"),
    ("(a + b)^2 >= 4ab + c for all real a, b", "all a, b. (a + b)^2 >= 4*a*b + c"),
    ("x + y > a for all x, y > 0", "all x, y. x > 0 and y > 0 -> x + y > a"),
    ("exists t: x = t^2, y = t^3", "ex t. x = t^2 and y = t^3"),
    ("exists t > 0: x = t, y = t^2", "ex t. t > 0 and x = t and y = t^2"),
    ("x + y > a, for all x > 0, y > 0", "all x. x > 0 -> (all y. y > 0 -> x + y > a)"),
    ("a > 0, for all x, x^2 > b", "a > 0 and (all x. x^2 > b)"),
    ("exists 0 < x < 1 with x^2 = a", "ex x. 0 < x < 1 and x^2 = a"),
    ("for all -1 <= x <= 1: x^2 <= a", "all x. -1 <= x <= 1 -> x^2 <= a"),
    ("if x > 0 then x^2 > a", "x > 0 -> x^2 > a"),
    ("all x. (If x > 2 then x^2 > a) and x^2 >= 0", "all x. (x > 2 -> x^2 > a) and x^2 >= 0"),
    ("x^2 = a; x > 0;", "x^2 = a and x > 0"),
    ("∀x∃y y^2 > a*x", "all x. ex y. y^2 > a*x"),
    ("ex x y x*y = a", "ex x, y. x*y = a"),
    ("given any x, there is some y with y^2 = x + a", "all x. ex y. y^2 = x + a"),
    ("(∀x∈R)(∃y∈[0, 1]) y > a*x", "all x. ex y in [0, 1]. y > a*x"),
    ("(∀x > 0)(x > a) -> a > 1", "(all x. x > 0 -> x > a) -> a > 1"),
    ("not (∃x ∈ R)[x^2 = a] and a < 5", "not (ex x. x^2 = a) and a < 5"),
    (r"(\forall x \in \mathbb{R})(\exists y > 0)\; y > x + a", "all x. ex y. y > 0 and y > x + a"),
    (r"\exists x \, . \, x^2 = a", "ex x. x^2 = a"),
    ("pi^2 >= a for all pi", "all pi. pi^2 >= a"),
    ("And(forall a > 0, b > 0, c > 0)", "(forall a > 0: b > 0) and c > 0"),  # commas of the call
)
def test_what_was_refused_or_answered_by_itself_is_read_as_it_is_meant(typed: str, meant: str) -> None:
    """Products with a bound variable; bounds that a comma ends; ``&and``; sets of points, whose bar was read as or."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert text.read(typed) == text.read(meant)


@each(
    "exists y > 0, y > 1, x > 2",  # no further variable
    r"\forall a > 0, b > 0, c > 0",
    "y^2 + c = 0 has two roots",
    "x >= 0 if a > 0 else x <= 0",
    "x > 1 where x > 0",
    r"1 \le 0 \; a + b",
    r"f(x) \ge 0",
    "2/3 a > 1",
    "{(x, y) ∈ ℝ³ : x < y}",
    "x > 1 where x = a",  # a definition, or one more condition
)
def test_what_may_mean_two_things_is_refused_in_one_line(typed: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        text.read(typed)
    assert "\n" not in str(caught.value)


def test_terms_of_sympy_in_a_list_are_zero() -> None:
    """``qe.solve([x*y - 1, y*z])``, as it is given to ``nonlinsolve``, was refused."""
    assert qe.equivalent([x * y - 1, y * b], "x*y = 1 and b = 0")
    for odd in (x, sp.Integer(3), [x, y > 0]):
        with pytest.raises(qe.InputError, match="Boolean combination"):
            qe.eliminate(odd)


@each("rlqe ex(x, x**2 = a);", "(declare-const a Real)(assert (exists ((x Real)) (= (* x x) a)))")
def test_commands_of_other_systems_are_read_as_such(typed: str) -> None:
    assert qe.equivalent(typed, "a >= 0")


@each(("x + y = 3, xy = 2", "x = 1 and y = 2 or\nx = 2 and y = 1"), ("xy = x*y and x = 1", "x = 1 and y = `xy`"))
def test_a_product_of_variables_that_are_solved_for_needs_no_sign(typed: str, said: str) -> None:
    assert str(qe.solve(typed)) == said
    assert qe.find("x + y = 3, xy = 2 and x < y") == [{"x": 1, "y": 2}]


@each(
    (qe.minimize, "minimize x^2 + y^2 s.t. x + y = 1, x >= 0", "1/2"),
    (qe.maximize, "x*y subject to x + y <= 1, x, y >= 0", "1/4"),
    (qe.maximize, "MaxValue[{x, x^3 <= 2}, x]", "cbrt(2)"),
    (qe.minimize, "x + 1/x for x > 0", "2"),
    (qe.minimize, "find the minimum of x^2 + 2/x where x > 0", "3"),
    (qe.minimize, "minimum value of x^2 + 1", "1"),
    (qe.minimize, "min -x for x in [1, 2]", "-2"),
    (qe.maximize, "min(x, 1 - x)", "1/2"),
    (qe.maximize, "max(x, y) such that x^2 + y^2 = 1", "1"),
)
def test_an_optimum_is_asked_for_in_words(door, asked: str, value: str) -> None:
    assert f"({value} at " in repr(door(asked))
    with pytest.raises(qe.InputError, match="greatest"):
        qe.maximize("Minimise x subject to x > 1")


def test_terms_of_z3_are_minimised() -> None:
    v, w = pytest.importorskip("z3").Reals("v w")
    assert qe.minimize(w, w == (v - 3) * (v - 3) + 8).value == 8


@each(
    "ex x. a*x^2 + b*x + c = 0",
    "ex x. x - x + a = 0",
    "ex x in Reals. a*x > 0 and amax > 1",
    "ex x. x^2 = x1 and xmax > tax",
    "ex x, ax. x^2 = ax",
    r"\exists x\colon ax^2 + bx + c = 0",
    "all x. (ex x. x > a) -> x < b",
)
def test_nothing_is_noted_where_all_occur(given: str) -> None:
    assert noted_in(given) == []


@each(("a + b", "a > 0 and b > 0 and ab = 1", 2), ("a^2 + b^2 - ab", ["a >= 1", "b >= 1"], 1))
def test_a_product_without_a_sign_is_read_where_a_term_is_optimised(
    term: str, given: str | list[str], value: int
) -> None:
    """The least value of ``a + b`` under ``ab = 1`` was 0."""
    with pytest.warns(qe.DoubtfulInput, match=r"ab is read as the product a\*b"):
        assert qe.minimize(term, given).value == value


@each(("6", True), ("5", False))
def test_letters_side_by_side_are_read_alike_at_every_door(product: str, holds: bool) -> None:
    """``a = 2, b = 3, ab = 5`` had solutions for ``eliminate`` and ``decide``, and none for ``solve`` and ``find``."""
    typed = f"a = 2, b = 3, ab = {product}"
    with pytest.warns(qe.DoubtfulInput, match=r"ab is read as the product a\*b"):
        found = (
            str(qe.eliminate(typed)) != "false",
            qe.decide(f"exists a, b: {typed.replace(',', ' and')}"),
            qe.find_instance(typed) is not None,
            bool(qe.find(typed)),
            str(qe.solve(typed)) != "false",
            bool(qe.solve(typed, "a, b")),
            not qe.region(typed).is_empty,
            qe.minimize("a", typed).value is not None,
            qe.minimize("ab", "a = 2, b = 3").value == int(product),
            qe.equivalent(f"ab = {product}", "a = a and b = b", assuming="a = 2, b = 3"),
            qe.decide(f"ab = {product}", assuming="a = 2 and b = 3"),
        )
    assert found == (holds,) * len(found)


def test_names_that_are_quantified_or_listed_are_no_products() -> None:
    assert str(qe.eliminate("ex ab. ab = a + b and ab > 0")) == "a + b > 0"
    assert str(qe.solve("ab = a + b", "ab")) == "`ab` = a + b"
    with pytest.raises(qe.InputError, match="write `ab` there"):
        qe.decide("all a, b: a + b > ab and (ex ab. ab > 0)")
    with pytest.warns(qe.DoubtfulInput, match=r"ax is read as the product a\*x"):
        assert str(qe.solve("ax = b and a > 0", "x")) == "a > 0 and x = b/a"


def test_a_comma_in_an_order_is_no_variable() -> None:
    disc = "x^2 + y^2 <= 1"
    assert qe.region(disc, order="y,x").order == qe.region(disc, order="y x").order == ("y", "x")
    assert qe.region(disc, order=(y, x)).order == ("y", "x")
    for wrong in ("y,,x", {"x", "y"}, {"x": 1, "y": 2}, 5, ["x", 5], b"xy"):
        with pytest.raises(qe.InputError, match="order"):
            qe.region(disc, order=wrong)


def test_an_objective_may_use_any_name() -> None:
    """A name that the reader used for itself was lost from the objective."""
    best = qe.minimize("polynomial_value^2 - 2*polynomial_value", "polynomial_value <= 5")
    assert best.value == -1 and best.point == {"polynomial_value": 1}
    with pytest.raises(qe.InputError, match=":1:5"):
        qe.minimize("x + ) 1")


# --- truth --------------------------------------------------------------------------------------------------
def test_an_answer_has_no_truth_value() -> None:
    answer = qe.eliminate("ex x. x^2 < 0")
    assert answer.truth is False
    for ask in (bool, lambda a: a and 1, lambda a: not a, lambda a: 1 if a else 0):
        with pytest.raises(TypeError, match=r"qe\.decide"):
            ask(answer)
    assert issubclass(qe.NoTruthValue, qe.InputError)


@each(lambda: qe.Exists(x, x**2 == b), lambda: qe.ForAll(x, x != x), lambda: qe.decide(True))
def test_the_comparison_of_expressions_is_no_formula(make) -> None:
    with pytest.raises(qe.InputError, match="Eq"):
        make()


# --- names --------------------------------------------------------------------------------------------------
@each("x!0", "d.g", "$in", "a b", "x^*", "a + b", "1", "`", "ä\u0301", "a\nb")
def test_a_witness_for_a_variable_with_an_odd_name(name: str) -> None:
    script = f"(declare-const |{name}| Real)(assert (= (* |{name}| |{name}|) 2))(assert (> |{name}| 0))"
    found = qe.find_instance(script, format="smtlib")
    assert found is not None and found[name] == root2
    assert qe.decide(qe.Exists(sp.Symbol(name), sp.Eq(sp.Symbol(name) ** 2, 2)))


def test_certificates_of_plain_names_are_as_they_were() -> None:
    """Written before names could be quoted: words of the syntax and letters of any script stood as they are."""
    ring = Ring.of(("and", "e", "x²", "y'", "_1"))
    for written in ("and^2 - 3*e", "x²^2*y' + 7", "-and*e*_1 + x² - 1", "0", "-5"):
        assert poly_to_text(parse_poly(written, ring)) == written
    named = atom(Ring.of(("pi",)).gen(0) ** 2 - 2, Relation.EQ)
    old = qe.Certificate.witness(named, ["pi"], [Fraction(1)])
    assert qe.verify(old).step == "payload.steps[0].evidence.values"


def test_line_breaks_keep_symbols_apart() -> None:
    """``|a b|`` and ``|a`` newline ``b|`` were one variable: the inner quantifier hid the outer one."""
    script = "(assert (exists ((|a b| Real)) (forall ((|a\nb| Real)) (= |a b| |a\nb|))))"
    assert qe.decide(script, format="smtlib") is False


# --- SymPy --------------------------------------------------------------------------------------------------
def test_numbers_go_to_sympy_exactly() -> None:
    assert sp.sympify(root2) == sp.sqrt(2)
    assert root2 + sp.sqrt(2) == sp.sqrt(2) + root2 == 2 * sp.sqrt(2)
    assert sp.sqrt(2) - root2 == root2 - sp.sqrt(2) == 0
    assert root2 * sp.sqrt(2) == 2 and root2 / sp.sqrt(2) == 1 and sp.sqrt(2) / root2 == 1
    assert root2 == sp.sqrt(2) and sp.sqrt(2) == root2 and bool(root2 < sp.sqrt(3))
    cubic = qe.RealAlgebraic.from_root([1, -10, 0, 1], 0, 1)
    assert sp.sympify(cubic) == sp.CRootOf(x**3 - 10 * x + 1, 1)
    assert isinstance(root2 + x, sp.Expr) and (root2 + x).subs(x, 0) == sp.sqrt(2)
    field = NumberField(root2)
    assert sp.sympify(field.generator() + 1) == 1 + sp.sqrt(2)
    assert root2 == field.generator() and root2 + field.generator() == 2 * root2


def test_numbers_of_sympy_are_coordinates() -> None:
    disc = qe.region("x^2 <= 2")
    inside, outside = sp.sqrt(2), sp.sqrt(2) + sp.Rational(1, 10**40)
    assert disc.contains({x: inside}) and not disc.contains({x: outside})
    assert disc.contains({x: root2 + sp.sqrt(3) - sp.sqrt(3)}) and disc.contains({x: sp.CRootOf(x**3 - 2, 0)})
    assert disc.contains({x: Decimal("1.4")}) and not disc.contains({x: sp.Float("1.5")})
    for wrong in (sp.pi, sp.oo, sp.I, x, sp.sqrt(2) * 1.0, Decimal("1e999999999"), sp.nan):
        with pytest.raises(qe.InputError, match="exact number"):
            disc.contains({x: wrong})


def test_formulas_and_answers_go_to_sympy() -> None:
    answer = qe.eliminate("ex x. x^2 + b*x + c = 0")
    c = sp.Symbol("c")
    assert sp.sympify(answer) == sp.sympify(answer.formula)
    assert sp.And(answer, x > 0).free_symbols == {b, c, x}
    assert sp.sympify(answer).subs({b: 3, c: 2}) is sp.true
    assert qe.equivalent(sp.sympify(answer), answer)
    solvable = qe.Exists(x, sp.Eq(x**2 + b * x + c, 0))
    assert qe.decide(qe.ForAll([b, c], (~solvable | answer) & (solvable | ~sp.sympify(answer))))


def test_a_float_of_sympy_is_the_decimal_that_it_prints() -> None:
    assert qe.decide(qe.Exists(x, sp.Eq(10 * x, 1) & sp.Eq(x, 0.1)))
    assert qe.minimize(0.1 * x, x >= 3).value == sp.Rational(3, 10)


# --- wrong values -------------------------------------------------------------------------------------------
@each(
    ("10^400*x", "x >= 1", 10**400),
    ("x", "10^400*x >= 1", Fraction(1, 10**400)),
    ("x", "x >= 10^400", 10**400),
    ("x^2/10^400", "x >= 1", Fraction(1, 10**400)),
    ("x^2", "10^400*x^2 <= 1 and x >= -1", 0),
)
def test_coefficients_that_no_float_holds(objective: str, constraints: str, value: Fraction) -> None:
    """They ended in an OverflowError; what no proof is found for is said to be so."""
    try:
        assert qe.minimize(objective, constraints).value == value
    except qe.Unable as error:
        assert "could" in str(error) or "numerical method" in str(error)


def test_parametric_witnesses_of_a_body_that_is_a_constant() -> None:
    (anything,) = qe.parametric_witnesses("ex x. ex y. y^2 = x^2 and x^2 >= 0")
    assert set(anything.at({})) == {"x", "y"}
    assert qe.parametric_witnesses("all x. (ex y. y > x)") == ()
    assert qe.parametric_witnesses("ex x. (all y. y > x)") == ()
    (refuting,) = qe.parametric_witnesses("all x. (all y. y > x)")
    assert str(refuting.guard) == "true"


@each(
    ("ex x. x = x", [{"x": 0}]),
    ("ex x, y. x^2 >= x^2 - 1", [{"x": 0, "y": 0}]),
    ("ex x. x < x", []),
    ("all x. x = x", []),
    ("all x. x < x", [{"x": 0}]),
    (qe.Exists(x, sp.Eq(x, x)), [{"x": 0}]),
    (qe.ForAll([x, y], sp.false), [{"x": 0, "y": 0}]),
)
def test_parametric_witnesses_of_a_block_that_reading_folds(block: object, found: list[dict[str, int]]) -> None:
    assert [w.at({}) for w in qe.parametric_witnesses(block)] == found


def test_a_witness_in_a_root_atom() -> None:
    assert qe.check_witness("ex y. y > root(1, y^2-2)", {"y": "3"}) is True
    assert qe.check_witness("ex y. y > root(1, y^2-2)", {"y": "-3"}) is False
    assert qe.check_witness("all x. ex y. y > root(1, y^3 - x)", {"y": "x^2 + x + 1"}) is True


def test_a_witness_where_a_name_is_quantified_twice() -> None:
    assert qe.check_witness("all x. (ex y. y > x) and (ex y. y < x)", {"y": "x + 1"}) is True


def test_a_certificate_made_by_hand_is_rejected_not_a_crash() -> None:
    for wrong in (qe.Certificate("cells", {}), qe.Certificate("x", 5), qe.Certificate(None, (1, 2))):  # type: ignore
        assert not qe.verify(wrong).accepted
    with pytest.raises(qe.CertificateRejected):
        qe.Certificate.from_json(json.dumps({"format": "bezier-qe certificate", "version": 3}))


@each(
    (1, "written before bezier-qe 0.2"),
    (2, "written before bezier-qe 0.2"),
    (4, "version 3 is expected"),
    (True, "True"),
)
def test_certificates_of_former_versions_are_refused_in_one_line(version: object, said: str) -> None:
    with pytest.raises(qe.InputError, match=said):
        qe.Certificate.from_json(json.dumps({"format": "bezier-qe certificate", "version": version}))


def test_letters_side_by_side_are_told_to_be_one_name() -> None:
    noted = pytest.warns(qe.DoubtfulInput, match=r"abc is one name; a product is written a\*b\*c")
    with noted, pytest.raises(qe.InputError, match=r"free: abc \(all abc"):
        qe.decide("all a, b > 0. abc = 1 -> a + 2*b >= 2")
    with pytest.raises(qe.InputError, match=r"free: area "):
        qe.decide("all a, r. area = a*r")


# --- points and their names ---------------------------------------------------------------------------------
def test_a_point_with_an_unknown_name_is_refused() -> None:
    """``{"x": 1, "y": 0, "z": 3}`` was in the disc: z was left out without a word."""
    disc = qe.region("x^2 + y^2 <= 4")
    for ask in (disc.contains, disc.distance):
        with pytest.raises(qe.InputError, match="values for x, y expected, z found"):
            ask({"x": 1, "y": 0, "z": 3})
        ask({"x": 1, "y": 0})


@each("z > 1 and x = 2 and y < x", "x in [a, b] and b > a", "1/z > y and sqrt(x) < y")
def test_an_instance_has_the_names_in_the_order_of_the_question(given: str) -> None:
    """The ends of an interval came before the variable that lies in it."""
    found = qe.find_instance(given)
    assert found is not None and [*found] == [*dict.fromkeys(re.findall(r"\b[abxyz]\b", given))]
    assert all([*point] == [*found] for point in qe.find_instances(given, 2))


# --- letters side by side, once more --------------------------------------------------------------------------
@each(
    (r"(E ab)[ab > a /\ b < 0]", "ex `ab`. `ab` > a and b < 0"),  # was a*b > a, without a note
    ("Exists[{ab}, ab > a && b < 0]", "ex `ab`. `ab` > a and b < 0"),  # these were refused: unexpected '*'
    ("{(ab, a) | ab > a and b < 0}", "`ab` > a and b < 0"),
    ("Reduce[ab > 0 && a > 0 && b < 0, ab, Reals]", "`ab` > 0 and a > 0 and b < 0"),
    ("1/ab > 1 and ab < a + b", "1/`ab` > 1 and `ab` < a + b"),  # the second one was a*b
    ("√ab > a + b", "√`ab` > a + b"),  # was √a*b
    ("all a. -b^2 + 2alpha >= 1", "all a. -b^2 + 2*`alpha` >= 1"),  # was 2*a*l*p*h*a
    ("(E x)[ax > 0 and b = 1]", "ex x. a*x > 0 and b = 1"),  # ax was a name here, and a product behind "ex x."
    (r"\exists \mathrm{let}, \mathrm{bx}\colon \mathrm{let} < \mathrm{bx}", "ex `let`, `bx`. `let` < `bx`"),
)
def test_a_word_is_read_in_one_way_in_a_text(typed: str, meant: str) -> None:
    assert str(text.read(typed)) == str(text.read(meant))


@each("(A x)(x + 1) > 0", "(A x)((x + 1)(x + 2)) > (0)")
def test_what_may_be_a_quantifier_or_a_product_is_refused(typed: str) -> None:
    with pytest.raises(qe.ParseError, match="a quantifier or a product"):
        text.read(typed)


@each(
    ("ex x. x = 1 and ab < 0 and a = 1 and b = 1", ["ab is read as the product a*b"]),  # false: nothing was noted
    ("x^2 + px + q = 0", ["px is one name; a product is written p*x"]),
    ("b^2 > 4ac", ["ac is one name; a product is written a*c"]),
    ("`ab` > a + b", []),  # as it is said to be written
)
def test_notes_say_what_was_read(typed: str, notes: list[str]) -> None:
    assert noted_in(typed) == notes


def test_names_of_mathematica_are_names_in_its_optima() -> None:
    """``Minimize[{ab, …}, {ab, a, b}]`` was about the product of a and b."""
    best = qe.minimize("Minimize[{ab, a >= 1, b >= 1, ab >= -3}, {ab, a, b}]")
    assert best.value == -3 and best.point["ab"] == -3


@each(
    ("x^3 - 3x + c has three real roots", "exactly three x. x^3 - 3*x + c = 0"),
    ("for which m does x^2 - 2mx + m = 0 have two solutions?", "exactly two x. x^2 - 2*m*x + m = 0"),
    ("the equation x^2 = c has at most one solution", "at most one x. x^2 = c"),
    ("y^2 + c has no real root in y", "not ex y. y^2 + c = 0"),
    ("find all m such that x^2 + m x + 1 > 0 for all x", "all x. x^2 + m*x + 1 > 0"),
    ("solve x^2 = 2", "x^2 = 2"),
    ("prove that x^2 + 1 > y", "all x, y. x^2 + 1 > y"),
    ("is it true that all x. x^2 >= 0?", "all x. x^2 >= 0"),
    ("for which a is x^2 + a > 0 for all x?", "all x. x^2 + a > 0"),
)
def test_questions_in_words(typed: str, meant: str) -> None:
    """They were refused. What is read is noted."""
    assert text.read(typed) == text.read(meant)
    assert noted_in(typed)[0].startswith("read as ")


@each(
    "y^2 + c has two roots",
    "x + y < z has two solutions",
    "prove in [0, 1] and find x > 1",
    "for all x is x",
)
def test_questions_that_are_not_clear_are_refused(typed: str) -> None:
    with pytest.raises(qe.ParseError):
        text.read(typed)


def test_solutions_for_what_is_asked() -> None:
    assert str(qe.solve("for which m does x^2 - 2mx + m = 0 have a solution?")) == "m <= 0 or\nm >= 1"


@each(("1 - 2", "false"), ("0*x", "true"), ("3/2, 1/2", "false"))
def test_witnesses_said_that_terms_alone_end_too_early(typed: str, truth: str) -> None:
    """They are equations with zero for all doors."""
    with pytest.raises(qe.InputError, match=f"the formula is {truth} as it stands"):
        qe.witnesses(typed)


def test_words_in_the_bracket_of_a_quantifier_were_taken_apart_for_ever() -> None:
    """Every way to cut them into names was tried: 2^n of them."""
    begun = time.perf_counter()
    with pytest.raises(qe.ParseError):
        text.read("ForAll(of all the values of k for which the straight line intersects the parabola")
    assert time.perf_counter() - begun < 5

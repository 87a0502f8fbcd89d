"""From surface trees to formulas: functions, chains, case distinctions."""

from fractions import Fraction
from itertools import product

import pytest

import qe
from qe.errors import InputError
from qe.formula.evaluate import holds_at
from qe.formula.relation import Relation
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.io import surface as s
from qe.io.lowering import lower, lower_term
from qe.io.parser import FUNCTIONS, RELATIONS, TERM
from qe.io.text_parser import TextParser
from qe.io.total import Fill, Total
from tests.tables import each
from tests.unit.io.failing import fail


def meaning(text: str, **more: object) -> Formula:
    return lower(TextParser(text).whole(), fail, **more)  # type: ignore[arg-type]


def term(text: str) -> s.Term:
    found: s.Term = TextParser(text).whole(TERM)
    return found


@each(
    ("1/x > 0", lambda x: x != 0 and 1 / x > 0),
    ("not 1/x > 0", lambda x: not (x != 0 and 1 / x > 0)),
    ("1/x > 0 -> x > 1", lambda x: not (x != 0 and 1 / x > 0) or x > 1),
    ("x/x = 1", lambda x: x != 0),
    ("1/(1/x) = x", lambda x: x != 0),
    ("x^-2 >= 1/4", lambda x: x != 0 and 1 / x**2 >= Fraction(1, 4)),
    ("-infinity < 1/x < infinity", lambda x: x != 0),
    ("infinity > x", lambda x: True),
    ("x > infinity", lambda x: False),
    ("sign(x)*abs(x) = x", lambda x: True),
    ("max(x, 1/x) >= 1", lambda x: x != 0 and max(x, 1 / x) >= 1),
    ("min(x, 2, -x) = -2", lambda x: min(x, 2, -x) == -2),
    ("sqrt(x^2) = x", lambda x: x >= 0),
    ("sqrt(x) >= 1", lambda x: x >= 1),
    ("not sqrt(x) >= 1", lambda x: x < 1),
    ("(if x > 0 then 1/x else x) <= 1/2", lambda x: (1 / x if x > 0 else x) <= Fraction(1, 2)),
    ("1 < x <-> x < 2", lambda x: (x > 1) == (x < 2)),
    ("0 < x < 2 < 3", lambda x: 0 < x < 2),
)
def test_comparisons_are_true_where_both_sides_have_a_value(text: str, holds: object) -> None:
    formula = meaning(text)
    assert formula.is_quantifier_free
    for x in map(Fraction, ("-4", "-2", "-1/2", "0", "1/3", "1", "3/2", "2", "4", "9")):
        point = dict.fromkeys(formula.ring.names if formula.ring else (), x)
        assert holds_at(formula, point) == holds(x), x  # type: ignore[operator]


def test_roots_in_comparisons() -> None:
    assert str(meaning("x < root(2, x^2 - y)")) == "x < root(2, x^2 - y)"
    assert meaning("root(2, x^2 - y) > x") == meaning("x < root(2, x^2 - y)")
    assert str(meaning("y < root(1, 2*x - 6)")) == "y < 3"  # a number, since there is only x
    for text in ("x < root(0, x^2 - y)", "z < root(1, x^2 - y, z)", "x < root(1/2, x^2 - y)", "x < root(1, 1/x, x)"):
        with pytest.raises(InputError):
            meaning(text)


def test_infinity_is_a_whole_side() -> None:
    for text, at in (("x + infinity > 1", 4), ("infinity < -infinity", -1)):
        with pytest.raises(InputError, match="infinity"):
            meaning(text)
    assert meaning("x = infinity") == FALSE and meaning("x /= infinity") == TRUE


def test_names_of_the_ring() -> None:
    formula = meaning("ex y. y > b and a > y")
    assert formula.ring is not None and formula.ring.names == ("b", "a", "y")
    assert meaning("a > 0", names=["z", "a"]).ring.names == ("z", "a")  # type: ignore[union-attr]
    with pytest.raises(InputError, match="unknown variable b"):
        meaning("b > 0", names=["a"])
    taken = meaning("s1^(1/3) > s2")
    assert taken.ring is not None and taken.ring.names[:2] == ("s1", "s2") and "s3" in taken.ring.names


def test_shared_parts_are_lowered_once() -> None:
    """A chain of squares of length 40: without sharing there would be 2^40 parts."""
    parts: list[s.Part] = [s.Name("x", 0)]
    for _ in range(12):
        parts.append(s.Sum([parts[-1], parts[-1]]))  # type: ignore[list-item]
    last = s.Comparison([parts[-1], s.Number(2**12)], [Relation.EQ], 0)  # type: ignore[list-item]
    assert str(lower(last, fail, names=["x"], shared=parts[1:])) == "x = 1"
    nodes: list[s.Part] = [s.Comparison([s.Name("x", 0), s.Number(0)], [Relation.GT], 0)]
    for _ in range(150):
        nodes.append(s.Negation(nodes[-1]))  # type: ignore[arg-type]
    assert str(lower(nodes[-1], fail, names=["x"], shared=nodes)) == "x > 0"  # type: ignore[arg-type]


def test_terms_that_are_polynomials() -> None:
    value = lower_term(term("(x + 1)^2/4 - y*abs(-3)"), fail)
    assert value.den == 4 and value.poly.evaluate([1, 2]) == 4 - 24 and value.poly.ring.names == ("x", "y")
    for text in ("1/x", "sqrt(x)", "abs(x)"):
        with pytest.raises(InputError):
            lower_term(term(text), fail)


@each((Fill.ARGUMENT, "1/x = 1", "x = 0 or x = 1"))
def test_functions_that_are_total(fill: Fill, text: str, after: str) -> None:
    total = Total(fill=fill)
    formula = meaning(text, total=total)
    for x in (-1, 0, 1, 2):
        assert holds_at(formula, {"x": x}) == holds_at(meaning(after), {"x": x})


def test_unknown_values_agree_for_equal_arguments() -> None:
    """x/0 and y/0 are different unknowns, equal where x = y."""
    total = Total()
    formula = meaning("x/z = 1 and y/z = 2 and z = 0", total=total)
    assert len(total.values) == 2 and not total.weakened
    assert qe.equivalent(formula, "z = 0 and x /= y")


def name(letter: str, at: int) -> s.Name:
    return s.Name(letter, at)


@each(
    ("a + b - (c)", s.Sum([name("a", 0), name("b", 4), s.Minus(name("c", 9))])),
    ("a - (b - c)", s.Sum([name("a", 0), s.Minus(s.Sum([name("b", 5), s.Minus(name("c", 9))]))])),
    ("a*b/c", s.Quotient(s.Product(name("a", 0), name("b", 2), 1), name("c", 4), 3)),
    ("-a^2", s.Minus(s.Power(name("a", 1), s.Number(2), 2))),
    ("a^-2", s.Power(name("a", 0), s.Number(-2), 1)),
    ("--a", name("a", 2)),
    ("---a", s.Minus(name("a", 3))),
    ("+a", name("a", 1)),
    ("1.5e1", s.Number(Fraction(15))),
    ("Max(a, b, 1)", s.Apply("max", [name("a", 4), name("b", 7), s.Number(1)], 0)),
    ("sgn(a)", s.Apply("sign", [name("a", 4)], 0)),
    ("CubeRoot(a)", s.Apply("cbrt", [name("a", 9)], 0)),
    ("root(1, a, b)", s.Root(s.Number(1), name("a", 8), "b", 0)),
    ("Root(1, a)", s.Root(s.Number(1), name("a", 8), None, 0)),
)
def test_terms(text: str, tree: s.Term) -> None:
    assert term(text) == tree


X, Y = s.Comparison([name("x", 0), s.Number(0)], [Relation.GT], 2), s.Truth(True)


@each(
    ("x > 0 and true and false", s.Every([X, Y, s.Truth(False)])),
    ("x > 0 or true or false", s.Some([X, Y, s.Truth(False)])),
    ("x > 0 -> true -> false", s.Implication(X, s.Implication(Y, s.Truth(False)))),
    ("x > 0 <-> true <-> false", s.Equivalence(s.Equivalence(X, Y), s.Truth(False))),
    ("not true", s.Negation(Y)),
    ("not not true", Y),
    ("not not not true", s.Negation(Y)),
    (
        "x > 0 <= y",
        s.Comparison([name("x", 0), s.Number(0), name("y", 9)], [Relation.GT, Relation.LE], 2),
    ),
    ("ex x, y. true", s.Quantification(False, ["x", "y"], Y)),
)
def test_formulas(text: str, tree: s.Node) -> None:
    assert TextParser(text).whole() == tree


def test_all_spellings_of_relations_and_functions() -> None:
    spelled = {relation: {text for text, found in RELATIONS.items() if found is relation} for relation in Relation}
    assert {"=", "==", "Eq", "Equal"} <= spelled[Relation.EQ] and {"!=", "<>", "≠", "Ne"} <= spelled[Relation.NE]
    assert {"<", "Lt", "Less"} == spelled[Relation.LT] and {">", "Gt", "Greater"} == spelled[Relation.GT]
    assert {"<=", "=<", "≤", "⩽", "\\[LessEqual]", "Le", "LessEqual"} == spelled[Relation.LE]
    assert {"≥", "⩾", ">=", "Ge"} <= spelled[Relation.GE]
    assert set(FUNCTIONS.values()) == set(s.FUNCTIONS)


@pytest.mark.parametrize("count", range(1, 5))
def test_an_odd_number_of_parts_holds(count: int) -> None:
    parts: list[s.Node] = [s.Comparison([s.Name(f"x{k}", 0), s.Number(0)], [Relation.GT], 0) for k in range(count)]
    odd = s.connected("Xor", parts)
    assert odd is not None
    formula = lower(odd, lambda message, at: InputError(message))
    for signs in product((0, 1), repeat=count):
        assert holds_at(formula, {f"x{k}": sign for k, sign in enumerate(signs)}) == bool(sum(signs) % 2)


def test_the_functions_take_as_many_arguments_as_the_text_says() -> None:
    assert {name: ends for name, ends in s.FUNCTIONS.items() if ends != (1, 1)} == {"min": (1, 1000), "max": (1, 1000)}

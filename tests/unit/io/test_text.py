"""The text syntax: what it means, how it is printed, and what is said about mistakes."""

import pytest

from qe.errors import InputError, ParseError
from qe.exact.ring import Ring
from qe.formula.syntax import FALSE, TRUE, RootAtom
from qe.io.text import read, write
from tests.tables import each


@each(
    ("x>0", "x > 0"),
    ("x >= 1/2", "x >= 1/2"),
    ("1 <= x", "x >= 1"),
    ("y > x", "y > x"),
    ("0.75*x = 1.5e-3", "x = 1/500"),
    ("(x + 1)*(x - 1) /= 0", "x^2 /= 1"),
    ("(x - y)^3/3 < 0", "(x - y)^3 < 0"),
    ("-x^2 <= -4", "x^2 >= 4"),
    ("2*-x = --1", "x = -1/2"),
    ("x^0 = 1", "true"),
    ("x^abs(-2) = y^max(1, 3)", "y^3 = x^2"),
    ("1 < 0", "false"),
    ("x = x and y > 0", "y > 0"),
    ("0 < x <= 1", "0 < x <= 1"),
    ("x < 1 and x > 0 and x < y + 1 and x > y", "0 < x < 1 and 0 < x - y < 1"),
    ("x^2 + y^2 >= 1 and 2*x^2 + 2*y^2 <= 5", "1 <= x^2 + y^2 <= 5/2"),
    ("a >= 0 and a < b and a <= c", "0 <= a < b and a <= c"),
    ("3*x > 1 and 2*x <= 1 and x /= 0", "1/3 < x <= 1/2 and x /= 0"),
    ("x > 1 and x < 0", "x > 1 and x < 0"),
    ("x = 1 and y = 2 or z = 3", "x = 1 and y = 2 or z = 3"),
    ("x = 1 and (y = 2 or z = 3)", "x = 1 and (y = 2 or z = 3)"),
    ("x = 0 -> y = 0 -> z = 0", "x /= 0 or y /= 0 or z = 0"),
    ("(x = 0 -> y = 0) -> z = 0", "not (x /= 0 or y = 0) or z = 0"),
    ("x = 0 <-> y = 0", "(x /= 0 or y = 0) and (y /= 0 or x = 0)"),
    ("not x < 0", "x >= 0"),
    ("not not (x < 0 and y < 0)", "x < 0 and y < 0"),
    ("ex x, y. all z. x*y > z", "ex x, y. all z. z < x*y"),
    ("ex x. x > 0 and y > 0", "ex x. x > 0 and y > 0"),
    ("(ex x. x > 0) and y > 0", "(ex x. x > 0) and y > 0"),
    ("y > 0 and ex x. x > y", "y > 0 and ex x. y < x"),
    ("y > 0 and (ex x. x > y) or z > 0", "y > 0 and (ex x. y < x) or z > 0"),
    ("not ex x. x > y", "not ex x. y < x"),
    ("x > 0 and not (ex y. y > x) and x < 5", "x > 0 and not (ex y. x < y) and x < 5"),
    ("ex x. ex x. x = a", "ex x. a = x"),
    ("ex x, x. x = a", "ex x. a = x"),
    ("ex x. true", "true"),
    ("x < root(2, x^2 - y, x)", "x < root(2, x^2 - y)"),
    ("root(-1, y - x^2) >= x", "x <= root(-1, x^2 - y)"),
    ("not x = root(1, x^2 - y)", "not (x = root(1, x^2 - y))"),
    ("E + A > 0 and (E x. x > E)", "E + A > 0 and ex x. E < x"),
    ("A y, z. y > A + z", "all y, z. A + z < y"),
    ("x' + x'' = `my name`", "x' + x'' = `my name`"),
    ("`and` > `x`", "`and` > x"),
    ("`a\\`b` > `a\\u{a}b`", "`a\\`b` > `a\\u{a}b`"),
    ("`pi` > 3", "`pi` > 3"),
    ("ex e. e > 0 and x < e", "ex e. e > 0 and x < e"),
    ("ex e. e > 0 and x < e or i = 0", "ex e. e > 0 and x < e or i = 0"),
    ("`pi` = 0 or (ex pi. pi > x)", "`pi` = 0 or ex `pi`. `pi` > x"),
    ("x > Pi and π < y and `pi` < 2 ", "x > pi and y > pi and `pi` < 2"),
    ("x + E > I", "x + E > I"),
    ("∃x. x·y ≥ 1 ∧ ¬(x ≠ y)", "ex x. y*x >= 1 and y = x"),
    ("Ex u, v. (x-u*v = 0 /\\ ~(y = 0 \\/ z < 1))", "ex u, v. x = u*v and not (y = 0 or z < 1)"),
    ("All x. x != 1 ==> x /= 2 <==> true", "all x. x = 1 or x /= 2"),
    ("forall x. exists y. x < y # a comment\n and y > 0", "all x. ex y. x < y and y > 0"),
)
def test_meaning_and_printing(text: str, printed: str) -> None:
    formula = read(text)
    assert write(formula) == printed
    assert write(read(printed)) == printed


def test_lines_are_counted() -> None:
    with pytest.raises(ParseError) as caught:
        read("x = 1\n  and y >< 2")
    assert (caught.value.line, caught.value.column) == (2, 10)


def test_nesting_has_a_limit_and_says_so() -> None:
    assert write(read("(" * 500 + "x = 1" + ")" * 500)) == "x = 1"
    deep = "x = 1"
    for _ in range(200):
        deep = f"x = 2 or (y = 1 and ({deep}))"
    with pytest.raises(InputError, match="deep"):
        read(deep)


DIGITS = "1234567890" * 1000


@each(
    ("+".join(["x"] * 3000) + " = 0", "x = 0"),
    ("*".join(["x"] * 3000) + " = 0", "x^3000 = 0"),
    (" and ".join(f"x > {i}" for i in range(1, 1000)), " and ".join(f"x > {i}" for i in range(1, 1000))),
    (f"x = {DIGITS}", f"x = {DIGITS}"),
    (f"x = {DIGITS}.0", f"x = {DIGITS}"),
    ("ex x. x = y and (ex y. y > x)", "ex x. y = x and ex y. y > x"),  # free and bound
)
def test_long_inputs_are_not_deep_and_numbers_have_any_length(text: str, printed: str) -> None:
    assert write(read(text)) == printed


@each(
    ("ex x, y. x + b = y*a and (ex z. z > a)", "baxyz"),
    ("x > 0 and (ex y. ex x. x = y)", "xy"),
    ("x > root(3, x^3 - y*x)", "xy"),
)
def test_ring_order_is_free_then_bound(text: str, names: str) -> None:
    assert read(text).ring is Ring.of(tuple(names))


def test_constants_have_no_ring_and_root_atoms_their_number() -> None:
    assert read("true") is TRUE and read("x < x") is FALSE
    formula = read("x > root(3, x^3 - y*x)")
    assert isinstance(formula, RootAtom) and formula.k == 3 and formula.variable == "x"


def test_powers_that_would_not_fit_are_refused_before_they_are_computed() -> None:
    for text in ("((2*x + 1)^99)^99 = 0", "((7^10000)^10000)^10000 = x", "(123456789^9999*x)^9999 = 1"):
        with pytest.raises(ParseError):
            read(text)

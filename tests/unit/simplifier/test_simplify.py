"""The simplifier's rules, one example each; every pair is checked for equivalence by the property tests as well."""

from itertools import pairwise

from qe.formula.build import disj
from qe.formula.traverse import atoms
from qe.io.text import read
from qe.simplifier import simplify as module
from qe.simplifier.absorb import absorb
from qe.simplifier.simplify import simplify
from tests.tables import each


@each(
    # implied bounds: one polynomial up to a constant
    ("x^2 + y^2 - 4 <= 0 and x^2 + y^2 - 9 <= 0", "x^2 + y^2 - 4 <= 0"),
    ("x^2 + y^2 - 4 <= 0 or x^2 + y^2 - 9 <= 0", "x^2 + y^2 - 9 <= 0"),
    ("x > 0 and x /= 1 and x >= 1", "x > 1"),
    ("2*x > 1 and 3*x > 1", "2*x > 1"),
    ("x >= 0 and x <= 0", "x = 0"),
    ("x > 0 or x < 0", "x /= 0"),
    ("x > 0 and x < 0", "false"),
    ("x >= 0 or x < 1", "true"),
    # sign-definite polynomials
    ("x^2 + y^2 + 1 > 0", "true"),
    ("x^4 + y^2 < 0", "false"),
    ("x^2 + y^2 <= 0", "x = 0 and y = 0"),
    ("x^2 + y^2 > 0 or z > 1", "z > 1 or x /= 0 or y /= 0"),
    ("x^2 + y^2 - 2*y + 1 = 0 and x /= 0", "false"),
    ("x^4 + y^2*z^6 = 0", "x = 0 and y*z = 0"),
    ("x^2 - x + 1 > 0", "true"),
    ("x^2 + 2*x*y + 2*y^2 - 2*y + 1 < 0", "false"),
    # multiplicities and factors
    ("x^2*y < 0", "x /= 0 and y < 0"),
    ("x^2*y <= 0", "x = 0 or y <= 0"),
    ("x^3*y >= 0", "x*y >= 0"),
    ("x^3 = 0", "x = 0"),
    ("(x^2 + 1)*y > 0", "y > 0"),
    ("x > 0 and x*y < 0", "x > 0 and y < 0"),
    ("x < 0 and x*y < 0", "x < 0 and y > 0"),
    ("x*y /= 0 and z > 0", "z > 0 and x /= 0 and y /= 0"),
    # products of two that differ by a number
    ("(x^2 + y^2 - 1)*(x^2 + y^2 - 9) <= 0", "x^2 + y^2 - 9 <= 0 and x^2 + y^2 - 1 >= 0"),
    ("(x^2 + y^2 - 1)*(x^2 + y^2 - 9) > 0", "x^2 + y^2 - 9 > 0 or x^2 + y^2 - 1 < 0"),
    ("(x*y - 1)*(3 - x*y) >= 0", "x*y - 3 <= 0 and x*y - 1 >= 0"),
    ("(x - 1)*(x + 1) < 0", "x^2 - 1 < 0"),
    # variables with a known value
    ("x = 0 and x*y + z = 0 and (z > 1 or y + x < 0)", "x = 0 and z = 0 and y < 0"),
    ("x /= 2 or x*y > 0", "x /= 2 or y > 0"),
    # one variable: the order of the real roots
    ("m^2 - 8*m - 2 = 0 and m > 4 and 4*m^2 - 33*m - 4 < 0", "m^2 - 8*m - 2 = 0 and m > 4"),
    ("x^2 < 2 and x^2 - 4*x + 3 < 0 and x > 2", "false"),
    ("x^3 > 5 and x > 1", "x^3 > 5"),
    ("x^3 > 5 or x > 1", "x > 1"),
    ("x^2 >= 2 or x < 3/2", "true"),
    ("x > 0 and (x^3 > -1 or y > 0)", "x > 0"),
    ("x^5 - x - 1 = 0 and x > 0", "x^5 - x - 1 = 0"),
    # the implicit theory reaches into subformulas
    ("x > 1 and (x > 0 or y > 0)", "x > 1"),
    ("x > 1 and (x < 0 or y > 0)", "x > 1 and y > 0"),
    ("x > 0 and y > 0 and x + y > 0", "x > 0 and y > 0"),
    ("x >= 0 and y >= 0 and x*y > 0", "x > 0 and y > 0"),  # such a product may be zero
    ("x > 0 and ex y. (x*y > 0 and x > -1)", "x > 0 and ex y. y > 0"),
    # a bound variable is not the free one of the same name
    ("x > 1 and ex x. (x > 0 and y*x > 1)", "x > 1 and ex x. (x > 0 and x*y > 1)"),
    # absorption and merging
    ("x > 0 and y > 0 or x > 0 and y > 0 and z > 0", "x > 0 and y > 0"),
    ("x < 0 and y > z or x = 0 and y > z", "y > z and x <= 0"),
    # quantifiers over nothing
    ("ex x, y. x*z > 1", "ex x. x*z > 1"),
    ("not ex x. (x > 0 and (y < 0 or x >= 0))", "all x. x <= 0"),
)
def test_rule(given: str, expected: str) -> None:
    assert str(simplify(read(given))) == str(simplify(read(expected)))
    assert len(str(simplify(read(given)))) <= len(str(read(expected))) + 4


@each(
    ("x*y > 0", "x > 0 and y > 1", "true"),
    ("x*y > 0", "x > 0 and y < -1", "false"),
    ("x > 0", "y > 0", "x > 0"),
    ("x > y", "x > 0 and x < 0", "true"),  # contradictory assumptions allow everything
)
def test_assumptions_decide(text: str, given_: str, simple: str) -> None:
    assert simplify(read(text), read(given_)) == read(simple)


@each(
    "x > 1 and ex x. (x > 0 and x*y > 1)",  # the bound x is not the free one
    "x > 1 and ex x. (x < 0 and x + y > 0)",
    "x >= 0 and x + y >= 0 and y < 3",
    "x^2 - 2*x*y + y^2 + z <= 0",
    "p /= 0 and (p < 0 or q > 0)",  # was p <= 0
    "p /= 0 and (p > 0 or q > 0)",
)
def test_nothing_to_do(kept: str) -> None:
    given = read(kept)
    result = simplify(given)
    assert len(list(atoms(result))) == len(list(atoms(given)))
    assert str(result) == str(given)


def test_an_alternative_that_stands_twice_is_kept() -> None:
    """One node in two places was merged with itself and lost."""
    twice, other = read("a > 0 and b > 0"), read("a < 0 and c > 0")
    assert absorb([twice, twice, other], False, lambda parts, _: simplify(disj(parts))) == [twice, other]


def test_many_clauses_under_many_facts_are_not_each_asked_about_all_of_them(monkeypatch):
    """A job shop of 220 bounds and 1,900 clauses was simplified in the product of the two."""
    asked, said = [], module._said
    monkeypatch.setattr(module, "_said", lambda facts: asked.append(len(facts.ranges)) or said(facts))
    names = [f"x{k}" for k in range(40)]
    bounds = [f"{x} >= {k}" for k, x in enumerate(names)]
    clauses = [f"({x} - {y} >= 3 or {y} - {x} >= 2)" for x, y in pairwise(names)]
    body = read(" and ".join([*bounds, *clauses]))
    assert simplify(body) == body and 0 < sum(asked) < 10 * len(names)

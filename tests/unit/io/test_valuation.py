"""The values of terms: polynomials, quotients, roots and case distinctions, at points."""

from fractions import Fraction

import pytest

from qe.errors import InputError
from qe.exact.ring import Ring
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, Relation
from qe.io import cases, terms
from qe.io.auxiliaries import Place
from qe.io.parser import TERM
from qe.io.terms import TermError, Value
from qe.io.text_parser import TextParser
from qe.io.valuation import Valuation
from tests.tables import each
from tests.unit.io.failing import fail

RING = Ring.of(("x", "y", "s1", "s2", "s3"))


def made() -> Valuation:
    return Valuation(RING, fail, ("s1", "s2", "s3"), None, lambda node, place: TRUE)


def value(text: str, valuation: Valuation | None = None) -> object:
    return (valuation or made()).term(TextParser(text).whole(TERM))


@each(
    ("(x + y)^2/2", "x^2 + 2*x*y + y^2"),
    ("sqrt(4)*x", "2*x"),
    ("sqrt(9/4) + y", "2*y + 3"),
    ("abs(-5/3)", "5"),
    ("sign(-7)", "-1"),
    ("max(1, 2, 3) - min(4, 2)", "1"),
    ("x^0", "1"),
    ("root(2, x^2 - 4)", "2"),
    ("root(-1, x^2 - 4)", "2"),
    ("root(1, 2*x - 3)", "3"),
)
def test_polynomials(text: str, poly: str) -> None:
    found = value(text)
    assert isinstance(found, Value) and str(found.poly) == f"Poly({poly})"


@each(
    ("1/x + 1/y", lambda x, y: Fraction(1) / x + Fraction(1) / y),
    ("x/y/y", lambda x, y: Fraction(x) / y / y),
    ("(x/y)^-2", lambda x, y: Fraction(y) ** 2 / Fraction(x) ** 2),
    ("abs(x)*sign(y)", lambda x, y: abs(x) * ((y > 0) - (y < 0))),
    ("max(x, y, 0) - min(x, y)", lambda x, y: max(x, y, 0) - min(x, y)),
    ("sqrt(x^2)/y", lambda x, y: Fraction(abs(x)) / y),
    ("sqrt(x^2*y^4)", lambda x, y: abs(x) * y * y),
)
def test_quotients_and_cases(text: str, exact: object) -> None:
    valuation = made()
    found = value(text, valuation)
    for x in (-2, -1, 1, 3):
        for y in (-3, 1, 2):
            point = {"x": x, "y": y, "s1": 0, "s2": 0, "s3": 0}
            wanted = Fraction(exact(x, y))  # type: ignore[operator]
            right = cases.plain(terms.number(RING, wanted))
            same = valuation.compared(valuation.listed(found), Relation.EQ, right, Place())  # type: ignore[arg-type]
            assert holds_at(same, point), (x, y)


def test_square_roots_share_their_names() -> None:
    valuation = made()
    value("sqrt(x) + sqrt(y) + sqrt(x)*sqrt(4*x)", valuation)
    assert list(valuation.made) == ["s1", "s2"]
    value("cbrt(x)", valuation)
    assert list(valuation.made) == ["s1", "s2", "s3"]


@each(
    ("1/0", "division by zero"),
    ("x/(1 - 1)", "division by zero"),
    ("x^y", "an exponent must be a rational number"),
    ("x^(1/10001)", "a root of degree 10001"),
    ("root(x, x^2 - 2)", "the first argument of root is its number"),
    ("root(1/2, x^2 - 2)", "the first argument of root is its number"),
    ("root(1, x^2 - y)", "needs its variable"),
    ("root(0, x^2 - 2)", "counted from 1 or -1"),
    ("root(1, x^2 - 2, y)", "no such root"),
    ("root(1, 1/x, x)", "a polynomial expected"),
    ("z", "unknown variable z"),
    ("infinity + 1", "infinity is no number"),
)
def test_what_has_no_meaning(text: str, said: str) -> None:
    with pytest.raises((InputError, TermError), match=said):
        value(text)


def test_a_root_that_is_not_there_has_no_value() -> None:
    assert value("root(3, x^2 - 2)") == () and value("root(-3, x^2 - 2)") == () and value("root(1, x^2 + 1)") == ()
    assert value("sqrt(-1)") == ()

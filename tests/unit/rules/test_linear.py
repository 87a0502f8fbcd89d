"""Linear equations: which one is chosen, and that what is put in means the same at every point."""

from fractions import Fraction
from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.rules.linear import Pivot, choose_pivot, substitute
from qe.simplifier.facts import NOTHING
from tests.tables import each

RING = Ring.of(("a", "b", "x"))
A, B, X = (RING.gen(i) for i in range(3))
WIDER = Ring.of("abxyz")
VALUES = (Fraction(-2), Fraction(-1, 2), Fraction(1), Fraction(3))


def pivot_of(text: str, variables: str = "x", known: str = "") -> Pivot | None:
    facts = NOTHING.extended(conjuncts(convert(read(known), WIDER))) if known else NOTHING
    return choose_pivot(conjuncts(convert(read(text), WIDER)), variables.split(), lambda position: facts)


@each(
    ("a + 2*x = 1 and x^2 > b", 0, "x", 1, False),
    ("x^2 > b and b - 3*x = a", 1, "x", 1, False),
    ("a*x = b and x > 0", 0, "x", None, False),
    ("a*x = b and b > 0", 0, "x", None, True),
    ("a*x = b and x > 1 and 2*x = a", 2, "x", 1, False),
    ("(a^2 + 1)*x = b and x > 0", 0, "x", 1, False),
    ("(-a^2 - 1)*x = b and x > 0", 0, "x", 1, False),
)
def test_the_equation_that_is_chosen(text: str, position: int, name: str, sign: int | None, alone: bool) -> None:
    found = pivot_of(text)
    assert found is not None and (found.position, found.name, found.alone) == (position, name, alone)
    assert (found.sign == sign if sign is None else abs(found.sign or 0) == 1) and found.guarded == (
        sign is None and not alone
    )


def test_the_sign_of_a_constant_coefficient() -> None:
    for text, sign in (("x = 2*a and a^2 > b", -1), ("x + 2*a = 0 and a^2 > b", 1)):
        found = pivot_of(text, "a")
        assert found is not None and (found.name, found.sign) == ("a", sign)


def test_what_is_known_of_the_leading_coefficient() -> None:
    for known, sign in (("a > 0", 1), ("a < 0", -1), ("a /= 0", 0), ("a >= 0", None)):
        found = pivot_of("b = a*x and x > 1", known=known)
        assert found is not None and found.sign == sign and found.guarded == (sign is None)


@each("x^2 = a", "x > 1", "a*b = 1 and x > 0", "x^2 + x = a", "x /= a")
def test_no_equation(text: str) -> None:
    assert pivot_of(text) is None


def test_few_occurrences_are_cheap() -> None:
    found = pivot_of("x + y + z = 0 and x > 0 and x < 1 and x*y > 0 and z > y", "x y z")
    assert found is not None and found.name == "z"


POLYS = st.builds(
    lambda c: sum((k * m for k, m in zip(c, (X**2, A * X, X, B, RING.constant(1)), strict=True)), RING.constant(0)),
    st.lists(st.integers(-2, 2), min_size=5, max_size=5),
)


@given(POLYS.filter(lambda p: not p.is_constant), st.sampled_from(tuple(Relation)), st.sampled_from(("a", "b")))
def test_substitution_keeps_the_truth(poly, relation, name):
    """x = -rest/lead put in by hand, for every sign of the leading coefficient and for what is known of it."""
    lead, rest = (A, B - 1) if name == "a" else (B, A * 2 + 3)
    given_atom = Atom(poly, relation)
    for a, b in product(VALUES, repeat=2):
        point = (a, b, Fraction(0))
        low = lead.evaluate(point)
        x = -rest.evaluate(point) / low
        wanted = relation.holds((v := poly.evaluate((a, b, x))) and (1 if v > 0 else -1))
        for sign in (0, None, 1 if low > 0 else -1):
            found = substitute(given_atom, Pivot(0, 2, lead, rest, sign, False))
            assert found is not None and holds_at(found, {"a": a, "b": b, "x": Fraction(7)}) == wanted


def test_where_nothing_can_be_put_in() -> None:
    pivot = Pivot(0, 2, WIDER.gen(0), WIDER.gen(1), None, False)

    def put(text: str) -> Formula | None:
        return substitute(convert(read(text), WIDER), pivot)

    assert put("ex b. b > x") is None and put("all b. b > a") is not None
    assert str(put("ex x. x > a")) == "ex x. a < x"
    assert str(put("not (x > 0 and b > 0)")) == "not (a*b < 0 and b > 0)"
    assert str(put("ex y. y > x")) == "ex y. a*(a*y + b) > 0" and str(put("all y. y > x")) == "all y. a*(a*y + b) > 0"
    assert str(put("true")) == "true" and put("a < root(1, a^3 - x)") is None
    assert put("x < root(1, x^3 - 2)") is None and put("a < root(1, a^3 - b)") is not None


@each("x^2 > b and x < root(1, x^2 - a)", "b > 0 or x < root(1, x^2 - a)")
def test_one_part_in_which_nothing_can_be_put_is_enough_to_leave_all(text: str) -> None:
    found = pivot_of("2*x = b and x > a")
    assert found is not None and substitute(convert(read(text), WIDER), found) is None

"""Multiples of equations subtracted where products remain: what changes, and what must not."""

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import And, Atom, Formula, Relation
from qe.formula.traverse import atoms
from qe.io.text import read
from qe.rules.cancelling import cancel_by, difference
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from qe.simplifier.facts import factor_list
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("p", "q", "x", "y"))
P, Q, X, Y = (RING.gen(i) for i in range(4))
CUBIC = X**3 + P * X + Q
ONLY = frozenset({StepKind.CANCELLING})


def sentence(text: str) -> Formula:
    return prepare(read(text), enabled=ONLY).formula


@each(
    (Y**3 + P * Y + Q, CUBIC, (Y - X) * (Y**2 + X * Y + X**2 + P)),
    (-2 * (Y**3 + P * Y + Q), CUBIC, -2 * (Y - X) * (Y**2 + X * Y + X**2 + P)),
    (2 * (Y**3 + P * Y + Q), -3 * CUBIC, 6 * (Y - X) * (Y**2 + X * Y + X**2 + P)),
    (CUBIC, CUBIC, None),  # itself
    (Y**3 + P * Y + 2 * Q, CUBIC, None),  # no product remains
    (Y**3 + P * Y + Q + X, CUBIC, None),  # not as many terms, and only one in common
    (Y**2 + P * Y, X**2 + P * X, None),  # no term in common
    (Y**2 + X**2 - 1, (X - 1) ** 2 + Y**2 - 1, None),  # one factor is left: nothing to split
    (X**2 - Y**2, X**2 - Y**2 - P * Q, None),  # a product already
    (X + P + Q, X**3 + P + Q, None),  # the equation has a higher degree
)
def test_differences(poly: Poly, equation: Poly, found: Poly | None) -> None:
    known = difference(poly, equation)
    assert (None if known is None else known[2]) == found
    if known is not None:
        a, b, rest = known
        assert a > 0
        assert a * poly - b * equation == rest


@given(polynomials(RING, max_degree=2), polynomials(RING, max_degree=2), polynomials(RING, max_degree=3))
def test_differences_are_what_they_say(left: Poly, right: Poly, equation: Poly) -> None:
    known = difference(left * right + equation, equation)
    if known is not None:
        a, b, rest = known
        assert a > 0
        assert a * (left * right + equation) - b * equation == rest
        assert all(f.total_degree < (left * right + equation).total_degree for f, _ in factor_list(rest))


def test_the_equation_stays() -> None:
    left = sentence("ex x, y. x^3 + p*x + q = 0 and y^3 + p*y + q <= 0 and y > 5")
    (equation,) = [a for a in atoms(left) if a.relation is Relation.EQ]
    assert equation.poly == CUBIC.convert(equation.poly.ring)
    (other,) = [a for a in atoms(left) if a.relation is Relation.LE]
    assert len(factor_list(other.poly)) == 2


def test_a_variable_that_is_bound_inside_is_another() -> None:
    """x of the equation is not the x that the inner block binds."""
    inner = read("all x. x^3 + p*x + q /= 0 or x*y > 1")
    (equation,) = atoms(read("x^3 + p*x + q = 0 and p < q").args[0])  # type: ignore[attr-defined]
    assert cancel_by((equation.poly,), inner) == inner


def test_each_equation_is_used_once() -> None:
    """Three equations of one pattern: the first one stays, and the others become products."""
    left = sentence("ex x, y, z. x^3 + p*x + q = 0 and y^3 + p*y + q = 0 and z^3 + p*z + q = 0 and x*y*z > 1")
    body = left.body  # type: ignore[attr-defined]
    assert isinstance(body, And)
    products = [a for a in body.args if isinstance(a, Atom) and len(factor_list(a.poly)) > 1]
    assert len(products) >= 2


QUESTIONS = (
    "ex x, y. x^3 + p*x + q = 0 and y^3 + p*y + q = 0 and x < y",
    "ex x. x^2 + p*x + q = 0 and (all y. y^2 + p*y + q /= 0 or y = x)",
    "ex x. x^4 + p*x^2 + q = 0 and x > 0 and (all y. y^4 + p*y^2 + q /= 0 or y = x or y = -x)",
    "all x, y. x^2 + p*x = q and y^2 + p*y = q -> x = y",
    "ex x, y. x^2 + p*x = 1 and y^2 + p*y < 1 and y > q",
)


@settings(deadline=None, max_examples=30)
@given(st.sampled_from(QUESTIONS), st.integers(-5, 5), st.integers(-5, 5))
def test_answers_are_those_of_decomposition(text: str, p: int, q: int) -> None:
    at = f"({text}) and p = {p} and q = {q}"
    closed = f"ex p, q. {at}"
    assert qe.decide(closed, process=False) is qe.decide(closed, method="cad", process=False)


def test_exactly_three_roots_of_an_even_quartic() -> None:
    """The shape of a question on circles and parabolas: three roots are named, and all others are one of them."""

    def root(t: str) -> str:
        return f"a^2*{t}^4 - 2*a*{t}^2 + {t}^2 - b^2 + 1"

    text = (
        f"a > 0 and b > 0 and (ex x, y, z. {root('x')} = 0 and {root('y')} = 0 and {root('z')} = 0 and x < y and y < z"
        f" and (all t. t = x or t = y or t = z or {root('t')} /= 0))"
    )
    answer = qe.eliminate(text, timeout=120)
    assert answer.formula is not None
    assert qe.decide(f"all a, b. ({answer.formula}) <-> (b = 1 and 2*a > 1)")
    assert "multiple of an equation subtracted" in [step.rule for step in answer.derivation.steps]


def test_no_basis_brings_back_what_was_cancelled() -> None:
    """Two rules undid each other forty times: a cubic through three points took 97 steps."""
    answer = qe.eliminate("exactly 3 x. 2*x^3 + (1 - 2*q)*x - p = 0")
    assert str(answer) == "16*q^3 - 24*q^2 - 27*p^2 + 12*q - 2 > 0"
    befores = [step.before for step in answer.derivation.steps]
    assert len(befores) < 30 and len({*befores}) == len(befores)

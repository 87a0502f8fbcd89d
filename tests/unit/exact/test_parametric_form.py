"""Quadratic conditions with parameters: the form is the polynomial, at every point and over every parameter."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.parametric_form import parametric_form
from qe.exact.ring import Poly, Ring
from tests.tables import each

RING = Ring.of(("a", "b", "x", "y"))
A, B, X, Y = (RING.gen(i) for i in range(4))
SMALL = st.integers(-3, 3)


@st.composite
def quadratics(draw: st.DrawFn) -> Poly:
    quadratic = draw(SMALL) * X**2 + draw(SMALL) * X * Y + draw(SMALL) * Y**2
    return (
        quadratic
        + draw(SMALL) * A * B * X
        + draw(SMALL) * A**2 * Y
        + draw(SMALL) * Y
        + draw(SMALL) * B**3
        + draw(SMALL)
    )


@given(quadratics(), st.tuples(SMALL, SMALL, SMALL, SMALL))
def test_the_form_has_the_values_of_the_polynomial(poly: Poly, point: tuple[int, ...]) -> None:
    form = parametric_form(poly, (2, 3))
    assert form is not None
    a, b, *place = map(Fraction, point)
    over = form.at((a, b))
    value = over.constant + sum((g * v for g, v in zip(over.gradient, place)), Fraction(0))
    value += sum((over.hessian[i][j] * place[i] * place[j] for i in range(2) for j in range(2)), Fraction(0)) / 2
    assert value == poly.evaluate([a, b, *place])
    assert all(over.hessian[i][j] == over.hessian[j][i] for i in range(2) for j in range(2))


@each(A * X**2, X**3, X**2 * Y, X * Y * B, X**2 * Y**2)
def test_other_polynomials_have_none(poly: Poly) -> None:
    assert parametric_form(poly + X + 1, (2, 3)) is None

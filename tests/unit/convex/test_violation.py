"""How far constraints are from being satisfied together: what is proposed is checked exactly here."""

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from qe.convex.violation import height, proposed, violation_form, violation_forms
from qe.exact.quadratic_form import Quadratic, combine, solve_linear
from tests.tables import each
from tests.unit.convex.quadratics import ball, line

ZERO = Fraction(0)


POINTS = [(Fraction(x), Fraction(y)) for x in (-1, 0, 3) for y in (-2, 0, 1)]


@each(ball((1, 2), 5), line(3, -6, constant=4), line(0, 0, constant=5))
def test_the_violation_is_the_scaled_form_less_the_height(form: Quadratic) -> None:
    found, scale = violation_form(form)
    assert scale > 0
    for x, y in POINTS:
        for t in (Fraction(-1), Fraction(5, 2)):
            assert found.value((x, y, t)) == scale * form.value((x, y)) - t
    largest = [abs(v) for row in found.hessian for v in row] if not form.is_linear else [abs(v) for v in found.gradient]
    assert max(largest) == 1


def test_the_height_is_bounded_below() -> None:
    forms, scales = violation_forms([line(1, 0), line(0, 1)], 2)
    assert len(forms) == 3 and len(scales) == 2
    assert forms[-1].value((ZERO, ZERO, Fraction(-3))) == 2  # -1 - t <= 0 is violated below -1
    assert height(2).value((Fraction(7), Fraction(8), Fraction(9))) == 9


NUMBERS = st.integers(-4, 4).map(Fraction)


@settings(max_examples=30)
@given(st.lists(st.tuples(NUMBERS, NUMBERS, st.integers(1, 9).map(Fraction)), min_size=1, max_size=3))
def test_proposals_prove_themselves(balls: list[tuple[Fraction, Fraction, Fraction]]) -> None:
    """A point inside all balls, or weights with which the sum of the forms is positive everywhere."""
    forms = [ball((x, y), square) for x, y, square in balls]
    witness, weights = proposed(forms)
    assert witness is None or weights is None
    if witness is not None:
        assert all(form.value(witness) < 0 for form in forms)
    if weights is not None:
        assert all(w >= 0 for w in weights) and any(weights)
        total = combine(weights, forms)
        least = solve_linear(total.hessian, [-b for b in total.gradient], 2)
        assert least is not None and total.value(least.particular) > 0


def test_what_is_clear_is_found() -> None:
    inside, none = proposed([ball((0, 0), 4), ball((1, 0), 4)])
    assert inside is not None and none is None
    none, weights = proposed([ball((0, 0), 1), ball((5, 0), 1)])
    assert none is None and weights is not None

"""Quotients with guards: what arithmetic makes of them, evaluated at points where they have a value and where not."""

from fractions import Fraction

from hypothesis import assume, given
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, neg
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, Relation
from qe.io import cases
from qe.io.cases import Case, Cases
from qe.io.terms import Value
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")
POINTS = [{"x": Fraction(a), "y": Fraction(b, 2)} for a in (-2, 0, 1, 3) for b in (-3, 0, 2)]


def value(poly: Poly | int, den: int = 1) -> Value:
    found = RING.constant(poly) if isinstance(poly, int) else poly
    return Value(found, den, found.height_bits())


def case_at(case: Case, point: dict[str, Fraction]) -> Fraction | None:
    """The value of a case; None where a guard does not hold."""
    if not all(holds_at(guard, point) for guard in case.guards):
        return None
    found = case.value.poly.evaluate(point.values()) / case.value.den
    for factor, k in case.below:
        found /= factor.evaluate(point.values()) ** k
    return found


def at(meaning: Cases, point: dict[str, Fraction]) -> Fraction | None:
    found = [v for case in meaning if (v := case_at(case, point)) is not None]
    assert len(found) <= 1, "the guards of the cases exclude each other"
    return found[0] if found else None


QUOTIENTS = st.builds(
    lambda top, den, bottom: cases.combine(
        (cases.plain(value(top, den)), (cases.inverse(Case((), value(bottom))),)), lambda pair: cases.times(*pair)
    ),
    polynomials(RING),
    st.integers(1, 4),
    polynomials(RING).filter(bool),
)


@given(QUOTIENTS, QUOTIENTS)
def test_arithmetic_of_quotients(a: Cases, b: Cases) -> None:
    """Defined where both are, with the right value."""
    gap, product = cases.difference(a, b), cases.combine((a, b), lambda pair: cases.times(*pair))
    for point in POINTS:
        left, right = at(a, point), at(b, point)
        if left is None or right is None:
            assert at(gap, point) is None and at(product, point) is None
        else:
            assert at(gap, point) == left - right and at(product, point) == left * right


@given(polynomials(RING).filter(bool), st.integers(1, 5))
def test_an_inverse_is_defined_where_the_bottom_is_not_zero(bottom: Poly, den: int) -> None:
    found = cases.inverse(Case((), value(bottom, den)))
    for point in POINTS:
        below = bottom.evaluate(point.values())
        assert case_at(found, point) == (den / below if below else None)
    again = cases.inverse(found) if not found.value.poly.is_constant else None
    if again is not None:
        assert all(case_at(again, p) in (None, 1 / v) for p in POINTS if (v := case_at(found, p)))


@given(QUOTIENTS, st.integers(0, 3))
def test_powers(a: Cases, k: int) -> None:
    assume(a)
    found = cases.power(a[0], k)._replace(guards=a[0].guards)
    for point in POINTS:
        left = case_at(a[0], point)
        assert case_at(found, point) == (None if left is None else left**k)
    assert not (k == 0 and found.below)


@given(QUOTIENTS, st.sampled_from(tuple(Relation)))
def test_the_sign_of_a_quotient_needs_no_division(a: Cases, relation: Relation) -> None:
    for case in a:
        said = cases.holds(case, relation)
        for point in POINTS:
            found = case_at(case, point)
            assert holds_at(said, point) == (found is not None and relation.holds((found > 0) - (found < 0)))


def test_a_sum_over_the_least_denominator_shown() -> None:
    one = Case((), value(1), ((X, 2),))
    other = Case((), value(Y, 3), ((X, 1), (Y, 1)))
    found = cases.total((one, other))
    assert found.below == ((X, 2), (Y, 1))
    assert (found.value.poly, found.value.den) == (3 * Y + X * Y, 3)


def test_a_guard_that_the_sign_implies_is_left_out() -> None:
    """1/x > 0 is x > 0, without x /= 0 beside it; an even power keeps it."""
    odd = Case((atom(X, Relation.NE),), value(1), ((X, 1),))
    assert cases.holds(odd, Relation.GT) == atom(X, Relation.GT)
    even = Case((atom(X, Relation.NE),), value(Y), ((X, 2),))
    assert str(cases.holds(even, Relation.GT)) == "x /= 0 and y > 0"


@each(
    ((TRUE,), 1),
    ((FALSE,), None),
    ((atom(X, Relation.EQ),), 2),
    ((atom(X, Relation.GT),), 1),  # said already
    ((atom(X, Relation.LE),), None),  # the negation
)
def test_guards_are_joined_without_repetition_or_contradiction(guards: tuple, expected: int | None) -> None:  # type: ignore[type-arg]
    found = cases.guarded(guards, Case((atom(X, Relation.GT),), value(1)))
    assert (len(found[0].guards) if found else None) == expected
    assert cases.guarded((), Case((FALSE,), value(1))) == ()


def test_combinations_leave_out_contradictions() -> None:
    positive, negative = atom(X, Relation.GT), neg(atom(X, Relation.GT))
    absolute = (Case((positive,), value(X)), Case((negative,), value(-X)))
    assert len(cases.difference(absolute, absolute)) == 2
    assert len(cases.difference(absolute, cases.plain(value(1)))) == 2
    assert cases.combine((), lambda _: Case((), value(1))) == cases.plain(value(1))


def test_long_polynomials_are_not_factored() -> None:
    short = (X + 1) * (X + 2)
    assert len(cases.split(short)[1]) == 2
    long = RING.from_terms({(i, j): 1 for i in range(8) for j in range(8)})  # sums of powers, a product
    assert long.term_count() > cases.MOST_FACTORED and len(cases.split(2 * long)[1]) == 1
    unit, ((primitive, k),) = cases.split(-6 * long)
    assert unit * primitive**k == -6 * long and primitive == long

"""Curves: points, derivatives, Bernstein bases, areas, places where something happens."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import comb

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from bezier.curves import bernstein as bs
from bezier.curves.area import convex_area
from bezier.curves.bernstein import halves
from bezier.curves.curve import Bezier, Smoothness, curvature_squared, join
from bezier.curves.nonnegative import events_of
from bezier.curves.scalar import add, brief, dot, is_zero, same, scale, sign, subtract, with_decimal
from qe.errors import InputError
from qe.exact.field import NumberField
from tests.bezier.made import control_points, points, small, surds, unit
from tests.tables import each

HALF = Fraction(1, 2)


def by_definition(control, t):
    """P(t) by the sum of the definition."""
    n = len(control) - 1
    weights = [comb(n, k) * t**k * (1 - t) ** (n - k) for k in range(n + 1)]
    terms = [[w * x for x in p] for w, p in zip(weights, control, strict=True)]
    return tuple(sum(column, Fraction(0)) for column in zip(*terms, strict=True))


@given(control_points(), unit)
def test_de_casteljau_is_the_definition(control, t):
    assert Bezier.of(control).point(t) == by_definition(control, t)


@given(control_points(1, 4, coordinate=surds), unit)
def test_de_casteljau_over_a_number_field(control, t):
    assert same(Bezier.of(control).point(t), by_definition(control, t))


@given(control_points(), unit, unit)
def test_subdivision_reparametrises(control, t, u):
    left, right = Bezier.of(control).split(t)
    assert left.point(u) == by_definition(control, t * u)
    assert right.point(u) == by_definition(control, t + (1 - t) * u)


@given(control_points(), st.tuples(unit, unit).filter(lambda p: p[0] != p[1]), unit)
def test_segment(control, ends, u):
    low, high = sorted(ends)
    assert Bezier.of(control).segment(low, high).point(u) == by_definition(control, low + (high - low) * u)


@given(control_points(), st.integers(0, 3), unit)
def test_elevation_keeps_the_curve(control, more, t):
    curve = Bezier.of(control)
    assert curve.elevate(curve.degree + more).point(t) == curve.point(t)


@given(control_points(2, 5), unit)
def test_hodograph_is_the_derivative(control, t):
    curve = Bezier.of(control)
    for i in range(3):
        power = bs.to_power(curve.coordinate(i))
        slope = bs.from_power(bs.power_derivative(power))
        assert curve.hodograph().point(t)[i] == bs.value(slope, t)


@given(control_points(1, 4), unit)
def test_norm_squared(control, t):
    curve = Bezier.of(control)
    assert bs.value(curve.norm_squared(), t) == dot(curve.point(t), curve.point(t))


@given(control_points(2, 4), unit)
def test_curvature_is_the_cross_product_formula(control, t):
    curve = Bezier.of(control)
    u, v = curve.derivative(1, t), curve.derivative(2, t)
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    above, below = (bs.value(side, t) for side in curvature_squared(curve))
    assert above * dot(u, u) ** 3 == below * dot(cross, cross) and below == dot(u, u) ** 3


def test_curvature_of_a_parabola():
    # P(t) = (t, t^2): kappa = 2 / (1 + 4 t^2)^(3/2), so kappa^2 = 4 at the vertex and 4/125 at t = 1
    curve = Bezier.of([(0, 0), (HALF, 0), (1, 1)])
    above, below = curvature_squared(curve)
    assert above[0] == 4 * below[0] and above[-1] == Fraction(4, 125) * below[-1]


@given(control_points(1, 4), unit.filter(lambda t: 0 < t < 1))
def test_halves_of_a_curve_join_with_all_jumps_in_proportion(control, t):
    left, right = Bezier.of(control).split(t)
    meeting = join(left, right)
    assert meeting.smoothness >= Smoothness.C0
    if t == HALF:
        assert meeting.smoothness is Smoothness.C2


@given(points(), points(), points(), points())
def test_c1_exactly_when_the_middle_is_the_mean(p0, p1, corner, q2):
    q1 = subtract(scale(2, corner), p1)
    assert join(Bezier.of([p0, p1, corner]), Bezier.of([corner, q1, q2])).smoothness >= Smoothness.C1
    moved = add(q1, (Fraction(1, 10**9), 0, 0))
    broken = join(Bezier.of([p0, p1, corner]), Bezier.of([corner, moved, q2]))
    assert broken.smoothness is Smoothness.C0 and not is_zero(broken.jumps[1][0])


def test_gap_and_direction():
    a, b = Bezier.of([(0, 0), (1, 0)]), Bezier.of([(1, 0), (3, 0)])
    assert join(a, b).smoothness is Smoothness.C0 and join(a, b).same_direction
    assert join(a, Bezier.of([(1, 1), (2, 1)])).smoothness is Smoothness.GAP
    assert not join(a, Bezier.of([(1, 0), (0, 0)])).same_direction


@each([], [()], [(1, 2), (1, 2, 3)])
def test_no_curve(control):
    with pytest.raises(InputError):
        Bezier.of(control)


def test_elevation_cannot_lower():
    with pytest.raises(InputError):
        Bezier.of([(0,), (1,)]).elevate(0)


@given(st.lists(small, min_size=1, max_size=5), st.lists(small, min_size=1, max_size=5), unit)
def test_bernstein_products_and_sums(a, b, t):
    assert bs.value(bs.multiply(a, b), t) == bs.value(a, t) * bs.value(b, t)
    assert bs.value(bs.add(a, b), t) == bs.value(a, t) + bs.value(b, t)
    assert all(x == y for x, y in zip(bs.elevate(bs.from_power(bs.to_power(a)), len(a) - 1), a, strict=True))


@each(
    (Fraction(3), "3"),
    (Fraction(7, 10), "0.7"),
    (Fraction(-3, 2), "-1.5"),
    (Fraction(1, 3), "0.33333333 (exactly 1/3)"),
    (Fraction(1, 3**100), "about 1.9403252e-48"),
    (Fraction(1, 2**40), "9.094947e-13 (exactly 1/1099511627776)"),
)
def test_numbers_in_words(value, text):
    assert brief(value) == text


def test_roots_in_words():
    assert with_decimal("sqrt(14)", "3.74166") == "3.74166 (exactly sqrt(14))"
    assert with_decimal("sqrt(89)/2", "4.71699") == "4.71699 (exactly sqrt(89)/2)"
    assert with_decimal("6", "6") == "6"


PI = Fraction(3141592653589793, 10**15)


@each(
    ("x^2 + y^2 <= 1", PI),
    ("x >= 0 and y >= 0 and x + 2*y <= 3", Fraction(9, 4)),
    ("x^2 <= y and y <= 1", Fraction(4, 3)),
    ("4*x^2 + y^2 <= 4 and x >= 0", PI),
    ("0 <= x and x <= 1 and 0 <= y and y <= 1/1000", Fraction(1, 1000)),
    ("x^2 + y^2 <= 1 and (x - 1)^2 + y^2 <= 1", 2 * PI / 3 - Fraction(8660254037844386, 10**16)),
)
def test_known_areas(text: str, area: Fraction) -> None:
    for rel in (Fraction(1, 20), Fraction(1, 1000)):
        found = convex_area(qe.region(text), rel)
        assert (
            found.high is not None
            and found.low <= area + Fraction(1, 10**12)
            and found.high >= area - Fraction(1, 10**12)
        )
        assert found.high - found.low <= rel * found.high


@each("x^2 + y^2 < 0", "x^2 + y^2 <= 0", "x = y and 0 <= x and x <= 1", "x = 1 and y^2 <= 2")
def test_nothing_and_thin_sets_have_no_area(text: str) -> None:
    found = convex_area(qe.region(text, order=("x", "y")), Fraction(1, 100))
    assert found.low == 0 and found.high == 0


@each("y >= x^2", "0 <= x and x <= 1", "x > y")
def test_unbounded_regions_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="bounded"):
        convex_area(qe.region(text, order=("x", "y")), Fraction(1, 100))


def test_agrees_with_the_volume_of_a_region() -> None:
    region = qe.region("x^2 + 2*y^2 - x*y <= 3 and y >= -1/2")
    low, high = region.volume(0.001)
    found = convex_area(region, Fraction(1, 500))
    assert found.high is not None and max(low, found.low) <= min(high, found.high)


class Plain:
    """A rational number that does not say so, as an element of a number field does not."""

    def __init__(self, value: Fraction | int) -> None:
        self.value = Fraction(value)

    def __add__(self, other: object) -> Plain:
        return Plain(self.value + _plain(other))

    def __sub__(self, other: object) -> Plain:
        return Plain(self.value - _plain(other))

    def __mul__(self, other: object) -> Plain:
        return Plain(self.value * _plain(other))

    def __neg__(self) -> Plain:
        return Plain(-self.value)

    def __lt__(self, other: object) -> bool:
        return self.value < _plain(other)

    def __gt__(self, other: object) -> bool:
        return self.value > _plain(other)

    def __eq__(self, other: object) -> bool:
        return self.value == _plain(other)

    def __bool__(self) -> bool:
        return bool(self.value)

    __radd__, __rmul__, __hash__ = __add__, __mul__, None


def _plain(value: object) -> Fraction:
    return value.value if isinstance(value, Plain) else Fraction(value)  # type: ignore[call-overload,no-any-return]


NUMBERS = st.one_of(st.integers(-9, 9), st.fractions(-50, 50, max_denominator=60), st.just(Fraction(10**40 + 1, 3**30)))


FORMS = st.lists(NUMBERS, min_size=1, max_size=7)


PARAMETERS = st.fractions(0, 1, max_denominator=12)


def hidden(form: list[Fraction]) -> list[Plain]:
    return [Plain(c) for c in form]


def shown(form: object) -> list[Fraction]:
    return [_plain(c) for c in form]  # type: ignore[attr-defined]


def defined(form: list[Fraction], t: Fraction) -> Fraction:
    n = len(form) - 1
    return sum((comb(n, k) * t**k * (1 - t) ** (n - k) * c for k, c in enumerate(form)), Fraction(0))


@given(FORMS, FORMS, PARAMETERS)
def test_both_ways_agree_with_the_definition(a: list[Fraction], b: list[Fraction], t: Fraction) -> None:
    assert bs.value(a, t) == defined(a, t) == _plain(bs.value(hidden(a), t))
    product = bs.multiply(a, b)
    assert len(product) == len(a) + len(b) - 1 and bs.value(product, t) == defined(a, t) * defined(b, t)
    assert list(product) == shown(bs.multiply(hidden(a), hidden(b)))
    for part, other, u in zip(bs.split(a, t), bs.split(hidden(a), t), (t / 2, t + (1 - t) / 2), strict=True):
        assert list(part) == shown(other) and len(part) == len(a)
        assert bs.value(part, Fraction(1, 2)) == defined(a, u)


@given(FORMS, st.integers(0, 9), PARAMETERS)
def test_raising_the_degree(a: list[Fraction], degree: int, t: Fraction) -> None:
    raised = bs.elevate(a, degree)
    assert len(raised) == max(len(a), degree + 1) and list(raised) == shown(bs.elevate(hidden(a), degree))
    assert defined(list(raised), t) == defined(a, t)


@given(FORMS, FORMS, PARAMETERS)
def test_power_forms(a: list[Fraction], b: list[Fraction], t: Fraction) -> None:
    power = bs.to_power(a)
    assert sum((c * t**k for k, c in enumerate(power)), Fraction(0)) == defined(a, t)
    assert not power or power[-1] != 0
    assert defined(list(bs.from_power(power)), t) == defined(a, t)
    assert list(bs.from_power(power)) == shown(bs.from_power(hidden(list(power))))
    assert list(bs.power_multiply(a, b)) == shown(bs.power_multiply(hidden(a), hidden(b)))
    assert bs.power_multiply(a, ()) == bs.power_multiply((), b) == ()


PLACES = [Fraction(k, 4) for k in range(5)]


def value(b, t: Fraction) -> Fraction:
    n = len(b) - 1
    return sum((comb(n, k) * t**k * (1 - t) ** (n - k) * c for k, c in enumerate(b)), Fraction(0))


@given(st.lists(st.integers(-9, 9), min_size=1, max_size=6))
def test_integers_stay_integers(b: list[int]) -> None:
    left, right = halves(tuple(b))
    factor = 2 ** (len(b) - 1)
    assert all(isinstance(c, int) for c in left + right)
    for t in PLACES:
        assert value(left, t) == factor * value(b, t / 2)
        assert value(right, t) == factor * value(b, (1 + t) / 2)


@given(st.lists(st.fractions(-3, 3, max_denominator=5), min_size=1, max_size=5))
def test_fractions_are_split_as_they_are(b: list[Fraction]) -> None:
    left, right = halves(tuple(b))
    for t in PLACES:
        assert value(left, t) == value(b, t / 2) and value(right, t) == value(b, (1 + t) / 2)


TINY = Fraction(1, 10**30)


ROOTS = st.sampled_from(
    [*(Fraction(k, 6) for k in range(-1, 8)), TINY, 1 - TINY, Fraction(1, 3) + TINY, Fraction(1, 3) - 2 * TINY]
)


SQRT2 = NumberField.from_root([-2, 0, 1], 1, 2).generator()


def polynomial(roots, factor=Fraction(1)):
    power = (factor,)
    for root in roots:
        power = bs.power_multiply(power, (-root, Fraction(1)))
    return bs.from_power(power)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.lists(ROOTS, max_size=4), min_size=1, max_size=3), st.booleans())
def test_known_roots_are_found_with_all_signs(chosen, in_field):
    factor = SQRT2 if in_field else Fraction(-3)
    forms = [polynomial(roots, factor) for roots in chosen]
    found = events_of(forms)
    inside = sorted({r for roots in chosen for r in roots if 0 < r < 1} | {Fraction(0), Fraction(1)})
    assert len(found) == len(inside)
    for event, root in zip(found, inside, strict=True):
        assert event.t[0] <= root <= event.t[1]
        assert event.signs == tuple(sign(bs.value(f, root)) for f in forms)
    for one, two in pairwise(found):
        assert one.t[1] < two.t[0]
        for form in forms:
            ends = [(a.t[1] + b.t[0]) / 2 for a, b in ((one, two),)]
            near = [one.t[1] + (two.t[0] - one.t[1]) * Fraction(k, 7) for k in range(1, 7)]
            assert len({sign(bs.value(form, t)) for t in [*ends, *near]}) == 1


def test_an_irrational_root_that_two_polynomials_share():
    """2 t^2 - 1 divides both; the second one has it twice."""
    base = (Fraction(-1), Fraction(0), Fraction(2))
    first = bs.from_power(bs.power_multiply(base, (Fraction(-1, 9), Fraction(1))))
    second = bs.from_power(bs.power_multiply(base, base))
    found = events_of([first, second])
    assert [event.signs for event in found] == [(1, 1), (0, 1), (0, 0), (1, 1)]
    assert found[2].t[0] < Fraction(7071067811865476, 10**16) < found[2].t[1] + Fraction(1, 10**15)


def test_zero_and_constant_polynomials_have_no_roots():
    found = events_of([(Fraction(0),) * 4, (Fraction(2),) * 3, (SQRT2 - SQRT2, SQRT2)])
    assert [event.signs for event in found] == [(0, 1, 0), (0, 1, 1)]


@each(3, 5)
def test_a_root_next_to_the_start_is_apart_from_it(degree):
    form = polynomial([TINY, *([Fraction(0)] * (degree - 1))])
    start, root, end = events_of([form])
    assert (
        start.t == (0, 0)
        and 0 < root.t[0] <= TINY <= root.t[1]
        and (start.signs, root.signs, end.signs)
        == (
            (0,),
            (0,),
            (1,),
        )
    )


def test_ends_and_roots_are_disjoint_and_have_exact_signs():
    a = (Fraction(-1), Fraction(0), Fraction(1))  # 2t - 1
    b = (Fraction(-2), Fraction(-2), Fraction(2))  # 4t^2 - 2, root sqrt(2)/2
    found = events_of([a, b])
    assert found[0].t == (0, 0) and found[-1].t == (1, 1) and len(found) == 4
    assert [event.signs for event in found] == [(-1, -1), (0, -1), (1, 0), (1, 1)]

"""All sign changes of several polynomials: shared, multiple, tiny and very close roots, at the ends and inside."""

from fractions import Fraction
from itertools import pairwise

from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.curves import bernstein as bs
from bezier.curves.nonnegative import events_of
from bezier.curves.scalar import sign
from qe.exact.field import NumberField
from tests.tables import each

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

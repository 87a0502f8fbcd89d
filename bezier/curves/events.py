"""Where several polynomials along one curve change their signs: all roots in [0, 1], in order, with all exact signs.

Each polynomial is isolated by itself and the roots are then told apart by halving. Inverses are what is slow in a large
number field, and greatest common divisors are full of them; so they are left for the cases that halving does not
settle: a multiple root (the discriminant tells, up to degree 3), and a root that two polynomials seem to share.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from bezier.curves import bernstein as bs
from bezier.curves.nonnegative import Interval, isolate_simple, refine
from bezier.curves.scalar import is_zero, sign

WIDTH = Fraction(1, 2**60)
"""To what width a root is refined before a common root is suspected; also the width of what is returned."""
MAX_DENOMINATOR = 10**6
"""Rational roots up to this denominator are recognised as such."""
ZERO, ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True, slots=True)
class Event:
    """A parameter in [0, 1], isolated (equal ends: exactly), with the exact sign of each polynomial there."""

    t: Interval
    signs: tuple[int, ...]


def events_of(forms: Sequence[bs.Coefficients]) -> tuple[Event, ...]:
    """The ends 0 and 1 and all roots of the polynomials (in Bernstein form) between, ascending and disjoint.

    Between two neighbouring events no polynomial changes its sign. Zero polynomials have no roots here.
    """
    found = [(-1, Event((t, t), tuple(sign(bs.value(f, t)) for f in forms))) for t in (ZERO, ONE)]
    simple = [_simple(form) for form in forms]
    for i, form in enumerate(simple):
        for interval in isolate_simple(form):
            event = _located(i, interval, simple, forms)
            if not any(event.signs[j] == 0 and len(simple[j]) > 1 for j in range(i)):  # else it is listed with j
                found.append((i, event))
    return tuple(_apart(found, simple))


def _simple(form: bs.Coefficients) -> bs.Coefficients:
    """A polynomial with the same roots in (0, 1), all simple, and none at 0 or 1."""
    power = bs.trim(bs.to_power(form))
    while len(power) > 1 and is_zero(power[0]):
        power = power[1:]
    while len(power) > 1 and is_zero(sum(power, ZERO)):
        power = bs.divide(power, (ONE, -ONE))[0]
    if len(power) < 2:
        return (ONE,)
    if _has_multiple_root(power):
        power = bs.divide(power, bs.gcd(power, bs.power_derivative(power)))[0]
    return bs.from_power(power)


def _has_multiple_root(power: bs.Coefficients) -> bool:
    """Whether the discriminant may vanish; exact up to degree 3, "perhaps" above."""
    if len(power) == 2:
        return False
    if len(power) == 3:
        c, b, a = power
        return is_zero(b * b - 4 * a * c)
    if len(power) == 4:
        d, c, b, a = power
        return is_zero(18 * a * b * c * d - 4 * b * b * b * d + b * b * c * c - 4 * a * c * c * c - 27 * a * a * d * d)
    return True


def _located(i: int, t: Interval, simple: Sequence[bs.Coefficients], forms: Sequence[bs.Coefficients]) -> Event:
    """The root of polynomial ``i`` in ``t`` with all signs, refined."""
    low, high = refine(simple[i], t, WIDTH) if t[0] < t[1] else t
    if low < high:
        guess = ((low + high) / 2).limit_denominator(MAX_DENOMINATOR)
        if low <= guess <= high and is_zero(bs.value(simple[i], guess)):
            low = high = guess
    signs = []
    for j, form in enumerate(forms):
        if j == i:
            signs.append(0)
            continue
        here, (low, high) = _sign_at(simple[i], (low, high), form)
        signs.append(here)
    return Event((low, high), tuple(signs))


def _sign_at(root_of: bs.Coefficients, t: Interval, form: bs.Coefficients) -> tuple[int, Interval]:
    """The sign of a polynomial at the root of another one in ``t``, and ``t`` as far as it was refined."""
    if t[0] == t[1]:
        return sign(bs.value(form, t[0])), t
    asked = False
    while True:
        signs = {sign(c) for c in bs.restrict(form, *t)}
        if len(signs) == 1:
            return signs.pop(), t
        if not asked:
            asked = True
            common = bs.from_power(bs.gcd(bs.to_power(root_of), bs.trim(bs.to_power(form))))
            if sign(bs.value(common, t[0])) * sign(bs.value(common, t[1])) < 0:
                return 0, t
        t = refine(root_of, t, (t[1] - t[0]) / 2**10)
        if t[0] == t[1]:
            return sign(bs.value(form, t[0])), t


def _apart(found: Sequence[tuple[int, Event]], simple: Sequence[bs.Coefficients]) -> list[Event]:
    """The events, all different, each with its polynomial's index: refined until they are in order, with gaps between.

    Also next to the ends 0 and 1, which are no roots of the simple polynomials.
    """
    events = list(found)
    moved = True
    while moved:
        moved = False
        events.sort(key=lambda item: item[1].t)
        for k in range(len(events) - 1):
            (i, one), (j, two) = events[k], events[k + 1]
            if one.t[1] >= two.t[0]:
                moved = True
                events[k], events[k + 1] = (i, _finer(one, simple[i])), (j, _finer(two, simple[j]))
    return [event for _, event in events]


def _finer(event: Event, form: bs.Coefficients) -> Event:
    low, high = event.t
    return event if low == high else Event(refine(form, event.t, (high - low) / 2), event.signs)

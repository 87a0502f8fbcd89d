"""Proof or refutation of p >= 0 on [0, 1], complete over any ordered field with exact signs.

Bernstein coefficients decide most polynomials. The rest come near zero or touch it: between their neighbouring roots
one sign each decides.

Where several polynomials along one curve change their signs: all roots in [0, 1], in order, with all exact signs.

Each polynomial is isolated by itself and the roots are then separated by halving. Inverses are what is slow in a large
number field, and greatest common divisors are full of them; so they are left for the cases that halving does not
settle: a multiple root (the discriminant tells, up to degree 3), and a root that two polynomials seem to share.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import lcm
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.scalar import is_zero, sign
from qe.errors import Unable
from qe.exact.nearby import rational_between

Interval = tuple[Fraction, Fraction]
UNIT: Interval = (Fraction(0), Fraction(1))
QUICK_DEPTH = 5
"""Bisections before roots are split off. Over Q, where bisecting is cheap and long numbers make gcds slow: 16."""
QUICK_DEPTH_RATIONAL = 16
MAX_BOXES = 20_000
NEAR = Fraction(1, 2**40)
"""To what width a place is refined where a curve touches."""


@dataclass(frozen=True, slots=True)
class Nonnegative:
    """p >= 0 on [0, 1].

    ``boxes``: intervals covering [0, 1] on each of which all Bernstein coefficients are >= 0; none where roots had to
    be isolated. ``touches``: where p is zero, as intervals (equal ends: exactly there) holding one root each; the unit
    interval when p is zero everywhere.
    """

    boxes: tuple[Interval, ...]
    touches: tuple[Interval, ...]


@dataclass(frozen=True, slots=True)
class Negative:
    """p(t) < 0 at this rational t in [0, 1]; ``value`` is p(t)."""

    t: Fraction
    value: Any


def decide(b: Sequence[Any]) -> Nonnegative | Negative:
    """Decide p >= 0 on [0, 1] for the polynomial with Bernstein coefficients ``b``.

    Raises ``Unable`` when more than ``MAX_BOXES`` intervals would be needed.
    """
    whole = tuple(b)
    if all(map(is_zero, whole)):
        return Nonnegative((UNIT,), (UNIT,))
    is_rational = all(isinstance(c, (int, Fraction)) for c in whole)
    outcome = subdivided(whole, QUICK_DEPTH_RATIONAL if is_rational else QUICK_DEPTH)
    if isinstance(outcome, Negative):
        return outcome
    if outcome is not None:
        return Nonnegative(outcome, _end_touches(whole, outcome))
    events = events_of((whole,), NEAR)
    for t in (rational_between(one.t[1], two.t[0]) for one, two in pairwise(events)):
        if sign(here := bs.value(whole, t)) < 0:
            return Negative(t, here)
    return Nonnegative((), tuple(event.t for event in events if event.signs == (0,)))


def subdivided(b: bs.Coefficients, depth: int) -> tuple[Interval, ...] | Negative | None:
    """Boxes with nonnegative coefficients covering [0, 1]; a negative point; None when ``depth`` is reached."""
    done: list[Interval] = []
    todo = [(b, Fraction(0), Fraction(1), 0)]
    while todo:
        part, low, high, level = todo.pop()
        signs = [sign(c) for c in part]
        if signs[0] < 0:
            return Negative(low, part[0])
        if signs[-1] < 0:
            return Negative(high, part[-1])
        if min(signs) >= 0:
            done.append((low, high))
            continue
        if level == depth:
            return None
        if len(done) + len(todo) > MAX_BOXES:
            raise Unable("the curve comes too close to the boundary for the subdivision limit")
        middle = (low + high) / 2
        left, right = bs.split(part)
        todo.append((right, middle, high, level + 1))
        todo.append((left, low, middle, level + 1))
    return tuple(done)


def _end_touches(b: bs.Coefficients, boxes: Sequence[Interval]) -> tuple[Interval, ...]:
    """The zeros of p where every box has coefficients >= 0: only ends of boxes can be zeros."""
    ends = sorted({end for box in boxes for end in box})
    return tuple((t, t) for t in ends if is_zero(bs.value(b, t)))


def isolate(b: Sequence[Any]) -> list[Interval]:
    """Disjoint intervals with one root each, for all distinct roots in the open interval (0, 1).

    ``b``: Bernstein coefficients of a non-zero polynomial. Vincent-Collins-Akritas in Bernstein form
    (Mourrain, Rouillier and Roy 2005): no sign change, no root; one sign change, one root. Equal ends mean
    that the root is that rational number.
    """
    if _keeps_sign(tuple(b), QUICK_DEPTH):  # this spares the square-free part, which is slow in large number fields
        return []
    return isolate_simple(_simple(tuple(b)))


def isolate_simple(b: bs.Coefficients) -> list[Interval]:
    """``isolate`` for a polynomial whose roots in (0, 1) are simple and which does not vanish at 0."""
    result: list[Interval] = []
    todo = [(b, Fraction(0), Fraction(1))]
    while todo:
        part, low, high = todo.pop()
        changes = bs.sign_changes(part)
        if changes == 0:
            continue
        if changes == 1 and sign(part[0]) and sign(part[-1]):
            result.append((low, high))
            continue
        middle = (low + high) / 2
        left, right = bs.split(part)
        if is_zero(right[0]):
            result.append((middle, middle))
        todo += [(left, low, middle), (right, middle, high)]
    return sorted(result)


def _keeps_sign(b: bs.Coefficients, depth: int) -> bool:
    """Whether ``depth`` bisections show that the polynomial has no root in [0, 1]."""
    signs = {sign(c) for c in b}
    if len(signs) == 1:
        return 0 not in signs
    if depth == 0 or is_zero(b[0]) or is_zero(b[-1]):
        return False
    return all(_keeps_sign(part, depth - 1) for part in bs.split(b))


def refine(b: Sequence[Any], interval: Interval, width: Fraction) -> Interval:
    """Bisect an isolating interval of a simple root down to at most ``width``."""
    low, high = interval
    if 0 <= low < high <= 1 and all(isinstance(c, (int, Fraction)) for c in b):
        return _refined(bs.to_power(bs.restrict(b, low, high)), low, high, width)
    power = bs.to_power(b)
    below = sign(bs.power_value(power, low))
    while high - low > width:
        middle = (low + high) / 2
        here = sign(bs.power_value(power, middle))
        if here == 0:
            return middle, middle
        low, high = (middle, high) if here == below else (low, middle)
    return low, high


def _refined(power: Sequence[Any], low: Fraction, high: Fraction, width: Fraction) -> Interval:
    """The same for a polynomial over Q on an interval that is mapped to [0, 1]: signs at k/2^n, by integers alone."""
    common = lcm(*(c.denominator for c in power))
    numbers = [c.numerator * (common // c.denominator) for c in reversed(power)]
    place, depth, wide = 0, 0, high - low
    below = sign(numbers[-1]) if numbers else 0
    while wide > width * (1 << depth):
        place, depth = 2 * place, depth + 1
        here = _sign_at_dyadic(numbers, place + 1, depth)
        if here == 0:
            middle = low + wide * Fraction(place + 1, 1 << depth)
            return middle, middle
        place += here == below
    return low + wide * Fraction(place, 1 << depth), low + wide * Fraction(place + 1, 1 << depth)


def _sign_at_dyadic(numbers: Sequence[int], at: int, depth: int) -> int:
    """The sign of a polynomial, its leading coefficient first, at ``at`` / 2^``depth``."""
    total, shift = 0, 0
    for c in numbers:
        total = total * at + (c << shift)
        shift += depth
    return (total > 0) - (total < 0)


WIDTH = Fraction(1, 2**80)
"""To what width a root is refined before a common root is suspected; also the width of what is returned."""
MAX_DENOMINATOR = 10**6
"""Rational roots up to this denominator are recognised as such."""
ZERO, ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True, slots=True)
class Event:
    """A parameter in [0, 1], isolated (equal ends: exactly), with the exact sign of each polynomial there."""

    t: Interval
    signs: tuple[int, ...]


def events_of(forms: Sequence[bs.Coefficients], width: Fraction = WIDTH) -> tuple[Event, ...]:
    """The ends 0 and 1 and all roots of the polynomials (in Bernstein form) between, ascending and disjoint.

    Between two neighbouring events no polynomial changes its sign. Zero polynomials have no roots here.
    """
    result = [(-1, Event((t, t), tuple(sign(bs.value(f, t)) for f in forms))) for t in (ZERO, ONE)]
    simple = [_simple(form) for form in forms]
    for i, form in enumerate(simple):
        for interval in isolate_simple(form):
            event = located(i, interval, simple, forms, width)
            if not any(event.signs[j] == 0 and len(simple[j]) > 1 for j in range(i)):  # else it is listed with j
                result.append((i, event))
    return tuple(_disjoint(result, simple))


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


def located(
    i: int, t: Interval, simple: Sequence[bs.Coefficients], forms: Sequence[bs.Coefficients], width: Fraction
) -> Event:
    """The root of polynomial ``i`` in ``t``, a simple one of ``simple[i]``, with all signs, refined."""
    low, high = refine(simple[i], t, width) if t[0] < t[1] else t
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
    has_divisor = False
    while True:
        signs = {sign(c) for c in bs.restrict(form, *t)}
        if len(signs) == 1:
            return signs.pop(), t
        if not has_divisor:
            has_divisor = True
            common = bs.from_power(bs.gcd(bs.to_power(root_of), bs.trim(bs.to_power(form))))
            if sign(bs.value(common, t[0])) * sign(bs.value(common, t[1])) < 0:
                return 0, t
        t = refine(root_of, t, (t[1] - t[0]) / 2**10)
        if t[0] == t[1]:
            return sign(bs.value(form, t[0])), t


def _disjoint(listed: Sequence[tuple[int, Event]], simple: Sequence[bs.Coefficients]) -> list[Event]:
    """The events, all different, each with its polynomial's index: refined until they are in order, with gaps between.

    Also next to the ends 0 and 1, which are no roots of the simple polynomials.
    """
    events = list(listed)
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

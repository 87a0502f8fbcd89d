"""Proof or refutation of p >= 0 on [0, 1], complete over any ordered field with exact signs.

Bernstein coefficients decide most polynomials. The rest come near zero or touch it: between their neighbouring roots
one sign each decides.

Where several polynomials along one curve change their signs: all roots in [0, 1], in order, with all exact signs, by
the engine's root finding over a sample point (``qe.exact.fibre_stack``), here the generator of the field of the curve.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import lcm
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.scalar import coefficients_of, generator_of, is_zero, sign
from qe.errors import Unable
from qe.exact.fibre_stack import isolate_over
from qe.exact.nearby import multiples_around, rational_between
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point

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
        ends = sorted({end for box in outcome for end in box})  # no other place can be a zero
        return Nonnegative(outcome, tuple((t, t) for t in ends if is_zero(bs.value(whole, t))))
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


WIDTH = Fraction(1, 2**80)
"""To what width a root is refined before a common root is suspected; also the width of what is returned."""
ZERO, ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True, slots=True)
class Event:
    """A parameter in [0, 1], isolated (equal ends: exactly), with the exact sign of each polynomial there."""

    t: Interval
    signs: tuple[int, ...]


def events_of(forms: Sequence[bs.Coefficients], width: Fraction = WIDTH) -> tuple[Event, ...]:
    """The ends 0 and 1 and all roots of the polynomials (in Bernstein form) between, ascending and disjoint.

    Between two neighbouring events no polynomial changes its sign. Zero polynomials have no roots here. ``width``: a
    power of 1/2; roots are between neighbouring multiples of it, or of a smaller one where that keeps them apart.
    """
    theta = generator_of(c for form in forms for c in form)
    ring = Ring.of(("t",) if theta is None else ("root", "t"))
    polys = [_poly(ring, form) for form in forms]
    stack = isolate_over(Point.of(ring, () if theta is None else (theta,)), tuple(dict.fromkeys(polys)))
    first, last = (2 * below + is_root for below, is_root in map(stack.place_of, (ZERO, ONE)))
    inner = range(first // 2 + first % 2, last // 2)
    values = [ZERO, *(stack.sections[k].value for k in inner), ONE]
    placed, units = [multiples_around(v, width) for v in values], [width] * len(values)
    while clashes := {j for k in range(len(placed) - 1) if placed[k][1] >= placed[k + 1][0] for j in (k, k + 1)}:
        for k in clashes:
            units[k] /= 2
            placed[k] = multiples_around(values[k], units[k])
    known = map(stack.signs_at, (first, *(2 * k + 1 for k in inner), last))
    return tuple(Event(t, tuple(signs[p] for p in polys)) for t, signs in zip(placed, known, strict=True))


def _poly(ring: Ring, form: bs.Coefficients) -> Poly:
    """A positive multiple of a polynomial, in t and the generator of the field."""
    rows = [coefficients_of(c) for c in bs.to_power(form)]
    below = lcm(*(c.denominator for row in rows for c in row))
    named = ring.names[0] == "root"
    listed = ((((j, k) if named else (k,)), int(c * below)) for k, row in enumerate(rows) for j, c in enumerate(row))
    return ring.from_terms({powers: c for powers, c in listed if c})

"""Is a whole curve clear of an obstacle? A proof for all t, or exactly where it first meets it.

A piece of an obstacle is an intersection {f_1 >= 0, ..., f_m >= 0}. The curve misses it iff at every t some f_i(P(t))
is negative. Intervals of t are halved, from left to right, until one f_i has negative Bernstein coefficients on the
whole interval; these intervals are the proof. Where that does not come to an end soon, the real roots of the f_i(P(t))
that are still open on a short interval decide: signs change only there, so the first contact is the left end of the
interval or one of the roots. Signs at a root are exact (greatest common divisors), so contact without crossing is
distinguished from passing close by.

Polynomials along a curve, ready for signs: f(P(t)) in Bernstein form up to a positive factor.

With p_k = C(n,k) P_k ("scaled" Bernstein coefficients) products of polynomials are plain convolutions, and a rational
curve can be scaled to integers, so that all work before the sign is integer arithmetic. Curves over a number field go
the same way with field elements.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from functools import lru_cache
from math import comb, lcm
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.bernstein import Numbers, halves
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure, bounds
from bezier.curves.nonnegative import Interval, events_of
from bezier.curves.scalar import Vector, sign
from bezier.obstacles.bodies import Box
from bezier.obstacles.obstacle import Constraint, Exponents, Obstacle, Piece
from qe.errors import InputError


class Along:
    """One curve, with its monomials x^i y^j z^k kept as they are needed; coordinates are integers over ``scale``."""

    __slots__ = ("_box", "_monomials", "coordinates", "curve", "scale")

    def __init__(self, curve: Bezier) -> None:
        if curve.dimension != 3:
            raise InputError(f"obstacles are in space: expected a curve of dimension 3, found {curve.dimension}")
        self.curve = curve
        values = [c for p in curve.points for c in p]
        known = [c for c in values if isinstance(c, Fraction)]
        rational = len(known) == len(values)
        self.scale = lcm(*(c.denominator for c in known)) if rational else 1
        n = curve.degree
        self.coordinates = tuple(
            tuple((int(p[i] * self.scale) if rational else p[i]) * comb(n, k) for k, p in enumerate(curve.points))
            for i in range(curve.dimension)
        )
        self._monomials: dict[Exponents, Numbers] = {(0, 0, 0): (1,)}
        self._box: Box | None = None

    @property
    def box(self) -> Box:
        """A rational axis-parallel box around the control points, hence around the curve."""
        if self._box is None:
            ends = [[bounds(p[i]) for p in self.curve.points] for i in range(self.curve.dimension)]
            low = tuple(min(e[0] for e in column) for column in ends)
            self._box = low, tuple(max(e[1] for e in column) for column in ends)
        return self._box

    def form(self, constraint: Constraint) -> Numbers:
        """A positive multiple of the Bernstein coefficients of f(P(t)), of degree n * deg f; integers if rational."""
        degree, n = constraint.degree, self.curve.degree
        common = lcm(*(c.denominator for _, c in constraint.terms)) if constraint.terms else 1
        total: list[Any] = [0] * (n * degree + 1)
        for exponents, coefficient in constraint.terms:
            missing = degree - sum(exponents)
            factor = int(coefficient * common) * self.scale**missing
            for k, c in enumerate(bs.convolved(self._monomial(exponents), _binomials(n * missing))):
                total[k] = total[k] + factor * c
        weights = _weights(n * degree)
        return tuple(c * w for c, w in zip(total, weights, strict=True))

    def _monomial(self, exponents: Exponents) -> Numbers:
        found = self._monomials.get(exponents)
        if found is None:
            axis = next(i for i, e in enumerate(exponents) if e)
            lower = tuple(e - (i == axis) for i, e in enumerate(exponents))
            found = tuple(bs.convolved(self._monomial(lower), self.coordinates[axis]))
            self._monomials[exponents] = found
        return found


@lru_cache(maxsize=64)
def _binomials(n: int) -> tuple[int, ...]:
    return tuple(comb(n, k) for k in range(n + 1))


@lru_cache(maxsize=64)
def _weights(n: int) -> tuple[int, ...]:
    """Integers proportional to 1 / C(n, k)."""
    row = _binomials(n)
    common = lcm(*row)
    return tuple(common // c for c in row)


SHORT = 8
"""After this many halvings roots are isolated."""


class ClearanceArgument(Enum):
    """Which argument proved a curve clear; ``value`` is for people. Each includes the ones before it."""

    BOXES = "bounding boxes apart"
    POLYGON = "Bernstein coefficients of the whole curve"
    SUBDIVISION = "Bernstein coefficients after subdivision"
    ROOTS = "isolated roots and signs"


@dataclass(frozen=True, slots=True)
class Span:
    """On [low, high] the constraint with this index has the wrong sign; None: shown by isolated roots."""

    low: Fraction
    high: Fraction
    constraint: int | None


@dataclass(frozen=True, slots=True)
class Clear:
    """The curve never meets the obstacle."""

    argument: ClearanceArgument
    spans: tuple[tuple[Span, ...] | None, ...]
    """For each piece the proof, None where boxes already show it."""


@dataclass(frozen=True, slots=True)
class Contact:
    """The curve meets the obstacle; ``t`` is the first parameter, an isolating interval or exactly (equal ends)."""

    t: Interval
    place: tuple[Enclosure, ...]
    """P(t) enclosed."""
    exact_place: Vector | None
    """Where t is rational."""
    enters: bool
    """Whether a part of the curve lies in the interior of a piece; if not, the curve only touches."""
    attained: bool
    """False where the obstacle is not closed (strict inequalities) and the contact begins right after t."""
    piece: int
    """The piece met first."""

    @property
    def is_exact(self) -> bool:
        """Whether the parameter is a known rational number."""
        return self.t[0] == self.t[1]


Outcome = Clear | Contact


@dataclass(slots=True)
class _Part:
    """A short interval of t and the constraints that are not satisfied on all of it, as forms on it."""

    low: Fraction
    high: Fraction
    open: list[tuple[int, Numbers]]
    depth: int = 0


@dataclass(slots=True)
class Hit:
    """A first contact with one piece, at the only critical value in ``t``."""

    t: Interval
    attained: bool
    piece: int = 0


@dataclass(slots=True)
class ContactSearch:
    """One curve against one piece, from left to right up to the first contact."""

    piece: Piece
    roots_after: int = SHORT
    """So many halvings come before roots are isolated."""
    spans: list[Span] = field(default_factory=list)
    """The proof so far."""

    def run(self, forms: Sequence[Numbers]) -> Hit | None:
        """The first contact, or None with ``spans`` covering [0, 1]; ``forms``: the constraints along the curve."""
        todo = [_Part(Fraction(0), Fraction(1), list(enumerate(forms)))]
        while todo:
            part = todo.pop()
            still_open, refuted = self._still_open(part)
            part = _Part(part.low, part.high, still_open, part.depth)
            if refuted is not None:
                self.spans.append(Span(part.low, part.high, refuted))
            elif all(self.piece.constraints[i].holds(form[0]) for i, form in still_open):
                return Hit((part.low, part.low), True)
            elif len(still_open) == 1 and _crosses_up(still_open[0][1]):
                return _crossing(part, attained=not self.piece.constraints[still_open[0][0]].strict)
            elif part.depth < self.roots_after:
                todo += _halved(part)
            else:
                hit = self._by_roots(part)
                if hit is not None:
                    return hit
                self.spans.append(Span(part.low, part.high, None))
        return None

    def _still_open(self, part: _Part) -> tuple[list[tuple[int, Numbers]], int | None]:
        undecided = []
        for i, form in part.open:
            signs = [sign(c) for c in form]
            if max(signs) < 0 or (max(signs) == 0 and self.piece.constraints[i].strict):
                return [], i
            if min(signs) < 0 or (min(signs) == 0 and self.piece.constraints[i].strict):
                undecided.append((i, form))
        return undecided, None

    def _by_roots(self, part: _Part) -> Hit | None:
        """The first contact in a short interval, exactly: at its left end, at a root, or right after one of these."""
        constraints = [self.piece.constraints[i] for i, _ in part.open]
        forms = [form for _, form in part.open]
        events = events_of(forms)
        for event, after in zip(events, [*events[1:], None], strict=True):
            if all(c.holds(side) for c, side in zip(constraints, event.signs, strict=True)):
                return _on_curve(part, event.t, True)
            between = None if after is None else (event.t[1] + after.t[0]) / 2
            if between is not None and all(
                c.holds(bs.value(f, between)) for c, f in zip(constraints, forms, strict=True)
            ):
                return _on_curve(part, event.t, False)
        return None


def _on_curve(part: _Part, t: Interval, attained: bool) -> Hit:
    """A contact at the only critical value in ``t``, a parameter of a part, as one of the whole curve."""
    wide = part.high - part.low
    return Hit((part.low + wide * t[0], part.low + wide * t[1]), attained)


def _crosses_up(form: Numbers) -> bool:
    """One sign change, from negative to positive: exactly one root, and simple (Descartes' rule in Bernstein form)."""
    return sign(form[0]) < 0 < sign(form[-1]) and bs.sign_changes(form) == 1


def _crossing(part: _Part, *, attained: bool) -> Hit:
    """The contact where the only open constraint crosses zero once."""
    _, crossing, _ = events_of((part.open[0][1],))
    return _on_curve(part, crossing.t, attained)


def _halved(part: _Part) -> list[_Part]:
    """Both halves, the left one last (it is taken first)."""
    middle = (part.low + part.high) / 2
    split = [(i, halves(form)) for i, form in part.open]
    left = _Part(part.low, middle, [(i, sides[0]) for i, sides in split], part.depth + 1)
    return [_Part(middle, part.high, [(i, sides[1]) for i, sides in split], part.depth + 1), left]


def examine(curve: Bezier | Along, obstacle: Obstacle) -> Outcome:
    """Prove the whole curve clear of the obstacle, or find the first contact. Complete."""
    along = curve if isinstance(curve, Along) else Along(curve)
    if _are_disjoint(along.box, obstacle.box):
        return Clear(ClearanceArgument.BOXES, (None,) * len(obstacle.pieces))
    first: Hit | None = None
    spans: list[tuple[Span, ...] | None] = []
    for k, piece in enumerate(obstacle.pieces):
        if _are_disjoint(along.box, piece.box):
            spans.append(None)
            continue
        search = ContactSearch(piece)
        hit = search.run([along.form(c) for c in piece.constraints])
        spans.append(tuple(search.spans))
        if hit is not None:
            hit.piece = k
            first = hit if first is None else _earlier(hit, first)
    if first is None:
        return Clear(_argument(spans), tuple(spans))
    return _contact(along, obstacle, first)


def _argument(spans: Sequence[tuple[Span, ...] | None]) -> ClearanceArgument:
    shown = [span for piece in spans if piece is not None for span in piece]
    if any(span.constraint is None for span in shown):
        return ClearanceArgument.ROOTS
    if any(span.high - span.low < 1 for span in shown):
        return ClearanceArgument.SUBDIVISION
    return ClearanceArgument.POLYGON if shown else ClearanceArgument.BOXES


def _are_disjoint(a: Box | None, b: Box | None) -> bool:
    """Whether two closed boxes have no common point."""
    if a is None or b is None:
        return False
    return any(x < y for x, y in zip(a[1], b[0], strict=True)) or any(x > y for x, y in zip(a[0], b[1], strict=True))


def _earlier(a: Hit, b: Hit) -> Hit:
    """The first of two contacts; where they are as good as simultaneous, an interval around the smaller parameter."""
    if a.t[1] < b.t[0] or b.t[1] < a.t[0]:
        return a if a.t[1] < b.t[0] else b
    low, high = min(a.t[0], b.t[0]), min(a.t[1], b.t[1])
    return Hit((low, high), a.attained or b.attained, min(a.piece, b.piece))


def _contact(along: Along, obstacle: Obstacle, hit: Hit) -> Contact:
    low, high = hit.t
    curve = along.curve
    if low == high:
        point = curve.point(low)
        place = tuple(Enclosure(*bounds(c)) for c in point)
        return Contact(hit.t, place, point, enters(along, obstacle), hit.attained, hit.piece)
    part = curve.segment(low, high)
    rows = [[bounds(c) for c in part.coordinate(i)] for i in range(curve.dimension)]
    place = tuple(Enclosure(min(lo for lo, _ in row), max(hi for _, hi in row)) for row in rows)
    return Contact(hit.t, place, None, enters(along, obstacle), hit.attained, hit.piece)


def enters(curve: Bezier | Along, obstacle: Obstacle) -> bool:
    """Whether some point of the curve lies in the interior of a piece: f_i > 0 for all its constraints."""
    along = curve if isinstance(curve, Along) else Along(curve)
    for piece in obstacle.pieces:
        if not _are_disjoint(along.box, piece.box):
            strict = tuple(Constraint(c.terms, True) for c in piece.constraints)
            if ContactSearch(Piece(strict)).run([along.form(c) for c in strict]) is not None:
                return True
    return False

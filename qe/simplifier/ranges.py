"""Ranges: what a set of comparisons with rational numbers says about the value of one polynomial.

A range is an interval with rational or infinite ends, minus finitely many points. It stands for the
set of values that a real quantity may take; every operation returns a superset of the exact result,
so a range derived from true facts is a true fact.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from qe.formula.syntax import Relation


@dataclass(frozen=True, slots=True)
class Range:
    """The reals between ``lo`` and ``hi`` without ``holes``; an end of None is infinite.

    Invariant (``make``): holes lie strictly inside; an infinite end is open; a range whose ends contradict
    each other is ``EMPTY``.
    """

    lo: Fraction | None = None
    hi: Fraction | None = None
    lo_open: bool = True
    hi_open: bool = True
    holes: frozenset[Fraction] = frozenset()

    @property
    def is_empty(self) -> bool:
        """Whether no number lies in the range."""
        return self is EMPTY or (self.lo is not None and self.hi is not None and self.lo > self.hi)

    @property
    def point(self) -> Fraction | None:
        """The only value, or None."""
        return self.lo if self.lo is not None and self.lo == self.hi and not self.lo_open else None

    def admits(self, value: Fraction) -> bool:
        """Whether the value lies in the range."""
        if self.lo is not None and (value < self.lo or (value == self.lo and self.lo_open)):
            return False
        if self.hi is not None and (value > self.hi or (value == self.hi and self.hi_open)):
            return False
        return not self.holes or value not in self.holes

    def signs(self, value: Fraction) -> frozenset[int]:
        """The possible signs of (quantity - value)."""
        if self is EVERYTHING:
            return ANY_SIGN
        below, above = self.lo is None or self.lo < value, self.hi is None or self.hi > value
        return frozenset((-1,) * below + (0,) * self.admits(value) + (1,) * above)


def make(
    lo: Fraction | None,
    hi: Fraction | None,
    lo_open: bool,
    hi_open: bool,
    holes: frozenset[Fraction] = frozenset(),
) -> Range:
    """The range in normal form: holes at closed ends open them, holes outside vanish."""
    if holes:
        lo_open = lo_open or lo in holes
        hi_open = hi_open or hi in holes
        holes = frozenset(h for h in holes if (lo is None or lo < h) and (hi is None or h < hi))
    if lo is not None and hi is not None and (lo > hi or (lo == hi and (lo_open or hi_open))):
        return EMPTY
    return Range(lo, hi, lo is None or lo_open, hi is None or hi_open, holes)


EVERYTHING, ANY_SIGN = Range(), frozenset((-1, 0, 1))
EMPTY = Range(Fraction(1), Fraction(0), False, False)


def compare(relation: Relation, value: Fraction) -> Range:
    """The range of a quantity q with ``q relation value``."""
    match relation:
        case Relation.EQ:
            return Range(value, value, False, False)
        case Relation.NE:
            return Range(holes=frozenset((value,)))
        case Relation.LT | Relation.LE:
            return Range(None, value, True, relation is Relation.LT)
    return Range(value, None, relation is Relation.GT, True)


def meet(a: Range, b: Range) -> Range:
    """The intersection."""
    if a is EVERYTHING:
        return b
    if b is EVERYTHING or a is b:
        return a
    if a.is_empty or b.is_empty:
        return EMPTY
    lo, lo_open = _tighter(a.lo, a.lo_open, b.lo, b.lo_open, 1)
    hi, hi_open = _tighter(a.hi, a.hi_open, b.hi, b.hi_open, -1)
    return make(lo, hi, lo_open, hi_open, a.holes | b.holes)


def _tighter(
    a: Fraction | None, a_open: bool, b: Fraction | None, b_open: bool, direction: int
) -> tuple[Fraction | None, bool]:
    if a is None:
        return b, b_open
    if b is None:
        return a, a_open
    if a == b:
        return a, a_open or b_open
    return (a, a_open) if (a > b) == (direction > 0) else (b, b_open)


def describe(own: Range, base: Range, as_equations: bool) -> list[tuple[Relation, Fraction]]:
    """Comparisons whose conjunction, together with ``base``, says ``own``. Precondition: own is inside base, not empty.

    Only what ``base`` does not already say is listed. Where ``base`` ends at v and only v itself is to be
    excluded there are two ways to say so; ``as_equations`` chooses /= (its negation is an equation).
    """
    if own is base or own == base:
        return []
    if own.point is not None:
        return [(Relation.EQ, own.point)]
    out: list[tuple[Relation, Fraction]] = []
    low = own.lo, own.lo_open, (base.lo, base.lo_open), (Relation.GE, Relation.GT)
    high = own.hi, own.hi_open, (base.hi, base.hi_open), (Relation.LE, Relation.LT)
    for end, is_open, known, relations in (low, high):
        if end is not None and (end, is_open) != known:
            is_open = is_open and not (as_equations and end in base.holes)  # so that its negation is strict
            out.append((Relation.NE if as_equations and end == known[0] else relations[is_open], end))
    out += [(Relation.NE, h) for h in sorted(own.holes - base.holes)]
    return out


# --- arithmetic (supersets) --------------------------------------------------------------------


def add(a: Range, b: Range) -> Range:
    """Contains x + y for x in a, y in b."""
    lo = None if a.lo is None or b.lo is None else a.lo + b.lo
    hi = None if a.hi is None or b.hi is None else a.hi + b.hi
    return Range(lo, hi, lo is None or a.lo_open or b.lo_open, hi is None or a.hi_open or b.hi_open)


def scale(a: Range, factor: Fraction) -> Range:
    """Contains factor * x for x in a; ``factor`` is not zero."""
    lo = None if a.lo is None else a.lo * factor
    hi = None if a.hi is None else a.hi * factor
    holes = frozenset(h * factor for h in a.holes)
    if factor > 0:
        return Range(lo, hi, a.lo_open, a.hi_open, holes)
    return Range(hi, lo, a.hi_open, a.lo_open, holes)


def power(a: Range, exponent: int) -> Range:
    """Contains x**exponent for x in a, exponent at least 1."""
    if exponent == 1:
        return a
    zero = Fraction(0)
    lo = None if a.lo is None else a.lo**exponent
    hi = None if a.hi is None else a.hi**exponent
    if exponent % 2:
        return Range(lo, hi, a.lo_open, a.hi_open, frozenset((zero,)) & a.holes)
    if a.lo is not None and a.lo >= 0:
        return Range(lo, hi, a.lo_open, a.hi_open)
    if a.hi is not None and a.hi <= 0:
        return Range(hi, lo, a.hi_open, a.lo_open)
    top = None if lo is None or hi is None else max(lo, hi)
    return Range(zero, top, not a.admits(zero), top is None)


def multiply(a: Range, b: Range) -> Range:
    """Contains x * y for x in a, y in b; sharp in sign, and in size where both have one sign."""
    negative = False
    if a.hi is not None and a.hi <= 0:
        a, negative = scale(a, Fraction(-1)), not negative
    if b.hi is not None and b.hi <= 0:
        b, negative = scale(b, Fraction(-1)), not negative
    if a.lo is None or b.lo is None or a.lo < 0 or b.lo < 0:
        zero = Fraction(0)
        product = EVERYTHING if a.admits(zero) or b.admits(zero) else Range(holes=frozenset((zero,)))
    else:
        lo = a.lo * b.lo
        touched = (a.lo == 0 and not a.lo_open) or (b.lo == 0 and not b.lo_open)
        lo_open = (a.lo_open or b.lo_open) if lo else not touched
        hi = None if a.hi is None or b.hi is None else a.hi * b.hi
        product = make(lo, hi, lo_open, hi is None)
    return scale(product, Fraction(-1)) if negative else product

"""Bounds of linear forms: whether they can hold together, kept from one question to the next (general simplex).

Dutertre, de Moura, CAV 2006: every form is a variable of its own, tied to the others by a row; bounds come and go, rows
and values stay, so that a question like the last one takes few pivots. Strict bounds are weak ones moved by a positive
infinitesimal: values are pairs (a, b) for a + b*delta, compared lexicographically.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from fractions import Fraction

from flint import fmpq

Value = tuple[fmpq, fmpq]
Bound = tuple[Value, Hashable]
Term = tuple[int, bool, fmpq, Value, Hashable]
"""A bound in a contradiction: variable, whether it is an upper one, coefficient (negative for lower bounds), number,
reason."""
Offered = Callable[[int, bool], Iterable[tuple[Fraction, bool, Hashable]]]
"""Upper or lower bounds of a variable: number, strict, reason."""

_ZERO, _ONE = fmpq(0), fmpq(1)
_GREEDY = 60
"""Pivots that look for the largest violation, before Bland's rule sees to it that the search ends."""


class TooMuch(Exception):
    """The simplex method takes more work than it was to."""


class Bounds:
    """The bounds of variables, as they come and go; ``reasons`` of a conflict are those given with the bounds.

    ``stuck``: the contradiction that was found last; none where ``conflict`` found none.
    """

    def __init__(self) -> None:
        self.stuck: list[Term] = []
        self.lower: dict[int, Bound] = {}
        self.upper: dict[int, Bound] = {}
        self._changed: list[tuple[dict[int, Bound], int, Bound | None]] = []

    def mark(self) -> int:
        """The bounds as they are now, for ``back``."""
        return len(self._changed)

    def back(self, mark: int) -> None:
        """Take back the bounds set since; all else stays."""
        for bounds, x, before in reversed(self._changed[mark:]):
            if before is None:
                del bounds[x]
            else:
                bounds[x] = before
            self._rebound(bounds, x)
        del self._changed[mark:]

    def at_least(self, x: int, bound: Fraction, *, strict: bool, reason: Hashable) -> set[Hashable] | None:
        """x >= bound (>); the reasons of a contradiction with an upper bound, or None."""
        return self._bounded(x, 1, (fmpq(bound.numerator, bound.denominator), _ONE if strict else _ZERO), reason)

    def at_most(self, x: int, bound: Fraction, *, strict: bool, reason: Hashable) -> set[Hashable] | None:
        """x <= bound (<); the reasons of a contradiction with a lower bound, or None."""
        return self._bounded(x, -1, (fmpq(bound.numerator, bound.denominator), -_ONE if strict else _ZERO), reason)

    def _bounded(self, x: int, side: int, value: Value, reason: Hashable) -> set[Hashable] | None:
        """A lower bound (``side`` 1) or an upper one (-1)."""
        bounds, other = (self.lower, self.upper) if side > 0 else (self.upper, self.lower)
        if x in bounds and (bounds[x][0] >= value if side > 0 else bounds[x][0] <= value):
            return None
        if x in other and (other[x][0] < value if side > 0 else other[x][0] > value):
            self.stuck = [(x, side < 0, fmpq(-side), value, reason), (x, side > 0, fmpq(side), *other[x])]
            return {reason, other[x][1]}
        self._changed.append((bounds, x, bounds.get(x)))
        bounds[x] = value, reason
        self._rebound(bounds, x)
        return None

    def contradicted(self, weights: Mapping[int, fmpq | int]) -> list[Term]:
        """The bounds that multiples of the variables contradict which add up to zero; none where they do not.

        THEOREM (Farkas 1902, Motzkin 1936). The multiples, bounded above where they are positive and below where they
        are negative, add up to no more than those of the bounds: these must not be less than zero.
        """
        terms: list[Term] = []
        total = _ZERO, _ZERO
        for x, w in weights.items():
            known = (self.upper if w > 0 else self.lower).get(x)
            if known is None and w:
                return []
            if known is not None and w:
                (a, b), c = known[0], fmpq(w)
                total = total[0] + c * a, total[1] + c * b
                terms.append((x, w > 0, c, *known))
        return terms if total < (_ZERO, _ZERO) else []

    def weakened(self, offered: Offered) -> set[Hashable]:
        """After a conflict: reasons that contradict each other as well, each bound exchanged for the first of those
        ``offered`` (of a variable, upper ones or lower ones: bound, strict, reason) with which the sum still does."""
        return weakest(self.stuck, offered)

    def _rebound(self, bounds: dict[int, Bound], x: int) -> None:
        """Do what a changed bound asks for."""


class LinearBounds(Bounds):
    """Variables are numbers from 0. ``work``: how many entries pivots have computed; ``most``: how many they may."""

    def __init__(self, most: int | None = None) -> None:
        super().__init__()
        self.most = most
        self.rows: dict[int, dict[int, fmpq]] = {}
        self.using: list[set[int]] = []
        self.values: list[Value] = []
        self.work = 0

    def variable(self) -> int:
        """A new variable."""
        self.values.append((_ZERO, _ZERO))
        self.using.append(set())
        return len(self.values) - 1

    def form(self, coefficients: Mapping[int, Fraction | int]) -> int:
        """A new variable equal to a linear form in others."""
        row: dict[int, fmpq] = {}
        for x, c in coefficients.items():
            factor = fmpq(c.numerator, c.denominator)
            for y, other in self.rows[x].items() if x in self.rows else ((x, _ONE),):
                row[y] = row.get(y, _ZERO) + factor * other
        new = self.variable()
        self.rows[new] = row = {y: c for y, c in row.items() if c}
        first = second = _ZERO
        for y, c in row.items():
            self.using[y].add(new)
            first, second = first + c * self.values[y][0], second + c * self.values[y][1]
        self.values[new] = first, second
        return new

    def clear(self) -> None:
        """No bounds; rows and values stay as they are."""
        self.lower.clear()
        self.upper.clear()
        self._changed.clear()
        self.stuck = []

    def free(self, x: int) -> None:
        """No bounds on a variable from now on; what ``mark`` knew of them is lost."""
        self.lower.pop(x, None)
        self.upper.pop(x, None)
        self._changed.clear()

    def forget(self, x: int) -> None:
        """A form without bounds, whose row is no longer needed."""
        if x not in self.rows and self.using[x]:
            y, value = min(self.using[x]), self.values[min(self.using[x])]
            value = max(value, self.lower[y][0]) if y in self.lower else value
            self._pivot(y, x, min(value, self.upper[y][0]) if y in self.upper else value)
        for y in self.rows.pop(x, ()):
            self.using[y].discard(x)

    def start(self, x: int, value: Fraction) -> None:
        """Give a variable a value to start from, where it is free to have one; without bounds only."""
        if x not in self.rows:
            self._move(x, (fmpq(value.numerator, value.denominator), _ZERO))

    def conflict(self, check: Callable[[], object], *, now: bool = True) -> set[Hashable] | None:
        """None where all bounds can hold together; else reasons that cannot, by Farkas's lemma on one row.

        No reason can be left out of them as long as the row stands. ``check`` is called between pivots; it is
        always ``now``. Raises ``TooMuch``.
        """
        pivots, self.stuck = 0, []
        while True:
            check()
            if self.most is not None and self.work > self.most:
                raise TooMuch
            broken = self._broken(greedy=pivots < _GREEDY)
            if broken is None:
                return None
            x, wanted, up = broken
            row = self.rows[x]
            open_ones = [y for y, c in row.items() if self._may_move(y, up == (c > 0))]
            if not open_ones:
                sign = _ONE if up else -_ONE
                self.stuck = self.contradicted({x: -sign} | {y: sign * c for y, c in row.items()})
                return {reason for *_, reason in self.stuck}
            shortest = min(open_ones, key=lambda y: (len(self.using[y]), y))
            self._pivot(x, shortest if pivots < _GREEDY else min(open_ones), wanted)
            pivots += 1

    def contradiction(self) -> list[tuple[Hashable, Fraction]]:
        """After a conflict: the reasons, each with the factor of the variable that it bounds; these multiples
        of the variables add up to zero, and those of their bounds to a contradiction."""
        assert self.stuck
        return [(reason, Fraction(int(c.p), int(c.q))) for _, _, c, _, reason in self.stuck]

    def side(self, x: int, bound: Fraction) -> int:
        """The sign of x - bound for the present value of x."""
        value, other = self.values[x], (fmpq(bound.numerator, bound.denominator), _ZERO)
        return int(value > other) - int(value < other)

    def point(self) -> list[Fraction]:
        """Numbers for all variables that keep all bounds, after ``conflict`` found none."""
        delta = _ONE
        for bounds, s in ((self.lower, 1), (self.upper, -1)):
            for x, ((a, b), _) in bounds.items():
                gap, slope = s * (self.values[x][0] - a), s * (b - self.values[x][1])
                if slope > 0 and gap < delta * slope:
                    delta = gap / slope
        moved = (a + b * delta for a, b in self.values)
        return [Fraction(int(v.p), int(v.q)) for v in moved]

    # --- steps -------------------------------------------------------------------------------------
    def _may_move(self, y: int, up: bool) -> bool:
        if up:
            return y not in self.upper or self.values[y] < self.upper[y][0]
        return y not in self.lower or self.values[y] > self.lower[y][0]

    def _broken(self, *, greedy: bool) -> tuple[int, Value, bool] | None:
        """A basic variable outside its bounds, the bound, and whether it has to grow."""
        broken: tuple[int, Value, bool] | None = None
        most = _ZERO
        for x in self.rows:
            value = self.values[x]
            if x in self.lower and value < self.lower[x][0]:
                wanted, up = self.lower[x][0], True
            elif x in self.upper and value > self.upper[x][0]:
                wanted, up = self.upper[x][0], False
            else:
                continue
            size = abs(wanted[0] - value[0])
            if broken is None or (size > most if greedy else x < broken[0]):
                broken, most = (x, wanted, up), size
        return broken

    def _rebound(self, bounds: dict[int, Bound], x: int) -> None:
        """Move a variable without a row to a bound that it does not keep."""
        if x in bounds and x not in self.rows:
            bound, value = bounds[x][0], self.values[x]
            if value < bound if bounds is self.lower else value > bound:
                self._move(x, bound)

    def _move(self, x: int, value: Value) -> None:
        """Give a variable without a row this value, and the rows that use it theirs."""
        da, db = value[0] - self.values[x][0], value[1] - self.values[x][1]
        self.values[x] = value
        for r in self.using[x]:
            c, (a, b) = self.rows[r][x], self.values[r]
            self.values[r] = a + c * da, b + c * db

    def _pivot(self, x: int, y: int, wanted: Value) -> None:
        """x leaves its row at the value ``wanted``, y takes the row."""
        row, (a, b) = self.rows.pop(x), self.values[x]
        lead = row.pop(y)
        step = (wanted[0] - a) / lead, (wanted[1] - b) / lead
        for z in row:
            self.using[z].discard(x)
        self.using[y].discard(x)
        self._move(y, (self.values[y][0] + step[0], self.values[y][1] + step[1]))
        self.values[x] = wanted
        new = {z: -c / lead for z, c in row.items()}
        new[x] = 1 / lead
        self.work += len(new) * len(self.using[y])
        for r in list(self.using[y]):
            other = self.rows[r]
            factor = other.pop(y)
            for z, c in new.items():
                before = other.get(z)
                if before is None:
                    other[z] = factor * c
                    self.using[z].add(r)
                elif total := before + factor * c:
                    other[z] = total
                else:
                    del other[z]
                    self.using[z].discard(r)
        self.using[y] = set()
        self.rows[y] = new
        for z in new:
            self.using[z].add(y)


def weakest(terms: Iterable[Term], offered: Offered) -> set[Hashable]:
    """Reasons of a contradiction, as weak as those offered allow.

    The sum of the bounds, each times its coefficient, is negative; it grows by what a bound moves. Bounds that can
    move only a little come first, so that in a sum of 2^k*x_k those of large k stay.
    """
    total = _ZERO, _ZERO
    moves: list[list[tuple[Value, Hashable]]] = []
    for y, above, c, (a, b), reason in terms:
        total = total[0] + c * a, total[1] + c * b
        one = -_ONE if above else _ONE
        others = [
            ((c * (fmpq(p.numerator, p.denominator) - a), c * (strict * one - b)), other)
            for p, strict, other in offered(y, above)
        ]
        weaker = [] if reason is None else [move for move in others if move[0] >= (_ZERO, _ZERO)]
        moves.append([*weaker, ((_ZERO, _ZERO), reason)])
    reasons: set[Hashable] = set()
    for choices in sorted(moves, key=lambda choices: choices[0][0]):
        (p, q), reason = next(
            ((p, q), other) for (p, q), other in choices if (total[0] + p, total[1] + q) < (_ZERO, _ZERO)
        )
        total = total[0] + p, total[1] + q
        reasons.add(reason)
    return reasons

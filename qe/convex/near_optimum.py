"""Rational numbers on both sides of an optimum whose exact coordinates need a number field of high degree.

THEOREM (weak duality; Boyd, Vandenberghe: Convex Optimization, 5.2.2). Let f and g_i be convex, w_i >= 0, and y a point
with grad (f + sum w_i g_i)(y) = 0. Then f(x) >= f(x) + sum w_i g_i(x) >= f(y) + sum w_i g_i(y) wherever all g_i <= 0.
So f at any feasible point and the right side enclose the least value. Both are rational here: the weights are rounded
ones of the optimality conditions, which costs the square of the rounding, and the feasible point is moved a little from
the optimum towards a point where all g_i < 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count, islice

from qe.convex.violation import proposed
from qe.exact.kkt_system import HighDegree
from qe.exact.quadratic_form import Quadratic, combine, dot, solve_linear

GAP = Fraction(1, 10**9)
"""The proved difference of the two sides is at most this share of the value."""
_PLACES = 30  # decimal places that are tried; a rational point near the optimum is known to about 48
_ZERO, _ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True, slots=True)
class Bracket:
    """``point``: all forms are negative there; ``weights`` >= 0 by form, and ``stationary``: the y of the theorem;
    ``bound``: at most the value of the weighted sum there."""

    point: tuple[Fraction, ...]
    weights: dict[int, Fraction]
    stationary: tuple[Fraction, ...]
    bound: Fraction


def bracket(
    objective: Quadratic, forms: Sequence[Quadratic], known: HighDegree, check: Callable[[], object]
) -> Bracket | None:
    """Both sides of the least value where all forms are <= 0, at most ``GAP`` of it apart.

    None where the forms have no common interior near the optimum, the optimum is zero, or rational weights do not do.
    """
    value = Fraction(objective.value(known.near)) if known.near else _ZERO
    inside = proposed(forms)[0] if value else None
    if inside is None:
        return None
    unit = Fraction(10) ** (len(str(abs(value.numerator))) - len(str(value.denominator)))
    scaled, room = combine([1 / unit], [objective]), abs(value) / unit * GAP / 2
    dual = _dual(scaled, forms, known, value / unit - room, check)
    point = _primal(scaled, forms, known.near, inside, value / unit + room, check)
    if dual is None or point is None:
        return None
    weights, stationary, bound = dual
    return Bracket(point, {i: unit * w for i, w in weights.items()}, stationary, unit * bound)


Dual = tuple[dict[int, Fraction], tuple[Fraction, ...], Fraction]


def _dual(
    objective: Quadratic, forms: Sequence[Quadratic], known: HighDegree, least: Fraction, check: Callable[[], object]
) -> Dual | None:
    """Short weights on the support that give a bound of at least ``least``."""
    active = [forms[i] for i in known.support]
    for exact in islice(_rounded_weights(objective, active, known.near), _PLACES):
        check()
        total = combine([_ONE, *exact], [objective, *active])
        solution = total.stationary()
        if min(exact, default=_ZERO) < 0 or solution is None:
            continue
        value = total.value(solution.particular)
        if value > least:
            named = {i: w for i, w in zip(known.support, exact, strict=True) if w}
            decimals = (_decimal((least + value) / 2, places) for places in count())
            return named, solution.particular, next(d for d in decimals if least <= d <= value)
    return None


def _rounded_weights(
    objective: Quadratic, active: Sequence[Quadratic], near: Sequence[Fraction]
) -> Iterator[tuple[Fraction, ...]]:
    """The weights of the optimality conditions at a point, in the sense of least squares, to more and more digits.

    Where no Hessian bends the weighted sum, its slope has to vanish exactly: the weights satisfy these equations, and
    only those that they leave free are rounded.
    """
    slopes = [form.slope(near) for form in active]
    gram = [[dot(u, v) for v in slopes] for u in slopes]
    target = objective.slope(near)
    fitted = solve_linear(gram, [-dot(u, target) for u in slopes], len(active))
    rows = [row for form in (objective, *active) for row in form.hessian if any(row)]
    flat = solve_linear(rows, [_ZERO] * len(rows), objective.size)
    if fitted is None or flat is None:
        return
    straight = [[dot(form.gradient, d) for form in active] for d in flat.kernel]
    exact = solve_linear(straight, [-dot(objective.gradient, d) for d in flat.kernel], len(active))
    if exact is None:
        return
    for places in count(2):
        weights = list(exact.particular)
        for i, direction in zip(exact.free, exact.kernel, strict=True):
            share = _decimal(fitted.particular[i], places)
            weights = [w + share * d for w, d in zip(weights, direction, strict=True)]
        yield tuple(weights)


def _primal(
    objective: Quadratic,
    forms: Sequence[Quadratic],
    near: Sequence[Fraction],
    inside: Sequence[Fraction],
    most: Fraction,
    check: Callable[[], object],
) -> tuple[Fraction, ...] | None:
    """A point with few decimals where all forms are negative and the objective is at most ``most``."""
    for places in range(1, _PLACES):
        check()
        for shift in range(max(0, places - 6), places + 1):
            share = Fraction(1, 10**shift)
            moved = (_decimal(p + share * (c - p), places) for p, c in zip(near, inside, strict=True))
            point = tuple(moved)
            if objective.value(point) <= most and all(form.value(point) < 0 for form in forms):
                return point
    return None


def _decimal(value: Fraction, places: int) -> Fraction:
    return Fraction(round(value * 10**places), 10**places)

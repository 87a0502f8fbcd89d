"""Points of a region by random walks from variable to variable: each value lies in what the earlier ones leave."""

from __future__ import annotations

from fractions import Fraction
from itertools import islice
from random import Random

from qe.decomposition.interval import Interval, Number
from qe.exact.nearby import rational_between
from qe.exact.number import ExactPoint, Values, rational_ends, simplest
from qe.options import Budget
from qe.regions.region import Region

MOST_POINTS = 100_000
"""So many points may be asked for at once."""
TRIES = 64
"""Random walks in a row that may find nothing new before the rest of the points is looked for systematically."""
FAR = 8
"""How far a walk goes from the end of a range that goes on for ever."""
FEWEST_STEPS, STEPS = 4, 1 << 12
"""Into how many steps the width of a range is divided, at least, for a random value; for one of several different ones
into few at first, so that their values are short."""


def walked(region: Region, random: Random, budget: Budget, steps: int = STEPS) -> Values | None:
    """A random point of a region; None if there is none."""
    if region.is_empty:
        return None
    values: list[Number] = []
    for _ in region.order:
        budget.check("walk to a point", len(values))
        offered = region.fibre(values)
        values.append(_value(random.choice(offered), random, steps))
    return ExactPoint(zip(region.order, values, strict=True))


def different_points(region: Region, n: int, seed: int, budget: Budget) -> list[Values]:
    """Up to ``n`` different points, fewer only where there are no more; the same for the same seed."""
    random = Random(seed)
    points: dict[tuple[Number, ...], Values] = {}
    misses, steps = 0, FEWEST_STEPS
    while len(points) < n and misses < TRIES:
        point = walked(region, random, budget, steps)
        if point is None:
            return []
        before = len(points)
        points.setdefault(tuple(point.values()), point)
        if len(points) > before:
            misses = 0
        elif steps < STEPS:
            steps *= 2
        else:
            misses += 1
    if len(points) < n and misses:  # few isolated points, perhaps, that are hard to meet
        for point in region.sample_points():
            points.setdefault(tuple(simplest(value) for value in point.values()), point)
    return list(islice(points.values(), n))


def _value(offered: Interval, random: Random, steps: int) -> Number:
    """A value of an interval, rational unless it is a single irrational one."""
    lower, upper = offered
    if lower is not None and lower == upper:
        return simplest(lower)
    middle = rational_between(lower, upper)
    low, high = (middle - FAR if lower is None else lower), (middle + FAR if upper is None else upper)
    start, stop = (sum(rational_ends(end, 64), Fraction(0)) / 2 for end in (low, high))
    grid = _grid(stop - start, steps)
    value = Fraction(round((start + (stop - start) * Fraction(random.random())) / grid)) * grid
    return value if value in offered else middle


def _grid(width: Fraction, steps: int) -> Fraction:
    """The greatest power of two that is at most the width over ``steps``."""
    step = Fraction(1)
    while step * steps > width:
        step /= 2
    while step * steps * 2 <= width:
        step *= 2
    return step

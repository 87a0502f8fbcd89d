"""Points at which a polynomial with a negative value often shows it."""

from __future__ import annotations

import random
from collections.abc import Iterator
from fractions import Fraction
from itertools import islice, product

from qe.exact.ring import Poly

MOST = 400
_FAR = (Fraction(0), Fraction(1), Fraction(-1), Fraction(2), Fraction(-2), Fraction(1, 2), Fraction(-1, 2), Fraction(7))
_WIDE = tuple(Fraction(n) for n in (0, 1, 2, 3, 10, 100))


def grid(poly: Poly, orthant: frozenset[int] = frozenset()) -> Iterator[list[Fraction]]:
    """Points with small coordinates, at most ``MOST``; those of ``orthant`` are not negative."""
    used = poly.variables
    values = [[v for v in _FAR[: 8 if len(used) < 3 else 5] if v >= 0 or i not in orthant] for i in used]
    place = [Fraction(0)] * poly.ring.size
    for chosen in islice(product(*values), MOST):
        point = list(place)
        for i, v in zip(used, chosen, strict=True):
            point[i] = v
        yield point


def may_be_positive(poly: Poly, orthant: frozenset[int]) -> bool:
    """Whether no point of the grid has a negative value."""
    return all(poly.evaluate(point) >= 0 for point in grid(poly, orthant))


def drawn(poly: Poly, orthant: frozenset[int]) -> Iterator[list[Fraction]]:
    """Points of a larger grid, with coordinates that coincide and that are large, drawn once for all."""
    rng = random.Random(0)
    for _ in range(MOST):
        values = rng.sample(_WIDE, 2)
        place = [Fraction(0)] * poly.ring.size
        for i in poly.variables:
            value = rng.choice((*values, rng.choice(_WIDE)))
            place[i] = -value if i not in orthant and rng.random() < 0.5 else value
        yield place

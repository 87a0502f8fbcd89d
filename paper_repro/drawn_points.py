"""The filter of the authors' test points (github.com/teamsnactsukuba/ev3-cgs-qe-ik, GenerateSamplePoint.py), in floats.

x and y in (-200, 200), z in (0, 300), mm; the arm has L = 112. Its reach is that of the claim "nearer-is-reachable".
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np

SIDE, TOP = 200.0, 300.0
A = 44 * np.sqrt(2)
SHOULDER = 104 + A
"""Joint 4 is at the distance A from the z axis and at this height."""
REACH = 8 * np.sqrt(293) + 112
KEPT = 248.0


def reaches(x: Any, y: Any, z: Any) -> Any:
    """Whether the arm reaches the point."""
    return (np.hypot(x, y) - A) ** 2 + (z - SHOULDER) ** 2 <= REACH**2


def passes(x: Any, y: Any, z: Any) -> Any:
    """Whether the filter, as it is coded, keeps the point."""
    shift = A / np.hypot(x, y)
    return (x - shift) ** 2 + (y - shift) ** 2 + (z - SHOULDER) ** 2 <= KEPT**2


def share_thrown_away(cells: int = 4001) -> tuple[float, float]:
    """Bounds of the share of the reachable points of the box that do not pass, all of which that pass being reachable.

    Interval arithmetic over the squares of a grid, one row at a time: the height above each is enclosed. An odd number
    of cells keeps the axis, where the filter has a pole, inside one of them.
    """
    grid = np.linspace(-SIDE, SIDE, cells + 1)
    y = grid[:-1], grid[1:]
    reached, kept = np.zeros(2), np.zeros(2)
    with np.errstate(divide="ignore"):
        for x in itertools.pairwise(grid):
            squares = _square(*x), _square(*y)
            near, far = (np.sqrt(squares[0][k] + squares[1][k]) for k in (0, 1))
            off = [_square(side[0] - A / near, side[1] - A / far) for side in (x, y)]
            reached += _heights(REACH, _square(near - A, far - A))
            kept += _heights(KEPT, (off[0][0] + off[1][0], off[0][1] + off[1][1]))
    slack = 1e-9  # far above the rounding of these sums
    return 1 - kept[1] / reached[0] - slack, 1 - kept[0] / reached[1] + slack


def _square(low: Any, high: Any) -> tuple[Any, Any]:
    """The range of the square of what lies between."""
    inside = (low <= 0) & (high >= 0)
    return np.where(inside, 0.0, np.minimum(low**2, high**2)), np.maximum(low**2, high**2)


def _heights(radius: float, off: tuple[Any, Any]) -> Any:
    """Bounds of the sum of the lengths in z that a ball cuts out, by the squared distance of its centre."""
    halves = (np.sqrt(np.maximum(radius**2 - square, 0.0)) for square in reversed(off))
    return np.array([(np.minimum(h, SHOULDER) + np.minimum(h, TOP - SHOULDER)).sum() for h in halves])

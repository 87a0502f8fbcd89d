"""Paths within a stated gap, against the shortest way over points of the edges of all boxes (numpy, scipy)."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy.sparse.csgraph import dijkstra

import bezier
import qe
from bezier.scenes.route import Route, Wish

BOXES = [((30, 44, 20), (62, 70, 54)), ((45, 30, 40), (67, 58, 74))]
START, GOAL = (2, 50, 50), (98, 50, 50)
SCENE: dict[str, Any] = {
    "domain": {"low": [0, 0, 0], "high": [100, 100, 100]},
    "start": list(START),
    "goal": list(GOAL),
    "obstacle": [{"kind": "box", "low": list(low), "high": list(high)} for low, high in BOXES],
}


def _shortest_over_edges() -> float:
    """The shortest way whose corners are on the edges, 12 to each, a little outside."""
    points = [np.array(p, float) for p in (START, GOAL)]
    for low, high in BOXES:
        middle = (np.array(low) + high) / 2
        for axis, signs in product(range(3), product((0, 1), repeat=2)):
            for t in np.linspace(0, 1, 12):
                point = np.insert(np.array(signs, float), axis, t) * np.subtract(high, low) + low
                points.append(middle + (point - middle) * (1 + 1e-6))
    p = np.array(points)
    step, apart = p[None] - p[:, None], np.ones((len(p), len(p)), bool)
    for low, high in BOXES:
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.sort([(np.array(c) - p[:, None]) / step for c in (low, high)], axis=0)
        enter, leave = np.nanmax(ends[0], axis=2), np.nanmin(ends[1], axis=2)
        apart &= np.maximum(enter, 0) >= np.minimum(leave, 1)
    return float(dijkstra(np.where(apart, np.linalg.norm(step, axis=2), 0), indices=0)[1])


def test_ways_are_tried_until_the_gap_is_proved() -> None:
    found = [bezier.route(SCENE, shortest=True), bezier.route(SCENE, gap="1%")]
    plain, close = (route for route in found if isinstance(route, Route))
    assert plain.at_least == close.at_least is not None and close.longer <= Fraction(1, 100) < plain.longer
    best = _shortest_over_edges()
    assert float(close.at_least) <= best * (1 + 1e-9) and close.length <= Fraction(101, 100) * Fraction(best)
    t = np.linspace(0, 1, 2001)[:, None]
    for curve in close.curves:
        a, b, c, d = (np.array(point, float) for point in curve)
        at = a * (1 - t) ** 3 + 3 * b * t * (1 - t) ** 2 + 3 * c * t**2 * (1 - t) + d * t**3
        assert not any(np.any(np.all((at > low) & (at < high), axis=1)) for low, high in BOXES)
    close.check()
    assert str(close).endswith("%)")


@pytest.mark.parametrize("gap", ["-1%", "near", "5 %%", -0.1])
def test_a_gap_that_is_no_share_is_refused(gap: Any) -> None:
    with pytest.raises(qe.InputError, match="gap"):
        Wish.of(3, 1, gap)


def test_a_number_of_thousands_of_digits_is_one_line() -> None:
    for name in ("degree", "continuity", "gap"):
        with pytest.raises(qe.InputError, match=f"{name}: .*a large integer"):
            bezier.route(SCENE, shortest=True, **{name: -(10**5000)})  # type: ignore[arg-type]


def test_the_shortest_path_from_a_point_to_itself_has_no_length() -> None:
    found = bezier.route({**SCENE, "goal": SCENE["start"]}, gap="1%")
    found.check()
    assert found.length == found.at_least == 0

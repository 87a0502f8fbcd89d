"""A picture of what is known where a limit ended the work: three colours on a grid of points. For looking only."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

from qe import arguments
from qe.errors import InputError
from qe.extras import wanted
from qe.formula.evaluate import holds_at
from qe.options import Budget
from qe.proof.partial import Partial
from qe.regions.picture import FLAT, check_ending, written

TRUE_COLOUR, FALSE_COLOUR, OPEN_COLOUR = "#4c78a8", "#e8e8e8", "#f2b84b"
REACH = 5
"""The picture shows the values from -REACH to REACH."""

POINTS = {1: 401, 2: 40}
"""Points of the grid along each axis, by the number of variables."""


def plotted(partial: Partial, order: tuple[str, ...], path: str | Path | None, axes: Any, timeout: float | None) -> Any:
    """The matplotlib axes, with every grid point in the colour of its part; written to ``path`` where one is given.

    Raises ``InputError`` for other than one or two variables, ``BudgetExceeded`` past ``timeout`` seconds.
    """
    if len(order) not in POINTS:
        raise InputError(f"a picture of the parts needs 1 or 2 variables, there are {len(order)}")
    target = None if path is None else Path(path)
    if target is not None:
        check_ending(target)
        if target.suffix.lower() not in FLAT or axes is not None:
            raise InputError("a picture of the parts: a flat file or axes expected, not both")
    values = kinds(partial, order, Budget(arguments.seconds(timeout)))
    with wanted():
        if target is not None:
            return written(lambda own: _painted(values, order, own), target)
        return _painted(values, order, axes)


def kinds(partial: Partial, order: tuple[str, ...], budget: Budget) -> list[list[int]]:
    """By rows of the last variable: 0 where the question is proved to be false, 1 where it is open, 2 where true."""
    number = POINTS[len(order)]
    # the middles of equal cells: border lines of small coefficients are seldom met
    line = [Fraction((2 * k + 1) * REACH, number) - REACH for k in range(number)]
    rows: list[list[int]] = []
    for y in line if len(order) == 2 else [Fraction(0)]:
        budget.check("draw", len(rows), number)
        points = [dict(zip(order, (x, y), strict=False)) for x in line]
        rows.append(
            [2 if holds_at(partial.proved_true, p) else 0 if holds_at(partial.proved_false, p) else 1 for p in points]
        )
    return rows


def _painted(rows: list[list[int]], order: tuple[str, ...], axes: Any) -> Any:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    if axes is None:
        from matplotlib import pyplot

        axes = pyplot.figure().add_subplot()
    colours = [FALSE_COLOUR, OPEN_COLOUR, TRUE_COLOUR]
    frame = (-REACH, REACH, -REACH, REACH)
    axes.imshow(rows, origin="lower", extent=frame, cmap=ListedColormap(colours), vmin=0, vmax=2, aspect="auto")
    names = ("proved false", "open", "proved true")
    axes.legend(handles=[Patch(color=c, label=n) for c, n in zip(colours, names, strict=True)], loc="upper right")
    axes.set_xlabel(order[0])
    if len(order) == 2:
        axes.set_ylabel(order[1])
    else:
        axes.set_yticks([])
    return axes

"""Gordan's alternative, decided exactly over any ordered field: a direction that makes linear forms negative, or why
there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.convex.simplex import Nowhere, least_cost
from qe.exact.quadratic_form import Number, Vector, independent_rows, solve_linear
from qe.options import Budget

_ZERO, _ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True, slots=True)
class Descent:
    """``direction``.row < 0 for every row."""

    direction: tuple[Number, ...]


@dataclass(frozen=True, slots=True)
class Balance:
    """sum weights_i row_i = 0 with ``weights`` >= 0, not all of them zero; zero weights are left out."""

    weights: dict[int, Number]


def alternative(rows: Sequence[Vector], size: int, *, budget: Budget) -> Descent | Balance:
    """THEOREM (Gordan 1873). For rows of length ``size`` over an ordered field exactly one of the two exists."""
    for i, row in enumerate(rows):
        if not any(row):
            return Balance({i: _ONE})
    if len(independent_rows(rows)) == len(rows):
        solution = solve_linear(rows, [-_ONE] * len(rows), size)
        assert solution is not None
        return Descent(solution.particular)
    # sum w_i row_i = 0 with sum w_i = 1; without such weights (direction, s) has direction.row_i + s <= 0 and s > 0
    columns = [(*row, _ONE) for row in rows]
    least = least_cost(
        columns, [_ZERO] * size + [_ONE], [_ZERO] * len(rows), check=lambda: budget.check("optimum: strict conditions")
    )
    if isinstance(least, Nowhere):
        return Descent(least.dual[:size])
    return Balance(least.weights)

"""Gordan's alternative, decided exactly over any ordered field: a direction that makes linear forms negative, or why
there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.exact.quadratic_form import Number, Vector, independent_rows, solve_linear
from qe.options import Budget
from qe.solution.optimum_kkt import sign

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
    return _by_simplex(rows, size, budget)


def _by_simplex(rows: Sequence[Vector], size: int, budget: Budget) -> Descent | Balance:
    """Phase one of the simplex method for sum w_i row_i = 0, sum w_i = 1, w >= 0, with Bland's rule, which ends.

    One artificial variable per equation; their least sum s is zero iff there are such weights, and otherwise the dual
    solution (direction, s) has direction.row_i + s <= 0 for all i (Farkas 1902).
    """
    count, height = len(rows), size + 1
    table: list[list[Number]] = []
    for r in range(height):
        known = [row[r] for row in rows] if r < size else [_ONE] * count
        unit = [_ONE if k == r else _ZERO for k in range(height)]
        table.append([*known, *unit, _ONE if r == size else _ZERO])
    basic = [count + r for r in range(height)]
    goal = [sum(column, start=_ZERO) for column in zip(*table, strict=True)]
    goal[count : count + height] = [_ZERO] * height
    while True:
        budget.check("optimum: strict conditions")
        entering = next((j for j in range(count) if sign(goal[j]) > 0), None)
        if entering is None:
            break
        leaving = _leaving(table, basic, entering)
        pivot = table[leaving]
        scale = 1 / pivot[entering]
        pivot = table[leaving] = [v * scale if v else v for v in pivot]
        basic[leaving] = entering
        for r, row in enumerate(table):
            if r != leaving and row[entering]:
                table[r] = _without(row, pivot, entering)
        goal = _without(goal, pivot, entering)
    if goal[-1]:
        return Descent(tuple(v + _ONE for v in goal[count : count + size]))
    return Balance({basic[r]: row[-1] for r, row in enumerate(table) if basic[r] < count and row[-1]})


def _leaving(table: Sequence[Sequence[Number]], basic: Sequence[int], entering: int) -> int:
    """The row of the least ratio; of several the one whose variable comes first."""
    rows = [r for r, row in enumerate(table) if sign(row[entering]) > 0]
    ratios = {r: table[r][-1] / table[r][entering] for r in rows}
    least = min(ratios.values())
    return min((r for r in rows if ratios[r] == least), key=lambda r: basic[r])


def _without(row: Sequence[Number], pivot: Sequence[Number], column: int) -> list[Number]:
    factor = row[column]
    return [a - factor * b if b else a for a, b in zip(row, pivot, strict=True)]

"""The simplex method in standard form, exactly, over any ordered field; it ends by Bland's rule (Bland 1977)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.exact.field import FieldElement
from qe.exact.quadratic_form import Number, Quadratic, Vector

_ZERO, _ONE = Fraction(0), Fraction(1)


def sign(value: Number) -> int:
    """The sign of a Fraction or a field element."""
    if isinstance(value, FieldElement):
        return value.sign()
    return int(value > 0) - int(value < 0)


@dataclass(frozen=True, slots=True)
class Least:
    """Nonnegative ``weights`` (zeros left out) of least cost, and ``dual`` with dual.column_j <= cost_j for all j, with
    equality for the columns of the weights."""

    weights: dict[int, Number]
    dual: tuple[Number, ...]


@dataclass(frozen=True, slots=True)
class Nowhere:
    """No weights: ``dual``.column_j <= 0 for all j and dual.rhs > 0 (Farkas 1902)."""

    dual: tuple[Number, ...]


@dataclass(frozen=True, slots=True)
class Endless:
    """The cost has no lower bound: nonnegative ``weights`` whose columns add up to zero, of negative cost."""

    weights: dict[int, Number]


def least_cost(
    columns: Sequence[Vector], rhs: Vector, cost: Vector, *, check: Callable[[], object]
) -> Least | Nowhere | Endless:
    """Minimise sum cost_j w_j subject to sum w_j column_j = rhs, w >= 0. ``check`` is called between steps."""
    work = _Tableau(columns, rhs)
    count, height = len(columns), len(rhs)
    work.price([_ZERO] * count + [_ONE] * height)
    while (entering := work.entering()) is not None:
        check()
        row = work.leaving(entering)
        assert row is not None  # the sum of the artificial variables is bounded below
        work.pivot(row, entering)
    if work.goal[-1]:
        return Nowhere(work.dual(_ONE))
    work.drop_artificial()
    work.price([*cost, *([_ZERO] * height)])
    while (entering := work.entering()) is not None:
        check()
        row = work.leaving(entering)
        if row is None:
            return Endless(work.ray(entering))
        work.pivot(row, entering)
    return Least(work.weights(), work.dual(_ZERO))


def linear_optimum(
    objective: Quadratic, forms: Sequence[Quadratic], *, check: Callable[[], object]
) -> tuple[Least | Endless, tuple[Number, ...] | None]:
    """Minimise a linear polynomial subject to linear polynomials <= 0, by the dual problem in standard form: the
    greatest sum w_i forms_i(0) for weights w >= 0 with sum w_i grad forms_i = -grad objective. Its ``dual`` is the
    point; where it is endless, the weights contradict. Second: a direction in which the objective falls forever."""
    columns, cost = [form.gradient for form in forms], [-form.constant for form in forms]
    least = least_cost(columns, [-b for b in objective.gradient], cost, check=check)
    if not isinstance(least, Nowhere):
        return least, None
    anywhere = least_cost(columns, [_ZERO] * objective.size, cost, check=check)
    assert not isinstance(anywhere, Nowhere)  # no weights at all will do
    return anywhere, least.dual if isinstance(anywhere, Least) else None


class _Tableau:
    """Rows: the columns' coefficients, those of one artificial variable per row, the right side. ``goal``: the same for
    the cost, reduced by the basic variables. Rows whose right side is negative are turned about at the start."""

    def __init__(self, columns: Sequence[Vector], rhs: Vector) -> None:
        self.count, self.height = len(columns), len(rhs)
        self.turned = [-1 if sign(b) < 0 else 1 for b in rhs]
        self.rows: list[list[Number]] = []
        for r, (b, s) in enumerate(zip(rhs, self.turned, strict=True)):
            unit = [_ONE if k == r else _ZERO for k in range(self.height)]
            self.rows.append([*(column[r] * s for column in columns), *unit, b * s])
        self.basic = [self.count + r for r in range(self.height)]
        self.goal: list[Number] = []

    def price(self, cost: Sequence[Number]) -> None:
        """Begin to minimise a cost of all variables."""
        self.goal = [*cost, _ZERO]
        for row, variable in zip(self.rows, self.basic, strict=True):
            if cost[variable]:
                self.goal = [g - cost[variable] * v if v else g for g, v in zip(self.goal, row, strict=True)]

    def entering(self) -> int | None:
        """The first variable that lowers the cost; artificial ones never come back."""
        return next((j for j in range(self.count) if sign(self.goal[j]) < 0), None)

    def leaving(self, entering: int) -> int | None:
        """The row of the least ratio, of several the one whose variable comes first; None without a bound."""
        ratios = {r: row[-1] / row[entering] for r, row in enumerate(self.rows) if sign(row[entering]) > 0}
        if not ratios:
            return None
        least = min(ratios.values())
        return min((r for r, ratio in ratios.items() if ratio == least), key=lambda r: self.basic[r])

    def pivot(self, at: int, entering: int) -> None:
        scale = 1 / self.rows[at][entering]
        pivot = self.rows[at] = [v * scale if v else v for v in self.rows[at]]
        self.basic[at] = entering
        for r, row in enumerate(self.rows):
            if r != at and row[entering]:
                self.rows[r] = _without(row, pivot, entering)
        self.goal = _without(self.goal, pivot, entering)

    def drop_artificial(self) -> None:
        """Pivot artificial variables, all zero by now, out of the basis; one that stays has a row without columns."""
        for r, variable in enumerate(self.basic):
            if variable >= self.count:
                column = next((j for j in range(self.count) if self.rows[r][j]), None)
                if column is not None:
                    self.pivot(r, column)

    def weights(self) -> dict[int, Number]:
        """The basic variables that are not zero."""
        return {v: row[-1] for v, row in zip(self.basic, self.rows, strict=True) if v < self.count and row[-1]}

    def ray(self, entering: int) -> dict[int, Number]:
        """How the variables grow with one that nothing bounds."""
        others = {v: -row[entering] for v, row in zip(self.basic, self.rows, strict=True) if row[entering]}
        return {entering: _ONE, **others}

    def dual(self, artificial: Fraction) -> tuple[Number, ...]:
        """The multipliers of the rows, where an artificial variable costs ``artificial``."""
        prices = self.goal[self.count : self.count + self.height]
        return tuple((artificial - g) * s for g, s in zip(prices, self.turned, strict=True))


def _without(row: Sequence[Number], pivot: Sequence[Number], column: int) -> list[Number]:
    factor = row[column]
    return [a - factor * b if b else a for a, b in zip(row, pivot, strict=True)]

"""Proposals for linear conditions by HiGHS, in floats: a basis, and what it is worth. Nothing proposed is believed.

Huangfu, Hall 2018. The greatest t with row.x + scale * t <= 0 for some of the rows and t <= 1 always exists where the
equations can hold together: positive where all these rows can be strict, negative where they contradict each other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate
from math import inf
from typing import Any

from qe.convex.linear_rows import LinearRows

_DUAL: Mapping[str, object] = {"presolve": "off", "solver": "simplex", "simplex_strategy": 1}
_MOST_STEPS = 5_000
"""Steps of the simplex method to a contradiction beyond one for each variable, at most."""

_NEAR = 1e-7
"""How far from a bound a row is taken to keep it."""


@dataclass(frozen=True, slots=True)
class Slackened:
    """The rows of a system in x and t, the last column: row i has ``scales[i]`` * t as well, 0 for those without.

    Floats are asked for the difference from ``centre``, ``zoom`` times as large (Gleixner, Steffy, Wolter 2016).
    """

    system: LinearRows
    scales: Sequence[int]
    centre: Sequence[Fraction] = ()
    zoom: int = 1

    @property
    def size(self) -> int:
        """The column of t."""
        return len(self.system.names)

    def terms(self, i: int) -> Mapping[int, int]:
        """Row i with its multiple of t."""
        row = self.system.rows[i].terms
        return {**row, self.size: self.scales[i]} if self.scales[i] else row

    def right(self, i: int) -> Fraction | int:
        """What is left for the terms of row i, seen from the centre."""
        constant = -self.system.rows[i].constant
        if not self.centre:
            return constant
        return self.zoom * (constant - sum(c * self.centre[j] for j, c in self.terms(i).items()))

    @property
    def is_solved(self) -> bool:
        """Whether the centre itself keeps all rows."""
        rests = map(self.right, range(len(self.system.rows)))
        kept = (rest == 0 if row.is_equation else rest >= 0 for row, rest in zip(self.system.rows, rests))
        return self.highest >= 0 and all(kept)

    @property
    def highest(self) -> Fraction | int:
        """What t may be at most, seen from the centre."""
        return self.zoom * (1 - self.centre[self.size]) if self.centre else 1


@dataclass(frozen=True, slots=True)
class Proposal:
    """``columns`` are basic, ``rows`` tight, as many; ``point`` and ``multipliers`` in floats; ``ray``: the multipliers
    are said to contradict, as the equations do among themselves."""

    columns: Sequence[int]
    rows: Sequence[int]
    point: Sequence[float]
    multipliers: Sequence[float]
    ray: bool = False


Proposer = Callable[[Slackened, float | None], Proposal | None]
"""From the problem and the seconds left; None where there is nothing to propose."""


def highs(problem: Slackened, seconds: float | None) -> Proposal | None:
    """What HiGHS proposes; None where it is not installed or fails. Raises ``OverflowError`` beyond floats."""
    try:
        import highspy
    except ImportError:
        return None
    sparse = problem.system.is_sparse
    dense: Mapping[str, object] = {"presolve": "off", "simplex_strategy": 4, "simplex_scale_strategy": 0}  # scaled rows
    solver = _solver(seconds, {"solver": "ipm"} if sparse else dense)
    model = _Model(problem)
    solver.passModel(model.program)
    solver.run()
    if solver.getModelStatus() == highspy.HighsModelStatus.kInfeasible:
        return _contradiction(seconds, model)
    basis, solution = solver.getBasis(), solver.getSolution()
    if solver.getModelStatus() != highspy.HighsModelStatus.kOptimal or not basis.valid:
        return None
    status = highspy.HighsBasisStatus
    columns = [j for j, state in enumerate(basis.col_status) if state == status.kBasic]
    rows = [i for i, state in zip(model.numbers, basis.row_status) if state != status.kBasic]
    for side, bounds in ((status.kLower, model.least), (status.kUpper, model.most)):
        on_bounds = [j for j, state in enumerate(basis.col_status) if state == side and bounds.get(j, (0, -1))[1] >= 0]
        columns += on_bounds
        rows += [bounds[j][1] for j in on_bounds]
    return Proposal(columns, rows, list(solution.col_value), model.multipliers(solution.row_dual, cost=True))


def _contradiction(seconds: float | None, model: _Model) -> Proposal | None:
    """What the simplex method without presolving says of conditions that cannot hold together."""
    solver = _solver(seconds, {**_DUAL, "simplex_iteration_limit": _MOST_STEPS + model.problem.size})
    solver.passModel(model.program)
    solver.run()
    _, known, ray = solver.getDualRay()
    return Proposal((), (), (), model.multipliers(ray), ray=True) if known else None


def _solver(seconds: float | None, options: Mapping[str, object]) -> Any:
    """HiGHS without a word."""
    import highspy

    solver = highspy.Highs()
    limit = {} if seconds is None else {"time_limit": seconds}
    for name, value in {"output_flag": False, "log_to_console": False, "threads": 1, **limit, **options}.items():
        solver.setOptionValue(name, value)
    return solver


class _Model:
    """The linear program, each row divided by a power of two so that floats hold it. Inequalities in one variable are
    its bounds: by column ``least`` and ``most``, each with its row; ``numbers`` and ``units`` belong to the others."""

    def __init__(self, problem: Slackened) -> None:
        self.problem = problem
        self.numbers, self.units, self.terms = list[int](), list[int](), list[Mapping[int, float]]()
        self.least, self.most = dict[int, tuple[float, int]](), {problem.size: (float(problem.highest), -1)}
        upper, lower = list[float](), list[float]()
        units = [1 << max(0, max(map(abs, row.terms.values())).bit_length() - 20) for row in problem.system.rows]
        self.base = min(units, default=1)
        for i, (row, unit) in enumerate(zip(problem.system.rows, units)):
            given, right = problem.terms(i), problem.right(i)
            if len(given) == 1 and not row.is_equation:
                ((j, c),) = given.items()
                bounds, number = (self.most if c > 0 else self.least), float(Fraction(right) / c)
                if j not in bounds or (number - bounds[j][0]) * c < 0:
                    bounds[j] = number, i
                continue
            self.numbers.append(i)
            self.units.append(unit)
            self.terms.append(given if unit == 1 else {j: c / unit for j, c in given.items()})
            upper.append(float(right / unit))
            lower.append(upper[-1] if row.is_equation else -inf)
        self.program = _program(problem.size + 1, self.terms, lower, upper, last=self.most[problem.size][0])
        for name, bounds in (("col_lower_", self.least), ("col_upper_", self.most)):
            numbers = list(getattr(self.program, name))
            for j, (number, _) in bounds.items():
                numbers[j] = number
            setattr(self.program, name, numbers)

    def multipliers(self, duals: Sequence[float], *, cost: bool = False) -> list[float]:
        """Those of all rows, as multiples of one number, from those of the rows of the program: those of bounds are
        what the others leave of each column, but for what t is worth (``cost``)."""
        worth, rests = [0.0] * len(self.problem.system.rows), {self.problem.size: float(cost)}
        for i, w, unit, row in zip(self.numbers, duals, self.units, self.terms):
            if w:
                worth[i] = w / (unit // self.base)
                for j, c in row.items():
                    rests[j] = rests.get(j, 0.0) + w * c
        for j, rest in rests.items():
            _, i = (self.most if rest > 0 else self.least).get(j, (0.0, -1))
            if rest and i >= 0:
                worth[i] = -rest / (self.problem.system.rows[i].terms[j] / self.base)
        return worth


def _program(
    size: int, rows: Sequence[Mapping[int, float]], lower: Sequence[float], upper: Sequence[float], last: float = inf
) -> Any:
    """Rows between bounds, all variables free; where the ``last`` is at most a number, it is to be greatest."""
    import highspy
    import numpy as np

    made = highspy.HighsLp()
    made.num_col_, made.num_row_ = size, len(rows)
    made.col_cost_ = np.array([0.0] * (size - 1) + [-1.0 if last < inf else 0.0])
    made.col_lower_ = np.full(size, -inf)
    made.col_upper_ = np.array([inf] * (size - 1) + [last])
    made.row_lower_, made.row_upper_ = np.array(lower), np.array(upper)
    made.a_matrix_.format_ = highspy.MatrixFormat.kRowwise
    made.a_matrix_.start_ = np.array([0, *accumulate(map(len, rows))])
    made.a_matrix_.index_ = np.array([j for row in rows for j in row])
    made.a_matrix_.value_ = np.array([c for row in rows for c in row.values()], dtype=float)
    return made


class FloatRows:
    """Rows in floats whose bounds, ``lower`` and ``upper``, come and go: each question starts where the last one ended.
    ``values`` of the rows at a ``point`` that kept all bounds when it was looked for."""

    def __init__(self, size: int, rows: Sequence[Mapping[int, float]], seconds: float | None) -> None:
        import numpy as np

        self.lower, self.upper = np.full(len(rows), -inf), np.full(len(rows), inf)
        self.values: Any = np.zeros(len(rows))
        self.point: Sequence[float] = [0.0] * size
        self._known = self.lower.copy(), self.upper.copy()
        self._solver = _solver(seconds, _DUAL)
        self._solver.passModel(_program(size, rows, self.lower.tolist(), self.upper.tolist()))

    def contradiction(self) -> dict[int, float] | None:
        """Multipliers of rows whose bounds are said to contradict each other; None where the point keeps all, now."""
        import highspy
        import numpy as np

        if ((self.lower - _NEAR <= self.values) & (self.values <= self.upper + _NEAR)).all():
            return None
        (changed,) = np.nonzero((self.lower != self._known[0]) | (self.upper != self._known[1]))
        self._known = self.lower.copy(), self.upper.copy()
        self._solver.changeRowsBounds(len(changed), changed.astype(np.int32), self.lower[changed], self.upper[changed])
        self._solver.run()
        status = self._solver.getModelStatus()
        if status == highspy.HighsModelStatus.kUnknown:  # where it started from was of no use
            self._solver.clearSolver()
            self._solver.run()
            status = self._solver.getModelStatus()
        if status == highspy.HighsModelStatus.kOptimal:
            solution = self._solver.getSolution()
            self.values, self.point = np.array(solution.row_value), solution.col_value
        if status != highspy.HighsModelStatus.kInfeasible:
            return None
        _, known, ray = self._solver.getDualRay()
        (support,) = np.nonzero(ray) if known else ((),)
        return {int(i): float(ray[i]) for i in support}


class Offers:
    """Bounds of rows by the literals that say them: literal, row, number, whether it is an upper one and strict."""

    def __init__(self, offered: Sequence[tuple[int, int, float, bool, bool]]) -> None:
        import numpy as np

        self._literals, self._rows, self._numbers, upper, strict = (np.array(c) for c in zip(*offered, strict=True))
        self._signs = np.where(upper, -1.0, 1.0)
        self._least = np.where(strict, _NEAR, -_NEAR)
        self._held = np.zeros(len(self._rows), dtype=bool)
        self._seen: Sequence[float] = ()

    def changes(self, values: Sequence[float]) -> list[int]:
        """The literals that hold where the rows have these values, and did not when this was asked last."""
        import numpy as np

        if values is self._seen:
            return []
        self._seen = values
        held = (np.asarray(values)[self._rows] - self._numbers) * self._signs > self._least
        new, self._held = held & ~self._held, held
        return [int(literal) for literal in self._literals[new]]

"""Proposals for linear conditions by HiGHS, in floats: a basis, and what it is worth. Nothing proposed is believed.

Huangfu, Hall 2018. The greatest t with row.x + scale * t <= 0 for some of the rows and t <= 1 always exists where the
equations can hold together: positive where all these rows can be strict, negative where they contradict each other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from qe.convex.linear_rows import LinearRows

_SPARSE, _MANY = 0.2, 5_000
"""Below that share of entries, and with more of them, an interior method with crossover is faster than the simplex
method (measured: 3,000 rows of 5 entries in 1,000 variables 0.55 s for 1.4 s, 1,280 dense rows 4 s for 2 s)."""


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
    """What HiGHS proposes; None where it is not installed, fails, or the numbers are beyond floats."""
    try:
        import highspy
    except ImportError:
        return None
    solver = highspy.Highs()
    entries = sum(len(row.terms) for row in problem.system.rows)
    sparse = entries > _MANY and entries < _SPARSE * problem.size * len(problem.system.rows)
    options: dict[str, Any] = {"output_flag": False, "log_to_console": False, "threads": 1}
    options |= {"solver": "ipm"} if sparse else {"presolve": "off", "simplex_strategy": 4}
    if seconds is not None:
        options["time_limit"] = seconds
    for name, value in options.items():
        solver.setOptionValue(name, value)
    try:
        solver.passModel(_model(problem))
    except OverflowError:
        return None
    solver.run()
    if solver.getModelStatus() == highspy.HighsModelStatus.kInfeasible:
        return _contradiction(solver, problem)
    basis, solution = solver.getBasis(), solver.getSolution()
    if solver.getModelStatus() != highspy.HighsModelStatus.kOptimal or not basis.valid:
        return None
    basic = highspy.HighsBasisStatus.kBasic
    columns = [j for j, status in enumerate(basis.col_status) if status == basic]
    rows = [i for i, status in enumerate(basis.row_status) if status != basic]
    return Proposal(columns, rows, list(solution.col_value), list(solution.row_dual))


def _contradiction(solver: Any, problem: Slackened) -> Proposal | None:
    """What the simplex method without presolving says of equations that cannot hold together."""
    for name, value in (("presolve", "off"), ("solver", "simplex"), ("simplex_strategy", 1)):
        solver.setOptionValue(name, value)
    solver.clearSolver()
    solver.run()
    _, known, ray = solver.getDualRay()
    return Proposal((), (), (), list(ray), ray=True) if known else None


def _model(problem: Slackened) -> Any:
    """The linear program, each row divided by a power of two so that floats hold it."""
    import highspy
    import numpy as np

    rows, size, infinity = problem.system.rows, problem.size, highspy.kHighsInf
    starts, columns, values, upper, lower = [0], list[int](), list[float](), list[float](), list[float]()
    for i, row in enumerate(rows):
        terms = problem.terms(i)
        unit = 1 << max(0, max(map(abs, row.terms.values())).bit_length() - 20)
        columns += terms
        values += terms.values() if unit == 1 else [c / unit for c in terms.values()]
        starts.append(len(columns))
        upper.append(float(problem.right(i) / unit))
        lower.append(upper[-1] if row.is_equation else -infinity)
    made = highspy.HighsLp()
    made.num_col_, made.num_row_ = size + 1, len(rows)
    made.col_cost_ = np.array([0.0] * size + [-1.0])
    made.col_lower_ = np.full(size + 1, -infinity)
    made.col_upper_ = np.array([infinity] * size + [float(problem.highest)])
    made.row_lower_, made.row_upper_ = np.array(lower), np.array(upper)
    made.a_matrix_.format_ = highspy.MatrixFormat.kRowwise
    made.a_matrix_.start_ = np.array(starts)
    made.a_matrix_.index_ = np.array(columns)
    made.a_matrix_.value_ = np.array(values, dtype=float)
    return made

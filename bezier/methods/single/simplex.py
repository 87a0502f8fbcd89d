"""Linear programs over Q, solved exactly: lexicographic optima with dual certificates, or a proved contradiction.

The simplex method in dictionary form (Chvatal, "Linear Programming", 1983, chapters 2-3 and 8) with Bland's rule, which
always ends. All entries of the dictionary are integers over one common denominator, the last pivot, and every division
by it is exact (Edmonds 1967; Bareiss 1968).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from qe.convex.evidence import optimum_certificate
from qe.errors import InternalError, Unable
from qe.exact.field import NumberField
from qe.exact.quadratic_form import Quadratic
from qe.proof.certificate import Certificate
from qe.proof.multipliers import FormRelation, OptimumEvidence, OptimumStatus

Numbers = tuple[Fraction, ...]
Check = Callable[[], object]


@dataclass(frozen=True, slots=True)
class LinearRow:
    """coefficients . x <= bound, or = bound for an ``equation``."""

    coefficients: Numbers
    bound: Fraction
    equation: bool = False

    def at(self, x: Sequence[Fraction]) -> Fraction:
        """coefficients . x - bound."""
        return sum((a * v for a, v in zip(self.coefficients, x, strict=True)), -self.bound)


@dataclass(frozen=True, slots=True)
class LinearProgram:
    """The points x with x_j >= lower_j and all rows. Invariant: as many lower bounds and coefficients as names."""

    names: tuple[str, ...]
    lower: Numbers
    rows: tuple[LinearRow, ...]

    def __post_init__(self) -> None:
        if any(len(numbers) != len(self.names) for numbers in (self.lower, *(row.coefficients for row in self.rows))):
            raise InternalError("a linear program with rows of different lengths")


@dataclass(frozen=True, slots=True)
class Duals:
    """One number per row (>= 0 unless it is an equation) and one >= 0 per lower bound."""

    rows: Numbers
    bounds: Numbers


@dataclass(frozen=True, slots=True)
class LinearOptimum:
    """``point`` minimises the first objective c, among those points the second one, and so on.

    ``duals`` prove it for the first: c.x + sum rows_i (a_i.x - b_i) + sum bounds_j (lower_j - x_j) = ``value`` for all
    x.
    """

    value: Fraction
    point: Numbers
    duals: Duals
    unique: bool
    """Whether no other point minimises the first objective; False also when that is not known."""


@dataclass(frozen=True, slots=True)
class Contradiction:
    """No point: sum rows_i (a_i.x - b_i) + sum bounds_j (lower_j - x_j) is a positive constant (Farkas 1902)."""

    duals: Duals


Outcome = LinearOptimum | Contradiction


def solve(program: LinearProgram, objectives: Sequence[Sequence[Fraction]], *, check: Check = lambda: None) -> Outcome:
    """Minimise the objectives, the earlier ones first. ``check`` is called between pivots and may raise.

    Raises ``Unable`` when an objective falls without bound.
    """
    work = _Dictionary(program, objectives, check)
    contradiction = work.enter_equations() or work.make_feasible()
    if contradiction is not None:
        return Contradiction(contradiction)
    unique = False
    for k in range(len(objectives)):
        work.minimise(k)
        work.keep_optimal(k)
        unique = unique or (k == 0 and not work.free_columns())
    return work.optimum(unique)


class _Dictionary:
    """basic variables = (constant + coefficients . nonbasic variables) / denominator, the same for the objectives.

    Variables: 0 .. n-1 are x_j - lower_j, n + i is the slack of row i times ``scales[i]``, and ``AUXILIARY`` measures
    the violation. Column 0 of an entry row is the constant. ``fixed``: nonbasic variables that have to stay zero.
    """

    AUXILIARY = -1

    def __init__(self, program: LinearProgram, objectives: Sequence[Sequence[Fraction]], check: Check) -> None:
        self.program, self.check, self.denominator = program, check, 1
        size = len(program.names)
        self.size = size
        shifted = [(row.at(program.lower), row.coefficients) for row in program.rows]
        self.scales = [_common([v, *a]) for v, a in shifted]
        self.rows = [[int(-s * v), *(int(-s * c) for c in a)] for s, (v, a) in zip(self.scales, shifted, strict=True)]
        self.basic = list(range(size, size + len(self.rows)))
        self.nonbasic = list(range(size))
        self.fixed: set[int] = set()
        self.cost_scales = [_common(c) for c in objectives]
        self.costs = [[0, *(int(s * v) for v in c)] for s, c in zip(self.cost_scales, objectives, strict=True)]
        self.objectives = objectives

    # --- steps ---------------------------------------------------------------------------------------------------

    def pivot(self, r: int, c: int) -> None:
        """Exchange the basic variable of row ``r`` with the nonbasic one of column ``c`` (from 0)."""
        self.check()
        row, old, column = self.rows[r], self.denominator, c + 1
        sign = 1 if row[column] > 0 else -1
        new = abs(row[column])
        turned = [-sign * v for v in row]
        turned[column] = sign * old
        for other in (*self.rows, *self.costs):
            factor = other[column]
            if other is row:
                continue
            if factor:
                other[:] = [(new * v + factor * w) // old for v, w in zip(other, turned, strict=True)]
                other[column] = sign * factor
            elif new != old:
                other[:] = [new * v // old for v in other]
        row[:] = turned
        self.denominator = new
        self.basic[r], self.nonbasic[c] = self.nonbasic[c], self.basic[r]

    def enter_equations(self) -> Duals | None:
        """Make the slacks of all equations nonbasic and fixed; the proof if the equations contradict each other."""
        for i, row in enumerate(self.program.rows):
            if not row.equation:
                continue
            slack = self.size + i
            r = self.basic.index(slack)
            c = next((c for c in self.free_columns() if self.rows[r][c + 1]), None)
            if c is not None:
                self.pivot(r, c)
                self.fixed.add(slack)
            elif self.rows[r][0]:
                sign = 1 if self.rows[r][0] > 0 else -1
                return self.duals([sign * v for v in self.rows[r]], {slack: -sign * self.denominator})
            else:
                del self.rows[r], self.basic[r]
        return None

    def make_feasible(self) -> Duals | None:
        """All constants >= 0, by minimising one violation added to every row; the proof if that is impossible."""
        if all(row[0] >= 0 for row in self.rows):
            return None
        for row in self.rows:
            row.append(self.denominator)
        for cost in self.costs:
            cost.append(0)
        self.nonbasic.append(self.AUXILIARY)
        self.pivot(min(range(len(self.rows)), key=lambda r: self.rows[r][0]), len(self.nonbasic) - 1)
        while self.AUXILIARY in self.basic:
            r = self.basic.index(self.AUXILIARY)
            if self.rows[r][0] == 0:
                self.drop_auxiliary(r)
                break
            entering = self.entering(self.rows[r])
            if entering is None:
                return self.duals(self.rows[r])
            self.pivot(self.leaving(entering), entering)
        self.remove_column(self.AUXILIARY)
        return None

    def drop_auxiliary(self, r: int) -> None:
        """Take the auxiliary variable, whose value is zero, out of the basis."""
        c = next((c for c in self.free_columns() if self.rows[r][c + 1]), None)
        if c is None:
            del self.rows[r], self.basic[r]
        else:
            self.pivot(r, c)

    def remove_column(self, variable: int) -> None:
        """Forget a nonbasic variable, if it is there."""
        if variable in self.nonbasic:
            c = self.nonbasic.index(variable)
            del self.nonbasic[c]
            for row in (*self.rows, *self.costs):
                del row[c + 1]

    def minimise(self, k: int) -> None:
        """Pivot until objective ``k`` cannot fall any more."""
        while (entering := self.entering(self.costs[k])) is not None:
            self.pivot(self.leaving(entering), entering)

    def keep_optimal(self, k: int) -> None:
        """Fix the variables whose growth would raise objective ``k``: they are zero at all its optimal points."""
        self.fixed |= {self.nonbasic[c] for c in self.free_columns() if self.costs[k][c + 1]}

    # --- choices -------------------------------------------------------------------------------------------------

    def free_columns(self) -> list[int]:
        """The columns of variables that may grow."""
        return [c for c, variable in enumerate(self.nonbasic) if variable not in self.fixed]

    def entering(self, cost: Sequence[int]) -> int | None:
        """The column of the first variable whose growth lowers the cost (Bland 1977)."""
        falling = [c for c in self.free_columns() if cost[c + 1] < 0]
        return min(falling, key=lambda c: self.nonbasic[c], default=None)

    def leaving(self, c: int) -> int:
        """The row that first reaches zero as column ``c`` grows; the first variable among equals (Bland 1977)."""
        best: int | None = None
        for r, row in enumerate(self.rows):
            if row[c + 1] < 0:
                if best is None:
                    best = r
                    continue
                champion = self.rows[best]
                difference = row[0] * champion[c + 1] - champion[0] * row[c + 1]  # > 0: this row is reached earlier
                if difference > 0 or (difference == 0 and self.basic[r] < self.basic[best]):
                    best = r
        if best is None:
            raise Unable("a linear objective falls without bound")
        return best

    # --- answers -------------------------------------------------------------------------------------------------

    def duals(self, row: Sequence[int], extra: dict[int, int] | None = None, scale: Fraction = Fraction(1)) -> Duals:
        """The multipliers that the coefficients of a dictionary row give, times ``scale``."""
        held = dict(zip(self.nonbasic, row[1:], strict=True)) | (extra or {})
        of_rows = [Fraction(held.get(self.size + i, 0)) * s * scale for i, s in enumerate(self.scales)]
        return Duals(tuple(of_rows), tuple(Fraction(held.get(j, 0)) * scale for j in range(self.size)))

    def optimum(self, unique: bool) -> LinearOptimum:
        """The answer, from a dictionary in which all objectives are minimal."""
        height = dict(zip(self.basic, (row[0] for row in self.rows), strict=True))
        lower = self.program.lower
        point = tuple(low + Fraction(height.get(j, 0), self.denominator) for j, low in enumerate(lower))
        value = sum((c * x for c, x in zip(self.objectives[0], point, strict=True)), Fraction(0))
        scale = Fraction(1, self.denominator * self.cost_scales[0])
        return LinearOptimum(value, point, self.duals(self.costs[0], scale=scale), unique)


def _common(numbers: Sequence[Fraction]) -> int:
    return lcm(*(Fraction(v).denominator for v in numbers))


def certificate(program: LinearProgram, objective: Sequence[Fraction], outcome: Outcome) -> Certificate:
    """The outcome as a certificate that ``qe.verify`` accepts: constraints in the order rows, then lower bounds."""
    size = len(program.names)
    unit = [tuple(Fraction(int(i == j)) for i in range(size)) for j in range(size)]
    forms = [_linear(row.coefficients, -row.bound) for row in program.rows]
    forms += [_linear(tuple(-v for v in unit[j]), low) for j, low in enumerate(program.lower)]
    relations = [FormRelation.EQ if row.equation else FormRelation.LE for row in program.rows]
    optimal = isinstance(outcome, LinearOptimum)
    evidence = OptimumEvidence(
        names=program.names,
        objective=_linear(tuple(objective), Fraction(0)),
        forms=tuple(forms),
        relations=(*relations, *[FormRelation.LE] * size),
        status=OptimumStatus.OPTIMAL if optimal else OptimumStatus.INFEASIBLE,
        field=NumberField.rationals(),
        faces=(),
        point=outcome.point if isinstance(outcome, LinearOptimum) else program.lower,
        multipliers=(*outcome.duals.rows, *outcome.duals.bounds),
        attained=True if optimal else None,
        unique=False if optimal else None,
    )
    return optimum_certificate(evidence)


def _linear(gradient: Numbers, constant: Fraction) -> Quadratic:
    size = len(gradient)
    return Quadratic(((Fraction(0),) * size,) * size, gradient, constant)

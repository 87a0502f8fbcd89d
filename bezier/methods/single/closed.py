"""Method 1*: problem (4) with the conditions that it lacks, for all t, by constraint generation in exact arithmetic.

    for all t in [t_a, t_b]: P_y(t) >= h_y and P_z(t) >= h_z;   for all t in [0, 1]: |P(t)|^2 <= r^2 (and P_z(t) >= 0)

A linear program over Q holds (4) and cuts at finitely many t (``cuts``); its exact optimum is a proved
lower bound (Kelley 1960). First the cuts' common slack is maximised until a curve is proved to satisfy everything or
the program contradicts itself, which proves that there is no such curve. Then the sum is minimised; as an optimum that
is only approached from outside is never feasible, the answer is the best proved curve on the segments from the
first one to the optima of the programs (Veinott 1967), with the bound that its sum cannot fall below.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, log10

from bezier.curves.curve import Bezier
from bezier.curves.scalar import sign
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.input.task import Task, Values
from bezier.methods.single.cuts import Cut, CutKind, Model
from bezier.methods.single.program import Check, Solution, curve, lower_of, rows_of, solve
from qe.errors import BudgetExceeded, InputError, InternalError
from qe.proof.certificate import Certificate

MAX_ROUNDS = 60
TOLERANCE = Fraction(1, 1000)
"""The sum may exceed the proved lower bound by this part of it."""
BISECTIONS = 7
SHARE_BITS = 20
SIMPLE_STEPS = 5
"""So many decimal steps are tried for shorter numbers, from about a hundredth of the radius down."""


@dataclass(frozen=True, slots=True)
class ProvedCurve:
    """A curve for which everything is proved for all t."""

    values: dict[str, Values]
    curve: Bezier
    value: Fraction
    """Its sum over p+1..q of all raised axes."""
    bound: Fraction
    """No curve has a smaller sum, by ``certificate`` about the linear program of (4) and ``cuts``."""
    cuts: tuple[Cut, ...]
    certificate: Certificate
    rounds: int

    @property
    def is_optimal(self) -> bool:
        """Whether the sum is proved to be the least possible."""
        return self.value == self.bound


@dataclass(frozen=True, slots=True)
class NoCurve:
    """No curve of this degree: the linear program of (4) and ``cuts`` contradicts itself, by ``certificate``."""

    cuts: tuple[Cut, ...]
    certificate: Certificate
    rounds: int


def close(task: Task, workspace: Workspace, *, check: Check = lambda: None) -> ProvedCurve | NoCurve:
    """Method 1* for this task. ``check`` is called between steps and may raise.

    Raises ``InputError`` for ends below the table, and ``BudgetExceeded`` after ``MAX_ROUNDS`` rounds without a proof,
    also where curves exist but all of them touch the boundary somewhere else than (4) forces them to.
    """
    model = Model.of(task, workspace)
    if workspace.kind is WorkspaceKind.HEMISPHERE and any(sign(workspace.floor.margin(end)) < 0 for end in model.ends):
        raise InputError("expected a start and a goal with z >= 0 in the hemisphere")
    return _Search(model, check).run()


class _Search:
    """The rounds of constraint generation, with the cuts so far."""

    def __init__(self, model: Model, check: Check) -> None:
        self.model, self.check, self.cuts, self.rounds = model, check, model.initial(), 0
        self.rigid: set[str] = set()

    def run(self) -> ProvedCurve | NoCurve:
        """Slack first, then the sum."""
        inner = self.inner_point()
        if isinstance(inner, Solution):
            return NoCurve(tuple(self.cuts), self.certificate(inner), self.rounds)
        best, outcome = self.least_sum(self.simplified(inner))
        exact = self.sum_of(best) == outcome.value
        best = self.simplified(best, outcome.value if exact else max(self.sum_of(best), _enough(outcome)))
        values = self.model.values(best)
        return ProvedCurve(
            values,
            curve(self.model.task, values),
            self.sum_of(best),
            outcome.value,
            tuple(self.cuts),
            self.certificate(outcome),
            self.rounds,
        )

    def least_sum(self, inner: Values) -> tuple[Values, Solution]:
        """A proved curve with a small sum, from the proved curve ``inner`` on, and the optimum of the cuts so far."""
        best = inner
        for _ in self.counted():
            outcome = self.optimum()
            result = self.violations(outcome.point)
            if not result:
                return outcome.point, outcome
            candidate, outside = self.last_feasible(inner, outcome)
            best = min(best, candidate, key=self.sum_of)
            if self.sum_of(best) <= _enough(outcome):
                return best, outcome
            self.cuts += [*result, *outside]
        return best, self.optimum()

    def inner_point(self) -> Values | Solution:
        """A curve proved to satisfy everything, with the largest slack that the cuts allow."""
        for _ in self.counted():
            outcome = solve(self.model.program(self.cuts, self.rigid), check=self.check)
            if not outcome.optimal:
                return outcome
            result = self.violations(outcome.point)
            if not result:
                return outcome.point
            self.cuts += result
            if outcome.value == 0:
                self.rigid |= self.tight(outcome)
        raise BudgetExceeded(f"Method 1*: no curve proved or excluded after {MAX_ROUNDS} rounds", limit="rounds")

    def certificate(self, outcome: Solution) -> Certificate:
        """The outcome for the program without the slack: where s has a part in a proof, s = 0 gives another."""
        return outcome.narrowed(self.model.plain_program(self.cuts)).certificate

    def tight(self, outcome: Solution) -> set[str]:
        """The axes (empty: the ball) whose cuts leave no slack at all, by the multipliers."""
        cuts = (*self.model.tangents, *self.cuts)
        equations = len(self.model.task.raised) * 2
        used = (cut for cut, factor in zip(cuts, outcome.multipliers[equations:], strict=False) if factor)
        return {cut.axis for cut in used if cut.kind is not CutKind.TANGENT}

    def counted(self) -> Iterator[int]:
        """Rounds, at most ``MAX_ROUNDS`` for each of the two stages."""
        for k in range(MAX_ROUNDS):
            self.rounds += 1
            yield k

    def optimum(self) -> Solution:
        """The least sum, then the largest slack, of a program that is known to have a point."""
        program = self.model.program(self.cuts, self.rigid, self.model.costs)
        slack = (*(Fraction(0) for _ in self.model.costs[1:]), Fraction(-1))
        result = solve(program, [slack], check=self.check)
        if not result.optimal:
            raise InternalError("a linear program without the point that was proved to satisfy it")
        return result

    def violations(self, point: Sequence[Fraction]) -> list[Cut]:
        """New cuts against this point; none if its curve is proved to satisfy everything."""
        self.check()
        return self.model.violations(self.model.values(point))

    def sum_of(self, point: Sequence[Fraction]) -> Fraction:
        """The objective."""
        return sum((c * x for c, x in zip(self.model.costs, point, strict=True)), Fraction(0))

    def last_feasible(self, inner: Values, outcome: Solution) -> tuple[Values, list[Cut]]:
        """A point of the segment from ``inner`` to the optimum whose curve is proved, with a small enough sum or close
        to the last such point, and cuts against a point just beyond."""
        outer, enough = outcome.point, _enough(outcome)
        most, low, high = self.sum_of(inner), Fraction(0), Fraction(1)
        fall = most - outcome.value
        middle = (most - enough) / fall if most > enough else low
        longer = Fraction(ceil(middle * 2**SHARE_BITS), 2**SHARE_BITS)  # a short number
        middle = longer if longer < 1 else middle
        cuts: list[Cut] = []
        for _ in range(BISECTIONS):
            result = self.violations(_between(inner, outer, middle))
            if result:
                high, cuts = middle, result
            else:
                low = middle
                if most - low * fall <= enough:
                    break
            middle = (low + high) / 2
        return _between(inner, outer, low), cuts

    def simplified(self, point: Values, allowed: Fraction | None = None) -> Values:
        """A point with shorter numbers that is proved as well, with a sum of at most ``allowed`` if that is given."""
        largest = Fraction(10) ** (floor(log10(self.model.workspace.radius_squared) / 2) - 2)
        for k in () if self.model.tangents else range(SIMPLE_STEPS):
            candidate = _rounded(self.model.task, point, largest / 10**k)
            if candidate is None or (allowed is not None and self.sum_of(candidate) > allowed):
                continue
            if not self.violations(candidate):
                return candidate
        return point


def _enough(outcome: Solution) -> Fraction:
    """A sum that is close enough to the bound."""
    return outcome.value + TOLERANCE * abs(outcome.value)


def _between(inner: Values, outer: Values, share: Fraction) -> Values:
    return tuple(a + share * (b - a) for a, b in zip(inner, outer, strict=True))


def _rounded(task: Task, point: Values, step: Fraction) -> Values | None:
    """The point with multiples of ``step``, but two coordinates per axis solved from P(t_a) = P(t_b) = h.

    None where that breaks a lower bound of (4). The last entry, the slack, becomes zero.
    """
    result: list[Fraction] = []
    size = task.degree - 1
    neighbours = [i for i in (task.p, task.q + 1, task.p - 1, task.q) if 1 <= i <= size][:2]
    for k, axis in enumerate(task.raised):
        lower, (first, second) = lower_of(task, axis), (form for form, _ in rows_of(task, axis))
        given = zip(point[k * size : (k + 1) * size], lower, strict=True)
        values = [low if v == low else max(low, round(v / step) * step) for v, low in given]
        i, j = (index - 1 for index in neighbours)
        values[i] = values[j] = Fraction(0)
        a, b, c, d = (form.gradient[index] for form in (first, second) for index in (i, j))
        u, v = (-Fraction(form.value(tuple(values))) for form in (first, second))
        values[i], values[j] = (u * d - b * v) / (a * d - b * c), (a * v - u * c) / (a * d - b * c)
        if any(v < low for v, low in zip(values, lower, strict=True)):
            return None
        result += values
    return (*result, Fraction(0))

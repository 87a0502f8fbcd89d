"""Linear programs over Q, solved exactly: lexicographic optima with dual certificates, or a proved contradiction."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from qe.convex.evidence import optimum_certificate
from qe.convex.minimise import evidence_about
from qe.convex.simplex import Endless, linear_optimum
from qe.convex.system import ConvexSystem
from qe.errors import InternalError, Unable
from qe.exact.quadratic_form import Quadratic, combine, independent_rows
from qe.proof.certificate import Certificate
from qe.proof.multipliers import FormRelation, OptimumStatus

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

    @property
    def forms(self) -> list[Quadratic]:
        """The rows, then the lower bounds, as linear forms that are at most 0, or 0 for an equation."""
        size = len(self.names)
        rows = [_linear(row.coefficients, -row.bound) for row in self.rows]
        return rows + [
            _linear(tuple(Fraction(-int(i == j)) for i in range(size)), low) for j, low in enumerate(self.lower)
        ]


@dataclass(frozen=True, slots=True)
class LinearOptimum:
    """``point`` minimises the first objective c, among those points the second one, and so on.

    ``multipliers`` of ``LinearProgram.forms``, >= 0 unless it is an equation, prove it for the first: c.x + sum
    multipliers_i forms_i(x) = ``value`` for all x.
    """

    value: Fraction
    point: Numbers
    multipliers: Numbers


@dataclass(frozen=True, slots=True)
class Contradiction:
    """No point: sum multipliers_i forms_i is a positive constant (Farkas 1902)."""

    multipliers: Numbers


Outcome = LinearOptimum | Contradiction


def narrowed(outcome: Outcome, rows: int, program: LinearProgram) -> Outcome:
    """The outcome for ``program``, of the first rows (of so many) and variables, if the others play no part in it."""
    kept, size = outcome.multipliers, len(program.names)
    kept = (*kept[: len(program.rows)], *kept[rows : rows + size])
    if isinstance(outcome, Contradiction):
        return Contradiction(kept)
    return replace(outcome, point=outcome.point[:size], multipliers=kept)


def solve(program: LinearProgram, objectives: Sequence[Sequence[Fraction]], *, check: Check = lambda: None) -> Outcome:
    """Minimise the objectives, the earlier ones first. ``check`` is called between pivots and may raise.

    The minima of an objective are the points at which the forms that have a multiplier are 0 (complementary
    slackness): with these as equations the next objective is minimised.

    Raises ``Unable`` when an objective falls without bound.
    """
    forms = program.forms
    equal = [k for k, row in enumerate(program.rows) if row.equation]
    forms += _negated(forms, equal)
    zero = {*equal}
    first: Numbers | None = None
    point: Numbers = ()
    for objective in objectives:
        if first is not None and len(independent_rows([forms[k].gradient for k in zero])) == len(program.names):
            break  # one point is left
        optimum, falls = linear_optimum(_linear(tuple(objective), Fraction(0)), forms, check=check)
        if falls is not None:
            raise Unable("a linear objective falls without bound")
        first = first or _multipliers(program, equal, optimum.weights)
        if isinstance(optimum, Endless):
            return Contradiction(first)
        forms += _negated(forms, optimum.weights)
        zero |= optimum.weights.keys()
        point = optimum.dual
    if first is None:
        raise InternalError("a linear program without an objective")
    value = sum((c * x for c, x in zip(objectives[0], point, strict=True)), Fraction(0))
    return LinearOptimum(value, point, first)


def _negated(forms: Sequence[Quadratic], which: Iterable[int]) -> list[Quadratic]:
    return [combine((Fraction(-1),), (forms[k],)) for k in which]


def _multipliers(program: LinearProgram, equal: Sequence[int], weights: Mapping[int, Fraction]) -> Numbers:
    """Of the forms of the program, which the negative ones of its equations follow."""
    size = len(program.rows) + len(program.names)
    negative = {k: weights.get(place, Fraction(0)) for place, k in enumerate(equal, size)}
    return tuple(weights.get(k, Fraction(0)) - negative.get(k, 0) for k in range(size))


def certificate(program: LinearProgram, objective: Sequence[Fraction], outcome: Outcome) -> Certificate:
    """The outcome as a certificate that ``qe.verify`` accepts: constraints in the order rows, then lower bounds."""
    relations = [FormRelation.EQ if row.equation else FormRelation.LE for row in program.rows]
    relations += [FormRelation.LE] * len(program.names)
    least = _linear(tuple(objective), Fraction(0))
    system = ConvexSystem(program.names, least, tuple(program.forms), tuple(relations))
    said: dict[str, object] = {"status": OptimumStatus.INFEASIBLE, "point": program.lower}
    if isinstance(outcome, LinearOptimum):
        said = {"status": OptimumStatus.OPTIMAL, "point": outcome.point, "attained": True, "unique": False}
    return optimum_certificate(evidence_about(system, multipliers=outcome.multipliers, **said))


def _linear(gradient: Numbers, constant: Fraction) -> Quadratic:
    size = len(gradient)
    return Quadratic(((Fraction(0),) * size,) * size, gradient, constant)

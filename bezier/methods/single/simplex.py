"""Linear programs over Q, solved exactly: lexicographic optima with dual certificates, or a proved contradiction."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.convex.evidence import optimum_certificate
from qe.convex.minimise import evidence_about
from qe.convex.simplex import Endless, linear_optimum
from qe.convex.system import ConvexSystem
from qe.errors import Unable
from qe.exact.quadratic_form import Quadratic, combine, independent_rows
from qe.proof.certificate import Certificate
from qe.proof.multipliers import FormRelation, OptimumStatus

Numbers = tuple[Fraction, ...]
Check = Callable[[], object]
Row = tuple[Quadratic, FormRelation]
"""A linear form that is at most 0, or 0."""


def linear_program(names: Sequence[str], cost: Numbers, rows: Sequence[Row], lower: Numbers) -> ConvexSystem:
    """The points x with all rows and x_j >= lower_j."""
    bounds = (tuple(Fraction(-int(i == j)) for i in range(len(names))) for j in range(len(names)))
    forms = *(form for form, _ in rows), *map(Quadratic.linear, bounds, lower)
    relations = *(relation for _, relation in rows), *[FormRelation.LE] * len(names)
    return ConvexSystem(tuple(names), Quadratic.linear(cost), forms, relations)


@dataclass(frozen=True, slots=True)
class Solution:
    """``point`` minimises the objective of a program, and among its minima further ones. ``multipliers`` of the forms,
    >= 0 unless it is an equation, prove it: objective + sum multipliers_i forms_i = ``value`` everywhere. Where it is
    not ``optimal``, there is no point: sum multipliers_i forms_i is a positive constant (Farkas 1902)."""

    program: ConvexSystem
    point: Numbers
    multipliers: Numbers
    optimal: bool = True

    @property
    def value(self) -> Fraction:
        """The least value."""
        return Fraction(self.program.objective.value(self.point))

    @property
    def certificate(self) -> Certificate:
        """What ``qe.verify`` accepts."""
        said: dict[str, object] = {"status": OptimumStatus.INFEASIBLE}
        if self.optimal:
            said = {"status": OptimumStatus.OPTIMAL, "attained": True, "unique": False}
        return optimum_certificate(evidence_about(self.program, point=self.point, multipliers=self.multipliers, **said))

    def narrowed(self, program: ConvexSystem) -> Solution:
        """That of a program of the first rows and variables alone, if the others play no part in it."""
        size, rest = len(program.names), len(self.multipliers) - len(self.program.names)
        kept = (*self.multipliers[: len(program.forms) - size], *self.multipliers[rest : rest + size])
        return Solution(program, self.point[:size], kept, self.optimal)


def solve(program: ConvexSystem, others: Iterable[Numbers] = (), *, check: Check = lambda: None) -> Solution:
    """Minimise the objective, then the others. ``check`` is called between pivots and may raise.

    The minima of an objective are the points at which the forms that have a multiplier are 0 (complementary
    slackness): with these as equations the next objective is minimised.

    Raises ``Unable`` when an objective falls without bound.
    """
    forms, size = list(program.forms), len(program.forms)
    equal = [k for k, relation in enumerate(program.relations) if relation is FormRelation.EQ]
    forms += _negated(forms, equal)
    zero, known = {*equal}, Solution(program, (Fraction(0),) * len(program.names), ())
    for objective in (program.objective, *map(Quadratic.linear, others)):
        if known.multipliers and len(independent_rows([forms[k].gradient for k in zero])) == len(program.names):
            break  # one point is left
        optimum, falls = linear_optimum(objective, forms, check=check)
        if falls is not None:
            raise Unable("a linear objective falls without bound")
        if not known.multipliers:
            weights = {k: Fraction(w) for k, w in optimum.weights.items()}  # of equations the negative ones, too
            negative = {k: weights.get(place, 0) for place, k in enumerate(equal, size)}
            first = tuple(weights.get(k, Fraction(0)) - negative.get(k, 0) for k in range(size))
        if isinstance(optimum, Endless):
            return Solution(program, known.point, first, optimal=False)
        forms += _negated(forms, optimum.weights)
        zero |= optimum.weights.keys()
        known = Solution(program, tuple(map(Fraction, optimum.dual)), first)
    return known


def _negated(forms: Sequence[Quadratic], which: Iterable[int]) -> list[Quadratic]:
    return [combine((Fraction(-1),), (forms[k],)) for k in which]

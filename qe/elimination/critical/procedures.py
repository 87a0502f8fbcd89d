"""What critical-value elimination takes from other parts of the engine, passed in by the pipeline."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.decomposition.operators.operator import Operator
from qe.exact.quadratic_form import Quadratic
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.formula.syntax import Formula
from qe.options import Budget
from qe.proof.multipliers import FormRelation

Levels = tuple[tuple[Poly, ...], ...]
Decide = Callable[[Point], bool]


@dataclass(frozen=True, slots=True)
class Proposal:
    """Rational data that may settle a convex system: a ``witness`` point, or ``weights`` of its inequalities."""

    witness: tuple[Fraction, ...] | None = None
    weights: tuple[Fraction, ...] | None = None


@dataclass(frozen=True, slots=True)
class Procedures:
    """Procedures of the engine.

    ``project(polys, size, operator, budget, thom_levels)``: irreducible factors closed under projection, per level.
    ``propose(forms)``: a proposal for the convex system forms <= 0; nothing it says is believed.
    ``feasible(forms, relations)``: whether a convex system has a solution, exactly; raises ``Unable``.
    ``decide(matrix, names, free)``: whether the variables after the first ``free`` ones of ``names`` can be completed,
    over any point of those, exactly.
    """

    project: Callable[[Iterable[Poly], int, Operator, Budget, frozenset[int]], Levels]
    propose: Callable[[Sequence[Quadratic]], Proposal]
    feasible: Callable[[Sequence[Quadratic], Sequence[FormRelation]], bool]
    decide: Callable[[Formula, tuple[str, ...], int], Decide]

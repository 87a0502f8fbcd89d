"""From a formula to the region of its solutions: quantifiers are eliminated, and the rest described cylindrically."""

from __future__ import annotations

from dataclasses import dataclass

from qe import pipeline
from qe.execution import Limits
from qe.formula.counting import without_root_atoms
from qe.formula.syntax import Formula
from qe.formula.traverse import free_variables, is_quantifier_free
from qe.options import Budget, Options
from qe.solution.convex_region import ConvexRegion, shadow_of
from qe.solution.region import Region

TABLE_VARIABLES = 3
"""In more variables than this, convex regions are not decomposed unless that is asked for."""


def described(formula: Formula, names: tuple[str, ...] | None, budget: Budget, limits: Limits) -> Region:
    """The region of a formula in the order of ``names``; ``limits`` are for the questions that it will be asked.

    Raises ``InputError`` for an order that misses a free variable, ``Unable`` where elimination does.
    """
    given = without_root_atoms(formula)
    quantified = not is_quantifier_free(given)
    if quantified or len(free_variables(given)) > TABLE_VARIABLES:
        shadow = shadow_of(given, Elimination(names))
        if shadow is not None:
            return ConvexRegion(shadow, names, limits=limits)
    if not quantified:
        return Region.of(given, names, budget=budget, limits=limits)
    found = pipeline.solve(given, Options(order=names), budget)
    return Region.of(found.formula, names or found.parameter_order, budget=budget, limits=limits)


@dataclass(frozen=True, slots=True)
class Elimination:
    """Elimination in an order, for a region to call when its formula is asked for; a value that can be pickled."""

    order: tuple[str, ...] | None

    def __call__(self, formula: Formula, budget: Budget) -> Formula:
        return pipeline.solve(formula, Options(order=self.order), budget).formula

"""From a formula to the region of its solutions: quantifiers are eliminated, and the rest described cylindrically."""

from __future__ import annotations

from dataclasses import dataclass, replace

from qe.elimination.protocol import Context, Outcome
from qe.engine.run import answer_to, answered, proved, solve
from qe.engine.untangle import degrees, untangled
from qe.formula.counting import without_root_atoms
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.options import Budget, Options
from qe.processes.limits import Limits
from qe.proof.answer import UNPROVED, Answer, Status
from qe.proof.run_log import RunLog
from qe.regions.convex_region import ConvexRegion, shadow_of
from qe.regions.region import Region

TABLE_VARIABLES = 3
"""In more variables than this, convex regions are not decomposed unless that is asked for."""


def described(
    formula: Formula, names: tuple[str, ...] | None, budget: Budget, limits: Limits, *, check: bool = False
) -> Region:
    """The region of a formula in the order of ``names``; ``limits`` are for the questions that it will be asked.

    ``check``: with a table where there are few variables, and evidence for the elimination of quantifiers.
    Raises ``InputError`` for an order that misses a free variable, ``Unable`` where elimination does.
    """
    given = without_root_atoms(formula)
    quantified = not given.is_quantifier_free
    many = len(given.free) > TABLE_VARIABLES
    if many or (quantified and not check):
        shadow = shadow_of(given, Elimination(names))
        if shadow is not None:
            return ConvexRegion(shadow, names, limits=limits)
    options = Options(order=names, certify=check)
    equations = [p for p in conjuncts(given) if isinstance(p, Atom) and p.relation is Relation.EQ]
    if many and not quantified and len(equations) > 1:
        log = RunLog()
        better = untangled(given, Context(options, budget, log), size=degrees)
        region = Region.of(better, names or given.free, budget=budget, limits=limits)
        region.answer = answer_to(formula, proved(formula, Outcome(better, log=log), options, budget))
        return region
    if not quantified:
        region = Region.of(given, names, budget=budget, limits=limits)
        region.answer = None if given is formula else _counted(formula, given)
        return region
    outcome = answered(formula, options, budget)
    region = Region.of(outcome.formula, names or outcome.order, budget=budget, limits=limits)
    if check:
        region.answer = replace(answer_to(formula, outcome), certificate=None, reason=UNPROVED)
        region.reason = UNPROVED
        budget.keep(region)
        region.reason = ""
    region.answer = answer_to(formula, proved(formula, outcome, options, budget))
    return region


def _counted(formula: Formula, given: Formula) -> Answer:
    """The answer that a formula with root atoms has by counting roots."""
    log = RunLog()
    log.step("roots counted", formula, given)
    why = "no checked evidence for: roots counted"
    return Answer(Status.SOLVED, given, unchecked_steps=("roots counted",), question=formula, log=log, reason=why)


@dataclass(frozen=True, slots=True)
class Elimination:
    """Elimination in an order, for a region to call when its formula is asked for; a value that can be pickled."""

    order: tuple[str, ...] | None

    def __call__(self, formula: Formula, budget: Budget) -> Formula:
        return solve(formula, Options(order=self.order), budget).formula

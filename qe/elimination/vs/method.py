"""Virtual substitution as a method: one block, its figures, and values for its variables."""

from __future__ import annotations

import time
from functools import partial

from qe.elimination.protocol import Context, Outcome
from qe.elimination.vs.block import eliminate_block
from qe.exact.number import Values
from qe.formula.block import Block
from qe.formula.syntax import TRUE
from qe.options import Options
from qe.simplifier.simplify import simplify


class VirtualSubstitution:
    """Elimination sets for variables of degree at most 2 (after factoring and degree shift); the others stay."""

    name = "vs"
    highest = 2

    def suits(self, problem: Block, options: Options) -> str | None:
        """Blocks over quantifier-free bodies."""
        return f"degrees up to {self.highest} are eliminated" if problem.is_flat else None

    def run(self, problem: Block, context: Context) -> Outcome:
        """The block as far as substitution goes: what it could not eliminate stays quantified in the formula."""
        start = time.perf_counter()
        matrix = problem.positive
        tidy = partial(simplify, watch=context.budget.check)
        result = eliminate_block(problem.variables, matrix, budget=context.budget, simplify=tidy, highest=self.highest)
        seconds = round(time.perf_counter() - start, 6)
        context.log.work(self.name, {"variables": list(problem.variables), **result.stats, "seconds": seconds})
        evidence = {**result.stats, "trace": result.trace}
        answer = context.log.step("elimination set", problem.formula, problem.asked(result.formula), evidence=evidence)
        values: Values | None = None
        if not result.remaining and result.formula == TRUE:
            certain = next((candidate for candidate in result.answers if tidy(candidate.guard) == TRUE), None)
            values = None if certain is None else certain.witness(budget=context.budget)
        return Outcome(answer, values)


class CubicSubstitution(VirtualSubstitution):
    """The same for degrees up to 3."""

    name = "vs, cubic"
    highest = 3

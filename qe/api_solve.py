"""The public functions that list solutions: ``solve``, ``find_instances``."""

from __future__ import annotations

import random
import time
from dataclasses import replace
from typing import Any

from qe import arguments
from qe.api_input import AnyFormula, read_formula
from qe.api_limits import Progress, limits_of, performed
from qe.exact.number import Values
from qe.execution import Budgets
from qe.formula.traverse import free_variables
from qe.progress import silent
from qe.regions.build import described
from qe.regions.solutions import Solutions
from qe.regions.walk import different_points


def solve(
    formula: AnyFormula,
    variables: Any = None,
    *,
    format: str = "text",
    timeout: float | None = None,
    memory: int | None = None,
    progress: Progress = silent,
    process: bool = True,
) -> Solutions:
    """All real solutions, case by case, as Mathematica's ``Reduce`` writes them (cylindrical decomposition).

    ``variables``: those to solve for, in their order; they come after all others, so that each is told in terms of the
    parameters and of the variables before it. Without them all free variables are meant, in the order of the formula.
    Quantifiers are eliminated first. See ``eliminate`` for the limits.
    Raises ``InputError`` for what cannot be read, ``Unable`` (``BudgetExceeded`` at a limit) where elimination does.
    """
    start = time.monotonic()
    limits = limits_of(timeout, memory, progress, process)
    given, wanted = read_formula(formula, format), arguments.names(variables, "variables")
    order = None if wanted is None else (*(v for v in free_variables(given) if v not in wanted), *wanted)

    def work(budgets: Budgets) -> Solutions:
        budget = budgets()
        found = described(given, order, budget, replace(limits, process=False))
        cases = tuple(found.cells)
        found.limits = limits
        return Solutions(found.order, cases, found)

    return performed(work, given, limits.begun(start))


reduce = solve
"""The older name of ``solve``."""


def find_instances(
    formula: AnyFormula,
    n: int,
    *,
    seed: int = 0,
    format: str = "text",
    timeout: float | None = None,
    memory: int | None = None,
    progress: Progress = silent,
    process: bool = True,
) -> list[Values]:
    """Up to ``n`` different exact solutions; fewer only where there are no more. The same for the same ``seed``.

    See ``eliminate`` for the limits. Raises ``Unable`` (``BudgetExceeded`` at a limit) where no description is found.
    """
    start = time.monotonic()
    count = arguments.whole(n, "n")
    limits = limits_of(timeout, memory, progress, process)
    given = read_formula(formula, format)

    def work(budgets: Budgets) -> list[Values]:
        found = described(given, None, budgets(), replace(limits, process=False))
        return different_points(found, count, random.Random(seed), budgets())

    return performed(work, given, limits.begun(start))

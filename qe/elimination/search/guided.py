"""A SAT solver guided by linear bounds while it decides: a point, or the clauses that have refuted all cases."""

from __future__ import annotations

from collections.abc import Sequence

from qe.elimination.search.clauses import Clause, Clauses
from qe.elimination.search.linear_theories import Differences, Forms, difference, said
from qe.elimination.search.online import LinearTheory, Propagator
from qe.elimination.search.theory import Theory
from qe.exact.number import Values

UNITS = 60
"""Units of work of one look at a whole assignment; one is that of one look at a part."""


def guided(clauses: Clauses, theory: Theory) -> Values | list[Clause]:
    """Values that make the formula true, or clauses each of which holds at all real points.

    They leave no case, if the solver did what it should; this is for the caller to see. Raises what ``theory`` does.
    """
    from pysat.solvers import Cadical195, pysolvers

    budget = theory.budget
    found: Values = {}
    bounds = list(said(clauses.inequalities()))
    theories: list[LinearTheory] = []
    differences = Differences(bounds) if Differences.suit(bounds) else None
    if differences is None or any(difference(one.direction) is None for one in bounds):
        theories.append(Forms(bounds))
    if differences is not None:
        theories.insert(0, differences)

    def check() -> None:
        budget.spend(1)
        budget.check("search", len(propagator.lemmas))

    def last(model: Sequence[int]) -> list[Clause]:
        budget.spend(UNITS)
        budget.check("search", len(propagator.lemmas))
        theory.bounds.start(theories[-1].point())
        looked = theory.look(clauses.chosen(model, theory.bounds.sign))
        if isinstance(looked, dict):
            found.update(looked)
            return []
        return [[-clauses.literal(a) for a in reason] for reason in looked]

    propagator = Propagator(theories, check, last)
    with Cadical195(bootstrap_with=clauses.clauses) as solver:
        solver.connect_propagator(propagator)
        for literal in clauses.signs():
            solver.observe(literal)
        # as ``solver.solve()``, but Ctrl-C stays what it is in Python: a jump out of calls from C would break it
        true = pysolvers.cadical195_solve(solver.cadical, [], 0)
        solver.disconnect_propagator()
    if propagator.failure is not None:
        raise propagator.failure
    return found if true else propagator.lemmas

"""A SAT solver guided by linear bounds while it decides: a point, or the clauses that have refuted all cases.

What is decided next is what holds at the point at which all bounds so far hold, where the simplex method has one: then
nothing has to be moved for it (the choice of phases by the theory, as in Yices; only how long the search is rests on
it).
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

from qe.convex.linear_point import LARGE, WORK
from qe.elimination.search.clauses import Clause, Clauses
from qe.elimination.search.linear_forms import FormBounds
from qe.elimination.search.linear_theories import Differences, Forms, Said, difference, said
from qe.elimination.search.online import LinearTheory, Propagator
from qe.elimination.search.proposed_bounds import ProposedBounds, suits
from qe.elimination.search.theory import Theory
from qe.exact.linear_bounds import TooMuch
from qe.exact.number import Values
from qe.exact.ring import Poly
from qe.formula.syntax import Atom, Relation

UNITS = 60
"""Units of work of one look at a whole assignment; one is that of one look at a part."""


def guided(clauses: Clauses, theory: Theory) -> Values | list[Clause]:
    """Values that make the formula true, or clauses each of which holds at all real points.

    They leave no case, if the solver did what it should; this is for the caller to see. Raises what ``theory`` does.
    Linear bounds in many forms, or whose tableaus fill, are for HiGHS where it is installed.
    """
    bounds = list(said(clauses.inequalities()))
    directions = {one.direction for one in bounds}
    linear = all(poly.total_degree == 1 for poly in clauses.polys)
    floats = linear and suits(directions)
    work = WORK if floats else None
    if not floats or sum(map(len, directions)) < LARGE:
        with suppress(TooMuch):
            forms = Forms(bounds, lambda: theory.budget.check("search: bounds"), FormBounds(work))
            theory.bounds.offer(clauses.polys)
            return _guided(clauses, bounds, theory, forms, linear)
    theory.at_once = True
    forms = Forms(bounds, lambda: theory.budget.check("search: bounds"), ProposedBounds(theory.budget.remaining()))
    return _guided(clauses, bounds, theory, forms, linear)


def _guided(
    clauses: Clauses, bounds: Sequence[Said], theory: Theory, forms: Forms, linear: bool
) -> Values | list[Clause]:
    from pysat.solvers import Cadical195, pysolvers

    budget = theory.budget
    point: Values = {}
    theories: list[LinearTheory] = []
    differences = Differences(bounds) if Differences.suit(bounds) else None
    leading: Forms | None = None  # whose point says what is preferred; among curved conditions it says too little
    if differences is None or any(difference(one.direction) is None for one in bounds):
        theories.append(forms)
        leading = forms if linear else None
    if differences is not None:
        theories.insert(0, differences)

    def check() -> None:
        budget.spend(1)
        budget.check("search", len(propagator.lemmas))

    def last(model: Sequence[int]) -> list[Clause]:
        budget.spend(UNITS)
        budget.check("search", len(propagator.lemmas))
        if theory.at_once:
            if (reasons := forms.settle(now=True)) is not None:
                return [[-r for r in reasons]]
        else:
            theory.bounds.start(theories[-1].point())
        looked = theory.look(clauses.chosen(model, sign if theory.at_once else theory.bounds.sign))
        if isinstance(looked, dict):
            point.update(looked)
            return []
        return [[-clauses.literal(a) for a in reason] for reason in looked]

    def sign(poly: Poly) -> int:
        above, below = (clauses.literal(Atom(poly, relation)) for relation in (Relation.GT, Relation.LT))
        return forms.holds(above) - forms.holds(below)

    def prefer() -> None:
        if leading is not None and (changed := leading.changes()):
            pysolvers.cadical195_setphases(solver.cadical, changed)

    propagator = Propagator(theories, clauses.needed, check, last, prefer)
    with Cadical195(bootstrap_with=clauses.clauses) as solver:
        if leading is not None:
            solver.set_phases([-zero for _, _, zero in clauses.triples()])
        solver.connect_propagator(propagator)
        for literal in clauses.signs():
            solver.observe(literal)
        with _signals_kept(propagator):
            # as ``solver.solve()``, which would have Ctrl-C jump out of the calls from C
            true = pysolvers.cadical195_solve(solver.cadical, [], 0)
        solver.disconnect_propagator()
    if propagator.failure is not None:
        raise propagator.failure
    return point if true else propagator.lemmas


@contextmanager
def _signals_kept(propagator: Propagator) -> Iterator[None]:
    """What handlers of signals raise meanwhile (Ctrl-C, alarms) ends the search and is the propagator's failure.

    The solver would lose an error that one of its calls raises, and a signal may come at the first step of any of them.
    """
    before: dict[int, Callable[[int, FrameType | None], Any]] = {}
    if threading.current_thread() is threading.main_thread():  # the one that runs handlers, and may set them
        before = {number: handler for number in signal.valid_signals() if callable(handler := signal.getsignal(number))}

    def kept(number: int, frame: FrameType | None) -> None:
        if propagator.keeps_errors:  # it may wait for another process, which ends by the error alone
            propagator.keeps_errors = False
            before[number](number, frame)
            propagator.keeps_errors = True
        else:
            with propagator:
                before[number](number, frame)

    try:
        for number in before:
            signal.signal(number, kept)
        yield
    finally:
        for number, handler in before.items():
            if signal.getsignal(number) is kept:  # a handler may have set another one
                signal.signal(number, handler)

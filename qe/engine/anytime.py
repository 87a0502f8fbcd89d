"""What can be said of a question when it cannot be answered as a whole in the time or work there is.

The parts of a disjunction or conjunction are answered one by one, an existential block over a disjunction disjunct by
disjunct (a universal one likewise, by its negation). A block that no method ends is decomposed: the cells in the space
of its free variables that were decided when the budget ended are described by root atoms. What is said of the parts
gives what is said of the whole: a disjunction is true where one part is proved true, and false where all are proved
false. A decided cell is right whatever becomes of the others: the theorems of the projection speak of one cell and the
cells below it, at which lifting has checked that nothing is nullified.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TypeVar, cast

from qe.decomposition.decompose import Tactics, decompose
from qe.decomposition.extended_tarski import extended_formula
from qe.decomposition.order import Prenex
from qe.decomposition.sampled_cells import free_part
from qe.elimination.protocol import Outcome
from qe.engine.run import answered, proved
from qe.errors import Unable
from qe.exact.ring import Ring
from qe.formula.build import convert, disj, exists, neg
from qe.formula.counting import without_root_atoms
from qe.formula.normal import nnf, rename_apart, without_clashes
from qe.formula.syntax import FALSE, TRUE, And, Constant, Exists, ForAll, Formula, Not, Or
from qe.io.names import names_in
from qe.options import Budget, Options
from qe.processes.execution import perform
from qe.processes.limits import Limits
from qe.proof.cells import Cell, CellTable
from qe.proof.cells_json import cells_to_json
from qe.proof.certificate import Certificate
from qe.proof.derivation import moved
from qe.proof.entry import Json
from qe.proof.partial import Partial
from qe.simplifier.simplify import simplify

SHARE = 0.5
"""The share of what is left that a part may take before it is decomposed as far as the rest allows."""

WRITING = 0.3
"""The share of the time of a decomposition that is kept for writing its cells as formulas."""

T = TypeVar("T")


def partly(question: Formula, options: Options, budget: Budget, limits: Limits) -> Partial:
    """What is found out about a question within the budget; at worst, nothing. It has been tried as a whole before.

    Where the time is limited each part is worked on in a process of its own if ``limits`` lets it: one that cannot be
    interrupted costs its own share only.
    """
    plain = rename_apart(without_root_atoms(question))
    search = _Search(options, limits, Ring.of(question.free))
    outcome = search.known(plain, budget, tried=True)
    true, false = outcome.proved_true, outcome.proved_false
    certificate = None
    if options.certify:  # the parts stay as the proofs give them
        certificate = search.certificate(question, true, false)
    else:
        true, false = simplify(true), simplify(false)
    return Partial(true, false, simplify(nnf(neg(disj((true, false))))), certificate)


@dataclass(frozen=True, slots=True)
class _Search:
    """``ring``: of the free variables, in which all parts are. ``proofs``: where certificates are wanted, one for every
    part of which something was found; None for one that has none."""

    options: Options
    limits: Limits
    ring: Ring
    proofs: list[Certificate | None] = field(default_factory=list)

    def known(self, formula: Formula, budget: Budget, *, tried: bool = False) -> Partial:
        match formula:
            case Constant():
                return _answered(formula)
            case Not(arg):
                return self.known(arg, budget, tried=tried).negated
            case And(args):
                return self.known(disj(neg(a) for a in args), budget, tried=tried).negated
            case Or(args):
                return self.of_parts(list(args), budget)
            case ForAll(variables, body):
                return self.known(exists(variables, nnf(neg(body))), budget, tried=tried).negated
            case Exists(variables, body) if isinstance(body, Or):
                return self.of_parts([exists(variables, a) for a in body.args], budget)
        if formula.is_quantifier_free:
            return _answered(convert(formula, self.ring))
        if not tried:
            try:
                outcome = self.held(partial(answered, formula, self.options), budget, SHARE)
            except Unable:
                pass  # as far as cells go, then
            else:
                if self.options.certify:
                    self.proofs.append(self.proof(formula, outcome, budget))
                return _answered(convert(outcome.formula, self.ring))
        try:
            cells = self.held(partial(_decided_cells, formula, self.options), budget, 1)
        except Unable:
            return Partial()
        if self.options.certify:
            self.proofs.append(cells.certificate)
        return Partial(convert(cells.proved_true, self.ring), convert(cells.proved_false, self.ring))

    def proof(self, formula: Formula, outcome: Outcome, budget: Budget) -> Certificate | None:
        """The certificate of a part's answer; None where none is found in its share."""
        try:
            return self.held(partial(proved, formula, outcome, self.options), budget, SHARE).certificate
        except Unable:
            return None

    def certificate(self, question: Formula, true: Formula, false: Formula) -> Certificate | None:
        """What proves the parts of a question, by the proofs of its own parts."""
        proofs = [proof for proof in self.proofs if proof is not None]
        if len(proofs) < len(self.proofs):
            return None
        clear = without_clashes(question)
        order = Ring.of(dict.fromkeys(n for f in (clear, true, false) for n in names_in(f)))
        start, true, false = (moved(f, order) for f in (clear, true, false))
        evidence: dict[str, Json] = {"proofs": [cast(Json, part.payload) for proof in proofs for part in proof.parts]}
        return Certificate.decided(start, true, false, "parts", evidence)

    def of_parts(self, parts: list[Formula], budget: Budget) -> Partial:
        """A disjunction; each part may take its share of what is left."""
        answers = []
        for k, part in enumerate(parts):
            answers.append(self.known(part, _apportioned(budget, 1 / (len(parts) - k))))
        return Partial.of_disjunction(answers)

    def held(self, work: Callable[[Budget], T], budget: Budget, share: float) -> T:
        """The work within a share of the budget, ended at its limit of time whatever it does. Raises ``Unable``."""
        budget.check("parts")
        allowed = _apportioned(budget, share)
        seconds = allowed.remaining()
        if seconds is None:
            return work(allowed)
        limits = replace(self.limits, timeout=max(seconds, 0.001))
        return perform(partial(_within, work, allowed.left()), limits, at_once=True)


def _within(work: Callable[[Budget], T], units: int | None, budget: Budget) -> T:
    """The work within so many units of it."""
    return work(budget.part(units))


def _answered(answer: Formula) -> Partial:
    return Partial(answer, nnf(neg(answer)))


def _apportioned(budget: Budget, share: float) -> Budget:
    """A budget for a part of the work: at most this share of the time and of the work that are left."""
    units = budget.left()
    timed = budget.share(share)
    return timed if units is None else timed.part(max(1, int(units * share)))


def _decided_cells(formula: Formula, options: Options, budget: Budget) -> Partial:
    """The decided cells of the space of the free variables. Raises ``Unable`` where there is none."""
    question = Prenex.of(formula, options, _apportioned(budget, SHARE))
    if isinstance(question.matrix, Constant):
        return _answered(question.matrix)
    order, lifting, tactics = question.order, _apportioned(budget, 1 - WRITING), Tactics(anytime=True)
    table = decompose(question.matrix, order, question.quantifiers, budget=lifting, tactics=tactics).table
    if not formula.free:
        known = _answered(TRUE if table.root.truth else FALSE)
    else:
        free = free_part(table)
        known = Partial(extended_formula(_where(free, True)), extended_formula(_where(free, False)))
    true, false = (convert(part, Ring.of(order)) for part in (known.proved_true, known.proved_false))
    if not options.certify:
        return known
    whole, evidence = moved(formula, Ring.of(order)), {"cells": cells_to_json(table)}
    return replace(known, certificate=Certificate.decided(whole, true, false, "cells", evidence))


def _where(table: CellTable, truth: bool) -> CellTable:
    """The table of the statement that the truth value is known to be ``truth``."""

    def seen(cell: Cell) -> Cell:
        if cell.stack is None:
            return Cell(cell.signs, cell.truth is truth)
        return replace(cell, truth=None, stack=replace(cell.stack, cells=tuple(map(seen, cell.stack.cells))))

    return replace(table, root=seen(table.root))

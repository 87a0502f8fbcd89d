"""Decomposition as a method: prenex form, order, cell table, solution formula, certificate."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from qe.decomposition.decompose import Decomposed, Tactics, decompose
from qe.decomposition.follows import follows
from qe.decomposition.formulas import construct, formula_of_cells
from qe.decomposition.operators.table import OPERATORS
from qe.decomposition.order import Prenex
from qe.decomposition.refined import refined
from qe.decomposition.sampled_cells import deciding_point, free_part
from qe.decomposition.sign_table import Columns, free_cells
from qe.elimination.protocol import Context, Outcome
from qe.errors import BudgetExceeded, Contradiction
from qe.exact.number import Values
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import conj, convert
from qe.formula.features import is_small, length
from qe.formula.syntax import FALSE, TRUE, Constant, Formula
from qe.formula.traverse import polynomials
from qe.options import Budget, Options, Stage
from qe.proof.cells import CellTable
from qe.proof.certificate import Certificate
from qe.proof.on_demand import OnDemand, Repeated
from qe.proof.run_log import RunLog
from qe.simplifier.presented import presented
from qe.simplifier.simplify import simplify

WHOLE_FROM, WHOLE_CELLS = 300, 2000
"""A decomposition of at most so many cells is made once more with the whole space of the free variables, of at most so
many cells in all, when its answer is small (``is_small``)."""

WHOLE_ATOMS, WHOLE_ATOMS_BOUND = 3, 4
"""An answer of fewer atoms is not compared with that of the whole space; the second where there are quantifiers."""


class Decomposition:
    """Cylindrical algebraic decomposition of the whole problem, with any prefix."""

    name = "cad"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Every problem."""
        return "complete for every formula"

    def run(self, problem: Block, context: Context) -> Outcome:
        """The answer read off the cells, with a witness of a sentence and a certificate. Raises ``BudgetExceeded``."""
        return decomposed(problem.formula, context.options, context.budget, context.log)


def decomposed(formula: Formula, options: Options, budget: Budget, log: RunLog) -> Outcome:
    """Any formula, as a whole, by cylindrical algebraic decomposition. Raises ``BudgetExceeded``."""
    start = time.perf_counter()
    question = _Question(Prenex.of(formula, options, budget), formula.free, options)
    matrix = question.prenex.matrix
    if isinstance(matrix, Constant):
        return Outcome(matrix, {} if matrix.value else None)
    first = question.table(budget)
    values: Values | None = None
    whole: CellTable | None = None
    if formula.free:
        (answer, proof, levels), whole = question.shortest(first, budget)
        answer = answer if options.root_atoms else presented(answer)
        if levels and options.certify:  # what was refined is no proof
            proof = question.table(budget, levels, whole_free=proof is whole).table
    else:
        truth, proof = first.table.root.truth is True, first.table
        answer = TRUE if truth else FALSE
        if truth is (proof.quantifiers[0] == "E"):
            values = deciding_point(proof, truth)
    log.work("cad", question.prenex.figures | _figures(first, time.perf_counter() - start))
    make = partial(Certificate.cells, proof, answer, formula) if follows(answer, proof) else None
    log.step("cells", formula, answer, evidence=kept(formula, make, options))
    # back into the ring of the formula it came from: it is joined with parts of that formula
    ring = formula.ring
    return Outcome(answer if ring is None else convert(answer, ring), values, make=make, large=True)


def kept(formula: Formula, make: Callable[[], Certificate] | None, options: Options) -> dict[str, object]:
    """The evidence of a step by a table of a formula: tables are large, and made again where it is wanted later."""
    if make is None:
        return {}
    again = OnDemand(Repeated(decomposed, formula, options))
    return {"proof": {"certificate": make()} if options.certify else again}


def certificate_for(formula: Formula, answer: Formula, options: Options, budget: Budget) -> Certificate | None:
    """A decomposition that proves ``formula`` <-> ``answer``, a quantifier-free formula from whatever source.

    The factors of the answer join the projection, and the space of the free variables is decomposed whole, so that the
    table has their signs on every cell. None where the formula has no matrix to decompose. Raises ``BudgetExceeded``,
    and ``Contradiction`` where the decomposition decides a sentence otherwise.
    """
    question = _Question(Prenex.of(formula, options, budget), formula.free, options)
    if isinstance(question.prenex.matrix, Constant):
        return None
    claim = convert(answer, Ring.of(question.prenex.order))
    proof = question.table(budget, whole_free=True, extra=tuple(polynomials(claim))).table
    if not formula.free and answer != (TRUE if proof.root.truth else FALSE):
        raise Contradiction(f"a decomposition says {proof.root.truth} where the answer is {answer}")
    return Certificate.cells(proof, claim, formula)


def short_where(formula: Formula, known: Formula, options: Options, budget: Budget) -> Formula:
    """A quantifier-free formula with the truth of another one on every cell on which ``known`` holds, read off these
    cells alone. Raises ``BudgetExceeded``, and ``Undistinguished`` where the signs on the cells do not suffice."""
    both = conj((known, formula))
    question = _Question(Prenex.of(both, options, budget), both.free, options)
    if isinstance(question.prenex.matrix, Constant):
        return formula
    ring = Ring.of(question.prenex.order)
    whole = convert(question.prenex.matrix, ring)
    table = question.table(budget, whole_free=True, extra=tuple(polynomials(whole))).table
    cells = free_cells(table)
    outside = Columns(cells, table.factors).where(convert(known, ring))[1]
    answer = formula_of_cells(table.factors, [cell for k, cell in enumerate(cells) if not outside >> k & 1])
    return simplify(convert(answer, both.ring or Ring.of(both.free)), known, watch=budget.check)


_Answer = tuple[Formula, CellTable, frozenset[int]]


@dataclass(frozen=True, slots=True)
class _Question:
    """A prenex formula with the order of its variables."""

    prenex: Prenex
    free: tuple[str, ...]
    options: Options

    def table(
        self,
        budget: Budget,
        thom_levels: frozenset[int] = frozenset(),
        *,
        whole_free: bool = False,
        extra: tuple[Poly, ...] = (),
    ) -> Decomposed:
        """Its decomposition by the tactics that the options allow; see ``Tactics`` for ``whole_free``.

        With ``extra`` the signs of these polynomials in the free variables are wanted on every free cell.
        """
        without, operator = self.options.without, OPERATORS[self.options.projection]
        return decompose(
            self.prenex.matrix,
            self.prenex.order,
            self.prenex.quantifiers,
            budget=budget,
            operator=operator.complete if Stage.MCCALLUM in without else operator,
            thom_levels=thom_levels,
            tactics=Tactics(
                constraints=Stage.CONSTRAINTS not in without,
                partial=Stage.PARTIAL not in without,
                open_only=Stage.OPEN not in without,
                whole_free=whole_free,
                free_constraints=not extra,
            ),
            extra=extra,
        )

    def answer(
        self, found: Decomposed, budget: Budget, thom_levels: frozenset[int] = frozenset(), *, whole_free: bool = False
    ) -> _Answer:
        """The formula that a decomposition gives, and the table (refined if need be) that proves it; with the levels
        whose derivatives it needs, ``thom_levels`` from the start."""
        levels = thom_levels

        def refine(more: frozenset[int]) -> CellTable:
            nonlocal levels
            levels = more
            free = free_part(found.table)
            table = None if self.options.root_atoms else refined(free, found.operator, levels, budget)
            return table or self.table(budget, levels, whole_free=whole_free).table

        answer, proof = construct(found.table, refine, levels)
        if self.options.root_atoms:
            from qe.decomposition.extended_tarski import extended_formula

            answer = extended_formula(proof)
        simple = simplify(convert(answer, Ring.of(self.free)), watch=budget.check)
        return simple, proof, levels

    def shortest(self, first: Decomposed, budget: Budget) -> tuple[_Answer, CellTable | None]:
        """As ``answer``; a small one is compared with that of the whole space of the free variables, for which formula
        construction knows the signs of all factors everywhere. Last: the table of that space."""
        best = self.answer(first, budget)
        plain = not self.options.root_atoms and Stage.PARTIAL not in self.options.without
        fewest = WHOLE_ATOMS_BOUND if any(self.prenex.quantifiers) else WHOLE_ATOMS
        if not plain or first.cells > WHOLE_FROM or length(best[0])[0] < fewest or not is_small(best[0]):
            return best, None
        part = budget.part(WHOLE_CELLS)
        try:
            whole = self.table(part, best[2], whole_free=True)
            other = self.answer(whole, part, best[2], whole_free=True)
        except BudgetExceeded:
            return best, None
        return min(best, other, key=lambda one: length(one[0])), other[1]


def _figures(found: Decomposed, seconds: float) -> dict[str, object]:
    return {
        "projection": found.operator.name.value,
        "factors": found.factors,
        "cells": found.cells,
        "stacks": found.stacks,
        "nullified": found.nullified,
        "equational constraints": list(found.restricted),
        "seconds": round(seconds, 6),
    }

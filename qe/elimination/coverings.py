"""Cylindrical algebraic coverings as a method: any prefix, with and without parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from qe.decomposition.cover import Search
from qe.decomposition.evidence import tree
from qe.decomposition.formulas import Undistinguished, formula_of_cells
from qe.decomposition.line import Cover
from qe.decomposition.order import Prenex
from qe.decomposition.parameters import parameter_cells
from qe.elimination.protocol import Context, Outcome
from qe.errors import InternalError
from qe.exact.number import Values
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import convert
from qe.formula.syntax import FALSE, TRUE, Constant, Formula
from qe.options import Budget, Options
from qe.proof.certificate import Certificate
from qe.proof.on_demand import OnDemand, Repeated
from qe.proof.run_log import RunLog
from qe.simplifier.simplify import simplify


class Coverings:
    """Any block, with what is quantified inside it, by coverings of lines (see ``qe.decomposition.cover``)."""

    name = "coverings"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Every problem."""
        return "for any prefix and parameters"

    def run(self, problem: Block, context: Context) -> Outcome:
        """The answer by the signs of the polynomials of parameter space, or a truth value, with values where there are
        some. Raises ``NotWellOriented`` where a polynomial is zero on a whole line and its order is needed beside it,
        ``BudgetExceeded``.
        """
        question = Prenex.of(problem.formula, context.options, context.budget)
        matrix, quantifiers = question.matrix, question.quantifiers
        if isinstance(matrix, Constant):
            return Outcome(matrix, {} if matrix.value is not problem.universal else None)
        free, ring = len(problem.free), Ring.of(question.order)
        answered = _answered(Search(convert(matrix, ring), ring, quantifiers, context.budget), free)
        figures = {**question.figures, "samples": answered.samples, "cells": answered.cells}
        context.log.work("coverings", figures)
        values = None
        if not free and answered.cover.truth is (quantifiers[0] == "E"):
            values = _values(answered.cover, quantifiers)
        proof: dict[str, object] = {}
        if values is None or not problem.is_flat:  # values prove the answer otherwise
            wanted = context.options.certify
            again = OnDemand(Repeated(covered, problem.formula, context.options))
            proof["proof"] = _evidence(answered, quantifiers, convert(matrix, ring)) if wanted else again
        before = problem.formula.ring
        answer = answered.formula if before is None else convert(answered.formula, before)
        context.log.step("covering", problem.formula, answer, evidence=proof)
        return Outcome(context.log.step("simplification", answer, simplify(answer, watch=context.budget.check)), values)


def covered(formula: Formula, options: Options, budget: Budget, log: RunLog) -> None:
    """The steps of the method for a formula that begins with a quantifier, in the log."""
    problem = Block.of(formula)
    if problem is not None:
        Coverings().run(problem, Context(options, budget, log))


@dataclass(frozen=True, slots=True)
class _Answered:
    """A covering, with the answer whose truth follows from the signs on each of its cells."""

    cover: Cover
    formula: Formula
    samples: int
    cells: int = 0


def _evidence(answered: _Answered, quantifiers: Sequence[str], matrix: Formula) -> dict[str, object]:
    """The covering as a certificate."""
    answer = convert(answered.formula, answered.cover.point.ring)
    return {"certificate": Certificate.cells(tree(answered.cover, quantifiers, matrix), answer)}


def _answered(search: Search, free: int) -> _Answered:
    """The covering, finer where the signs of its polynomials do not tell true cells from false ones."""
    samples = 0
    while True:
        cover = search.run()
        samples += search.samples
        if not free:
            return _Answered(cover, TRUE if cover.truth else FALSE, samples)
        factors, cells = parameter_cells(cover, free)
        try:
            return _Answered(cover, formula_of_cells(factors, cells), samples, len(cells))
        except Undistinguished as pair:
            search = _finer(search, pair.level)


def _finer(search: Search, level: int) -> Search:
    """The search with more signs on the level at which two cells part.

    First every interval of a line there keeps the signs of all polynomials of the line, so that intervals are disjoint
    and have these in common; then also of their derivatives: by Thom's lemma these signs tell the intervals apart.
    """
    if level not in search.whole:
        return replace(search, whole=search.whole | {level}, samples=0)
    if level in search.thom:
        raise InternalError("derivatives do not distinguish the cells, against Thom's lemma")
    return replace(search, thom=search.thom | {level}, samples=0)


def _values(cover: Cover, quantifiers: Sequence[str]) -> Values:
    """The values of the first block that decide a sentence."""
    known = cover.intervals[0].known
    while isinstance(above := known.reason, Cover) and quantifiers[above.point.depth] == quantifiers[0]:
        known = above.intervals[0].known
    sample = known.sample
    return {name: sample.number(i) for i, name in enumerate(sample.ring.names[: sample.depth])}

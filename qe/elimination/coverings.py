"""Cylindrical algebraic coverings as a method: any prefix, with and without parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from qe.cad.order_by_projection import variable_order
from qe.cells.formulas import formula_of_cells, undistinguished
from qe.coverings.cover import Search
from qe.coverings.evidence import tree
from qe.coverings.line import Cover
from qe.coverings.parameters import parameter_cells
from qe.elimination.protocol import Context, Outcome
from qe.errors import InternalError
from qe.exact.number import Values
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import convert
from qe.formula.normal import nnf, prenex
from qe.formula.syntax import FALSE, TRUE, Constant, Formula
from qe.options import Budget, Options
from qe.proof.cells import FreeCell
from qe.proof.certificate import Certificate
from qe.proof.on_demand import OnDemand, Repeated
from qe.proof.run_log import RunLog
from qe.simplify.simplify import simplify


class Coverings:
    """Any block, with what is quantified inside it, by coverings of lines (see ``qe.coverings.cover``)."""

    name = "coverings"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Every problem."""
        return "for any prefix and parameters"

    def run(self, problem: Block, context: Context) -> Outcome:
        """The answer by the signs of the polynomials of parameter space, or a truth value, with values where there are
        some. Raises ``NotWellOriented`` where a polynomial is zero on a whole line and its order is needed beside it,
        ``BudgetExceeded``.
        """
        prefix, matrix = prenex(problem.formula)
        matrix = nnf(matrix)
        if isinstance(matrix, Constant):
            return Outcome(matrix, {} if matrix.value is not problem.universal else None)
        free = len(problem.free)
        order, quantifiers, reason = variable_order(prefix, problem.free, matrix, context.options, context.budget)
        ring = Ring.of(order)
        search = Search(convert(matrix, ring), ring, quantifiers, context.budget)
        found = _answered(search, free)
        figures = {"order": list(order), "order by": reason, "samples": found.samples, "cells": found.cells}
        context.log.work("coverings", figures)
        values = None
        if not free and found.cover.truth is (quantifiers[0] == "E"):
            values = _values(found.cover, search)
        proof: dict[str, object] = {}
        if values is None or not problem.is_flat:  # values prove the answer otherwise
            wanted = context.options.certify
            again = OnDemand(Repeated(covered, problem.formula, context.options))
            proof["proof"] = _evidence(found, quantifiers, search.formula) if wanted else again
        given = problem.formula.ring
        answer = found.formula if given is None else convert(found.formula, given)
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


def _evidence(found: _Answered, quantifiers: Sequence[str], matrix: Formula) -> dict[str, object]:
    """The covering as a certificate."""
    answer = convert(found.formula, found.cover.point.ring)
    return {"certificate": Certificate.cells(tree(found.cover, quantifiers, matrix), answer)}


def _answered(search: Search, free: int) -> _Answered:
    """The covering, finer where the signs of its polynomials do not tell true cells from false ones."""
    samples = 0
    while True:
        cover = search.run()
        samples += search.samples
        if not free:
            return _Answered(cover, TRUE if cover.truth else FALSE, samples)
        factors, cells = parameter_cells(cover, free)
        pair = undistinguished(factors, cells)
        if pair is None:
            return _Answered(cover, formula_of_cells(factors, cells), samples, len(cells))
        search = _finer(search, *pair)


def _finer(search: Search, one: FreeCell, other: FreeCell) -> Search:
    """The search with more signs on the level at which two cells part.

    First every interval of a line there keeps the signs of all polynomials of the line, so that intervals are disjoint
    and have these in common; then also of their derivatives: by Thom's lemma these signs tell the intervals apart.
    """
    level = next(k for k, (a, b) in enumerate(zip(one.path, other.path, strict=False)) if a != b)
    if level not in search.whole:
        return replace(search, whole=search.whole | {level}, samples=0)
    if level in search.thom:
        raise InternalError("derivatives do not tell the cells apart, against Thom's lemma")
    return replace(search, thom=search.thom | {level}, samples=0)


def _values(cover: Cover, search: Search) -> Values:
    """The values of the first block that decide a sentence."""
    while isinstance(above := cover.intervals[0].found.reason, Cover) and search.is_leading(above.point.depth):
        cover = above
    sample = cover.intervals[0].found.sample
    return {name: sample.number(i) for i, name in enumerate(search.ring.names[: sample.depth])}

"""Decomposition in the pipeline: prenex form, order, cell table, solution formula, certificate."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.eliminate.cad.decompose import Decomposition, Tactics, decompose
from qe.eliminate.cad.pilot import choose_order
from qe.errors import BudgetExceeded, InternalError
from qe.evidence.cells import CellTable
from qe.evidence.cells_json import CellEvidence
from qe.evidence.certificate import Certificate
from qe.evidence.story import Story
from qe.exact.algebraic import RealAlgebraic
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.formula.normal import Quantifier, nnf, prenex
from qe.formula.syntax import FALSE, TRUE, Constant, Formula, Or
from qe.formula.traverse import atoms, children, free_variables, polynomials, ring_of
from qe.options import Budget, Options, Projection, Stage
from qe.plan.order import OrderRule
from qe.prepare.simplify import simplify
from qe.solution.construct import construct
from qe.solution.extended import extended_formula
from qe.solution.follows import follows
from qe.solution.walk import deciding_point

Values = dict[str, Fraction | RealAlgebraic]

WHOLE_FROM, WHOLE_CELLS = 300, 2000
"""A decomposition of at most so many cells is made once more with the whole space of the free variables, of at most so
many cells in all, when its answer is small (``is_small``)."""

SMALL_DEGREE = {1: 40, 2: 12, 3: 4, 4: 2}
"""An answer in so many variables is small up to this total degree: its whole space is decomposed in no time."""


@dataclass(frozen=True, slots=True)
class Decomposed:
    """``formula``: equivalent to what was asked. ``values``: a witness or counterexample of a sentence's outermost
    block, where there is one. ``certificate``: of exactly this question
    and answer; None where nothing was decomposed, or where simplifying brought in other polynomials.
    """

    formula: Formula
    values: Values | None = None
    certificate: Certificate | None = None


def decomposed(formula: Formula, options: Options, budget: Budget, story: Story) -> Decomposed:
    """Any formula, as a whole, by cylindrical algebraic decomposition. Raises ``BudgetExceeded``."""
    start = time.perf_counter()
    prefix, matrix = prenex(formula)
    matrix = nnf(matrix)
    if isinstance(matrix, Constant):
        return Decomposed(matrix, {} if matrix.value else None)
    free = free_variables(formula)
    order, quantifiers, reason = _order(prefix, free, matrix, options, budget)
    question = _Question(matrix, order, quantifiers, free, options)
    first = question.table(budget)
    values: Values | None = None
    if free:
        answer, proof = question.shortest(first, budget)
    else:
        truth, proof = first.table.root.truth is True, first.table
        answer = TRUE if truth else FALSE
        if truth is (quantifiers[0] == "E"):
            values = deciding_point(proof, truth)
    story.note("cad", _figures(order, reason, first, time.perf_counter() - start))
    certificate = Certificate.cells(proof, convert(answer, Ring.of(order))) if follows(answer, proof) else None
    # back into the ring of the formula it came from: it is joined with parts of that formula
    ring = ring_of(formula)
    return Decomposed(answer if ring is None else convert(answer, ring), values, certificate)


def certificate_for(formula: Formula, answer: Formula, options: Options, budget: Budget) -> Certificate | None:
    """A decomposition that proves ``formula`` <-> ``answer``, a quantifier-free formula from whatever source.

    The factors of the answer join the projection, and the space of the free variables is decomposed whole, so that the
    table has their signs on every cell. None where the formula has no matrix to decompose. Raises ``BudgetExceeded``,
    and ``InternalError`` where the decomposition decides a sentence otherwise.
    """
    prefix, matrix = prenex(formula)
    matrix = nnf(matrix)
    if isinstance(matrix, Constant):
        return None
    free = free_variables(formula)
    order, quantifiers, _ = _order(prefix, free, matrix, options, budget)
    ring = Ring.of(order)
    claim = convert(answer, ring)
    question = _Question(matrix, order, quantifiers, free, options)
    proof = question.table(budget, whole_free=True, beside=tuple(polynomials(claim))).table
    if not free and answer != (TRUE if proof.root.truth else FALSE):
        raise InternalError(f"a decomposition says {proof.root.truth} where the answer is {answer}")
    return Certificate.cells(proof, claim)


@dataclass(frozen=True, slots=True)
class _Question:
    """A prenex formula with the order of its variables."""

    matrix: Formula
    order: tuple[str, ...]
    quantifiers: tuple[str, ...]
    free: tuple[str, ...]
    options: Options

    def table(
        self,
        budget: Budget,
        separated: frozenset[int] = frozenset(),
        *,
        whole_free: bool = False,
        beside: tuple[Poly, ...] = (),
    ) -> Decomposition:
        """Its decomposition by the tactics that the options allow; see ``Tactics`` for ``whole_free``.

        With ``beside`` the signs of these polynomials in the free variables are wanted on every free cell.
        """
        without = self.options.without
        return decompose(
            self.matrix,
            self.order,
            self.quantifiers,
            budget=budget,
            projection=Projection.LAZARD if Stage.MCCALLUM in without else self.options.projection,
            separated=separated,
            tactics=Tactics(
                constraints=Stage.CONSTRAINTS not in without,
                partial=Stage.PARTIAL not in without,
                open_only=Stage.OPEN not in without,
                whole_free=whole_free,
                free_constraints=not beside,
            ),
            beside=beside,
        )

    def answer(self, found: Decomposition, budget: Budget, *, whole_free: bool = False) -> tuple[Formula, CellTable]:
        """The formula that a decomposition gives, and the table (refined if need be) that proves it."""

        def refined(levels: frozenset[int]) -> CellTable:
            return self.table(budget, levels, whole_free=whole_free).table

        answer, proof = construct(found.table, refined)
        if self.options.root_atoms:
            answer = extended_formula(proof)
        simple = simplify(convert(answer, Ring.of(self.free)))
        return simple, proof

    def shortest(self, first: Decomposition, budget: Budget) -> tuple[Formula, CellTable]:
        """The answer; a small one is compared with that of the whole space of the free variables, for which formula
        construction knows the signs of all factors everywhere."""
        answer, proof = self.answer(first, budget)
        plain = not self.options.root_atoms and Stage.PARTIAL not in self.options.without
        if not plain or first.cells > WHOLE_FROM or not is_small(answer):
            return answer, proof
        part = budget.apart(cells=WHOLE_CELLS)
        try:
            other, table = self.answer(self.table(part, whole_free=True), part, whole_free=True)
        except BudgetExceeded:
            return answer, proof
        return (other, table) if length(other) < length(answer) else (answer, proof)


def is_small(formula: Formula) -> bool:
    """Whether a shorter equivalent is easily found: few variables and low degrees. Conjunctions are short enough."""
    if not _has_disjunction(formula):
        return False
    degree = max((a.poly.total_degree for a in atoms(formula)), default=0)
    return degree <= SMALL_DEGREE.get(len(free_variables(formula)), 0)


def _has_disjunction(formula: Formula) -> bool:
    return isinstance(formula, Or) or any(_has_disjunction(part) for part in children(formula))


def length(formula: Formula) -> tuple[int, int]:
    """Atoms, and terms of their polynomials."""
    polys = [a.poly for a in atoms(formula)]
    return len(polys), sum(p.term_count() for p in polys)


def claims(certificate: Certificate, answer: Formula) -> bool:
    """Whether a certificate by cells is about this very answer."""
    evidence = certificate.payload
    if not isinstance(evidence, CellEvidence) or evidence.answer is None:
        return True
    return evidence.answer == convert(answer, Ring.of(evidence.table.order))


def _figures(order: Sequence[str], reason: str, found: Decomposition, seconds: float) -> dict[str, object]:
    return {
        "order": list(order),
        "order by": reason,
        "projection": found.table.projection.value,
        "factors": found.factors,
        "cells": found.cells,
        "stacks": found.stacks,
        "nullified": found.nullified,
        "equational constraints": list(found.restricted),
        "seconds": round(seconds, 6),
    }


def _order(
    prefix: Sequence[tuple[Quantifier, tuple[str, ...]]],
    free: Sequence[str],
    matrix: Formula,
    options: Options,
    budget: Budget,
) -> tuple[tuple[str, ...], tuple[str, ...], str]:
    """The variables, free ones first, blocks never mixed; the quantifier of each; and why this order.

    Within a block the variables that the caller named come first, in the caller's order.
    """
    parts = [("", tuple(free)), *((kind.value, names) for kind, names in prefix)]
    blocks: list[tuple[str, ...]] = []
    for _, names in parts:
        wished = [v for v in options.order or () if v in names]
        rest = tuple(v for v in names if v not in wished)
        blocks += [*((v,) for v in wished), *([rest] if rest else [])]
    rule = OrderRule.WRITTEN if Stage.ORDER in options.without else OrderRule.PILOT
    order, reason = choose_order(matrix, blocks, rule=rule, budget=budget)
    return order, tuple(kind for kind, names in parts for _ in names), reason

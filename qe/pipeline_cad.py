"""Decomposition in the pipeline: prenex form, order, cell table, solution formula, certificate."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.eliminate.cad.decompose import Decomposition, Tactics, decompose
from qe.eliminate.cad.pilot import choose_order
from qe.evidence.cells import CellTable
from qe.evidence.certificate import Certificate
from qe.evidence.story import Story
from qe.exact.algebraic import RealAlgebraic
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.normal import Quantifier, nnf, prenex
from qe.formula.syntax import FALSE, TRUE, Constant, Formula
from qe.formula.traverse import free_variables, polynomials, ring_of
from qe.options import Budget, Options, Projection, Stage
from qe.plan.order import OrderRule
from qe.prepare.simplify import simplify
from qe.solution.construct import construct
from qe.solution.extended import extended_formula
from qe.solution.walk import deciding_point

Values = dict[str, Fraction | RealAlgebraic]


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
    projection = Projection.LAZARD if Stage.MCCALLUM in options.without else options.projection

    tactics = Tactics(
        constraints=Stage.CONSTRAINTS not in options.without,
        partial=Stage.PARTIAL not in options.without,
        open_only=Stage.OPEN not in options.without,
    )

    def table(separated: frozenset[int] = frozenset()) -> Decomposition:
        return decompose(
            matrix, order, quantifiers, budget=budget, projection=projection, separated=separated, tactics=tactics
        )

    first = table()
    values: Values | None = None
    if free:
        answer, proof = construct(first.table, lambda levels: table(levels).table)
        if options.root_atoms:
            answer = extended_formula(proof)
        shorter = simplify(convert(answer, Ring.of(free)))
        if not options.certify or _is_listed(shorter, proof):
            answer = shorter
    else:
        truth, proof = first.table.root.truth is True, first.table
        answer = TRUE if truth else FALSE
        if truth is (quantifiers[0] == "E"):
            values = deciding_point(proof, truth)
    story.note("cad", _figures(order, reason, first, time.perf_counter() - start))
    certificate = Certificate.cells(proof, convert(answer, Ring.of(order))) if _is_listed(answer, proof) else None
    # back into the ring of the formula it came from: it is joined with parts of that formula
    ring = ring_of(formula)
    return Decomposed(answer if ring is None else convert(answer, ring), values, certificate)


def _is_listed(answer: Formula, table: CellTable) -> bool:
    """Whether the answer's polynomials are products of the table's factors, as the checker wants them."""
    factors = {f for level in table.factors for f in level}
    ring = Ring.of(table.order)
    return all(f in factors for p in polynomials(answer) for f, _ in p.convert(ring).factors()[1])


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
    """The variables, free ones first, blocks never mixed; the quantifier of each; and why this order."""
    parts = [("", tuple(free)), *((kind.value, names) for kind, names in prefix)]
    blocks: list[tuple[str, ...]] = []
    for _, names in parts:
        wished = [v for v in options.order or () if v in names]
        blocks += [(v,) for v in wished] if len(wished) == len(names) else [names]
    rule = OrderRule.WRITTEN if Stage.ORDER in options.without else OrderRule.PILOT
    order, reason = choose_order(matrix, blocks, rule=rule, budget=budget)
    return order, tuple(kind for kind, names in parts for _ in names), reason

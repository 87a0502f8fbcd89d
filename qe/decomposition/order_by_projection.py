"""Choosing a variable order by projecting: greedy steps, and whole projections of the candidates for comparison."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from qe.decomposition.constraints import equational_constraints
from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.order import Candidate, OrderRule, brown_order, greedy_order, preferred, sotd
from qe.decomposition.projection import FactorSet, effort, factor_lists, project
from qe.errors import BudgetExceeded
from qe.exact.algebraic import real_roots
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.formula.normal import Quantifier
from qe.formula.syntax import Formula
from qe.formula.traverse import polynomials
from qe.options import Budget, Options, Stage

Found = TypeVar("Found")

HEAVY = 20_000
"""Projections of more effort than this are not tried: a resultant cannot be interrupted, and what is chosen must not
depend on the clock (measured: up to a tenth of a second for all trials of a problem)."""

TOO_HEAVY = 10 * HEAVY
"""The usual order is left for another one outright where its projection has steps of more effort than this."""

ROOTS_UP_TO = 300
"""Roots are counted where the polynomials of level 0 have degrees up to this in all."""


def choose_order(
    matrix: Formula, blocks: Sequence[Sequence[str]], *, rule: OrderRule = OrderRule.BY_PROJECTION, budget: Budget
) -> tuple[tuple[str, ...], str]:
    """The order of all variables (free block first, blocks never mixed) and why it was taken.

    A part of the order that the caller fixes is written as blocks of one variable.
    """
    polys = polynomials(matrix)
    if rule is OrderRule.WRITTEN or all(len(block) < 2 for block in blocks):
        return tuple(v for block in blocks for v in block), OrderRule.WRITTEN.value
    brown = tuple(v for block in blocks for v in brown_order(polys, block))
    if rule is OrderRule.BROWN:
        return brown, rule.value
    greedy = _unless_heavy(lambda: greedy_order(polys, blocks, lambda found, v: _projected(found, v, budget)), budget)
    if greedy is None:
        return brown, "brown (greedy is too heavy)"
    if rule is OrderRule.GREEDY or greedy == brown:
        return greedy, rule.value if rule is OrderRule.GREEDY else "brown and greedy agree"
    usual = _unless_heavy(lambda: _measured(matrix, brown, OrderRule.BROWN, TOO_HEAVY, budget), budget)
    other = _unless_heavy(lambda: _measured(matrix, greedy, OrderRule.GREEDY, HEAVY, budget), budget)
    if other is None:
        return brown, "brown (greedy is too heavy)"
    if usual is None:
        return greedy, "greedy (brown is too heavy)"
    best = preferred(usual, other)
    figures = ", ".join(f"{c.rule.value} {c.sotd} with {c.roots} roots" for c in (usual, other))
    return best.order, f"{best.rule.value} (size of projection: {figures})"


def variable_order(
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
        named = [v for v in options.order or () if v in names]
        rest = tuple(v for v in names if v not in named)
        blocks += [*((v,) for v in named), *([rest] if rest else [])]
    rule = OrderRule.WRITTEN if Stage.ORDER in options.without else OrderRule.BY_PROJECTION
    order, reason = choose_order(matrix, blocks, rule=rule, budget=budget)
    return order, tuple(kind for kind, names in parts for _ in names), reason


def _unless_heavy(trial: Callable[[], Found], budget: Budget) -> Found | None:
    try:
        return trial()
    except BudgetExceeded:
        budget.check("order")  # a limit of the caller's goes on
        return None


def _projected(polys: Sequence[Poly], name: str, budget: Budget) -> list[Poly]:
    """The irreducible factors left without the variable; raises ``BudgetExceeded`` rather than start a heavy step."""
    if not polys or name not in polys[0].ring.index:
        return list(polys)
    i = polys[0].ring.index[name]
    factors = FactorSet(polys)
    inside = [f for f in factors if f.degree(i)]
    if effort(inside, i) > HEAVY:
        raise BudgetExceeded("a trial projection is too heavy", limit="effort")
    left = FactorSet(f for f in factors if not f.degree(i))
    for p in project(inside, i, BROWN_MCCALLUM):
        budget.check("order")
        left.add((p,))
    return list(left)


def _measured(matrix: Formula, order: tuple[str, ...], rule: OrderRule, heaviest: int, budget: Budget) -> Candidate:
    """The size of the whole projection."""
    matrix = convert(matrix, Ring.of(order))
    levels = factor_lists(
        polynomials(matrix),
        len(order),
        BROWN_MCCALLUM,
        budget,
        constraints=equational_constraints(matrix, len(order)).factors,
        heaviest=heaviest,
    )
    roots = sum(f.degree(0) for f in levels[0])
    if roots <= ROOTS_UP_TO:
        roots = sum(len(real_roots(f.to_univariate(0))) for f in levels[0])
    return Candidate(order, rule, sum(sotd(level) for level in levels), roots)

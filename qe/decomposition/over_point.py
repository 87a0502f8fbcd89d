"""Deciding an existential block over one point of its parameters by lifting from that point.

THEOREM (Lazard 1994; McCallum, Parusinski, Paunescu 2019). A single point is a connected manifold on which every
polynomial is valuation-invariant. So if the factor lists of the quantified levels are closed under Lazard's
projection among themselves, lifting with Lazard evaluation from that point gives cells on which they are
sign-invariant; nothing needs to be projected into the space of the parameters.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache

from qe.decomposition.decompose import decompose
from qe.decomposition.lifting import Lifter, Plan, sector_levels
from qe.decomposition.matrix import compile_matrix, specialise
from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.order import brown_order
from qe.decomposition.projection import factor_lists
from qe.exact.fibre_stack import isolate_over
from qe.exact.nearby import rational_values
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.formula.build import convert
from qe.formula.evaluate import substituted, truth_under
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import polynomials
from qe.options import Budget


def over_point(matrix: Formula, order: tuple[str, ...], free: int, *, budget: Budget) -> Callable[[Point], bool]:
    """The truth of ``exists order[free:]. matrix`` (matrix quantifier-free) at points of the first ``free`` variables.

    The points are points of the ring of all of ``order``. Over points with an irrational coordinate the projection is
    done once, for all of them. Raises ``BudgetExceeded``.
    """

    @cache
    def lifted() -> Callable[[Point], bool]:
        return _lifted(matrix, order, free, budget)

    def decide(point: Point) -> bool:
        if point.algebraic:
            return lifted()(point)
        return _at_rationals(matrix, order[free:], dict(zip(order, rational_values(point), strict=False)), budget)

    return decide


def _lifted(matrix: Formula, order: tuple[str, ...], free: int, budget: Budget) -> Callable[[Point], bool]:
    matrix = nnf(convert(matrix, Ring.of(order)))
    lists = factor_lists(polynomials(matrix), len(order), LAZARD, budget, lowest=free)
    node = compile_matrix(matrix, {f: (k, j) for k, level in enumerate(lists) for j, f in enumerate(level)})
    quantifiers = ("",) * free + ("E",) * (len(order) - free)
    lifter = Lifter(Plan(lists, quantifiers, LAZARD, sector_levels(matrix, quantifiers)), budget)

    def decide(point: Point) -> bool:
        here = node
        for k in range(free):
            here = specialise(here, k, {j: point.sign(f) for j, f in enumerate(lists[k])})
        return lifter.run(point, here).truth is True

    return decide


def _at_rationals(matrix: Formula, variables: tuple[str, ...], values: dict[str, Fraction], budget: Budget) -> bool:
    """The truth of ``exists variables. matrix`` at rational values of the other variables."""
    rest = substituted(matrix, values)
    if rest in (TRUE, FALSE):
        return rest == TRUE
    if len(variables) == 1:  # its polynomials have constant signs between their roots
        line = convert(rest, Ring.of(variables))
        stack = isolate_over(Point(Ring.of(variables)), tuple(polynomials(line)))
        return any(truth_under(line, signs.get) for signs in stack.sign_maps())
    order = brown_order(polynomials(rest), variables)
    return decompose(rest, order, ("E",) * len(order), budget=budget).table.root.truth is True

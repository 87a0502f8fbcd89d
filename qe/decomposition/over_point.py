"""Deciding an existential block over one point of its parameters by lifting from that point.

THEOREM (Lazard 1994; McCallum, Parusinski, Paunescu 2019). A single point is a connected manifold on which every
polynomial is valuation-invariant. So if the factor lists of the quantified levels are closed under Lazard's
projection among themselves, lifting with Lazard evaluation from that point gives cells on which they are
sign-invariant; nothing needs to be projected into the space of the parameters.
"""

from __future__ import annotations

from collections.abc import Callable

from qe.decomposition.lifting import Lifter, Plan, sector_levels
from qe.decomposition.matrix import compile_matrix, specialise
from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.projection import factor_lists
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.formula.build import convert
from qe.formula.normal import nnf
from qe.formula.syntax import Formula
from qe.formula.traverse import polynomials
from qe.options import Budget


def over_point(matrix: Formula, order: tuple[str, ...], free: int, *, budget: Budget) -> Callable[[Point], bool]:
    """The truth of ``exists order[free:]. matrix`` (matrix quantifier-free) at points of the first ``free`` variables.

    The points are points of the ring of all of ``order``. The projection is done once, for all points.
    Raises ``BudgetExceeded``.
    """
    ring = Ring.of(order)
    matrix = nnf(convert(matrix, ring))
    lists = factor_lists(polynomials(matrix), len(order), LAZARD, budget, lowest=free)
    places = {f: (k, j) for k, level in enumerate(lists) for j, f in enumerate(level)}
    node = compile_matrix(matrix, places)
    quantifiers = ("",) * free + ("E",) * (len(order) - free)
    lifter = Lifter(Plan(lists, quantifiers, LAZARD, sector_levels(matrix, quantifiers)), budget)

    def decide(point: Point) -> bool:
        here = node
        for k in range(free):
            here = specialise(here, k, {j: point.sign(f) for j, f in enumerate(lists[k])})
        return lifter.run(point, here).truth is True

    return decide

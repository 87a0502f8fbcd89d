"""The open cells of a decomposition of parameter space, and the hypersurfaces between true and false ones.

THEOREM. Let T be a closed convex set whose boundary lies in the zeros of polynomials U, and let some open cell of a
decomposition for U be true. Then the boundary of T lies in the zeros of those polynomials of U that have a section
between a true and a false sector over an open cell, and those without the last variable.
PROOF. T has interior points, so it is the closure of its interior and its boundary is a manifold of codimension one.
A piece of the boundary over lower polynomials' zeros lies in the zeros of a polynomial without the last variable.
Elsewhere, over an open cell B of the last but one space, the fibre of T over each point of B is an interval with
interior points (otherwise no open cell over B would be true, while T, if it meets B x R at all, has interior points
there); so a boundary point over B is an end of that interval and separates a true from a false sector.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction

from qe.eliminate.critical.helpers import Levels
from qe.exact.fibre_stack import Section, isolate_over
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.options import Budget

Values = tuple[Fraction, ...]
Holds = Callable[[Values], bool]


@dataclass(slots=True)
class Walls:
    """One exploration for a closed convex set. ``inside``: samples of true open cells; ``walls``: see the theorem."""

    levels: Levels
    holds: Holds
    budget: Budget
    cells: int = 0
    inside: list[Values] = field(default_factory=list)
    walls: set[Poly] = field(default_factory=set)

    def explore(self, point: Point, values: Values = ()) -> bool:
        """Whether some open cell over the point is true. Beyond the end of a true run all are false by convexity."""
        level = point.depth
        if level == len(self.levels):
            self.cells += 1
            self.budget.check("open cells", self.cells)
            if not self.holds(values):
                return False
            self.inside.append(values)
            return True
        isolation = isolate_over(point, self.levels[level])
        before: bool | None = None
        entered = False
        for k, q in enumerate(isolation.sectors):
            here = self.explore(point.extend(q), (*values, Fraction(int(q.p), int(q.q))))
            if level == len(self.levels) - 1 and before is not None and here is not before:
                self._wall(isolation.sections[k - 1], level)
            if entered and not here:
                break
            entered, before = entered or here, here
        return entered

    def _wall(self, section: Section, level: int) -> None:
        self.walls |= {self.levels[level][j] for j in section.members}


@dataclass(frozen=True, slots=True)
class OpenCell:
    """``path``: the number of the sector in every stack; ``signs``: per level the signs of all its factors, as text
    of ``+`` and ``-``; ``values``: the sample."""

    path: tuple[int, ...]
    signs: tuple[str, ...]
    values: Values
    truth: bool


def open_cells(levels: Levels, holds: Holds, origin: Point, budget: Budget) -> list[OpenCell]:
    """All open cells of the decomposition for factor lists closed under projection."""

    def over(point: Point, path: tuple[int, ...], signs: tuple[str, ...], values: Values) -> Iterator[OpenCell]:
        if point.depth == len(levels):
            budget.check("open cells")
            yield OpenCell(path, signs, values, holds(values))
            return
        isolation = isolate_over(point, levels[point.depth])
        texts = isolation.sign_texts()
        for k, q in enumerate(isolation.sectors):
            value = Fraction(int(q.p), int(q.q))
            yield from over(point.extend(q), (*path, k), (*signs, texts[2 * k]), (*values, value))

    return list(over(origin, (), (), ()))

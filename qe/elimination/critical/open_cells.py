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

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from qe.decomposition.projection import Levels
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.options import Budget

Values = tuple[Fraction, ...]
Holds = Callable[[Values], bool]


@dataclass(slots=True)
class OpenCells:
    """The open cells for a closed convex set T and factor lists closed under projection.

    By convexity the sectors of a stack over which T has interior points follow one another, so that only the ends of
    that run are looked for; ``hint`` says where to begin (a point of T, or any). ``inside``: samples of true cells.
    """

    levels: Levels
    holds: Holds
    budget: Budget
    hint: Values
    decided: int = 0
    inside: list[Values] = field(default_factory=list)
    _stacks: dict[tuple[int, ...], tuple[Isolation, range]] = field(default_factory=dict)
    _near: list[Fraction] = field(default_factory=list)

    def explore(self, origin: Point) -> bool:
        """Visit the stacks that can hold true cells; whether there is one."""
        self._near = list(self.hint)
        return self._any_true(origin, (), ())

    def _any_true(self, point: Point, path: tuple[int, ...], values: Values) -> bool:
        level = point.depth
        if level == len(self.levels):
            self.decided += 1
            self.budget.check("open cells", self.decided)
            if self.holds(values):
                self.inside.append(values)
                return True
            return False
        isolation = isolate_over(point, self.levels[level])
        samples = isolation.samples

        def test(k: int) -> bool:
            return self._any_true(isolation.sample(2 * k), (*path, k), (*values, samples[k]))

        run = true_run(samples, self._near[level], test)
        if run:
            self._near[level] = samples[(run.start + run.stop) // 2]
        if level < len(self.levels) - 1:
            for k in run:
                if (*path, k) not in self._stacks:
                    test(k)
        self._stacks[path] = isolation, run
        return bool(run)

    def walls(self) -> set[Poly]:
        """The polynomials of the last level that vanish between a true and a false sector."""
        found: set[Poly] = set()
        last = len(self.levels) - 1
        for path, (isolation, run) in self._stacks.items():
            if len(path) == last and run:
                ends = [k for k in (run.start - 1, run.stop - 1) if 0 <= k < len(isolation.sections)]
                found |= {self.levels[last][j] for k in ends for j in isolation.sections[k].members}
        return found


def true_run(samples: Sequence[Fraction], near: Fraction, test: Callable[[int], bool]) -> range:
    """The indices with a true test, which follow one another; sought from the sample nearest to a number. Its ends are
    found by bisection: others in the middle are not tested."""
    first = next((k for k in sorted(range(len(samples)), key=lambda k: abs(samples[k] - near)) if test(k)), None)
    if first is None:
        return range(0)
    ends = []
    for false in (-1, len(samples)):
        true = first
        while abs(false - true) > 1:
            middle = (true + false) // 2
            if test(middle):
                true = middle
            else:
                false = middle
        ends.append(true)
    return range(ends[0], ends[1] + 1)

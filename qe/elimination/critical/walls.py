"""The walls of a convex truth set in the plane: which of many hypersurfaces its boundary lies in.

LEMMA. Let the boundary of T lie in the zeros of polynomials U and T in a closed box B. Then it lies in the zeros of
those of U that have a zero in B. (T is closed, so its boundary is in T and so in B.)

THEOREM. Let T be a closed bounded convex set of points (x, y) with interior points, (a, b) the interior of its
projection onto x, and let its boundary lie in the zeros of irreducible polynomials U. Let W be some of those with y,
and a = x_0 < ... < x_n = b contain all zeros in (a, b) of the members of U without y, and of the leading coefficient
(in y) and the discriminant of each f in W and its resultants with all others of U. If for some x in each
(x_k, x_k+1) the ends of the fibre of T over x are zeros of members of W and of no others of U, the boundary lies in the
zeros of W and of the members without y.
PROOF. The upper end u(x) of the fibre is continuous on (a, b). Where it is a zero of f in W over (x_k, x_k+1), that is
a simple zero, which is the graph of one function nearby, and no other member of U vanishes there, so u is
that function nearby: such x are an open set, also a closed one, and there is one. The lower end is alike. What is left
of the boundary lies over finitely many x: its segments lie in the zeros of members without y, and its other points are
limits of those found.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from qe.convex.optimum import exact, maximize, minimize
from qe.decomposition.interval import Number
from qe.elimination.critical.open_cells import Holds, Values, true_run
from qe.elimination.critical.system import System
from qe.errors import BudgetExceeded, Unable
from qe.exact.algebraic import real_roots
from qe.exact.fibre_stack import isolate_over
from qe.exact.nearby import rational_between, without_zeros
from qe.exact.number import rational_ends
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.options import Budget

FEW = 12
"""So many hypersurfaces are explored by all their open cells."""
HALVINGS = 8
"""How often a box is halved before a polynomial counts as one with zeros in it."""
BITS = 64

Box = tuple[tuple[Number, Number], ...]


@dataclass(frozen=True, slots=True)
class Walls:
    """``polys``: polynomials whose zeros contain the boundary; ``inside``: interior points (none: there are none)."""

    polys: frozenset[Poly]
    inside: tuple[Values, ...]
    decided: int


def box_around(system: System, budget: Budget) -> Box | None:
    """The smallest box around the parameters for which a convex system holds, by exact convex optimisation; None where
    there is none or none is proved. Raises ``BudgetExceeded``."""
    try:
        return tuple(_range(system.ring.gen(i), system, budget) for i in range(system.free))
    except BudgetExceeded:
        raise
    except Unable:
        return None


def _range(variable: Poly, system: System, budget: Budget) -> tuple[Number, Number]:
    values = [find(variable, system.formula, budget=budget).value for find in (minimize, maximize)]
    if values[0] is None or values[1] is None:
        raise Unable("critical-value elimination: no box around the truth set")
    return exact(values[0]), exact(values[1])


def walls_in_plane(surfaces: frozenset[Poly], box: Box, holds: Holds, origin: Point, budget: Budget) -> Walls:
    """The walls of a convex set whose boundary lies in the zeros of ``surfaces`` and whose smallest box is ``box``.

    ``holds``: membership of rational points. Polynomials are taken into W (see above) until it is large enough.
    Raises ``BudgetExceeded``.
    """
    (left, right) = box[0]
    outer = tuple((rational_ends(low, BITS)[0], rational_ends(high, BITS)[1]) for low, high in box)
    near = [f for f in surfaces if not _misses(f, outer, HALVINGS)]
    upright, others = [f for f in near if not f.level], tuple(f for f in near if f.level)
    seen: dict[Fraction, Fibre] = {}
    walls: frozenset[Poly] = frozenset()
    middle = sum(outer[1], Fraction(0)) / 2
    while left < right:
        for x in _between(left, right, _turns(upright, walls, others)):
            if x not in seen:
                budget.check("walls", len(seen))
                seen[x] = fibre_over(x, others, holds, origin, middle)
        if not all(fibre.inside for fibre in seen.values()):
            break  # no fibre has interior points
        found = frozenset().union(*(fibre.ends for fibre in seen.values()))
        if found == walls:
            inside = [(x, y) for x, fibre in sorted(seen.items()) for y in fibre.inside]
            return Walls(walls.union(upright), tuple(inside), len(seen))
        walls = found
    return Walls(frozenset(), (), len(seen))


@dataclass(frozen=True, slots=True)
class Fibre:
    """What a convex set has over a rational x: rational points inside, and the polynomials that vanish at its ends."""

    inside: tuple[Fraction, ...]
    ends: frozenset[Poly]


def fibre_over(x: Fraction, polys: tuple[Poly, ...], holds: Holds, origin: Point, near: Fraction) -> Fibre:
    """The fibre over x; ``polys``: all that may vanish at its ends; ``near``: where it is looked for first."""
    stack = isolate_over(Point.of(origin.ring, [x]), polys)
    run = true_run(stack.samples, near, lambda k: holds((x, stack.samples[k])))
    ends = [stack.sections[k] for k in (run.start - 1, run.stop - 1) if run and 0 <= k < len(stack.sections)]
    return Fibre(stack.samples[run.start : run.stop], frozenset(polys[j] for end in ends for j in end.members))


def _turns(upright: Sequence[Poly], walls: frozenset[Poly], others: Sequence[Poly]) -> Iterator[Poly]:
    """Polynomials in x whose zeros are those the theorem names."""
    yield from upright
    for f in walls:
        yield f.leading(1)
        yield f.discriminant(1)
        yield from (f.resultant(g, 1) for g in others if g != f)


def _between(left: Number, right: Number, polys: Iterable[Poly]) -> list[Fraction]:
    """A rational number in each part into which zeros of the polynomials divide the interval from left to right."""
    factors = {f for p in polys for f, _ in p.factors()[1] if f.level == 0}
    roots = {root for f in factors for root in real_roots(f.to_univariate(0)) if left < root < right}
    ends = [left, *sorted(roots), right]
    return [rational_between(a, b) for a, b in pairwise(ends)]


def _misses(f: Poly, box: tuple[tuple[Fraction, Fraction], ...], halvings: int) -> bool:
    """Whether it is seen that f has no zero in the box: by an enclosure of its values there, or in both halves."""
    if without_zeros((f,), box, BITS):
        return True
    if not halvings:
        return False
    k = max(f.variables, key=lambda i: box[i][1] - box[i][0])
    low, high = box[k]
    middle = (low + high) / 2
    return all(_misses(f, (*box[:k], side, *box[k + 1 :]), halvings - 1) for side in ((low, middle), (middle, high)))

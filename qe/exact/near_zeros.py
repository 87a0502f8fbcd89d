"""Common zeros of polynomials with many digits, by least squares from a start; their coordinates as algebraic numbers.

A step from u is the d with (J^T J + c*|p|^2) d = J^T p, J the matrix of derivatives (Levenberg 1944, Marquardt 1963):
also where zeros are not isolated it converges as Newton's method does (Yamashita, Fukushima 2001). Nothing is proved.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Sequence
from dataclasses import dataclass, field
from itertools import chain
from math import prod

from flint import arb, arb_mat

from qe.exact.balls import precision
from qe.exact.lattice_recognition import SCHEDULE, algebraic_candidate
from qe.exact.number import Number, simplest
from qe.exact.poly import Poly, SparseTerm

STEPS, TERMS_OF_A_CELL = 40, 10
"""Steps from a start, and terms that are evaluated in about the time of a cell."""

Point = list[arb]


@dataclass(frozen=True, slots=True)
class NearZeros:
    """``table``: for each polynomial its terms and those of its derivatives; ``spend`` is told of units of work."""

    table: list[list[list[SparseTerm]]]
    spend: Callable[[int], object]
    known: dict[tuple[int, int], tuple[Point, bool]] = field(default_factory=dict)

    @staticmethod
    def of(polys: Sequence[Poly], spend: Callable[[int], object]) -> NearZeros:
        """Those of these polynomials."""
        size = polys[0].ring.size
        return NearZeros([[q.sparse_terms() for q in (p, *map(p.derivative, range(size)))] for p in polys], spend)

    def coordinate(self, i: int, point: Point, longest: int) -> Number | None:
        """The i-th coordinate of the zero next to a point, if it is recognised in so many rounds of more digits."""

        def digits(bits: int) -> arb:
            known = self.known.get((id(point), bits)) or self.near(point, bits)
            self.known[id(point), bits] = known
            return known[0][i]

        numbers = (algebraic_candidate(digits, degree, bits) for degree, bits in SCHEDULE[:longest])
        return next((simplest(number) for number in numbers if number is not None), None)

    def near(
        self, start: Sequence[arb | float], bits: int, fixed: Container[int] = (), most: int = STEPS
    ) -> tuple[Point, bool]:
        """A point after so many steps at most, with some unknowns fixed; whether all are 0 there up to 2^-bits."""
        units = 1 + sum(map(len, chain(*self.table))) // TERMS_OF_A_CELL
        with precision(6 * bits + 64):
            point, damping, enough = [arb(x) for x in start], arb(1), arb(2) ** (-2 * bits)
            values, size = self._at(point)
            for _ in range(most):
                if size < enough:
                    break
                self.spend(units)
                slopes = arb_mat([[arb(0) if i in fixed else c for i, c in enumerate(row)] for _, *row in values])
                square = (slopes.transpose() * slopes).mid()
                for i in range(len(point)):
                    square[i, i] = square[i, i] + size * damping
                try:
                    step = square.mid().solve((slopes.transpose() * arb_mat([[p] for p, *_ in values])).mid())
                except ZeroDivisionError:
                    break
                moved = [(x - step[i, 0]).mid() for i, x in enumerate(point)]
                after, smaller = self._at(moved)
                if smaller < size:
                    point, values, size, damping = moved, after, smaller, damping / 8
                else:
                    damping = damping * 8
            return point, bool(size < enough)

    def _at(self, point: Point) -> tuple[list[Point], arb]:
        """The values of the table, and the sum of the squares of the polynomials."""
        values = [[value(terms, point) for terms in row] for row in self.table]
        return values, sum((row[0] * row[0] for row in values), arb(0)).mid()


def value(terms: Sequence[SparseTerm], point: Point) -> arb:
    """The middle of a sum of terms at a point."""
    return sum((prod((point[i] ** k for i, k in powers), start=arb(c)) for powers, c in terms), arb(0)).mid()

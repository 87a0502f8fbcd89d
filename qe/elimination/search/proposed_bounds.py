"""Bounds of linear forms by HiGHS in floats, where exact tableaus fill: what it says is made exact, or not believed.

What is overlooked here, strict bounds that touch among it, is for the exact look at a whole assignment to see.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from fractions import Fraction
from importlib.util import find_spec
from math import inf
from typing import SupportsInt

from qe.convex.exact_basis import proportions
from qe.convex.highs import FloatRows, Offers
from qe.elimination.search.linear_forms import Direction, Monomial
from qe.exact.linear_bounds import Bound, Bounds, Term
from qe.exact.sparse_solve import solve_sparse, whole_multiples

_APART = 1e-6
"""How far from its bound a form is looked for where that is strict, in proportion."""

_PATIENCE = 256
"""Bounds that are told before floats look at them, at most."""

_TINY = 1e-9
"""Multipliers that count as zero, and how near a bound a form lies on it."""


class ProposedBounds(Bounds):
    """The same as ``FormBounds`` where no square is among the monomials: each form is a row."""

    def __init__(self, seconds: float | None = None) -> None:
        super().__init__()
        self.seconds = seconds
        self.monomials: dict[Monomial, int] = {}
        self.forms: dict[Direction, int] = {}
        self._rows: list[dict[int, int]] = []
        self._floats: FloatRows | None = None
        self._patience, self._waiting = 1, 0
        self._offered: Offers | None = None

    def of(self, direction: Direction) -> int:
        """The row of a form; all of them before the first bound."""
        known = self.forms.get(direction)
        if known is None:
            known = self.forms[direction] = len(self._rows)
            self._rows.append({self.monomials.setdefault(m, len(self.monomials)): c for m, c in direction})
        return known

    def conflict(self, check: Callable[[], object], *, now: bool = True) -> set[Hashable] | None:
        """Reasons of bounds that cannot hold together; None where floats do not see any, or see what is none.

        Otherwise than ``now`` it may wait for more bounds, for the longer the more often there was none that is exact.
        """
        check()
        program = self._program()
        self._waiting += 1
        if not now and self._waiting < self._patience:
            return None
        before, self._waiting = program.values, 0
        ray = program.contradiction()
        self.stuck = [] if ray is None else self._exact({i: w for i, w in ray.items() if abs(w) > _TINY})
        if self.stuck:
            self._patience = max(1, self._patience // 4)
        elif ray is not None or program.values is not before:  # what is not believed once comes again
            self._patience = min(2 * self._patience, _PATIENCE)
        return {reason for *_, reason in self.stuck} or None

    def side(self, x: int, bound: Fraction) -> int:
        """The sign of x - bound at the present point, in floats."""
        gap = self._program().values[x] - _float(bound.numerator, bound.denominator)
        return 0 if abs(gap) <= _TINY else 1 if gap > 0 else -1

    def offer(self, literals: Iterable[tuple[int, int, Fraction, bool, bool]]) -> None:
        """Literals that say of a row that it is at most (True) or at least a number, or (True) beyond it."""
        self._offered = Offers(
            [(i, x, _float(p.numerator, p.denominator), up, strict) for i, x, p, up, strict in literals]
        )

    def changes(self) -> list[int]:
        """The literals offered that hold at the present point and did not when this was asked last."""
        return [] if self._offered is None else self._offered.changes(self._program().values)

    def values_of_monomials(self) -> dict[Monomial, Fraction]:
        """Where floats see all bounds kept."""
        point = self._program().point
        return {m: Fraction(point[j]) for m, j in self.monomials.items()}

    # --- steps -------------------------------------------------------------------------------------------
    def _program(self) -> FloatRows:
        if self._floats is None:
            self._floats = FloatRows(len(self.monomials), self._rows, self.seconds)
        return self._floats

    def _rebound(self, bounds: dict[int, Bound], x: int) -> None:
        known, program = bounds.get(x), self._program()
        number = (inf if bounds is self.upper else -inf) if known is None else _float(known[0][0].p, known[0][0].q)
        if known is not None and known[0][1]:
            number += float(int(known[0][1].p)) * _APART * max(1.0, abs(number))
        (program.upper if bounds is self.upper else program.lower)[x] = number

    def _exact(self, ray: Mapping[int, float]) -> list[Term]:
        """Multiples of the bounds of these rows, about so large, that contradict each other; none where they do not."""
        weights = proportions(ray)
        if not self._cancels(weights):
            first, *support = ray or (0,)
            columns: dict[int, dict[int, int]] = {}
            for i in support:
                for j, c in self._rows[i].items():
                    columns.setdefault(j, {})[i] = c
            right = self._rows[first]
            solved = solve_sparse(columns.values(), [-right.get(j, 0) for j in columns])
            weights = whole_multiples({first: Fraction(1), **(solved or {})})
            if not self._cancels(weights):
                return []
        return self.contradicted(weights) or self.contradicted({i: -w for i, w in weights.items()})

    def _cancels(self, weights: Mapping[int, int]) -> bool:
        """Whether these multiples of the rows, not none of them, add up to zero."""
        sums: dict[int, int] = {}
        for i, w in weights.items():
            for j, c in self._rows[i].items():
                sums[j] = sums.get(j, 0) + w * c
        return bool(weights) and not any(sums.values())


def _float(p: SupportsInt, q: SupportsInt) -> float:
    """The float nearest to p/q, infinite where there is none."""
    try:
        return int(p) / int(q)
    except OverflowError:
        return inf if int(p) > 0 else -inf


def suits(directions: Iterable[Direction]) -> bool:
    """Whether floats hold the numbers in these forms, and HiGHS is there."""
    return all(abs(c) < 1 << 40 for direction in directions for _, c in direction) and find_spec("highspy") is not None

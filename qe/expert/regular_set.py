"""Whether a set of one or two parameters is the closure of its interior, seen from its cell table.

THEOREM. In a decomposition of the line or plane, sign-invariant for the polynomials of a formula, let the formula be
true on a cell that is not open iff it is true on an open cell whose closure meets it. If this closure then contains the
cell, the formula's set is the closure of its interior. In the plane:
* A section over an interval lies in the closures of the sectors next to it, and meets those of no others.
* Let a be a section of the line, y_0 < y_1 < ... samples of the sectors over it, and l < a < r such that no factor of
  these stacks vanishes on [l, r] x {y_i}; let l and r lie in the intervals next to a. Then a sector over a lies in the
  closures of the sectors at (l, y_i) and (r, y_i), and meets those of no others: its factors do not vanish on it, so
  near it each side of a is in one sector. A section over a between y_i and y_j is the only root there of the factors
  over a; the sections left of a that lie between y_i and y_j at l do so up to a, and have limits there that are roots.
  So it is in the closures of the sectors from (l, y_i) to (l, y_j), and of those from (r, y_i) to (r, y_j), and no
  others. A sector's place in its stack is the number of real roots below.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Poly
from qe.kernel.arithmetic.sturm import count_real_roots, count_roots_between, exact, sign_of
from qe.kernel.step import Limits
from qe.proof.cells import Cell, CellTable, Stack

MOST_HALVINGS = 400
"""How often an interval around a section is halved at most."""


def check_regular(table: CellTable, limits: Limits, path: str) -> None:
    """``CertificateRejected`` unless the theorem applies to the table, whose cells have been checked."""
    if len(table.order) > 2 or table.root.stack is None or any(table.constraints) or not table.is_decomposition:
        raise CertificateRejected(path, "expected a decomposition of the line or the plane")
    if len(table.order) == 1:
        _check_sections(table.root, path)
        return
    first = table.root.stack
    for cell in first.cells[::2]:
        _check_sections(cell, path)
    for k in range(len(first.sections)):
        limits.tick()
        _Section(table, first, k, limits, path).check()


def _check_sections(cell: Cell, path: str) -> None:
    truths = _truths(cell, path)
    for left, section, right in zip(truths[::2], truths[1::2], truths[2::2], strict=False):
        if section is not (left or right):
            raise CertificateRejected(path, "not the closure of its interior")


class _Section:
    """A section of the first stack, and the cells over it and next to it."""

    def __init__(self, table: CellTable, first: Stack, k: int, limits: Limits, path: str) -> None:
        self.factors, self.limits, self.path = table.factors, limits, path
        self.left, self.over, self.right = first.cells[2 * k : 2 * k + 3]
        self.low, self.high = first.sectors[k], first.sectors[k + 1]
        self.members = [table.factors[0][j] for j in first.sections[k]]
        if any(not set(_used(side)) <= set(_used(self.over)) for side in (self.left, self.right)):
            raise CertificateRejected(path, "a stack over a section has fewer factors than its neighbours")

    def check(self) -> None:
        """Each cell over the section is true iff an open cell beside it is."""
        samples = self.over.stack.sectors if self.over.stack is not None else (Fraction(0),)
        self._narrow(samples)
        sides = ((self.left, self.low), (self.right, self.high))
        beside = [_Side(cell, at, self.factors[1], samples, self.path) for cell, at in sides]
        truths = _truths(self.over, self.path)
        for i in range(len(samples)):
            if truths[2 * i] is not any(side.between(i, i) for side in beside):
                raise CertificateRejected(self.path, "not the closure of its interior over a section")
            if i and truths[2 * i - 1] is not any(side.between(i - 1, i) for side in beside):
                raise CertificateRejected(self.path, "not the closure of its interior at a point")

    def _narrow(self, samples: Sequence[Fraction]) -> None:
        """Halve the interval around the section until no factor vanishes on it at the heights of the samples."""
        used = [self.factors[1][j] for j in _used(self.over)]
        lines = [f.at_rational(1, y).to_univariate(0) for y in samples for f in used]
        root = self.members[0].to_univariate(0)
        below, above = (sign_of(root(exact(end))) for end in (self.low, self.high))
        if below * above >= 0:
            raise CertificateRejected(self.path, "no sign changes at a section")
        for _ in range(MOST_HALVINGS):
            self.limits.tick()
            lines = [p for p in lines if vanishes_on(p, self.low, self.high, self.limits.tick)]
            if not lines:
                return
            middle = (self.low + self.high) / 2
            sign = sign_of(root(exact(middle)))
            if not sign:
                self.low, self.high = (self.low + middle) / 2, (self.high + middle) / 2
            elif sign == below:
                self.low = middle
            else:
                self.high = middle
        raise Unable("an interval around a section cannot be made narrow enough")


class _Side:
    """The stack over a point beside a section: where the samples lie in it."""

    def __init__(
        self, cell: Cell, at: Fraction, factors: Sequence[Poly], samples: Sequence[Fraction], path: str
    ) -> None:
        self.truths = _truths(cell, path)
        polys = [factors[j].at_rational(0, at).to_univariate(1) for j in _used(cell)]
        if 2 * sum(map(count_real_roots, polys)) + 1 != len(self.truths):
            raise CertificateRejected(path, "a stack with another number of sections at a point of its interval")
        self.places = [sum(count_roots_below(p, y) for p in polys) for y in samples]

    def between(self, i: int, j: int) -> bool:
        """Whether one of the sectors from that of sample i to that of sample j is true."""
        return any(self.truths[2 * self.places[i] : 2 * self.places[j] + 1 : 2])


def _used(cell: Cell) -> tuple[int, ...]:
    return () if cell.stack is None else cell.stack.used


def _truths(cell: Cell, path: str) -> list[bool]:
    """The truth on the cells of a stack; on the whole line over a cell without one."""
    found = [c.truth for c in ((cell,) if cell.stack is None else cell.stack.cells)]
    known = [truth for truth in found if truth is not None]
    if len(known) < len(found):
        raise CertificateRejected(path, "a cell without a truth value")
    return known


def count_roots_below(p: Any, y: Fraction) -> int:
    """The number of distinct real roots of a nonzero polynomial less than y, which is none."""
    if p.degree() < 1:
        return 0
    bound = Fraction(-2 - max(abs(int(c)) for c in p.coeffs()) // abs(int(p.leading_coefficient())))  # Cauchy
    return count_roots_between(p, bound, y) if bound < y else 0


def vanishes_on(p: Any, low: Fraction, high: Fraction, check: Callable[[], None]) -> bool:
    """Whether a polynomial has a root in [low, high]."""
    if any(not p(exact(end)) for end in (low, high)):
        return True
    return p.degree() > 0 and count_roots_between(p, low, high, check) > 0

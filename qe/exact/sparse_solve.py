"""Sparse systems of linear equations over Q: short pivots are eliminated by hand, what is dense then goes to FLINT.

A pivot of a row with r entries whose column has c makes at most (r - 1)(c - 1) new ones (Markowitz 1957). The dense
rest is solved by p-adic lifting (Dixon 1982), which costs little more than its answer is long.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from heapq import heapify, heappop, heappush
from math import gcd, lcm

from flint import fmpq, fmpz_mat, nmod_mat

from qe.exact.poly import T

_FILL = 24
"""New entries that a pivot may make by hand."""

_BITS = 200
"""Rows with longer numbers are left to FLINT."""

_DENSE = 2000
"""Unknowns of the dense rest, at most."""

_PRIME = (1 << 61) - 1


def solve_sparse(rows: Iterable[Mapping[int, int]], right: Iterable[int]) -> dict[int, Fraction] | None:
    """The unknowns x_j with sum rows[i][j] * x_j = right[i] for all i, which may be more than there are unknowns.

    None where there is no solution or more than one, or where the dense rest is too large. The solution satisfies as
    many independent equations as there are unknowns; that it satisfies the others is for the caller to see.
    """
    work = _Elimination(rows, right)
    if not work.eliminate():
        return None
    values = work.dense_part()
    if values is None:
        return None
    for row, j in reversed(work.pivots):
        total = fmpq(row[_RIGHT]) if _RIGHT in row else _ZERO
        for k, c in row.items():
            if k not in (j, _RIGHT):
                total -= values[k] * c
        values[j] = total / row[j]
    return {j: Fraction(int(v.p), int(v.q)) for j, v in values.items()}


def whole_multiples(values: Mapping[T, Fraction]) -> dict[T, int]:
    """The values times the least number that makes all of them whole."""
    scale = lcm(*(v.denominator for v in values.values()))
    return {key: v.numerator * (scale // v.denominator) for key, v in values.items()}


_RIGHT = -1  # the column of the right side
_ZERO = fmpq(0)


class _Elimination:
    def __init__(self, rows: Iterable[Mapping[int, int]], right: Iterable[int]) -> None:
        self.rows: dict[int, dict[int, int]] = {}
        self.using: dict[int, set[int]] = {}
        self.pivots: list[tuple[dict[int, int], int]] = []
        for r, (row, b) in enumerate(zip(rows, right, strict=True)):
            self.rows[r] = {**row, _RIGHT: b} if b else dict(row)
            for j in row:
                self.using.setdefault(j, set()).add(r)

    def eliminate(self) -> bool:
        """Take all pivots that make few new entries; whether no contradiction was met."""
        waiting = [(len(row), r) for r, row in self.rows.items()]
        heapify(waiting)
        while waiting:
            size, r = heappop(waiting)
            row = self.rows.get(r)
            if row is None or len(row) != size:
                continue
            unknowns = [j for j in row if j != _RIGHT]
            if not unknowns:
                if row:
                    return False
                del self.rows[r]
                continue
            j = min(unknowns, key=lambda j: (len(self.using[j]), abs(row[j]), j))
            if (len(unknowns) - 1) * (len(self.using[j]) - 1) > _FILL or max(
                map(abs, row.values())
            ).bit_length() > _BITS:
                continue
            for other in self._pivot(r, j):
                heappush(waiting, (len(self.rows[other]), other))
        return True

    def dense_part(self) -> dict[int, fmpq] | None:
        """What the rows that are left say about their unknowns."""
        left_over = list(self.rows.values())
        unknowns = sorted({j for row in left_over for j in row if j != _RIGHT})
        if len(unknowns) + len(self.pivots) != len(self.using) or not len(unknowns) <= min(len(left_over), _DENSE):
            return None
        if not unknowns:
            return {}
        table = [[row.get(j, 0) for j in unknowns] for row in left_over]
        if len(table) > len(unknowns):
            chosen = _independent(table)
            table, left_over = [table[i] for i in chosen], [left_over[i] for i in chosen]
        if len(table) < len(unknowns):
            return None
        try:
            solved = fmpz_mat(table).solve(fmpz_mat([[row.get(_RIGHT, 0)] for row in left_over]))
        except ZeroDivisionError:
            return None
        return {j: solved[i, 0] for i, j in enumerate(unknowns)}

    def _pivot(self, r: int, j: int) -> list[int]:
        """Solve row r for unknown j; the rows that changed by it."""
        pivot = self.rows.pop(r)
        lead = pivot[j]
        for k in pivot:
            if k != _RIGHT:
                self.using[k].discard(r)
        changed = sorted(self.using[j])
        for other in changed:
            row = self.rows[other]
            common = gcd(lead, row[j]) * (1 if lead > 0 else -1)  # rows that need no multiple stay as they are
            scale, factor = lead // common, row[j] // common
            if scale != 1:
                row = {k: scale * c for k, c in row.items()}
            for k, c in pivot.items():
                value = row.get(k, 0) - factor * c
                if value:
                    if k not in row and k != _RIGHT:
                        self.using[k].add(other)
                    row[k] = value
                elif k in row:
                    del row[k]
                    if k != _RIGHT:
                        self.using[k].discard(other)
            content = gcd(*row.values()) if scale != 1 else 1
            self.rows[other] = {k: c // content for k, c in row.items()} if content > 1 else row
        self.pivots.append((pivot, j))
        return changed


def _independent(table: Sequence[Sequence[int]]) -> list[int]:
    """Rows that are independent, modulo a prime: the pivot columns of the transposed table."""
    reduced, rank = nmod_mat(
        len(table[0]), len(table), [c % _PRIME for line in zip(*table) for c in line], _PRIME
    ).rref()
    pivots, start = [], 0
    for i in range(rank):
        start = next(j for j in range(start, len(table)) if int(reduced[i, j]))
        pivots.append(start)
    return pivots

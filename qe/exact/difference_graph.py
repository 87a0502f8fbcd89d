"""Bounds of differences of variables: all that follows from them, kept while bounds come and go.

THEOREM (Bellman 1958). Bounds x_v - x_u <= w, as edges from u to v of length w, can hold together iff no cycle of edges
has negative length; they imply x_v - x_u <= d iff some path from u to v is no longer than d. The lengths of all
shortest paths are kept: a further edge changes those only that become shorter through it.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Hashable
from typing import Any, NamedTuple

import numpy as np

_NEVER = -1


class Change(NamedTuple):
    """What an edge made shorter: the pairs of vertices, their lengths before, and the changes that these came from,
    counted through all edges. ``first``: how many changes there were before."""

    starts: Any
    ends: Any
    lengths: Any
    since: Any
    first: int


class DifferenceGraph:
    """``size`` vertices. ``far``, longer than all edges together, is the length where there is no path."""

    def __init__(self, size: int, far: int) -> None:
        self.far = far
        self.edges: list[tuple[int, int, int, Hashable]] = []
        self.length = np.full((size, size), far, dtype=np.int64 if far < 1 << 60 else object)
        np.fill_diagonal(self.length, 0)
        self._since = np.full((size, size), _NEVER)
        self._changes: list[Change] = []
        self._firsts: list[int] = []

    def add(self, u: int, v: int, length: int, reason: Hashable) -> list[Hashable] | Change | None:
        """A further edge: reasons of a cycle of negative length that it closes (it is left out then), or what it
        brings nearer, if anything."""
        lengths = self.length
        if lengths[u, v] <= length:
            return None
        if lengths[v, u] + length < 0:
            return [reason, *self.reasons(v, u)]
        far, to_u, from_v = self.far, lengths[:, u], lengths[v]
        (starts,) = np.nonzero((to_u < far) & (to_u + length < lengths[:, v]))
        (ends,) = np.nonzero((from_v < far) & (from_v + length < lengths[u]))
        block = np.ix_(starts, ends)
        now, before = (to_u[starts] + length)[:, None] + from_v[ends], lengths[block]
        rows, columns = np.nonzero(now < before)
        pairs = starts[rows], ends[columns]
        first = self._firsts[-1] + len(self._changes[-1].starts) if self._changes else 0
        change = Change(*pairs, before[rows, columns], self._since[pairs], first)
        lengths[pairs], self._since[pairs] = now[rows, columns], np.arange(first, first + len(rows))
        self.edges.append((u, v, length, reason))
        self._changes.append(change)
        self._firsts.append(first)
        return change

    def keep(self, count: int) -> None:
        """Go back to the first so many edges."""
        for change in reversed(self._changes[count:]):
            pairs = change.starts, change.ends
            self.length[pairs], self._since[pairs] = change.lengths, change.since
        del self._changes[count:], self._firsts[count:], self.edges[count:]

    def reasons(self, u: int, v: int, edges: int | None = None) -> list[Hashable]:
        """Those of the edges on a shortest path; ``edges``: among the first so many."""
        reasons: list[Hashable] = []
        pending = [(u, v, len(self.edges) if edges is None else edges)]
        while pending:
            x, y, limit = pending.pop()
            if x == y:
                continue
            number, since = limit, int(self._since[x, y])
            while number >= limit:
                at, number = since, bisect_right(self._firsts, since) - 1
                assert number >= 0
                since = int(self._changes[number].since[at - self._firsts[number]])
            start, end, _, reason = self.edges[number]
            reasons.append(reason)
            pending += [(x, start, number), (end, y, number)]
        return reasons

    def potentials(self) -> list[int]:
        """Values of the variables that keep all bounds: how far each is from the nearest vertex."""
        return [int(least) for least in self.length.min(axis=0)]

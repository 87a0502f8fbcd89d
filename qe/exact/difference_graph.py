"""Bounds of differences of variables: all that follows from them, kept while bounds come and go.

THEOREM (Bellman 1958). Bounds x_v - x_u <= w, as edges from u to v of length w, can hold together iff no cycle of edges
has negative length; they imply x_v - x_u <= d iff some path from u to v is no longer than d. The lengths of all
shortest paths are kept: a further edge changes those only that become shorter through it.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator

Since = tuple[int, "Since | None"]
"""The last edge of those that made a path shorter, and what that was before."""


class DifferenceGraph:
    """``size`` vertices. ``far``, longer than all edges together, is the length where there is no path."""

    def __init__(self, size: int, far: int) -> None:
        self.far = far
        self.edges: list[tuple[int, int, int, Hashable]] = []
        self.length = [[0 if u == v else far for v in range(size)] for u in range(size)]
        self._since: list[list[Since | None]] = [[None] * size for _ in range(size)]
        self._changed: list[tuple[int, int, int, Since | None]] = []
        self._marks: list[int] = []

    def add(self, u: int, v: int, length: int, reason: Hashable) -> list[Hashable] | Iterator[tuple[int, int, int]]:
        """A further edge: reasons of a cycle of negative length that it closes (it is left out then), or the pairs of
        vertices that it brings nearer with the lengths before."""
        lengths, at_v = self.length, self.length[v]
        if lengths[u][v] <= length:
            return iter(())
        if at_v[u] + length < 0:
            return [reason, *self.reasons(v, u)]
        number, first = len(self.edges), len(self._changed)
        self.edges.append((u, v, length, reason))
        self._marks.append(first)
        far = self.far
        targets = [
            (y, more) for y, (more, now) in enumerate(zip(at_v, lengths[u])) if more < far and length + more < now
        ]
        for x, row in enumerate(lengths):
            start = row[u] + length
            if row[u] >= far or start >= row[v]:
                continue
            since = self._since[x]
            for y, more in targets:
                old = row[y]
                if start + more < old:
                    self._changed.append((x, y, old, since[y]))
                    row[y], since[y] = start + more, (number, since[y])
        return ((x, y, old) for x, y, old, _ in self._changed[first:])

    def keep(self, count: int) -> None:
        """Go back to the first so many edges."""
        if count >= len(self.edges):
            return
        first = self._marks[count]
        for x, y, length, since in reversed(self._changed[first:]):
            self.length[x][y], self._since[x][y] = length, since
        del self._changed[first:], self._marks[count:], self.edges[count:]

    def reasons(self, u: int, v: int, edges: int | None = None) -> list[Hashable]:
        """Those of the edges on a shortest path; ``edges``: among the first so many."""
        reasons: list[Hashable] = []
        pending = [(u, v, len(self.edges) if edges is None else edges)]
        while pending:
            x, y, limit = pending.pop()
            if x == y:
                continue
            since = self._since[x][y]
            while since is not None and since[0] >= limit:
                since = since[1]
            assert since is not None
            start, end, _, reason = self.edges[since[0]]
            reasons.append(reason)
            pending += [(x, start, since[0]), (end, y, since[0])]
        return reasons

    def potentials(self) -> list[int]:
        """Values of the variables that keep all bounds: how far each is from the nearest vertex."""
        return [min(column) for column in zip(*self.length)]

"""The closed surface of a region in space as triangles, block by block. Floating point, for looking only.

A full-dimensional piece of the cylindrical description is a block: it lies between two sheets over a cell of the
plane, and that cell between two curves over an interval. Its surface has six sides (two sheets, four walls), some of
which may have shrunk to a line or a point. The sides are taken from one lattice of points, so that every edge
belongs to exactly two triangles. Pieces of lower dimension are single sheets, curves and points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from qe.decomposition.pieces import Piece
from qe.regions.ends import Span, ends

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

FINEST, COARSEST = 44, 8
"""Samples in x and y along one piece: of a single piece, and of one among very many."""
ROWS = 14
"""Samples in z along a wall; a wall is straight in z, more rows only help to sort its triangles by depth."""
INSIDE = 1e-7
"""The share of a range left out at its ends, where the roots above may coincide or vanish."""
SHIFT, SLACK = 2e-6, 3e-2
"""How far outside a wall its neighbours are looked for, and how far their ends may differ: shares of the size."""


@dataclass(frozen=True, slots=True)
class Surface:
    """Triangles with ``vertices`` (n, 3) and ``faces`` (m, 3), of blocks counter-clockwise seen from outside.

    ``side`` (m,): the number of the block's side (smooth in itself; 0 and 1 are the sheets above and below).
    ``inner`` (m,): lies between two blocks, so that nobody sees it. ``solid``: bounds a block.
    """

    vertices: Array
    faces: Indices
    side: Indices
    inner: NDArray[np.bool_]
    solid: bool

    @property
    def volume(self) -> float:
        """The enclosed volume of a block, by the divergence theorem."""
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        return float((a * np.cross(b, c)).sum() / 6)


@dataclass(frozen=True, slots=True)
class Solid:
    """A region in space: closed surfaces of its blocks and its free sheets, curves (k, 3) and points (1, 3)."""

    surfaces: tuple[Surface, ...]
    lines: tuple[Array, ...]

    @property
    def blocks(self) -> tuple[Surface, ...]:
        """The closed surfaces."""
        return tuple(s for s in self.surfaces if s.solid)

    def corners(self) -> tuple[Array, Array]:
        """The lowest and the highest coordinates; zeros for nothing."""
        parts = [s.vertices for s in self.surfaces] + list(self.lines)
        points = np.concatenate(parts) if parts else np.zeros((1, 3))
        return points.min(axis=0), points.max(axis=0)


def solid(pieces: Sequence[Piece], spans: Sequence[Span]) -> Solid:
    """The surface of a region in three variables; ``spans`` replace the ends that a piece does not have."""
    full = [p for p in pieces if p.dimension == 3]
    count = max(COARSEST, round(FINEST / max(1, len(full)) ** 0.5))
    lattices = [_lattice(p, spans, (count, count, ROWS)) for p in full]
    size = _size(lattices)
    around = _Around(full, spans, size)
    surfaces = [_block(piece, lattice, around) for piece, lattice in zip(full, lattices, strict=True)]
    lines: list[Array] = []
    for piece in pieces:
        if piece.dimension == 3:
            continue
        points = _lattice(piece, spans, (count, count, ROWS))
        if around.touches(points):
            continue
        shape = tuple(n for n in points.shape[:3] if n > 1)
        flat = points.reshape(-1, 3)
        if len(shape) == 2:
            faces = _triangles(np.arange(len(flat)).reshape(shape))
            nowhere = np.zeros(len(faces), dtype=np.int64)
            surfaces.append(Surface(flat, faces, nowhere, nowhere > 0, False))
        else:
            lines.append(flat)
    return Solid(tuple(surfaces), tuple(lines))


def _size(lattices: Sequence[Array]) -> Array:
    if not lattices:
        return np.ones(3)
    points = np.concatenate([lattice.reshape(-1, 3) for lattice in lattices])
    return np.asarray(np.maximum(np.ptp(points, axis=0), 1e-9))


def _lattice(piece: Piece, spans: Sequence[Span], counts: tuple[int, int, int]) -> Array:
    """Points of a piece, evenly spread between its ends in each variable: an array (nx, ny, nz, 3)."""
    nx, ny, nz = (1 if r.is_point else n for r, n in zip(piece.ranges, counts, strict=True))
    points = np.empty((nx, ny, nz, 3))
    low, high = ends(piece, 0, {}, spans[0])
    for i, x in enumerate(spread(low, high, nx)):
        low, high = ends(piece, 1, {0: x}, spans[1])
        for j, y in enumerate(spread(low, high, ny)):
            bottom, top = ends(piece, 2, {0: x, 1: y}, spans[2])
            points[i, j, :, 0], points[i, j, :, 1] = x, y
            points[i, j, :, 2] = np.linspace(bottom, max(bottom, top), nz) if nz > 1 else bottom
    return points


def spread(low: float, high: float, count: int) -> Array:
    """Numbers from end to end, dense towards the ends; the ends themselves are left out by a hair."""
    if count == 1:
        return np.array([low])
    share = INSIDE + (1 - 2 * INSIDE) * (1 - np.cos(np.linspace(0, np.pi, count))) / 2
    return np.asarray(low + (max(low, high) - low) * share)


def _block(piece: Piece, points: Array, around: _Around) -> Surface:
    """The six sides of a lattice, with the triangles marked that lie between this block and another one."""
    ids = np.arange(points[..., 0].size).reshape(points.shape[:3])
    sides = [ids[:, :, -1], ids[:, :, 0].T, ids[-1], ids[0].T, ids[:, -1].T, ids[:, 0]]
    walls = [(points[-1], (1, 0)), (points[0], (-1, 0)), (points[:, -1], (0, 1)), (points[:, 0], (0, -1))]
    inner = [np.zeros(side[1:, 1:].shape, dtype=bool) for side in sides[:2]]
    for k, (wall, outwards) in enumerate(walls):
        covered = around.covered(piece, wall, outwards)
        inner.append(covered.T if k in (1, 2) else covered)  # sides 3 and 4 run along z first
    faces = np.concatenate([_triangles(side) for side in sides])
    flags = np.concatenate([np.tile(part.reshape(-1), 2) for part in inner])
    side = np.repeat(np.arange(6), [2 * part.size for part in inner])
    used, renamed = np.unique(faces, return_inverse=True)
    return Surface(points.reshape(-1, 3)[used], renamed.reshape(-1, 3), side, flags, True)


def _triangles(ids: Indices) -> Indices:
    """Two triangles for each square of a grid of vertices; the normal is (down the rows) x (along a row)."""
    a, b, c, d = (part.reshape(-1) for part in (ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]))
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


@dataclass(frozen=True, slots=True)
class _Around:
    """The blocks of a region, asked for what lies beside a point. ``size``: of the whole region."""

    pieces: Sequence[Piece]
    spans: Sequence[Span]
    size: Array

    def covered(self, own: Piece, wall: Array, outwards: tuple[int, int]) -> NDArray[np.bool_]:
        """For each square of a block's wall (columns, rows, 3) whether another block lies just outside it."""
        inside = np.zeros((len(wall), wall.shape[1] - 1), dtype=bool)
        slack = SLACK * self.size[2]
        others = [piece for piece in self.pieces if piece is not own]
        probes = wall.copy()
        probes[[0, -1]] = (wall[[0, -1]] + wall[[1, -2]]) / 2  # at its very ends a wall touches other walls
        for i, column in enumerate(probes if others else ()):
            x = float(column[0, 0] + outwards[0] * SHIFT * self.size[0])
            y = float(column[0, 1] + outwards[1] * SHIFT * self.size[1])
            for low, high in self._above(others, x, y):
                inside[i] |= (column[:-1, 2] >= low - slack) & (column[1:, 2] <= high + slack)
        return np.asarray(inside[1:] & inside[:-1])

    def touches(self, points: Array) -> bool:
        """Whether the middle of a sheet, a curve or a point lies on the border of a block."""
        x, y, z = points[tuple(n // 2 for n in points.shape[:3])]
        steps = 1e3 * SHIFT * self.size
        for across in (-1, 0, 1):
            for along in (-1, 0, 1):
                for low, high in self._above(self.pieces, float(x + across * steps[0]), float(y + along * steps[1])):
                    if low - steps[2] <= z <= high + steps[2]:
                        return True
        return False

    def _above(self, pieces: Sequence[Piece], x: float, y: float) -> list[Span]:
        """The intervals of z over a place that belong to blocks."""
        intervals = []
        for piece in pieces:
            low, high = ends(piece, 0, {}, self.spans[0])
            if low < x < high:
                low, high = ends(piece, 1, {0: x}, self.spans[1])
                if low < y < high:
                    intervals.append(ends(piece, 2, {0: x, 1: y}, self.spans[2]))
        return intervals

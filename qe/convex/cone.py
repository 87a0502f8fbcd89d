"""Polyhedral cones by what generates them, kept while half-spaces are added."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import gcd

Vector = tuple[int, ...]


class Cone:
    """All sums of multiples of ``lines`` and nonnegative multiples of ``rays``; at first the whole space.

    Motzkin, Raiffa, Thompson, Thrall 1953 (double description); two rays span a face iff no third one lies on all
    bounding hyperplanes that both lie on (Fukuda, Prodon 1996), which are at least as many as the face leaves
    dimensions.
    """

    def __init__(self, size: int) -> None:
        self.size = size
        self.lines: list[Vector] = [tuple(int(i == j) for j in range(size)) for i in range(size)]
        self.rays: dict[Vector, int] = {}  # with the bounding hyperplanes that they lie on, as bits
        self.count = 0

    def generators(self) -> Iterator[Vector]:
        """Vectors whose sums of nonnegative multiples are the cone."""
        yield from self.rays
        for line in self.lines:
            yield line
            yield tuple(-c for c in line)

    def cut(self, normal: Vector) -> None:
        """Keep what has normal.x <= 0."""
        bit = 1 << self.count
        self.count += 1
        line = next((v for v in self.lines if dot(normal, v)), None)
        if line is not None:
            lead = dot(normal, line)
            inward = line if lead < 0 else tuple(-c for c in line)
            depth = abs(lead)

            def moved(v: Vector) -> Vector:
                """Along the line, onto the hyperplane."""
                return combination(depth, v, dot(normal, v), inward)

            self.lines = [moved(v) for v in self.lines if v is not line]
            self.rays = {moved(v): bits | bit for v, bits in self.rays.items()} | {inward: bit - 1}
            return
        values = {v: dot(normal, v) for v in self.rays}
        inside = [(v, self.rays[v]) for v, value in values.items() if value < 0]
        outside = [(v, self.rays[v]) for v, value in values.items() if value > 0]
        kept = {v: bits if values[v] else bits | bit for v, bits in self.rays.items() if values[v] <= 0}
        masks, least = list(self.rays.values()), self.size - len(self.lines) - 2
        for u, at_u in outside:
            for v, at_v in inside:
                common = at_u & at_v
                if common.bit_count() >= least and sum(bits & common == common for bits in masks) == 2:
                    kept[combination(-values[v], u, values[u], v)] = common | bit
        self.rays = kept


def dot(u: Vector, v: Vector) -> int:
    """The sum of products."""
    return sum(a * b for a, b in zip(u, v))


def combination(a: int, u: Sequence[int], b: int, v: Sequence[int]) -> Vector:
    """a*u + b*v with coprime coordinates."""
    total = [a * p + b * q for p, q in zip(u, v)]
    content = gcd(*total) or 1
    return tuple(c // content for c in total)

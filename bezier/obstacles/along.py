"""Polynomials along a curve, ready for signs: f(P(t)) in Bernstein form up to a positive factor.

With p_k = C(n,k) P_k ("scaled" Bernstein coefficients) products of polynomials are plain convolutions, and a rational
curve can be scaled to integers, so that all work before the sign is integer arithmetic. Curves over a number field go
the same way with field elements.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from math import comb, lcm
from typing import Any

from bezier.curves.bernstein import Numbers
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import bounds
from bezier.obstacles.obstacle import Box, Constraint, Exponents
from qe.errors import InputError


class Along:
    """One curve, with its monomials x^i y^j z^k kept as they are needed; coordinates are integers over ``scale``."""

    __slots__ = ("_box", "_monomials", "coordinates", "curve", "scale")

    def __init__(self, curve: Bezier) -> None:
        if curve.dimension != 3:
            raise InputError(f"obstacles are in space: expected a curve of dimension 3, found {curve.dimension}")
        self.curve = curve
        values = [c for p in curve.points for c in p]
        known = [c for c in values if isinstance(c, Fraction)]
        rational = len(known) == len(values)
        self.scale = lcm(*(c.denominator for c in known)) if rational else 1
        n = curve.degree
        self.coordinates = tuple(
            tuple(_times(p[i], self.scale, rational) * comb(n, k) for k, p in enumerate(curve.points))
            for i in range(curve.dimension)
        )
        self._monomials: dict[Exponents, Numbers] = {(0, 0, 0): (1,)}
        self._box: Box | None = None

    @property
    def box(self) -> Box:
        """A rational axis-parallel box around the control points, hence around the curve."""
        if self._box is None:
            ends = [[bounds(p[i]) for p in self.curve.points] for i in range(self.curve.dimension)]
            low = tuple(min(e[0] for e in column) for column in ends)
            self._box = low, tuple(max(e[1] for e in column) for column in ends)
        return self._box

    def form(self, constraint: Constraint) -> Numbers:
        """A positive multiple of the Bernstein coefficients of f(P(t)), of degree n * deg f; integers if rational."""
        degree, n = constraint.degree, self.curve.degree
        common = lcm(*(c.denominator for _, c in constraint.terms)) if constraint.terms else 1
        total: list[Any] = [0] * (n * degree + 1)
        for exponents, coefficient in constraint.terms:
            missing = degree - sum(exponents)
            factor = int(coefficient * common) * self.scale**missing
            for k, c in enumerate(_convolved(self._monomial(exponents), _binomials(n * missing))):
                total[k] = total[k] + factor * c
        weights = _weights(n * degree)
        return tuple(c * w for c, w in zip(total, weights, strict=True))

    def _monomial(self, exponents: Exponents) -> Numbers:
        found = self._monomials.get(exponents)
        if found is None:
            axis = next(i for i, e in enumerate(exponents) if e)
            lower = tuple(e - (i == axis) for i, e in enumerate(exponents))
            found = _convolved(self._monomial(lower), self.coordinates[axis])
            self._monomials[exponents] = found
        return found


def _times(value: Any, scale: int, rational: bool) -> Any:
    return int(value * scale) if rational else value


def _convolved(a: Sequence[Any], b: Sequence[Any]) -> Numbers:
    if len(a) == 1 and isinstance(a[0], int):
        return tuple(b) if a[0] == 1 else tuple(a[0] * y for y in b)
    if len(b) == 1 and isinstance(b[0], int):
        return tuple(a) if b[0] == 1 else tuple(x * b[0] for x in a)
    out: list[Any] = [0] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            out[i + j] = out[i + j] + x * y
    return tuple(out)


@lru_cache(maxsize=64)
def _binomials(n: int) -> tuple[int, ...]:
    return tuple(comb(n, k) for k in range(n + 1))


@lru_cache(maxsize=64)
def _weights(n: int) -> tuple[int, ...]:
    """Integers proportional to 1 / C(n, k)."""
    row = _binomials(n)
    common = lcm(*row)
    return tuple(common // c for c in row)

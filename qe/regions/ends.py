"""Ends of the ranges of a cylindrical piece as floating-point numbers, for pictures."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import numpy

from qe.decomposition.pieces import Piece, RootFunction
from qe.exact.algebraic import real_roots
from qe.exact.ring import Poly

Span = tuple[float, float]

CLOSE = 1e-3
"""Roots nearer to each other than this, as a share of their size, are counted exactly."""


def ends(piece: Piece, i: int, values: Mapping[int, float], span: Span) -> Span:
    """Both ends of a piece's range number ``i`` over the earlier values; ``span`` replaces missing ones."""
    r = piece.ranges[i]
    thin = any(earlier.is_point for earlier in piece.ranges[:i])
    return _at(r.lower, values, span[0], thin), _at(r.upper, values, span[1], thin)


def _at(root: RootFunction | None, values: Mapping[int, float], fallback: float, thin: bool = False) -> float:
    """An approximate value of a root function; ``thin``: over a single value, where coinciding roots count once."""
    if root is None:
        return fallback
    if root.value is not None:
        return float(root.value)
    coefficients = [_value(terms, values) for terms in _coefficients(root.poly)]
    if len(coefficients) == 2:
        return -coefficients[0] / coefficients[1] if coefficients[1] else fallback
    if len(coefficients) == 3:
        c, b, a = coefficients
        if not a:
            return -c / b if b else fallback
        wide = max(b * b - 4 * a * c, 0.0) ** 0.5
        pair = sorted(((-b - wide) / (2 * a), (-b + wide) / (2 * a)))
        return float(pair[root.k - 1])
    roots = numpy.roots(coefficients[::-1])
    if not thin and _are_close(roots):
        poly = root.poly.at_rationals({i: Fraction(values[i]) for i in root.poly.variables[:-1]})
        exact = [] if poly.is_constant else [float(r) for r in real_roots(poly.to_univariate(poly.level))]
        return exact[min(root.k, len(exact)) - 1] if exact else fallback
    real: list[float] = sorted(float(z.real) for z in roots if abs(z.imag) < 1e-6 * max(1.0, abs(z)))
    if thin:
        real = [b for a, b in zip([-numpy.inf, *real], real, strict=False) if b - a > 1e-5 * max(1.0, abs(b))]
    return real[min(root.k, len(real)) - 1] if real else fallback


def _are_close(roots: numpy.ndarray[Any, Any]) -> bool:
    """Whether two roots are so near to each other that floating point may not tell whether they are real."""
    apart = numpy.abs(roots[:, None] - roots) + 9 * numpy.eye(len(roots)) * (1 + abs(roots))
    return bool((apart < CLOSE * (1 + numpy.abs(roots))).any())


@functools.lru_cache(maxsize=64)
def _coefficients(poly: Poly) -> list[list[tuple[tuple[int, ...], int]]]:
    """The terms of the coefficients by powers of the main variable: the same for all points of a line."""
    return [c.terms() for c in poly.coefficients(poly.level)]


def _value(terms: list[tuple[tuple[int, ...], int]], values: Mapping[int, float]) -> float:
    total = 0.0
    for exponents, c in terms:
        product = float(c)
        for i, e in enumerate(exponents):
            if e:
                product *= values[i] ** e
        total += product
    return total

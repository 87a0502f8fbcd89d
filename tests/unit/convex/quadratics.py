"""Quadratic forms written short."""

from collections.abc import Sequence
from fractions import Fraction

from qe.exact.quadratic_form import Quadratic


def ball(centre: Sequence[Fraction | int], square: Fraction | int) -> Quadratic:
    """|x - centre|^2 - square."""
    size = len(centre)
    at = [Fraction(c) for c in centre]
    hessian = tuple(tuple(Fraction(2 * (i == j)) for j in range(size)) for i in range(size))
    return Quadratic(hessian, tuple(-2 * c for c in at), sum((c * c for c in at), Fraction(0)) - square)


def line(*row: Fraction | int, constant: Fraction | int = 0) -> Quadratic:
    """row . x + constant."""
    nothing = ((Fraction(0),) * len(row),) * len(row)
    return Quadratic(nothing, tuple(Fraction(a) for a in row), Fraction(constant))


def diagonal(*squares: Fraction | int, slope: Sequence[Fraction | int] = (), constant: Fraction | int = 0) -> Quadratic:
    """sum squares_i x_i^2 + slope . x + constant."""
    size = len(squares)
    hessian = tuple(tuple(Fraction(2 * s if i == j else 0) for j in range(size)) for i, s in enumerate(squares))
    return Quadratic(hessian, tuple(Fraction(b) for b in slope or (0,) * size), Fraction(constant))

"""Exact numbers as points hold them: rational, or real algebraic."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction

from flint import fmpz, fmpz_poly

from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.algebraic_text import in_latex
from qe.services import SymPyForm
from qe.spelling import quoted

Number = Fraction | RealAlgebraic
Assignment = Mapping[str, Number]
Values = dict[str, Number]


class ExactPoint(dict[str, Number], SymPyForm):
    """Exact values by the names of variables: a ``dict`` that notebooks set as formulas."""

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {point_in_latex(self)}$"


def point_in_latex(point: Mapping[str, object]) -> str:
    """A point for math mode."""
    names = {n: re.sub(r"([_#$%&{}])", r"\\\1", n).replace("^", r"\char94 ").replace("~", r"\sim ") for n in point}
    return r",\ ".join(rf"\mathit{{{names[n]}}} = {in_latex(value)}" for n, value in point.items())


def optimum_in_latex(status: str, value: object, points: Sequence[Mapping[str, object]], *, near: bool = False) -> str:
    """An optimum as notebooks set it: its value (``near``: one close to it), or why there is none, and points that
    have it."""
    if value is None:
        return rf"$\text{{{status}}}$"
    at = r"\ \text{or}\ ".join(map(point_in_latex, points))
    where = rf"\quad\text{{at}}\quad {at}" if points else r"\quad\text{(not attained)}"
    about = r"\approx " if near else ""
    return rf"$\displaystyle {about}{in_latex(value)}{where}$"


def point_text(point: Mapping[str, object], between: str = ", ") -> str:
    """A point in one line: ``x = 1/2, y = sqrt(2)``, the names as the text syntax reads them."""
    return between.join(f"{quoted(name, point)} = {value}" for name, value in point.items())


def simplest(value: Number) -> Number:
    """A rational number as a Fraction, whatever its representation."""
    if isinstance(value, RealAlgebraic) and value.is_rational:
        return value.as_fraction()
    return value


def rational_ends(value: Number, bits: int) -> tuple[Fraction, Fraction]:
    """Rational numbers around a number, close together; the number itself, twice, where it is known to be rational."""
    return value.interval(bits) if isinstance(value, RealAlgebraic) else (value, value)


def whole_root(n: int, k: int) -> int:
    """The greatest whole number whose k-th power is at most n, for n >= 0."""
    return int(fmpz(n).root(k))


def square_root(value: Number) -> Number:
    """The square root of a number that is not negative.

    The roots of p(x^2) that are not negative are the roots of those of p, in the same order.
    """
    if value == 0:
        return Fraction(0)
    coefficients = (
        value.minimal_polynomial if isinstance(value, RealAlgebraic) else (-value.numerator, value.denominator)
    )
    spread = [c for pair in zip(coefficients, (0,) * len(coefficients), strict=True) for c in pair]
    squares, roots = ([r for r in real_roots(fmpz_poly(c)) if r > 0] for c in (list(coefficients), spread))
    return simplest(next(root for square, root in zip(squares, roots, strict=True) if square == value))

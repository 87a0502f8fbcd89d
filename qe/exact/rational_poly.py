"""Polynomials in one variable over Q, for pieces of trajectories: immutable values around FLINT's dense ones."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from flint import arb_poly, fmpq, fmpq_poly

from qe.exact.algebraic import RealAlgebraic, irreducible_factors, irreducible_roots
from qe.exact.balls import precision


class RationalPoly:
    """A polynomial with rational coefficients."""

    __slots__ = ("_poly",)
    _poly: fmpq_poly

    def __init__(self, poly: fmpq_poly) -> None:
        self._poly = poly

    @staticmethod
    def of(coefficients: Iterable[Fraction | int]) -> RationalPoly:
        """From the coefficients, the constant one first."""
        return RationalPoly(fmpq_poly([fmpq(c.numerator, c.denominator) for c in coefficients]))

    def __add__(self, other: RationalPoly) -> RationalPoly:
        return RationalPoly(self._poly + other._poly)

    def __sub__(self, other: RationalPoly) -> RationalPoly:
        return RationalPoly(self._poly - other._poly)

    def __mul__(self, other: RationalPoly) -> RationalPoly:
        return RationalPoly(self._poly * other._poly)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, RationalPoly) and bool(self._poly == other._poly)

    def __hash__(self) -> int:
        return hash(self.coefficients())

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return RationalPoly.of, (self.coefficients(),)

    def __repr__(self) -> str:
        return f"RationalPoly.of({[str(c) for c in self.coefficients()]})"

    def __call__(self, at: Fraction) -> Fraction:
        """The value at a rational number."""
        value = self._poly(fmpq(at.numerator, at.denominator))
        return Fraction(int(value.p), int(value.q))

    def compose(self, inner: RationalPoly) -> RationalPoly:
        """self(inner(u))."""
        return RationalPoly(self._poly(inner._poly))

    def derivative(self) -> RationalPoly:
        """The derivative."""
        return RationalPoly(self._poly.derivative())

    @property
    def degree(self) -> int:
        """The degree; -1 for 0."""
        return int(self._poly.degree())

    def coefficients(self) -> tuple[Fraction, ...]:
        """The coefficients, the constant one first; none for 0."""
        below = int(self._poly.denom())
        return tuple(Fraction(int(c), below) for c in self._poly.numer().coeffs())

    def floats(self) -> list[float]:
        """Floats within 2^-52 of the coefficients, as parts of them; infinite where they are too large."""
        with precision(160):
            return [float(c) for c in arb_poly(self._poly)]

    def roots(self, low: Fraction, high: Fraction) -> list[RealAlgebraic]:
        """The distinct roots strictly between two rational numbers, ascending; none for 0."""
        first, last = RealAlgebraic.rational(low), RealAlgebraic.rational(high)
        listed = (r for f, _ in irreducible_factors(self._poly.numer()) for r in irreducible_roots(f))
        return sorted(r for r in listed if first < r < last)


def largest_gap(
    rows: Sequence[Sequence[RationalPoly]], lengths: Sequence[Fraction]
) -> tuple[int, int, Fraction] | None:
    """Where p(length) of a row differs most from q(0) in the next row: the row, the column, and by how much; None where
    it never does."""
    best, place = fmpq(0), None
    for i, (length, before, after) in enumerate(zip(lengths, rows, rows[1:], strict=False)):
        at = fmpq(length.numerator, length.denominator)
        for k, (p, q) in enumerate(zip(before, after, strict=True)):
            gap = abs(p._poly(at) - q._poly[0])
            if gap > best:
                best, place = gap, (i, k)
    return None if place is None else (*place, Fraction(int(best.p), int(best.q)))

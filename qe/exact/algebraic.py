"""Real algebraic numbers: the k-th real root of an irreducible integer polynomial.

A number is its minimal polynomial (irreducible in Z[x], primitive, positive leading coefficient) and
the index of the root among the polynomial's real roots, ascending from 0; two numbers are equal iff both
agree. Rational numbers are the degree 1 case. The isolating interval and its refinements are a cache.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from operator import mul

from flint import arb, fmpq, fmpz_poly

from qe import arguments
from qe.arguments import shown
from qe.errors import InputError, Unable
from qe.exact.algebraic_text import format_root
from qe.exact.balls import FIRST_PRECISION, ball_sign, ends, hull, lower_end, precision, upper_end
from qe.exact.combined_roots import combined_polynomial, power_polynomial
from qe.exact.isolate import Interval, isolate, sign_at
from qe.exact.python_number import Operation, PythonNumber, exact, exact_operand

STALLED_BITS = 8
"""An enclosure that is right to so many bits and gets no better is held up by rounding, not by the polynomial."""

Rational = int | Fraction


class RealAlgebraic(PythonNumber):
    """A real algebraic number, with all that Python asks of a real number (``numbers.Real``).

    Arithmetic is exact with its kind and with rational numbers, ``Decimal`` included, and that of floats next to a
    float. Comparisons are exact, with floats too, as the numbers that they are.
    """

    __slots__ = ("_ball", "_bits", "_hi", "_lo", "index", "poly")
    poly: fmpz_poly
    index: int

    def __init__(self, poly: fmpz_poly, index: int, interval: Interval) -> None:
        self.poly, self.index = poly, index
        self._lo, self._hi = interval
        self._ball: arb | None = None
        self._bits = 0

    # --- construction ----------------------------------------------------------------------
    @staticmethod
    def rational(value: Rational | fmpq) -> RealAlgebraic:
        """A rational number."""
        if not isinstance(value, fmpq):
            exact = value if isinstance(value, int | Fraction) else arguments.rational(value, "value")
            value = fmpq(exact.numerator, exact.denominator)
        q = value
        return RealAlgebraic(fmpz_poly([-q.p, q.q]), 0, (q, q))

    @staticmethod
    def from_root(coefficients: Iterable[int], lo: Rational, hi: Rational) -> RealAlgebraic:
        """The only root of the polynomial (integer coefficients from degree 0 up) in the closed interval [lo, hi].

        Raises ``InputError`` unless there is exactly one (distinct) root there.
        """
        p = fmpz_poly(arguments.integers(coefficients, "coefficients"))
        if not p:
            raise InputError("coefficients: a polynomial other than 0 expected")
        low = RealAlgebraic.rational(arguments.rational(lo, "lo"))
        high = RealAlgebraic.rational(arguments.rational(hi, "hi"))
        inside = [r for r in real_roots(p) if low <= r <= high]
        if len(inside) != 1:
            raise InputError(f"{len(inside)} roots of the polynomial in [{shown(lo)}, {shown(hi)}], one expected")
        return inside[0]

    # --- access ----------------------------------------------------------------------------
    @staticmethod
    def by_index(coefficients: Iterable[int], index: int) -> RealAlgebraic:
        """The number with this ``minimal_polynomial`` and ``index``. Raises ``InputError`` where there is none."""
        p = fmpz_poly(arguments.integers(coefficients, "coefficients"))
        roots = irreducible_roots(p) if irreducible_factors(p) == [(p, 1)] else []
        if not roots:
            raise InputError("coefficients: an irreducible polynomial with a real root, the leading one > 0, expected")
        return roots[arguments.whole(index, "index", len(roots) - 1)]

    @property
    def degree(self) -> int:
        """The degree of the minimal polynomial over Q."""
        return int(self.poly.degree())

    @property
    def is_rational(self) -> bool:
        """Whether the minimal polynomial is linear."""
        return bool(self.poly.degree() == 1)

    def as_fmpq(self) -> fmpq:
        """The value of a rational number."""
        return fmpq(-self.poly[0], self.poly[1])

    def as_fraction(self) -> Fraction:
        """The value of a rational number; ``InputError`` otherwise."""
        if not self.is_rational:
            raise InputError(f"{self} is irrational")
        return Fraction(-int(self.poly[0]), int(self.poly[1]))

    @property
    def minimal_polynomial(self) -> tuple[int, ...]:
        """Integer coefficients from degree 0 up."""
        return tuple(int(c) for c in self.poly.coeffs())

    def interval(self, bits: int = 0) -> tuple[Fraction, Fraction]:
        """Rational numbers lo <= self <= hi, with hi - lo small when ``bits`` are requested."""
        if arguments.whole(bits, "bits"):
            return ends(self.ball(bits))
        lo, hi = self._lo, self._hi
        return Fraction(int(lo.p), int(lo.q)), Fraction(int(hi.p), int(hi.q))

    def ball(self, bits: int = FIRST_PRECISION) -> arb:
        """A ball around the number with about ``bits`` bits of relative accuracy."""
        if self._ball is None or self._bits < bits:
            with precision(bits + 16):
                self._ball, self._bits = self._refined(bits), bits
        return self._ball

    def _refined(self, bits: int) -> arb:
        degree = self.poly.degree()
        if degree == 1:
            return arb(self.as_fmpq())
        if degree == 2:
            return _quadratic_root(self.poly, self.index)
        x = self._newton(bits)
        self._lo, self._hi = max(self._lo, lower_end(x)), min(self._hi, upper_end(x))
        return x

    def _newton(self, bits: int) -> arb:
        """Interval Newton with bisection as its safeguard; ends stay exact."""
        derivative = self.poly.derivative()
        lo, hi = self._lo, self._hi
        low_sign = sign_at(self.poly, lo)
        x = hull(lo, hi)
        while x.rel_accuracy_bits() < bits:
            slope = derivative(x)
            if not slope.contains(0):
                middle = x.mid()
                step = middle - self.poly(middle) / slope
                narrowed = x.intersection(step)
                if narrowed.rel_accuracy_bits() >= x.rel_accuracy_bits() + 4:
                    x = narrowed
                    continue
                if x.rel_accuracy_bits() > STALLED_BITS:  # by rounding: more working precision
                    with precision(4 * bits + int(self.poly.height_bits()) + 64):
                        middle = x.mid()
                        narrowed = x.intersection(middle - self.poly(middle) / derivative(x))
                    if narrowed.rel_accuracy_bits() >= x.rel_accuracy_bits() + 1:
                        x = narrowed
                        continue
            lo, hi = max(lo, lower_end(x)), min(hi, upper_end(x))
            middle_q = (lo + hi) / 2
            sign = sign_at(self.poly, middle_q)
            if sign == low_sign:
                lo = middle_q
            else:
                hi = middle_q
            x = hull(lo, hi)
        return x

    # --- order -----------------------------------------------------------------------------
    def compare_rational(self, q: fmpq) -> int:
        """The sign of self - q, exactly."""
        if self.poly.degree() == 1:
            own = self.as_fmpq()
            return int(own > q) - int(own < q)
        x = self.ball() - arb(q)
        sign = ball_sign(x)
        if sign is not None:
            return sign
        if q <= self._lo:
            return 1
        if q >= self._hi:
            return -1
        return 1 if sign_at(self.poly, q) == sign_at(self.poly, self._lo) else -1

    def sign(self) -> int:
        """-1, 0 or 1."""
        return self.compare_rational(fmpq(0))

    def compare(self, other: RealAlgebraic) -> int:
        """The sign of self - other, exactly."""
        if self.poly == other.poly:
            return (self.index > other.index) - (self.index < other.index)
        bits = FIRST_PRECISION
        while True:
            with precision(bits + 16):
                sign = ball_sign(self.ball(bits) - other.ball(bits))
            if sign:  # different irreducible polynomials have no common root, so this ends
                return sign
            bits *= 2

    def _operand(self, other: object) -> RealAlgebraic | None:
        if isinstance(other, RealAlgebraic):
            return other
        if (value := exact_operand(other)) is not None:
            return RealAlgebraic.rational(value)
        convert = getattr(other, "to_algebraic", None)  # an element of a number field
        return convert() if convert is not None else None

    def _order(self, other: object) -> float | None:
        if isinstance(other, RealAlgebraic):
            return self.compare(other)
        if hasattr(other, "to_algebraic"):
            return self.compare(other.to_algebraic())
        value = exact(other)
        if value is None or isinstance(value, float):
            return None if value is None else -value
        return self.compare_rational(fmpq(value.numerator, value.denominator))

    def __eq__(self, other: object) -> bool:
        if isinstance(other, RealAlgebraic):
            return self.index == other.index and bool(self.poly == other.poly)
        sign = self._order(other)
        return NotImplemented if sign is None else sign == 0

    def __hash__(self) -> int:
        return hash(self.as_fraction()) if self.is_rational else hash((self.minimal_polynomial, self.index))

    # --- arithmetic ------------------------------------------------------------------------
    def __neg__(self) -> RealAlgebraic:
        return _image(self, lambda p: p(fmpz_poly([0, -1])), lambda x: -x)

    def _with(self, operation: Operation, other: RealAlgebraic) -> RealAlgebraic:
        """A root of the resultant of the two minimal polynomials, picked by enclosure."""
        if self.is_rational and other.is_rational:
            return RealAlgebraic.rational(operation(self.as_fmpq(), other.as_fmpq()))
        if operation is mul and (self.sign() == 0 or other.sign() == 0):
            return RealAlgebraic.rational(0)

        def enclosure(bits: int) -> arb:
            with precision(bits + 16):
                return operation(self.ball(bits), other.ball(bits))

        return select_root(combined_polynomial(self.poly, other.poly, operation), enclosure)

    def inverse(self) -> RealAlgebraic:
        """1/self; ``ZeroDivisionError`` for zero."""
        if self.sign() == 0:
            raise ZeroDivisionError("inverse of zero")
        return _image(self, lambda p: fmpz_poly(p.coeffs()[::-1]), lambda x: 1 / x)

    def _power(self, exponent: int) -> RealAlgebraic:
        if abs(exponent) > MAX_EXPONENT:
            raise Unable(f"powers of real algebraic numbers have exponents up to {MAX_EXPONENT} here")
        if exponent < 0:
            return self.inverse()._power(-exponent)
        if self.is_rational or exponent < 2:
            return self if exponent == 1 else RealAlgebraic.rational(self.as_fmpq() ** exponent if exponent else 1)
        return _image(self, lambda p: power_polynomial(p, exponent), lambda x: x**exponent)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return _restore, (self.minimal_polynomial, self.index)

    def __str__(self) -> str:
        return format_root(self.minimal_polynomial, self.index)

    def __repr__(self) -> str:
        return f"RealAlgebraic({self} ≈ {float(self):.6g})"


def _restore(coefficients: tuple[int, ...], index: int) -> RealAlgebraic:
    return irreducible_roots(fmpz_poly(list(coefficients)))[index]


def _quadratic_root(p: fmpz_poly, index: int) -> arb:
    """Root 0 (smaller) or 1 (larger) of a*x^2+b*x+c, a > 0, without cancellation."""
    c, b, a = p[0], p[1], p[2]
    root = arb(b * b - 4 * a * c).sqrt()
    large = -(root + b) if b >= 0 else root - b  # the numerator in which nothing cancels
    if (index == 0) == (b >= 0):
        return large / (2 * a)
    return 2 * c / large


def irreducible_roots(p: fmpz_poly) -> list[RealAlgebraic]:
    """The real roots, ascending, of an irreducible primitive polynomial with positive leading coefficient."""
    if p.degree() == 2:
        c, b, a = p[0], p[1], p[2]
        if b * b < 4 * a * c:
            return []
        # a rational strictly between the two roots, and root bounds outside
        middle, bound = fmpq(-b, 2 * a), 1 + fmpq(max(abs(b), abs(c)), a)
        return [RealAlgebraic(p, 0, (-bound, middle)), RealAlgebraic(p, 1, (middle, bound))]
    return [RealAlgebraic(p, i, interval) for i, interval in enumerate(isolate(p))]


def irreducible_factors(p: fmpz_poly) -> list[tuple[fmpz_poly, int]]:
    """(irreducible factor with positive leading coefficient, multiplicity); quadratics without factoring."""
    degree = p.degree()
    if degree <= 0:
        return []
    if degree <= 2:
        content = p.content()
        q = p / content if content != 1 else p
        if q.leading_coefficient() < 0:
            q = -q
        if degree == 1:
            return [(q, 1)]
        c, b, a = q[0], q[1], q[2]
        discriminant = b * b - 4 * a * c
        if discriminant < 0 or discriminant.isqrt() ** 2 != discriminant:
            return [(q, 1)]
    _, factors = p.factor()
    return [(f if f.leading_coefficient() > 0 else -f, int(e)) for f, e in factors]


def real_roots(p: fmpz_poly) -> list[RealAlgebraic]:
    """The distinct real roots of a nonzero integer polynomial, ascending."""
    return sorted(r for f, _ in irreducible_factors(p) for r in irreducible_roots(f))


def select_root(p: fmpz_poly, enclosure: Callable[[int], arb]) -> RealAlgebraic:
    """The real root of ``p`` that is enclosed by ``enclosure(bits)`` at every precision.

    The caller guarantees that the enclosed number is a root of p.
    """
    candidates = [r for f, _ in irreducible_factors(p) for r in irreducible_roots(f)]
    bits = FIRST_PRECISION
    x = enclosure(bits)
    candidates = [r for r in candidates if hull(r._lo, r._hi).overlaps(x)]  # the isolating intervals tell most apart
    while len(candidates) > 1:
        x = enclosure(bits)
        candidates = [r for r in candidates if r.ball(bits).overlaps(x)]
        bits *= 2
    return candidates[0]


def _image(a: RealAlgebraic, transform: Callable[[fmpz_poly], fmpz_poly], value: Callable[[arb], arb]) -> RealAlgebraic:
    """The number value(a), a root of the transformed polynomial."""

    def enclosure(bits: int) -> arb:
        with precision(bits + 16):
            return value(a.ball(bits))

    return select_root(transform(a.poly), enclosure)


MAX_EXPONENT = 10_000

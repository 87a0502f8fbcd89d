"""Numbers Σ q √d (q rational, d squarefree) with exact signs, polynomials over them, counts of real roots.

Square roots of different squarefree numbers are linearly independent over Q (A. S. Besicovitch, J. London Math. Soc.
15, 1940), so such a sum is zero iff every q is; then more digits always tell its sign. The checker's own arithmetic:
integers, fractions, and FLINT's balls.

Polynomials with square roots in their coefficients that have one sign on an interval, proved by subdivision.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import pairwise, zip_longest
from math import gcd, isqrt
from operator import add, mul
from typing import Any

from flint import arb, arb_poly, fmpq

from qe.exact.balls import ball_sign, precision

LARGEST = 10**10
"""Radicands are factored by trial division, up to this."""

Interval = tuple[Fraction, Fraction]
Ball = arb


@dataclass(frozen=True, slots=True)
class Surd:
    """``terms``: (d, q) with q not zero, ascending."""

    terms: tuple[tuple[int, Fraction], ...]

    @staticmethod
    def of(pairs: Iterable[tuple[int, Fraction]]) -> Surd:
        """The sum of q √d over the pairs (d, q)."""
        result: dict[int, Fraction] = {}
        for d, q in pairs:
            result[d] = result.get(d, Fraction(0)) + q
        return Surd(tuple(sorted((d, q) for d, q in result.items() if q)))

    @staticmethod
    def rational(value: Fraction | int) -> Surd:
        """A rational number."""
        return Surd(((1, Fraction(value)),)) if value else Surd(())

    def __add__(self, other: Surd) -> Surd:
        return Surd.of((*self.terms, *other.terms))

    def __sub__(self, other: Surd) -> Surd:
        return Surd.of((*self.terms, *((d, -q) for d, q in other.terms)))

    def __neg__(self) -> Surd:
        return Surd(tuple((d, -q) for d, q in self.terms))

    def __mul__(self, other: Surd) -> Surd:
        if len(self.terms) == 1 and self.terms[0][0] == 1:
            return Surd(tuple((d, self.terms[0][1] * q) for d, q in other.terms))
        result = []
        for d, q in self.terms:
            for e, r in other.terms:
                g = gcd(d, e)
                result.append((d // g * (e // g), q * r * g))
        return Surd.of(result)

    def __bool__(self) -> bool:
        return bool(self.terms)

    by = __mul__

    @property
    def one(self) -> Surd:
        """The number 1."""
        return ONE

    def inverse(self) -> Surd:
        """1 / self: the product with what √p -> -√p makes of it is free of √p."""
        largest = self.terms[-1][0]
        if largest == 1:
            return Surd.rational(1 / self.terms[0][1])
        other = self.conjugate(next(primes(largest)))
        return other * (self * other).inverse()

    def conjugate(self, p: int) -> Surd:
        """What √p -> -√p, p prime, makes of it."""
        return Surd(tuple((d, -q if d % p == 0 else q) for d, q in self.terms))

    def ball(self) -> arb:
        """A ball around it, at FLINT's working precision."""
        return sum((arb(d).sqrt() * rational_ball(q) for d, q in self.terms), arb(0))

    def __float__(self) -> float:
        with precision(BITS[0]):
            return float(self.ball())

    def sign(self) -> int:
        """-1, 0 or 1."""
        bits = 64
        while self.terms:
            with precision(bits):
                if side := ball_sign(self.ball()):
                    return side
            bits *= 2
        return 0


def rational_ball(value: Fraction) -> arb:
    """A rational number as a ball."""
    return arb(fmpq(value.numerator, value.denominator))


ZERO, ONE = Surd(()), Surd.rational(1)


def primes(d: int) -> Iterator[int]:
    """The prime factors of d >= 1, ascending, for d <= ``LARGEST``."""
    p = 2
    while d > 1:
        p = next((k for k in range(p, isqrt(d) + 1) if d % k == 0), d)
        yield p
        d //= p


def is_squarefree(d: int) -> bool:
    """Whether no square but 1 divides d."""
    return all(p < q for p, q in pairwise(primes(d)))


# --- polynomials -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Polynomial:
    """Coefficients from degree 0 up, the last one not zero."""

    coefficients: tuple[Surd, ...] = ()

    @staticmethod
    def of(values: Iterable[Surd]) -> Polynomial:
        """Without leading zeros."""
        kept = list(values)
        while kept and not kept[-1]:
            kept.pop()
        return Polynomial(tuple(kept))

    def __len__(self) -> int:
        return len(self.coefficients)

    def __getitem__(self, k: int) -> Surd:
        return self.coefficients[k]

    def __iter__(self) -> Iterator[Surd]:
        return iter(self.coefficients)

    def __add__(self, other: Polynomial) -> Polynomial:
        return Polynomial.of(a + b for a, b in zip_longest(self, other, fillvalue=ZERO))

    def __neg__(self) -> Polynomial:
        return Polynomial(tuple(-c for c in self))

    def __sub__(self, other: Polynomial) -> Polynomial:
        return self + -other

    def __mul__(self, other: Polynomial) -> Polynomial:
        product = [ZERO] * max(0, len(self) + len(other) - 1)
        for i, a in enumerate(self):
            for j, b in enumerate(other):
                product[i + j] = product[i + j] + a * b
        return Polynomial.of(product)

    def by(self, c: Surd) -> Polynomial:
        """c times it."""
        return Polynomial.of(a * c for a in self)

    @property
    def one(self) -> Polynomial:
        """The constant 1."""
        return Polynomial((ONE,))

    def at(self, x: Fraction) -> Surd:
        """The value at a rational number."""
        total, point = ZERO, Surd.rational(x)
        for c in reversed(self.coefficients):
            total = total * point + c
        return total

    @property
    def derivative(self) -> Polynomial:
        """The slope."""
        return Polynomial.of(Surd.rational(k) * c for k, c in enumerate(self) if k)


def divided(p: Polynomial, q: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Quotient and remainder."""
    rest, over = list(p), q[-1].inverse()
    quotient = [ZERO] * max(0, len(p) - len(q) + 1)
    for k in range(len(p) - len(q), -1, -1):
        c = quotient[k] = rest[k + len(q) - 1] * over
        if c:
            for j, a in enumerate(q):
                rest[k + j] = rest[k + j] - c * a
    return Polynomial.of(quotient), Polynomial.of(rest[: len(q) - 1] if len(p) >= len(q) else rest)


def tarski(p: Polynomial, s: Polynomial, between: Interval | None = None) -> int:
    """The sum of the signs of s at the different real roots of p, all of them or those in an interval whose ends are no
    roots (S. Basu, R. Pollack, M.-F. Roy, *Algorithms in Real Algebraic Geometry*, theorem 2.73). p is not constant."""
    sequence = [p, p.derivative * s]
    while sequence[-1]:
        sequence.append(-divided(sequence[-2], sequence[-1])[1])
    sequence.pop()
    if between is None:
        high = [q[-1].sign() for q in sequence]
        low = [sign * (-1) ** (len(q) - 1) for sign, q in zip(high, sequence, strict=True)]
    else:
        low, high = ([q.at(x).sign() for q in sequence] for x in between)
    return _variations(low) - _variations(high)


def _variations(signs: Sequence[int]) -> int:
    present = [s for s in signs if s]
    return sum(a != b for a, b in pairwise(present))


def enclosure(p: Polynomial, x: Interval) -> arb:
    """A ball around p on x, by Horner's rule."""
    total, around = arb(0), rational_ball(x[0]).union(rational_ball(x[1]))
    for c in reversed(p.coefficients):
        total = total * around + c.ball()
    return total


Triple = tuple[Surd, ...]
Motion = tuple[tuple[Triple, Triple, Triple], Triple]
"""Rows of the rotation, and the shift."""

STILL: Motion = (((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE)), (ZERO, ZERO, ZERO))


def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """The scalar product, in numbers of any kind."""
    return reduce(add, map(mul, a, b))


def combined(row: Sequence[Surd], parts: Sequence[Any]) -> Any:
    """The sum of the parts, times the numbers of a row."""
    return reduce(add, (part.by(c) for c, part in zip(row, parts, strict=True)))


def turn(plane: tuple[int, int], angle: tuple[Surd, Surd], shift: Triple) -> Motion:
    """A turn in the plane of two axes, and a shift along the third one: they commute."""
    (c, s), (i, j) = angle, plane
    rows = [list(row) for row in STILL[0]]
    rows[i][i], rows[i][j], rows[j][i], rows[j][j] = c, -s, s, c
    return (tuple(rows[0]), tuple(rows[1]), tuple(rows[2])), shift


def together(first: Motion, second: Motion) -> Motion:
    """The second motion, then the first one."""
    a, b, c = (tuple(dot(row, column) for column in zip(*second[0], strict=True)) for row in first[0])
    return (a, b, c), image(first, second[1])


def image(motion: Any, point: Sequence[Any], is_point: bool = True) -> tuple[Any, ...]:
    """Where a point comes to lie, or which direction a direction takes."""
    rows, shift = motion
    return tuple(dot(row, point) + o if is_point else dot(row, point) for row, o in zip(rows, shift, strict=True))


def moved(value: Sequence[Any], point: Sequence[Any], is_point: bool = True) -> Sequence[Any]:
    """What a joint makes of a point or a direction: ``value`` holds cosine and sine of a turn about the third axis, or
    the length of a slide along it."""
    x, y, z = point
    if len(value) == 2:
        c, s = value
        return (c * x - s * y, s * x + c * y, z)
    return (x, y, z + value[0]) if is_point else point


def carried(
    links: Sequence[Any], values: Sequence[Sequence[Any]], point: Sequence[Any], is_point: bool = True
) -> Sequence[Any]:
    """What joints make of a point, each of them followed by the constant motion of a link."""
    for link, value in zip(links[::-1], values[::-1], strict=True):
        point = moved(value, image(link, point, is_point), is_point)
    return point


def carried_with_rates(
    links: Sequence[Any], values: Sequence[Sequence[Any]], point: Sequence[Any]
) -> tuple[Sequence[Any], list[Sequence[Any]]]:
    """The same of a point, and its derivatives by the angles and lengths."""
    rates = list[Sequence[Any]]()
    for link, value in zip(links[::-1], values[::-1], strict=True):
        point = moved(value, image(link, point))
        rates = [moved(value, image(link, rate, False), False) for rate in rates]
        rates.insert(0, (-point[1], point[0], 0) if len(value) == 2 else (0, 0, 1))
    return point, rates


def back(motion: Motion) -> Motion:
    """The inverse motion: rotations are orthogonal."""
    rows, shift = motion
    a, b, c = zip(*rows, strict=True)
    return (a, b, c), tuple(-dot(row, shift) for row in (a, b, c))


def cross(a: Sequence[Any], b: Sequence[Any]) -> tuple[Any, ...]:
    """The vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def is_motion(motion: Motion) -> bool:
    """Whether the rows are orthogonal, of length 1 and of determinant 1."""
    a, b, c = motion[0]
    pairs = [(a, a, ONE), (b, b, ONE), (a, b, ZERO)]
    return cross(a, b) == c and all(dot(x, y) == value for x, y, value in pairs)


BITS = (512, 2048)
MOST_SUMS = 20_000_000
"""Of the coefficients of all parts that are looked at."""


def constant_sign(p: Polynomial, low: Fraction, high: Fraction) -> int:
    """1 or -1 if p is proved to have this sign everywhere on [low, high], else 0."""
    sides = {p.at(x).sign() for x in (low, high)}
    if len(sides) > 1 or sides == {0}:
        return 0
    return sides.pop() if any(_is_nonzero(p, low, high, bits) for bits in BITS) else 0


def _is_nonzero(p: Polynomial, low: Fraction, high: Fraction, bits: int) -> bool:
    """By halves, until the constant part of p(middle + h u), |u| <= 1, is larger than all others together."""
    with precision(bits):
        whole, parts = arb_poly([c.ball() for c in p]), [(low, high)]
        for _ in range(200 + MOST_SUMS // len(p) ** 2):
            a, b = parts.pop()
            middle, *rest = whole(arb_poly([rational_ball((a + b) / 2), rational_ball((b - a) / 2)]))
            if middle.contains(0):
                return False
            if not sum(map(abs, rest), arb(0)) < abs(middle):
                parts += [(a, (a + b) / 2), ((a + b) / 2, b)]
            elif not parts:
                return True
        return False

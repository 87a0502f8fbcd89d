"""Numbers Σ q √d (q rational, d squarefree) with exact signs, polynomials over them, counts of real roots.

Square roots of different squarefree numbers are linearly independent over Q (A. S. Besicovitch, J. London Math. Soc.
15, 1940), so such a sum is zero iff every q is; then more digits always tell its sign. The checker's own arithmetic:
nothing but integers and fractions.

Polynomials with square roots in their coefficients that have one sign on an interval, proved by subdivision.

On [a, b] a polynomial lies between its smallest and its largest Bernstein coefficient there (R. T. Farouki, CAGD 29,
2012, section 3). The coefficients are enclosed by integers, and halves follow by de Casteljau's algorithm.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, zip_longest
from math import ceil, comb, floor, gcd, isqrt

LARGEST = 10**10
"""Radicands are factored by trial division, up to this."""

Interval = tuple[Fraction, Fraction]


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
        result = []
        for d, q in self.terms:
            for e, r in other.terms:
                g = gcd(d, e)
                result.append((d // g * (e // g), q * r * g))
        return Surd.of(result)

    def __bool__(self) -> bool:
        return bool(self.terms)

    def inverse(self) -> Surd:
        """1 / self: the product with what √p -> -√p makes of it is free of √p."""
        largest = self.terms[-1][0]
        if largest == 1:
            return Surd.rational(1 / self.terms[0][1])
        p = least_prime(largest)
        other = Surd(tuple((d, -q if d % p == 0 else q) for d, q in self.terms))
        return other * (self * other).inverse()

    def interval(self, bits: int) -> Interval:
        """Rational numbers around it; each root is known to 2^-bits."""
        low = high = Fraction(0)
        for d, q in self.terms:
            root = isqrt(d << (2 * bits))
            ends = Fraction(root, 1 << bits), Fraction(root + (d != 1), 1 << bits)
            low += q * ends[q < 0]
            high += q * ends[q > 0]
        return low, high

    def sign(self) -> int:
        """-1, 0 or 1."""
        bits = 32
        while self.terms:
            low, high = self.interval(bits)
            if low > 0 or high < 0:
                return 1 if low > 0 else -1
            bits *= 2
        return 0


ZERO, ONE = Surd(()), Surd.rational(1)


def is_squarefree(d: int) -> bool:
    """Whether no square but 1 divides d, for 1 <= d <= ``LARGEST``."""
    k = 2
    while k * k <= d:
        if d % (k * k) == 0:
            return False
        if d % k == 0:
            d //= k
        k += 1
    return True


def least_prime(d: int) -> int:
    """The least prime factor of d > 1."""
    return next((k for k in range(2, isqrt(d) + 1) if d % k == 0), d)


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


# --- intervals ---------------------------------------------------------------------------------------------------


def plus(a: Interval, b: Interval) -> Interval:
    """a + b."""
    return a[0] + b[0], a[1] + b[1]


def product(a: Interval, b: Interval) -> Interval:
    """a b."""
    ends = [x * y for x in a for y in b]
    return min(ends), max(ends)


def enclosure(p: Polynomial, x: Interval, bits: int) -> Interval:
    """An interval around p on x, by Horner's rule."""
    total: Interval = (Fraction(0), Fraction(0))
    for c in reversed(p.coefficients):
        total = plus(product(total, x), c.interval(bits))
    return total


def root(a: Interval, bits: int) -> Interval:
    """An interval around the square roots of what is not negative in a, whose upper end is not negative."""
    low, high = (max(Fraction(0), v) * (1 << (2 * bits)) for v in a)
    return Fraction(isqrt(int(low)), 1 << bits), Fraction(isqrt(int(high)) + 1, 1 << bits)


def quotient(a: Interval, b: Interval) -> Interval:
    """a / b for b > 0."""
    return product(a, (1 / b[1], 1 / b[0]))


def outwards(a: Interval, bits: int) -> Interval:
    """A little wider, with ends that are multiples of 2^-bits."""
    low, high = (v * (1 << bits) for v in a)
    return Fraction(floor(low), 1 << bits), Fraction(ceil(high), 1 << bits)


Triple = tuple[Surd, ...]
Motion = tuple[tuple[Triple, Triple, Triple], Triple]
"""Rows of the rotation, and the shift."""

STILL: Motion = (((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE)), (ZERO, ZERO, ZERO))


def dot(a: Sequence[Surd], b: Sequence[Surd]) -> Surd:
    """The scalar product."""
    return sum((x * y for x, y in zip(a, b, strict=True)), ZERO)


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


def image(motion: Motion, point: Sequence[Surd]) -> Triple:
    """Where a point comes to lie."""
    return tuple(dot(row, point) + o for row, o in zip(*motion, strict=True))


def back(motion: Motion) -> Motion:
    """The inverse motion: rotations are orthogonal."""
    rows, shift = motion
    a, b, c = zip(*rows, strict=True)
    return (a, b, c), tuple(-dot(row, shift) for row in (a, b, c))


def is_motion(motion: Motion) -> bool:
    """Whether the rows are orthogonal, of length 1 and of determinant 1."""
    a, b, c = motion[0]
    across = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    pairs = [(a, a, ONE), (b, b, ONE), (a, b, ZERO)]
    return across == c and all(dot(x, y) == value for x, y, value in pairs)


BITS = (256, 1024)
MOST_SUMS = 20_000_000
"""Of the coefficients of all parts that are looked at."""

Ends = list[tuple[int, int]]


def constant_sign(p: Polynomial, low: Fraction, high: Fraction) -> int:
    """1 or -1 if p is proved to have this sign everywhere on [low, high], else 0."""
    ends = {p.at(x).sign() for x in (low, high)}
    if len(ends) > 1 or ends == {0}:
        return 0
    bernstein = _bernstein(p, low, high)
    return ends.pop() if any(_is_nonzero(_enclosed(bernstein, bits)) for bits in BITS) else 0


def _bernstein(p: Polynomial, low: Fraction, high: Fraction) -> list[Surd]:
    """b_k = Σ_j C(k,j) / C(n,j) c_j, c the coefficients of p(low + (high - low) u)."""
    step, composed = Polynomial((Surd.rational(low), Surd.rational(high - low))), Polynomial()
    for c in reversed(p.coefficients):
        composed = composed * step + Polynomial.of([c])
    n = len(p) - 1
    moved = [*composed, *[ZERO] * (n + 1 - len(composed))]
    result = []
    for k in range(n + 1):
        pairs = [(d, q * Fraction(comb(k, j), comb(n, j))) for j in range(k + 1) for d, q in moved[j].terms]
        result.append(Surd.of(pairs))
    return result


def _enclosed(values: list[Surd], bits: int) -> Ends:
    ends = [v.interval(2 * bits) for v in values]
    unit = max(max(abs(a), abs(b)) for a, b in ends) / (1 << bits)
    return [(floor(a / unit), ceil(b / unit)) for a, b in ends]


def _is_nonzero(whole: Ends) -> bool:
    parts, count, most = [whole], 0, 200 + MOST_SUMS // len(whole) ** 2
    while parts:
        part, count = parts.pop(), count + 1
        if all(low > 0 for low, _ in part) or all(high < 0 for _, high in part):
            continue
        if any(low <= 0 <= high for low, high in (part[0], part[-1])) or count > most:
            return False
        parts += _halves(part)
    return True


def _halves(row: Ends) -> tuple[Ends, Ends]:
    """The coefficients on both halves: after k sums they are 2^k times as large."""
    left, right, k = [row[0]], [row[-1]], 0
    while len(row) > 1:
        row, k = [(a + c, b + d) for (a, b), (c, d) in pairwise(row)], k + 1
        left.append((row[0][0] >> k, -(-row[0][1] >> k)))
        right.append((row[-1][0] >> k, -(-row[-1][1] >> k)))
    return left, right[::-1]

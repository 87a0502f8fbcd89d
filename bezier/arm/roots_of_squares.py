"""Rigid motions over a tower of square roots: entries are polynomials in roots m with m² known, over one scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd
from typing import Any

from bezier.arm.elimination import Quotient, quotient
from bezier.arm.model import Matrix, root_in
from bezier.arm.ratio import Ratio, constant, reduced, variable
from bezier.curves.scalar import is_zero, rational
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic, irreducible_roots
from qe.exact.algebraic_text import square_part
from qe.exact.field import FieldElement, NumberField
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point

ZERO = Fraction(0)


@dataclass(frozen=True, eq=False)
class Rules:
    """``ring``: the generator of the field, the given irrational numbers, the roots. ``given``: the numbers that were
    given. ``squares``: m² for each root that is known by now, by its place in the ring."""

    ring: Ring
    field: NumberField
    given: tuple[Ratio, ...]
    squares: dict[int, Poly]

    @staticmethod
    def of(field: NumberField, roots: Sequence[str], numbers: Sequence[Any]) -> tuple[Rules, Point]:
        """The rules, and the point with the generator and the irrational numbers: sums of square roots share these."""
        known = {d: root for d in (2, 3, 6) if (root := root_in(field, d)) is not None}
        sums = [_sum_of_roots(v) if isinstance(v, RealAlgebraic) else None for v in numbers]
        new = sorted({d for terms in sums for d in terms or ()} - {1, *known})
        others = [v for v, terms in zip(numbers, sums, strict=True) if terms is None and isinstance(v, RealAlgebraic)]
        ring = Ring.of(("w", *(f"r{d}" for d in new), *(f"x{k}" for k in range(len(others))), *roots))
        names = iter(f"x{k}" for k in range(len(others)))

        def read(value: Any, terms: Terms | None) -> Ratio:
            if terms is None:
                irrational = isinstance(value, RealAlgebraic)
                return variable(ring, next(names), field) if irrational else constant(ring, value, field)
            total = constant(ring, 0, field)
            for d, q in terms.items():
                total = total + (variable(ring, f"r{d}", field) if d in new else constant(ring, known[d], field)) * q
            return total

        known[1] = Fraction(1)
        given = tuple(read(v, terms) for v, terms in zip(numbers, sums, strict=True))
        squares = {ring.index[f"r{d}"]: ring.constant(d) for d in new}
        lengths = [RealAlgebraic.from_root([-d, 0, 1], 0, d + 1) for d in new]
        return Rules(ring, field, given, squares), Point.of(ring, [field.theta, *lengths, *others])

    def number(self, value: Any) -> Ratio:
        """A polynomial, rational number or element of the field."""
        return Ratio(value, 1, self.field) if isinstance(value, Poly) else constant(self.ring, value, self.field)

    def numbers(self, pair: Sequence[Quotient]) -> tuple[Ratio, Ratio]:
        """The tops of cosine and sine, with their scales."""
        c, s = (Ratio(q.top * q.scale.numerator, q.scale.denominator, self.field) for q in pair)
        return c, s

    def tidy(self, value: Ratio) -> Ratio:
        """The same with squares of roots replaced, and without a common factor of numerator and denominator."""
        top = value.top
        for place in sorted(self.squares, reverse=True):
            top = _lowered(top, place, self.squares[place])
        top = reduced(top, self.field)
        unit = top.normal()[0]
        common = gcd(unit, value.bottom)
        if common > 1:
            return Ratio(top.exact_divide(common), value.bottom // common, self.field)
        return Ratio(top, value.bottom, self.field)

    def turn(self, a: Ratio, b: Ratio, k: Ratio, weight: Ratio, root: str, by: Point | None = None) -> Turn | None:
        """The angles with a cos θ + b sin θ = k / weight; None where a = b = 0 at the point ``by`` (elsewhere they are
        constants that are not both 0). The square of the root is known from then on."""
        a, b, k = self.tidy(a), self.tidy(b), self.tidy(k)
        size = self.tidy(a * a + b * b)
        if by is not None and by.sign(size.top) == 0:
            return None
        square = self.tidy(size * weight * weight - k * k)
        m = Ratio(self.ring.var(root), square.bottom, self.field)  # it stands for a multiple, of integer coefficients
        self.squares[self.ring.index[root]] = square.top * square.bottom
        c, s, scale = a * k - b * m, b * k + a * m, self.tidy(size * weight)
        if (number := _constant(size, self.field)) is not None:
            over = 1 / number
            c, s, scale = c * over, s * over, weight
        return Turn(self.tidy(c), self.tidy(s), scale, Ratio(square.top * square.bottom, 1, self.field))


@dataclass(frozen=True, eq=False)
class Turn:
    """``cosine / scale`` and ``sine / scale``; ``square``: what the square of the root is."""

    cosine: Ratio
    sine: Ratio
    scale: Ratio
    square: Ratio

    @property
    def motion(self) -> Scaled:
        """The turn about z."""
        return turned((self.cosine, self.sine), self.scale)

    @property
    def pair(self) -> tuple[Quotient, ...]:
        """Cosine and sine."""
        return tuple(quotient(v, self.scale) for v in (self.cosine, self.sine))


@dataclass(frozen=True, eq=False)
class Scaled:
    """The rigid motion ``rows / scale``."""

    rows: tuple[tuple[Any, ...], ...]
    scale: Ratio
    rules: Rules | None

    def __matmul__(self, other: Scaled) -> Scaled:
        rules = self.rules or other.rules
        assert rules is not None, "constants come with their rules"

        def entry(row: Sequence[Any], j: int) -> Ratio:
            total = self.scale * 0
            for k in range(3):
                if not (_is_nothing(row[k]) or _is_nothing(other.rows[k][j])):
                    total = total + row[k] * other.rows[k][j]
            if j == 3:
                total = total + row[3] * other.scale
            return rules.tidy(total)

        rows = tuple(tuple(entry(row, j) for j in range(4)) for row in self.rows)
        return Scaled(rows, rules.tidy(self.scale * other.scale), rules)

    def image(self, point: Sequence[Any]) -> tuple[tuple[Ratio, ...], Ratio]:
        """The image of a point with constant coordinates, and what it is multiplied by."""
        start = self.scale * 0
        return tuple(sum((row[k] * point[k] for k in range(3)), start + row[3]) for row in self.rows), self.scale

    def inverse(self) -> Scaled:
        """The inverse motion: over the square of the scale, unless there is no shift."""
        turned_back = [[self.rows[j][i] for j in range(3)] for i in range(3)]
        shift = [row[3] for row in self.rows]
        if all(_is_nothing(v) for v in shift):
            zero = self.scale * 0
            return Scaled(tuple((*row, zero) for row in turned_back), self.scale, self.rules)
        rules = self.rules
        assert rules is not None, "shifts come from constants"
        moved = [rules.tidy(-sum((row[k] * shift[k] for k in range(3)), self.scale * 0)) for row in turned_back]
        rows = tuple((*(rules.tidy(v * self.scale) for v in row), t) for row, t in zip(turned_back, moved, strict=True))
        return Scaled(rows, rules.tidy(self.scale * self.scale), rules)

    @property
    def rotation(self) -> Scaled:
        """The same without its shift."""
        zero = self.scale * 0
        return Scaled(tuple((*row[:3], zero) for row in self.rows), self.scale, self.rules)

    @property
    def pair(self) -> tuple[Quotient, ...]:
        """Cosine and sine of a turn about z."""
        return quotient(self.rows[0][0], self.scale), quotient(self.rows[1][0], self.scale)


def fixed(m: Matrix | Sequence[Sequence[Any]], rules: Rules) -> Scaled:
    """A constant motion."""
    rows = tuple(tuple(v if isinstance(v, Ratio) else rules.number(v) for v in row) for row in m)
    return Scaled(rows, rules.number(1), rules)


def turned(pair: tuple[Ratio, Ratio], scale: Ratio) -> Scaled:
    """The turn about z with cosine and sine ``pair / scale``."""
    (c, s), zero = pair, scale * 0
    return Scaled(((c, -s, zero, zero), (s, c, zero, zero), (zero, zero, scale, zero)), scale, None)


def _sum_of_roots(value: RealAlgebraic) -> Terms | None:
    try:
        return square_roots(value)
    except Unable:
        return None


def _lowered(p: Poly, place: int, square: Poly) -> Poly:
    result = list(p.coefficients(place))
    if len(result) <= 2:
        return p
    while len(result) > 2:
        lead = result.pop()
        result[-2] = result[-2] + lead * square
    return result[0] + result[1] * p.ring.gen(place)


def _constant(value: Ratio, field: NumberField) -> Any:
    """The number that a polynomial in the generator alone stands for, or None."""
    if value.top.level > 0:
        return None
    total: Any = ZERO
    theta: FieldElement | Fraction = field.generator() if field.degree > 1 else ZERO
    for c in reversed(value.top.coefficients(0)):
        total = total * theta + int(c.constant_value())
    total = total / value.bottom
    assert not is_zero(total), "it was tested"
    number = rational(total)
    return total if number is None else number


def _is_nothing(value: Any) -> bool:
    return not value.top


Terms = dict[int, Fraction]


def square_roots(value: Any) -> Terms:
    """The number as a sum of factors times square roots of squarefree numbers, from a field of at most two square
    roots. Raises ``Unable`` where it is none.

    With c the mean of a number and its conjugates, it is c plus what it differs from c by (degree 2), or plus its half
    sums with each conjugate, less c (degree 4): in such a field their squares are rational.
    """
    number = rational(value)
    if number is not None:
        return {1: number} if number else {}
    a: RealAlgebraic = value if isinstance(value, RealAlgebraic) else value.to_algebraic()
    conjugates = irreducible_roots(a.poly)
    refused = Unable("certificates of joint positions are for coordinates that are sums of square roots")
    if a.degree not in (2, 4) or len(conjugates) != a.degree:
        raise refused
    mean = Fraction(-a.minimal_polynomial[-2], a.degree * a.minimal_polynomial[-1])
    parts = [a - mean] if a.degree == 2 else [(a + b) * Fraction(1, 2) - mean for b in conjugates if b != a]
    result = {1: mean}
    for x in parts:
        square = rational(x * x)
        if square is None:
            raise refused
        if square:
            d, q = _root(square)
            result[d] = result.get(d, Fraction(0)) + (q if x > 0 else -q)
    return {d: q for d, q in result.items() if q}


def _root(square: Fraction) -> tuple[int, Fraction]:
    whole = square.numerator * square.denominator
    outside = square_part(whole)
    return whole // outside**2, Fraction(outside, square.denominator)

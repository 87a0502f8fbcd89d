"""Balls with derivatives in a few directions (forward mode), and the end point of an arm computed with them.

The checker's own: whoever makes the certificates uses products of matrices and cross products instead.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from flint import arb, arb_mat

from bezier.proofs.square_roots import Motion, Surd, rational_ball

BITS = 96


class Dual:
    """A ball, and one ball for each partial derivative."""

    __slots__ = ("slope", "value")

    def __init__(self, value: arb, slope: tuple[arb, ...]) -> None:
        self.value, self.slope = value, slope

    def __add__(self, other: Dual) -> Dual:
        return Dual(self.value + other.value, tuple(a + b for a, b in zip(self.slope, other.slope, strict=True)))

    def __sub__(self, other: Dual) -> Dual:
        return Dual(self.value - other.value, tuple(a - b for a, b in zip(self.slope, other.slope, strict=True)))

    def __neg__(self) -> Dual:
        return Dual(-self.value, tuple(-a for a in self.slope))

    def __mul__(self, other: Dual) -> Dual:
        pairs = zip(self.slope, other.slope, strict=True)
        return Dual(self.value * other.value, tuple(a * other.value + self.value * b for a, b in pairs))

    def sine_cosine(self) -> tuple[Dual, Dual]:
        """sin and cos."""
        s, c = self.value.sin(), self.value.cos()
        return Dual(s, tuple(c * a for a in self.slope)), Dual(c, tuple(-s * a for a in self.slope))


def number(value: Fraction, directions: int) -> Dual:
    """A constant."""
    return Dual(ball(value), (arb(0),) * directions)


def constant(value: Surd, directions: int) -> Dual:
    """A sum of square roots."""
    return Dual(value.ball(), (arb(0),) * directions)


def seed(value: arb, which: int, directions: int) -> Dual:
    """A variable: its derivative in direction ``which`` is 1."""
    return Dual(value, tuple(arb(int(k == which)) for k in range(directions)))


ball = rational_ball


def around(radius: Fraction) -> arb:
    """The ball of this radius around 0."""
    return arb(0, 1) * ball(radius)


Vector = list[Dual]


def origin(directions: int) -> Vector:
    """The point 0."""
    return [number(Fraction(0), directions) for _ in range(3)]


def rigid(motion: Motion) -> Callable[[Vector], Vector]:
    """A constant motion."""
    rows, shift = [[c.ball() for c in row] for row in motion[0]], [c.ball() for c in motion[1]]

    def moved(p: Vector) -> Vector:
        values = [_inner(row, [v.value for v in p]) + o for row, o in zip(rows, shift, strict=True)]
        slopes = [tuple(_inner(row, part) for part in zip(*(v.slope for v in p), strict=True)) for row in rows]
        return [Dual(value, slope) for value, slope in zip(values, slopes, strict=True)]

    return moved


def moved(turns: bool, value: Dual, p: Vector) -> Vector:
    """A point turned about the z axis by an angle, or shifted along it by a length."""
    x, y, z = p
    if not turns:
        return [x, y, z + value]
    s, c = value.value.sin(), value.value.cos()

    def turned(a: arb, b: arb) -> tuple[arb, arb]:
        return c * a - s * b, s * a + c * b

    rates = zip(x.slope, y.slope, value.slope, strict=True)
    slopes = [turned(dx - rate * y.value, dy + rate * x.value) for dx, dy, rate in rates]
    return [*map(Dual, turned(x.value, y.value), zip(*slopes, strict=True)), z]


def krawczyk(
    centre: Sequence[Dual], along: Sequence[Dual], whole: Sequence[Dual], sigma: arb, box: Sequence[arb]
) -> list[arb] | None:
    """The image of the box under -C f(σ, 0) + (I - C ∂f/∂r) R, for three functions f of σ (first direction) and r.

    ``centre``: f at 0; ``along``: over all σ with r = 0, so that f(σ, 0) lies in f(0) + σ ∂f/∂σ; ``whole``: over all σ
    and the box. None where the matrix at the middle has no inverse.
    """
    middle = arb_mat([[f.slope[j + 1].mid() for j in range(3)] for f in centre])
    try:
        inverse = middle.inv()
    except ZeroDivisionError:
        return None
    c = [[inverse[i, j].mid() for j in range(3)] for i in range(3)]
    start = [f.value + sigma * g.slope[0] for f, g in zip(centre, along, strict=True)]
    image = []
    for i in range(3):
        total = -_inner(c[i], start)
        for j in range(3):
            total += (int(i == j) - _inner(c[i], [f.slope[j + 1] for f in whole])) * box[j]
        image.append(total)
    return image


def _inner(a: Sequence[arb], b: Sequence[arb]) -> arb:
    return sum((x * y for x, y in zip(a, b, strict=True)), arb(0))


def strictly_within(values: Sequence[arb], radii: Sequence[Fraction]) -> bool:
    """Whether every ball lies in the open ball of its radius around 0."""
    return all(v.abs_upper() < ball(r) for v, r in zip(values, radii, strict=True))


def radius_above(value: arb) -> Fraction:
    """A number at least as large as all absolute values in the ball."""
    top = value.abs_upper().fmpq()
    return Fraction(int(top.p), int(top.q))

"""Balls with derivatives in a few directions (forward mode), and the end point of an arm computed with them.

The checker's own: whoever makes the certificates uses products of matrices and cross products instead.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction

from flint import arb, arb_mat, fmpq

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


def root_sum(terms: Iterable[tuple[int, Fraction]], directions: int) -> Dual:
    """The sum of q √d over the pairs (d, q), a constant."""
    value = sum((arb(d).sqrt() * ball(q) for d, q in terms), arb(0))
    return Dual(value, (arb(0),) * directions)


def seed(value: arb, which: int, directions: int) -> Dual:
    """A variable: its derivative in direction ``which`` is 1."""
    return Dual(value, tuple(arb(int(k == which)) for k in range(directions)))


def ball(value: Fraction) -> arb:
    """A rational number as a ball."""
    return arb(fmpq(value.numerator, value.denominator))


def around(radius: Fraction) -> arb:
    """The ball of this radius around 0."""
    return arb(0, 1) * ball(radius)


Angle = tuple[Dual, Dual]


def multiple_of_pi(twelfths: int, directions: int) -> Angle:
    """Sine and cosine of twelfths * pi / 12."""
    angle = arb.pi() * twelfths / 12
    flat = (arb(0),) * directions
    return Dual(angle.sin(), flat), Dual(angle.cos(), flat)


Vector = list[Dual]


def origin(directions: int) -> Vector:
    """The point 0."""
    return [number(Fraction(0), directions) for _ in range(3)]


def image(motions: Sequence[Callable[[Vector], Vector]], point: Vector) -> Vector:
    """The image of a point under all motions, the last one first."""
    for motion in reversed(motions):
        point = motion(point)
    return point


def together(motions: Sequence[Callable[[Vector], Vector]], directions: int) -> Callable[[Vector], Vector]:
    """Several constant motions as one, from the images of the origin and of the unit points."""
    start = image(motions, origin(directions))
    units = [[number(Fraction(int(i == k)), directions) for i in range(3)] for k in range(3)]
    columns = [[a - b for a, b in zip(image(motions, unit), start, strict=True)] for unit in units]

    def moved(p: Vector) -> Vector:
        found = []
        for i in range(3):  # what the columns hold are constants
            c = [column[i].value for column in columns]
            value = start[i].value + c[0] * p[0].value + c[1] * p[1].value + c[2] * p[2].value
            parts = zip(p[0].slope, p[1].slope, p[2].slope, strict=True)
            found.append(Dual(value, tuple(c[0] * x + c[1] * y + c[2] * z for x, y, z in parts)))
        return found

    return moved


def turn(axis: str, angle: Angle) -> Callable[[Vector], Vector]:
    """The rotation about the x or the z axis."""
    s, c = angle
    first, second, _ = (1, 2, 0) if axis == "x" else (0, 1, 2)

    def moved(p: Vector) -> Vector:
        q = list(p)
        q[first], q[second] = c * p[first] - s * p[second], s * p[first] + c * p[second]
        return q

    return moved


def shift(axis: str, length: Dual) -> Callable[[Vector], Vector]:
    """The translation along the x or the z axis."""
    index = 0 if axis == "x" else 2

    def moved(p: Vector) -> Vector:
        return [v + length if i == index else v for i, v in enumerate(p)]

    return moved


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

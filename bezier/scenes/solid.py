"""Convex bodies of a scene: where two of them meet, what separates them, and polytopes around and within them.

A body is its core, a polytope, with all points within ``radius`` of it; the core of a cylinder is its axis, widened
horizontally. Everything is decided in rational numbers. THEOREM. Where two polytopes with margins touch in one point
only, it is rational: it divides the segment between the nearest points of the cores in the ratio of the margins.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import product

from bezier.curves.curve import Bezier
from bezier.curves.enclosure import root_above
from bezier.curves.scalar import dot, subtract
from bezier.obstacles.bodies import Body
from bezier.obstacles.clearance import Along, Contact, examine
from bezier.obstacles.obstacle import Constraint, Obstacle, ObstacleKind, Piece
from bezier.obstacles.polyhedron import nearest
from bezier.scenes.cells import Cell, Point, Side, opposite, primitive

ROUNDINGS = (1, 16, 1024, 2**20, 2**40)
"""Denominators that are tried where a shorter number will do."""
ZERO = Fraction(0)


@dataclass(frozen=True, slots=True)
class Solid:
    """``corners``: of the core; ``sides``: half-spaces around it, all of them where it is a polytope with interior or
    a flat one without margin. ``pieces``: the body as a union of intersections of conditions. ``is_open``: without its
    boundary (the hole of an annulus), which its conditions say. What a formula gives has conditions only. ``body``: in
    space (of the plane: at the height 0), where it is one; the ``margin`` is in all of them."""

    name: str
    corners: tuple[Point, ...]
    sides: tuple[Side, ...]
    radius: Fraction
    pieces: tuple[tuple[Constraint, ...], ...]
    tube: Fraction = ZERO
    is_open: bool = False
    body: Body | None = None
    margin: Fraction = ZERO
    core: tuple[tuple[Constraint, ...], ...] = ()
    """The conditions of a formula without its margin."""

    @property
    def obstacle(self) -> Obstacle:
        """What ``bezier.obstacles`` knows of it."""
        box, pieces = None, tuple(map(Piece, self.pieces))
        if self.body is not None and self.body.box is not None and self.corners:
            low, high = self.low_high()
            box = (*low, ZERO)[:3], (*high, ZERO)[:3]
        return Obstacle(self.name, ObstacleKind.FORMULA, pieces, self.body, box, self.margin)

    @property
    def is_polytope(self) -> bool:
        """Whether the sides are all that is to say."""
        return not self.radius and not self.tube

    @property
    def is_formula(self) -> bool:
        """Whether there is nothing but conditions."""
        return not self.corners and not self.sides

    @property
    def centre(self) -> Point:
        """The mean of the corners."""
        return tuple(sum(c) / len(self.corners) for c in zip(*self.corners, strict=True))

    def contains(self, point: Point) -> bool:
        """Whether a point belongs to it."""
        at = (*point, ZERO)[:3]
        return any(all(c.holds(c.value(at)) for c in piece) for piece in self.pieces)

    def support(self, normal: Point, bits: int = 64) -> Fraction:
        """The largest normal . p over it, roots rounded up in these bits behind the point."""
        level = max(Fraction(dot(normal, c)) for c in self.corners)
        if self.tube:
            level += self.tube * root_above(Fraction(dot(normal[:2], normal[:2])), bits)
        return level + self.radius * root_above(Fraction(dot(normal, normal)), bits) if self.radius else level

    def is_behind(self, side: Side) -> bool:
        """Whether a half-space holds it, without rounding: that part of the plane or of space with which it is made."""
        normal, level = side
        room = level - max(Fraction(dot(normal, c)) for c in self.corners)
        ball, tube = self.radius**2 * dot(normal, normal), self.tube**2 * dot(normal[:2], normal[:2])
        rest = Fraction(room**2 - ball - tube)  # room >= sqrt(ball) + sqrt(tube)
        return room >= 0 <= rest and bool(rest**2 >= 4 * ball * tube)

    def low_high(self) -> tuple[Point, Point]:
        """The corners of a box around it."""
        axes = [tuple(Fraction(i == k) for i in range(len(self.corners[0]))) for k in range(len(self.corners[0]))]
        low = tuple(-self.support(tuple(-x for x in n)) for n in axes)
        return low, tuple(map(self.support, axes))

    def meets(self, start: Point, end: Point) -> bool:
        """Whether it has a point in common with a segment; of a cylinder, whether a prism around it has."""
        if self.is_formula:
            return isinstance(examine(in_space((start, end)), self.obstacle), Contact)
        reach = self.radius + self.tube
        for core, leg in zip(zip(*self.corners, strict=True), zip(start, end, strict=True), strict=True):
            if min(core) - reach > max(leg) or max(core) + reach < min(leg):
                return False
        if self.radius and not self.tube:
            p, q = nearest(self.corners, (start, end))
            away = dot(subtract(p, q), subtract(p, q))
            return bool(away < self.radius**2 if self.is_open else away <= self.radius**2)
        first, last = ZERO, Fraction(1)
        for n, c in self.sides if self.is_polytope else self.around(directions(3, 2)):
            a, b = (Fraction(dot(n, p)) - c for p in (start, end))
            if a > 0 and b > 0:
                return False
            if a > 0:
                first = max(first, a / (a - b))
            elif b > 0:
                last = min(last, a / (a - b))
        return first <= last

    def holds(self, start: Point, end: Point) -> bool:
        """Whether a segment is in one of its pieces, by the signs of Bernstein coefficients."""
        leg = Along(in_space((start, end)))
        return any(all(c.holds(min(leg.form(c))) for c in piece) for piece in self.pieces)

    def around(self, normals: Iterable[Point]) -> list[Side]:
        """Half-spaces that hold it: its sides moved out, and those with some more normals."""
        if self.is_polytope:
            return list(self.sides)
        core = [primitive(side)[0] for side in self.sides]
        return [_short(n, self.support(n)) for n in dict.fromkeys((*core, *normals))]

    def inside(self, normals: Sequence[Point]) -> Cell | None:
        """A polytope in it, touching it: one around it, drawn to its centre; its core where that is not in there. None
        where it is too thin."""
        if self.is_polytope:
            return self.cell()
        whole, middle = Cell.within(*self.low_high(), self.around(normals)), self.centre
        if whole is None:
            return None
        for step in range(63, 0, -1):
            share = Fraction(step, 64)
            corners = [tuple(m + share * (c - m) for m, c in zip(middle, p, strict=True)) for p in whole.corners]
            if all(map(self.contains, corners)):
                sides = [(n, Fraction(dot(n, middle)) * (1 - share) + share * c) for n, c in whole.sides]
                cell = Cell.of(sides, corners)
                return cell if not self.sides or self.tube or all(map(cell.contains, self.corners)) else self.cell()
        return None

    def cell(self) -> Cell:
        """A polytope as a cell."""
        flat = any(opposite(side) in self.sides for side in self.sides)
        return Cell.of(self.sides, self.corners, is_flat=flat)


def in_space(curve: Sequence[Point]) -> Bezier:
    """A curve; the plane is where z = 0."""
    return Bezier(tuple((*p, ZERO)[:3] for p in curve))


def _short(normal: Point, level: Fraction) -> Side:
    """The half-space, moved out by at most a millionth part where its number is long."""
    step = Fraction(max(1, abs(level).__ceil__()), 2**20)
    return normal, level if level.denominator < 2**20 else ((level / step).__floor__() + 1) * step


@cache
def directions(size: int, fine: int) -> tuple[Point, ...]:
    """Directions around: in the plane 4 * 2^fine, nearly even; in space those of the corners, edges and faces of a cube
    (6, 14, 26), then those with entries up to 2 (98), and 3."""
    if size == 2:
        ring: list[Point] = [(Fraction(x), Fraction(y)) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
        for _ in range(fine):
            ring = [p for k, a in enumerate(ring) for p in (a, between(a, ring[(k + 1) % len(ring)]))]
        return tuple(ring)
    largest = max(1, fine - 1)
    every = [v for v in product(range(-largest, largest + 1), repeat=3) if any(v)]
    wanted = [v for v in every if fine >= 2 or sum(map(abs, v)) in ((1,), (1, 3))[fine]]
    rays = {primitive((tuple(map(Fraction, v)), ZERO))[0] for v in wanted}
    return tuple(sorted(rays))


def between(a: Point, b: Point) -> Point:
    """The rational unit vector nearly in the middle of two, by the half of the angle's tangent."""
    x, y = (float(p + q) for p, q in zip(a, b, strict=True))
    far = (x * x + y * y) ** 0.5
    apart = max(abs(float(p - q)) for p, q in zip(a, b, strict=True))
    t = Fraction(y / (far + abs(x))).limit_denominator(int(16 / apart) + 16)
    return ((1 - t * t) / (1 + t * t) * (1 if x >= 0 else -1), 2 * t / (1 + t * t))


# --- two bodies ------------------------------------------------------------------------------------------
def common_point(one: Solid, other: Solid) -> Point | None:
    """A point of both (of two open bodies: None where they only touch), None where there is none."""
    p, q = nearest(one.corners, other.corners)
    away, reach = Fraction(dot(subtract(p, q), subtract(p, q))), one.radius + other.radius
    if away > reach**2 or (away == reach**2 and one.is_open and other.is_open):
        return None
    share = one.radius / reach if reach else ZERO
    return tuple(a + share * (b - a) for a, b in zip(p, q, strict=True))


def separators(one: Solid, other: Solid) -> tuple[Side, Side] | None:
    """Half-spaces around two bodies, with a strip between them; without one where they touch and one is open. None
    where none have been found."""
    p, q = nearest(one.corners, other.corners)
    for normal in _rounded(subtract(q, p)):
        turned = tuple(-x for x in normal)
        for bits in (64, 256):
            low, high = one.support(normal, bits), -other.support(turned, bits)
            if low < high:
                middle = short_between(low, high)
                return (normal, short_between(low, middle)), (turned, -short_between(middle, high))
            if low == high and (one.is_open or other.is_open):
                return (normal, low), (turned, -low)
    return None


def _rounded(normal: Point) -> Iterator[Point]:
    """A direction in short numbers, then in longer ones, then as it is."""
    largest = max(map(abs, normal))
    for most in ROUNDINGS if largest else ():
        yield tuple(Fraction(round(x / largest * most)) for x in normal)
    if largest:
        yield normal


def short_between(low: Fraction, high: Fraction) -> Fraction:
    """A short number strictly between two."""
    middle = (low + high) / 2
    return next((c for c in (middle.limit_denominator(m) for m in ROUNDINGS) if low < c < high), middle)


def beyond_side(body: Solid, side: Side) -> Point | None:
    """A point of a body in the plane of a side or behind it (of an open body: behind it); None where there is none.

    Where it touches the plane the point is exact, since the length of the normal is rational then."""
    (normal, level), square = side, Fraction(dot(side[0], side[0]))
    corner = max(body.corners, key=lambda c: dot(normal, c))
    missing = level - Fraction(dot(normal, corner))
    far = missing**2 - body.radius**2 * square if missing > 0 else Fraction(-1)
    if far > 0 or (far == 0 and body.is_open):
        return None
    share = max(missing, ZERO) / square
    return tuple(c + share * n for c, n in zip(corner, normal, strict=True))


def beyond_ball(body: Solid, ball: Solid) -> list[Point]:
    """Points of a body on the boundary of a ball or outside, one in each part that is there: the distance from the
    centre is largest in the directions of the corners."""
    centre, result = ball.corners[0], []
    for corner in body.corners:
        away = subtract(corner, centre) if corner != centre else tuple(Fraction(k == 0) for k in range(len(centre)))
        far = root_above(Fraction(dot(away, away)), 256)
        share = body.radius / far
        point = tuple(c + share * d for c, d in zip(corner, away, strict=True))
        square = Fraction(dot(subtract(point, centre), subtract(point, centre)))
        if square > ball.radius**2 or (square == ball.radius**2 and not body.is_open):
            result.append(point)
    return result


def point_solid(point: Point) -> Solid:
    """A point as a body without conditions."""
    return Solid("", (point,), (), ZERO, ())

"""Obstacles: closed sets in space as unions of polynomial conditions.

An obstacle is a union of pieces; a piece is an intersection of ``Constraint``s {p : f(p) >= 0} (or > 0). A margin m
replaces a body K by all points within distance m of K. For K a convex polytope that is the union of K, of the points
above and below a facet at most m away, of the cylinders of radius m around the edges and of the balls around the
corners; every interior point of the union is an interior point of one of these pieces. All of it is rational.

Lengths are in the unit of the problem (millimetres in the paper).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from math import lcm
from typing import Any

from bezier.curves.scalar import Terms, Vector, dot, exactly, sign, subtract, terms_product, terms_scaled, terms_sum
from bezier.obstacles.bodies import Body, Box, Cylinder, HalfSpaceBody, Rounded, around
from bezier.obstacles.polyhedron import Point, Polytope
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import Formula, Relation
from qe.proof.certificate import Certificate

Exponents = tuple[int, ...]
ZERO, ONE = Fraction(0), Fraction(1)


class ObstacleKind(Enum):
    """The word in the problem file."""

    BALL = "ball"
    BOX = "box"
    HALF_SPACE = "half_space"
    CYLINDER = "cylinder"
    CAPSULE = "capsule"
    POLYHEDRON = "polyhedron"
    FORMULA = "formula"


@dataclass(frozen=True, slots=True)
class Constraint:
    """{p : f(p) >= 0}, or f(p) > 0 where ``strict``; ``terms``: coefficient by exponents of x, y, z."""

    terms: tuple[tuple[Exponents, Fraction], ...]
    strict: bool = False

    @staticmethod
    def of(terms: Mapping[Exponents, Any], strict: bool = False) -> Constraint:
        """Zero coefficients are left out, the exponents are sorted."""
        return Constraint(tuple(sorted((e, Fraction(c)) for e, c in terms.items() if c)), strict)

    @property
    def degree(self) -> int:
        """The total degree."""
        return max((sum(e) for e, _ in self.terms), default=0)

    def value(self, p: Sequence[Any]) -> Any:
        """f(p), exactly."""
        x, y, z = p
        return sum((c * x**i * y**j * z**k for (i, j, k), c in self.terms), ZERO)

    @property
    def negated(self) -> Constraint:
        """That it does not hold."""
        return Constraint(tuple((e, -c) for e, c in self.terms), not self.strict)

    @property
    def relation(self) -> Relation:
        """How f compares with 0."""
        return Relation.GT if self.strict else Relation.GE

    def holds(self, value: Any) -> bool:
        """Whether a value of f satisfies the constraint."""
        return sign(value) > 0 if self.strict else sign(value) >= 0

    def formula(self, at: Sequence[Poly], scale: int = 1) -> Formula:
        """That the point with the coordinates ``at`` over ``scale`` satisfies it; the plane is where z = 0."""
        return atom(self.poly(at, scale), self.relation)

    def poly(self, at: Sequence[Poly], scale: int = 1) -> Poly:
        """A positive multiple of f there."""
        whole, zero, degree = lcm(*(c.denominator for _, c in self.terms)), at[0] * 0, self.degree
        total = zero
        for exponents, c in self.terms:
            term = at[0] ** 0 * int(c * whole * scale ** (degree - sum(exponents)))
            for power, coordinate in zip(exponents, (*at, zero)[:3], strict=True):
                term = term * coordinate**power
            total = total + term
        return total


@dataclass(frozen=True, slots=True)
class Piece:
    """An intersection of constraints; ``box``: a box around it, where one is known."""

    constraints: tuple[Constraint, ...]
    box: Box | None = None


@dataclass(frozen=True, slots=True)
class Obstacle:
    """The union of ``pieces``.

    ``margin`` is already included in the pieces and in the body.
    """

    name: str
    kind: ObstacleKind
    pieces: tuple[Piece, ...]
    body: Body | None = None
    """The convex body it is, where it is one."""
    box: Box | None = None
    """A box around everything."""
    margin: Fraction = ZERO
    stated: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """The table of the problem file, with exact numbers."""
    elimination: Any = field(default=None, compare=False, repr=False)
    """The engine's answer to the formula that it is given by, where that has quantifiers."""

    @property
    def top(self) -> Fraction | None:
        """The height of its highest point, None where there is none or where it is not known."""
        if isinstance(self.body, Cylinder):
            return None if self.body.top is None else self.body.top + self.body.radius
        return None if self.box is None else self.box[1][2]

    def contains(self, p: Sequence[Any]) -> bool:
        """Exact membership."""
        return any(all(c.holds(c.value(p)) for c in piece.constraints) for piece in self.pieces)


# --- constraints ------------------------------------------------------------------------------------


def half_space(normal: Sequence[Fraction], offset: Fraction) -> Constraint:
    """normal . p <= offset."""
    a, b, c = normal
    return Constraint.of({(0, 0, 0): offset, (1, 0, 0): -a, (0, 1, 0): -b, (0, 0, 1): -c})


def slab(normal: Sequence[Fraction], offset: Fraction, margin: Fraction) -> Constraint:
    """At most ``margin`` away from the plane normal . p = offset: (normal . p - offset)^2 <= margin^2 |normal|^2."""
    return _less_square([(normal, -offset)], margin * margin * Fraction(dot(normal, normal)))


def ball(centre: Point, radius: Fraction) -> Constraint:
    """|p - centre|^2 <= radius^2."""
    axes = [tuple(ONE if i == k else ZERO for i in range(3)) for k in range(3)]
    return _less_square([(axis, -c) for axis, c in zip(axes, centre, strict=True)], radius * radius)


def vertical_tube(centre: Sequence[Fraction], radius: Fraction) -> Constraint:
    """(x - c_x)^2 + (y - c_y)^2 <= radius^2."""
    return _less_square([((ONE, ZERO, ZERO), -centre[0]), ((ZERO, ONE, ZERO), -centre[1])], radius * radius)


def tube(a: Point, b: Point, radius: Fraction) -> Constraint:
    """At most ``radius`` away from the line through a and b: |p-a|^2 |d|^2 - ((p-a).d)^2 <= radius^2 |d|^2, d = b-a.

    The left side is |(p-a) x d|^2, a sum of three squares of linear forms.
    """
    x, y, z = subtract(b, a)
    rows = [(ZERO, z, -y), (-z, ZERO, x), (y, -x, ZERO)]
    return _less_square([(row, -Fraction(dot(row, a))) for row in rows], radius * radius * (x * x + y * y + z * z))


def ring(centre: Sequence[Fraction], height: Fraction, radius: Fraction, margin: Fraction) -> list[Constraint]:
    """The points at most ``margin`` away from a horizontal circle: the union of these sets.

    With R^2 = x^2 + y^2 about the centre, (R - radius)^2 + (z - height)^2 <= margin^2 means A <= 2 radius R for
    A = R^2 + (z - height)^2 + radius^2 - margin^2: A <= 0, which needs margin >= radius, or A^2 <= 4 radius^2 R^2.
    """
    across = terms_sum(_square((ONE, ZERO, ZERO), -centre[0]), _square((ZERO, ONE, ZERO), -centre[1]))
    a = terms_sum(across, _square((ZERO, ZERO, ONE), -height), {(0, 0, 0): radius * radius - margin * margin})
    torus = Constraint.of(terms_sum(terms_scaled(4 * radius * radius, across), terms_scaled(-1, terms_product(a, a))))
    return [torus, Constraint.of(terms_scaled(-1, a))] if margin >= radius else [torus]


def _less_square(rows: Sequence[tuple[Sequence[Fraction], Fraction]], bound: Fraction) -> Constraint:
    """sum of (row . p + constant)^2 <= bound."""
    total = terms_sum(*(_square(row, constant) for row, constant in rows))
    return Constraint.of(terms_sum({(0, 0, 0): bound}, terms_scaled(-1, total)))


def _square(row: Sequence[Fraction], constant: Fraction) -> Terms:
    a, b, c = row
    form: Terms = {(0, 0, 0): constant, (1, 0, 0): a, (0, 1, 0): b, (0, 0, 1): c}
    return terms_product(form, form)


# --- bodies as pieces -------------------------------------------------------------------------------


def pieces_of(body: Body) -> tuple[Piece, ...]:
    """The pieces whose union is the body."""
    match body:
        case Rounded(core, radius):
            return tuple(_rounded(core, radius))
        case HalfSpaceBody(normal, offset, margin):
            inside = Piece((half_space(normal, offset),))
            return (inside, Piece((slab(normal, offset, margin),))) if margin else (inside,)
        case Cylinder():
            return tuple(_cylinder(body))


def _rounded(core: Polytope, radius: Fraction) -> list[Piece]:
    pieces = []
    if core.facets:
        boundaries = tuple(half_space(f.normal, f.offset) for f in core.facets)
        pieces.append(Piece(boundaries, around(core.corners, ZERO)))
    if not radius:
        return pieces
    for facet in core.facets:
        sides = (half_space(normal, offset) for normal, offset in facet.boundaries)
        box = around([core.corners[i] for i in facet.corners], radius)
        pieces.append(Piece((slab(facet.normal, facet.offset, radius), *sides), box))
    for i, j in core.edges:
        a, b = core.corners[i], core.corners[j]
        along = subtract(b, a)
        back = tuple(-x for x in along)
        ends = half_space(along, Fraction(dot(along, b))), half_space(back, Fraction(dot(back, a)))
        pieces.append(Piece((tube(a, b, radius), *ends), around((a, b), radius)))
    pieces += [Piece((ball(corner, radius),), around((corner,), radius)) for corner in core.corners]
    return pieces


def _cylinder(body: Cylinder) -> list[Piece]:
    """Without margin one piece; with margin the wider tube, the higher tube, and a torus around each rim."""
    centre, m = body.centre, body.radius
    up, down = (ZERO, ZERO, ONE), (ZERO, ZERO, -ONE)

    def between(extra: Fraction) -> list[Constraint]:
        result = [] if body.top is None else [half_space(up, body.top + extra)]
        return result if body.bottom is None else [*result, half_space(down, extra - body.bottom)]

    pieces = [Piece((vertical_tube(centre, body.tube_radius + m), *between(ZERO)), body.box)]
    rims = [h for h in (body.bottom, body.top) if h is not None]
    if m and rims:
        pieces.append(Piece((vertical_tube(centre, body.tube_radius), *between(m)), body.box))
        pieces += [Piece((c,), body.box) for h in rims for c in ring(centre, h, body.tube_radius, m)]
    return pieces


def from_body(
    name: str, kind: ObstacleKind, body: Body, margin: Fraction = ZERO, stated: Mapping[str, Any] | None = None
) -> Obstacle:
    """The obstacle that is this body (which already includes the margin)."""
    return Obstacle(name, kind, pieces_of(body), body, body.box, margin, stated or {})


AXES = ("x", "y", "z")


@dataclass(frozen=True, slots=True)
class PointInside:
    """The given point ``name`` at ``place`` belongs to a piece of the obstacle."""

    name: str
    place: tuple[Fraction, ...]
    obstacle: Obstacle
    piece: int

    @property
    def label(self) -> str:
        """Of the certificate."""
        return f"{self.name} in {self.obstacle.name}"

    def in_words(self) -> str:
        """As a clause."""
        return f"the {self.name} ({', '.join(map(str, self.place))}) lies in the obstacle {self.obstacle.name}"

    def certificate(self) -> Certificate:
        """That the conditions of the piece hold at the place."""
        constraints, at = self.obstacle.pieces[self.piece].constraints, list(map(Ring.of(AXES).var, AXES))
        return Certificate.witness(conj(c.formula(at) for c in constraints), AXES, self.place)


def inside(points: Mapping[str, Vector], obstacles: Sequence[Obstacle]) -> tuple[PointInside, ...]:
    """Every point with every obstacle that it belongs to, exactly; touching a closed obstacle is belonging to it."""
    result = []
    for name, point in points.items():
        place = tuple(map(exactly, point))
        for obstacle in obstacles:
            held = (all(c.holds(c.value(place)) for c in piece.constraints) for piece in obstacle.pieces)
            number = next((k for k, holds in enumerate(held) if holds), None)
            if number is not None:
                result.append(PointInside(name, place, obstacle, number))
    return tuple(result)

"""Convex bodies with finitely many corners, exactly: points, segments and full polyhedra with rational corners.

A polyhedron is given by half-spaces or by corners; both lead to the same value, which knows corners, edges and
facets.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import cast

from bezier.curves.scalar import dot, subtract
from bezier.proofs.square_roots import cross
from qe.convex.cone import Cone
from qe.errors import InputError
from qe.exact.quadratic_form import solve_linear

Point = tuple[Fraction, ...]
MAX_PARTS = 40
"""Most half-spaces or corners of a polyhedron."""


@dataclass(frozen=True, slots=True)
class Facet:
    """A face of dimension 2: ``normal`` . p <= ``offset`` holds in the body, with equality exactly at ``corners``.

    ``normal`` has coprime integer entries and points outwards; ``corners`` are indices, in order around the facet.
    """

    normal: Point
    offset: Fraction
    corners: tuple[int, ...]
    boundaries: tuple[tuple[Point, Fraction], ...]
    """(n, c) for each side; n . p <= c says that p is on the facet's side of the upright plane there."""


@dataclass(frozen=True, slots=True)
class Polytope:
    """The convex hull of ``corners``: a point, a segment, or a body with interior, then with ``facets``.

    Invariant: every corner is an extreme point; ``edges`` are pairs of indices.
    """

    corners: tuple[Point, ...]
    edges: tuple[tuple[int, int], ...] = ()
    facets: tuple[Facet, ...] = ()


def point(p: Point) -> Polytope:
    """The body that is one point."""
    return Polytope((p,))


def segment(a: Point, b: Point) -> Polytope:
    """The segment from a to b, a != b."""
    return Polytope((a, b), ((0, 1),))


def parallelepiped(corner: Point, sides: Sequence[Point]) -> Polytope:
    """The body corner + [0, 1] s_1 + [0, 1] s_2 + [0, 1] s_3. Raises ``InputError`` if it lies in a plane."""
    result = []
    for used in itertools.product((0, 1), repeat=3):
        result.append(tuple(c + sum(u * s[i] for u, s in zip(used, sides, strict=True)) for i, c in enumerate(corner)))
    return from_corners(result)


def from_half_spaces(half_spaces: Sequence[tuple[Point, Fraction]]) -> Polytope:
    """The body {p : n . p <= c for all (n, c)}.

    Raises ``InputError`` when it is empty, in a plane or unbounded.
    """
    cone = Cone(4)
    for normal in ((0, 0, 0, -1), *(whole((*n, -c)) for n, c in half_spaces)):
        cone.cut(normal)
    corners = [tuple(Fraction(c, v[3]) for c in v[:3]) for v in cone.rays if v[3]]
    if cone.lines or len(corners) < len(cone.rays):
        raise InputError("an unbounded set of half-spaces")
    if not corners:
        raise InputError("an empty set of half-spaces")
    return from_corners(corners)


def from_corners(points: Sequence[Point]) -> Polytope:
    """The convex hull of points. Raises ``InputError`` when it lies in a plane.

    The half-spaces that hold all points are a cone, and its rays are those of the facets.
    """
    distinct, cone = sorted(set(points)), Cone(4)
    rows = [whole((*p, 1)) for p in distinct]
    for p in rows:
        cone.cut(p)
    if cone.lines:
        raise InputError("a set of corners in one plane")
    on = {side: tuple(i for i, p in enumerate(rows) if not dot(side, p)) for side in cone.rays}
    ordered = sorted(on.items(), key=lambda item: item[1])
    return _with_edges(distinct, {(n := _primitive(side[:3]), dot(n, distinct[i[0]])): i for side, i in ordered})


def from_sides(corners: Sequence[Point], sides: Sequence[tuple[Point, Fraction]]) -> Polytope:
    """The body with just these corners and these facets (n, c): n . p <= c."""
    planes = {}
    for n, c in sides:
        normal = _primitive(n)
        on = tuple(i for i, p in enumerate(corners) if dot(n, p) == c)
        planes[normal, Fraction(dot(normal, corners[on[0]]))] = on
    return _with_edges(list(corners), planes)


def _with_edges(points: list[Point], planes: dict[tuple[Point, Fraction], tuple[int, ...]]) -> Polytope:
    """Extreme points lie in three facets, edges join two extreme points that share two facets."""
    shared = {i: [on for on in planes.values() if i in on] for i in range(len(points))}
    extreme = [i for i in shared if len(shared[i]) >= 3]
    place = {i: k for k, i in enumerate(extreme)}
    pairs = [
        (i, j) for i, j in itertools.combinations(extreme, 2) if sum(i in on and j in on for on in planes.values()) >= 2
    ]
    facets = []
    for (normal, offset), on in planes.items():
        sides = [(i, j) for i, j in pairs if i in on and j in on]
        loop = _around(sides)
        boundaries = _boundaries(normal, [points[i] for i in loop])
        facets.append(Facet(normal, offset, tuple(place[i] for i in loop), boundaries))
    corners = tuple(points[i] for i in extreme)
    return Polytope(corners, tuple((place[i], place[j]) for i, j in pairs), tuple(facets))


def _around(sides: list[tuple[int, int]]) -> list[int]:
    """The corners of a polygon in order, from its sides."""
    order, rest = list(sides[0]), sides[1:]
    while rest:
        following = next(side for side in rest if order[-1] in side)
        rest.remove(following)
        order.append(following[0] if following[1] == order[-1] else following[1])
    return order[:-1]


def _boundaries(normal: Point, corners: Sequence[Point]) -> tuple[tuple[Point, Fraction], ...]:
    """The upright planes over the sides of a facet, its inner side where n . p <= c."""
    result = []
    for k, a in enumerate(corners):
        b, inner = corners[(k + 1) % len(corners)], corners[(k + 2) % len(corners)]
        n = cross(subtract(b, a), normal)
        if dot(n, inner) > dot(n, a):
            n = tuple(-x for x in n)
        result.append((n, Fraction(dot(n, a))))
    return tuple(result)


def nearest(ones: Sequence[Point], others: Sequence[Point]) -> tuple[Point, Point]:
    """Nearest points of two convex hulls, exactly: Wolfe's algorithm for the least norm in the hull of all differences
    (Wolfe, Finding the nearest point in a polytope, 1976), which ends after finitely many steps."""
    chosen, weights = [(0, 0)], [Fraction(1)]
    while True:
        differences = [subtract(ones[i], others[j]) for i, j in chosen]
        x = _mixed(differences, weights)
        i = min(range(len(ones)), key=lambda k: dot(x, ones[k]))
        j = max(range(len(others)), key=lambda k: dot(x, others[k]))
        if dot(x, subtract(ones[i], others[j])) >= dot(x, x):
            pick = ([ones[i] for i, _ in chosen], [others[j] for _, j in chosen])
            return _mixed(pick[0], weights), _mixed(pick[1], weights)
        chosen, weights = [*chosen, (i, j)], [*weights, Fraction(0)]
        differences.append(subtract(ones[i], others[j]))
        while True:
            best = _least(differences)
            if min(best) >= 0:
                weights = best
                break
            step = min(w / (w - b) for w, b in zip(weights, best, strict=True) if b < 0)
            weights = [w + step * (b - w) for w, b in zip(weights, best, strict=True)]
            kept = [k for k, w in enumerate(weights) if w]
            chosen, weights = [chosen[k] for k in kept], [weights[k] for k in kept]
            differences = [differences[k] for k in kept]


def _mixed(points: Sequence[Point], weights: Sequence[Fraction]) -> Point:
    return tuple(sum(w * c for w, c in zip(weights, axis, strict=True)) for axis in zip(*points, strict=True))


def _least(points: Sequence[Point]) -> list[Fraction]:
    """Weights with sum 1 of the point of least norm in the affine hull of independent points."""
    base, *rest = points
    spans = [subtract(p, base) for p in rest]
    rows, right = [[Fraction(dot(a, b)) for b in spans] for a in spans], [-Fraction(dot(a, base)) for a in spans]
    solution = solve_linear(rows, right, len(spans))
    assert solution is not None
    shares = cast(tuple[Fraction, ...], solution.particular)
    return [1 - sum(shares, Fraction(0)), *shares]


def _primitive(direction: Sequence[Fraction | int]) -> Point:
    """The positive multiple with coprime integer entries."""
    entries = whole(direction)
    return tuple(Fraction(x, gcd(*entries)) for x in entries)


def whole(numbers: Sequence[Fraction | int]) -> tuple[int, ...]:
    """A positive multiple with integer entries."""
    common = lcm(*(x.denominator for x in numbers))
    return tuple(int(x * common) for x in numbers)

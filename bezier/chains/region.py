"""Where a point of a chain may be, and by how much it may move before there is no chain: both sides proved.

The places of a given point that leave a chain (the others as they are), and those of a control point in all chains,
are the projection of a convex set. Each corner of the inner polytope has a chain as its witness. Each half-space of the
outer one has multipliers: weak duality for a linear objective (``bezier.chains.proof``). The normals of the outer
half-spaces are those of the inner facets: the outer polytope lies in the inner one, enlarged by 1 + gap.
Facets are refined where the gap is largest (sandwich algorithm; Rote, Computing 48, 1992).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any

from bezier.chains import proposals
from bezier.chains.chain import Chain, freed, requirements
from bezier.chains.form import Affine, Form, Point, Requirement, Solved, linear_form, weighted_sum
from bezier.chains.proof import Contradiction, decided, lower_bound, near_optimum, rational_weights, refuted, witness
from bezier.curves.enclosure import root_above, root_below
from bezier.curves.scalar import described, dot
from bezier.obstacles.polyhedron import whole
from qe.convex.cone import Cone, Vector
from qe.convex.simplex import Least, linear_optimum
from qe.errors import InputError, Unable
from qe.proof.certificate import Certificate

_ZERO, _ONE = Fraction(0), Fraction(1)
MOST = 600
"""Directions that are looked at."""
MOST_NEAR = 250
"""Of a radius of validity, where all directions may be alike."""
USUAL = {2: Fraction(1, 1000), 3: Fraction(1, 20)}
"""The gap by the dimension."""
NARROW = Fraction(1, 10**6)
"""Of a radius of validity, relative."""


@dataclass(frozen=True, slots=True)
class Support:
    """normal . place <= offset for all chains, by the multipliers ``weights``; at the free points ``at`` the place is
    ``corner``, nearly farthest in this direction."""

    normal: Point
    offset: Fraction
    weights: tuple[Fraction, ...]
    stationary: tuple[Point, ...]
    at: tuple[Point, ...]
    corner: Point


def placed(chain: Chain, name: str) -> tuple[Chain, Solved, Affine]:
    """The chain with this point free, and the point in it. Raises ``InputError``, ``Unable``."""
    if chain.max_length is not None or chain.max_curvature is not None or chain.free_total is not None:
        raise InputError("region: expected a chain with given durations, without bounds on length and curvature")
    moved = replace(chain, free=name)
    if name in chain.moving:
        return moved, moved.solved, freed(moved, moved.solved)[0]
    if (matched := re.fullmatch(r"C(\d{1,3})\.(\d)", name)) and 0 < int(matched[1]) <= chain.pieces:
        curve, j = int(matched[1]) - 1, int(matched[2])
    else:
        curve, j = 0, chain.degree + 1
    if j > chain.degree:
        known = f"{', '.join(chain.moving)}, or C1.0 to C{chain.pieces}.{chain.degree}"
        raise InputError(f"region: expected one of {known}, found {name}")
    solved = chain.solved
    place = solved.controls[curve][j]
    if not place.coefficients:
        raise InputError(f"region: expected a point that may move, found {name}")
    return chain, solved, place


@dataclass(frozen=True)
class Places:
    """What is looked at: the chain with its free points, its conditions, and the place as a combination of them."""

    chain: Chain
    solved: Solved
    rows: tuple[Requirement, ...]
    place: Affine
    inside: tuple[Point, ...]

    @staticmethod
    def of(chain: Chain, name: str) -> Places:
        """``name``: "start", "via[0]", "goal", or a control point such as "C2.1". Raises ``InputError``, ``Unable``."""
        freed, solved, place = placed(chain, name)
        rows = requirements(freed, solved)
        inside = decided(freed, solved, rows)
        if isinstance(inside, Contradiction):
            raise Unable(f"there is no chain, wherever {name} is")
        return Places(freed, solved, tuple(row for row in rows if not row.form.is_constant), place, inside)

    def support(self, normal: Point) -> Support:
        """The farthest places in a direction, from both sides. Raises ``Unable``."""
        size, objective = self.solved.size, linear_form(tuple(-c for c in normal), self.place)
        if not any(row.squares for row in self.rows):
            return self._vertex(normal, objective)
        proposal = proposals.best(self.chain, size, self.rows, objective)
        if proposal is None:
            raise Unable("no farthest place was proposed")
        multipliers = rational_weights(proposal.weights)
        value, stationary, weights = lower_bound(self.chain, size, objective, self.rows, multipliers)
        points = [*near_optimum(self.chain, proposal, self.inside, self.rows, objective), self.inside]
        at = min(points, key=objective.value)
        return Support(normal, -value, tuple(weights), stationary, at, self.place.at(at))

    def _vertex(self, normal: Point, objective: Form) -> Support:
        """The same where half-spaces are all conditions: both sides agree."""
        size, d = self.solved.size, self.chain.dimension
        forms = [row.form.quadratic(size, d) for row in self.rows]
        least, falls = linear_optimum(objective.quadratic(size, d), forms, check=lambda: None)
        if falls is not None or not isinstance(least, Least):
            raise Unable("it is unbounded")
        flat = tuple(map(Fraction, least.dual))
        at = tuple(flat[i : i + d] for i in range(0, len(flat), d))
        weights = tuple(Fraction(least.weights.get(i, _ZERO)) for i in range(len(forms)))
        return Support(normal, -objective.value(at), weights, at, at, self.place.at(at))

    def proof(self, support: Support) -> Certificate:
        """That no chain has the place beyond this half-space."""
        beyond = beyond_form(self.place, support.normal, support.offset)
        chosen = [(w, row.form) for w, row in zip(support.weights, self.rows, strict=True) if w]
        forms, weights = [*(f for _, f in chosen), beyond], [*(w for w, _ in chosen), _ONE]
        return refuted(self.chain, self.solved.size, forms, weights, support.stationary, strict=1)

    def witness(self, corner: Point, free: Sequence[Point]) -> Certificate:
        """A chain, that of these free points, with the place at the corner."""
        forms = [*(r.form for r in self.rows), *at_form(self.place, corner)]
        return witness(self.chain, self.solved.size, forms, free)


def at_form(place: Affine, point: Point) -> list[Form]:
    """Forms that are all <= 0 where the place is this point."""
    d = len(point)
    units = [tuple(_ONE if i == k else _ZERO for i in range(d)) for k in range(d)]
    here = [linear_form(u, place).shifted(-c) for u, c in zip(units, point, strict=True)]
    return [weighted_sum([(s, form)]) for form in here for s in (_ONE, -_ONE)]


def beyond_form(place: Affine, normal: Point, offset: Fraction) -> Form:
    """A form that is < 0 where normal . place > offset."""
    return linear_form(tuple(-c for c in normal), place).shifted(offset)


@dataclass(frozen=True)
class PointRegion:
    """``inner``: corners of a polytope in which every place has a chain; ``outer``: (a, b) with a . p <= b for all
    places that have one. The outer polytope lies in the inner one, enlarged by 1 + ``gap`` about its centre."""

    name: str
    inner: tuple[Point, ...]
    outer: tuple[tuple[Point, Fraction], ...]
    gap: Fraction
    places: Places
    supports: tuple[Support, ...]
    sides: tuple[Support, ...]

    @property
    def certificate(self) -> Certificate:
        """A witness for each corner, multipliers for each half-space."""
        corners = [(at_label(self.name, s.corner), self.places.witness(s.corner, s.at)) for s in self.supports]
        sides = [(beyond_label(self.name, s), self.places.proof(s)) for s in self.sides]
        return Certificate.bundle([*corners, *sides])

    def to_json(self) -> dict[str, Any]:
        """The corners and the half-spaces, with exact numbers."""
        outer = [{"normal": [str(c) for c in n], "offset": str(b)} for n, b in self.outer]
        inner = [[described(c) for c in p] for p in self.inner]
        return {"of": self.name, "inner": inner, "outer": outer, "gap": described(self.gap)}

    def __str__(self) -> str:
        return (
            f"{self.name}: {len(self.inner)} corners, each with a chain; "
            f"no place is more than {100 * float(self.gap):.2g} % farther from the centre, proved"
        )


@dataclass(frozen=True)
class Validity:
    """A point may move by ``low`` in every direction, and by more than ``high`` not in the direction ``towards``.
    ``certificate`` proves both."""

    name: str
    low: Fraction
    high: Fraction
    towards: Point
    certificate: Certificate

    def __str__(self) -> str:
        low, high = f"{float(self.low):.9g}", f"{float(self.high):.9g}"
        return f"{self.name} may move by {low} in every direction; by more than {high} not in one of them"


def at_label(name: str, corner: Point) -> str:
    """Of a witness."""
    return f"a chain has {name} at {', '.join(map(str, corner))}"


def beyond_label(name: str, support: Support) -> str:
    """Of a half-space that no chain reaches beyond."""
    return f"no chain has {name} beyond {', '.join(map(str, (*support.normal, support.offset)))}"


@dataclass(frozen=True)
class _Sandwich:
    """Supports so far; the hull of their corners, and the supports in the direction of facets."""

    supports: list[Support]
    hull: Hull
    known: dict[Facet, Support]
    centre: Point

    @property
    def corners(self) -> tuple[Support, ...]:
        """One for each corner of the hull."""
        return tuple({(s := self.supports[i]).corner: s for i in self.hull.corners}.values())


def _begun(places: Places) -> _Sandwich:
    """The supports along the axes. Raises ``Unable``."""
    d = places.chain.dimension
    axes = [tuple(Fraction(s if i == k else 0) for i in range(d)) for k in range(d) for s in (1, -1)]
    supports = [places.support(axis) for axis in axes]
    corners, hull = [s.corner for s in supports], Hull(d)
    for corner in corners:
        hull.add(corner)
    if not hull.facets:
        raise Unable("the places have no interior, or hardly any")
    centre = tuple(sum(c, _ZERO) / len(corners) for c in zip(*corners, strict=True))
    return _Sandwich(supports, hull, {}, centre)


def _look(places: Places, state: _Sandwich, side: Facet, enough: Callable[[Support], bool]) -> None:
    """The support in the direction of a facet, whose corner joins the hull unless it is near ``enough``."""
    support = places.support(side.normal)
    if enough(support) or side.beyond(support.corner) <= 0:
        state.known[side] = support
    else:
        state.supports.append(support)
        state.hull.add(support.corner)


def region(chain: Chain, name: str, accuracy: Fraction | None = None) -> PointRegion:
    """Where this point may be, with a gap of at most ``accuracy`` (0.001 in the plane, 0.05 in space). Raises
    ``InputError`` for a name of no point, ``Unable``."""
    places = Places.of(chain, name)
    target = USUAL[chain.dimension] if accuracy is None else accuracy
    state = _begun(places)

    def gap(side: Facet, support: Support) -> Fraction:
        return (support.offset - side.offset) / -side.beyond(state.centre)

    for _ in range(MOST):
        side = next((f for f in state.hull.facets if f not in state.known), None)
        if side is None:
            break
        _look(places, state, side, partial(lambda f, s: gap(f, s) <= target, side))
    else:
        raise Unable(f"the gap was not reached in {MOST} directions")
    corners, sides = state.corners, tuple(state.known[f] for f in state.hull.facets)
    largest = max(gap(f, state.known[f]) for f in state.hull.facets)
    outer = tuple((s.normal, s.offset) for s in sides)
    return PointRegion(name, tuple(s.corner for s in corners), outer, largest, places, corners, sides)


def validity(chain: Chain, name: str) -> Validity:
    """By how much this given point may move. Where many directions are alike, the two sides may be wider than a
    millionth. Raises ``InputError``, and ``Unable``: also where there is no chain as it is."""
    if name not in chain.point_names:
        raise InputError(f"validity: expected one of {', '.join(chain.point_names)}, found {name}")
    places, here = Places.of(chain, name), chain.points[chain.point_names.index(name)]
    state = _begun(places)
    for _ in range(MOST_NEAR):
        low = min(state.hull.facets, key=lambda f: -_away(f.normal, f.offset, here))
        ways = [*state.supports, *state.known.values()]
        high = min(ways, key=lambda s: -_away(s.normal, s.offset, here))
        if _away(high.normal, high.offset, here) > 0:
            raise Unable(f"there is no chain with {name} where it is")
        if _away(low.normal, low.offset, here) <= _away(high.normal, high.offset, here) * (1 - float(NARROW) / 2):
            break
        if low in state.known:
            break
        _look(places, state, low, lambda _: False)
    least = min(root_below(f.beyond(here) ** 2 / dot(f.normal, f.normal)) for f in state.hull.facets)
    most = root_above((high.offset - Fraction(dot(high.normal, here))) ** 2 / dot(high.normal, high.normal))
    if any(f.beyond(here) > 0 for f in state.hull.facets):
        raise Unable(f"there may be no chain with {name} where it is")
    proofs = [(at_label(name, s.corner), places.witness(s.corner, s.at)) for s in state.corners]
    proofs.append((beyond_label(name, high), places.proof(high)))
    return Validity(name, least, most, high.normal, Certificate.bundle(proofs))


def _away(normal: Point, offset: Fraction, here: Point) -> float:
    """How far outside a half-space a point lies, in floating point."""
    length: float = float(dot(normal, normal)) ** 0.5
    return float(Fraction(dot(normal, here)) - offset) / length


# --- convex hulls -------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Facet:
    """The hull has normal . p <= offset."""

    normal: Point
    offset: Fraction

    @staticmethod
    def of(ray: Vector) -> Facet:
        """normal . p - offset <= 0, the largest coordinate of the normal 1 or -1."""
        largest = max(map(abs, ray[:-1]))
        return Facet(tuple(Fraction(c, largest) for c in ray[:-1]), Fraction(-ray[-1], largest))

    def beyond(self, point: Point) -> Fraction:
        """Positive outside: normal . point - offset."""
        return Fraction(dot(self.normal, point)) - self.offset


class Hull:
    """The convex hull of points, one after the other: the half-spaces that hold all points are a cone, and its rays are
    those of the facets. ``facets``: none until the points do not lie in one plane."""

    def __init__(self, dimension: int) -> None:
        self.cone = Cone(dimension + 1)
        self.facets: list[Facet] = []

    def add(self, point: Point) -> None:
        """One more point."""
        known = dict(zip(self.cone.rays, self.facets, strict=False))
        self.cone.cut(whole((*point, 1)))
        self.facets = [] if self.cone.lines else [known.get(ray) or Facet.of(ray) for ray in self.cone.rays]

    @property
    def corners(self) -> list[int]:
        """The numbers of extreme points, in as many facets as the space has dimensions; of equal ones all."""
        on = Counter(i for bits in self.cone.rays.values() for i in range(self.cone.count) if bits >> i & 1)
        return sorted(i for i, count in on.items() if count >= self.cone.size - 1)

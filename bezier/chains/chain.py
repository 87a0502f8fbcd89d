"""A chain of Bézier curves through via points as a value, and its control points as combinations of free points.

A curve of degree d with duration T has at its ends the derivatives d!/(d-j)! Δ^j P / T^j in time (Farin, "Curves and
Surfaces for CAGD", 5.3), so that a join is C^c in time where Δ^j P / T^j agree for j = 1, ..., c. These equations are
solved over Q; what they leave free is free.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import comb, factorial

from bezier.chains.form import Affine, Form, Point, affine_sum, linear_form, squared_length, weighted_sum
from bezier.curves.curve import Bezier
from qe.errors import InputError
from qe.exact.quadratic_form import echelon

MOST_VIA = 50
_ZERO, _ONE = Fraction(0), Fraction(1)


class Objective(Enum):
    """What is to be least."""

    MIDDLE_LEGS = "middle legs"
    """The sum of the squared legs of the control polygons of all curves between via points, as in formula (7)."""
    LEGS = "legs"
    """That of all curves."""
    ACCELERATION = "acceleration"
    """The integral of the squared acceleration over time."""
    JERK = "jerk"
    """The integral of its squared derivative."""
    SNAP = "snap"
    """The integral of its squared second derivative."""

    @property
    def order(self) -> int:
        """Of the derivative whose square is integrated; 0 for legs."""
        return {Objective.ACCELERATION: 2, Objective.JERK: 3, Objective.SNAP: 4}.get(self, 0)


KINDS = ((2, 1), (3, 1), (3, 2), (5, 2))
"""Degree and continuity of the chains that there are."""


class Ends(Enum):
    """What is asked of the ends."""

    FREE = "free"
    ZERO = "zero"
    """Velocity zero, and with degree 5 acceleration zero."""


@dataclass(frozen=True)
class Chain:
    """``points``: start, via points, goal (of a closed chain: all points, the last joined with the first).

    Every control point has to lie in the ball about ``centre`` with this ``radius_squared``, where it is given, and in
    all ``half_spaces``: (a, b) for a . p >= b. ``free_via``: the number of a point that may move.
    ``max_length`` (mm) of all curves together, ``max_curvature`` (1/mm). ``free_total``: the sum of free durations.
    ``velocities`` at the start and at the goal (mm/s), where these are fixed.
    """

    points: tuple[Point, ...]
    degree: int = 3
    continuity: int = 2
    durations: tuple[Fraction, ...] = ()
    ends: Ends = Ends.FREE
    closed: bool = False
    objective: Objective = Objective.LEGS
    centre: Point = ()
    radius_squared: Fraction | None = None
    half_spaces: tuple[tuple[Point, Fraction], ...] = ()
    free_via: int | None = None
    max_length: Fraction | None = None
    max_curvature: Fraction | None = None
    free_total: Fraction | None = None
    velocities: tuple[Point, ...] = ()

    def __post_init__(self) -> None:
        if (self.degree, self.continuity) not in KINDS:
            raise InputError("chain: degree 2 with continuity 1, degree 3 with 1 or 2, or degree 5 with 2 expected")
        if len(self.points) < 3 or len({len(p) for p in self.points}) != 1:
            raise InputError("chain: at least three points of one dimension expected")
        if len(self.points) > MOST_VIA + 2:
            raise InputError(f"chain: at most {MOST_VIA} via points expected, found {len(self.points) - 2}")
        if any(a == b for a, b in pairwise(self.corners)):
            raise InputError("chain: neighbouring points that differ expected, found two that are equal")
        if self.durations and (len(self.durations) != self.pieces or min(self.durations) <= 0):
            raise InputError(f"chain: {self.pieces} durations above 0 expected")
        if self.free_total is not None and (self.durations or self.free_total <= 0):
            raise InputError("chain: a sum of free durations above 0 expected, and no durations")
        if self.closed and self.ends is not Ends.FREE:
            raise InputError("chain: a closed chain has no ends")
        if self.velocities and (self.closed or self.ends is not Ends.FREE or len(self.velocities) != 2):
            raise InputError("chain: velocities at the start and at the goal of an open chain with free ends expected")
        if self.objective.order > self.degree:
            raise InputError(f"chain: a degree of at least {self.objective.order} expected for {self.objective.value}")
        if self.radius_squared is not None and self.radius_squared <= 0:
            raise InputError("chain: a radius above zero expected")

    @property
    def dimension(self) -> int:
        """Of the points."""
        return len(self.points[0])

    @property
    def point_names(self) -> tuple[str, ...]:
        """What the points are called: "start", "via[0]", ..., "goal"."""
        via = len(self.points) - (1 if self.closed else 2)
        return ("start", *(f"via[{i}]" for i in range(via)), *(() if self.closed else ("goal",)))

    @property
    def corners(self) -> tuple[Point, ...]:
        """Where the curves begin and end, in order."""
        return (*self.points, self.points[0]) if self.closed else self.points

    @property
    def pieces(self) -> int:
        """The number of curves."""
        return len(self.corners) - 1

    @property
    def times(self) -> tuple[Fraction, ...]:
        """The durations of the curves, 1 each where none are given."""
        return self.durations or (_ONE,) * self.pieces

    @cached_property
    def solved(self) -> Solved | None:
        """The control points; None where the joins and ends contradict each other."""
        return _solved(self)


@dataclass(frozen=True, slots=True)
class Solved:
    """The control points of each curve as combinations of ``size`` free points."""

    size: int
    controls: tuple[tuple[Affine, ...], ...]

    def curves(self, free: Sequence[Point]) -> tuple[Bezier, ...]:
        """The curves for these free points."""
        return tuple(Bezier(tuple(p.at(free) for p in piece)) for piece in self.controls)


@dataclass(frozen=True, slots=True)
class Requirement:
    """``form`` <= 0. ``squares``: with it sum w |p|² is bounded; none where the form is linear. ``is_ball``: a larger
    radius is a wider condition."""

    label: str
    form: Form
    squares: tuple[tuple[Fraction, Affine], ...] = ()
    is_ball: bool = False
    detail: str = ""
    """How to make it again, where the chain alone does not say it: behind the labels of proofs that use it."""

    @property
    def right(self) -> Fraction:
        """The bound of the sum of squares."""
        squares = ((w, squared_length(p).constant) for w, p in self.squares)
        return sum((w * c for w, c in squares), -self.form.constant)


def requirements(chain: Chain, solved: Solved) -> tuple[Requirement, ...]:
    """Of all control points, those that several curves share once."""
    result = []
    for k, piece in enumerate(solved.controls):
        last = k == chain.pieces - 1 and not chain.closed
        for j, point in enumerate(piece if last else piece[:-1]):
            corner = chain.point_names[(k + (j > 0)) % len(chain.points)]
            name = f"C{k + 1}.{j}" if 0 < j < chain.degree else corner
            if chain.radius_squared is not None:
                away = affine_sum(((_ONE, point), (-_ONE, Affine({}, chain.centre))))
                form = squared_length(away).shifted(-chain.radius_squared)
                result.append(Requirement(f"{name} in the ball", form, ((_ONE, away),), is_ball=True))
            for i, (normal, offset) in enumerate(chain.half_spaces):
                form = linear_form(tuple(-c for c in normal), point).shifted(offset)
                result.append(Requirement(f"{name} in half_space[{i}]", form))
    return tuple(result)


def objective_form(chain: Chain, solved: Solved) -> Form:
    """What is to be least."""
    if chain.free_via is not None:
        corner = solved.controls[chain.free_via % chain.pieces][0 if chain.free_via < chain.pieces else -1]
        return squared_length(affine_sum(((_ONE, corner), (-_ONE, Affine({}, chain.points[chain.free_via])))))
    order, pieces = chain.objective.order, solved.controls
    if not order:
        if chain.objective is Objective.MIDDLE_LEGS and not chain.closed:
            pieces = pieces[1:-1]
        legs = (_difference(p[j : j + 2]) for p in pieces for j in range(chain.degree))
        return weighted_sum((_ONE, squared_length(leg)) for leg in legs)
    parts = [(w, f) for p, t in zip(pieces, chain.times, strict=True) for w, f in _energy(p, t, order)]
    return weighted_sum(parts)


def _energy(points: Sequence[Affine], time: Fraction, order: int) -> list[tuple[Fraction, Form]]:
    """The integral of the squared derivative: with B-coefficients c_i of degree m that is sum G_ij c_i.c_j and
    G_ij = C(m,i) C(m,j) / (C(2m,i+j) (2m+1)) (Farin, 6.5), by polarisation."""
    degree = len(points) - 1
    m, scale = degree - order, Fraction(factorial(degree), factorial(degree - order)) / time**order
    slopes = [_difference(points[i : i + order + 1]) for i in range(m + 1)]
    squares = [squared_length(slope) for slope in slopes]

    def weight(i: int, j: int) -> Fraction:
        return Fraction(comb(m, i) * comb(m, j), comb(2 * m, i + j) * (2 * m + 1)) * scale**2 * time

    parts = [(weight(i, i), squares[i]) for i in range(m + 1)]
    for i in range(m + 1):
        for j in range(i):
            both = squared_length(affine_sum(((_ONE, slopes[i]), (_ONE, slopes[j]))))
            parts += [(weight(i, j), both), (-weight(i, j), squares[i]), (-weight(i, j), squares[j])]
    return parts


def _difference(points: Sequence[Affine]) -> Affine:
    """Δ^k of k + 1 points."""
    k = len(points) - 1
    return affine_sum((Fraction((-1) ** (k - j) * comb(k, j)), p) for j, p in enumerate(points))


def _solved(chain: Chain) -> Solved | None:
    """Gauss and Jordan with the points of the beginning last: they stay free, and the others are tame in them."""
    d, c, m = chain.degree, chain.continuity, chain.pieces
    inner = [(k, j) for k in range(m) for j in range(1, d)]
    ends = {(0, 1), (m - 1, d - 1)}
    columns = sorted(inner, key=lambda at: (at in ends, at[1] <= d - 1 - c, at))
    place = {at: i for i, at in enumerate(columns)}
    moving = chain.free_via
    width = len(columns) + (moving is not None)
    rows = []

    def equation(terms: Sequence[tuple[int, int, Fraction]], value: Point = (_ZERO,) * chain.dimension) -> None:
        row, right = [_ZERO] * width, list(value)
        for k, j, weight in terms:
            corner = (k + (j == d)) % len(chain.points) if j in (0, d) else None
            if corner is None:
                row[place[k, j]] += weight
            elif corner == moving:
                row[-1] += weight
            else:
                right = [r - weight * x for r, x in zip(right, chain.points[corner], strict=True)]
        rows.append([*row, *right])

    times = chain.times
    for k in range(m if chain.closed else m - 1):
        after = (k + 1) % m
        for order in range(1, c + 1):
            equation([*_end(k, d, order, times[k]), *((q, j, -w) for q, j, w in _begin(after, order, times[after]))])
    if chain.ends is Ends.ZERO:
        for order in range(1, 3 if d == 5 else 2):
            equation(_begin(0, order, times[0]))
            equation(_end(m - 1, d, order, times[-1]))
    for velocity, end in zip(chain.velocities, (_begin(0, 1, times[0]), _end(m - 1, d, 1, times[-1])), strict=False):
        equation([(k, j, d * w) for k, j, w in end], velocity)
    work, pivots = echelon(rows)
    if any(p >= width for p in pivots):
        return None
    free = {column: i for i, column in enumerate(c for c in range(width) if c not in set(pivots))}
    zero = (_ZERO,) * chain.dimension
    values = {column: Affine({i: _ONE}, zero) for column, i in free.items()}
    for row, column in zip(work, pivots, strict=True):
        values[column] = Affine({i: -row[q] for q, i in free.items() if row[q]}, tuple(row[width:]))
    known = [Affine({}, p) for p in chain.corners]
    if moving is not None:
        known = [values[width - 1] if k % len(chain.points) == moving else p for k, p in enumerate(known)]
    middle = [[values[place[k, j]] for j in range(1, d)] for k in range(m)]
    controls = tuple((known[k], *middle[k], known[k + 1]) for k in range(m))
    return Solved(len(free), controls)


def _begin(k: int, order: int, time: Fraction) -> list[tuple[int, int, Fraction]]:
    signs = [(-1) ** (order - j) * comb(order, j) for j in range(order + 1)]
    return [(k, j, s / time**order) for j, s in enumerate(signs)]


def _end(k: int, degree: int, order: int, time: Fraction) -> list[tuple[int, int, Fraction]]:
    signs = [(-1) ** (order - j) * comb(order, j) for j in range(order + 1)]
    return [(k, degree - order + j, s / time**order) for j, s in enumerate(signs)]

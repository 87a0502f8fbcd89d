"""A chain of Bézier curves through via points as a value, what its control points have to keep, and what is least.

A curve of degree d with duration T has at its ends the derivatives d!/(d-j)! Δ^j P / T^j in time (Farin, "Curves and
Surfaces for CAGD", 5.3), so that a join is C^c in time where Δ^j P / T^j agree for j = 1, ..., c. These equations are
solved over Q; what they leave free is free.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import comb, factorial

from bezier.chains import form as forms
from qe.errors import InputError
from qe.exact.quadratic_form import echelon, solve_linear

MOST_VIA = 50
_ZERO, _ONE = Fraction(0), Fraction(1)
_WORDS = ("place", "velocity", "acceleration")
Place = tuple[int, int]
"""A control point by its curve and its number in it; a corner as that of the curve that begins there."""


@dataclass(frozen=True, slots=True)
class Equation:
    """The control points with the weights of ``terms`` sum up to ``value``; of a curve they are its derivative of this
    ``order``. ``without``: it does not hold where one of these is free."""

    label: str
    order: int
    without: tuple[str, ...]
    terms: tuple[tuple[Place, Fraction], ...]
    value: forms.Point


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
    all ``half_spaces``: (a, b) for a . p >= b.
    ``max_length`` (mm) of all curves together, ``max_curvature`` (1/mm). ``free_total``: the sum of free durations.
    ``velocities`` at the start and at the goal (mm/s), where these are fixed. ``free``: what may be another one, in
    questions about repairs: a point by its name, "velocities[0]", or "durations[2]": this without the joins of that
    curve, so that what excludes such chains excludes all durations of it.
    """

    points: tuple[forms.Point, ...]
    degree: int = 3
    continuity: int = 2
    durations: tuple[Fraction, ...] = ()
    ends: Ends = Ends.FREE
    closed: bool = False
    objective: Objective = Objective.LEGS
    centre: forms.Point = ()
    radius_squared: Fraction | None = None
    half_spaces: tuple[tuple[forms.Point, Fraction], ...] = ()
    free: str = ""
    max_length: Fraction | None = None
    max_curvature: Fraction | None = None
    free_total: Fraction | None = None
    velocities: tuple[forms.Point, ...] = ()

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
        if self.velocities and (self.closed or [len(v) for v in self.velocities] != [self.dimension] * 2):
            raise InputError("chain: velocities at the start and at the goal of an open chain expected")
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
    def moving(self) -> tuple[str, ...]:
        """What may be ``free`` and is a point or a vector: points, and velocities at the ends."""
        return self.point_names + (() if self.closed else ("velocities[0]", "velocities[1]"))

    @property
    def paces(self) -> tuple[str, ...]:
        """The names of the durations."""
        return tuple(f"durations[{k}]" for k in range(self.pieces))

    @property
    def corners(self) -> tuple[forms.Point, ...]:
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

    @property
    def is_still(self) -> bool:
        """Whether it rests at its ends, as far as no ``velocities`` say more."""
        return self.ends is Ends.ZERO

    @cached_property
    def solved(self) -> forms.Solved:
        """The control points as combinations of free ones."""
        return solved_joins(self)


def requirements(chain: Chain, solved: forms.Solved) -> tuple[forms.Requirement, ...]:
    """Of all control points, those that several curves share once; with the joins that contradict each other."""
    result, names = [row for _, row in solved.joins], chain.point_names
    for k, piece in enumerate(solved.controls):
        last = k == chain.pieces - 1 and not chain.closed
        for j, point in enumerate(piece if last else piece[:-1]):
            corner = names[(k + (j > 0)) % len(names)]
            name = f"C{k + 1}.{j}" if 0 < j < chain.degree else corner
            if chain.radius_squared is not None:
                away = forms.affine_sum(((_ONE, point), (-_ONE, forms.Affine({}, chain.centre))))
                form = forms.squared_length(away).shifted(-chain.radius_squared)
                result.append(forms.Requirement(f"{name} in the ball", form, ((_ONE, away),), is_ball=True))
            for i, (normal, offset) in enumerate(chain.half_spaces):
                form = forms.linear_form(tuple(-c for c in normal), point).shifted(offset)
                result.append(forms.Requirement(f"{name} in half_space[{i}]", form))
    return tuple(result)


def objective_form(chain: Chain, solved: forms.Solved) -> forms.Form:
    """What is to be least."""
    if chain.free:
        place, given = freed(chain, solved)
        return forms.squared_length(forms.affine_sum(((_ONE, place), (-_ONE, forms.Affine({}, given)))))
    order, pieces = chain.objective.order, solved.controls
    if not order:
        if chain.objective is Objective.MIDDLE_LEGS and not chain.closed:
            pieces = pieces[1:-1]
        legs = (_difference(p[j : j + 2]) for p in pieces for j in range(chain.degree))
        return forms.weighted_sum((_ONE, forms.squared_length(leg)) for leg in legs)
    parts = [(w, f) for p, t in zip(pieces, chain.times, strict=True) for w, f in _energy(p, t, order)]
    return forms.weighted_sum(parts)


def freed(chain: Chain, solved: forms.Solved) -> tuple[forms.Affine, forms.Point]:
    """The point or velocity that is free, and the one that is given."""
    if matched := re.fullmatch(r"velocities\[([01])\]", chain.free):
        end = int(matched[1])
        terms = derivative(chain, end * (chain.pieces - 1), end, 1)
        velocity = forms.affine_sum((w, solved.controls[k][j]) for (k, j), w in terms)
        return velocity, chain.velocities[end] if chain.velocities else (_ZERO,) * chain.dimension
    k = chain.point_names.index(chain.free)
    return solved.controls[min(k, chain.pieces - 1)][0 if k < chain.pieces else -1], chain.points[k]


def _energy(points: Sequence[forms.Affine], time: Fraction, order: int) -> list[tuple[Fraction, forms.Form]]:
    """The integral of the squared derivative: with B-coefficients c_i of degree m that is sum G_ij c_i.c_j and
    G_ij = C(m,i) C(m,j) / (C(2m,i+j) (2m+1)) (Farin, 6.5), by polarisation."""
    degree = len(points) - 1
    m, scale = degree - order, Fraction(factorial(degree), factorial(degree - order)) / time**order
    slopes = [_difference(points[i : i + order + 1]) for i in range(m + 1)]
    squares = [forms.squared_length(slope) for slope in slopes]

    def weight(i: int, j: int) -> Fraction:
        return Fraction(comb(m, i) * comb(m, j), comb(2 * m, i + j) * (2 * m + 1)) * scale**2 * time

    parts = [(weight(i, i), squares[i]) for i in range(m + 1)]
    for i in range(m + 1):
        for j in range(i):
            both = forms.squared_length(forms.affine_sum(((_ONE, slopes[i]), (_ONE, slopes[j]))))
            parts += [(weight(i, j), both), (-weight(i, j), squares[i]), (-weight(i, j), squares[j])]
    return parts


def _difference(points: Sequence[forms.Affine]) -> forms.Affine:
    """Δ^k of k + 1 points."""
    k = len(points) - 1
    return forms.affine_sum((Fraction((-1) ** (k - j) * comb(k, j)), p) for j, p in enumerate(points))


def solved_joins(chain: Chain) -> forms.Solved:
    """Gauss and Jordan with the points of the beginning last: they stay free, and the others are tame in them. Where
    the equations contradict each other, all points stay free and the smallest contradiction is in ``joins``."""
    d, c, m = chain.degree, chain.continuity, chain.pieces
    cut = [k for k in range(m) if chain.free == f"durations[{k}]"]
    ends = {(0, 1), (m - 1, d - 1), *(at for k in cut for at in ((k - 1, d - 1), (k + 1, 1)))}
    inner = [(k, j) for k in range(m) for j in range(1, d)]
    columns = sorted(inner, key=lambda at: (at in ends, at[1] <= d - 1 - c, at))
    columns += [(k, 0) for k, name in enumerate(chain.point_names) if name == chain.free]
    width, listed = len(columns), [_unknown(chain, e) for e in equations(chain) if chain.free not in e.without]
    matrix = [[terms.get(at, _ZERO) for at in columns] for _, terms, _ in listed]
    work, pivots = echelon([[*row, *value] for row, (_, _, value) in zip(matrix, listed, strict=True)])
    contradictory = any(p >= width for p in pivots)
    if contradictory:
        work, pivots = [], []
    free = {column: i for i, column in enumerate(c for c in range(width) if c not in set(pivots))}
    values = {column: forms.Affine({i: _ONE}, (_ZERO,) * chain.dimension) for column, i in free.items()}
    for row, column in zip(work, pivots, strict=True):
        values[column] = forms.Affine({i: -row[q] for q, i in free.items() if row[q]}, tuple(row[width:]))
    at = {place: values[i] for i, place in enumerate(columns)}
    corners = [at.get((k % len(chain.points), 0), forms.Affine({}, p)) for k, p in enumerate(chain.corners)]
    controls = tuple((corners[k], *(at[k, j] for j in range(1, d)), corners[k + 1]) for k in range(m))
    joins = _contradiction(chain, listed, matrix, at) if contradictory else ()
    return forms.Solved(len(free), controls, joins)


def _contradiction(
    chain: Chain,
    listed: list[tuple[str, dict[Place, Fraction], forms.Point]],
    matrix: list[list[Fraction]],
    at: dict[Place, forms.Affine],
) -> tuple[tuple[Fraction, forms.Requirement], ...]:
    """Weights with which equations have the sum 0 = 1 in one coordinate. Those with a weight are independent but for
    this, so that there is no other contradiction among them."""
    for axis in range(chain.dimension):
        columns = [*zip(*matrix, strict=True), [value[axis] for _, _, value in listed]]
        right = [*(_ZERO for _ in columns[1:]), _ONE]
        if (solution := solve_linear(columns, right, len(listed))) is not None:
            break
    else:
        raise AssertionError("equations without a solution that contradict each other in no coordinate")
    unit, joins = tuple(_ONE if k == axis else _ZERO for k in range(chain.dimension)), []
    for weight, (label, terms, value) in zip(solution.particular, listed, strict=True):
        if weight:
            total = forms.weighted_sum((w, forms.linear_form(unit, at[place])) for place, w in terms.items())
            form = forms.weighted_sum([(-_ONE if weight > 0 else _ONE, total.shifted(-value[axis]))])
            joins.append((abs(weight), forms.Requirement(f"{label}, {forms.AXES[axis]}", form)))
    return tuple(joins)


def equations(chain: Chain) -> Iterator[Equation]:
    """Of joins and ends."""
    m, names, paces, zero = chain.pieces, chain.point_names, chain.paces, (_ZERO,) * chain.dimension
    for k in range(m if chain.closed else m - 1):
        after = (k + 1) % m
        for order in range(1, chain.continuity + 1):
            terms = [*derivative(chain, k, 1, order), *((p, -w) for p, w in derivative(chain, after, 0, order))]
            label = f"one {_WORDS[order]} at {names[(k + 1) % len(names)]}"
            yield Equation(label, order, (paces[k], paces[after]), tuple(terms), zero)
    given = chain.velocities or ((zero, zero) if chain.is_still else ())
    for end, velocity in enumerate(given):
        k, name = end * (m - 1), names[-end]
        without = (f"velocities[{end}]", *([paces[k]] if any(velocity) else []))
        yield Equation(f"velocity at {name}", 1, without, tuple(derivative(chain, k, end, 1)), velocity)
        if chain.is_still and chain.degree == 5:
            yield Equation(f"acceleration at {name}", 2, (), tuple(derivative(chain, k, end, 2)), zero)


def derivative(chain: Chain, k: int, end: int, order: int) -> list[tuple[Place, Fraction]]:
    """That of a curve at its beginning (0) or end (1), as control points with weights."""
    d, scale = chain.degree, _ONE
    for j in range(order):
        scale *= (d - j) / chain.times[k]
    first = (d - order) * end
    return [((k, first + j), scale * (-1) ** (order - j) * comb(order, j)) for j in range(order + 1)]


def _unknown(chain: Chain, equation: Equation) -> tuple[str, dict[Place, Fraction], forms.Point]:
    """What an equation is about, its weights of points that are not known, and what is known on the right."""
    unknown, value = dict[Place, Fraction](), equation.value
    for (k, j), weight in equation.terms:
        corner = (k + (j > 0)) % len(chain.points)
        if 0 < j < chain.degree or (chain.free and chain.point_names[corner] == chain.free):
            place = (k, j) if 0 < j < chain.degree else (corner, 0)
            unknown[place] = unknown.get(place, _ZERO) + weight
        else:
            value = tuple(v - weight * x for v, x in zip(value, chain.points[corner], strict=True))
    return equation.label, unknown, value

"""Quadratic polynomials in free points, the same in every coordinate: all that chains minimise and require.

With u_1, ..., u_n free points of dimension d, a form is sum M_ij u_i.u_j + sum g_i.u_i + c, M symmetric. Sums of
squared distances between combinations of points, and linear conditions, are of this kind. So one n × n matrix decides
about n d variables.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from bezier.curves.curve import Bezier
from bezier.curves.scalar import dot
from qe.exact.quadratic_form import Quadratic, solve_linear

Point = tuple[Fraction, ...]
_ZERO = Fraction(0)
AXES = "xyz"


@dataclass(frozen=True, slots=True)
class Affine:
    """A point that depends on free points: sum coefficients_i u_i + constant."""

    coefficients: Mapping[int, Fraction]
    constant: Point

    def at(self, free: Sequence[Point]) -> Point:
        """The point for these free points."""
        moved = (sum((a * free[i][k] for i, a in self.coefficients.items()), c) for k, c in enumerate(self.constant))
        return tuple(moved)


def affine_sum(parts: Iterable[tuple[Fraction, Affine]]) -> Affine:
    """The linear combination of at least one point."""
    pairs = list(parts)
    coefficients: dict[int, Fraction] = {}
    constant = [_ZERO] * len(pairs[0][1].constant)
    for weight, part in pairs:
        for i, a in part.coefficients.items():
            coefficients[i] = coefficients.get(i, _ZERO) + weight * a
        constant = [c + weight * b for c, b in zip(constant, part.constant, strict=True)]
    return Affine({i: a for i, a in coefficients.items() if a}, tuple(constant))


@dataclass(frozen=True, slots=True)
class Form:
    """``matrix`` has both (i, j) and (j, i); entries that are not there are zero."""

    matrix: Mapping[tuple[int, int], Fraction]
    gradient: Mapping[int, Point]
    constant: Fraction

    def value(self, free: Sequence[Point]) -> Fraction:
        """The value, exactly."""
        total = self.constant
        for (i, j), m in self.matrix.items():
            if i <= j:
                total += (m if i == j else 2 * m) * dot(free[i], free[j])
        return sum((dot(g, free[i]) for i, g in self.gradient.items()), total)

    @property
    def is_constant(self) -> bool:
        """Whether no free point occurs."""
        return not self.matrix and not self.gradient

    def shifted(self, constant: Fraction) -> Form:
        """The form with this added."""
        return Form(self.matrix, self.gradient, self.constant + constant)

    def minimum(
        self, size: int, dimension: int, near: Sequence[Point] | None = None
    ) -> tuple[tuple[Point, ...], Fraction] | None:
        """Where the form, convex, is least and its value there; None where it is unbounded below. ``dimension``: of the
        points, of which there are ``size``. Where it is least at many places: little from those that are ``near``."""
        axes = []
        rows = [[2 * self.matrix.get((i, j), _ZERO) for j in range(size)] for i in range(size)]
        for k in range(dimension):
            right = [-self.gradient[i][k] if i in self.gradient else _ZERO for i in range(size)]
            if near is not None:
                right = [
                    b - sum((a * p[k] for a, p in zip(row, near, strict=True)), _ZERO)
                    for row, b in zip(rows, right, strict=True)
                ]
            solution = solve_linear(rows, right, size)
            if solution is None:
                return None
            axes.append([x + (near[i][k] if near else 0) for i, x in enumerate(solution.particular)])
        point = tuple(tuple(axis[i] for axis in axes) for i in range(size))
        return point, self.value(point)

    def quadratic(self, size: int, dimension: int) -> Quadratic:
        """The same polynomial in the coordinates, point after point."""
        n = size * dimension
        hessian = [[_ZERO] * n for _ in range(n)]
        for (i, j), m in self.matrix.items():
            for k in range(dimension):
                hessian[i * dimension + k][j * dimension + k] = 2 * m
        gradient = [c for i in range(size) for c in self.gradient.get(i, (_ZERO,) * dimension)]
        return Quadratic(tuple(map(tuple, hessian)), tuple(gradient), self.constant)


def weighted_sum(parts: Iterable[tuple[Fraction, Form]]) -> Form:
    """The linear combination of forms."""
    matrix: dict[tuple[int, int], Fraction] = {}
    gradient: dict[int, Point] = {}
    constant = _ZERO
    for weight, form in parts:
        for key, m in form.matrix.items():
            matrix[key] = matrix.get(key, _ZERO) + weight * m
        for i, g in form.gradient.items():
            before = gradient.get(i, (_ZERO,) * len(g))
            gradient[i] = tuple(a + weight * b for a, b in zip(before, g, strict=True))
        constant += weight * form.constant
    clean = {i: g for i, g in gradient.items() if any(g)}
    return Form({key: m for key, m in matrix.items() if m}, clean, constant)


def squared_length(vector: Affine) -> Form:
    """|vector|²."""
    entries, matrix = list(vector.coefficients.items()), dict[tuple[int, int], Fraction]()
    for k, (i, a) in enumerate(entries):
        for j, b in entries[k:]:
            matrix[i, j] = matrix[j, i] = a * b
    twice = tuple(2 * c for c in vector.constant)
    gradient = {i: tuple(a * c for c in twice) for i, a in entries} if any(twice) else {}
    return Form(matrix, gradient, dot(vector.constant, vector.constant))


def linear_form(normal: Point, point: Affine) -> Form:
    """normal . point."""
    gradient = {i: tuple(a * c for c in normal) for i, a in point.coefficients.items()}
    return Form({}, {i: g for i, g in gradient.items() if any(g)}, dot(normal, point.constant))


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
        return sum((w * dot(p.constant, p.constant) for w, p in self.squares), -self.form.constant)


@dataclass(frozen=True, slots=True)
class Solved:
    """The control points of each curve as combinations of ``size`` free points."""

    size: int
    controls: tuple[tuple[Affine, ...], ...]
    joins: tuple[tuple[Fraction, Requirement], ...] = ()
    """Where the equations of joins and ends contradict each other: the least contradiction, with its weights."""

    def curves(self, free: Sequence[Point]) -> tuple[Bezier, ...]:
        """The curves for these free points."""
        return tuple(Bezier(tuple(p.at(free) for p in piece)) for piece in self.controls)

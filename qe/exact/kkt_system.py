"""Critical points of a quadratic polynomial on an intersection of quadrics, as exact candidates.

The Lagrange system grad f + sum nu_k grad q_k = 0, q_k = 0 is first reduced exactly: every linear combination
of the q_k without quadratic part is a hyperplane (for balls: the radical hyperplane of two spheres), and the
problem is restricted to it. What remains is refined by Newton's method in ball arithmetic from a numerical
start and recognised in one number field. The result is a candidate: the caller proves it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

from flint import arb, arb_mat, fmpq

from qe.errors import Unable
from qe.exact.balls import precision
from qe.exact.field import FieldElement, NumberField, to_fmpq
from qe.exact.lattice_recognition import SCHEDULE, Digits, FieldLattice, algebraic_candidate, element_candidate
from qe.exact.quadratic_form import Number, Quadratic, combine, dot, independent_rows, solve_linear

Point = tuple[Number, ...]

MAX_DEGREE = 40  # of the number field: beyond, lattice reduction takes seconds
NEAR_BITS = 160
_PATIENCE = 6  # Newton steps without a gain, although each should double the digits
_TALL = 4  # degree up to which coefficients longer than those of the problem are looked for
_MANY_TRIALS = 12  # degree up to which several generators are tried


@dataclass(frozen=True, slots=True)
class Flat:
    """The affine subspace origin + span(basis) of R^n, over Q."""

    origin: tuple[Fraction, ...]
    basis: tuple[tuple[Fraction, ...], ...]

    @staticmethod
    def whole(size: int) -> Flat:
        """R^n itself."""
        rows = tuple(tuple(Fraction(i == j) for j in range(size)) for i in range(size))
        return Flat((Fraction(0),) * size, rows)

    def cut(self, equations: Sequence[Quadratic]) -> Flat | None:
        """The part where linear polynomials (in the coordinates along the basis) vanish; None when empty."""
        solution = solve_linear([q.gradient for q in equations], [-q.constant for q in equations], len(self.basis))
        if solution is None:
            return None
        return self.inside(Flat(solution.particular, solution.kernel))

    def inside(self, inner: Flat) -> Flat:
        """The flat of the points whose coordinates along the basis are those of another one."""
        return Flat(self.lift(inner.origin), tuple(map(self.direction, inner.basis)))

    def direction(self, coordinates: Sequence[Number]) -> Point:
        """The vector with these coordinates along the basis."""
        return Flat((Fraction(0),) * len(self.origin), self.basis).lift(coordinates)

    def lift(self, coordinates: Sequence[Number]) -> Point:
        """The point with these coordinates along the basis."""
        point = list(self.origin)
        for z, direction in zip(coordinates, self.basis, strict=True):
            if z:
                for i, d in enumerate(direction):
                    if d:
                        point[i] = point[i] + z * d
        return tuple(point)

    def coordinates(self, point: Sequence[float]) -> list[float]:
        """Coordinates of the point of the flat that is nearest to a point, in floats."""
        from_origin = [p - float(o) for p, o in zip(point, self.origin, strict=True)]
        return _least_squares([[float(d) for d in direction] for direction in self.basis], from_origin)


def cut_linear_combinations(flat: Flat, equations: Sequence[Quadratic]) -> tuple[Flat, list[Quadratic]] | None:
    """Restrict to a flat until the Hessians of the remaining equations are linearly independent on it.

    Returns the flat and the remaining equations in its coordinates; None when the flat becomes empty. The common
    zeros of the equations do not change: each hyperplane is a linear combination of equations.
    """
    current = [q.restrict(flat.origin, flat.basis) for q in equations]
    while True:
        size = len(flat.basis)
        shapes = [[q.hessian[i][j] for i in range(size) for j in range(i, size)] for q in current]
        chosen = independent_rows(shapes)
        planes = []
        columns = [list(column) for column in zip(*[shapes[c] for c in chosen], strict=True)] if chosen else []
        for index, q in enumerate(current):
            if index in chosen:
                continue
            weights: tuple[Fraction, ...] = ()
            if chosen:
                solution = solve_linear(columns, shapes[index], len(chosen))
                weights = solution.particular if solution else ()
            parts = [q, *(current[c] for c in chosen)]
            planes.append(combine([Fraction(1), *(-w for w in weights)], parts))
        if any(p.constant and not any(p.gradient) for p in planes):
            return None
        if not any(any(p.gradient) for p in planes):
            return flat, [current[c] for c in chosen]
        inner = Flat.whole(size).cut(planes)
        if inner is None:
            return None
        current = [current[c].restrict(inner.origin, inner.basis) for c in chosen]
        flat = flat.inside(inner)


class _Newton:
    """High precision Newton iteration on the Lagrange system; approximations are cached and only grow."""

    def __init__(self, objective: Quadratic, equations: Sequence[Quadratic], start: Sequence[float]) -> None:
        self.n, self.k = objective.size, len(equations)
        self.parts = [_dense(objective), *(_dense(q) for q in equations)]
        self.bits = 0
        self.u = [arb(v) for v in start]

    def _residual(self) -> tuple[arb_mat, arb_mat]:
        n, k, x = self.n, self.k, self.u[: self.n]
        weights = [arb(1), *self.u[n:]]
        slopes, values = [], []
        for hessian, gradient, constant in self.parts:
            products = [sum((h * x[j] for j, h in row), arb(0)) for row in hessian]
            slopes.append([p + arb(b) for p, b in zip(products, gradient, strict=True)])
            halves = [xi * (p / 2 + arb(b)) for xi, p, b in zip(x, products, gradient, strict=True)]
            values.append(sum(halves, arb(constant)))
        size = n + k
        jacobian = [[arb(0)] * size for _ in range(size)]
        for w, (hessian, _, _) in zip(weights, self.parts, strict=True):
            for i, row in enumerate(hessian):
                for j, h in row:
                    jacobian[i][j] = jacobian[i][j] + w * h
        for q in range(k):
            for i in range(n):
                jacobian[i][n + q] = jacobian[n + q][i] = slopes[q + 1][i]
        top = [sum((w * s[i] for w, s in zip(weights, slopes, strict=True)), arb(0)) for i in range(n)]
        return arb_mat(jacobian), arb_mat([[v] for v in top + values[1:]])

    def at(self, bits: int) -> list[arb] | None:
        """The solution with error about 2^-bits (heuristically); None when the iteration does not converge."""
        if bits <= self.bits:
            return self.u
        stalled = 0
        while self.bits < bits:
            working = min(2 * max(self.bits, 32), bits + 16) + 48
            with precision(working):
                try:
                    jacobian, residual = self._residual()
                    step = jacobian.mid().solve(residual.mid())
                except ZeroDivisionError:
                    return None
                moves = [step[i, 0].mid() for i in range(self.n + self.k)]
                if not all(d.is_finite() for d in moves):
                    return None
                self.u = [(v - d).mid() for v, d in zip(self.u, moves, strict=True)]
            # quadratic convergence: a step of size 2^-e leaves an error of about 2^-2e
            reached = min(2 * min(_exponent(d, working) for d in moves) - 4, working - 32)
            stalled = stalled + 1 if reached <= self.bits else 0
            if stalled > _PATIENCE:
                return None
            self.bits = max(self.bits, reached)
        return self.u


def _exponent(d: arb, most: int) -> int:
    """The largest e <= most with |d| < 2^-e, roughly."""
    if d.is_zero():
        return most
    mantissa, exponent = d.man_exp()
    return min(most, -int(exponent) - int(abs(mantissa)).bit_length())


def _dense(q: Quadratic) -> tuple[list[list[tuple[int, fmpq]]], list[fmpq], fmpq]:
    rows = [[(j, to_fmpq(h)) for j, h in enumerate(row) if h] for row in q.hessian]
    return rows, [to_fmpq(b) for b in q.gradient], to_fmpq(q.constant)


class HighDegree(Unable):
    """The coordinates of the wanted point seem to have an algebraic degree above the limit.

    ``near``: a rational point within about 2^-``NEAR_BITS`` of it; ``support``: the inequalities it was sought with.
    """

    def __init__(self, message: str = "", near: Sequence[Fraction] = (), support: Sequence[int] = ()) -> None:
        super().__init__(message)
        self.near, self.support = tuple(near), tuple(support)


def critical_point(
    objective: Quadratic,
    equations: Sequence[Quadratic],
    near: Sequence[float],
    *,
    accept: Callable[[Sequence[float]], bool] = lambda point: True,
    max_degree: int = MAX_DEGREE,
    check: Callable[[], object] = lambda: None,
) -> tuple[NumberField, Point] | None:
    """A candidate for the point near ``near`` where f is critical on {q = 0 for q in equations}.

    The coordinates are ``Fraction`` or elements of the returned field. None when the equations contradict each
    other, the point is not isolated, Newton's method fails or leaves the neighbourhood, or ``accept`` refuses its
    limit. Raises ``HighDegree`` when the limit is accepted but not recognised. ``check`` is called between the steps of
    the recognition and may raise.
    """
    reduced = cut_linear_combinations(Flat.whole(objective.size), equations)
    if reduced is None:
        return None
    flat, rest = reduced
    f = _primitive(objective.restrict(flat.origin, flat.basis))
    rest = [_primitive(q) for q in rest]
    if not rest:
        solution = f.stationary()
        if solution is None or solution.kernel:
            return None
        return NumberField.rationals(), flat.lift(solution.particular)
    z = flat.coordinates(near)
    start = [Fraction(v) for v in z]
    multipliers = _least_squares([q.slope(start) for q in rest], [-c for c in f.slope(start)])
    newton = _Newton(f, rest, z + multipliers)
    limit = newton.at(64)
    if limit is None:
        return None
    point = flat.lift([Fraction(float(v)) for v in limit[: f.size]])
    approximate = [float(c) for c in point]
    reach = 1e-2 * (1 + max((abs(c) for c in near), default=0.0))
    if any(abs(p - q) > reach for p, q in zip(approximate, near, strict=True)) or not accept(approximate):
        return None
    try:
        field, coordinates = _recognise(newton, f, rest, max_degree, check)
    except HighDegree as reason:
        close = newton.at(NEAR_BITS) or limit
        raise HighDegree(str(reason), flat.lift([_middle(v) for v in close[: f.size]])) from None
    return field, flat.lift(coordinates)


def _middle(ball: arb) -> Fraction:
    value = ball.mid().fmpq()
    return Fraction(round(Fraction(int(value.p), int(value.q)) * 2**NEAR_BITS), 2**NEAR_BITS)


def _primitive(q: Quadratic) -> Quadratic:
    """The positive multiple with integer coefficients of content 1: short multipliers belong to it."""
    numbers = [c for row in q.hessian for c in row] + [*q.gradient, q.constant]
    scale = Fraction(lcm(*(c.denominator for c in numbers)), gcd(*(c.numerator for c in numbers)) or 1)
    return combine([scale], [q])


def _least_squares(rows: Sequence[Sequence[Number]], target: Sequence[Number]) -> list[float]:
    """The factors with which the sum of the rows comes nearest to a target."""
    gram, rhs = ([[Fraction(dot(u, v)) for v in others] for u in rows] for others in (rows, [target]))
    solution = solve_linear(gram, [value for (value,) in rhs], len(rows))
    return [float(z) for z in solution.particular] if solution else [0.0] * len(rows)


def _recognise(
    newton: _Newton, f: Quadratic, rest: Sequence[Quadratic], max_degree: int, check: Callable[[], object]
) -> tuple[NumberField, Point]:
    """The field generated by the multipliers (or by a combination of all unknowns), and z in it."""
    n, total = f.size, f.size + len(rest)

    def combination(weights: Sequence[int]) -> Digits:
        def digits(bits: int) -> arb:
            u = newton.at(bits + 16)
            with precision(bits + 64):
                return sum((v * w for v, w in zip(u, weights, strict=True) if w), arb(0)) if u else arb(0)

        return digits

    unit = [[int(i == j) for j in range(total)] for i in range(total)]
    # one unknown alone mostly generates the field; otherwise small generic combinations do
    generic = [[0] * n + [1 + 2 * k for k in range(len(rest))], [3 * k + 1 for k in range(total)]]
    trials = [unit[n], unit[0], *unit[n + 1 :], *generic]
    numbers = (c for q in (f, *rest) for row in (*q.hessian, (*q.gradient, q.constant)) for c in row)
    height = max(c.numerator.bit_length() for c in numbers)
    for degree, bits in SCHEDULE:
        if degree > max_degree:
            break
        bits += 2 * (degree + 1) * height if degree <= _TALL else 0  # what such coefficients need
        for weights in trials if degree <= _MANY_TRIALS else trials[:2]:
            check()
            theta = algebraic_candidate(combination(weights), degree, bits)
            if theta is None:
                continue
            field = NumberField(theta)
            lattice = FieldLattice(field)
            if weights is unit[0]:  # a coordinate: the others are about as short, multipliers mostly longer
                point = _elements(lattice, [combination(unit[i]) for i in range(n)])
                if point is not None:
                    return field, tuple(point)
                continue
            nu = _elements(lattice, [combination(unit[i]) for i in range(n, total)])
            if nu is None:
                continue
            z = _stationary(f, rest, nu, lattice, [combination(row) for row in unit[:n]])
            if z is not None:
                return field, z
    raise HighDegree(f"the exact optimum seems to need a number field of degree above {max_degree}")


def _elements(lattice: FieldLattice, unknowns: Sequence[Digits]) -> list[FieldElement] | None:
    elements: list[FieldElement] = []
    for digits in unknowns:
        value = element_candidate(lattice, digits)
        if value is None:
            return None
        elements.append(value)
    return elements


def _stationary(
    f: Quadratic, rest: Sequence[Quadratic], nu: Sequence[FieldElement], lattice: FieldLattice, digits: Sequence[Digits]
) -> Point | None:
    """z with (H_f + sum nu_k H_k) z = -(b_f + sum nu_k b_k); where that leaves z_i free, as its digits say."""
    n = f.size
    rows: list[list[Number]] = [list(row) for row in f.hessian]
    rhs: list[Number] = [-b for b in f.gradient]
    for q, v in zip(rest, nu, strict=True):
        for i in range(n):
            rhs[i] = rhs[i] - v * q.gradient[i]
            for j in range(n):
                if q.hessian[i][j]:
                    rows[i][j] = rows[i][j] + v * q.hessian[i][j]
    solution = solve_linear(rows, rhs, n)
    if solution is None:
        return None
    z = list(solution.particular)
    for i, direction in zip(solution.free, solution.kernel, strict=True):
        value = element_candidate(lattice, digits[i])
        if value is None:
            return None
        z = [a + value * d for a, d in zip(z, direction, strict=True)]
    return tuple(z)

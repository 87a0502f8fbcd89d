"""Checker for certificates of kind "inverse": all joint positions at a point, of an arm with three joints that turn.

With frames A0 Rz(θ1) A1 Rz(θ2) A2 Rz(θ3) A3, e the origin of A3, p' = A0^-1 p, A1 = (R, o), v = A2 Rz(θ3) e, κ = (v_x,
v_y) and u the first two coordinates of Rz(θ2) v, the point is reached iff |A1 (u, v_z)|² = |p'|², its height is p'_z
and |u| = |κ| (D. L. Pieper 1968). The first two are linear in u. With θ3 = φ + 2 arctan t, all multiplied by powers of
1 + t²: either they determine u, and |u|² - |κ|² = 0 is an equation E in t; or they are dependent, a combination E of
them is free of u, and S = m² is left for the component of u that they do not name. θ2 is the angle from κ to u, unique
where κ /= 0, and θ1 the one from q = A1 (u, v_z) to p', unique where p' is not on the first axis. So different (t, m)
are different solutions, and their number is counted exactly by Sturm's and Tarski's theorems over Q with square roots.

``roots``: intervals of t; the checker counts the roots of E in each (one) and the solutions over it, and proves by
interval arithmetic that each lies in its box. As many solutions as there are in all have to be listed, in disjoint
boxes: so every box holds exactly one, and there is no other. An empty list proves that there is none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from qe.certify.arithmetic import square_roots as sr
from qe.certify.arithmetic.square_roots import ONE, ZERO, Interval, Polynomial, Surd
from qe.errors import Unable
from qe.options import Budget
from qe.proof.entry import Entry, Json

MOST_ROWS, MOST_TERMS, MOST_BITS, BITS = 40, 16, 20_000, 400
Vector = list[Surd]
Motion = tuple[tuple[Vector, Vector, Vector], Vector]
"""Rows of the rotation, and the shift."""

Box = tuple[Interval, ...]
"""Cosine and sine of every joint."""


def check_inverse(payload: dict[str, Json], budget: Budget | None = None) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    arm, point, turn, count, roots = Entry(payload, "payload").fields("arm", "point", "turn", "count", "roots")
    constants = _constants(arm)
    target = [_surd(c) for c in point.items()]
    if len(target) != 3:
        raise point.fail("expected three coordinates")
    phi = [_number(v) for v in turn.items()]
    if len(phi) != 2 or phi[0] ** 2 + phi[1] ** 2 != 1:
        raise turn.fail("expected cosine and sine")
    system = _System.of(constants, target, (phi[0], phi[1]))
    if not system.equation or len(system.equation) <= system.full:
        raise turn.fail("the equation vanishes at the angle that t misses, or everywhere")
    if system.total() != count.integer():
        raise count.fail("not the number of solutions")
    boxes: list[Box] = []
    last: Fraction | None = None
    for entry in roots.items():
        if budget is not None:
            budget.check()
        low, high, solutions = entry.fields("low", "high", "solutions")
        between = _number(low), _number(high)
        if not between[0] < between[1] or (last is not None and between[0] <= last):
            raise entry.fail("expected intervals in ascending order")
        last = between[1]
        listed = [_box(box) for box in solutions.items()]
        for box, found in zip(listed, system.solutions(between, entry, len(listed)), strict=True):
            if not all(a <= c and d <= b for (a, b), (c, d) in zip(box, found, strict=True)):
                raise solutions.fail("a solution is not proved to lie in its box")
        boxes += listed
    if len(boxes) != count.integer():
        raise roots.fail("not all solutions are listed")
    for one, other in combinations(boxes, 2):
        if all(max(a[0], b[0]) <= min(a[1], b[1]) for a, b in zip(one, other, strict=True)):
            raise roots.fail("two boxes meet")


@dataclass(frozen=True, slots=True)
class _System:
    """``equation`` (E) and ``square`` (S, or None); ``full``: the degree of E where no angle is missed. ``u``: its two
    components as (part without m, factor of m); all as polynomials in t over powers of ``norm`` = 1 + t²: u and q over
    norm², v over norm."""

    equation: Polynomial
    full: int
    square: Polynomial | None
    u: tuple[tuple[Polynomial, Surd], tuple[Polynomial, Surd]]
    v: list[Polynomial]
    constants: Sequence[Motion]
    target: Vector
    phi: tuple[Fraction, Fraction]

    @staticmethod
    def of(constants: Sequence[Motion], point: Vector, phi: tuple[Fraction, Fraction]) -> _System:
        """The equations of the derivation above."""
        (turn, shift), second, last = constants[1:]
        target = _back(constants[0], point)
        norm, cosine, sine = _circle(phi)
        norm2, (x, y, z) = sr.times(norm, norm), last[1]
        turned = [
            sr.add(sr.scaled(cosine, x), sr.scaled(sine, -y)),
            sr.add(sr.scaled(sine, x), sr.scaled(cosine, y)),
            sr.scaled(norm, z),
        ]
        v = [sr.add(_combined(row, turned), sr.scaled(norm, o)) for row, o in zip(*second, strict=True)]
        g = [_dot([turn[i][j] for i in range(3)], shift) for j in range(3)]
        n = turn[2]
        half = Surd.rational(Fraction(1, 2))
        lifted = sr.times(v[2], norm)
        squares: Polynomial = []
        for component in v:
            squares = sr.add(squares, sr.times(component, component))
        b1 = sr.scaled(norm2, (_dot(target, target) - _dot(shift, shift)) * half)
        b1 = sr.add(sr.add(b1, sr.scaled(squares, -half)), sr.scaled(lifted, -g[2]))
        b2 = sr.add(sr.scaled(norm2, target[2] - shift[2]), sr.scaled(lifted, -n[2]))
        kappa = sr.times(sr.add(sr.times(v[0], v[0]), sr.times(v[1], v[1])), norm2)
        determinant = g[0] * n[1] - g[1] * n[0]
        square = None
        if determinant:
            over = determinant.inverse()
            u = [
                (sr.add(sr.scaled(b1, n[1] * over), sr.scaled(b2, -g[1] * over)), ZERO),
                (sr.add(sr.scaled(b2, g[0] * over), sr.scaled(b1, -n[0] * over)), ZERO),
            ]
            equation = sr.scaled(kappa, -ONE)
            for component, _ in u:
                equation = sr.add(equation, sr.times(component, component))
            full = 8
        else:
            along, d, equation = (b1, g[:2], b2) if g[0] or g[1] else (b2, n[:2], b1)
            length = d[0] * d[0] + d[1] * d[1]
            if not length:
                raise Unable("the first two joints turn about one axis")
            over = length.inverse()
            if g[0] or g[1]:
                equation = sr.add(equation, sr.scaled(b1, -_dot(n[:2], d) * over))
            square = sr.add(sr.scaled(kappa, length), sr.scaled(sr.times(along, along), -ONE))
            u = [(sr.scaled(along, d[0] * over), -d[1] * over), (sr.scaled(along, d[1] * over), d[0] * over)]
            full = 4
        while len(equation) > 2 and not (parts := sr.divided(equation, norm))[1]:
            equation, full = parts[0], full - 2
        return _System(equation, full, square, (u[0], u[1]), v, constants, target, phi)

    def total(self, between: Interval | None = None) -> int:
        """The number of solutions (t, m) with t real, or in an interval."""
        if len(self.equation) == 1:
            return 0
        roots = sr.tarski(self.equation, [ONE], between)
        if self.square is None or not roots:
            return roots
        if not self.square:
            return roots
        signs = sr.tarski(self.equation, self.square, between)
        nonzero = sr.tarski(self.equation, sr.times(self.square, self.square), between)
        return (nonzero + signs) + (roots - nonzero)  # two for each positive one, one where it vanishes

    def solutions(self, between: Interval, entry: Entry, wanted: int) -> Iterator[Box]:
        """Boxes around the solutions over the one root in an interval."""
        if any(not sr.at(self.equation, x) for x in between):
            raise entry.fail("an end is a root")
        if len(self.equation) == 1 or sr.tarski(self.equation, [ONE], between) != 1:
            raise entry.fail("expected exactly one root in the interval")
        if self.total(between) != wanted or not wanted:
            raise entry.fail("not the number of solutions over this root")
        if self.square is None or wanted == 1:
            yield self._box(between, (Fraction(0), Fraction(0)), entry)
            return
        low, high = sr.root(sr.enclosure(self.square, between, BITS), BITS)
        yield self._box(between, (-high, -low), entry)
        yield self._box(between, (low, high), entry)

    def _box(self, t: Interval, m: Interval, entry: Entry) -> Box:
        def over(p: Polynomial) -> Interval:
            return sr.enclosure(p, t, BITS)

        norm, cosine, sine = map(over, _circle(self.phi))
        u = [sr.plus(over(p), sr.product(m, c.interval(BITS))) for p, c in self.u]
        v = [over(p) for p in self.v]
        (turn, shift), norm2 = self.constants[1], sr.product(norm, norm)
        image = [*u, sr.product(v[2], norm)]
        q = []
        for row, o in zip(turn, shift, strict=True):
            total = sr.product(norm2, o.interval(BITS))
            for c, part in zip(row, image, strict=True):
                total = sr.plus(total, sr.product(c.interval(BITS), part))
            q.append(total)
        x, y = (c.interval(BITS) for c in self.target[:2])
        return (
            *_angle(q[:2], (x, y), entry, "the point is on the first axis"),
            *_angle(v[:2], u, entry, "the second joint is free"),
            _quotient(cosine, norm),
            _quotient(sine, norm),
        )


def _angle(a: Sequence[Interval], b: Sequence[Interval], entry: Entry, free: str) -> tuple[Interval, Interval]:
    """Cosine and sine of the angle from a to b: (a·b, a x b) / (|a| |b|)."""
    sizes = [sr.plus(sr.product(w[0], w[0]), sr.product(w[1], w[1])) for w in (a, b)]
    below = sr.root(sr.product(*sizes), BITS)
    if any(size[0] <= 0 for size in sizes) or below[0] <= 0:
        raise entry.fail(f"{free}, or the interval is too wide to tell")
    inner = sr.plus(sr.product(a[0], b[0]), sr.product(a[1], b[1]))
    outer = sr.product(a[1], b[0])
    across = sr.plus(sr.product(a[0], b[1]), (-outer[1], -outer[0]))
    return _quotient(inner, below), _quotient(across, below)


def _quotient(a: Interval, b: Interval) -> Interval:
    """a / b for b > 0."""
    return sr.product(a, (1 / b[1], 1 / b[0]))


def _circle(phi: tuple[Fraction, Fraction]) -> tuple[Polynomial, Polynomial, Polynomial]:
    """1 + t², and cos θ3 and sin θ3 times it."""
    c, s = phi
    rows = ((1, 0, 1), (c, -2 * s, -c), (s, 2 * c, -s))
    a, b, d = (sr.trimmed([Surd.rational(v) for v in row]) for row in rows)
    return a, b, d


def _dot(a: Sequence[Surd], b: Sequence[Surd]) -> Surd:
    total = ZERO
    for x, y in zip(a, b, strict=True):
        total = total + x * y
    return total


def _combined(row: Sequence[Surd], parts: Sequence[Polynomial]) -> Polynomial:
    total: Polynomial = []
    for c, part in zip(row, parts, strict=True):
        total = sr.add(total, sr.scaled(part, c))
    return total


def _back(motion: Motion, point: Vector) -> Vector:
    """The inverse motion: rotations are orthogonal."""
    rows, shift = motion
    moved = [a - b for a, b in zip(point, shift, strict=True)]
    return [_dot([row[j] for row in rows], moved) for j in range(3)]


# --- reading -----------------------------------------------------------------------------------------------------


def _constants(entry: Entry) -> list[Motion]:
    """What lies before, between and after the joints."""
    convention, rows = entry.fields("convention", "rows")
    modified = convention.text() == "modified"
    if not modified and convention.text() != "standard":
        raise convention.fail("expected modified or standard")
    listed = list(rows.items())
    if len(listed) > MOST_ROWS:
        raise rows.fail(f"expected at most {MOST_ROWS} rows")
    found, open_part = list[Motion](), _still()
    for row in listed:
        a, alpha, d, theta, joint = row.fields("a", "alpha", "d", "theta", "joint")
        across = _turn((1, 2), _angle_of(alpha), [_rational(a), ZERO, ZERO])
        along = _turn((0, 1), _angle_of(theta), [ZERO, ZERO, _rational(d)])
        if joint.value is not None and joint.text() != "revolute":
            raise joint.fail("expected null or revolute")
        before, after = (across, along) if modified else (_still(), _together(along, across))
        open_part = _together(open_part, before)
        if joint.value is not None:
            found.append(open_part)
            open_part = _still()
        open_part = _together(open_part, after)
    if len(found) != 3:
        raise rows.fail("expected three joints")
    return [*found, open_part]


def _still() -> Motion:
    return ([ONE, ZERO, ZERO], [ZERO, ONE, ZERO], [ZERO, ZERO, ONE]), [ZERO, ZERO, ZERO]


def _turn(plane: tuple[int, int], angle: tuple[Surd, Surd], shift: Vector) -> Motion:
    """A turn in the plane of two axes, and a shift along the third one: they commute."""
    (c, s), (i, j) = angle, plane
    rows, _ = _still()
    rows[i][i], rows[i][j], rows[j][i], rows[j][j] = c, -s, s, c
    return rows, shift


def _together(first: Motion, second: Motion) -> Motion:
    rows, shift = first
    columns = [[row[j] for row in second[0]] for j in range(3)]
    a, b, c = ([_dot(row, column) for column in columns] for row in rows)
    return (a, b, c), [_dot(row, second[1]) + o for row, o in zip(rows, shift, strict=True)]


def _angle_of(entry: Entry) -> tuple[Surd, Surd]:
    """An integer k for k pi / 12, or [cosine, sine]."""
    if isinstance(entry.value, int) and not isinstance(entry.value, bool):
        if abs(entry.value) > 24:
            raise entry.fail("expected at most 24 twelfths of pi")
        return _cosine(entry.value), _cosine(entry.value - 6)
    values = [_number(item) for item in entry.items()]
    if len(values) != 2 or values[0] ** 2 + values[1] ** 2 != 1:
        raise entry.fail("expected cosine and sine")
    return Surd.rational(values[0]), Surd.rational(values[1])


def _cosine(k: int) -> Surd:
    """cos(k pi / 12)."""
    k = abs(k) % 24
    k = min(k, 24 - k)
    if k > 6:
        return -_cosine(12 - k)
    quarter, half = Fraction(1, 4), Fraction(1, 2)
    return Surd.of(
        (
            ((1, Fraction(1)),),
            ((2, quarter), (6, quarter)),
            ((3, half),),
            ((2, half),),
            ((1, half),),
            ((2, -quarter), (6, quarter)),
            (),
        )[k]
    )


def _rational(entry: Entry) -> Surd:
    return Surd.rational(_number(entry))


def _number(entry: Entry) -> Fraction:
    value = entry.rational()
    if max(value.numerator.bit_length(), value.denominator.bit_length()) > MOST_BITS:
        raise Unable(f"{entry.path}: a number of more than {MOST_BITS} bits")
    return value


def _surd(entry: Entry) -> Surd:
    """A list of [q, d]: the sum of q √d, d squarefree."""
    pairs = list[tuple[int, Fraction]]()
    for item in entry.items():
        parts = list(item.items())
        if len(parts) != 2 or len(pairs) == MOST_TERMS:
            raise item.fail(f"expected at most {MOST_TERMS} pairs of a factor and a number under a root")
        q, d = _number(parts[0]), parts[1].integer(1)
        if d > sr.LARGEST:
            raise Unable(f"{item.path}: a root of more than {sr.LARGEST}")
        if not sr.is_squarefree(d):
            raise item.fail("expected a squarefree number under the root")
        pairs.append((d, q))
    return Surd.of(pairs)


def _box(entry: Entry) -> Box:
    """[[low, high] of cosine, [low, high] of sine] of every joint."""
    found = []
    for joint in entry.items():
        for part in joint.items():
            ends = [_number(v) for v in part.items()]
            if len(ends) != 2:
                raise part.fail("expected two ends")
            found.append((ends[0], ends[1]))
    if len(found) != 6:
        raise entry.fail("expected cosine and sine of three joints")
    return tuple(found)

"""The convex problems of the planning method as polynomials: three quadratic or three cubic Bezier curves."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import Formula, Relation

Vector = Sequence[Poly]
Coordinates = Sequence[int | Fraction]

CUBIC_LABELS = ("P1", "P2", "Q1", "Q2", "R1", "R2")
QUADRATIC_LABELS = ("Q1", "P1", "R1")


def norm(v: Vector) -> Poly:
    """|v|^2."""
    total = v[0] * v[0]
    for c in v[1:]:
        total = total + c * c
    return total


def _scaled(points: Sequence[Coordinates]) -> int:
    """The least common denominator."""
    return lcm(*(Fraction(c).denominator for p in points for c in p))


def cubic(
    q0: Coordinates, r0: Coordinates, r2: int | Fraction, *, hemisphere: bool = False
) -> tuple[Poly, list[Poly], int]:
    """(k^2 times the objective, forms <= 0, k): the six balls of (7) after elimination, in the variables of Q1 and Q2.

    With ``hemisphere`` the last coordinates of the six points are nonnegative. k clears denominators.
    """
    n, k = len(q0), _scaled([q0, r0])
    ring = Ring.of(tuple(f"{p}{i}" for p in "ab" for i in range(n)))
    a, b = ([ring.var(f"{p}{i}") * k for i in range(n)] for p in "ab")
    via, last = ([ring.constant(int(Fraction(c) * k)) for c in p] for p in (q0, r0))
    p1 = [4 * v - 4 * x + y for v, x, y in zip(via, a, b, strict=True)]
    p2 = [2 * v - x for v, x in zip(via, a, strict=True)]
    r1 = [2 * v - y for v, y in zip(last, b, strict=True)]
    r_2 = [x - 4 * y + 4 * v for x, y, v in zip(a, b, last, strict=True)]
    points = [p1, p2, a, b, r1, r_2]
    steps = [_minus(a, via), _minus(b, a), _minus(last, b)]
    objective = norm(steps[0]) + norm(steps[1]) + norm(steps[2])
    return objective, _inside(points, r2, k, hemisphere), k


def quadratic(
    q0: Coordinates, r0: Coordinates, r2: int | Fraction, *, hemisphere: bool = False
) -> tuple[Poly, list[Poly], int]:
    """The same for formula (8): three balls for Q1."""
    n, k = len(q0), _scaled([q0, r0])
    ring = Ring.of(tuple("xyz"[:n]))
    x = [ring.gen(i) * k for i in range(n)]
    via, last = ([ring.constant(int(Fraction(c) * k)) for c in p] for p in (q0, r0))
    points = [x, [2 * v - c for v, c in zip(via, x, strict=True)], [2 * v - c for v, c in zip(last, x, strict=True)]]
    return norm(_minus(x, via)) + norm(_minus(last, x)), _inside(points, r2, k, hemisphere), k


def _minus(u: Vector, v: Vector) -> list[Poly]:
    return [a - b for a, b in zip(u, v, strict=True)]


def _inside(points: Sequence[Vector], r2: int | Fraction, k: int, hemisphere: bool) -> list[Poly]:
    bound = Fraction(r2) * k * k
    forms = [norm(p) * bound.denominator - bound.numerator for p in points]
    return forms + [-p[-1] for p in points] if hemisphere else forms


def at_most_zero(forms: Sequence[Poly]) -> Formula:
    """The conjunction form <= 0 of all."""
    return conj(atom(p, Relation.LE) for p in forms)

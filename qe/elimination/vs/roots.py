"""The real roots of polynomials of low degree: one table, a row for each root that can be told from the others.

A row of a polynomial f with leading coefficient a /= 0 says where the root is real, and ``slope``: the sign with which
f may cross zero there. THEOREM. Let f turn from <= 0 to > 0, or from < 0 to >= 0, at e, going right. Then e is the
point of a row whose conditions hold and whose slope is positive; and so with signs changed. Proof: degree 1: the
slope is a. Degree 2: f falls at the smaller root for a > 0 and rises at the greater one; the formula with branch 1
is the one where f' = sqrt(D) >= 0. Double roots are both. Degree 3, a > 0: with D < 0 f rises at its only root. With
D >= 0 it rises at x1, falls at x2, and rises at x3 if they differ. At x1 = x2 < x3 f touches zero from below: it turns
to >= 0 there (x1), and to < 0 right of it (x2). At x1 < x2 = x3 it touches it from above: it turns to <= 0 there (x2),
and to > 0 right of it (x3). At a triple root it rises (x1, x3). For a < 0 take -f.
A further degree is a further entry of ``ROWS``, a kind of root, and its substitution.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qe.elimination.vs.points import CubicRoot, LinearRoot, QuadraticRoot, Root
from qe.exact.ring import Poly
from qe.formula.syntax import Relation

Condition = tuple[Poly, Relation]


@dataclass(frozen=True, slots=True)
class Row:
    """``point`` is a root where the leading coefficient is not 0 and the conditions ``real`` hold."""

    point: Root
    real: tuple[Condition, ...]
    slope: Poly


def _linear(coefficients: Sequence[Poly], epsilon: int) -> tuple[Row, ...]:
    b, a = coefficients
    return (Row(LinearRoot(a, b, epsilon), (), a),)


def _quadratic(coefficients: Sequence[Poly], epsilon: int) -> tuple[Row, ...]:
    c, b, a = coefficients
    real = ((b * b - 4 * (a * c), Relation.GE),)
    return tuple(Row(QuadraticRoot(a, b, c, s, epsilon), real, a.ring.constant(s)) for s in (-1, 1))


CUBIC = ((0, Relation.LT, 1), (1, Relation.GE, 1), (2, Relation.GE, -1), (3, Relation.GE, 1))
"""Index of the root, what the discriminant is compared with 0 by, and the slope in units of a."""


def _cubic(coefficients: Sequence[Poly], epsilon: int) -> tuple[Row, ...]:
    d, c, b, a = coefficients
    points = ((CubicRoot((d, c, b, a), index, epsilon), relation, s) for index, relation, s in CUBIC)
    return tuple(Row(p, ((p.discriminant, relation),), a * s) for p, relation, s in points)


ROWS: dict[int, Callable[[Sequence[Poly], int], tuple[Row, ...]]] = {1: _linear, 2: _quadratic, 3: _cubic}
"""By degree; the arguments are the coefficients from degree 0 up, and the side of the root on which points lie."""

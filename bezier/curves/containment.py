"""Proof that a whole curve stays inside a workspace, or an exact parameter where it does not.

Three tests, each finer than the one before:

1. control polygon: all control points lie in the convex condition, so the curve does (convex hull property);
2. Bernstein: all Bernstein coefficients of margin(P(t)) are nonnegative, on [0, 1] or after bisection. For a
   ball, c_k = sum_{i+j=k} C(n,i) C(n,j) / C(2n,k) P_i . P_j <= r^2 follows from |P_i| <= r by Cauchy-Schwarz,
   so this test accepts strictly more curves;
3. roots: the signs of margin(P(t)) between its roots (``bezier.curves.nonnegative``), which decide contact too.

The certificate is a derivation: no point of the curve, for 0 <= t <= 1, is outside the condition
(``bezier.curves.sentences``).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Interval, Negative, Nonnegative, decide, subdivided
from bezier.curves.scalar import Terms, Vector, exactly, sign
from bezier.curves.sentences import CurveSentence
from bezier.curves.workspace import Condition, HalfSpace
from qe.formula.syntax import Relation
from qe.proof.certificate import Certificate


class Argument(Enum):
    """Which argument proved that a curve is inside; ``value`` is for people."""

    POLYGON = "control polygon"
    BERNSTEIN = "Bernstein coefficients"
    ROOTS = "square-free part and roots"


@dataclass(frozen=True, slots=True)
class Inside:
    """The whole curve satisfies the condition.

    ``proof`` shows margin(P(t)) >= 0 on [0, 1]; it is None when the control polygon already proves it.
    """

    condition: Condition
    test: Argument
    proof: Nonnegative | None

    @property
    def touches(self) -> tuple[Interval, ...]:
        """Parameters where the curve is on the boundary, where the finer tests were needed to see them."""
        return self.proof.touches if self.proof else ()


@dataclass(frozen=True, slots=True)
class Leaves:
    """The curve violates the condition at the rational parameter ``t``."""

    condition: Condition
    t: Fraction
    point: Vector
    margin: Any


Outcome = Inside | Leaves


def examine(curve: Bezier, condition: Condition) -> Outcome:
    """Prove the whole curve inside one convex condition, or find a parameter where it leaves.

    Complete: one of the two is always returned (``Unable`` only past the subdivision limit).
    """
    if all(sign(condition.margin(p)) >= 0 for p in curve.points):  # the condition is convex
        return Inside(condition, Argument.POLYGON, None)
    return examine_closely(curve, condition)


def examine_closely(curve: Bezier, condition: Condition) -> Outcome:
    """Like ``examine``, without the control polygon test: also finds where the curve touches the boundary."""
    outcome = decide(condition.margin_along(curve))
    if isinstance(outcome, Negative):
        return Leaves(condition, outcome.t, curve.point(outcome.t), outcome.value)
    return Inside(condition, Argument.BERNSTEIN if outcome.boxes else Argument.ROOTS, outcome)


def examine_all(curve: Bezier, conditions: Iterable[Condition]) -> tuple[Outcome, ...]:
    """``examine`` for each condition."""
    return tuple(examine(curve, condition) for condition in conditions)


MAX_DEPTH = 14


def containment(curve: Bezier, inside: Inside) -> Certificate | None:
    """The certificate; None where a curve over a number field touches the boundary at an irrational parameter, where
    no intervals with nonnegative Bernstein coefficients exist."""
    sentence = CurveSentence(curve, ([(margin_terms(inside.condition), Relation.LT)],))
    breaks = [Fraction(0), Fraction(1)] if sentence.theta is None else _breaks(curve, inside)
    return None if breaks is None else sentence.refuted([[(low, high, 0) for low, high in pairwise(breaks)]])


def _breaks(curve: Bezier, inside: Inside) -> list[Fraction] | None:
    if inside.proof is None:
        return [Fraction(0), Fraction(1)]
    if inside.proof.boxes:
        return sorted({end for box in inside.proof.boxes for end in box})
    margin = inside.condition.margin_along(curve)
    touches = {low for low, high in inside.touches if low == high}
    result = [Fraction(0)]
    for low, high in pairwise(sorted({Fraction(0), Fraction(1), *touches})):
        boxes = subdivided(bs.restrict(margin, low, high), MAX_DEPTH)
        if not isinstance(boxes, tuple):
            return None
        result += (low + end * (high - low) for _, end in boxes)
    return result


def margin_terms(condition: Condition) -> Terms:
    """The margin of a condition as a polynomial in the coordinates."""
    if isinstance(condition, HalfSpace):
        size = len(condition.normal)
        linear = {_unit(size, i): exactly(c) for i, c in enumerate(condition.normal)}
        return {(0,) * size: condition.offset, **linear}
    centre = [exactly(c) for c in condition.centre]
    size = len(centre)
    terms = {_unit(size, i, 2): Fraction(-1) for i in range(size)}
    terms |= {_unit(size, i): 2 * c for i, c in enumerate(centre)}
    return {(0,) * size: condition.radius_squared - sum(c * c for c in centre), **terms}


def _unit(size: int, i: int, exponent: int = 1) -> tuple[int, ...]:
    return tuple(exponent if k == i else 0 for k in range(size))

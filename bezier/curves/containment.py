"""Proof that a whole curve stays inside a workspace, or an exact parameter where it does not.

Three tests, each finer than the one before:

1. control polygon: all control points lie in the convex condition, so the curve does (convex hull property);
2. Bernstein: all Bernstein coefficients of margin(P(t)) are nonnegative, on [0, 1] or after bisection. For a
   ball, c_k = sum_{i+j=k} C(n,i) C(n,j) / C(2n,k) P_i . P_j <= r^2 follows from |P_i| <= r by Cauchy-Schwarz,
   so this test accepts strictly more curves;
3. roots: the square-free decomposition of margin(P(t)) (``bezier.curves.nonnegative``), which decides contact too.

Certificates for whole curves: what ``qe.verify`` multiplies out to see that a curve stays in a condition.

The certificate holds the control points over one number field, the condition, and breaks of [0, 1] such that
margin(P(t)) has nonnegative Bernstein coefficients between neighbouring breaks.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from itertools import pairwise
from math import floor
from typing import Any

from bezier.curves import bernstein as bs
from bezier.curves.curve import Bezier
from bezier.curves.nonnegative import Interval, Negative, Nonnegative, decide
from bezier.curves.scalar import Vector, rational, sign
from bezier.curves.workspace import Ball, Condition, HalfSpace
from qe.errors import InternalError
from qe.proof.certificate import Certificate, Kind


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


def polygon_inside(points: Iterable[Sequence[Any]], condition: Condition) -> bool:
    """Whether every control point satisfies the (convex) condition, exactly."""
    return all(sign(condition.margin(p)) >= 0 for p in points)


def examine(curve: Bezier, condition: Condition) -> Outcome:
    """Prove the whole curve inside one convex condition, or find a parameter where it leaves.

    Complete: one of the two is always returned (``Unable`` only past the subdivision limit).
    """
    if polygon_inside(curve.points, condition):
        return Inside(condition, Argument.POLYGON, None)
    return examine_closely(curve, condition)


def examine_closely(curve: Bezier, condition: Condition) -> Outcome:
    """Like ``examine``, without the control polygon test: also finds where the curve touches the boundary."""
    outcome = decide(condition.margin_along(curve))
    if isinstance(outcome, Negative):
        return Leaves(condition, outcome.t, curve.point(outcome.t), outcome.value)
    return Inside(condition, Argument.ROOTS if outcome.is_factored else Argument.BERNSTEIN, outcome)


def examine_all(curve: Bezier, conditions: Iterable[Condition]) -> tuple[Outcome, ...]:
    """``examine`` for each condition."""
    return tuple(examine(curve, condition) for condition in conditions)


def all_inside(outcomes: Iterable[Outcome]) -> bool:
    """Whether no outcome is a violation."""
    return all(isinstance(outcome, Inside) for outcome in outcomes)


MAX_DEPTH = 14


def containment(curve: Bezier, inside: Inside) -> Certificate | None:
    """The certificate, or None where the curve touches the boundary at an irrational parameter.

    There no breaks with nonnegative coefficients exist; the square-free decomposition is then the only proof.
    """
    breaks = _breaks(curve, inside)
    if breaks is None:
        return None
    payload: dict[str, Any] = {
        **curve_payload(curve),
        "condition": _condition(inside.condition),
        "breaks": [str(t) for t in breaks],
    }
    return Certificate(Kind("containment"), payload)


def curve_payload(curve: Bezier) -> dict[str, Any]:
    """The control points of a curve over one number field, as every certificate about a curve holds them."""
    values = [c for p in curve.points for c in p]
    return {"field": _field(values), "points": [[_coefficients(c) for c in p] for p in curve.points]}


def _breaks(curve: Bezier, inside: Inside) -> list[Fraction] | None:
    if inside.proof is None:
        return [Fraction(0), Fraction(1)]
    if not inside.proof.is_factored:
        return sorted({end for box in inside.proof.boxes for end in box})
    margin = inside.condition.margin_along(curve)
    touches = {low for low, high in inside.touches if low == high}
    result = [Fraction(0)]
    for low, high in pairwise(sorted({Fraction(0), Fraction(1), *touches})):
        ends = _bisected(bs.restrict(margin, low, high), low, high, 0)
        if ends is None:
            return None
        result += ends
    return result


def _bisected(b: bs.Coefficients, low: Fraction, high: Fraction, depth: int) -> list[Fraction] | None:
    """Right ends of parts of [low, high] on each of which all coefficients are nonnegative."""
    if all(sign(c) >= 0 for c in b):
        return [high]
    if depth == MAX_DEPTH:
        return None
    middle = (low + high) / 2
    left, right = bs.split(b)
    first = _bisected(left, low, middle, depth + 1)
    second = None if first is None else _bisected(right, middle, high, depth + 1)
    return None if first is None or second is None else first + second


def _field(values: Iterable[Any]) -> dict[str, Any]:
    theta = next((v.field.theta for v in values if rational(v) is None), None)
    if theta is None:
        return {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
    return field_json(theta, 96)


def field_json(theta: Any, bits: int) -> dict[str, Any]:
    """An irrational theta by its minimal polynomial and an isolating interval of at least ``bits`` good bits.

    The interval depends on theta alone, not on what was computed with it before: its ends are neighbouring multiples
    of a power of 1/2. So whoever reads theta from a file and writes it again writes the same text.
    """
    # narrow enough for a checker to see at once that there is one root, and a simple one
    height = max(abs(c) for c in theta.minimal_polynomial).bit_length()
    low, high = dyadic_interval(theta, max(bits, 64 + height))
    return {"minimal_polynomial": [str(c) for c in theta.minimal_polynomial], "interval": [str(low), str(high)]}


def dyadic_interval(theta: Any, bits: int) -> tuple[Fraction, Fraction]:
    """The neighbouring multiples of 2^(e - bits) around an irrational theta with 2^e < |theta| < 2^(e + 1)."""
    working = bits + 32
    while True:
        ends = [Fraction(end) for end in theta.interval(working)]
        if ends[0] * ends[1] > 0 and _size(ends[0]) == _size(ends[1]):
            unit = Fraction(2) ** (_size(ends[0]) - bits)
            first, last = (floor(end / unit) for end in ends)
            if first == last:
                return first * unit, (first + 1) * unit
        working *= 2


def _size(value: Fraction) -> int:
    """The e with 2^e <= |value| < 2^(e + 1)."""
    result = value.numerator.bit_length() - value.denominator.bit_length()
    return result if abs(value) >= Fraction(2) ** result else result - 1


def _coefficients(value: Any) -> list[str]:
    number = rational(value)
    if number is not None:
        return [str(number)]
    coefficients = list(value.coefficients)
    while len(coefficients) > 1 and not coefficients[-1]:
        coefficients.pop()
    return [str(c) for c in coefficients]


def _condition(condition: Condition) -> dict[str, Any]:
    """The checker's form: |p - centre|^2 <= radius_squared, or normal . p <= offset."""
    if isinstance(condition, Ball):
        return {"centre": [str(c) for c in condition.centre], "radius_squared": [str(condition.radius_squared)]}
    if isinstance(condition, HalfSpace):
        return {"normal": [str(-c) for c in condition.normal], "offset": str(condition.offset)}
    raise InternalError(f"no certificate for the condition {condition.name}")

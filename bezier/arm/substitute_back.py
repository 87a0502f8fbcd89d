"""The reduction of an arm, checked against the forward kinematics of its model by putting the angles back, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from bezier.arm.elimination import M, Quotient, Reduction, T
from bezier.arm.kinematics import position
from bezier.arm.model import Arm, Motion
from bezier.arm.ratio import Ratio, reduced
from qe.errors import InternalError
from qe.exact.field import NumberField
from qe.exact.ring import Poly, Ring


def confirm(arm: Arm, reduction: Reduction, point: Sequence[Ratio]) -> None:
    """Put cosines and sines back into the forward kinematics, for all points at once.

    Multiplied by their denominators, c² + s² - 1 of every joint and position minus point have to leave no remainder on
    division by m² - square and then by the equation in t (pseudo-division: so they vanish at every root where the
    leading coefficient does not). Raises ``InternalError`` otherwise.
    """
    field, ring = arm.field, reduction.ring
    tops = [tuple(_top(q, field) for q in quotients) for quotients in reduction.values]
    bottoms = [Ratio(quotients[0].bottom, 1, field) for quotients in reduction.values]
    zeros = [c * c + s * s - d * d for (c, *rest), d in zip(tops, bottoms, strict=True) for s in rest]
    whole = Ratio(ring.constant(1), 1, field)
    for d in bottoms:
        whole = whole * d
    for coordinate, p in zip(_general_position(arm), point, strict=True):
        total = -(whole * p)
        for exponents, c in coordinate:
            term = Ratio(c.convert(ring), 1, field) * Fraction(1, coordinate.bottom)
            for k, (known, d) in enumerate(zip(tops, bottoms, strict=True)):
                used = [top for top, e in zip(known, exponents[2 * k : 2 * k + 2], strict=False) if e]
                term = term * (used[0] if used else d)
            total = total + term
        zeros.append(total)
    for value in zeros:
        if any(
            leaves_remainder(part, reduction.coefficients, field) for part in _without_m(value.top, reduction, field)
        ):
            raise InternalError("the reduction of an arm contradicts its forward kinematics")


def _top(q: Quotient, field: NumberField) -> Ratio:
    return Ratio(q.top * q.scale.numerator, q.scale.denominator, field)


class _Coordinate(list[tuple[tuple[int, ...], Poly]]):
    """Terms in cosines and sines (exponents of c1, s1, c2, s2, ...; a length stands for a cosine), over ``bottom``."""

    bottom: int = 1


def _general_position(arm: Arm) -> list[_Coordinate]:
    """The forward kinematics as polynomials in cosines and sines, or lengths, of the joints: of degree 1 in each."""
    names = [f"{letter}{k}" for k in range(len(arm.joints)) for letter in "cs"]
    ring = Ring.of(("w", *names))
    variables = [Ratio(ring.var(name), 1, arm.field) for name in names]
    values: dict[str, Any] = {
        j.name: (variables[2 * k], variables[2 * k + 1]) if j.motion is Motion.REVOLUTE else variables[2 * k]
        for k, j in enumerate(arm.joints)
    }
    found = []
    for value in position(arm, values):
        ratio = value if isinstance(value, Ratio) else variables[0] * 0 + value
        terms = _Coordinate(ratio.top.collected(range(1, ring.size)).items())
        terms.bottom = ratio.bottom
        found.append(terms)
    return found


def _without_m(p: Poly, reduction: Reduction, field: NumberField) -> tuple[Poly, ...]:
    """The coefficients of 1 and m after m² was replaced."""
    if reduction.square is None:
        return (p,)
    found = list(p.coefficients(p.ring.index[M]))
    while len(found) > 2:
        lead = found.pop()
        found[-2] = reduced(found[-2] + lead * reduction.square, field)
    return tuple(found)


def leaves_remainder(p: Poly, divisor: Sequence[Poly], field: NumberField) -> bool:
    """Whether pseudo-division by a polynomial in t (coefficients from degree 0 up) leaves a remainder."""
    t = p.ring.index[T]
    rest = list(p.coefficients(t))
    lead = divisor[-1]
    while len(rest) >= len(divisor):
        first = rest.pop()
        rest = [reduced(c * lead, field) for c in rest]
        offset = len(rest) - len(divisor) + 1
        for k, c in enumerate(divisor[:-1]):
            rest[offset + k] = reduced(rest[offset + k] - first * c, field)
    return any(bool(c) for c in rest)

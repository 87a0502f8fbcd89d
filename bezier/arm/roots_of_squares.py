"""Arms, numbers and real roots as the checker of arms has them: in sums of square roots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from typing import Any

from bezier.arm.model import Angle, Arm
from bezier.curves.scalar import rational
from bezier.proofs.nested_roots import Place
from bezier.proofs.square_roots import ONE, Ball, Interval, Polynomial, Surd, Triple, divided
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic, irreducible_roots
from qe.exact.algebraic_text import square_part
from qe.exact.ball_roots import certified_roots
from qe.exact.balls import ends, precision
from qe.proof.entry import Json


def arm_json(arm: Arm) -> Json:
    """The rows of an arm, exactly: angles as twelfths of pi or as [cosine, sine]."""
    rows: list[Json] = [
        {
            "a": str(row.a),
            "alpha": _angle(row.alpha),
            "d": str(row.d),
            "theta": _angle(row.theta),
            "joint": None if row.joint is None else row.joint.motion.value,
        }
        for row in arm.rows
    ]
    return {"convention": arm.convention.value, "rows": rows}


def _angle(angle: Angle) -> Json:
    return angle.twelfths if angle.twelfths is not None else [str(angle.cosine), str(angle.sine)]


def surds(numbers: Sequence[Any]) -> Triple:
    """Sums of square roots. Raises ``Unable`` for other numbers."""
    return tuple(Surd.of(square_roots(v).items()) for v in numbers)


Terms = dict[int, Fraction]


def square_roots(value: Any) -> Terms:
    """The number as a sum of factors times square roots of squarefree numbers. Raises ``Unable`` where it is none.

    Half the sum of it and a conjugate has those terms that the change of signs between these two leaves, and so a
    smaller degree; every term of a number of degree more than 2 is in one of these. If all of them are such sums, so is
    the number: their sum is half of it, as often as there are others, and half the sum of these.
    """
    number = rational(value)
    if number is not None:
        return {1: number} if number else {}
    a: RealAlgebraic = value if isinstance(value, RealAlgebraic) else value.to_algebraic()
    if a.degree == 2:
        mean = Fraction(-a.minimal_polynomial[1], 2 * a.minimal_polynomial[2])
        square = rational((a - mean) * (a - mean)) or Fraction(0)
        outside = square_part(square.numerator * square.denominator)
        d, q = square.numerator * square.denominator // outside**2, Fraction(outside, square.denominator)
        return {**({1: mean} if mean else {}), d: q if a > mean else -q}
    conjugates, result = irreducible_roots(a.poly), Terms()
    refused = Unable("poses, and certificates of joint positions, are for coordinates that are sums of square roots")
    if len(conjugates) < a.degree:
        raise refused  # some are not real
    for half in ((a + b) * Fraction(1, 2) for b in conjugates if b != a):
        if 2 * half.degree > a.degree:
            raise refused
        result |= square_roots(half)
    return result


# --- real roots ------------------------------------------------------------------------------------------------------
@dataclass(frozen=True, eq=False)
class RootPlace(Place):
    """A real root known to any number of digits: that of this index, of a modulus without multiple roots."""

    index: int

    def around(self, bits: int) -> Interval:
        return ends(_real_roots(self.modulus, bits)[self.index])


def roots_of(p: Polynomial) -> list[RootPlace]:
    """The real roots, ascending, of a polynomial that is not zero, in disjoint intervals whose ends are no roots."""
    simple = divided(p, common_factor(p, p.derivative))[0] if len(p) > 1 else Polynomial((ONE,))
    modulus, bits = simple.by(simple[-1].inverse()), 40
    while True:
        spare = Fraction(1, 1 << bits)
        around = [(low - spare, high + spare) for low, high in map(ends, _real_roots(modulus, bits))]
        if all(a[1] < b[0] for a, b in pairwise(around)):
            return [RootPlace(modulus, between, k) for k, between in enumerate(around)]
        bits *= 2


@lru_cache(maxsize=256)
def _real_roots(p: Polynomial, bits: int) -> list[Ball]:
    """Balls at most 2^-bits wide around the real roots of a polynomial without multiple ones."""
    working = 2 * bits
    while len(p) > 1:
        with precision(working):
            balls = certified_roots([c.ball() for c in p], working)
            if balls is not None and all(2 * x.rad() < Ball(2) ** -bits for x in balls):
                return balls
        working *= 2
    return []


def common_factor(a: Polynomial, b: Polynomial) -> Polynomial:
    """The greatest common divisor, by Euclid's algorithm with leading coefficient 1."""
    while b:
        b = b.by(b[-1].inverse())
        a, b = b, divided(a, b)[1]
    return a

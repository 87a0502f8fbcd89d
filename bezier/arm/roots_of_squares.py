"""Arms, numbers and real roots as the checker of arms has them: in sums of square roots."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from itertools import pairwise
from math import lcm
from operator import mul
from typing import Any

from bezier.arm.model import Angle, Arm
from bezier.curves.scalar import rational
from bezier.proofs.nested_roots import Place
from bezier.proofs.square_roots import ONE, Polynomial, Surd, Triple, enclosure, primes
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic, irreducible_roots, real_roots
from qe.exact.algebraic_text import square_part
from qe.exact.balls import precision
from qe.exact.ring import Ring
from qe.proof.entry import Json

APPARENT = 400
"""So many binary places show of most numbers that they are not 0."""


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


def surd_json(value: Any) -> Json:
    """A sum of square roots as [factor, number under the root]."""
    return [[str(q), d] for d, q in sorted(square_roots(value).items()) if q]


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
        d, q = _root(rational((a - mean) * (a - mean)) or Fraction(0))
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


def _root(square: Fraction) -> tuple[int, Fraction]:
    whole = square.numerator * square.denominator
    outside = square_part(whole)
    return whole // outside**2, Fraction(outside, square.denominator)


# --- real roots ------------------------------------------------------------------------------------------------------
@dataclass(frozen=True, eq=False)
class RootPlace(Place):
    """A real root that is known to any number of digits."""

    root: RealAlgebraic

    def around(self, bits: int) -> tuple[Fraction, Fraction]:
        return self.root.interval(bits)


def roots_of(p: Polynomial) -> list[RootPlace]:
    """The real roots, ascending, of a polynomial that is not zero, in disjoint intervals whose ends are no roots."""
    _, *others = conjugates(p)
    if not others:
        return zeros_among([p])
    near = [place for place in zeros_among([p]) if _may_vanish(p, place)]
    # one of the conjugates vanishes there: p, if no other one does
    listed = [p_at for p_at in near if not any(_may_vanish(q, p_at) for q in others) or not p_at.value(p).sign()]
    return [replace(place, modulus=p.by(p[-1].inverse())) for place in listed]


def conjugates(p: Polynomial) -> list[Polynomial]:
    """What changes of the signs of square roots make of it, itself first; their product is rational."""
    listed = [p]
    for prime in sorted({prime for c in p for d, _ in c.terms for prime in primes(d)}):
        listed += [Polynomial(tuple(c.conjugate(prime) for c in q)) for q in listed]
    return listed


def _may_vanish(p: Polynomial, place: Place) -> bool:
    with precision(APPARENT):
        return bool(enclosure(p, place.around(APPARENT)).contains(0))


def zeros_among(polynomials: Iterable[Polynomial]) -> list[RootPlace]:
    """The real roots of polynomials and of their conjugates, likewise."""
    ring, roots, bits = Ring.of(("t",)), set[RealAlgebraic](), 40
    for p in polynomials:
        norm = [c.terms[0][1] if c else Fraction(0) for c in reduce(mul, conjugates(p))]
        below = lcm(*(c.denominator for c in norm))
        whole = ring.from_terms({(k,): int(c * below) for k, c in enumerate(norm) if c})
        roots |= {*real_roots(whole.to_univariate(0))}
    ordered = sorted(roots)
    while True:
        ends = [_around(root, bits) for root in ordered]
        if all(a[1] < b[0] for a, b in pairwise(ends)):
            return list(map(_place, ordered, ends))
        bits *= 2


def _around(root: RealAlgebraic, bits: int) -> tuple[Fraction, Fraction]:
    low, high = root.interval(bits)
    return (low - Fraction(1, 1 << bits), high + Fraction(1, 1 << bits)) if root.is_rational else (low, high)


def _place(root: RealAlgebraic, between: tuple[Fraction, Fraction]) -> RootPlace:
    *rest, lead = root.minimal_polynomial
    return RootPlace(Polynomial((*(Surd.rational(Fraction(c, lead)) for c in rest), ONE)), between, root)

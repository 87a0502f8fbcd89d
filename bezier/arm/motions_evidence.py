"""Certificates of kind "motions": all continuous joint motions along a path, which ``qe.verify`` checks."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor

from bezier.arm.arm_json import arm_json, curve_json
from bezier.arm.continuous import ContinuousMotions
from bezier.arm.critical import Number, S
from bezier.arm.signs_along import SignsAlong
from bezier.arm.square_roots import square_roots
from qe.certify.verify import verify
from qe.errors import Unable
from qe.exact.balls import precision
from qe.exact.field import FieldElement, NumberField
from qe.exact.ring import Poly
from qe.exact.sample import Point
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Json

ATTEMPTS = (16, 40, 100, 250)
"""Binary places of the intervals around what is special: more where such places lie close together."""

PRECISIONS = (128, 512, 2048)

Coefficients = list[FieldElement]


def motions_certificate(found: ContinuousMotions) -> Certificate:
    """The certificate that these are all continuous motions, accepted by the checker. Raises ``Unable`` where there is
    none."""
    factors = [[(s, _factor(signs, s)) for s in signs.places] for signs in found.curves]
    reason = ""
    for bits in ATTEMPTS:
        listed: list[Json] = [[_place(s, factor, bits) for s, factor in places] for places in factors]
        curves: list[Json] = [curve_json(signs.along.curve) for signs in found.curves]
        solutions: list[Json] = [len(arcs.labels) for arcs in found.arcs]
        through: list[Json] = [len(junction.passes) for junction in found.junctions]
        payload: dict[str, Json] = {"arm": arm_json(found.arm), "curves": curves, "places": listed}
        payload |= {"solutions": solutions, "through": through, "motions": found.count}
        certificate = Certificate(Kind("motions"), payload)
        verdict = verify(certificate)
        if verdict.accepted:
            return certificate
        reason = verdict.reason
    raise Unable(f"no certificate of the continuous motions was found: {reason}")


def _place(s: Number, factor: Json, bits: int) -> Json:
    """An interval around s."""
    low, high = (s, s) if isinstance(s, Fraction) else s.interval(bits + 4)
    unit = Fraction(1, 1 << bits)
    ends = floor(low / unit - 1) * unit, ceil(high / unit + 1) * unit
    return {"low": str(ends[0]), "high": str(ends[1]), "factor": factor}


def _factor(signs: SignsAlong, s: Number) -> Json:
    """A polynomial with a simple zero at s that divides W, N and A as often as they vanish there; None for N itself."""
    field = signs.along.arm.field
    if isinstance(s, Fraction):
        return _written([field.rational(-s), field.rational(1)])
    here = signs.along.place(s)
    quality = signs.quality
    norm = None if quality is None else quality.norm.top
    if norm is not None and not signs.has_no_square(s) and _is_apparent(here, norm.derivative(S)):
        return None
    found = [field.rational(c) for c in s.minimal_polynomial]
    for p in (signs.square, norm, None if quality is None else quality.even.top):
        while p and here.sign(p) == 0:
            found = _common_factor(found, _coefficients(p, field))
            p = p.derivative(S)
    return _written(found)


def _is_apparent(here: Point, p: Poly) -> bool:
    """Whether balls show that p does not vanish: exact zero tests take long where degrees are high."""
    reduced = here.reduce(p)
    for bits in PRECISIONS:
        with precision(bits):
            if not here.enclose(reduced, bits).contains(0):
                return True
    return False


def _coefficients(p: Poly, field: NumberField) -> Coefficients:
    """Of a polynomial in w and s, from degree 0 up."""
    return [field.element([c.constant_value() for c in part.coefficients(0)]) for part in p.coefficients(S)]


def _common_factor(a: Coefficients, b: Coefficients) -> Coefficients:
    """The greatest common divisor, by Euclid's algorithm with leading coefficient 1."""
    while b:
        over = b[-1].inverse()
        b = [c * over for c in b]
        rest = list(a)
        while len(rest) >= len(b):
            lead = rest.pop()
            for k in range(1, len(b)):
                rest[-k] = rest[-k] - lead * b[-k - 1]
        while rest and not rest[-1]:
            rest.pop()
        a, b = b, rest
    return a


def _written(p: Coefficients) -> Json:
    return [[[str(q), d] for d, q in sorted(square_roots(c).items())] for c in p]

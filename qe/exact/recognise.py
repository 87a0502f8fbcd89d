"""From many digits to an exact candidate: minimal polynomials and field elements by lattice reduction.

A short integer relation between 1, x, …, x^d (or between the basis of a number field and x) is found by LLL
(Lenstra–Lenstra–Lovász 1982; Kannan–Lenstra–Lovász 1988: with enough digits the minimal polynomial of an
algebraic number is found with certainty). What is returned is a *candidate* that agrees with many more digits
than it was made from; the caller must prove it by exact arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import arb, fmpq, fmpq_poly, fmpz, fmpz_mat, fmpz_poly

from qe.exact.algebraic import RealAlgebraic, irreducible_factors, irreducible_roots
from qe.exact.balls import precision
from qe.exact.field import FieldElement, NumberField

Digits = Callable[[int], arb]  # an approximation with error below 2^-bits

_EXTRA = 96  # further bits that a candidate has to agree with
# (largest degree, bits) tried in this order: each step costs a few times the one before
_SCHEDULE = ((1, 64), (2, 128), (4, 320), (8, 800), (12, 1800), (16, 2800), (24, 5000), (32, 9000), (40, 14000))


def _rounded(x: arb, bits: int) -> fmpz:
    scaled = (x * arb(2) ** bits).mid()
    return fmpz((scaled + arb(0.5)).floor().unique_fmpz() or 0)


def relation(values: Sequence[arb], bits: int) -> list[fmpz]:
    """A shortest-vector candidate (a_i) with sum a_i*values_i within about 2^-bits of zero."""
    n = len(values)
    with precision(2 * bits + 64):
        rows = [[int(i == j) for j in range(n)] + [_rounded(v, bits)] for i, v in enumerate(values)]
    reduced = fmpz_mat(rows).lll()
    return [reduced[0, j] for j in range(n)]


def _powers(x: arb, count: int) -> list[arb]:
    out = [arb(1)]
    for _ in range(count):
        out.append(out[-1] * x)
    return out


def algebraic_candidate(digits: Digits, max_degree: int) -> RealAlgebraic | None:
    """The real algebraic number that the digits seem to be of, of degree at most ``max_degree``."""
    for degree, bits in _SCHEDULE:
        full = bits + _EXTRA + 32
        x = digits(full)
        with precision(full + 32):
            coefficients = relation(_powers(x, degree), bits)
            p = fmpz_poly(coefficients)
            agrees = p.degree() > 0 and abs(p(x)) < arb(2) ** -(bits + _EXTRA // 2)
        if agrees:
            found = _nearest_root(p, x, bits)
            if found is not None:
                return found
        if degree >= max_degree:
            return None
    return None


def _nearest_root(p: fmpz_poly, x: arb, bits: int) -> RealAlgebraic | None:
    """The root of p that lies within 2^(-bits/4) of x, if there is one."""
    with precision(bits + _EXTRA + 64):
        reach = arb(x.mid(), arb(2) ** -(bits // 4))
        for factor, _ in irreducible_factors(p):
            if factor(reach).contains(0):
                for root in irreducible_roots(factor):
                    if root.ball(bits).overlaps(reach):
                        return root
    return None


def element_candidate(field: NumberField, digits: Digits) -> FieldElement | None:
    """The element of the field that the digits seem to be of.

    Searched in the form (a_0 + … + a_{d-1} theta^{d-1}) / (c * p'(theta)) with p the minimal polynomial of
    theta: in this form the coefficients stay as short as those of p (rational univariate representation,
    Rouillier 1999).
    """
    p = field.theta.poly
    degree, slope = p.degree(), p.derivative()
    bits = 64 + (degree + 1) * (24 + int(p.height_bits()) // 2)
    for _ in range(4):
        full = bits + _EXTRA + 32
        x = digits(full)
        with precision(full + 32):
            theta = field.theta.ball(full)
            values = [x * slope(theta), *_powers(theta, degree - 1)]
            found = relation(values, bits)
            rest = arb(0)
            for a, v in zip(found, values, strict=True):
                rest += v * a
            if found[0] != 0 and abs(rest) < arb(2) ** -(bits + _EXTRA // 2):
                top = fmpq_poly([fmpq(-a, found[0]) for a in found[1:]])
                return FieldElement(field, top) / FieldElement(field, fmpq_poly(slope) % field.modulus)
        bits *= 2
    return None

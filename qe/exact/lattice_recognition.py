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

_EXTRA = 128  # further bits that a candidate has to agree with
# (largest degree, bits) tried in this order: each step costs a few times the one before
SCHEDULE = (
    *((1, 64), (2, 128), (4, 320), (8, 800), (12, 1800), (16, 2800)),
    *((20, 5500), (28, 9000), (40, 15000)),
)


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


def algebraic_candidate(digits: Digits, degree: int, bits: int) -> RealAlgebraic | None:
    """The real algebraic number that the digits seem to be of, of degree at most ``degree``, from ``bits`` digits.

    The number is scaled by a power of two to about 1, so that all coefficients weigh alike.
    """
    full = bits + 2 * bits // (degree + 1) + _EXTRA  # the coefficients amplify the error of x
    x = digits(full)
    with precision(full + 32):
        shift = _magnitude(x)
        scaled = x * arb(2) ** -shift
        coefficients = relation(_powers(scaled, degree), bits)
        p = fmpz_poly(coefficients)
        if p.degree() <= 0 or not abs(p(scaled)) < arb(2) ** -(bits + _EXTRA // 2):
            return None
        # p(x / 2^shift), without denominators
        up, down, top = max(shift, 0), max(-shift, 0), p.degree()
        unscaled = [c << (up * (top - i) + down * i) for i, c in enumerate(p.coeffs())]
    return _nearest_root(fmpz_poly(unscaled), x, bits - abs(shift))


def _magnitude(x: arb) -> int:
    middle = x.mid()
    if middle.is_zero():
        return 0
    mantissa, exponent = middle.man_exp()
    return max(-64, min(64, int(exponent) + int(abs(mantissa)).bit_length()))


def _nearest_root(p: fmpz_poly, x: arb, bits: int) -> RealAlgebraic | None:
    """The root of p that lies within 2^(-bits/4) of x, if there is one."""
    with precision(2 * bits + _EXTRA + 64):
        reach = arb(x.mid(), arb(2) ** -(bits // 4))
        for factor, _ in irreducible_factors(p):
            if factor(reach).contains(0):
                for root in irreducible_roots(factor):
                    if root.ball(bits).overlaps(reach):
                        return root
    return None


class FieldLattice:
    """Recognition of many elements of one field: the lattice of small values at theta is reduced once per precision."""

    def __init__(self, field: NumberField) -> None:
        self.field = field
        self.bits = 64 + (field.degree + 1) * (16 + int(field.theta.poly.height_bits()))
        self._reduced: dict[int, list[list[fmpz]]] = {}
        slope = fmpq_poly(field.theta.poly.derivative()) % field.modulus
        self.slope_inverse = FieldElement(field, slope).inverse()

    def relation(self, value: arb, bits: int) -> list[fmpz]:
        """A short (c, a_0, …, a_{d-1}) with c*value + a_0 + … + a_{d-1}*theta^(d-1) near zero."""
        d = self.field.degree
        basis = self._reduced.get(bits)
        if basis is None:
            powers = _powers(self.field.theta.ball(2 * bits), d - 1)
            rows = [[int(i == j) for j in range(d)] + [_rounded(v, bits)] for i, v in enumerate(powers)]
            reduced = fmpz_mat(rows).lll()
            basis = self._reduced[bits] = [[reduced[i, j] for j in range(d + 1)] for i in range(d)]
        extended = [[fmpz(0), *row] for row in basis] + [[fmpz(1), *[fmpz(0)] * d, _rounded(value, bits)]]
        short = fmpz_mat(extended).lll()
        return [short[0, j] for j in range(d + 1)]


def element_candidate(lattice: FieldLattice, digits: Digits) -> FieldElement | None:
    """The element of the lattice's field that the digits seem to be of.

    Searched in the form (a_0 + … + a_{d-1} theta^{d-1}) / (c * p'(theta)) with p the minimal polynomial of
    theta: in this form the coefficients stay as short as those of p (rational univariate representation,
    Rouillier 1999).
    """
    field, p = lattice.field, lattice.field.theta.poly
    degree, slope = p.degree(), p.derivative()
    for _ in range(4):
        bits = lattice.bits
        full = bits + 2 * bits // (degree + 1) + degree * max(0, _magnitude(field.theta.ball())) + _EXTRA
        x = digits(full)
        with precision(2 * full + 32):
            theta = field.theta.ball(full)
            value = x * slope(theta)
            multiples = lattice.relation(value, bits)
            rest = value * multiples[0]
            for a, v in zip(multiples[1:], _powers(theta, degree - 1), strict=True):
                rest += v * a
            if multiples[0] != 0 and abs(rest) < arb(2) ** -(bits + _EXTRA // 2):
                top = fmpq_poly([fmpq(-a, multiples[0]) for a in multiples[1:]])
                found: FieldElement = FieldElement(field, top) * lattice.slope_inverse
                return found
        lattice.bits *= 2
    return None

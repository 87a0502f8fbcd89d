"""The zeros of a zero-dimensional ideal from its multiplication matrices: the rational univariate representation.

For a linear form t that takes different values at different zeros, every coordinate of a zero is one rational
function of the value of t there: x = g_x(t)/g_1(t), where g_v(T) is the sum over all zeros a of
mult(a)*v(a)*f(T)/(T - t(a)) and f is squarefree with the values t(a) as roots (Rouillier 1999). So the real zeros are
the real roots of f, and their coordinates are elements of the field of the root.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count

from flint import fmpq, fmpq_mat, fmpq_poly

from qe.errors import InternalError
from qe.exact.algebraic import RealAlgebraic, irreducible_factors, irreducible_roots
from qe.exact.field import FieldElement, NumberField
from qe.exact.ring import Poly


@dataclass(frozen=True, slots=True)
class Zero:
    """A real zero: an element of a real number field for every variable, and the multiplicity of the zero.

    ``FieldElement.interval(bits)`` gives an isolating interval of any width, ``sign`` exact signs, ``to_algebraic`` the
    minimal polynomial.
    """

    values: Mapping[str, FieldElement]
    multiplicity: int

    def box(self, bits: int = 64) -> dict[str, tuple[object, object]]:
        """Rational bounds of every coordinate with about so many bits."""
        return {name: value.interval(bits) for name, value in self.values.items()}

    def sign(self, poly: Poly) -> int:
        """The sign of a polynomial in the variables at the zero, exactly."""
        values = [self.values.get(name) for name in poly.ring.names]
        total = next(iter(self.values.values())).field.rational(0)
        for exponents, c in poly.terms():
            term = total.field.rational(c)
            for value, k in zip(values, exponents, strict=True):
                if k and value is not None:
                    term = term * value**k
            total = total + term
        return total.sign()


def zeros_of(matrices: Sequence[fmpq_mat], traces: fmpq_mat, distinct: int, names: Sequence[str]) -> list[Zero]:
    """All real zeros, sorted by the value of the separating form that was found."""
    matrix, f = _separating(matrices, distinct)
    vectors = _krylov(matrix, distinct)
    tails = [fmpq_poly(f.coeffs()[j + 1 :]) for j in range(distinct)]

    def numerator(row: fmpq_mat) -> fmpq_poly:
        return sum(((row * v)[0, 0] * tail for v, tail in zip(vectors, tails, strict=True)), fmpq_poly())

    weight = numerator(traces)
    tops = [numerator(traces * m) for m in matrices]
    zeros: list[tuple[RealAlgebraic, Zero]] = []
    for factor, _ in irreducible_factors(f.numer()):
        roots = irreducible_roots(factor)
        if not roots:
            continue
        modulus = fmpq_poly(factor)
        inverse = _inverse(weight % modulus, modulus)
        multiplicity = (weight * _inverse(f.derivative() % modulus, modulus)) % modulus
        if multiplicity.degree() > 0:
            raise InternalError("a zero has no multiplicity of its own")
        values = [top * inverse % modulus for top in tops]
        for root in roots:
            field = NumberField(root)
            point = {name: FieldElement(field, value) for name, value in zip(names, values, strict=True)}
            zeros.append((root, Zero(point, int(multiplicity[0].p))))
    return [zero for _, zero in sorted(zeros, key=lambda pair: pair[0])]


def _separating(matrices: Sequence[fmpq_mat], distinct: int) -> tuple[fmpq_mat, fmpq_poly]:
    """Multiplication by a linear form with ``distinct`` values at the zeros, and the polynomial with these roots."""
    for form in linear_forms(len(matrices)):
        matrix = fmpq_mat(matrices[0].nrows(), matrices[0].ncols())
        for k, m in zip(form, matrices, strict=True):
            if k:
                matrix += m * fmpq(k)
        f = matrix.charpoly()
        f = f / f.gcd(f.derivative())
        if f.degree() == distinct:
            return matrix, f / f.leading_coefficient()
    raise InternalError("no linear form separates the zeros")  # pragma: no cover: almost all of them do


def linear_forms(size: int) -> Iterator[list[int]]:
    """Single variables first, then (1, k, k^2, …): each pair of zeros agrees for fewer than ``size`` of these k."""
    for k in range(size - 1, -1, -1):
        yield [int(i == k) for i in range(size)]
    for k in count(1):
        yield [k**i for i in range(size)]


def _krylov(matrix: fmpq_mat, length: int) -> list[fmpq_mat]:
    """1, t, t^2, … as coordinate columns: 1 is the first monomial of the basis."""
    size = matrix.nrows()
    vector = fmpq_mat(size, 1, [fmpq(i == 0) for i in range(size)])
    powers = []
    for _ in range(length):
        powers.append(vector)
        vector = matrix * vector
    return powers


def _inverse(value: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly:
    if modulus.degree() == 1:
        return fmpq_poly([1 / value[0]])
    common, factor, _ = value.xgcd(modulus)
    if common.degree() != 0:
        raise InternalError("a factor of a univariate representation is reducible")
    return factor / common

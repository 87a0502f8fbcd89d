"""Towers of real number fields Q(a_1, …, a_h), as Q[x_1..x_h] modulo a triangular set.

Each modulus T_j is monic in x_j and irreducible over the field of the earlier coordinates, so the set is
a Groebner basis for the lexicographic order (the main variable leads), the quotient is a field, and an
element is zero iff its normal form is. Irreducible factors over a tower are found with norms (Trager 1976).
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from typing import TypeAlias

from flint import arb, fmpq_mpoly, fmpz, fmpz_poly

from qe.errors import InternalError
from qe.exact.algebraic import irreducible_factors
from qe.exact.balls import FIRST_PRECISION, precision
from qe.exact.ring import Poly, Ring

Element: TypeAlias = "fmpq_mpoly"


class Tower:
    """The field; ``variables`` are ring indices, ascending, ``moduli`` the triangular set."""

    __slots__ = ("moduli", "ring", "variables")

    ring: Ring
    variables: tuple[int, ...]
    moduli: tuple[Element, ...]

    def __init__(self, ring: Ring, variables: tuple[int, ...] = (), moduli: tuple[Element, ...] = ()) -> None:
        self.ring, self.variables, self.moduli = ring, variables, moduli

    def extended(self, variable: int, modulus: Element) -> Tower:
        """The tower with one more coordinate; ``modulus`` monic irreducible over this field."""
        return Tower(self.ring, (*self.variables, variable), (*self.moduli, modulus))

    @property
    def degree(self) -> int:
        """The degree over Q."""
        product = 1
        for variable, modulus in zip(self.variables, self.moduli, strict=True):
            product *= degree_in(self.ring, modulus, variable)
        return product

    # --- elements --------------------------------------------------------------------------
    def embed(self, p: Poly) -> Element:
        """The polynomial over Q, coefficients reduced; other variables are left alone."""
        return self.reduce(fmpq_mpoly(p.p, self.ring.qctx))

    def reduce(self, a: Element) -> Element:
        """The normal form: one division per modulus, highest variable first."""
        for modulus in reversed(self.moduli):
            a = a % modulus
        return a

    def is_zero(self, p: Poly) -> bool:
        """Whether p (in the tower's variables only) vanishes at the tower's point."""
        return not self.embed(p)

    def inverse(self, a: Element) -> Element:
        """1/a for a nonzero element, by the extended Euclidean algorithm from the top coordinate down."""
        position = self._top(a)
        if position < 0:
            return self.ring.qctx.constant(1 / a.leading_coefficient())
        variable, modulus = self.variables[position], self.moduli[position]
        below = Tower(self.ring, self.variables[:position], self.moduli[:position])
        r0, r1 = modulus, a
        s0, s1 = self.ring.qctx.constant(0), self.ring.qctx.constant(1)
        while degree_in(self.ring, r1, variable):
            scale = below.inverse(leading_in(self.ring, r1, variable))
            r1, s1 = below.reduce(r1 * scale), below.reduce(s1 * scale)
            quotient, rest = divmod(r0, r1)
            r0, r1 = r1, below.reduce(rest)
            s0, s1 = s1, below.reduce((s0 - quotient * s1) % modulus)
        if not r1:
            raise InternalError("a tower modulus is reducible")
        return below.reduce(s1 * below.inverse(r1))

    def _top(self, a: Element) -> int:
        degrees = a.degrees()
        for position in range(len(self.variables) - 1, -1, -1):
            if degrees[self.ring.slot(self.variables[position])]:
                return position
        return -1

    # --- univariate polynomials over the field -----------------------------------------------
    def monic(self, f: Element, variable: int) -> Element:
        """f divided by its leading coefficient in ``variable`` (above the tower); f reduced and nonzero."""
        lead = leading_in(self.ring, f, variable)
        if lead.is_one():
            return f
        return self.reduce(f * self.inverse(lead))

    def gcd(self, f: Element, g: Element, variable: int) -> Element:
        """The monic greatest common divisor in K[variable]; f and g reduced, not both zero."""
        if degree_in(self.ring, f, variable) < degree_in(self.ring, g, variable):
            f, g = g, f
        while g:
            g = self.monic(g, variable)
            f, g = g, self.reduce(f % g)
        return self.monic(f, variable)

    def squarefree_part(self, f: Element, variable: int) -> Element:
        """f / gcd(f, f'), monic."""
        f = self.monic(f, variable)
        common = self.gcd(f, f.derivative(self.ring.slot(variable)), variable)
        if degree_in(self.ring, common, variable) == 0:
            return f
        quotient, _ = divmod(f, common)
        return self.reduce(quotient)

    def norm(self, f: Element, variable: int) -> fmpz_poly:
        """A positive multiple of the norm of f, as an integer polynomial in ``variable``."""
        current = clear_denominators(self.ring, f)
        for position in range(len(self.variables) - 1, -1, -1):
            modulus = clear_denominators(self.ring, self.moduli[position])
            current = modulus.resultant(current, self.variables[position]).normal()[1]
        return current.to_univariate(variable)

    def irreducible_factor(
        self, f: Element, variable: int, ball: Callable[[int], arb], own: Callable[[int, int], arb]
    ) -> Element:
        """The monic irreducible factor of squarefree f over the field that vanishes at the number in ``ball(bits)``.

        ``own(i, bits)`` encloses the tower's coordinate i. Trager 1976: after a shift by a multiple of a generator
        the norm is squarefree, and its factors over Q correspond to those of f over the field.
        """
        f = self.monic(f, variable)
        if degree_in(self.ring, f, variable) == 1:
            return f
        gens = self.ring.qctx.gens()
        main = gens[self.ring.slot(variable)]
        for s in count(0):
            weights = [s * (position + 1) + s * s * (position > 0) for position in range(len(self.variables))]
            shift = self.ring.qctx.constant(0)
            for weight, i in zip(weights, self.variables, strict=True):
                shift += weight * gens[self.ring.slot(i)]
            images = [main - shift if gen == main else gen for gen in gens]
            shifted = self.reduce(f.compose(*images, ctx=self.ring.qctx))
            norm = self.norm(shifted, variable)
            if norm.gcd(norm.derivative()).degree() == 0:
                break
        factors = irreducible_factors(norm)
        if len(factors) == 1:
            return f
        chosen = self._vanishing([q for q, _ in factors], weights, ball, own)
        image = self.ring.qctx.constant(0)
        for c in reversed(chosen.coeffs()):
            image = self.reduce(image * (main + shift)) % f + c
        return self.gcd(f, self.reduce(image), variable)

    def _vanishing(
        self, factors: list[fmpz_poly], weights: list[int], ball: Callable[[int], arb], own: Callable[[int, int], arb]
    ) -> fmpz_poly:
        """The only one of coprime polynomials that vanishes at ball + Σ weight_i * coordinate_i."""
        bits = FIRST_PRECISION
        while len(factors) > 1:
            x, others = ball(bits), [own(i, bits) for i in self.variables]
            with precision(bits + 16):
                for weight, value in zip(weights, others, strict=True):
                    x += weight * value
                factors = [q for q in factors if q(x).contains(0)]
            bits *= 2
        return factors[0]


def degree_in(ring: Ring, a: Element, variable: int) -> int:
    """The degree of a in the ring's variable (0 for the zero element)."""
    return int(a.degrees()[ring.slot(variable)]) if a else 0


def leading_in(ring: Ring, a: Element, variable: int) -> Element:
    """The coefficient of the highest power of ``variable``, the highest variable that occurs."""
    degree = degree_in(ring, a, variable)
    slot = ring.slot(variable)
    terms = {}
    for exponents, c in a.terms():
        if exponents[slot] == degree:
            moved = [int(k) for k in exponents]
            moved[slot] = 0
            terms[tuple(moved)] = c
        else:
            break  # the main variable leads in the lexicographic order
    return ring.qctx.from_dict(terms)


def clear_denominators(ring: Ring, a: Element) -> Poly:
    """The element times the (positive) least common denominator of its coefficients."""
    scale = fmpz(1)
    for c in a.coeffs():
        scale = scale * c.q // scale.gcd(c.q)
    return ring.element(ring.ctx.from_dict({m: int((c * scale).p) for m, c in a.terms()}))

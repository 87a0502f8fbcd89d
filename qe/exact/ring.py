"""Polynomial rings over the integers, and their immutable elements.

A ``Ring`` is a tuple of variable names. Variable ``i`` is ``ring.names[i]``; a later variable is
"higher": the *level* of a polynomial is the largest index it contains, its *main variable*. FLINT
stores the variables in reverse, so that its lexicographic order puts the main variable first, which
makes triangular sets of main-variable-monic polynomials Groebner bases for free.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cache, cached_property
from typing import Any

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_poly

from qe.errors import InternalError

_PRIMES = (3, -7, 11, -13, 17, -19, 23, -29, 31, -37, 41, -43, 47, -53, 59, -61)
_ZERO = fmpz(0)


class Ring:
    """Z[names], immutable; compared by identity (``Ring.of`` interns by names)."""

    __slots__ = ("__weakref__", "_gens", "_hash_point", "cache", "ctx", "index", "names", "qctx", "size")

    def __init__(self, names: tuple[str, ...]) -> None:
        if len(set(names)) != len(names):
            raise InternalError(f"repeated variable in ring {names}")
        self.names, self.size = names, len(names)
        self.index = {name: i for i, name in enumerate(names)}
        flint_names = tuple(f"v{i}" for i in range(max(1, self.size)))
        self.ctx = fmpz_mpoly_ctx.get(flint_names, "lex")
        self.qctx = fmpq_mpoly_ctx.get(flint_names, "lex")
        self._gens = self.ctx.gens()
        self._hash_point = tuple(fmpz(_PRIMES[i % 16] + 64 * (i // 16)) for i in range(max(1, self.size)))
        self.cache: dict[object, object] = {}

    @staticmethod
    def of(names: Iterable[str]) -> Ring:
        """The ring with these variable names, lowest first; equal names give the same ring."""
        return _intern(tuple(names))

    def slot(self, i: int) -> int:
        """The FLINT index of variable ``i``."""
        return self.size - 1 - i

    def gen(self, i: int) -> Poly:
        """The polynomial that is variable ``i``."""
        return Poly(self, self._gens[self.size - 1 - i])

    def var(self, name: str) -> Poly:
        """The polynomial that is the variable called ``name``."""
        return self.gen(self.index[name])

    def constant(self, value: int) -> Poly:
        """The constant polynomial ``value``."""
        return Poly(self, self.ctx.constant(value))

    def from_terms(self, terms: Mapping[tuple[int, ...], int]) -> Poly:
        """The polynomial with coefficient ``terms[e]`` at the exponent vector ``e`` (in ring order)."""
        if any(k < 0 for e in terms for k in e):
            raise InternalError("negative exponent")
        if self.size == 0:
            return self.constant(sum(terms.values()))
        return Poly(self, self.ctx.from_dict({tuple(reversed(e)): int(c) for e, c in terms.items()}))

    def remember(self, key: object, value: object) -> None:
        """Store in the ring's cache, which is emptied when it has grown past a bound."""
        if len(self.cache) > 50_000:
            self.cache.clear()
        self.cache[key] = value

    def __repr__(self) -> str:
        return f"Ring({', '.join(self.names)})"

    def __reduce__(self) -> tuple[object, tuple[tuple[str, ...]]]:
        return Ring.of, (self.names,)


@cache
def _intern(names: tuple[str, ...]) -> Ring:
    # FLINT contexts are immortal too, so nothing is lost by keeping the (small) rings.
    return Ring(names)


def guarded_factor(p: fmpz_mpoly) -> tuple[fmpz, list[tuple[fmpz_mpoly, int]]]:
    """``p.factor()``, redone over Q where python-flint 0.9 overflows while sorting the factors."""
    try:
        unit, factors = p.factor()
        return unit, [(f, int(e)) for f, e in factors]
    except OverflowError:
        context = p.context()
        rational = fmpq_mpoly_ctx.get(context.names(), "lex")
        unit, factors = fmpq_mpoly(p, rational).factor()
        result: list[tuple[fmpz_mpoly, int]] = []
        constant = fmpq(unit)
        for factor, exponent in factors:
            scale = fmpz(1)
            for c in factor.coeffs():
                scale = scale * c.q // scale.gcd(c.q)
            integral = context.from_dict({m: int((c * scale).p) for m, c in factor.terms()})
            content = integral.content()
            constant = constant * (fmpq(content) / scale) ** int(exponent)
            result.append((integral / content, int(exponent)))
        return constant.p, result


class Poly:
    """An element of a ring: immutable and hashable. The raw FLINT object never leaves ``qe.exact``."""

    __slots__ = ("__dict__", "_hash", "p", "ring")

    def __init__(self, ring: Ring, p: fmpz_mpoly) -> None:
        self.ring, self.p = ring, p
        self._hash: int | None = None

    # --- value semantics -------------------------------------------------------------------
    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = hash((self.ring.size, int(self.p(*self.ring._hash_point))))
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Poly) and self.ring is other.ring and bool(self.p == other.p)

    def __bool__(self) -> bool:
        return bool(self.p)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return _rebuild, (self.ring.names, tuple((e, int(c)) for e, c in self.terms()))

    def __repr__(self) -> str:
        return f"Poly({format_poly(self)})"

    # --- arithmetic ------------------------------------------------------------------------
    def _lift(self, other: Poly | int) -> fmpz_mpoly | int:
        if isinstance(other, Poly):
            if other.ring is not self.ring:
                raise InternalError(f"polynomials of different rings: {self.ring} and {other.ring}")
            return other.p
        return other

    def __add__(self, other: Poly | int) -> Poly:
        return Poly(self.ring, self.p + self._lift(other))

    __radd__ = __add__

    def __sub__(self, other: Poly | int) -> Poly:
        return Poly(self.ring, self.p - self._lift(other))

    def __rsub__(self, other: int) -> Poly:
        return Poly(self.ring, other - self.p)

    def __mul__(self, other: Poly | int) -> Poly:
        return Poly(self.ring, self.p * self._lift(other))

    __rmul__ = __mul__

    def __neg__(self) -> Poly:
        return Poly(self.ring, -self.p)

    def __pow__(self, exponent: int) -> Poly:
        return Poly(self.ring, self.p**exponent)

    def exact_divide(self, other: Poly | int) -> Poly:
        """The quotient of a division known to leave no remainder."""
        return Poly(self.ring, self.p / self._lift(other))

    # --- structure -------------------------------------------------------------------------
    @cached_property
    def degrees(self) -> tuple[int, ...]:
        """The degree in every variable of the ring, in ring order (0 for the zero polynomial)."""
        if self.ring.size == 0 or not self.p:
            return (0,) * self.ring.size
        return tuple(int(d) for d in reversed(self.p.degrees()))

    def degree(self, i: int) -> int:
        """The degree in variable ``i``."""
        return self.degrees[i]

    @cached_property
    def variables(self) -> tuple[int, ...]:
        """The indices that occur, ascending."""
        return tuple(i for i, d in enumerate(self.degrees) if d)

    @property
    def level(self) -> int:
        """The index of the main variable, or -1 for a constant."""
        return self.variables[-1] if self.variables else -1

    @property
    def is_constant(self) -> bool:
        return not self.variables

    def constant_value(self) -> int:
        """The value of a constant polynomial."""
        return int(self.p.leading_coefficient()) if self.p else 0

    @cached_property
    def total_degree(self) -> int:
        return int(self.p.total_degree()) if self.p else 0

    def term_count(self) -> int:
        return len(self.p)

    def height_bits(self) -> int:
        """The number of bits of the largest coefficient."""
        return max((int(abs(c)).bit_length() for c in self.p.coeffs()), default=0)

    def terms(self) -> list[tuple[tuple[int, ...], int]]:
        """(exponent vector in ring order, coefficient), highest first in the lexicographic order."""
        if self.ring.size == 0:
            return [((), self.constant_value())] if self.p else []
        return [(tuple(int(k) for k in reversed(e)), int(c)) for e, c in self.p.terms()]

    def coefficients(self, i: int) -> tuple[Poly, ...]:
        """The coefficients with respect to variable ``i``, from degree 0 up; () for zero."""
        memory: dict[Any, Any] = self.__dict__
        key = ("coefficients", i)
        stored: tuple[Poly, ...] | None = memory.get(key)
        if stored is None:
            slot, gen, rest, out = self.ring.slot(i), self.ring._gens[self.ring.slot(i)], self.p, []
            while rest:
                lowest = rest.subs({slot: _ZERO})
                out.append(Poly(self.ring, lowest))
                rest = (rest - lowest) / gen
            stored = memory[key] = tuple(out)
        return stored

    def leading(self, i: int) -> Poly:
        """The leading coefficient with respect to variable ``i``."""
        return self.coefficients(i)[-1]

    def derivative(self, i: int) -> Poly:
        return Poly(self.ring, self.p.derivative(self.ring.slot(i)))

    # --- algebra ---------------------------------------------------------------------------
    def gcd(self, other: Poly) -> Poly:
        return Poly(self.ring, self.p.gcd(self._lift(other)))

    def resultant(self, other: Poly, i: int) -> Poly:
        """The resultant with respect to variable ``i``; both need not contain it."""
        m, n = self.degree(i), other.degree(i)
        if m == 0 and n == 0:
            return self.ring.constant(1)
        if m == 0:
            return self**n
        if n == 0:
            return other**m
        return Poly(self.ring, self.p.resultant(self._lift(other), self.ring.slot(i)))

    def discriminant(self, i: int) -> Poly:
        """The discriminant with respect to variable ``i``, of degree at least 1 in it."""
        return Poly(self.ring, self.p.discriminant(self.ring.slot(i)))

    @cached_property
    def _normal(self) -> tuple[int, Poly]:
        if not self.p:
            return 0, self
        content, primitive = self.p.primitive()
        unit = int(content)
        if primitive.leading_coefficient() < 0:
            unit, primitive = -unit, -primitive
        return unit, (self if unit == 1 else Poly(self.ring, primitive))

    def normal(self) -> tuple[int, Poly]:
        """(u, q) with self = u*q, q primitive with positive leading coefficient; (0, 0) for zero."""
        return self._normal

    def factors(self) -> tuple[int, tuple[tuple[Poly, int], ...]]:
        """(unit, ((irreducible primitive factor, multiplicity), ...)), cached in the ring."""
        stored = self.ring.cache.get(("factors", self))
        if stored is None:
            if self.is_constant:
                stored = (self.constant_value(), ())
            else:
                unit, parts = guarded_factor(self.p)
                value, listing = int(unit), []
                for f, e in parts:
                    u, q = Poly(self.ring, f).normal()
                    value *= u**e
                    listing.append((q, e))
                stored = (value, tuple(listing))
            self.ring.remember(("factors", self), stored)
        return stored  # type: ignore[return-value]

    # --- substitution ----------------------------------------------------------------------
    def at_rational(self, i: int, value: Fraction | int) -> Poly:
        """A positive multiple of the polynomial with variable ``i`` set to a rational number."""
        slot = self.ring.slot(i)
        number = Fraction(value)
        if number.denominator == 1:
            return Poly(self.ring, self.p.subs({slot: number.numerator}))
        rational = fmpq_mpoly(self.p, self.ring.qctx).subs({slot: fmpq(number.numerator, number.denominator)})
        return Poly(self.ring, self._clear(rational, number.denominator ** self.degree(i)))

    def _clear(self, rational: fmpq_mpoly, scale: int) -> fmpz_mpoly:
        context = self.ring.ctx
        return context.from_dict({m: int((c * scale).p) for m, c in rational.terms()})

    def evaluate(self, values: Iterable[Fraction | int]) -> Fraction:
        """The value at a rational point (one value per ring variable)."""
        point = [Fraction(v) for v in values]
        if self.ring.size == 0:
            return Fraction(self.constant_value())
        rational = fmpq_mpoly(self.p, self.ring.qctx)
        value = rational(*[fmpq(v.numerator, v.denominator) for v in reversed(point)])
        return Fraction(int(value.p), int(value.q))

    def compose(self, substitution: Mapping[int, Poly]) -> Poly:
        """Replace variables by polynomials of the same ring, simultaneously."""
        ring = self.ring
        images = [substitution[i].p if i in substitution else ring._gens[ring.slot(i)] for i in range(ring.size)]
        return Poly(ring, self.p.compose(*reversed(images), ctx=ring.ctx)) if ring.size else self

    def convert(self, ring: Ring) -> Poly:
        """The same polynomial in another ring that has all variables occurring here (by name)."""
        if ring is self.ring:
            return self
        if not self.variables:
            return ring.constant(self.constant_value())
        missing = [self.ring.names[i] for i in self.variables if self.ring.names[i] not in ring.index]
        if missing:
            raise InternalError(f"{missing} not in {ring}")
        target = [(i, ring.index[self.ring.names[i]]) for i in self.variables]
        terms = {}
        for exponents, coefficient in self.terms():
            moved = [0] * ring.size
            for source, destination in target:
                moved[destination] = exponents[source]
            terms[tuple(moved)] = coefficient
        return ring.from_terms(terms)

    def to_univariate(self, i: int) -> fmpz_poly:
        """The polynomial as a FLINT univariate one; no other variable may occur."""
        slot = self.ring.slot(i)
        coefficients = [0] * (self.degree(i) + 1)
        for exponents, c in self.p.terms():
            coefficients[int(exponents[slot])] = c
        return fmpz_poly(coefficients)


def _rebuild(names: tuple[str, ...], terms: tuple[tuple[tuple[int, ...], int], ...]) -> Poly:
    return Ring.of(names).from_terms(dict(terms))


def from_univariate(ring: Ring, i: int, p: fmpz_poly) -> Poly:
    """The FLINT univariate polynomial ``p`` as a polynomial in variable ``i``."""
    unit = [0] * ring.size
    terms = {}
    for k, c in enumerate(p.coeffs()):
        if c:
            unit[i] = k
            terms[tuple(unit)] = int(c)
    return ring.from_terms(terms)


def format_poly(p: Poly) -> str:
    """Text such as ``x^2 - 2*x*y + 1``, which the text reader reads back."""
    if not p:
        return "0"
    pieces: list[str] = []
    ordered = sorted(p.terms(), key=lambda term: (sum(term[0]), term[0]), reverse=True)
    for exponents, coefficient in ordered:
        powers = [name if k == 1 else f"{name}^{k}" for name, k in zip(p.ring.names, exponents, strict=True) if k]
        magnitude = abs(coefficient)
        body = "*".join(([str(fmpz(magnitude))] if magnitude != 1 or not powers else []) + powers)
        if not pieces:
            pieces.append(f"-{body}" if coefficient < 0 else body)
        else:
            pieces.append(f"{'-' if coefficient < 0 else '+'} {body}")
    return " ".join(pieces)

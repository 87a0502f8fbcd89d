"""Polynomial rings over the integers, and their immutable elements.

A ``Ring`` is a tuple of variable names. Variable ``i`` is ``ring.names[i]``; a later variable is "higher": the *level*
of a polynomial is the largest index it contains, its *main variable*. FLINT stores the variables in reverse, so that
its lexicographic order puts the main variable first: triangular sets monic in main variables are Groebner bases.

Import both from ``qe.exact.ring``, which knows every kind of ring.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from fractions import Fraction
from functools import cache, cached_property, reduce
from math import isqrt, prod
from operator import add
from typing import Any, ClassVar, TypeAlias, TypeVar, cast

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_poly

from qe.errors import BudgetExceeded, InternalError
from qe.exact.factor import guarded_factor
from qe.exact.sparse_text import SparseTerm as SparseTerm
from qe.exact.sparse_text import sparse_text
from qe.spelling import quoted

_PRIMES = (3, -7, 11, -13, 17, -19, 23, -29, 31, -37, 41, -43, 47, -53, 59, -61)
_FEW = 8
MOST_CACHED = 50_000  # values of a ring
T = TypeVar("T")
Factors: TypeAlias = "tuple[int, tuple[tuple[Poly, int], ...]]"


class Ring:
    """Z[names], immutable; compared by identity (``Ring.of`` interns by names).

    A subclass may be meant for rings of ``more_than`` so many variables; ``Ring.of`` takes it there.
    """

    kinds: ClassVar[tuple[tuple[int, type[Ring]], ...]] = ()
    is_wide = False

    def __init_subclass__(cls, *, more_than: int) -> None:
        Ring.kinds += ((more_than, cls),)

    def __init__(self, names: tuple[str, ...]) -> None:
        if len(set(names)) != len(names):
            raise InternalError(f"repeated variable in ring {names}")
        self.names: tuple[str, ...] = names
        self.size: int = len(names)
        self.index: dict[str, int] = {name: i for i, name in enumerate(names)}
        flint_names = tuple(f"v{i}" for i in range(max(1, self.size)))
        self.ctx: fmpz_mpoly_ctx = fmpz_mpoly_ctx.get(flint_names, "lex")
        self.qctx: fmpq_mpoly_ctx = fmpq_mpoly_ctx.get(flint_names, "lex")
        self._hash_point = tuple(fmpz(_PRIMES[i % 16] + 64 * (i // 16)) for i in range(max(1, self.size)))
        self._products: dict[tuple[str, ...], fmpz_mpoly] = {}
        self.cache: dict[object, object] = {}

    @staticmethod
    def of(names: Iterable[str]) -> Ring:
        """The ring with these variable names, lowest first; equal names give the same ring."""
        return _intern(tuple(names))

    @cached_property
    def _gens(self) -> Any:
        """The variables in FLINT, made at their first use: 30,000 take a gigabyte."""
        return self.ctx.gens()

    def slot(self, i: int) -> int:
        """The FLINT index of variable ``i``."""
        return self.size - 1 - i

    def gen(self, i: int) -> Poly:
        """The polynomial that is variable ``i``."""
        return self.element(self._gens[self.size - 1 - i], (i,))

    def var(self, name: str) -> Poly:
        """The polynomial that is the variable called ``name``."""
        return self.gen(self.index[name])

    def constant(self, value: int) -> Poly:
        """The constant polynomial ``value``."""
        return self.element(self.ctx.constant(value), ())

    def element(self, p: fmpz_mpoly, support: Iterable[int] | None = None) -> Poly:
        """The polynomial with this value in FLINT; ``support``, where known, has all variables that occur."""
        return Poly(self, p)

    def from_terms(self, terms: Mapping[tuple[int, ...], int]) -> Poly:
        """The polynomial with coefficient ``terms[e]`` at the exponent vector ``e`` (in ring order)."""
        if any(k < 0 for e in terms for k in e):
            raise InternalError("negative exponent")
        if self.size == 0:
            return self.constant(sum(terms.values()))
        return self.element(self.ctx.from_dict({tuple(reversed(e)): int(c) for e, c in terms.items()}))

    def from_sparse(self, terms: Iterable[SparseTerm]) -> Poly:
        """The polynomial with these terms; see ``Poly.sparse_terms``."""
        return self.from_terms({tuple(dict(powers).get(i, 0) for i in range(self.size)): c for powers, c in terms})

    def combination(self, coefficients: Mapping[tuple[str, ...], int]) -> Poly:
        """The sum of multiples, not by zero, of products of names, each of which is sorted."""
        if len(self._products) > MOST_CACHED:
            self._products.clear()
        parts = [self._product(names) * c for names, c in coefficients.items()]
        while len(parts) > _FEW:  # a sum that grows by one term at a time is copied as often
            parts = [*map(add, parts[::2], parts[1::2]), *parts[len(parts) & ~1 :]]
        support = {self.index[name] for names in coefficients for name in names}
        return self.element(reduce(add, parts), support)

    def _product(self, names: tuple[str, ...]) -> fmpz_mpoly:
        """The product of the variables with these names."""
        if (product := self._products.get(names)) is None:
            product = self.ctx.constant(1)
            if names:
                product = self._product(names[:-1]) * self._gens[self.slot(self.index[names[-1]])]
            self._products[names] = product
        return product

    def hash_of(self, p: Poly) -> int:
        """The hash of a polynomial of the ring: equal for equal values."""
        return hash((self.size, int(p.p(*self._hash_point))))

    def remembered(self, key: object, make: Callable[[], T]) -> T:
        """What is stored under a key of the ring's cache, made where it is not; emptied when grown past a bound."""
        if (stored := self.cache.get(key)) is None:
            stored = make()
            if len(self.cache) > MOST_CACHED:
                self.cache.clear()
            self.cache[key] = stored
        return cast(T, stored)

    def __repr__(self) -> str:
        return f"Ring({', '.join(self.names)})"

    def __reduce__(self) -> tuple[object, tuple[tuple[str, ...]]]:
        return Ring.of, (self.names,)


@cache
def _intern(names: tuple[str, ...]) -> Ring:
    # FLINT contexts are immortal too, so nothing is lost by keeping the (small) rings.
    kinds = [kind for least, kind in Ring.kinds if len(names) > least]
    return (kinds or [Ring])[-1](names)


class Poly:
    """An element of a ring: immutable and hashable. The raw FLINT object never leaves ``qe.exact``."""

    __slots__ = ("__dict__", "_hash", "p", "ring")

    def __init__(self, ring: Ring, p: fmpz_mpoly) -> None:
        self.ring: Ring = ring
        self.p: fmpz_mpoly = p
        self._hash: int | None = None

    # --- value semantics -------------------------------------------------------------------
    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = self.ring.hash_of(self)
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Poly) and self.ring is other.ring and bool(self.p == other.p)

    def __bool__(self) -> bool:
        return bool(self.p)

    def __reduce__(self) -> tuple[object, tuple[object, ...]]:
        return self.ring.from_terms, ({e: int(c) for e, c in self.terms()},)

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
        return self._like(-self.p)

    def __pow__(self, exponent: int) -> Poly:
        return self._like(self.p**exponent)

    def exact_divide(self, other: Poly | int) -> Poly:
        """The quotient of a division known to leave no remainder."""
        return self._like(self.p / self._lift(other))

    def _like(self, p: fmpz_mpoly) -> Poly:
        """A polynomial of the ring in which no other variables occur than here."""
        return Poly(self.ring, p)

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
        return bool(self.p.is_constant())

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

    def sparse_terms(self) -> list[SparseTerm]:
        """The terms without the variables that do not occur in them."""
        return [(tuple((i, e[i]) for i in self.variables if e[i]), c) for e, c in self.terms()]

    def coefficients(self, i: int) -> tuple[Poly, ...]:
        """The coefficients with respect to variable ``i``, from degree 0 up; () for zero."""
        memory: dict[Any, Any] = self.__dict__
        key = ("coefficients", i)
        stored: tuple[Poly, ...] | None = memory.get(key)
        if stored is None:
            slot, gen, rest, out = self.ring.slot(i), self.ring._gens[self.ring.slot(i)], self.p, []
            while rest:
                lowest = rest.subs({slot: fmpz(0)})
                out.append(self._like(lowest))
                rest = (rest - lowest) / gen
            stored = memory[key] = tuple(out)
        return stored

    def collected(self, indices: Collection[int]) -> dict[tuple[int, ...], Poly]:
        """The polynomial as one in the variables ``indices``: exponents there (in the order given) -> coefficient.

        The coefficients are not zero and free of these variables; highest term first.
        """
        inside, coefficients = tuple(indices), dict[tuple[int, ...], dict[tuple[int, ...], int]]()
        for exponents, c in self.terms():
            rest = tuple(0 if i in inside else k for i, k in enumerate(exponents))
            coefficients.setdefault(tuple(exponents[i] for i in inside), {})[rest] = c
        return {key: self.ring.from_terms(terms) for key, terms in coefficients.items()}

    def coefficients_in(self, indices: Collection[int]) -> tuple[Poly, ...]:
        """The distinct coefficients, none zero, of the polynomial as one in the variables ``indices``.

        So it vanishes identically in these variables iff all of them are zero.
        """
        inside = [i for i in self.variables if i in indices]
        if not inside:
            return (self,) if self else ()
        if len(inside) == 1:
            return tuple(dict.fromkeys(c for c in reversed(self.coefficients(inside[0])) if c))
        return tuple(dict.fromkeys(self.collected(inside).values()))

    def leading(self, i: int) -> Poly:
        """The leading coefficient with respect to variable ``i``."""
        return self.coefficients(i)[-1]

    def derivative(self, i: int) -> Poly:
        return self._like(self.p.derivative(self.ring.slot(i)))

    # --- algebra ---------------------------------------------------------------------------
    def gcd(self, other: Poly) -> Poly:
        return Poly(self.ring, self.p.gcd(self._lift(other)))

    def remainder(self, other: Poly) -> Poly:
        """What is left when multiples of another are subtracted as long as its leading term divides a term."""
        return Poly(self.ring, divmod(self.p, self._lift(other))[1])

    def resultant(self, other: Poly, i: int) -> Poly:
        """The resultant with respect to variable ``i``; both need not contain it."""
        m, n = self.degree(i), other.degree(i)
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
        return unit, (self if unit == 1 else self._like(primitive))

    def normal(self) -> tuple[int, Poly]:
        """(u, q) with self = u*q, q primitive with positive leading coefficient; (0, 0) for zero."""
        return self._normal

    def square_root(self) -> Poly | None:
        """A polynomial with this square, or None."""
        unit, factors = self.factors()
        if unit < 0 or isqrt(unit) ** 2 != unit or any(multiplicity % 2 for _, multiplicity in factors):
            return None
        return prod((factor ** (times // 2) for factor, times in factors), start=self.ring.constant(isqrt(unit)))

    def factors(self) -> Factors:
        """(unit, ((irreducible primitive factor, multiplicity), ...)), cached in the ring."""
        return self.ring.remembered(("factors", self), self._factored)

    def _factored(self) -> Factors:
        if self.is_constant:
            return self.constant_value(), ()
        unit, parts = guarded_factor(self.p)
        value, listing = int(unit), []
        for f, e in parts:
            u, q = Poly(self.ring, f).normal()
            value *= u**e
            listing.append((q, e))
        return value, tuple(listing)

    # --- substitution ----------------------------------------------------------------------
    def at_rational(self, i: int, value: Fraction | int | fmpq) -> Poly:
        """A positive multiple of the polynomial with variable ``i`` set to a rational number."""
        top, bottom = fmpz(value.numerator), fmpz(value.denominator)
        if bottom == 1 or not self.p:
            return self._like(self.p.subs({self.ring.slot(i): top}))
        image, power = self.leading(i).p, bottom
        for c in self.coefficients(i)[-2::-1]:
            image, power = image * top + c.p * power, power * bottom
        return self._like(image)

    def at_rationals(self, values: Mapping[int, Fraction | int]) -> Poly:
        """A positive multiple of the polynomial with these variables set to rational numbers."""
        return reduce(lambda f, i: f.at_rational(i, values[i]), values, self)

    def evaluate(self, values: Iterable[Fraction | int]) -> Fraction:
        """The value at a rational point (one value per ring variable)."""
        value = self._at(values)
        return Fraction(int(value.p), int(value.q)) if isinstance(value, fmpq) else Fraction(int(value))

    def sign_at(self, values: Iterable[Fraction | int]) -> int:
        """The sign there."""
        value = self._at(values)
        return (value > 0) - (value < 0)

    def _at(self, values: Iterable[Fraction | int]) -> fmpq | fmpz | int:
        if self.ring.size == 0:
            return self.constant_value()
        point = [v if type(v) is int else fmpq(v.numerator, v.denominator) for v in reversed([*values])]
        return fmpq_mpoly(self.p, self.ring.qctx)(*point) if fmpq in map(type, point) else self.p(*point)

    def at_quotient(self, i: int, top: Poly, bottom: Poly, *, most_terms: int | None = None) -> Poly:
        """bottom^d * p(x_i = top/bottom), a polynomial, where d is the degree of p in x_i.

        Raises ``BudgetExceeded`` where it, or a step on the way to it, has more than ``most_terms`` terms.
        """
        coefficients = self.coefficients(i)
        if not coefficients:
            return self
        image, power = coefficients[-1], self.ring.constant(1)
        for c in reversed(coefficients[:-1]):
            power = power * bottom
            image = image * top + c * power if c else image * top
            if most_terms is not None and image.term_count() > most_terms:
                raise BudgetExceeded("a substitution grows too large", limit="terms")
        return image

    def compose(self, substitution: Mapping[int, Poly]) -> Poly:
        """Replace variables by polynomials of the same ring, simultaneously."""
        ring = self.ring
        images = [substitution[i].p if i in substitution else ring._gens[ring.slot(i)] for i in range(ring.size)]
        return Poly(ring, self.p.compose(*reversed(images), ctx=ring.ctx)) if ring.size else self

    def convert(self, ring: Ring) -> Poly:
        """The same polynomial in another ring that has all variables occurring here (by name)."""
        if ring is self.ring:
            return self
        names, index = self.ring.names, ring.index
        if missing := [names[i] for i in self.variables if names[i] not in index]:
            raise InternalError(f"{missing} not in {ring}")
        if ring.is_wide or self.ring.is_wide:
            moved = ((sorted((index[names[i]], k) for i, k in powers), c) for powers, c in self.sparse_terms())
            return ring.from_sparse((tuple(powers), c) for powers, c in moved)
        if not (ring.size and self.ring.size):
            return ring.constant(self.constant_value())
        slots = {self.ring.slot(i): ring.slot(index[names[i]]) for i in self.variables}
        if ring.ctx is not self.ring.ctx:  # to its own context FLINT projects nothing, whatever is to go where
            return Poly(ring, self.p.project_to_context(ring.ctx, slots))
        images = [ring._gens[slots.get(slot, slot)] for slot in range(ring.size)]
        return Poly(ring, self.p.compose(*images, ctx=ring.ctx))

    def to_univariate(self, i: int) -> fmpz_poly:
        """The polynomial as a FLINT univariate one; no other variable may occur."""
        slot = self.ring.slot(i)
        coefficients = [0] * (self.degree(i) + 1)
        for exponents, c in self.p.terms():
            coefficients[int(exponents[slot])] = c
        return fmpz_poly(coefficients)


def format_poly(p: Poly, spelled: Callable[[str], str] = quoted) -> str:
    """Text such as ``x^2 - 2*x*y + 1``, which the text reader reads back; ``spelled`` writes a name."""
    return sparse_text(p.sparse_terms(), {i: spelled(p.ring.names[i]) for i in p.variables})

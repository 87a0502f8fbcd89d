"""Facts: a background theory of ranges, one per polynomial up to a constant.

Every atom compares a polynomial p = u*q + c (q primitive, without constant term, positive leading
coefficient) with zero, that is q with the rational number -c/u. All atoms with the same q are
about one quantity, so a conjunction of them is a ``Range`` of q (Dolzmann & Sturm, Simplification of
quantifier-free formulae over ordered fields, JSC 24 (1997), section 5: "smart" simplification with an
implicit theory, here with ranges instead of pairwise rules).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache

from qe.exact.ring import Poly, Ring
from qe.exact.watch import IDLE
from qe.formula.syntax import Atom, Atomic, Formula, Relation
from qe.simplifier.minima import minimum
from qe.simplifier.ranges import EVERYTHING, Range, add, compare, make, meet, multiply, power, scale

_ENCLOSED_TERMS = 24  # term count up to which ranges of the variables are propagated through a polynomial
_FACTORED_TERMS = 2000  # above this many terms a polynomial is taken as one factor


@lru_cache(maxsize=5_000)
def generator(ring: Ring, i: int) -> Poly:
    """Variable ``i`` as a polynomial (one object, so that its hash is computed once)."""
    return ring.gen(i)


@lru_cache(maxsize=20_000)
def key_of(poly: Poly) -> tuple[Poly, int, int]:
    """(q, u, c) with poly = u*q + c, u > 0, q primitive without constant term. poly is not constant."""
    ring = poly.ring
    constant = int(poly.evaluate((0,) * ring.size))
    unit, key = (poly - constant).normal() if constant else poly.normal()
    if unit < 0:
        raise AssertionError("an atom's polynomial has a positive leading coefficient")
    return key, unit, constant


@lru_cache(maxsize=20_000)
def place_of(poly: Poly) -> tuple[Poly, Fraction]:
    """(q, v) such that poly has the sign of q - v; see ``key_of``."""
    key, unit, constant = key_of(poly)
    return key, Fraction(-constant, unit)


@lru_cache(maxsize=5_000)
def _terms(key: Poly) -> tuple[tuple[tuple[tuple[int, int], ...], Fraction], ...]:
    return tuple((powers, Fraction(c)) for powers, c in key.sparse_terms())


@lru_cache(maxsize=20_000)
def inherent(key: Poly) -> Range:
    """A range of the polynomial that holds at every real point: above its global minimum, where that is easy."""
    least = minimum(key)
    return EVERYTHING if least is None else Range(least.value, None, False, True)


def variable_of(key: Poly) -> int | None:
    """The index if the polynomial is a bare variable, else None."""
    return key.variables[0] if key.total_degree == 1 and len(key.variables) == 1 else None


def factor_list(poly: Poly) -> tuple[tuple[Poly, int], ...]:
    """The irreducible factors with exponents; a polynomial of very many terms counts as irreducible."""
    primitive = poly.normal()[1]
    if primitive.total_degree == 1 or primitive.term_count() > _FACTORED_TERMS:
        return ((primitive, 1),)
    return primitive.factors()[1]


def _one_sided(key: Poly, gens: Mapping[int, Range]) -> Range:
    """The range above or below zero of a polynomial whose terms all have one sign; it ends at the first that has not.

    The sum is zero only where all terms are, so one term that is not zero keeps the end of the range open.
    """
    signs = {i: _sign(known) for i, known in gens.items()}
    common, strict = 0, False
    for powers, coefficient in key.sparse_terms():
        sign, apart = (1 if coefficient > 0 else -1), True
        for i, k in powers:
            known, nonzero = signs[i]
            if k % 2:
                sign *= known
            apart = apart and nonzero
        if not sign or common == -sign:
            return EVERYTHING
        common, strict = sign, strict or apart
    zero = Fraction(0)
    return make(zero, None, strict, True) if common > 0 else make(None, zero, True, strict)


def _sign(known: Range) -> tuple[int, bool]:
    """1 for a quantity >= 0, -1 for one <= 0, 0 where neither is known; and whether it is known not to be zero."""
    above, below = known.lo is not None and known.lo >= 0, known.hi is not None and known.hi <= 0
    return (1 if above else -1 if below else 0), not known.admits(Fraction(0))


@dataclass(frozen=True, slots=True)
class Facts:
    """What is known to hold: ranges by key polynomial, and literals that are opaque to ranges.

    ``ranges``: key -> range (inherent ranges are not stored). ``literals``: root atoms and quantified
    subformulas known to be true or false. ``watch`` is asked wherever work under the facts may take long.
    ``made``: atoms as ``atom_under`` made them here.
    """

    ranges: Mapping[Poly, Range] = field(default_factory=dict)
    literals: Mapping[Formula, bool] = field(default_factory=dict)
    watch: Callable[[], object] = field(default=IDLE, compare=False, repr=False)
    made: dict[tuple[Poly, Relation], Formula] = field(default_factory=dict, compare=False, repr=False)

    @property
    def is_empty(self) -> bool:
        """Whether nothing is known."""
        return not self.ranges and not self.literals

    def watched(self, watch: Callable[[], object]) -> Facts:
        """The same, with this one to be asked."""
        return Facts(self.ranges, self.literals, watch)

    def known(self, key: Poly) -> Range:
        """The best range of a key: stored, inherent and enclosed from the ranges of its variables."""
        best = meet(self.ranges.get(key, EVERYTHING), inherent(key))
        if self.ranges and variable_of(key) is None:
            best = meet(best, self.enclose(key))
        return best

    def enclose(self, key: Poly) -> Range:
        """The range that follows term by term from the ranges of the variables."""
        gens = {i: self.ranges.get(generator(key.ring, i), EVERYTHING) for i in key.variables}
        if all(r is EVERYTHING for r in gens.values()):
            return EVERYTHING
        if key.term_count() > _ENCLOSED_TERMS:
            return _one_sided(key, gens)
        terms = _terms(key)
        if len(terms) > 1 and any(k % 2 and gens[i] is EVERYTHING for powers, _ in terms for i, k in powers):
            return EVERYTHING  # one term of the sum is anything
        total: Range | None = None
        for powers, coefficient in terms:
            term: Range | None = None
            for i, k in powers:
                part = power(gens[i], k)
                term = part if term is None else multiply(term, part)
            if term is None:
                piece = Range(coefficient, coefficient, False, False)
            else:
                piece = scale(term, coefficient)
            total = piece if total is None else add(total, piece)
            if total.lo is None and total.hi is None and not total.holes:
                return EVERYTHING
        return total if total is not None else EVERYTHING

    def signs(self, poly: Poly) -> frozenset[int]:
        """The signs that a polynomial can have, as far as known: from its range and from those of its factors."""
        self.watch()
        if poly.is_constant:
            value = poly.constant_value()
            return frozenset(((value > 0) - (value < 0),))
        unit, primitive = poly.normal()
        signs = self._signs(primitive)
        if len(signs) > 1 and len(parts := factor_list(primitive)) + parts[0][1] > 2:
            product = frozenset((1,))
            for factor, exponent in parts:
                product = frozenset(a * b**exponent for a in product for b in self._signs(factor))
            signs &= product
        return signs if unit > 0 else frozenset(-s for s in signs)

    def _signs(self, primitive: Poly) -> frozenset[int]:
        key, value = place_of(primitive)
        return self.known(key).signs(value)

    def sign(self, poly: Poly) -> int | None:
        """1 or -1 where the polynomial is known to be positive or negative, else None."""
        signs = self.signs(poly)
        return next(iter(signs)) if len(signs) == 1 and 0 not in signs else None

    def extended(self, atoms: Iterable[Formula]) -> Facts:
        """These facts and the given atoms."""
        ranges = dict(self.ranges)
        for given in atoms:
            if isinstance(given, Atom):
                key, wanted = constraint(given.poly, given.relation)
                ranges[key] = meet(ranges.get(key, EVERYTHING), wanted)
        return Facts(ranges, self.literals, self.watch)

    def without(self, names: tuple[str, ...]) -> Facts:
        """The facts that do not mention these variables (they get bound)."""

        def free(poly: Poly) -> bool:
            return not any(poly.ring.names[i] in names for i in poly.variables)

        kept = (f for f in self.literals if isinstance(f, Atomic) and not {*names} & {*f.free})
        literals: dict[Formula, bool] = {f: self.literals[f] for f in kept}
        return Facts({key: r for key, r in self.ranges.items() if free(key)}, literals, self.watch)


NOTHING = Facts()


@lru_cache(maxsize=20_000)
def constraint(poly: Poly, relation: Relation) -> tuple[Poly, Range]:
    """The key of an atom's polynomial and the range that the atom gives it."""
    key, value = place_of(poly)
    return key, compare(relation, value)


@lru_cache(maxsize=20_000)
def atom_of(key: Poly, relation: Relation, value: Fraction) -> Atom:
    """The atom ``key relation value``; the inverse of ``constraint`` for one comparison."""
    poly = key * value.denominator - value.numerator
    return Atom(poly.normal()[1], relation)

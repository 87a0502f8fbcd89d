"""Groebner bases over Q of integer polynomials, within limits.

The engine is FLINT's Buchberger algorithm in a degree reverse lexicographic context, and where it gets long, if the
limits say so, F4 modulo primes (``modular_groebner.py``). Other orders come
from exponent inflation: giving variable x_i the weight w_i by substituting x_i^(w_i) turns degrevlex
into the order "weighted degree first", which is a monomial order for every choice of weights. With
heavy weights on a block it is an elimination order for that block; this is checked on the result.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

from flint import fmpq, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from qe.errors import InternalError, Unable
from qe.exact.ring import Poly, Ring

_HEAVY = (1009, 1213, 1471, 1723, 1999, 2293, 2557, 2819, 3089, 3359)


class MonomialOrder(Enum):
    """By total degree and then reverse lexicographic or lexicographic, or lexicographic; the first listed variable is
    the largest.
    """

    DEGREVLEX = "degrevlex"
    DEGLEX = "deglex"
    LEX = "lex"

    def key(self, exponents: Sequence[int]) -> tuple[int, ...]:
        """A key by which monomials are sorted: the larger the higher."""
        if self is MonomialOrder.LEX:
            return tuple(exponents)
        if self is MonomialOrder.DEGLEX:
            return (sum(exponents), *exponents)
        return (sum(exponents), *(-e for e in reversed(exponents)))


@dataclass(frozen=True, slots=True)
class Limits:
    """When to give up: number of basis elements, terms and coefficient bits of one of them.

    A C call cannot be interrupted, so these are the only protection from a runaway computation. ``modular``: beyond
    ``BRIEF`` F4 modulo primes is tried, within a limit of its own, before Buchberger's algorithm goes on.
    """

    elements: int = 120
    terms: int = 600
    bits: int = 1500
    modular: bool = False


DEFAULT_LIMITS = Limits()
BRIEF = Limits(elements=150, terms=1000, bits=1000)
"""Within these FLINT's algorithm mostly ends, or gives up, in some tenths of a second."""


class Basis:
    """The reduced Groebner basis of an ideal of Q[names], with integer primitive elements.

    ``polys``: ascending by leading monomial; () for the zero ideal, (1,) for the unit ideal.
    ``variables``: the ring's variables in the basis' own order, largest first; ``weights``: theirs, by which
    degrees are counted in a graded order.
    """

    __slots__ = ("_context", "_internal", "order", "polys", "ring", "variables", "weights")

    def __init__(
        self,
        ring: Ring,
        variables: tuple[int, ...],
        order: MonomialOrder,
        weights: tuple[int, ...] | None,
        internal: Sequence[fmpz_mpoly],
        context: fmpz_mpoly_ctx,
    ) -> None:
        self.ring, self.variables, self.order = ring, variables, order
        self.weights = weights or (1,) * len(variables)
        self._internal, self._context = tuple(internal), context
        self.polys = tuple(self._outside(g).normal()[1] for g in internal)

    @property
    def leads(self) -> tuple[tuple[int, ...], ...]:
        """The exponents of the leading monomials, each in the order of ``variables``, as ``polys`` stand."""
        return tuple(
            tuple(int(k) // w for k, w in zip(g.monomial(0), self.weights, strict=False)) for g in self._internal
        )

    def tails(self) -> list[dict[tuple[int, ...], fmpq]]:
        """For every element the normal form of its leading monomial: exponents -> coefficients."""
        tails = []
        for g in self._internal:
            terms = iter(g.terms())
            lead = next(terms)[1]
            moved = ((tuple(int(k) // w for k, w in zip(e, self.weights, strict=False)), c) for e, c in terms)
            tails.append({e: fmpq(-c, lead) for e, c in moved})
        return tails

    def rank(self, exponents: Sequence[int]) -> tuple[int, ...]:
        """A key by which monomials are sorted, exponents in the order of ``variables``: the larger the higher."""
        return self.order.key([e * w for e, w in zip(exponents, self.weights, strict=True)])

    @property
    def is_unit(self) -> bool:
        """Whether 1 is in the ideal: the equations have no common complex zero (Hilbert's Nullstellensatz)."""
        return len(self.polys) == 1 and self.polys[0].is_constant

    def reduce(self, poly: Poly) -> tuple[int, Poly]:
        """(s, r) with s /= 0 an integer and s*poly - r in the ideal, r the (scaled) normal form.

        At every common zero of the ideal poly and r/s have the same value. The polynomial's variables must
        be among those of the basis.
        """
        if not set(poly.variables) <= set(self.variables):
            raise InternalError("a polynomial to be reduced has a variable that the basis does not know")
        if not self._internal or not poly:
            return 1, poly
        if self.is_unit:
            return 1, poly.ring.constant(0)
        tag = self._context.gens()[len(self.variables)]
        inside = _inside(poly, self.variables, self.weights, self._context)
        reduced = (inside + tag).reduction_primitive_part(fmpz_mpoly_vec(self._internal, self._context))
        position = len(self.variables)
        scale = 0
        for exponents, coefficient in reduced.terms():
            if exponents[position]:
                scale = int(coefficient)
        if not scale:
            raise InternalError("the tag variable vanished in a normal form")
        return scale, self._outside(reduced - scale * tag)

    def contains(self, poly: Poly) -> bool:
        """Whether the polynomial is in the ideal (exact)."""
        return not self.reduce(poly)[1]

    def free_of(self, variables: Iterable[int]) -> tuple[Poly, ...]:
        """The basis elements without these variables."""
        gone = set(variables)
        return tuple(p for p in self.polys if not gone & set(p.variables))

    def _outside(self, g: fmpz_mpoly) -> Poly:
        size = self.ring.size
        weights = self.weights
        terms = {}
        for exponents, coefficient in g.terms():
            moved = [0] * size
            for k, i in enumerate(self.variables):
                moved[i] = int(exponents[k]) // weights[k]
            terms[tuple(moved)] = int(coefficient)
        return self.ring.from_terms(terms)


def groebner_basis(
    polys: Iterable[Poly],
    *,
    variables: Sequence[int] | None = None,
    order: MonomialOrder = MonomialOrder.DEGREVLEX,
    heavy: int = 0,
    weights: Sequence[int] = (),
    limits: Limits = DEFAULT_LIMITS,
) -> Basis | None:
    """The reduced Groebner basis of the ideal generated by ``polys``, or None when a limit is reached.

    ``variables``: indices, largest first (default: those that occur, highest index first). ``heavy``: make the first
    so many of them an elimination block (degrevlex only); None is returned too when the weights tried do not give one.
    ``weights``: positive, one for each variable: monomials are compared by weighted degree first (degrevlex only).
    """
    given = [p for p in polys if p]
    if not given:
        raise InternalError("a Groebner basis needs at least one nonzero polynomial")
    ring = given[0].ring
    used = sorted({i for p in given for i in p.variables}, reverse=True)
    chosen = tuple(used if variables is None else variables)
    if not set(used) <= set(chosen):
        raise InternalError("a variable of the ideal is missing from the variable order")
    heaviest = (_HEAVY[k % len(_HEAVY)] + 2 * (k // len(_HEAVY)) for k in range(heavy))
    scales = (*heaviest, *(tuple(weights) if not heavy and weights else (1,) * (len(chosen) - heavy)))
    names = (*(f"v{k}" for k in range(len(chosen))), "tag")
    context = fmpz_mpoly_ctx.get(names, order.value)
    found = _found([_inside(p, chosen, scales, context) for p in given], context, limits, order)
    if found is None:
        return None
    basis = Basis(ring, chosen, order, scales, _interreduced(found, context), context)
    return basis if not heavy or _is_block(basis, heavy) else None


def _found(
    polys: list[fmpz_mpoly], context: fmpz_mpoly_ctx, limits: Limits, order: MonomialOrder
) -> list[fmpz_mpoly] | None:
    """A basis, in one way or the other."""
    if not limits.modular or order is not MonomialOrder.DEGREVLEX:
        return _by_buchberger(polys, context, limits)
    brief = Limits(min(limits.elements, BRIEF.elements), min(limits.terms, BRIEF.terms), min(limits.bits, BRIEF.bits))
    if (found := _by_buchberger(polys, context, brief)) is not None:
        return found
    return _by_primes(polys, context) or _by_buchberger(polys, context, limits)


def _by_buchberger(polys: list[fmpz_mpoly], context: fmpz_mpoly_ctx, limits: Limits) -> list[fmpz_mpoly] | None:
    elements, complete = fmpz_mpoly_vec(polys, context).buchberger_naive(
        limits=(limits.elements, limits.terms, limits.bits)
    )
    return list(elements) if complete else None


def _by_primes(polys: list[fmpz_mpoly], context: fmpz_mpoly_ctx) -> list[fmpz_mpoly] | None:
    """By F4 modulo primes, which loads numpy; the tag variable takes no part."""
    from qe.exact.modular_groebner import modular_basis

    given = [{tuple(int(k) for k in e)[:-1]: int(c) for e, c in p.terms()} for p in polys]
    try:
        elements = modular_basis(given, context.nvars() - 1)
    except Unable:
        return None
    return [context.from_dict({(*e, 0): c for e, c in g.items()}) for g in elements]


def _is_block(basis: Basis, heavy: int) -> bool:
    """In every element every other monomial of the heavy block weighs strictly less than the leading one.

    Then initial forms agree with those of "block weight first, then the rest", an elimination order.
    """
    weights = basis.weights[:heavy]
    for g in basis._internal:
        tops: dict[tuple[int, ...], int] = {}
        for exponents in g.monoms():
            block = tuple(int(k) for k in exponents[:heavy])
            tops[block] = sum(block)
        lead = tuple(int(k) for k in g.monomial(0)[:heavy])
        if any(weight >= tops[lead] for block, weight in tops.items() if block != lead):
            return False
    return bool(weights)


def _inside(poly: Poly, variables: Sequence[int], weights: tuple[int, ...], context: fmpz_mpoly_ctx) -> fmpz_mpoly:
    return context.from_dict(
        {(*(e[i] * w for i, w in zip(variables, weights, strict=True)), 0): c for e, c in poly.terms()}
    )


def _interreduced(generators: list[fmpz_mpoly], context: fmpz_mpoly_ctx) -> list[fmpz_mpoly]:
    """The reduced basis: redundant leading monomials dropped, then every element reduced by the others."""
    elements = [g for g in generators if g]
    if any(g.total_degree() == 0 for g in elements):
        return [context.constant(1)]
    leads = [tuple(int(k) for k in g.monomial(0)) for g in elements]
    kept: list[int] = []
    for i in sorted(range(len(elements)), key=lambda k: (sum(leads[k]), leads[k])):
        if not any(all(a <= b for a, b in zip(leads[j], leads[i], strict=True)) for j in kept):
            kept.append(i)
    minimal = [elements[i] for i in kept]
    for position, g in enumerate(minimal):
        others = [h for k, h in enumerate(minimal) if k != position]
        if others:
            minimal[position] = g.reduction_primitive_part(fmpz_mpoly_vec(others, context))
    return minimal

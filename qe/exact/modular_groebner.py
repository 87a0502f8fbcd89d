"""Groebner bases over Q from bases modulo primes, proved afterwards.

The polynomials are made homogeneous by a last variable t. F4 modulo many primes, the Chinese remainder theorem and
rational reconstruction give candidates G over Q. Three facts prove that G is a basis of the ideal J of the given
polynomials F (Arnold 2003, Theorem 7.1):

1. all critical pairs of G reduce to zero, so that G is a Groebner basis of the ideal that it generates;
2. all of F reduce to zero by G, so that J is part of that ideal;
3. modulo some prime, J has elements with the leading monomials of G. In every degree the rank over Q of the multiples
   of F is at least the rank modulo a prime, and that is at least the number of multiples of leading monomials
   of G, the dimension of the ideal of G.

The third follows from how F4 finds its elements; the first two are worked out over Q. With t = 1 a homogeneous basis
becomes one of the ideal of the polynomials as they were given, t being last.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import gcd, isqrt, lcm, prod

from flint import fmpz, fmpz_mat, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from qe.errors import Unable
from qe.exact.critical_pairs import CriticalPairs
from qe.exact.f4 import Trace, Unlucky, learned
from qe.exact.packed import Exponents, PackedMonomials

Terms = Mapping[Exponents, int]

FIRST_PRIME = 67108859
"""The largest prime below 2^26."""

BATCHES = (6, 6, 12, 24, 48, 96, 192, 384)
"""How many primes are taken at a time."""

MOST_TRIALS = 5
"""How often a prime may turn out to be one of the few that do not suit a system."""

SPARE_BITS = 24
"""Bits by which the product of the primes must be longer than a fraction needs, so that chance rarely gives one."""


@dataclass(frozen=True)
class Work:
    """``learning``: products of numbers in the first run. ``following``: products, in all others together."""

    learning: int = 400_000_000
    following: int = 2_000_000_000


WORK = Work()


def modular_basis(polys: Sequence[Terms], size: int, work: Work = WORK) -> list[dict[Exponents, int]]:
    """A Groebner basis (not reduced) of integer polynomials in ``size`` variables, degree reverse lexicographic.

    Raises ``Unable`` at the limit of work.
    """
    bits = 12 + max(sum(e) for p in polys for e in p).bit_length()  # for degrees some dozen times those given
    monomials = PackedMonomials(size + 1, bits)
    given = [_homogeneous(p, monomials) for p in polys if p]
    primes = (n for n in range(FIRST_PRIME, 1 << 25, -2) if fmpz(n).is_prime())
    for _ in range(MOST_TRIALS):
        try:
            trace = learned(given, monomials, next(primes), work.learning)
            basis = _lifted(trace, given, monomials, primes, work)
        except Unlucky:
            continue
        return [{e[:-1]: c for e, c in g.items()} for g in basis]
    raise Unable("no prime suits a Gröbner basis")


def _homogeneous(poly: Terms, monomials: PackedMonomials) -> dict[int, int]:
    degree = max(map(sum, poly))
    return {monomials.packed((*e, degree - sum(e))): int(c) for e, c in poly.items()}


def _lifted(
    trace: Trace,
    given: Sequence[Mapping[int, int]],
    monomials: PackedMonomials,
    primes: Iterator[int],
    work: Work,
) -> list[dict[Exponents, int]]:
    """The basis over Q with the leading monomials of a trace. Raises ``Unlucky``, ``Unable``."""
    coefficients = [[c for _, c in sorted(g.items(), reverse=True)] for g in given]
    used: list[int] = []
    residues: list[list[list[int]]] = [[[] for _ in tail] for tail in trace.tails]
    for size in BATCHES:
        if trace.length * (len(used) + size) > work.following:
            break
        chosen = [next(primes) for _ in range(size)]
        tails, good = trace.followed(coefficients, chosen)
        kept = [k for k, fits in enumerate(good) if fits]
        used += [chosen[k] for k in kept]
        for known, tail in zip(residues, tails, strict=True):
            for entries, row in zip(known, tail[:, kept].tolist(), strict=True):
                entries += row
        fractions = _reconstructed(residues, used)
        if fractions is not None:
            basis = _polynomials(trace, fractions, monomials)
            if not _is_basis(basis, given, monomials):
                raise Unlucky  # the fractions stand; it is the first prime that saw too little
            return basis
    raise Unable("the coefficients of a Gröbner basis grow past their limits")


def _reconstructed(residues: Sequence[Sequence[Sequence[int]]], primes: Sequence[int]) -> list[list[int]] | None:
    """For every element its leading coefficient and the others, integers; None where more primes are needed."""
    if not primes:
        return None
    modulus = prod(primes)
    weights = []
    for p in primes:
        others = modulus // p
        weights.append(others * pow(others, -1, p))
    column = fmpz_mat(len(primes), 1, weights)
    elements = []
    for rows in residues:
        combined = (fmpz_mat(len(rows), len(primes), [c for row in rows for c in row]) * column).entries()
        integers = _over_one_denominator([int(c) % modulus for c in combined], modulus)
        if integers is None:
            return None
        elements.append(integers)
    return elements


def _over_one_denominator(values: Sequence[int], modulus: int) -> list[int] | None:
    """Fractions with these residues as [common denominator, *numerators]; None where some is too long."""
    bottom, fractions = 1, []
    small = isqrt(modulus) >> SPARE_BITS
    for value in values:
        top = value * bottom % modulus
        top = top - modulus if 2 * top > modulus else top
        if abs(top) > small:  # a further factor of the denominator
            part = _fraction(top % modulus, modulus)
            if part is None:
                return None
            top, further = part
            bottom *= further
        fractions.append((top, bottom))
    common = lcm(*(b for _, b in fractions))
    return [common, *(t * (common // b) for t, b in fractions)]


def _fraction(value: int, modulus: int) -> tuple[int, int] | None:
    """Numerator and positive denominator of the fraction with this residue, if there is a short one (Wang 1981)."""
    bound = isqrt(modulus) >> (SPARE_BITS // 2)
    a, b, s, t = modulus, value, 0, 1
    while b > bound:
        q = a // b
        a, b, s, t = b, a - q * b, t, s - q * t
    if t == 0 or abs(t) > bound or gcd(b, t) != 1:
        return None
    return (b, t) if t > 0 else (-b, -t)


def _polynomials(
    trace: Trace, coefficients: Sequence[Sequence[int]], monomials: PackedMonomials
) -> list[dict[Exponents, int]]:
    polys = []
    for head, tail, numbers in zip(trace.heads, trace.tails, coefficients, strict=True):
        terms = zip((head, *tail), numbers, strict=True)
        polys.append({monomials.exponents(m): c for m, c in terms if c})
    return polys


def _is_basis(candidates: Sequence[Terms], given: Sequence[Mapping[int, int]], monomials: PackedMonomials) -> bool:
    """Whether the candidates are a Groebner basis, over Q, and reduce all given polynomials to zero."""
    context = fmpz_mpoly_ctx.get(tuple(f"v{k}" for k in range(monomials.size)), "degrevlex")
    elements = [context.from_dict(dict(g)) for g in candidates]
    basis = fmpz_mpoly_vec(elements, context)
    for g in given:
        if context.from_dict({monomials.exponents(m): c for m, c in g.items()}).reduction_primitive_part(basis):
            return False
    pairs = CriticalPairs(monomials)
    for g in elements:
        pairs.add(monomials.packed([int(e) for e in g.monomial(0)]))
    return all(not _remainder(elements, basis, pairs, pair, context) for pair in pairs.pairs)


def _remainder(
    elements: Sequence[fmpz_mpoly],
    basis: fmpz_mpoly_vec,
    pairs: CriticalPairs,
    pair: tuple[int, int, int],
    context: fmpz_mpoly_ctx,
) -> fmpz_mpoly:
    """A multiple of the S-polynomial of a pair, reduced."""
    t, i, j = pair
    a, b = (int(elements[k].coefficient(0)) for k in (i, j))
    common = gcd(a, b)
    exponents = pairs.monomials.exponents
    left, right = (
        elements[k] * context.from_dict({exponents(t - pairs.heads[k]): c // common}) for k, c in ((i, b), (j, a))
    )
    difference = left - right
    return difference.reduction_primitive_part(basis) if difference else difference

"""Irreducible factors of squarefree polynomials in one variable (Zassenhaus, J. Number Theory 1, 1969)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, count
from math import gcd, isqrt
from random import Random

from qe.plain.modular import common, convolved, inverse_modulo, power, quotient, reduced, remainder, symmetric

PRIMES = 5
"""So many primes are looked at for one with few factors."""


def irreducible_factors(c: list[int]) -> list[list[int]]:
    """The factors of a primitive squarefree polynomial, coefficients from degree 0 up."""
    n, lead = len(c) - 1, c[-1]
    if n < 2:
        return [c]
    if not c[0]:
        return [[0, 1], *(irreducible_factors(c[1:]))]
    possible, tried = -1, list[tuple[int, int, list[tuple[int, list[int]]]]]()
    for p in (p for p in count(3, 2) if all(p % d for d in range(3, isqrt(p) + 1, 2))):  # the odd primes
        f = reduced(c, p)
        if len(f) <= n or len(common(f, [k * d for k, d in enumerate(f)][1:], p)) > 1:
            continue
        parts = list(_by_degree(f, p))
        degrees = 1
        for degree, product in parts:
            for _ in range((len(product) - 1) // degree):
                degrees |= degrees << degree
        possible &= degrees  # bit d: a factor can have degree d
        if possible == 1 | 1 << n:
            return [c]
        tried.append((sum((len(product) - 1) // degree for degree, product in parts), p, parts))
        if len(tried) == PRIMES:
            break
    _, p, parts = min(tried)
    factors = [g for degree, product in parts for g in _of_degree(product, degree, p)]
    bound = 2 * abs(lead) * (1 << n) * (isqrt(sum(d * d for d in c)) + 1)  # Mignotte
    return _recombined(c, *_lifted(c, factors, p, bound))


def _by_degree(f: list[int], p: int) -> Iterator[tuple[int, list[int]]]:
    """(d, product of the factors of degree d) of a squarefree polynomial modulo p."""
    x = [0, 1]
    frobenius = remainder(x, f, p)
    for degree in count(1):
        if len(f) - 1 < 2 * degree:
            break
        frobenius = power(frobenius, p, f, p)
        padded = frobenius + [0] * (2 - len(frobenius))
        padded[1] -= 1
        shared = common(f, padded, p) if reduced(padded, p) else f
        if len(shared) > 1:
            yield degree, shared
            f = quotient(f, shared, p)
            frobenius = remainder(frobenius, f, p)
    if len(f) > 1:
        yield len(f) - 1, f


def _of_degree(f: list[int], degree: int, p: int) -> Iterator[list[int]]:
    """The monic factors of a product of factors of one degree modulo p (Cantor, Zassenhaus, Math. Comp. 36, 1981)."""
    rng, pending = Random(p), [f]
    while pending:
        f = pending.pop()
        if len(f) - 1 == degree:
            inverse = pow(f[-1], -1, p)
            yield [c * inverse % p for c in f]
            continue
        while True:
            guess = reduced([rng.randrange(p) for _ in range(len(f) - 1)], p)
            image = power(guess, (p**degree - 1) // 2, f, p) or [0]
            image[0] -= 1
            if not reduced(image, p):
                continue
            shared = common(f, image, p)
            if 1 < len(shared) < len(f):
                pending += [shared, quotient(f, shared, p)]
                break


def _lifted(c: list[int], factors: list[list[int]], p: int, bound: int) -> tuple[list[list[int]], int]:
    """Monic factors modulo a power of p above the bound, and that power (Hensel's lemma)."""
    inverse, modulus, lifted = pow(c[-1], -1, p), p, [list(f) for f in factors]
    inverses = []
    for k, f in enumerate(factors):
        outside = [1]
        for g in (*factors[:k], *factors[k + 1 :]):
            outside = remainder(convolved(outside, g), f, p)
        inverses.append(inverse_modulo(outside, f, p))
    while modulus <= bound:
        product = [c[-1]]
        for f in lifted:
            product = [d % (modulus * p) for d in convolved(product, f)]
        error = reduced([(a - b) // modulus * inverse for a, b in zip(c, product, strict=True)], p)
        for f, base, s in zip(lifted, factors, inverses, strict=True):
            for k, d in enumerate(remainder(convolved(error, s), base, p)):
                f[k] += modulus * d
        modulus *= p
    return lifted, modulus


def _recombined(c: list[int], lifted: list[list[int]], modulus: int) -> list[list[int]]:
    """The true factors, products of some of the lifted ones."""
    found, size = [], 1
    while 2 * size <= len(lifted):
        for chosen in combinations(range(len(lifted)), size):
            constant = c[-1]
            for k in chosen:
                constant = constant * lifted[k][0] % modulus
            constant = symmetric(constant, modulus)
            if not constant or c[-1] * c[0] % constant:
                continue
            product = [c[-1]]
            for k in chosen:
                product = [d % modulus for d in convolved(product, lifted[k])]
            f = [symmetric(d, modulus) for d in product]
            divisor = gcd(*f)
            f = [d // divisor for d in f]
            quotient = _quotient(c, f)
            if quotient is not None:
                found.append(f)
                c, lifted = quotient, [g for k, g in enumerate(lifted) if k not in chosen]
                break
        else:
            size += 1
    return [*found, c]


def _quotient(a: Sequence[int], b: Sequence[int]) -> list[int] | None:
    """a / b, or None where it has no integer coefficients."""
    rest, n = list(a), len(b) - 1
    quotient = [0] * (len(a) - n)
    for k in reversed(range(len(quotient))):
        quotient[k], wrong = divmod(rest[k + n], b[-1])
        if wrong:
            return None
        for j, d in enumerate(b, k):
            rest[j] -= quotient[k] * d
    return None if any(rest) else quotient

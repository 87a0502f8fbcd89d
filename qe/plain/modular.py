"""Polynomials in one variable modulo a prime, as lists of coefficients from degree 0 up."""

from __future__ import annotations

from collections.abc import Sequence


def symmetric(c: int, modulus: int) -> int:
    """The residue between -modulus/2 and modulus/2."""
    c %= modulus
    return c - modulus if 2 * c > modulus else c


def convolved(a: Sequence[int], b: Sequence[int]) -> list[int]:
    """The product over the integers."""
    total = [0] * max(len(a) + len(b) - 1, 0)
    for i, c in enumerate(a):
        if c:
            for j, d in enumerate(b, i):
                total[j] += c * d
    return total


def reduced(a: Sequence[int], p: int) -> list[int]:
    """The polynomial modulo p, without leading zeros."""
    c = [x % p for x in a]
    while c and not c[-1]:
        c.pop()
    return c


def quotient_and_remainder(a: Sequence[int], b: Sequence[int], p: int) -> tuple[list[int], list[int]]:
    """(q, r) with a = q*b + r modulo p."""
    rest, n, inverse = reduced(a, p), len(b) - 1, pow(b[-1], -1, p)
    quotient = [0] * max(len(rest) - n, 0)
    for k in reversed(range(len(quotient))):
        factor = quotient[k] = rest[k + n] * inverse % p
        if factor:
            for j, c in enumerate(b, k):
                rest[j] = (rest[j] - factor * c) % p
    return quotient, reduced(rest[:n], p)


def quotient(a: Sequence[int], b: Sequence[int], p: int) -> list[int]:
    """a / b modulo p, without the remainder."""
    return quotient_and_remainder(a, b, p)[0]


def remainder(a: Sequence[int], b: Sequence[int], p: int) -> list[int]:
    """a modulo b and p."""
    return quotient_and_remainder(a, b, p)[1]


def common(a: Sequence[int], b: Sequence[int], p: int) -> list[int]:
    """The monic greatest common divisor modulo p."""
    f, g = reduced(a, p), reduced(b, p)
    while g:
        f, g = g, remainder(f, g, p)
    inverse = pow(f[-1], -1, p)
    return [c * inverse % p for c in f]


def inverse_modulo(a: Sequence[int], b: Sequence[int], p: int) -> list[int]:
    """s with s*a = 1 modulo b and p; a and b have no common divisor."""
    f, g, s, t = list(b), remainder(a, b, p), list[int](), [1]
    while len(g) > 1:
        q, r = quotient_and_remainder(f, g, p)
        product = convolved(q, t)
        size = max(len(product), len(s))
        padded = zip(s + [0] * (size - len(s)), product + [0] * (size - len(product)), strict=True)
        f, g, s, t = g, r, t, reduced([c - d for c, d in padded], p)
    inverse = pow(g[0], -1, p)
    return [c * inverse % p for c in t]


def power(a: Sequence[int], exponent: int, b: Sequence[int], p: int) -> list[int]:
    """a^exponent modulo b and p."""
    result, square = [1], list(a)
    while exponent:
        if exponent & 1:
            result = remainder(convolved(result, square), b, p)
        exponent >>= 1
        if exponent:
            square = remainder(convolved(square, square), b, p)
    return result

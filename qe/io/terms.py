"""Exact arithmetic on the terms that readers meet: polynomials over Q, guarded against blow-up.

FLINT ends the process where an expansion does not fit into memory, so every product and power is bounded before it is
computed. Errors are ``TermError`` without a position; readers know one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import comb, lcm, prod
from typing import NamedTuple, cast

from qe.errors import InputError
from qe.exact.ring import Poly, Ring

MAX_EXPONENT = 10_000
MAX_DEGREE = 10_000
MAX_TERMS = 1_000_000
MAX_BITS = 200_000_000
MAX_DIGITS = 1_000_000
_CHUNK = 4_000
SURELY_FEW, SURELY_SHORT = 64, 4096
"""A product of at most so many terms, with coefficients of so many bits, is within all limits: nothing is counted."""


class TermError(InputError):
    """A term has no meaning here or would grow past a limit; carries no position."""


class Value(NamedTuple):
    """The polynomial ``poly / den`` over Q, ``den`` > 0; no coefficient of ``poly`` has more than ``bits`` bits."""

    poly: Poly
    den: int
    bits: int


def integer(text: str) -> int:
    """The value of a string of ASCII digits of any length up to ``MAX_DIGITS``, perhaps with a minus in front."""
    if len(text) <= _CHUNK:
        return int(text)
    if text[0] == "-":
        return -integer(text[1:])
    if len(text) > MAX_DIGITS:
        raise TermError(f"a number with {len(text)} digits is too long")
    value = 0
    head = len(text) % _CHUNK
    for start in range(head - _CHUNK if head else 0, len(text), _CHUNK):
        piece = text[max(0, start) : start + _CHUNK]
        value = value * 10 ** len(piece) + int(piece)
    return value


def decimal(text: str) -> Fraction:
    """The exact value of ``12``, ``-1.25`` or ``1.5e-3``."""
    mantissa, _, exponent = text.replace("E", "e").partition("e")
    whole, _, decimals = mantissa.partition(".")
    value = Fraction(integer(whole + decimals), 10 ** len(decimals))
    if not exponent:
        return value
    power = int(exponent) if len(exponent) < 8 else MAX_EXPONENT + 1
    if abs(power) > MAX_EXPONENT:
        raise TermError(f"the exponent of the number {text[:40]} is too large")
    return value * Fraction(10) ** power


def number(ring: Ring, value: Fraction | int) -> Value:
    """A rational constant."""
    numerator = value.numerator
    return Value(ring.constant(numerator), value.denominator, numerator.bit_length())


def variable(ring: Ring, name: str) -> Value:
    """The variable called ``name``."""
    return Value(ring.var(name), 1, 1)


def combination(ring: Ring, coefficients: Mapping[tuple[str, ...], Fraction | int]) -> Value:
    """The sum of multiples, not by zero, of products of names."""
    den, whole = 1, cast(Mapping[tuple[str, ...], int], coefficients)
    if set(map(type, coefficients.values())) != {int}:
        den = lcm(*(c.denominator for c in coefficients.values()))
        whole = {names: c.numerator * (den // c.denominator) for names, c in coefficients.items()}
    bits = max(map(int.bit_length, whole.values()))
    _bounded(len(whole), bits)
    return Value(ring.combination(whole), den, bits)


def negative(value: Value) -> Value:
    """``-value``."""
    return Value(-value.poly, value.den, value.bits)


def total(values: Sequence[Value]) -> Value:
    """The sum of at least one value."""
    den = lcm(*(v.den for v in values))
    poly: Poly | None = None
    bits = 0
    for value in values:
        part = value.poly
        width = value.bits
        if value.den != den:
            part = part * (den // value.den)
            width += den.bit_length()
        poly = part if poly is None else poly + part
        bits = max(bits, width)
    assert poly is not None
    _bounded(poly.term_count(), bits)
    return Value(poly, den, bits + len(values).bit_length())


def product(left: Value, right: Value) -> Value:
    """``left * right``."""
    a, b = left.poly, right.poly
    count = a.term_count() * b.term_count()
    bits = left.bits + right.bits + min(a.term_count(), b.term_count()).bit_length()
    if count > SURELY_FEW or bits > SURELY_SHORT:
        degrees = [m + n + 1 for m, n in zip(a.degrees, b.degrees, strict=True)]  # and with all monomials of these
        if count > 100 * MAX_TERMS:
            raise TermError("the expanded product would have too many terms")
        _bounded(min(count, prod(degrees)), bits)
    result = a * b
    if result.total_degree > MAX_DEGREE:
        raise TermError(f"the degree {result.total_degree} is above the limit of {MAX_DEGREE}")
    return Value(result, left.den * right.den, bits)


def power(base: Value, exponent: int) -> Value:
    """``base ** exponent`` for a small natural ``exponent``; the zeroth power of anything is 1."""
    if exponent > MAX_EXPONENT:
        shown = f"exponent {exponent}" if exponent < 10**20 else "an exponent"
        raise TermError(f"{shown} is above the limit of {MAX_EXPONENT}")
    if exponent <= 1:
        return base if exponent else number(base.poly.ring, 1)
    poly, count = base.poly, base.poly.term_count()
    if poly.total_degree * exponent > MAX_DEGREE:
        raise TermError(f"the degree {poly.total_degree * exponent} is above the limit of {MAX_DEGREE}")
    bits = exponent * (base.bits + (count - 1).bit_length())
    _bounded(min(comb(exponent + count - 1, exponent), prod(d * exponent + 1 for d in poly.degrees)), bits)
    if base.den.bit_length() * exponent > MAX_BITS:
        raise TermError("the power is too large")
    return Value(poly**exponent, base.den**exponent, bits)


def _bounded(count: int, bits: int) -> None:
    if count > MAX_TERMS:
        raise TermError("the expanded term would have more than a million monomials")
    if count * bits > MAX_BITS:
        raise TermError("the expanded term would need too much memory")

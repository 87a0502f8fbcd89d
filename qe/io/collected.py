"""Sums and products of names and numbers, collected while they are read: short polynomials in place of trees. Only what
is surely small is collected; everything else stays a tree, which ``qe.io.valuation`` works out."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

from qe.io.surface import Name, Number, Polynomial, Sum, Term

Coefficients: TypeAlias = dict[tuple[str, ...], Fraction | int]

SHORT = 16
"""Terms of a polynomial up to which it becomes part of another."""
MOST_FACTORS = 64
"""The degree of a product."""
_LARGE = 1 << 2048
ZERO = Number(0)


def add(terms: Coefficients, part: Term, scale: int = 1, most: int = SHORT) -> bool:
    """Add a multiple of a part to a polynomial that is being collected; False, and nothing, where it is not short."""
    if isinstance(part, Name):
        name = (part.name,)
        terms[name] = terms[name] + scale if name in terms else scale
    elif isinstance(part, Polynomial) and len(part.terms) <= most:
        if not terms and scale == 1:
            terms.update(part.terms)
            return True
        for names, value in part.terms.items():
            value = value if scale == 1 else scale * value
            terms[names] = terms[names] + value if names in terms else value
    elif isinstance(part, Number) and _is_small(part.value):
        value = part.value.numerator if part.value.denominator == 1 else part.value  # whole numbers stay integers
        terms[()] = terms.get((), 0) + scale * value
    else:
        return False
    return True


def add_multiple(terms: Coefficients, factor: Term, name: Term, scale: int) -> bool:
    """Add ``scale * factor * name``; False, and nothing, where it is none of a name by a short number."""
    if isinstance(factor, Number) and isinstance(name, Name) and _is_small(factor.value):
        key = (name.name,)
        value = factor.value if scale == 1 else -factor.value
        terms[key] = terms[key] + value if key in terms else value
        return True
    return False


def joined(terms: Coefficients, others: list[Term]) -> Term:
    """The sum of a polynomial and other parts."""
    if not others:
        return polynomial(terms)
    if terms:
        others.insert(0, polynomial(terms))
    return Sum(others) if len(others) > 1 else others[0]


def negative(part: Term) -> Term | None:
    """``-part``, if the part is short."""
    if isinstance(part, Number):
        return Number(-part.value)
    terms: Coefficients = {}
    return polynomial(terms) if add(terms, part, -1) else None


def product(parts: Sequence[Term]) -> Term | None:
    """The product of at least one part, if it is short."""
    value: Fraction | int = 1
    names: list[str] = []
    sums: list[Coefficients] = []
    for part in parts:
        if isinstance(part, Name):
            names.append(part.name)
            continue
        if (terms := coefficients(part)) is None or not _is_small(value):
            return None
        if len(terms) == 1:
            ((factors, number),) = terms.items()
            names += factors
            value = number if value == 1 else value * number
        else:
            sums.append(terms)
    if len(names) > MOST_FACTORS or not _is_small(value):
        return None
    names.sort()
    result: Coefficients = {tuple(names): value}
    for terms in sums:
        if len(result) * len(terms) > SHORT or not all(map(_is_small, result.values())):
            return None
        result = _times(result, terms)
    return polynomial(result)


def quotient(part: Term, divisor: Number) -> Term | None:
    """``part / divisor``, if the part is short and the divisor not zero."""
    return product((part, Number(Fraction(1) / divisor.value))) if divisor.value else None


def power(base: Term, exponent: Number) -> Term | None:
    """``base ^ exponent``, if it is short and the exponent is a small number from 1 on."""
    k = exponent.value
    return product((base,) * int(k)) if k.denominator == 1 and 1 <= k <= SHORT else None


def sides(first: Term, second: Term, most: int = SHORT) -> list[Term]:
    """The sides of a comparison: of two that are collected, with ``most`` terms, their difference and zero."""
    terms: Coefficients = {}
    if second == ZERO or not (add(terms, first, 1, most) and add(terms, second, -1, most)):
        return [first, second]
    return [polynomial(terms), ZERO]


def coefficients(term: Term) -> Coefficients | None:
    """The coefficients of a short term; None for any other."""
    if isinstance(term, Polynomial):
        return term.terms if len(term.terms) <= SHORT else None
    if isinstance(term, Name):
        return {(term.name,): 1}
    if isinstance(term, Number) and _is_small(term.value):
        return {(): term.value}
    return None


def polynomial(terms: Coefficients) -> Polynomial | Number:
    """The term with these coefficients, some of which may be zero."""
    if 0 in terms.values():
        terms = {names: value for names, value in terms.items() if value}
    if len(terms) < 2 and (not terms or () in terms):
        return Number(terms.get((), 0))
    return Polynomial(terms)


def _times(one: Coefficients, other: Coefficients) -> Coefficients:
    result: Coefficients = {}
    for a, m in one.items():
        for b, n in other.items():
            names = tuple(sorted(a + b))
            result[names] = result.get(names, 0) + m * n
    return result


def _is_small(value: Fraction | int) -> bool:
    if isinstance(value, int):
        return -_LARGE < value < _LARGE
    return -_LARGE < value.numerator < _LARGE and value.denominator < _LARGE

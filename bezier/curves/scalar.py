"""Coordinates: rational numbers, or elements of one real number field.

Every computation on curves is generic over these two. A coordinate is a ``Fraction`` (or ``int``), or an
object with exact field arithmetic, ``sign()`` in {-1, 0, 1} and ``float()``, such as
``qe.exact.field.FieldElement``; values of one curve come from one field. Signs are exact; decimals are for
the reader only and decide nothing.
"""

from __future__ import annotations

import operator
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import comb
from typing import Any

Vector = tuple[Any, ...]
"""Coordinates; mixed arithmetic with ``int`` and ``Fraction`` is exact."""


def sign(value: Any) -> int:
    """The exact sign: -1, 0 or 1."""
    if isinstance(value, (int, Fraction)):
        return (value > 0) - (value < 0)
    return int(value.sign())


def is_zero(value: Any) -> bool:
    """Whether the value is exactly zero."""
    return sign(value) == 0


def vector(values: Iterable[Any]) -> Vector:
    """A tuple of coordinates; integers become ``Fraction`` so that division stays exact."""
    return tuple(Fraction(v) if isinstance(v, int) else v for v in values)


def add(a: Sequence[Any], b: Sequence[Any]) -> Vector:
    """a + b, coordinate by coordinate."""
    return tuple(x + y for x, y in zip(a, b, strict=True))


def subtract(a: Sequence[Any], b: Sequence[Any]) -> Vector:
    """a - b, coordinate by coordinate."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


def scale(factor: Any, a: Sequence[Any]) -> Vector:
    """factor * a."""
    return tuple(factor * x for x in a)


def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """The inner product."""
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def same(a: Sequence[Any], b: Sequence[Any]) -> bool:
    """Exact equality of two vectors."""
    return all(is_zero(x - y) for x, y in zip(a, b, strict=True))


def rational(value: Any) -> Fraction | None:
    """The value as a ``Fraction`` if it is rational, otherwise None."""
    if isinstance(value, (int, Fraction)):
        return Fraction(value)
    return Fraction(value.as_fraction()) if value.is_rational else None


def exactly(value: Any) -> Fraction:
    """The value of a coordinate that is known to be rational."""
    return Fraction(value)


def generator_of(values: Iterable[Any]) -> Any:
    """The generator of the field of these values; None over Q."""
    return next((value.field.theta for value in values if rational(value) is None), None)


def coefficients_of(value: Any) -> list[Fraction]:
    """A coordinate as a polynomial in the generator of its field."""
    number = rational(value)
    if number is not None:
        return [number]
    coefficients = list(value.coefficients)
    while len(coefficients) > 1 and not coefficients[-1]:
        coefficients.pop()
    return coefficients


def exact_text(value: Any) -> str:
    """Exact text: ``-3/4`` for a rational number, the field's own notation otherwise."""
    number = rational(value)
    return str(value) if number is None else str(number)


def decimal_text(value: Any, digits: int = 12) -> str:
    """A decimal with at most ``digits`` significant digits, for people and plotting programs."""
    number = rational(value)
    return f"{float(value if number is None else number):.{digits}g}"


def brief(value: Any) -> str:
    """A number as a decimal, with its exact text where that says more and is short."""
    return with_decimal(exact_text(value), decimal_text(value, 8))


def with_decimal(exact: str, decimal: str) -> str:
    """The decimal, with the exact text where they differ and where that would not fill the line."""
    if len(exact) > 40:
        return f"about {decimal}"
    if exact == decimal or ("/" in exact and _is_fraction(exact, decimal)):
        return decimal
    return f"{decimal} (exactly {exact})"


def _is_fraction(exact: str, decimal: str) -> bool:
    """Whether exact text is a fraction and the decimal the same number."""
    try:
        return Fraction(exact) == Fraction(decimal)
    except ValueError:
        return False


def described(value: Any) -> dict[str, str]:
    """``{"exact": ..., "decimal": ...}``, the form in which numbers leave the program."""
    return {"exact": exact_text(value), "decimal": decimal_text(value)}


Terms = dict[tuple[int, ...], Fraction]
"""A polynomial: coefficients by the exponents of its variables."""
UNITS = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def terms_sum(*parts: Terms) -> Terms:
    """The sum, without zero coefficients."""
    total: Terms = {}
    for part in parts:
        for exponents, coefficient in part.items():
            total[exponents] = total.get(exponents, Fraction(0)) + coefficient
    return {e: c for e, c in total.items() if c}


def terms_scaled(factor: Fraction | int, terms: Terms) -> Terms:
    """A multiple."""
    return {exponents: factor * c for exponents, c in terms.items()}


def terms_product(a: Terms, b: Terms) -> Terms:
    """The product."""
    return terms_sum(*({tuple(map(operator.add, d, e)): x * y for e, y in b.items()} for d, x in a.items()))


def ends_of(corners: Sequence[Sequence[Any]]) -> tuple[Vector, Vector]:
    """The least and the largest coordinates of points."""
    axes = list(zip(*corners, strict=True))
    return tuple(map(min, axes)), tuple(map(max, axes))


def terms_between(terms: Mapping[tuple[int, ...], Any], corners: Sequence[Sequence[Any]]) -> tuple[Any, Any]:
    """Numbers below and above a polynomial in the hull of points: its linear part at these, and bounds of the rest."""
    _, values, rest = terms_about(terms, corners)
    even = {powers for powers in rest if not any(n % 2 for n in powers)}
    below = sum((min(c, 0) if powers in even else -abs(c) for powers, c in rest.items()), min(values))
    return below, sum((max(c, 0) if powers in even else abs(c) for powers, c in rest.items()), max(values))


def terms_about(
    terms: Mapping[tuple[int, ...], Any], corners: Sequence[Sequence[Any]]
) -> tuple[list[Any], list[Any], dict[tuple[int, ...], Any]]:
    """Of a polynomial about the centre of the box around points: the slopes, the values of the linear part at these,
    and the other terms in coordinates that are -1 to 1 on the box."""
    rest, ends = dict(terms), list(zip(*ends_of(corners), strict=True))
    middles, halves = [(a + b) / 2 for a, b in ends], [(b - a) / 2 for a, b in ends]
    for axis, (middle, half) in enumerate(zip(middles, halves, strict=True)):
        moved = dict[tuple[int, ...], Any]()
        for powers, c in rest.items():
            n = powers[axis]
            for k in range(n + 1):
                key = (*powers[:axis], k, *powers[axis + 1 :])
                moved[key] = moved.get(key, 0) + c * comb(n, k) * middle ** (n - k) * half**k
        rest = moved
    level = rest.pop((0, 0, 0), 0)
    slopes = [rest.pop(key, 0) / (half or 1) for key, half in zip(UNITS, halves, strict=False)]  # 0 where it is flat
    return slopes, [sum(map(operator.mul, slopes, subtract(p, middles)), level) for p in corners], rest

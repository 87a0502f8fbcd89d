"""Real algebraic numbers as exact text, from their minimal polynomials."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from math import gcd, isqrt

from flint import fmpz

from qe.exact.sparse_text import sum_text

_FACTORED_BITS, _TRIED = 110, 3000
_QUOTIENT = re.compile(r"(?:\(([^()]*(?:\([^()]*\)[^()]*)?)\)|(-?)([^-/]+))/([0-9]+)")


def format_root(coefficients: Sequence[int], index: int) -> str:
    """Exact text of the real root with this index (from 0) of an irreducible polynomial, coefficients from degree 0 up.

    A fraction, ``(p + q*sqrt(d))/r`` for degree 2, otherwise ``root(k, polynomial)`` with k from 1.
    """
    if len(coefficients) == 2:
        return str(Fraction(-coefficients[0], coefficients[1]))
    if len(coefficients) == 3:
        return _format_quadratic(coefficients, index)
    powers = [[], ["x"], *([f"x^{i}"] for i in range(2, len(coefficients)))]
    return f"root({index + 1}, {sum_text((c, p) for c, p in zip(coefficients[::-1], powers[::-1], strict=True) if c)})"


def in_latex(number: object) -> str:
    """LaTeX of a number from its text: as ``format_root`` writes it, or of a rational number."""
    text = str(number)
    if text.startswith("root("):
        index, _, poly = text[5:-1].partition(", ")
        poly = re.sub(r"\^([0-9]+)", r"^{\1}", poly).replace("*", " ")
        return rf"\operatorname{{root}}_{{{index}}}\left({poly}\right)"
    if (quotient := _QUOTIENT.fullmatch(text)) is not None:
        whole, sign, part, bottom = quotient.groups()
        text = rf"{sign or ''}\frac{{{part if whole is None else whole}}}{{{bottom}}}"
    return re.sub(r"sqrt\(([0-9]+)\)", r"\\sqrt{\1}", text).replace("*", " ")


def square_part(n: int) -> int:
    """An s with s^2 dividing n > 0: the largest one, where n has at most ``_FACTORED_BITS`` bits or is easy to factor.

    Larger numbers are divided by small primes only, since factoring them may take for ever; what remains is taken out
    where it is a square.
    """
    outside, powers = 1, Counter[int]()
    for factor, power in fmpz(n).factor(trial_limit=None if n.bit_length() <= _FACTORED_BITS else _TRIED):
        powers[int(factor)] += int(power)  # FLINT may list a factor twice
    for factor, power in powers.items():
        root = isqrt(factor)
        outside *= root**power if root * root == factor else factor ** (power // 2)
    return outside


def _format_quadratic(coefficients: Sequence[int], index: int) -> str:
    c, b, lead = coefficients
    discriminant = b * b - 4 * lead * c
    outside = square_part(discriminant)
    inside = discriminant // outside**2
    negative = index == 0
    common = Fraction(-b, 2 * lead)
    radical = Fraction(outside, 2 * lead)
    denominator = (common.denominator * radical.denominator) // gcd(common.denominator, radical.denominator)
    whole, factor = int(common * denominator), int(radical * denominator)
    root = f"sqrt({inside})" if factor == 1 else f"{factor}*sqrt({inside})"
    if whole:
        text = f"{whole} {'-' if negative else '+'} {root}"
        return text if denominator == 1 else f"({text})/{denominator}"
    text = f"-{root}" if negative else root
    return text if denominator == 1 else f"{text}/{denominator}"

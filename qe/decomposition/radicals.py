"""Roots of polynomials with parameters written with quotients and radicals, where these are short."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import gcd
from typing import NamedTuple

from qe.exact.algebraic_text import square_part
from qe.exact.ring import Poly, format_poly

NONZERO, NOT_NEGATIVE = frozenset((-1, 1)), frozenset((0, 1))


class Radical(NamedTuple):
    """``text`` has a value where the polynomials in ``needs`` have one of these signs, as far as those tell."""

    text: str
    needs: tuple[tuple[Poly, frozenset[int]], ...]


def radicals(c: Sequence[Poly], k: int, count: int, lead: int) -> Iterator[Radical]:
    """The ``k``-th of ``count`` different real roots of c[0] + c[1]*x + ...; ``lead``: the last coefficient's sign.

    Degree 1: a quotient. Two terms: x^n = b/a, with the real n-th root. Degree 2: that root is greater whose square
    root has the sign of the leading coefficient. Degree 4 with even powers alone: square roots of the roots of a
    polynomial of degree 2, of which the greater one belongs to the first and to the last root.
    """
    degree, top, quotient = len(c) - 1, (c[-1], NONZERO), quotient_text(-c[0], None, c[-1], 0)
    signs = [sign for sign, half in (("-", 2 * k <= count + 1), ("", 2 * k >= count + 1)) if half]  # of even powers
    has_two_terms, is_even = not any(c[1:-1]), degree % 2 == 0 and not any(c[1::2])
    if degree == 1:
        yield Radical(quotient, (top,))
    elif degree == 3 and has_two_terms:
        yield Radical(f"cbrt({quotient})", (top,))
    elif is_even and has_two_terms:
        root = f"sqrt({quotient})" if degree == 2 else f"{bracketed(quotient, '-/ *')}^(1/{degree})"
        yield from (Radical(sign + root, (top, (-c[0] * c[-1], NOT_NEGATIVE))) for sign in signs)
    elif is_even and degree == 4:
        square = quotient_text(*halved(c[::2]), lead if k in (1, count) else -lead)
        yield from (Radical(f"{sign}sqrt({square})", ((c[-1], frozenset()),)) for sign in signs)
    if is_even and len(signs) == 2:
        yield Radical("0", ())
    if degree == 2 and not has_two_terms:
        front, inside, bottom = halved(c)
        for side in (-1, 1) if count == 1 else (lead if k == 2 else -lead,):
            yield Radical(quotient_text(front, inside, bottom, side), (top, (inside, NOT_NEGATIVE)))


def halved(c: Sequence[Poly]) -> tuple[Poly, Poly, Poly]:
    """a, b, d of the roots (a ± sqrt(b))/d of a polynomial of degree 2, without a common factor."""
    front, inside, bottom = -c[1], c[1] * c[1] - 4 * (c[2] * c[0]), 2 * c[2]
    whole, within, below = (abs(int(p.normal()[0])) for p in (front, inside, bottom))
    common = gcd(whole, within and square_part(within), below)
    return front.exact_divide(common), inside.exact_divide(common**2), bottom.exact_divide(common)


def quotient_text(front: Poly, inside: Poly | None, bottom: Poly, sign: int) -> str:
    """``(front ± sqrt(inside))/bottom``, without the square root where nothing is ``inside``."""
    if format_poly(bottom).startswith("-"):
        front, bottom, sign = -front, -bottom, -sign
    top, below = _term(front), format_poly(bottom)
    if inside is not None:
        side, root = "-" if sign < 0 else "+", f"sqrt({_term(inside)})"
        top = f"{top} {side} {root}" if front else f"{side}{root}".removeprefix("+")
    over = bracketed(top, " ") if front else top
    return top if below == "1" else f"{over}/{bracketed(below, ' *')}"


def _term(poly: Poly) -> str:
    """The text of a polynomial; one that would begin with a minus has its terms with a plus in front."""
    text = format_poly(poly)
    terms = re.split(" (?=[+-] )", f"- {text[1:]}" if text[0] == "-" else f"+ {text}")
    if text[0] == "-":
        terms.sort(key=lambda term: term[0] == "-")
    return " ".join(terms).removeprefix("+ ") if terms[0][0] == "+" else text


def bracketed(text: str, signs: str) -> str:
    """The text in brackets where one of the signs is in it."""
    return f"({text})" if any(sign in text for sign in signs) else text

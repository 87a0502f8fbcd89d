"""The text of a polynomial from its terms without the variables that do not occur in them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from flint import fmpz

SparseTerm = tuple[tuple[tuple[int, int], ...], int]
"""((variable, exponent > 0), ...), ascending, and the coefficient."""


def digits(value: int) -> str:
    """Decimal digits (``str`` refuses more than 4300 of them, and takes quadratic time for those it gives)."""
    return str(value) if -(1 << 64) < value < 1 << 64 else str(fmpz(value))


def sparse_text(terms: Iterable[SparseTerm], names: Sequence[str] | Mapping[int, str]) -> str:
    """Text such as ``x^2 - 2*x*y + 1``; the order of terms is ``in_order``."""
    power = "{}^{}".format
    return sum_text((c, [power(names[i], k) if k > 1 else names[i] for i, k in used]) for used, c in in_order(terms))


def sum_text(terms: Iterable[tuple[int, list[str]]], times: str = "*") -> str:
    """The sum of products, each of an integer and texts."""
    pieces: list[str] = []
    for coefficient, factors in terms:
        if coefficient not in (1, -1) or not factors:
            factors = [digits(abs(coefficient)), *factors]
        pieces += "-" if coefficient < 0 else "+", times.join(factors)
    start = "-" if pieces[:1] == ["-"] else ""
    return start + " ".join(pieces[1:]) or "0"


def in_order(terms: Iterable[SparseTerm]) -> list[SparseTerm]:
    """The terms as people write them: by falling degree, then few of the late variables first, as in b^2 - 4*a*c; where
    the first one has no powers, the early variables first, as in a*d - b*c."""
    terms = list(terms)
    if all(len(used) < 2 and (not used or used[0][1] == 1) for used, _ in terms):
        terms.sort()
        return terms if not terms or terms[0][0] else [*terms[1:], terms[0]]
    late_last = sorted(terms, key=lambda term: (_degree(term), [(-i, -k) for i, k in reversed(term[0])]), reverse=True)
    if late_last and any(k > 1 for _, k in late_last[0][0]):
        return late_last
    return sorted(late_last, key=lambda term: (_degree(term), [(-i, k) for i, k in term[0]]), reverse=True)


def _degree(term: SparseTerm) -> int:
    return sum(k for _, k in term[0])

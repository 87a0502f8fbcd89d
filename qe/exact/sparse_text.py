"""The text of a polynomial from its terms without the variables that do not occur in them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from flint import fmpz

SparseTerm = tuple[tuple[tuple[int, int], ...], int]
"""((variable, exponent > 0), ...), ascending, and the coefficient."""


def sparse_text(terms: Sequence[SparseTerm], names: Sequence[str] | Mapping[int, str]) -> str:
    """Text such as ``x^2 - 2*x*y + 1``, high terms first."""
    pieces: list[str] = []
    for exponents, coefficient in sorted(terms, key=_by_degree, reverse=True):
        used = ((names[i], k) for i, k in exponents)
        powers = [name if k == 1 else f"{name}^{k}" for name, k in used]
        magnitude = abs(coefficient)
        body = "*".join(([str(fmpz(magnitude))] if magnitude != 1 or not powers else []) + powers)
        if not pieces:
            pieces.append(f"-{body}" if coefficient < 0 else body)
        else:
            pieces.append(f"{'-' if coefficient < 0 else '+'} {body}")
    return " ".join(pieces) or "0"


def _by_degree(term: SparseTerm) -> tuple[int, list[tuple[int, int]]]:
    """Total degree, then the exponents of the variables in order: an early variable makes a term high."""
    return sum(k for _, k in term[0]), [(-i, k) for i, k in term[0]]

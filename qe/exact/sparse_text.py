"""The text of a polynomial from its terms without the variables that do not occur in them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from flint import fmpz

SparseTerm = tuple[tuple[tuple[int, int], ...], int]
"""((variable, exponent > 0), ...), ascending, and the coefficient."""


def sparse_text(terms: Iterable[SparseTerm], names: Sequence[str] | Mapping[int, str]) -> str:
    """Text such as ``x^2 - 2*x*y + 1``; the order of terms is ``in_order``."""
    pieces: list[str] = []
    for exponents, coefficient in in_order(terms):
        used = ((names[i], k) for i, k in exponents)
        powers = [name if k == 1 else f"{name}^{k}" for name, k in used]
        magnitude = abs(coefficient)
        body = "*".join(([str(fmpz(magnitude))] if magnitude != 1 or not powers else []) + powers)
        if not pieces:
            pieces.append(f"-{body}" if coefficient < 0 else body)
        else:
            pieces.append(f"{'-' if coefficient < 0 else '+'} {body}")
    return " ".join(pieces) or "0"


def in_order(terms: Iterable[SparseTerm]) -> list[SparseTerm]:
    """The terms as people write them: by falling degree, then few of the late variables first, as in b^2 - 4*a*c; where
    the first one has no powers, the early variables first, as in a*d - b*c."""
    late_last = sorted(terms, key=lambda term: (_degree(term), [(-i, -k) for i, k in reversed(term[0])]), reverse=True)
    if late_last and any(k > 1 for _, k in late_last[0][0]):
        return late_last
    return sorted(late_last, key=lambda term: (_degree(term), [(-i, k) for i, k in term[0]]), reverse=True)


def _degree(term: SparseTerm) -> int:
    return sum(k for _, k in term[0])

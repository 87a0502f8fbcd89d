"""Hermite's forms with polynomials for entries: their leading minors, and the signature that their signs give."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations

from qe.exact.ring import Poly

Entries = Callable[[int, int], Poly]


def leading_minors(
    entries: Entries,
    size: int,
    one: Poly,
    *,
    times: Callable[[Poly, Poly], Poly] = lambda a, b: a * b,
    reduced: Callable[[Poly], Poly] = lambda p: p,
) -> Iterator[Poly]:
    """The determinants of the leading blocks of a square matrix of polynomials, from 1 by 1 on.

    By expansion along the rows, each determinant of a set of columns once: without divisions. ``one``: of the ring;
    ``times``: how two polynomials are multiplied; ``reduced``: what a determinant may be replaced by.
    """
    previous: dict[tuple[int, ...], Poly] = {(): one}
    for k in range(size):
        current: dict[tuple[int, ...], Poly] = {}
        for columns in combinations(range(size), k + 1):
            total = one * 0
            for position, column in enumerate(columns):
                entry, rest = entries(k, column), previous[columns[:position] + columns[position + 1 :]]
                if entry and rest:
                    total = total + times(entry, rest) * (-1) ** (k - position)
            current[columns] = reduced(total)
        previous = current
        yield current[tuple(range(k + 1))]


def added_signature(gap: int, sign: int, last: int) -> int | None:
    """What a leading minor of a Hankel matrix adds to the signature, by its sign and that of the last one before it
    that is not 0, ``gap`` sizes smaller; None for signs that do not occur.

    THEOREM (Frobenius 1894; Gantmacher, volume 1, chapter X, section 10). The last leading minor of a Hankel matrix of
    rank r that is not 0 is that of size r, and the signature is the sum of (-1)^((k-1)/2)*sign(D_i*D_(i+k)) over
    neighbouring minors D_i, D_(i+k) that are not 0, k odd; for even k D_i*D_(i+k) has the sign (-1)^(k/2).
    """
    turned = sign * last if gap // 2 % 2 == 0 else -sign * last
    if gap % 2:
        return turned
    return 0 if turned == 1 else None

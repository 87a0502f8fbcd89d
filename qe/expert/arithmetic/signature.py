"""The signature of a symmetric matrix of polynomials, read off signs: when it can have which value.

THEOREM (Jacobi, Gundelfinger, Frobenius). Let D_0 = 1, D_1, ..., D_n be the leading minors of a real symmetric matrix
and D_n not 0. Where D_j and D_(j+g) are not 0 and the minors between them are, the signature grows by sign(D_j*D_(j+1))
for g = 1, by 0 for g = 2, and then the two have opposite signs, by -sign(D_j*D_(j+3)) for g = 3. In a trace form in
the powers of one variable, which is a Hankel matrix, the last minor that is not 0 has the size of the rank (it is a
square of a Vandermonde determinant times the weights), and g may be any number: for odd g it grows by
(-1)^((g-1)/2)*sign(D_j*D_(j+g)), for even g by 0, and then D_j*D_(j+g) has the sign (-1)^(g/2) (Frobenius 1894).

THEOREM (Descartes). A characteristic polynomial has real roots only: as many positive ones as its coefficients change
signs, as many negative ones as those with x replaced by -x. Two neighbouring coefficients that are 0 have only such
behind them, and a single 0 has neighbours of opposite signs, or none that are not 0 behind it.

So every vector of signs that occurs belongs to one signature; vectors that the theorems exclude belong to none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Formula, Relation

Signatures = dict[int, Formula]
"""For every signature that can occur the signs with which it does."""

SMALL = 4
"""Matrices of this size are read by minors as far as these decide; larger ones only where the last one is not 0."""


@dataclass(frozen=True)
class _Read:
    """The last sign other than 0, the zeros since, and the signature so far; None where it was left open."""

    last: int = 1
    zeros: int = 0
    so_far: int | None = 0


def signatures(
    minors: Sequence[Poly], coefficients: Callable[[], Sequence[Poly]], *, hankel: bool, square: bool
) -> Signatures:
    """When the matrix has which signature. ``coefficients``: of the characteristic polynomial, behind the first one;
    ``hankel``: a trace form in the powers of one variable; ``square``: for a square, whose signature is not negative.
    """
    if hankel or len(minors) <= SMALL:
        found = _by_minors(minors, coefficients, hankel=hankel, regular=False)
    else:
        found = _under(atom(minors[-1], Relation.NE), _by_minors(minors, coefficients, hankel=False, regular=True))
        rest = _under(atom(minors[-1], Relation.EQ), _by_descartes(coefficients()))
        found = {s: disj([f[s] for f in (found, rest) if s in f]) for s in (*found, *rest)}
    return {s: f for s, f in found.items() if f != FALSE and (s >= 0 or not square)}


def _under(condition: Formula, found: Signatures) -> Signatures:
    return {s: conj([condition, f]) for s, f in found.items()}


def _by_minors(
    minors: Sequence[Poly], coefficients: Callable[[], Sequence[Poly]], *, hankel: bool, regular: bool
) -> Signatures:
    """``regular``: only where the last minor is not 0."""

    def after(read: _Read, sign: int) -> _Read | None:
        gap = read.zeros + 1
        if read.so_far is None or (gap > 3 and not hankel):
            return _Read(sign, 0, None)
        turn = (-1) ** (gap // 2)
        if gap % 2:
            return _Read(sign, 0, read.so_far + turn * sign * read.last)
        return _Read(sign, 0, read.so_far) if sign * read.last == turn else None

    def end(read: _Read) -> Signatures:
        if read.zeros and regular:
            return {}
        if read.so_far is None or (read.zeros and not hankel):
            return _by_descartes(coefficients())
        return {read.so_far: TRUE}

    return _followed(minors, after, end)


def _by_descartes(coefficients: Sequence[Poly]) -> Signatures:
    def after(read: _Read, sign: int) -> _Read | None:
        if read.zeros > 1 or (read.zeros == 1 and sign == read.last):
            return None
        mirrored = read.last if read.zeros else -read.last  # the sign before it where x is replaced by -x
        return _Read(sign, 0, (read.so_far or 0) + (sign != read.last) - (sign != mirrored))

    return _followed(coefficients, after, lambda read: {read.so_far or 0: TRUE})


def _followed(
    polys: Sequence[Poly], after: Callable[[_Read, int], _Read | None], end: Callable[[_Read], Signatures]
) -> Signatures:
    """All ways to read the signs of the polynomials, one after the other."""

    @cache
    def following(k: int, read: _Read) -> Signatures:
        if k == len(polys):
            return end(read)
        found: dict[int, dict[Formula, list[int]]] = {}
        for sign in (1, 0, -1):
            reached = after(read, sign) if sign else _Read(read.last, read.zeros + 1, read.so_far)
            for value, f in following(k + 1, reached).items() if reached is not None else ():
                found.setdefault(value, {}).setdefault(f, []).append(sign)
        return {v: disj(conj([_is_one_of(polys[k], signs), f]) for f, signs in by.items()) for v, by in found.items()}

    return following(0, _Read())


def _is_one_of(p: Poly, signs: Sequence[int]) -> Formula:
    relation = next((r for r in Relation if r.signs == frozenset(signs)), None)
    return TRUE if relation is None else atom(p, relation)

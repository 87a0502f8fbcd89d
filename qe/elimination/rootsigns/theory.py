"""Which signs the minors of Hermite's forms and the coefficients have, by how the roots of a polynomial lie.

Let f have degree n in x, and let g be a polynomial. ``RootType`` says for every distinct root of f what g is there and
how often the root is one. The forms Tr(x^(i+j)) and Tr(g*x^(i+j)), summed over the roots with their multiplicities, are
Hankel matrices. THEOREM (Hermite 1853; Basu, Pollack, Roy 2006, theorem 4.57). The rank of the form of g is the number
of distinct roots of f at which g /= 0, its signature the number of real ones with g > 0 minus that of those with g < 0.
By Frobenius' theorem (``qe.exact.hermite``) the last leading minor that is not 0 is that of size r where f has r roots
with g /= 0, and the signs of the minors give the signature.
THEOREM (Descartes). The number of positive roots, with multiplicities, is that of the changes of sign of the
coefficients or an even number less; so for negative ones with x -> -x.
THEOREM. I = 12*a*e - 3*b*d + c^2 of a*x^4 + b*x^3 + c*x^2 + d*x + e is 0 where a root is triple, and positive where a
root is double and none is triple or all are simple and their number of real ones is not 2. (For f = a*((x-r)*(x-s))^2
it is a^2*(r-s)^4, and 4*I^3 = J^2 + 27*D for the discriminant D, where I = J = 0 iff a root is triple.)

``rows`` lists all rows of signs that these theorems allow. Where a row belongs to types of different truth it decides
nothing; where all its types agree it does.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from itertools import pairwise, product

from qe.exact.hermite import added_signature

Signs = tuple[int, ...]
Name = tuple[str, int]
"""A literal: P, A, Q for a minor of the form of 1, g, g^2 by its size, c for a coefficient by its power, I for I."""


class Root(Enum):
    """What g is at a root, or at both of a pair of complex conjugate roots."""

    NEGATIVE = -1
    ZERO = 0
    POSITIVE = 1
    PAIR = "pair"
    ZERO_PAIR = "pair of zeros"


RootType = tuple[tuple[Root, int], ...]
"""The distinct roots with their multiplicities."""


class Place(Enum):
    """Where roots are looked for: on the whole line, at x > 0 (g is x), or where g, any polynomial, has a sign."""

    LINE = "line"
    RAY = "ray"
    CONDITION = "condition"


@dataclass(frozen=True, slots=True)
class Shape:
    """The degree of f, the place, whether g has odd degree, and whether Q and I take part."""

    degree: int
    place: Place
    odd: bool = False
    squares: bool = False
    invariant: bool = False

    @property
    def names(self) -> tuple[Name, ...]:
        """The literals: leading coefficient, minors, the other coefficients."""
        n, names = self.degree, [("c", self.degree)]
        names += [("P", k) for k in range(2, n + 1)]
        if self.place is Place.RAY:
            names += [("A", k) for k in range(1, n)] + [("c", k) for k in range(n)]
        if self.place is Place.CONDITION:
            names += [("A", k) for k in range(1, n + 1)]
        if self.squares:
            names += [("Q", k) for k in range(1, n + 1)]
        return (*names, ("I", 0)) if self.invariant else tuple(names)


def types(shape: Shape) -> Iterator[RootType]:
    """The multisets of roots with a sum of multiplicities that is the degree."""
    real = [Root.POSITIVE] if shape.place is Place.LINE else [Root.NEGATIVE, Root.ZERO, Root.POSITIVE]
    pairs = [Root.PAIR, Root.ZERO_PAIR] if shape.place is Place.CONDITION else [Root.PAIR]
    kinds = [(r, m, m) for r in real for m in range(1, shape.degree + 1)]
    kinds += [(r, m, 2 * m) for r in pairs for m in range(1, shape.degree // 2 + 1)]

    def further(left: int, first: int) -> Iterator[RootType]:
        if not left:
            yield ()
        for k in range(first, len(kinds)):
            root, multiplicity, size = kinds[k]
            if size <= left:
                once = shape.place is Place.RAY and root is Root.ZERO  # x is 0 at one root only
                for rest in further(left - size, k):
                    if not (once and any(r is Root.ZERO for r, _ in rest)):
                        yield ((root, multiplicity), *rest)

    return further(shape.degree, 0)


def count(kind: RootType, *roots: Root) -> int:
    """The number of distinct roots, or pairs, of some kinds."""
    return sum(r in roots for r, _ in kind)


REAL = (Root.NEGATIVE, Root.ZERO, Root.POSITIVE)


@lru_cache(maxsize=32)
def rows(shape: Shape) -> tuple[tuple[Signs, int, RootType], ...]:
    """All rows of signs, in the order of the names, with the sign of the leading coefficient and the type."""
    listed = []
    for kind in types(shape):
        for lead in (1, -1):
            parts = [[(lead,)], *_parts(shape, kind, lead)]
            listed += [(sum(chosen, ()), lead, kind) for chosen in product(*parts)]
    return tuple(listed)


def _parts(shape: Shape, kind: RootType, lead: int) -> Iterator[Sequence[Signs]]:
    """For every group of literals the signs that a type allows."""
    n, positive, negative = shape.degree, count(kind, Root.POSITIVE), count(kind, Root.NEGATIVE)
    imaginary = 2 * count(kind, Root.PAIR)
    real, unreal = count(kind, *REAL), imaginary + 2 * count(kind, Root.ZERO_PAIR)
    yield [s[1:] for s in minors(n, real + unreal, real) if s[0] == 1]  # the first is the degree
    if shape.place is not Place.LINE:
        rank = positive + negative + imaginary
        sign = lead if shape.odd else 1
        forms = [tuple(sign * s for s in row) for row in minors(n, rank, positive - negative)]
        yield list(dict.fromkeys(s[:-1] for s in forms)) if shape.place is Place.RAY else forms
    if shape.place is Place.RAY:
        yield [s[:-1] for s in coefficients(n, kind, lead)]
    if shape.squares:
        yield minors(n, positive + negative + imaginary, positive + negative)
    if shape.invariant:
        yield [(s,) for s in _invariant(kind)]


@lru_cache(maxsize=512)
def minors(size: int, rank: int, signature: int) -> tuple[Signs, ...]:
    """The signs of the leading minors of Hankel matrices, by the theorem of Frobenius."""
    if not rank:
        return ((0,) * size,) if not signature else ()
    listed = []
    for signs in product((1, 0, -1), repeat=rank):
        if signs[-1] and _signature(signs) == signature:
            listed.append((*signs, *(0,) * (size - rank)))
    return tuple(listed)


def _signature(signs: Signs) -> int | None:
    """What the minors up to the last one, which is not 0, say; None for signs that do not occur."""
    last, gap, total = 1, 0, 0
    for sign in signs:
        gap += 1
        if not sign:
            continue
        added = added_signature(gap, sign, last)
        if added is None:
            return None
        total, last, gap = total + added, sign, 0
    return total


@lru_cache(maxsize=512)
def coefficients(degree: int, kind: RootType, lead: int) -> tuple[Signs, ...]:
    """Their signs, the constant one first, by Descartes' rule."""
    places = {r: sum(m for s, m in kind if s is r) for r in REAL}
    zeros, listed = (0,) * places[Root.ZERO], []
    for signs in product((1, 0, -1), repeat=degree - len(zeros)):
        row = (*zeros, *signs, lead)
        if not row[len(zeros)]:
            continue
        mirrored = [(-1) ** k * s for k, s in enumerate(row)]
        spare = [_changes(row) - places[Root.POSITIVE], _changes(mirrored) - places[Root.NEGATIVE]]
        if all(k >= 0 and k % 2 == 0 for k in spare):
            listed.append(row)
    return tuple(listed)


def _changes(signs: Sequence[int]) -> int:
    return sum(a != b for a, b in pairwise([s for s in signs if s]))


def _invariant(kind: RootType) -> Signs:
    """The signs of I."""
    most = max(m for _, m in kind)
    if most > 2:
        return (0,)
    return (1,) if most == 2 or count(kind, *REAL) != 2 else (1, 0, -1)

"""Sums of squares of binomials, by exact linear programming.

A polynomial is nowhere negative if it is a sum of c * (m - m')^2 and c * m^2 with c >= 0 and monomials m, m', some of
them with a plus (Hurwitz 1891; sums of binomial squares: Ahmadi, Majumdar 2019). With x = y^2 for the variables that
are not negative it is a polynomial in y, and squares that are even in y there are x^a * (m - m')^2 with a of zeros and
ones. Which c fit is a question of linear inequalities; no floating-point number takes part.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import chain, combinations, pairwise
from operator import itemgetter, sub

from qe.exact.linear_bounds import LinearBounds
from qe.exact.ring import Poly
from qe.positivity.identity import Positive, Powers, sum_of

MOST_POINTS, FEW_TERMS, MOST_TERMS, MOST_UNKNOWN = 24, 40, 500, 400
"""Monomials of squares that are added, terms up to which that is done, terms at most, and numbers to be found."""

Exponents = tuple[int, ...]
Square = tuple[Exponents, Exponents | None, int]
"""(m + sign * n)^2, or m^2."""


@lru_cache(maxsize=2_000)
def binomial_squares(poly: Poly, orthant: frozenset[int]) -> Positive | None:
    """That the polynomial is nowhere negative where the variables of ``orthant`` are not; None if it is no such sum."""
    if poly.term_count() > MOST_TERMS:
        return None
    doubled = [2 if i in orthant else 1 for i in range(poly.ring.size)]
    terms = {tuple(e * d for e, d in zip(exponents, doubled, strict=True)): c for exponents, c in poly.terms()}
    if any(c < 0 and sum(e) == poly.total_degree * max(doubled) and _is_vertex(e, terms) for e, c in terms.items()):
        return None
    points = _points(e for e, c in terms.items() if c > 0 and _is_even(e))
    problem = _Problem(poly, orthant, terms, points, _groups(terms, points))
    zero = (0,) * poly.ring.size
    return (problem.solved(strict=True) if terms.get(zero, 0) > 0 else None) or problem.solved(strict=False)


def _is_vertex(exponents: Exponents, terms: Iterable[Exponents]) -> bool:
    """Whether one variable alone occurs, to a power that is its highest."""
    own = [i for i, e in enumerate(exponents) if e]
    return len(own) == 1 and all(other[own[0]] <= exponents[own[0]] for other in terms)


def _groups(terms: dict[Exponents, int], points: list[Exponents]) -> list[list[int]]:
    """Variables of which any two can change places in the polynomial and among the monomials of squares."""
    size, groups = len(next(iter(terms))), list[list[int]]()
    for i in range(size):
        for group in groups:
            places = [*range(size)]
            places[i], places[group[0]] = group[0], i
            moved: Callable[[Exponents], Exponents] = itemgetter(*places)
            if {moved(e): c for e, c in terms.items()} == terms and {*map(moved, points)} == {*points}:
                group.append(i)
                break
        else:
            groups.append([i])
    return groups


def _is_even(exponents: Exponents) -> bool:
    return not any(e % 2 for e in exponents)


def _points(squares: Iterable[Exponents]) -> list[Exponents]:
    """Half the exponents of squares, and points halfway between them, while they are few."""
    found = dict.fromkeys(tuple(e // 2 for e in s) for s in squares)
    for _ in range(2 if len(found) <= MOST_POINTS else 0):
        between = (tuple(a + b for a, b in zip(*pair, strict=True)) for pair in combinations(list(found), 2))
        for point in dict.fromkeys(tuple(e // 2 for e in s) for s in between if _is_even(s)):
            if len(found) < MOST_POINTS:
                found.setdefault(point)
    return list(found)


@dataclass(slots=True)
class _Problem:
    """``terms``: the polynomial in y; ``points``: monomials of the squares;
    ``exchangeable``: variables that can change places, all of them in one of these groups."""

    poly: Poly
    orthant: frozenset[int]
    terms: dict[Exponents, int]
    points: list[Exponents]
    exchangeable: list[list[int]]

    def solved(self, *, strict: bool) -> Positive | None:
        """``strict``: with a positive constant. Squares that exchanges turn into one another get the same number, as
        the average over all exchanges is such a sum, too."""
        bounds, alike = LinearBounds(), dict[Hashable, list[Square]]()
        for m, n, sign in self.squares():
            ends = [*zip(m, n or m, strict=True)], [*zip(n or m, m, strict=True)]
            alike.setdefault((min(map(self.orbit, ends)), n is None, sign), []).append((m, n, sign))
        if len(alike) > MOST_UNKNOWN:  # without neighbours
            last = {key: _entries(each[0])[-1][0] for key, each in alike.items()}
            alike = {k: each for k, each in alike.items() if each[0][1] is None or self.terms.get(last[k], 0) < 0}
        equations = {e: dict[int, Fraction]() for e in self.terms if self.is_first(e)}
        for squares in alike.values():
            number = bounds.variable()
            for e, c in chain.from_iterable(map(_entries, squares)):
                if self.is_first(e):
                    row = equations.setdefault(e, {})
                    row[number] = row.get(number, Fraction(0)) + c
            m, n, _ = squares[0]
            bounds.at_least(number, Fraction(0), strict=strict and n is None and not any(m), reason=number)
        for exponents, row in equations.items():
            wanted = Fraction(self.terms.get(exponents, 0))
            row = {number: c for number, c in row.items() if c}
            if not row:
                if wanted:
                    return None
                continue
            form = bounds.form(row)
            sides = (bounds.at_least, bounds.at_most)
            if any(bounded(form, wanted, strict=False, reason=exponents) is not None for bounded in sides):
                return None
        if bounds.conflict(lambda: None) is not None:
            return None
        values = bounds.point()
        parts = [(values[k], self.product(*one)) for k, each in enumerate(alike.values()) if values[k] for one in each]
        return Positive((sum_of(self.poly, parts),), strict)

    def orbit(self, columns: Sequence[tuple[int, int]]) -> tuple[tuple[int, int], ...]:
        """The same for pairs of exponents that exchanges turn into one another."""
        return tuple(c for group in self.exchangeable for c in sorted(columns[i] for i in group))

    def is_first(self, exponents: Exponents) -> bool:
        """Whether it stands for all exponents that exchanges turn into it."""
        return all(exponents[i] <= exponents[j] for group in self.exchangeable for i, j in pairwise(group))

    def squares(self) -> Iterator[Square]:
        """The squares that may take part; of many those of neighbours, and those with a product that is negative."""
        yield from ((m, None, 1) for m in self.points)
        for m, n in combinations(self.points, 2) if len(self.terms) <= FEW_TERMS else self.near():
            mixed = _sum(m, n)
            coefficient = self.terms.get(mixed, 0)
            if coefficient or _is_even(mixed):  # else it is odd in y: the polynomial is even
                yield m, n, 1 if coefficient > 0 and not _is_even(mixed) else -1

    def near(self) -> Iterable[tuple[Exponents, Exponents]]:
        """Those with a product that is negative, and those of M * x_i^2 and M * x_j^2 or M, each once."""
        known, size = {*self.points}, self.poly.ring.size
        steps = [[2 * ((k == i) - (k == j)) for k in range(size)] for i in range(size + 1) for j in range(i)]
        negative = [e for e, c in self.terms.items() if c < 0]
        ends = ((m, _sum(m, step)) for m in self.points for step in steps)
        others = ((m, tuple(map(sub, e, m))) for m in self.points for e in negative)
        return dict.fromkeys((max(m, n), min(m, n)) for m, n in chain(ends, others) if n in known and m != n)

    def product(self, m: Exponents, n: Exponents | None, sign: int) -> Powers:
        """x^a * (m + sign * n)^2 in the variables x."""
        ring = self.poly.ring
        shared = [i in self.orthant and m[i] % 2 == 1 for i in range(ring.size)]
        base = ring.from_terms({self.halved(m): 1} if n is None else {self.halved(m): 1, self.halved(n): sign})
        linear = tuple((ring.gen(i), 1) for i, odd in enumerate(shared) if odd)
        return linear if base.is_constant else (*linear, (base, 2))

    def halved(self, m: Exponents) -> Exponents:
        return tuple(e // 2 if i in self.orthant else e for i, e in enumerate(m))


def _entries(square: Square) -> list[tuple[Exponents, int]]:
    m, n, sign = square
    return [(_sum(m, m), 1)] if n is None else [(_sum(m, m), 1), (_sum(n, n), 1), (_sum(m, n), 2 * sign)]


def _sum(m: Exponents, n: Sequence[int]) -> Exponents:
    return tuple(a + b for a, b in zip(m, n, strict=True))

"""Sums of squares of binomials, by exact linear programming.

A polynomial is nowhere negative if it is a sum of c * (m - m')^2 and c * m^2 with c >= 0 and monomials m, m', some of
them with a plus (Hurwitz 1891; sums of binomial squares: Ahmadi, Majumdar 2019). With x = y^2 for the variables that
are not negative it is a polynomial in y, and squares that are even in y there are x^a * (m - m')^2 with a of zeros and
ones. Which c fit is a question of linear inequalities; no floating-point number takes part.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import combinations

from qe.exact.linear_bounds import LinearBounds
from qe.exact.ring import Poly
from qe.positivity.identity import Positive, Powers, sum_of

MOST_POINTS, FEW_TERMS, MOST_TERMS = 24, 40, 400
"""Monomials of squares that are added, terms up to which that is done, and terms at most."""

Exponents = tuple[int, ...]


@lru_cache(maxsize=2_000)
def binomial_squares(poly: Poly, orthant: frozenset[int]) -> Positive | None:
    """That the polynomial is nowhere negative where the variables of ``orthant`` are not; None if it is no such sum."""
    if poly.term_count() > MOST_TERMS:
        return None
    doubled = [2 if i in orthant else 1 for i in range(poly.ring.size)]
    terms = {tuple(e * d for e, d in zip(exponents, doubled, strict=True)): c for exponents, c in poly.terms()}
    if any(c < 0 and sum(e) == poly.total_degree * max(doubled) and _is_vertex(e, terms) for e, c in terms.items()):
        return None
    problem = _Problem(poly, orthant, terms, _points(e for e, c in terms.items() if c > 0 and _is_even(e)))
    zero = (0,) * poly.ring.size
    return (problem.solved(strict=True) if terms.get(zero, 0) > 0 else None) or problem.solved(strict=False)


def _is_vertex(exponents: Exponents, terms: Iterable[Exponents]) -> bool:
    """Whether one variable alone occurs, to a power that is its highest."""
    own = [i for i, e in enumerate(exponents) if e]
    return len(own) == 1 and all(other[own[0]] <= exponents[own[0]] for other in terms)


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
    """``terms``: the polynomial in y; ``points``: monomials of the squares."""

    poly: Poly
    orthant: frozenset[int]
    terms: dict[Exponents, int]
    points: list[Exponents]

    def solved(self, *, strict: bool) -> Positive | None:
        """``strict``: with a positive constant."""
        bounds, columns = LinearBounds(), list(self.columns())
        equations: dict[Exponents, dict[int, Fraction]] = {e: {} for e in self.terms}
        for entries, _ in columns:
            number = bounds.variable()
            for exponents, c in entries:
                equations.setdefault(exponents, {})[number] = Fraction(c)
            lowest = strict and len(entries) == 1 and not any(entries[0][0])
            bounds.at_least(number, Fraction(0), strict=lowest, reason=number)
        for exponents, row in equations.items():
            wanted = Fraction(self.terms.get(exponents, 0))
            if not row:
                return None
            form = bounds.form(row)
            if bounds.at_least(form, wanted, strict=False, reason=exponents) is not None:
                return None
            if bounds.at_most(form, wanted, strict=False, reason=exponents) is not None:
                return None
        if bounds.conflict(lambda: None) is not None:
            return None
        values = bounds.point()
        parts = [(values[k], make()) for k, (_, make) in enumerate(columns) if values[k]]
        return Positive((sum_of(self.poly, parts),), strict)

    def columns(self) -> Iterable[tuple[list[tuple[Exponents, int]], Callable[[], Powers]]]:
        """The squares that may take part: their terms, and their factors."""
        for m in self.points:
            yield [(_sum(m, m), 1)], lambda m=m: self.product(m, None, 1)  # type: ignore[misc]
        for m, n in combinations(self.points, 2):
            mixed = _sum(m, n)
            coefficient = self.terms.get(mixed, 0)
            if coefficient >= 0 and (len(self.terms) > FEW_TERMS or (not coefficient and not _is_even(mixed))):
                continue  # also where it is odd in y: the polynomial is even
            sign = 1 if coefficient > 0 and not _is_even(mixed) else -1
            entries = [(_sum(m, m), 1), (_sum(n, n), 1), (mixed, 2 * sign)]
            yield entries, lambda m=m, n=n, sign=sign: self.product(m, n, sign)  # type: ignore[misc]

    def product(self, m: Exponents, n: Exponents | None, sign: int) -> Powers:
        """x^a * (m + sign * n)^2 in the variables x."""
        ring = self.poly.ring
        shared = [i in self.orthant and m[i] % 2 == 1 for i in range(ring.size)]
        base = ring.from_terms({self.halved(m): 1})
        if n is not None:
            base = base + ring.from_terms({self.halved(n): sign})
        linear = tuple((ring.gen(i), 1) for i, odd in enumerate(shared) if odd)
        return linear if base.is_constant else (*linear, (base, 2))

    def halved(self, m: Exponents) -> Exponents:
        return tuple(e // 2 if i in self.orthant else e for i, e in enumerate(m))


def _sum(m: Exponents, n: Exponents) -> Exponents:
    return tuple(a + b for a, b in zip(m, n, strict=True))

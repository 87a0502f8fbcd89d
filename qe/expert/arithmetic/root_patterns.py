"""How the roots of one polynomial can lie, and which signs of Hermite's forms and of coefficients go with it.

THEOREM (Hermite 1853; Basu, Pollack, Roy 2006, section 4.3). Let B be the matrix of multiplication by a*x modulo f =
c_0 + … + c_n*x^n, a = c_n /= 0, so that the trace of its k-th power is a^k times the sum of the k-th powers of the
roots.
The Hankel matrix of the traces of g*x^(i+j) has as its rank the number of distinct roots at which g /= 0, and as its
signature the number of the real ones of these with g > 0 minus that of those with g < 0.
THEOREM (Frobenius 1894). Where a Hankel matrix of rank r has a leading minor of size r that is not 0 (here it has, by
the formula of Cauchy and Binet: r distinct roots with g /= 0), the signature is found by reading the leading minors
that are not 0, one after the other: from D_i to D_j with j - i odd it changes by (-1)^((j-i-1)/2)*sign(D_i*D_j), and
with j - i even D_i*D_j has the sign (-1)^((j-i)/2). Before the first one stands 1.
THEOREM (Descartes). Positive roots, with multiplicities, are as many as the changes of sign in the coefficients, or an
even number less; negative roots as in f(-x).
THEOREM. For a quartic with coefficients c_0, …, c_4 let I = 12*c_4*c_0 - 3*c_3*c_1 + c_2^2, and J the other invariant:
27 times the discriminant is 4*I^3 - J^2, and I = J = 0 iff a root is at least triple. So I = 0 in that case, and
I > 0 where another root is multiple, or where the discriminant is positive: 0 or 4 real roots, all simple.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise, product

from qe.errors import Unable
from qe.exact.ring import Poly

MOST_TERMS = 20_000
"""Terms of a product that are multiplied out."""

Signs = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Pattern:
    """Multiplicities of the distinct real roots with g > 0, = 0, < 0, and of pairs with g /= 0, with g = 0."""

    above: tuple[int, ...]
    on: tuple[int, ...]
    below: tuple[int, ...]
    pairs: tuple[int, ...]
    zero_pairs: tuple[int, ...]

    @property
    def real(self) -> tuple[int, ...]:
        """All real roots."""
        return self.above + self.on + self.below

    @property
    def distinct(self) -> int:
        """All distinct roots."""
        return len(self.real) + 2 * len(self.pairs) + 2 * len(self.zero_pairs)

    @property
    def rank(self) -> int:
        """Of the form of g."""
        return len(self.above) + len(self.below) + 2 * len(self.pairs)

    def quartic_invariant(self) -> Signs:
        """The signs that I can have."""
        highest = max(self.real + self.pairs + self.zero_pairs)
        if highest >= 3:
            return (0,)
        return (-1, 0, 1) if highest == 1 and len(self.real) == 2 else (1,)


@lru_cache(maxsize=16)
def patterns(degree: int) -> tuple[Pattern, ...]:
    """All of them."""
    found = []
    for sizes in product(range(degree + 1), repeat=5):
        if sum(sizes[:3]) + 2 * sum(sizes[3:]) == degree:
            found += [Pattern(*parts) for parts in product(*(_partitions(s, s) for s in sizes))]
    return tuple(found)


def _partitions(total: int, most: int) -> list[tuple[int, ...]]:
    if not total:
        return [()]
    return [(k, *rest) for k in range(min(total, most), 0, -1) for rest in _partitions(total - k, k)]


@lru_cache(maxsize=32)
def forms(size: int) -> dict[tuple[int, int], list[Signs]]:
    """By rank and signature the signs of the leading minors."""
    found: dict[tuple[int, int], list[Signs]] = {}
    for signs in product((-1, 0, 1), repeat=size):
        rank = max((k + 1 for k, s in enumerate(signs) if s), default=0)
        value = _signature(signs[:rank])
        if value is not None:
            found.setdefault((rank, value), []).append(signs)
    return found


def _signature(signs: Signs) -> int | None:
    places = [(0, 1), *((k, s) for k, s in enumerate(signs, 1) if s)]
    total = 0
    for (i, before), (j, after) in pairwise(places):
        half, odd = divmod(j - i, 2)
        turn = 1 if half % 2 == 0 else -1
        if odd:
            total += turn * before * after
        elif before * after != turn:
            return None
    return total


def descartes(signs: Signs, pattern: Pattern) -> bool:
    """Whether coefficients, the constant one first, can have these signs, where g is x."""
    zeros = next(k for k, s in enumerate(signs) if s)
    if zeros != sum(pattern.on):
        return False
    for roots, mirrored in ((pattern.above, 1), (pattern.below, -1)):
        row = [s * mirrored**k for k, s in enumerate(signs) if s]
        spare = sum(a != b for a, b in pairwise(row)) - sum(roots)
        if spare < 0 or spare % 2:
            return False
    return True


def traces(c: Sequence[Poly], most: int) -> list[Poly]:
    """a^k times the sum of the k-th powers of the roots, by powers of B."""
    n, zero, a = len(c) - 1, c[0].ring.constant(0), c[-1]
    matrix = [[zero] * n for _ in range(n)]
    for i in range(n):
        matrix[i][n - 1] = -c[i]
        if i:
            matrix[i][i - 1] = a
    power = [[c[0].ring.constant(int(i == j)) for j in range(n)] for i in range(n)]
    found = []
    for _ in range(most + 1):
        found.append(sum((power[i][i] for i in range(n)), start=zero))
        power = [
            [sum((times(power[i][k], matrix[k][j]) for k in range(n)), start=zero) for j in range(n)] for i in range(n)
        ]
    return found


def leading_minors(c: Sequence[Poly], g: Sequence[Poly]) -> list[Poly]:
    """The leading minors of size k of the form of g, of degree m, times a^(2*(k-1) + m), for k from 1 to n.

    Each is a sum over k roots of their g and the squares of their differences (Cauchy, Binet), of that degree in each
    root, so a polynomial in the coefficients.
    """
    n, m, a = len(c) - 1, len(g) - 1, c[-1]
    sums, zero = traces(c, 2 * n - 2 + m), c[0].ring.constant(0)
    entry = [
        sum((times(times(p, a ** (m - j)), sums[k + j]) for j, p in enumerate(g)), start=zero) for k in range(2 * n - 1)
    ]
    found = []
    for size in range(1, n + 1):
        whole = _determinant([[entry[i + j] for j in range(size)] for i in range(size)])
        # row i was multiplied by a^(m+i), column j by a^j
        spare = size * m + size * (size - 1) - (2 * (size - 1) + m)
        found.append(whole if a == 1 or not spare else whole.exact_divide(a**spare))
    return found


def _determinant(rows: list[list[Poly]]) -> Poly:
    """By expansion along the first row."""
    if len(rows) == 1:
        return rows[0][0]
    total = rows[0][0].ring.constant(0)
    for j, first in enumerate(rows[0]):
        if first:
            total = total + times(first, _determinant([row[:j] + row[j + 1 :] for row in rows[1:]])) * (-1) ** j
    return total


def times(left: Poly, right: Poly) -> Poly:
    """A product, unless it is out of reach."""
    if left.term_count() * right.term_count() > MOST_TERMS * 50:
        raise Unable("a form of Hermite is out of reach")
    return left * right


def charts(lead: int, multiplicities: Sequence[int]) -> Iterator[int]:
    """The signs that a polynomial takes right of a point, at and between so many roots there, from the right."""
    sign = lead
    yield sign
    for m in multiplicities:
        yield 0
        sign = sign * (-1) ** m
        yield sign

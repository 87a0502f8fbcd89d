"""Sums of squares of polynomials: positive semidefinite rational Gram matrices, found by a small semidefinite program.

p = sum of m_k * b_k^T Q_k b_k, with matrices Q_k positive semidefinite, polynomials b_k and factors m_k that are
nowhere negative, proves p >= 0; LDL^T of Q_k gives the squares. With x = y^2 for the variables that are not negative
p is even in y, and its squares fall into classes by parity (Gatermann, Parrilo 2004, for these changes of sign): the
m_k are products of such variables. The matrices are an affine space over Q; a point of it that is well inside the
cones (found in floating point) stays inside when its free entries are rounded, and the identity stays exact (after
Peyrl, Parrilo 2008). A p with zeros has none inside: the polynomials b_k are those combinations of monomials that
vanish at the zeros that are found.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import combinations, product
from math import lcm, prod
from operator import add, sub

from qe.exact.quadratic_form import echelon, solve_linear
from qe.exact.ring import Poly
from qe.positivity.identity import Identity, Positive, Powers, sum_of
from qe.positivity.samples import drawn, grid

MOST_MONOMIALS, MOST_LOOKED_AT, MOST_ENTRIES, MOST_EQUATIONS = 220, 10_000, 3_000, 260
MOST_TERMS, MOST_VARIABLES = 200, 6
MOST_BITS, FEW = 4_000, 26  # of a common denominator; where it is longer, so many products are added at once
STEPS, LARGEST, NOISE = 60, 1e12, 1e-6  # of the solver; beyond these its point is not worth rounding
_DENOMINATORS = (1, 2, 12, 60, 2**10, 2**20, 2**32)

Exponents = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class _Squares:
    """The products of a factor, given by its variables, and squares of combinations of the polynomials ``basis``."""

    factor: tuple[Poly, ...]
    basis: tuple[Poly, ...]

    def places(self) -> Iterator[tuple[int, int]]:
        """The entries (i, j) of the Gram matrix with i <= j."""
        return ((i, j) for i in range(len(self.basis)) for j in range(i, len(self.basis)))

    def parts(self, entries: Iterator[Fraction]) -> list[tuple[Fraction, Powers]] | None:
        """The sum of squares with these entries by LDL^T; None where the matrix is not positive semidefinite."""
        size, products = len(self.basis), list[tuple[Fraction, Powers]]()
        rows = [[Fraction(0)] * size for _ in range(size)]
        for (i, j), entry in zip(self.places(), entries, strict=False):
            rows[i][j] = rows[j][i] = entry
        for k in range(size):
            pivot = rows[k][k]
            if pivot < 0 or (not pivot and any(rows[k][k:])):
                return None
            if not pivot:
                continue
            weights = [entry / pivot for entry in rows[k][k:]]
            scale = lcm(*(w.denominator for w in weights))
            base = sum(
                (b * int(w * scale) for b, w in zip(self.basis[k:], weights, strict=True) if w), 0 * self.basis[k]
            )
            factor, square = tuple((v, 1) for v in self.factor), (base, 2)
            if base.is_constant:
                products.append((pivot * base.constant_value() ** 2 / scale**2, factor))
            else:
                products.append((pivot / scale**2, (*factor, square)))
            for i in range(k + 1, size):
                if step := rows[i][k] / pivot:
                    rows[i] = [a - step * b if b else a for a, b in zip(rows[i], rows[k], strict=True)]
        return products


@lru_cache(maxsize=500)
def sum_of_squares(poly: Poly, orthant: frozenset[int] = frozenset(), under: tuple[Poly, ...] = ()) -> Positive | None:
    """That the polynomial is nowhere negative where the variables of ``orthant`` and conditions (``under``) are not, by
    squares times 1 or one of these (Putinar 1993). None where none is found, or without clarabel."""
    ring, lowest = poly.ring, [min(powers) for powers in zip(*(e for e, _ in poly.terms()), strict=True)]
    shared = [e if i in orthant else e - e % 2 for i, e in enumerate(lowest)]
    monomial = tuple((ring.gen(i), e) for i, e in enumerate(shared) if e)
    rest = ring.from_terms({tuple(map(sub, e, shared)): c for e, c in poly.terms()}) if monomial else poly
    parts = [(c, (*monomial, *powers)) for c, powers in _products(rest, orthant, under)]
    return Positive(_identities(poly, parts), any(not powers for _, powers in parts)) if parts else None


def _identities(poly: Poly, parts: Sequence[tuple[Fraction, Powers]]) -> tuple[Identity, ...]:
    """poly = sum of c * product; by way of sums of a few of these where the common denominator is long."""
    if lcm(*(c.denominator for c, _ in parts)).bit_length() <= MOST_BITS:
        return (sum_of(poly, parts),)
    sums, rest = list[tuple[Fraction, Powers]](), list[Identity]()
    for few in (parts[k : k + FEW] for k in range(0, len(parts), FEW)):
        scale, total = lcm(*(c.denominator for c, _ in few)), 0 * poly
        for c, powers in few:
            total += prod((base**e for base, e in powers), start=poly.ring.constant(int(c * scale)))
        content, primitive = total.normal()
        sums.append((Fraction(content) / scale, ((primitive, 1),)))
        rest.append(sum_of(primitive, [(c * scale / content, powers) for c, powers in few]))
    return sum_of(poly, sums), *rest


def _products(poly: Poly, orthant: frozenset[int], conditions: tuple[Poly, ...] = ()) -> list[tuple[Fraction, Powers]]:
    """Positive numbers and products that are nowhere negative, with the polynomial as sum; none if none are found."""
    points = (point for where in (drawn, grid) for point in where(poly, orthant))
    if any(poly.evaluate(p) < 0 and all(c.evaluate(p) >= 0 for c in conditions) for p in points):
        return []
    classes = _classes(poly, orthant, conditions)
    width = sum(1 for squares in classes for _ in squares.places())
    rows, pivots = echelon(_equations(poly, classes)) if 0 < width <= MOST_ENTRIES else ([], [])
    if not rows or width in pivots:
        return []
    system = [{k: c for k, c in enumerate(row) if c} for row in rows]
    point = _inside(system, classes, width)
    for denominator in _DENOMINATORS if point is not None else ():
        assert point is not None
        chosen = [Fraction(round(z * denominator), denominator) for z in point]
        for pivot, row in zip(pivots, system, strict=True):  # in which no other pivot occurs
            others = sum((c * chosen[k] for k, c in row.items() if k not in (pivot, width)), Fraction(0))
            chosen[pivot] = row.get(width, Fraction(0)) - others
        entries = iter(chosen)
        parts = [squares.parts(entries) for squares in classes]
        if None not in parts:
            return [each for listed in parts for each in listed or ()]
    return []


def _classes(poly: Poly, orthant: frozenset[int], conditions: tuple[Poly, ...]) -> list[_Squares]:
    """The squares that may take part, by the parity of their monomials in y; none where they are too many."""
    ring, gathered = poly.ring, dict[tuple[Poly, ...], list[Exponents]]()
    given, most = (poly, *conditions), max(p.total_degree for p in (poly, *conditions))
    for factor in ((), *((c,) for c in conditions)):
        room = 2 * ((most + 1) // 2 - (sum(f.total_degree for f in factor) + 1) // 2)
        within = sum((ring.gen(i) ** room for i in {i for p in given for i in p.variables}), ring.constant(1))
        for half in _halves(within if conditions else poly, orthant):
            odd = tuple(ring.gen(i) for i in sorted(orthant) if half[i] % 2)
            base = tuple(e // 2 if i in orthant else e for i, e in enumerate(half))
            gathered.setdefault((*odd, *factor), []).append(base)
    zeros = [z for z in grid(poly, orthant) if not poly.evaluate(z) and all(c.evaluate(z) >= 0 for c in conditions)]
    classes = []
    for factors, exponents in gathered.items():
        seen = [z for z in zeros if all(f.evaluate(z) for f in factors)]
        basis = _vanishing([ring.from_terms({e: 1}) for e in exponents], seen)
        classes.append(_Squares(factors, tuple(basis)))
    return [squares for squares in classes if squares.basis]


def _halves(poly: Poly, orthant: frozenset[int]) -> list[Exponents]:
    """Exponents of monomials in y that squares may have, falling; none where they are too many.

    Twice an exponent lies in the Newton polytope, here between the bounds of a few directions; and it is an exponent of
    the polynomial, or a sum of two others of its class (else its diagonal entry, and so its row, is 0).
    """
    support = {tuple(e * (1 + (i in orthant)) for i, e in enumerate(exponents)) for exponents, _ in poly.terms()}
    tops = [max(column) for column in zip(*support, strict=True)]
    few = len(support) <= MOST_TERMS and len(poly.variables) <= MOST_VARIABLES
    if not few or any(top % 2 for top in tops) or prod(top // 2 + 1 for top in tops) > MOST_LOOKED_AT:
        return []
    low, high = (f(map(sum, support)) for f in (min, max))
    halves = [m for m in product(*(range(top // 2 + 1) for top in tops)) if low <= 2 * sum(m) <= high]
    while 0 < len(halves) <= MOST_MONOMIALS:
        alike = {m: tuple(m[i] % 2 for i in orthant) for m in halves}
        sums = {tuple(map(add, m, n)) for m, n in combinations(halves, 2) if alike[m] == alike[n]}
        kept = [m for m in halves if (twice := tuple(map(add, m, m))) in support or twice in sums]
        if len(kept) == len(halves):
            return sorted(halves, key=lambda m: (sum(m), m), reverse=True)
        halves = kept
    return []


def _vanishing(monomials: list[Poly], zeros: Sequence[Sequence[Fraction]]) -> list[Poly]:
    """Combinations of the monomials that vanish at these points."""
    rows = [[m.evaluate(z) for m in monomials] for z in zeros]
    solved = solve_linear(rows, [Fraction(0)] * len(rows), len(monomials)) if rows else None
    if solved is None:
        return monomials
    vanishing = []
    for vector in solved.kernel:
        scale = lcm(*(c.denominator for c in vector))
        vanishing.append(sum((m * int(c * scale) for m, c in zip(monomials, vector, strict=True)), 0 * monomials[0]))
    return vanishing


def _equations(poly: Poly, classes: Sequence[_Squares]) -> list[list[Fraction]]:
    """For each monomial what the entries of the matrices give to it, and its coefficient in the polynomial; none where
    they are too many."""
    width = sum(1 for squares in classes for _ in squares.places())
    rows = {e: [*[Fraction(0)] * width, Fraction(c)] for e, c in poly.terms()}
    places = ((squares, i, j) for squares in classes for i, j in squares.places())
    for column, (squares, i, j) in enumerate(places):
        for exponents, c in prod((*squares.factor, squares.basis[j]), start=squares.basis[i]).terms():
            row = rows.setdefault(exponents, [Fraction(0)] * (width + 1))
            row[column] += c if i == j else 2 * c
    return list(rows.values()) if len(rows) <= MOST_EQUATIONS else []


def _inside(system: Sequence[dict[int, Fraction]], classes: Sequence[_Squares], width: int) -> list[float] | None:
    """Entries of matrices whose least eigenvalue is as large as it can be (up to 1); None if they are not positive."""
    try:
        import clarabel
        import numpy as np
        from scipy import sparse
    except ImportError:
        return None
    entries = [(r, k, float(c)) for r, row in enumerate(system) for k, c in row.items() if k < width]
    right, count, column = [float(row.get(width, 0)) for row in system], len(system), 0
    cones = [clarabel.ZeroConeT(count)]
    for squares in classes:  # entries of each upper triangle by columns, as the cone wants them, minus the eigenvalue
        size = len(squares.basis)
        for j in range(size):
            for i in range(j + 1):
                k = column + i * size - i * (i - 1) // 2 + j - i
                entries.append((count, k, -1.0 if i == j else -(2.0**0.5)))
                if i == j:
                    entries.append((count, width, 1.0))
                count += 1
        column += size * (size + 1) // 2
        cones.append(clarabel.PSDTriangleConeT(size))
    entries.append((count, width, 1.0))
    right += [0.0] * (count - len(system)) + [1.0]
    lines, places, values = zip(*entries, strict=True)
    matrix = sparse.csc_matrix((values, (lines, places)), shape=(count + 1, width + 1))
    settings = clarabel.DefaultSettings()
    settings.verbose, settings.max_iter = False, STEPS
    cost, nothing = np.array([0.0] * width + [-1.0]), sparse.csc_matrix((width + 1, width + 1))
    cones.append(clarabel.NonnegativeConeT(1))
    solution = clarabel.DefaultSolver(nothing, cost, matrix, np.array(right), cones, settings).solve()
    point = [float(z) for z in solution.x]
    return point[:width] if all(abs(z) < LARGEST for z in point) and point[width] > -NOISE else None

"""Sums of squares of polynomials: a positive definite rational Gram matrix, found by a small semidefinite program.

p = b^T Q b with Q positive semidefinite, b polynomials, proves p >= 0; LDL^T of Q gives the squares. The matrices with
p = b^T Q b are an affine space over Q; a point of it that is well inside the cone (found in floating point) stays
inside when its coordinates are rounded, and the identity stays exact (after Peyrl, Parrilo 2008). A p with zeros has
none inside: the polynomials b are those combinations of monomials that vanish at the zeros that are found.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import product
from math import lcm

from qe.exact.quadratic_form import Solution, solve_linear
from qe.exact.ring import Poly
from qe.positivity.identity import Positive, sum_of
from qe.positivity.samples import grid

MOST_MONOMIALS, MOST_EQUATIONS, MOST_TERMS, MOST_VARIABLES = 24, 160, 80, 6
STEPS, LARGEST, NOISE = 60, 1e12, 1e-6  # of the solver; beyond these its point is not worth rounding
_DENOMINATORS = (1, 2, 12, 60, 2**10, 2**20, 2**32)

Matrix = list[list[Fraction]]


@lru_cache(maxsize=500)
def sum_of_squares(poly: Poly) -> Positive | None:
    """That the polynomial is nowhere negative; None where none is found, or without clarabel."""
    if poly.total_degree % 2 or poly.term_count() > MOST_TERMS:
        return None
    monomials = _monomials(poly)
    if monomials is None:
        return None
    basis = _vanishing(poly, monomials)
    space = _gram_matrices(poly, basis)
    if space is None:
        return None
    size = len(basis)
    point = _inside(space, size)
    for denominator in _DENOMINATORS if point is not None else ():
        assert point is not None
        chosen = [Fraction(round(z * denominator), denominator) for z in point]
        parts = _squares(_matrix(space, chosen, size), basis)
        if parts is not None:
            listed = [
                (d * base.constant_value() ** 2, ()) if base.is_constant else (d, ((base, 2),)) for d, base in parts
            ]
            return Positive((sum_of(poly, listed),), strict=any(not powers for _, powers in listed))
    return None


def _monomials(poly: Poly) -> list[tuple[int, ...]] | None:
    """Exponents of monomials that squares may have, falling; None where they are too many.

    Twice an exponent lies in the Newton polytope, here between the bounds of a few directions; and it is an exponent of
    the polynomial, or a sum of two others in another way (else its diagonal entry, and so its row, is 0).
    """
    exponents = [e for e, _ in poly.terms()]
    used = poly.variables
    tops = [max(e[i] for e in exponents) // 2 if i in used else 0 for i in range(poly.ring.size)]
    if any(max(e[i] for e in exponents) % 2 for i in used) or len(used) > MOST_VARIABLES:
        return None
    low, high = (f(sum(e) for e in exponents) for f in (min, max))
    found = [m for m in product(*(range(t + 1) for t in tops)) if low <= 2 * sum(m) <= high]
    if len(found) > 8 * MOST_MONOMIALS:
        return None
    support = set(exponents)
    while True:
        sums = {tuple(a + b for a, b in zip(m, n, strict=True)) for m in found for n in found if m != n}
        kept = [m for m in found if (twice := tuple(2 * e for e in m)) in support or twice in sums]
        if len(kept) == len(found):
            break
        found = kept
    return sorted(found, key=lambda m: (sum(m), m), reverse=True) if 0 < len(found) <= MOST_MONOMIALS else None


def _vanishing(poly: Poly, monomials: Sequence[tuple[int, ...]]) -> list[Poly]:
    """Combinations of the monomials that vanish at the zeros of the polynomial on a small grid."""
    ring = poly.ring
    plain = [ring.from_terms({m: 1}) for m in monomials]
    rows = [[m.evaluate(z) for m in plain] for z in grid(poly) if not poly.evaluate(z)]
    solved = solve_linear(rows, [Fraction(0)] * len(rows), len(plain)) if rows else None
    if solved is None:
        return plain
    found = []
    for vector in solved.kernel:
        scale = lcm(*(c.denominator for c in vector))
        found.append(sum((m * int(c * scale) for m, c in zip(plain, vector, strict=True)), ring.constant(0)))
    return found


def _gram_matrices(poly: Poly, basis: Sequence[Poly]) -> Solution | None:
    """All Q with p = b^T Q b, as vectors of entries i <= j; None where there is none."""
    places = [(i, j) for i in range(len(basis)) for j in range(i, len(basis))]
    rows: dict[tuple[int, ...], list[Fraction]] = {e: [Fraction(0)] * len(places) for e, _ in poly.terms()}
    for k, (i, j) in enumerate(places):
        for exponents, c in (basis[i] * basis[j]).terms():
            row = rows.setdefault(exponents, [Fraction(0)] * len(places))
            row[k] += c if i == j else 2 * c
    if not places or len(rows) > MOST_EQUATIONS:
        return None
    values = dict(poly.terms())
    return solve_linear(list(rows.values()), [Fraction(values.get(e, 0)) for e in rows], len(places))


def _matrix(space: Solution, point: Sequence[Fraction], size: int) -> Matrix:
    entries = list(space.particular)
    for z, direction in zip(point, space.kernel, strict=True):
        if z:
            entries = [e + z * d if d else e for e, d in zip(entries, direction, strict=True)]
    found = [[Fraction(0)] * size for _ in range(size)]
    places = ((i, j) for i in range(size) for j in range(i, size))
    for (i, j), entry in zip(places, entries, strict=True):
        found[i][j] = found[j][i] = entry
    return found


def _squares(matrix: Matrix, basis: Sequence[Poly]) -> list[tuple[Fraction, Poly]] | None:
    """d and q with b^T Q b = sum d * q^2 by LDL^T; None where Q is not positive semidefinite."""
    rows, found = [list(row) for row in matrix], []
    for k in range(len(basis)):
        pivot = rows[k][k]
        if pivot < 0 or (not pivot and any(rows[k][k:])):
            return None
        if not pivot:
            continue
        weights = [entry / pivot for entry in rows[k][k:]]
        scale = lcm(*(w.denominator for w in weights))
        base = sum((b * int(w * scale) for b, w in zip(basis[k:], weights, strict=True)), basis[0].ring.constant(0))
        found.append((pivot / scale**2, base))
        for i in range(k + 1, len(basis)):
            if factor := rows[i][k] / pivot:
                rows[i] = [a - factor * b if b else a for a, b in zip(rows[i], rows[k], strict=True)]
    return found


def _inside(space: Solution, size: int) -> list[float] | None:
    """Coordinates of a matrix whose least eigenvalue is as large as it can be (up to 1); None if it is not positive."""
    if not space.kernel:
        return []
    try:
        import clarabel
        import numpy as np
        from scipy import sparse
    except ImportError:
        return None
    places = [(i, j) for j in range(size) for i in range(j + 1)]  # upper triangle by columns, as the cone wants it
    number = {place: k for k, place in enumerate((i, j) for i in range(size) for j in range(i, size))}
    order = [number[place] for place in places]
    factors = np.array([1.0 if i == j else 2.0**0.5 for i, j in places])
    columns = np.array([[float(v[k]) for k in order] for v in space.kernel]).T * factors[:, None]
    identity = np.array([1.0 if i == j else 0.0 for i, j in places])
    start = np.array([float(space.particular[k]) for k in order]) * factors
    count = len(space.kernel)
    rows = np.vstack([np.hstack([-columns, identity[:, None]]), [[0.0] * count + [1.0]]])
    right = np.concatenate([start, [1.0]])
    cost = np.array([0.0] * count + [-1.0])
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_iter = STEPS
    cones = [clarabel.PSDTriangleConeT(size), clarabel.NonnegativeConeT(1)]
    nothing = sparse.csc_matrix((count + 1, count + 1))
    solution = clarabel.DefaultSolver(nothing, cost, sparse.csc_matrix(rows), right, cones, settings).solve()
    point = [float(z) for z in solution.x]
    return point[:count] if all(abs(z) < LARGEST for z in point) and point[count] > -NOISE else None

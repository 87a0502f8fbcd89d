"""Whether one quadric lies in another, by one multiplier (S-lemma).

THEOREM. Let f(v) and h(v) be of degree 2 at most in the variables v = (x, y), F and H their symmetric matrices with
f = (v, 1)F(v, 1) and h = (v, 1)H(v, 1), and F_ii < 0 < H_ii for the place i of x or of y, and det H < 0. Then
    ex v (h = 0 and f < 0)  iff  ex v (h <= 0 and f < 0)  iff  not ex r > 0 (r*F + H is positive semidefinite).
PROOF. H has a negative eigenvalue, so (v, t)H(v, t) < 0 somewhere, also with t /= 0: h < 0 at v/t. Let f >= 0 where
h = 0. Along the i-th direction through a point with h <= 0, h is a convex parabola, which is 0 on both sides of the
point (or at it), and f is concave: f >= 0 there. So f >= 0 where h <= 0, and by the S-lemma (Yakubovich 1971; Pólik,
Terlaky, A survey of the S-lemma, SIAM Review 49, 2007, theorem 2.2), whose condition is that h < 0 somewhere, there is
m >= 0 with f + m*h >= 0 for all v, that is, with F + m*H positive semidefinite; m > 0 by F_ii < 0, and r = 1/m. If
there is such an r, f >= -h/r >= 0 where h <= 0.
COROLLARY. Let moreover m = H_11*H_22 - H_12^2 > 0, and let det H have any sign. Then
    ex v (h <= 0 and f < 0)  iff  det H < 0 and not ex r > 0 (…), or det H = 0 and (w, m)F(w, m) < 0,
with m and the entries of w the cofactors of the last row of H; the same with h = 0.
PROOF. h is strictly convex, and its least value is det H/m, taken at w/m alone.

A symmetric matrix is positive semidefinite iff its principal minors are not negative (Horn, Johnson, Matrix Analysis,
theorem 7.2.5); those of rows that fall into two parts without common entries are products of others.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, exists
from qe.formula.normal import nnf
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import Leaf

PARAMETERS_FROM = 3
"""With fewer parameters decomposition is quick (measured with three: ellipses in a disc with their centre on an axis
take 0.3 s and not 0.65 s, and their answers are shorter by a tenth)."""

Matrix = Mapping[tuple[int, int], Poly]
"""Twice a symmetric matrix, by places."""


def quadric_in_quadric(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on a block of two variables and two conditions."""
    parts = conjuncts(body)
    if StepKind.QUADRICS not in context.enabled or len(variables) != 2 or len(parts) != 2 or body.ring is None:
        return None
    if len(body.free) < len(variables) + PARAMETERS_FROM:
        return None
    for outside, inside in (parts, parts[::-1]):
        if not isinstance(outside, Atom) or not isinstance(inside, Atom) or outside.relation not in _LESS:
            continue
        f = outside.poly * _LESS[outside.relation]
        for sign in _AT_MOST.get(inside.relation, ()):
            found = _theorem(f, inside.poly * sign, variables, context)
            if found is not None:
                along, known, condition = found
                turned = int(inside.relation is Relation.EQ and sign < 0)
                proof = {"along": along, "turned": turned, "below": int(known)}
                return Found(StepKind.QUADRICS, "", Leaf((), condition), proof)
    return None


_LESS = {Relation.LT: 1, Relation.GT: -1}
"""The sign of f where the condition is f < 0."""

_AT_MOST = {Relation.LE: (1,), Relation.GE: (-1,), Relation.EQ: (1, -1)}
"""Those of h where it is h <= 0 or h = 0."""


def _theorem(f: Poly, h: Poly, variables: tuple[str, ...], context: BlockContext) -> tuple[str, bool, Formula] | None:
    """The variable along which f is concave and h convex, whether h is known to be negative somewhere, and the
    condition for a common point; None if the signs are not known."""
    places = [f.ring.index[v] for v in variables]
    if any(_degree(p, places) > 2 or not all(p.degree(i) for i in places) for p in (f, h)):
        return None  # with one variable in one of them, substitution is quicker, and its answer shorter
    outer, inner = matrix_of(f, places), matrix_of(h, places)
    for i, along in enumerate(variables):
        if _is_positive(inner[i, i], context) and _is_positive(-outer[i, i], context):
            apart = nnf(with_multiplier(outer, inner, variables[0]), negate=True)
            if _is_positive(-determinant(inner, (0, 1, 2)), context):
                return along, True, apart
            if _is_positive(determinant(inner, (0, 1)), context):
                return along, False, either_sign(outer, inner, apart)
    return None


def either_sign(outer: Matrix, inner: Matrix, apart: Formula) -> Formula:
    """The condition of the corollary; ``apart``: that there is no multiplier."""
    whole, rows = determinant(inner, (0, 1, 2)), ((1, 2), (0, 2), (0, 1))
    lowest = [_minor(inner, (0, 1), columns) * (-1) ** k for k, columns in enumerate(rows)]
    value = sum((outer[i, j] * lowest[i] * lowest[j] for i in range(3) for j in range(3)), whole * 0)
    point = conj((atom(whole, Relation.EQ), atom(value, Relation.LT)))
    return disj((conj((atom(whole, Relation.LT), apart)), point))


def with_multiplier(outer: Matrix, inner: Matrix, name: str) -> Formula:
    """ex r > 0: r*F + H is positive semidefinite."""
    ring = outer[0, 0].ring
    r = ring.gen(ring.index[name])
    sums = {place: r * outer[place] + inner[place] for place in outer}
    minors = [determinant(sums, rows) for rows in _connected(sums)]
    return exists((name,), conj((atom(r, Relation.GT), *(atom(minor, Relation.GE) for minor in minors))))


def matrix_of(p: Poly, places: list[int]) -> Matrix:
    """Twice the matrix of a polynomial of degree 2 at most in the variables of these places."""
    zero = p.ring.constant(0)
    found = {(i, j): zero for i in range(3) for j in range(3)}
    for (i, j), entry in p.collected(places).items():
        powers = [0] * i + [1] * j
        row, column = (*powers, 2, 2)[:2]
        found[row, column] = found[column, row] = entry * 2 if row == column else entry
    return found


def determinant(matrix: Matrix, rows: tuple[int, ...]) -> Poly:
    """The principal minor of these rows, by the first of them."""
    return _minor(matrix, rows, rows)


def _minor(matrix: Matrix, rows: tuple[int, ...], columns: tuple[int, ...]) -> Poly:
    if not rows:
        return matrix[0, 0].ring.constant(1)
    terms = (
        matrix[rows[0], c] * _minor(matrix, rows[1:], columns[:k] + columns[k + 1 :]) * (-1) ** k
        for k, c in enumerate(columns)
    )
    return sum(terms, matrix[0, 0].ring.constant(0))


def _connected(matrix: Matrix) -> Iterator[tuple[int, ...]]:
    """Rows that do not fall into parts without common entries."""
    for size in (1, 2, 3):
        for rows in combinations(range(3), size):
            joined = sum(bool(matrix[i, j]) for i, j in combinations(rows, 2))
            if joined >= size - 1:
                yield rows


def _degree(p: Poly, places: list[int]) -> int:
    return max(map(sum, p.collected(places)), default=0)


def _is_positive(p: Poly, context: BlockContext) -> bool:
    return context.facts.signs(p) == {1}

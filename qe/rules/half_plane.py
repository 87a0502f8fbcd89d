"""Whether a polynomial has a root in a closed half-plane, where its real and imaginary part are given.

THEOREM. Let u(x, y) and v(x, y) be real and imaginary part of p(x + i*y), up to constant factors, where
p(z) = c_0 + c_1*z + … + c_n*z^n with c_k, m polynomials without x and y, and k /= 0 a number. Then
    ex x, y (u = 0 and v = 0 and k*x + m >= 0)  iff  not S_n,
where q(w) = k^n * p((w - m)/k) = a_0 + … + a_n*w^n, and S_d, for d from n down, says that a_0 + … + a_d*w^d has no root
w with Re w >= 0: S_d iff H(a) or H(-a) or (a_d = 0 and S_{d-1}); S_0 iff a_0 /= 0. H(a) says that a_d > 0, a_0 > 0,
a_1 > 0, a_3 > 0, … and the Hurwitz determinants D_{d-1}, D_{d-3}, … are positive; it is false where one of all these
determinants is the zero polynomial.
PROOF. x + i*y is a root of p iff w = k*(x + i*y) + m is one of q, and Re w = k*x + m. For a_d > 0, H(a) is the
criterion of Liénard and Chipart for all roots to have negative real parts (Gantmacher, The Theory of Matrices, volume
2, chapter XV, section 13), under which all of D_1, …, D_d are positive (Routh–Hurwitz, section 6).
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.errors import Unable
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import Leaf

MOST_ROOTS = 8
"""Up to this degree the determinants of polynomials with coefficients that are all parameters are small."""

MOST_TERMS = 2_000
"""With more terms in a determinant the answer is of no use."""


def root_in_half_plane(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on a block of two variables and three conjuncts with parameters."""
    parts = conjuncts(body)
    if StepKind.HALF_PLANE not in context.enabled or len(parts) != 3 or len(variables) != 2 or body.ring is None:
        return None
    if set(body.free) <= set(variables):
        return None
    equations = [part.poly for part in parts if isinstance(part, Atom) and part.relation is Relation.EQ]
    bounds = [part for part in parts if isinstance(part, Atom) and part.relation in (Relation.GE, Relation.LE)]
    if len(equations) != 2 or len(bounds) != 1:
        return None
    for x, y in (variables, variables[::-1]):
        real, imaginary = body.ring.index[x], body.ring.index[y]
        side, coefficients = _side(bounds[0], real, imaginary), complex_polynomial(equations, real, imaginary)
        if side is None or coefficients is None:
            continue
        try:
            none = without_roots(_moved(coefficients, *side))
        except Unable:
            return None
        proof = {"real": x, "imaginary": y}
        return Found(StepKind.HALF_PLANE, f"{x} + i*{y}", Leaf((), nnf(none, negate=True)), proof)
    return None


def _side(bound: Atom, real: int, imaginary: int) -> tuple[int, Poly] | None:
    """k and m where the bound is k*x + m >= 0 and m has neither x nor y."""
    poly = bound.poly if bound.relation is Relation.GE else -bound.poly
    if poly.degree(real) != 1 or poly.degree(imaginary):
        return None
    m, k = poly.coefficients(real)
    return (k.constant_value(), m) if k.is_constant else None


def complex_polynomial(equations: Sequence[Poly], real: int, imaginary: int) -> tuple[Poly, ...] | None:
    """The coefficients of p, c_0 first, where two polynomials are its real and imaginary part up to constants."""
    for u, v in (equations, equations[::-1]):
        found = u.coefficients(imaginary)[0].coefficients(real)
        if not 2 <= len(found) <= MOST_ROOTS + 1 or v.coefficients(imaginary)[0]:
            continue
        re, im = _parts(found, real, imaginary)
        if re == u and im.normal()[1] == v.normal()[1]:
            return found
    return None


def _parts(coefficients: Sequence[Poly], real: int, imaginary: int) -> tuple[Poly, Poly]:
    """Real and imaginary part at x + i*y (Horner)."""
    ring = coefficients[0].ring
    x, y = ring.gen(real), ring.gen(imaginary)
    re, im = ring.constant(0), ring.constant(0)
    for c in reversed(coefficients):
        re, im = re * x - im * y + c, re * y + im * x
    return re, im


def _moved(coefficients: Sequence[Poly], k: int, m: Poly) -> list[Poly]:
    """The coefficients of k^n * p((w - m)/k) in w (Horner). Raises ``Unable`` where they grow too large."""
    zero, scale = m.ring.constant(0), 1
    found: list[Poly] = []
    for c in reversed(coefficients):
        found = [a - m * b for a, b in zip([zero, *found], [*found, zero], strict=True)] if found else [zero]
        found[0] = found[0] + c * scale
        scale *= k
        if any(a.term_count() > MOST_TERMS for a in found):
            raise Unable("the bound is too long")
    return found


def without_roots(a: Sequence[Poly]) -> Formula:
    """S_d of the theorem. Raises ``Unable`` where determinants grow too large."""
    *lower, lead = a
    if not lower:
        return atom(lead, Relation.NE)
    cases = [hurwitz(a), hurwitz([-c for c in a])]
    vanishes = atom(lead, Relation.EQ)
    if vanishes != FALSE:
        cases.append(conj((vanishes, without_roots(lower))))
    return disj(cases)


def hurwitz(a: Sequence[Poly]) -> Formula:
    """H(a) of the theorem: the leading coefficient is positive and all roots have negative real parts."""
    first = conj(atom(c, Relation.GT) for c in (a[-1], a[0], *a[1::2]))
    if first == FALSE:
        return FALSE
    minors = determinants(a)
    if not all(minors):
        return FALSE
    return conj((first, *(atom(d, Relation.GT) for d in minors[::-2])))


def determinants(a: Sequence[Poly]) -> list[Poly]:
    """The Hurwitz determinants D_1, …, D_{d-1}, up to the first that is the zero polynomial.

    They are the pivots of Bareiss' elimination, whose divisions are exact.
    """
    size, zero, last = len(a) - 2, a[0].ring.constant(0), a[0].ring.constant(1)
    falling = a[::-1]  # Gantmacher's order: the entry in row i and column j (from 1) has the index 2*j - i
    span = range(1, size + 1)
    rows = [[falling[2 * j - i] if 0 <= 2 * j - i < len(a) else zero for j in span] for i in span]
    found: list[Poly] = []
    for k in range(size):
        pivot = rows[k][k]
        found.append(pivot)
        if not pivot:
            break
        for i in range(k + 1, size):
            for j in range(k + 1, size):
                rows[i][j] = (pivot * rows[i][j] - rows[i][k] * rows[k][j]).exact_divide(last)
                if rows[i][j].term_count() > MOST_TERMS:
                    raise Unable("the Hurwitz determinants are too large")
        last = pivot
    return found

"""Rule "roots in a half-plane": whether a polynomial has a root with k*Re + m >= 0, by Hurwitz determinants.

THEOREM. Let two polynomials be, up to constant factors, real and imaginary part of p(x + i*y), where p(z) is the sum of
c_j*z^j for j up to n, c_j and m have neither x nor y, and k /= 0 is a number. Let q(w) = k^n * p((w - m)/k). A point
where both vanish and k*x + m >= 0 is a root of p; k times it, plus m, is one of q with real part >= 0. A polynomial
a_0 + … + a_d*w^d with a_d > 0, d >= 1, has no such root iff a_0 > 0, a_1 > 0, a_3 > 0, … and D_{d-1} > 0, D_{d-3} > 0,
… (Liénard, Chipart 1914; Gantmacher, The Theory of Matrices, volume 2, chapter XV, section 13), where D_j is the
leading minor of size j of the matrix with a_{d + i - 2j} in row i and column j (from 1). Then all D_1, …, D_d are
positive (Routh–Hurwitz, section 6). With a_d < 0 the same is so of -q; with a_d = 0 the degree is lower; a nonzero
number has no roots, 0 has all.

Evidence: ``real`` x, ``imaginary`` y; ``theory`` where the condition is written in another way.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb

from qe.certify.block import existential
from qe.certify.boolean import ByLemmas, Goal, equivalence
from qe.certify.limits import check_power
from qe.certify.negation import negation
from qe.certify.step import Claim, Context, only, outside
from qe.errors import Unable
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, And, Atom, Exists, Formula, Relation

MOST_ROOTS, MOST_TERMS = 10, 100_000
"""The degree up to which determinants are expanded, and terms of two factors multiplied."""


def half_plane_goals(claim: Claim, context: Context) -> list[Goal]:
    """The equations are the parts of a polynomial, and what stands after denies that it has no root there."""
    real, imaginary, _ = only(claim, "real", "imaginary", "theory")
    before, after = existential(claim)
    if not isinstance(before, Exists) or not isinstance(before.body, And) or len(before.body.args) != 3:
        raise claim.fail("a block over three conditions expected")
    if real.text() == imaginary.text() or {real.text(), imaginary.text()} != set(before.variables):
        raise claim.fail("a block over real and imaginary part expected")
    x, y = (claim.ring.index[entry.text()] for entry in (real, imaginary))
    equations: list[Poly] = []
    bounds: list[Poly] = []
    for part in before.body.args:
        if not isinstance(part, Atom) or part.relation not in (Relation.EQ, Relation.GE, Relation.LE):
            raise claim.fail("two equations and a weak bound expected")
        listing = equations if part.relation is Relation.EQ else bounds
        listing.append(-part.poly if part.relation is Relation.LE else part.poly)
    if len(equations) != 2:
        raise claim.fail("two equations and a weak bound expected")
    q = _moved(_polynomial(equations, x, y, claim), bounds[0], (x, y), claim)
    return equivalence(negation(_stable(q)), after, outside(context, before.variables))


check_half_plane = ByLemmas(half_plane_goals)


def _polynomial(equations: Sequence[Poly], x: int, y: int, claim: Claim) -> list[Poly]:
    """The coefficients of p, from the value of its real part on the real axis."""
    ring = claim.ring
    for u, v in (equations, equations[::-1]):
        values = {powers[0]: c for powers, c in u.collected((x, y)).items() if not powers[1]}
        degree = max(values, default=0)
        if not 1 <= degree <= MOST_ROOTS:
            continue
        p = [values.get(j, ring.constant(0)) for j in range(degree + 1)]
        parts = [ring.constant(0), ring.constant(0)]
        for j, c in enumerate(p):
            for h in range(j + 1):  # i^h is 1, i, -1, -i
                term = c * ring.gen(x) ** (j - h) * ring.gen(y) ** h * comb(j, h)
                parts[h % 2] = parts[h % 2] + (-term if h % 4 > 1 else term)
        if _proportional(parts[0], u) and _proportional(parts[1], v):
            return p
    raise claim.fail("not the real and imaginary part of a polynomial")


def _proportional(p: Poly, q: Poly) -> bool:
    """Whether one is a nonzero number times the other."""
    if not p or not q:
        return False
    (powers, first), *_ = p.terms()
    second = dict(q.terms()).get(powers, 0)
    return bool(second) and p * second == q * first


def _moved(p: Sequence[Poly], bound: Poly, plane: tuple[int, int], claim: Claim) -> list[Poly]:
    """The coefficients of k^n * p((w - m)/k), where the bound is k*x + m."""
    ring, (x, y) = claim.ring, plane
    k = bound.derivative(x)
    m = bound - k * ring.gen(x)
    if not k.is_constant or not k or m.degree(x) or m.degree(y):
        raise claim.fail("a bound of the real part expected")
    degree = len(p) - 1
    check_power(m, degree)
    found = [ring.constant(0)] * (degree + 1)
    for j, c in enumerate(p):
        for h in range(j + 1):
            found[h] = found[h] + c * k ** (degree - j) * (-m) ** (j - h) * comb(j, h)
    return found


def _stable(a: Sequence[Poly]) -> Formula:
    """That the polynomial with these coefficients has no root with real part >= 0."""
    if len(a) == 1:
        return atom(a[0], Relation.NE)
    cases = [_positive(a), _positive([-c for c in a])]
    vanishes = atom(a[-1], Relation.EQ)
    if vanishes != FALSE:
        cases.append(conj((vanishes, _stable(a[:-1]))))
    return disj(cases)


def _positive(a: Sequence[Poly]) -> Formula:
    """The conditions with a positive leading coefficient."""
    degree = len(a) - 1
    conditions = [atom(a[j], Relation.GT) for j in (degree, 0, *range(1, degree + 1, 2))]
    if FALSE in conditions:
        return FALSE
    minors = {j: _minor(a, j) for j in range(degree - 1, 0, -1)}
    if not all(minors.values()):
        return FALSE
    return conj((*conditions, *(atom(minors[j], Relation.GT) for j in range(degree - 1, 0, -2))))


def _minor(a: Sequence[Poly], size: int) -> Poly:
    """A leading minor of the matrix of Hurwitz, expanded row by row; the minors of the last rows are kept."""
    zero, one = a[0].ring.constant(0), a[0].ring.constant(1)
    below: dict[tuple[int, ...], Poly] = {(): one}
    for i in range(size, 0, -1):
        chosen: dict[tuple[int, ...], Poly] = {}
        for columns, minor in below.items():
            for j in range(1, size + 1):
                index = len(a) - 1 + i - 2 * j
                if j in columns or not 0 <= index < len(a) or not a[index] or not minor:
                    continue
                if a[index].term_count() * minor.term_count() > MOST_TERMS:
                    raise Unable("a determinant of Hurwitz has too many terms")
                taken = tuple(sorted((*columns, j)))
                sign = -1 if taken.index(j) % 2 else 1
                chosen[taken] = chosen.get(taken, zero) + a[index] * minor * sign
        below = chosen
    return below.get(tuple(range(1, size + 1)), zero)

"""A test point put for a variable, recomputed from the theorem: no roots or infinitesimals appear in the result.

THEOREM. Let t be -b/a with a /= 0, or (-b + s*sqrt(D))/(2*a) with a /= 0, D = b^2 - 4*a*c >= 0 and s = 1 or -1; let f
have degree n in x. Then ``f relation 0`` at t is equivalent to the formula made here.
* -b/a: N = a^n*f(-b/a) is a polynomial, and f(t) has the sign of N for even n, of a*N for odd n.
* With a^k*f = u*x + v modulo a*x^2 + b*x + c: 2*a^(k+1)*f(t) = A + B*sqrt(D) for A = 2*a*v - b*u, B = s*u, and A^2 -
  B^2*D = 4*a*(a*v^2 - b*u*v + c*u^2). For even k both sides are multiplied by a, so that the sign is right.
* A + B*r with r = sqrt(D), and N of the sign of A^2 - B^2*D: it is 0 iff N = 0 and A*B <= 0; it is < 0 iff A < 0 and
  N > 0, or B <= 0 and (A < 0 or N < 0); it is <= 0 iff A <= 0 and N >= 0, or B <= 0 and N <= 0. (If N > 0, the sign
  is that of A; if N < 0, that of B; if N = 0, |A| = |B|*r, and the sum is 0 or 2*A.)
* Next to t (on the side e = 1 or -1) a polynomial that is not identically 0 is not 0: f = 0 iff all coefficients are
  0; f < 0 iff f(t) < 0, or f(t) = 0 and e*f' < 0 there. Near infinity the first coefficient decides that is not 0.
Loos & Weispfenning 1993; Weispfenning 1997.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import Atom, Atomic, Formula, Relation
from qe.formula.traverse import map_atoms
from qe.kernel.substitution import quotient

EQ, NE, LT, LE, GT, GE = Relation.EQ, Relation.NE, Relation.LT, Relation.LE, Relation.GT, Relation.GE


@dataclass(frozen=True, slots=True)
class TestPoint:
    """``coefficients`` from degree 0 up: one of its own (infinity: none), ``branch`` 1 or -1 for a quadratic.

    ``shift``: 0 for the root itself, 1 or -1 for a point right or left of it; for infinity its sign.
    """

    __test__ = False

    coefficients: tuple[Poly, ...]
    branch: int
    shift: int


def put(formula: Formula, x: int, point: TestPoint, settled: Collection[Formula] = ()) -> Formula:
    """The formula at the point; the atoms ``settled`` at the root that the point is next to."""

    def change(found: Atomic) -> Formula:
        if not isinstance(found, Atom) or not found.poly.degree(x):
            return found
        at_root = not point.shift or found in settled
        if not point.coefficients:
            return _far(found.poly, found.relation, x, point.shift)
        return (_at if at_root else _beside)(found.poly, found.relation, x, point)

    return map_atoms(formula, change)


def _far(f: Poly, relation: Relation, x: int, sign: int) -> Formula:
    """Near infinity: the leading coefficient decides, then the next one, down to the constant one."""
    coefficients = f.coefficients(x)
    if relation in (EQ, NE):
        return _identically(coefficients, relation)
    result = atom(coefficients[0], relation)
    for power, c in enumerate(coefficients[1:], start=1):
        seen = -c if sign < 0 and power % 2 else c
        result = disj((atom(seen, _strict(relation)), conj((atom(seen, EQ), result))))
    return result


def _identically(coefficients: tuple[Poly, ...], relation: Relation) -> Formula:
    join = conj if relation is EQ else disj
    return join(atom(c, relation) for c in coefficients)


def _strict(relation: Relation) -> Relation:
    return {LE: LT, GE: GT}.get(relation, relation)


def _beside(f: Poly, relation: Relation, x: int, point: TestPoint) -> Formula:
    """Next to the root: the first derivative that is not 0 there decides."""
    if relation in (EQ, NE):
        return _identically(f.coefficients(x), relation)
    if not f.degree(x):
        return atom(f, relation)
    further = _beside(f.derivative(x) * point.shift, relation, x, point)
    return disj((_at(f, _strict(relation), x, point), conj((_at(f, EQ, x, point), further))))


def _at(f: Poly, relation: Relation, x: int, point: TestPoint) -> Formula:
    """At the root itself."""
    if not f.degree(x):
        return atom(f, relation)
    if len(point.coefficients) == 2:
        b, a = point.coefficients
        value = quotient(f, x, -b, a)
        return atom(value * a if f.degree(x) % 2 and relation not in (EQ, NE) else value, relation)
    return _at_quadratic(list(f.coefficients(x)), relation, point)


def _at_quadratic(parts: list[Poly], relation: Relation, point: TestPoint) -> Formula:
    c, b, a = point.coefficients
    k = 0
    while len(parts) > 2:
        top = parts.pop()
        if top:
            k += 1
            parts = [a * p for p in parts]
            parts[-1] = parts[-1] - top * b
            parts[-2] = parts[-2] - top * c
    v, u = parts
    first, second = 2 * (a * v) - b * u, u * point.branch
    if k % 2 == 0:
        first, second = a * first, a * second
    return _signed(first, second, a * (a * (v * v) - b * (u * v) + c * (u * u)), relation)


def _signed(a: Poly, b: Poly, n: Poly, relation: Relation) -> Formula:
    """``a + b*r relation 0`` for r >= 0, where n has the sign of a^2 - b^2*r^2."""
    if not b:
        return atom(a, relation)
    if relation is EQ:
        return conj((atom(n, EQ), atom(a * b, LE)))
    if relation is NE:
        return disj((atom(n, NE), atom(a * b, GT)))
    if relation in (GT, GE):
        return _signed(-a, -b, n, relation.flipped)
    if relation is LE:
        return disj((conj((atom(a, LE), atom(n, GE))), conj((atom(b, LE), atom(n, LE)))))
    below = atom(a, LT)
    return disj((conj((below, atom(n, GT))), conj((atom(b, LE), disj((below, atom(n, LT)))))))

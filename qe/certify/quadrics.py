"""Rule "quadric in a quadric": conditions f < 0 and h <= 0 (or h = 0) on two variables, by one multiplier (S-lemma).

THEOREM. Let F and H be twice the symmetric matrices of f and h, of degree 2 at most in (x, y). Where F_ii < 0 < H_ii
for the place i of x or y, and det H < 0, the conditions have no common solution (x, y) iff r*F + H is positive
semidefinite for some r > 0. For: h is negative somewhere (H has a negative eigenvalue). If f >= 0 where h = 0, so it
is where h <= 0: there a line in the i-th direction, on which f is concave and h a convex parabola, passes between two
points with h = 0. Then f + m*h >= 0 everywhere for some m >= 0 (Yakubovich 1971; Pólik, Terlaky, SIAM Review 49,
2007, theorem 2.2); m /= 0 by F_ii < 0, and r = 1/m. The other way round f >= -h/r where r*F + H is positive
semidefinite.

Where H_11*H_22 - H_12^2 = m > 0 instead of det H < 0, h has its least value det H/m (up to a positive factor) at one
point only, which solves the linear equations grad h = 0. So h <= 0 (h = 0) and f < 0 have a common solution iff
det H < 0 and there is no such r, or det H = 0 and f < 0 at that point.

That a symmetric matrix is positive semidefinite means that no principal minor is negative (Horn, Johnson, Matrix
Analysis, theorem 7.2.5). With b = 0 in ((a, b), (b, c)) the minor a*c follows from the others; so does the large one
where a row has two zeros beside the diagonal.

Evidence: ``along``, the variable at the place i; ``turned``, 1 where h is minus the polynomial of an equation, 0 else;
``below``, 1 where det H < 0 is known (also in older certificates, which do not say it), 0 where m > 0 is; ``theory``,
by which the three signs are known.
"""

from __future__ import annotations

from qe.certify.block import existential
from qe.certify.boolean import ByLemmas, Goal, equivalence
from qe.certify.negation import negation
from qe.certify.step import Claim, Context, only, outside
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import And, Atom, Exists, Formula, Relation

Rows = tuple[tuple[Poly, Poly, Poly], ...]


def quadrics_goals(claim: Claim, context: Context) -> list[Goal]:
    """The signs are known, and what stands after denies that there is a multiplier."""
    along, turned, _, below = only(claim, "along", "turned", "theory", optional=("below",))
    before, after = existential(claim)
    if not isinstance(before, Exists) or not isinstance(before.body, And) or len(before.body.args) != 2:
        raise claim.fail("a block over two conditions expected")
    if len(before.variables) != 2 or along.text() not in before.variables:
        raise claim.fail("a block over two variables, one of them named, expected")
    strict = [part for part in before.body.args if isinstance(part, Atom) and part.relation in _STRICT]
    weak = [part for part in before.body.args if isinstance(part, Atom) and part.relation in _WEAK]
    if len(strict) != 1 or len(weak) != 1:
        raise claim.fail("a strict inequality and a weak one, or an equation, expected")
    sign = _WEAK[weak[0].relation]
    if (turning := turned.integer(0)) > 1 or (turning and sign):
        raise turned.fail("0, or 1 for an equation, expected")
    if (known := 1 if below.value is None else below.integer(0)) > 1:
        raise below.fail("0 or 1 expected")
    outer = _rows(strict[0].poly * _STRICT[strict[0].relation], before.variables, claim)
    inner = _rows(weak[0].poly * (sign or (-1 if turning else 1)), before.variables, claim)
    place = before.variables.index(along.text())
    inside = outside(context, before.variables)
    signs = (
        atom(outer[place][place], Relation.GE),
        atom(inner[place][place], Relation.LE),
        atom(_determinant(inner), Relation.GE) if known else atom(_upper_left(inner), Relation.LE),
    )
    meet = negation(_multiplier(outer, inner, before.variables[0], claim))
    if not known:
        meet = _either_sign(outer, inner, meet)
    return [*((*inside, wrong) for wrong in signs), *equivalence(meet, after, inside)]


check_quadrics = ByLemmas(quadrics_goals)

_STRICT = {Relation.LT: 1, Relation.GT: -1}
_WEAK = {Relation.LE: 1, Relation.GE: -1, Relation.EQ: 0}


def _rows(p: Poly, names: tuple[str, ...], claim: Claim) -> Rows:
    """Twice the matrix of a polynomial of degree 2 at most: its second derivatives, with its first ones at 0."""
    x, y = (claim.ring.index[name] for name in names)
    if any(sum(powers) > 2 for powers in p.collected((x, y))):
        raise claim.fail("degree 2 at most expected")
    first, second = p.derivative(x), p.derivative(y)
    mixed, left, right = first.derivative(y), _at_origin(first, x, y), _at_origin(second, x, y)
    return (
        (first.derivative(x), mixed, left),
        (mixed, second.derivative(y), right),
        (left, right, _at_origin(p, x, y) * 2),
    )


def _at_origin(p: Poly, x: int, y: int) -> Poly:
    return p.collected((x, y)).get((0, 0), p.ring.constant(0))


def _multiplier(outer: Rows, inner: Rows, name: str, claim: Claim) -> Formula:
    """That r*F + H is positive semidefinite for some r > 0, with this name for r."""
    r = claim.ring.gen(claim.ring.index[name])
    first, second, third = (
        tuple(r * p + q for p, q in zip(row, below, strict=True)) for row, below in zip(outer, inner, strict=True)
    )
    (a, b, c), (_, d, e), (_, _, f) = first, second, third
    minors = [a, d, f]
    minors += [p * q - s * s for p, q, s in ((a, d, b), (a, f, c), (d, f, e)) if s]
    if sum(bool(s) for s in (b, c, e)) > 1:
        minors.append(_determinant((first, second, third)))  # type: ignore[arg-type]
    return exists((name,), conj((atom(r, Relation.GT), *(atom(minor, Relation.GE) for minor in minors))))


def _upper_left(rows: Rows) -> Poly:
    (a, b, _), (_, d, _), _ = rows
    return a * d - b * b


def _either_sign(outer: Rows, inner: Rows, meet: Formula) -> Formula:
    """A common solution whatever the sign of det H; ``meet``: where it is negative."""
    (a, b, c), (_, d, e), _ = inner
    whole, lowest = _determinant(inner), (b * e - c * d, b * c - a * e, _upper_left(inner))  # by Cramer's rule
    at_lowest = [sum((p * q for p, q in zip(row[1:], lowest[1:], strict=True)), row[0] * lowest[0]) for row in outer]
    value = sum((p * q for p, q in zip(at_lowest[1:], lowest[1:], strict=True)), at_lowest[0] * lowest[0])
    point = conj((atom(whole, Relation.EQ), atom(value, Relation.LT)))
    return disj((conj((atom(whole, Relation.LT), meet)), point))


def _determinant(rows: Rows) -> Poly:
    """By the rule of Sarrus, for a symmetric matrix."""
    (a, b, c), (_, d, e), (_, _, f) = rows
    return a * d * f + b * c * e * 2 - c * c * d - b * b * f - a * e * e

"""Sign conditions at the roots of a cubic, without the roots: which value of three has which sign, as a table.

Let f = a*x^3 + b*x^2 + c*x + d, a /= 0, with discriminant D, and g = u*x^2 + v*x + w.

THEOREM 1. Let D < 0: f has one real root e, and two others z, z'. With the elementary symmetric E1, E2, E3 of g(e),
g(z), g(z'): E3 = g(e)*|g(z)|^2, so g(e) has the sign of E3 if this is not 0. If it is, then either g(z) /= 0 = g(e)
and E2 = |g(z)|^2 > 0, or g(z) = 0 = E2 and g(e) = E1. A linear g is 0 at z only if it is 0.

THEOREM 2. Let D >= 0, with the roots x1 <= x2 <= x3 of f, each as often as it is one (so this is one case, not four
real types). Let E1, E2, E3 be the elementary symmetric values of g(x1), g(x2), g(x3). These are real, so the numbers of
negative and of positive ones among them are those of the changes of sign in their polynomial (Descartes' rule), from
which ``_ranked`` says when the greatest, the middle or the least of them is negative. Which of them g(xk) is depends on
the slopes m_i = u*(x_j + x_k) + v, for {i, j, k} = {1, 2, 3}: g(x_j) - g(x_k) = (x_j - x_k)*m_i. They are the values of
a linear polynomial with the slope -u, so that, for u >= 0, m1 >= m2 >= m3. Hence, if u >= 0, then g(x3) is the greatest
value unless m2 < 0, and the least one if m1 < 0; and so on: the lines of ``TABLE``. The slopes are real, too, so the
same rule says when one of them is negative, from their symmetric values S1, S2, S3.
Each condition in a line implies that g(xk) is at most the value of that rank, and for one of the lines it is this
value; so g(xk) < 0 iff some line holds whose value is < 0, and so with <=.

Weispfenning 1994 and Kosta 2016 tell the real types of f apart and have formulas for each; here two cases suffice.
Tests prove the table by decomposition.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from enum import Enum

from qe.elimination.vs.points import SOME, CubicRoot
from qe.exact.ring import Poly
from qe.formula.build import conj, disj
from qe.formula.syntax import TRUE, Formula, Relation

EQ, NE, LT, LE, GT, GE = Relation.EQ, Relation.NE, Relation.LT, Relation.LE, Relation.GT, Relation.GE

MakeAtom = Callable[[Poly, Relation], Formula]
Lines = list[tuple["Rank", Formula]]
Three = tuple[Poly, Poly, Poly]
"""The elementary symmetric values of three numbers, times a^2."""


class Rank(Enum):
    """Which of three numbers, counted with multiplicity."""

    LEAST = 1
    MIDDLE = 2
    GREATEST = 3


LEAST, MIDDLE, GREATEST = Rank

TABLE: dict[int, tuple[tuple[Rank, tuple[tuple[Relation, Rank], ...]], ...]] = {
    1: ((MIDDLE, ((GT, MIDDLE), (GT, GREATEST))), (LEAST, ((GT, LEAST), (GT, MIDDLE)))),
    3: ((MIDDLE, ((LT, MIDDLE), (LT, LEAST))), (LEAST, ((LT, GREATEST), (LT, MIDDLE)))),
}
"""For the least and the greatest root: g there is at most its middle (least) value over the roots if the first
condition on the slopes holds, or u <= 0 and the second. It is always at most the greatest value."""


def at_cubic(f: Poly, x: int, relation: Relation, e: CubicRoot, sign: int | None, atom: MakeAtom) -> Formula:
    """``f relation 0`` at the root, where ``e`` is real; ``sign``: of the leading coefficient, if it is known."""
    _, c, b, a = e.coefficients
    g, odd = remainder(f, x, e.coefficients)
    if odd:
        g = [p * (a if sign is None else sign) for p in g]
    w, v, u = g
    if not (u or v):
        return atom(w, relation)
    if not e.index:
        return _at_only(e, u, v, w, relation, atom)
    if e.index == SOME:
        return _at_some(symmetric(e, u, v, w), relation, atom)
    if 2 * (b * u) == 3 * (a * v) and c * u == 3 * (a * w):
        return _at_critical(e, u, relation, atom)
    return Ranked(e, u, v, w, atom).compare(relation)


def remainder(f: Poly, x: int, divisor: Sequence[Poly]) -> tuple[list[Poly], bool]:
    """The coefficients of a^k * f modulo a polynomial with leading coefficient a, all from degree 0 on, and whether k
    is odd."""
    *below, a = divisor
    parts, odd = list(f.coefficients(x)), False
    while len(parts) > len(below):
        lead = parts.pop()
        if lead:
            parts = [a * p for p in parts]
            for k, c in enumerate(reversed(below), 1):
                parts[-k] = parts[-k] - lead * c
            odd = not odd
    return parts + [f.ring.constant(0)] * (len(below) - len(parts)), odd


def symmetric(e: CubicRoot, u: Poly, v: Poly, w: Poly) -> Three:
    """Those of the values of u*x^2 + v*x + w at the roots, by the elementary symmetric functions of these."""
    d, c, b, a = e.coefficients
    ab, squares, pairs = a * b, b * b - 2 * (a * c), 3 * (a * d) - b * c
    ends = c * c - 2 * (b * d)  # of the squares of two roots
    one = u * squares - v * ab + 3 * (w * a * a)
    two = (
        u * u * ends + u * v * pairs + 2 * (u * w * squares) + v * v * (a * c) - 2 * (v * w * ab) + 3 * (w * w * a * a)
    )
    three = (
        u * u * (u * d * d - v * (c * d) + w * ends)
        + u * v * (v * (b * d) + w * pairs)
        + w * w * (u * squares - v * ab + w * a * a)
        + v * v * (w * (a * c) - v * (a * d))
    )
    return one, two, three


def slopes(e: CubicRoot, u: Poly, v: Poly) -> Three:
    """Those of m_i = t - u*x_i, where a*t = a*v - b*u."""
    d, c, b, a = e.coefficients
    t = a * v - b * u
    one = a * (3 * (a * v) - 2 * (b * u))
    two = 3 * (t * t) + 2 * (t * u * b) + u * u * (a * c)
    return one, two, t * t * v + t * u * u * c + a * d * u * u * u


def _at_only(e: CubicRoot, u: Poly, v: Poly, w: Poly, relation: Relation, atom: MakeAtom) -> Formula:
    """Theorem 1."""
    one, two, three = symmetric(e, u, v, w)
    if not u:
        return atom(three, relation)
    zero, other = atom(three, EQ), atom(two, EQ)
    match relation:
        case Relation.EQ:
            return conj((zero, disj((atom(two, NE), atom(one, EQ)))))
        case Relation.NE:
            return disj((atom(three, NE), conj((other, atom(one, NE)))))
        case Relation.LT | Relation.GT:
            return disj((atom(three, relation), conj((zero, other, atom(one, relation)))))
    strict = LT if relation is LE else GT
    return disj((atom(three, strict), conj((zero, disj((atom(two, NE), atom(one, relation)))))))


def _at_some(values: Three, relation: Relation, atom: MakeAtom) -> Formula:
    """Theorem 2 for one of the roots, whichever: the least value or the greatest."""
    one, two, three = values
    if relation is EQ:
        return atom(three, EQ)
    if relation is NE:
        return disj((atom(one, NE), atom(two, NE)))
    if relation in (LT, LE):
        return _ranked(values, LEAST, relation, atom)
    return _ranked(_negative(values), LEAST, relation.flipped, atom)


def _at_critical(e: CubicRoot, u: Poly, relation: Relation, atom: MakeAtom) -> Formula:
    """The sign of u*f'/a: that of u at x1 and x3, of -u at x2, unless the root is double (u may be 0).

    For D = 0, the double root is x1 iff a*q <= 0, and x3 iff a*q >= 0, q = 2*b^3 - 9*a*b*c + 27*a^2*d (f at the
    inflection -b/(3*a), times 27*a^2).
    """
    d, c, b, a = e.coefficients
    q = a * (2 * (b * b * b) - 9 * (a * b * c) + 27 * (a * a * d))
    double = atom(e.discriminant, EQ)
    if e.index != 2:
        double = conj((double, atom(q, LE if e.index == 1 else GE)))
    simple = atom(e.discriminant, NE)
    if e.index != 2:
        simple = disj((simple, atom(q, GT if e.index == 1 else LT)))
    sign = -u if e.index == 2 else u
    if relation is EQ:
        return disj((double, atom(u, EQ)))
    if relation is NE:
        return conj((simple, atom(u, NE)))
    if relation.is_strict:
        return conj((simple, atom(sign, relation)))
    return disj((double, atom(sign, relation)))


class Ranked:
    """Theorem 2 for one g at one root."""

    __slots__ = ("atom", "index", "slopes", "u", "v", "values")

    def __init__(self, e: CubicRoot, u: Poly, v: Poly, w: Poly, atom: MakeAtom) -> None:
        self.index, self.u, self.v, self.atom = e.index, u, v, atom
        self.values, self.slopes = symmetric(e, u, v, w), slopes(e, u, v)

    def compare(self, relation: Relation) -> Formula:
        """``g relation 0`` at the root."""
        if relation is EQ:
            return conj((self.atom(self.values[2], EQ), self._below(LE), self._negated()._below(LE)))
        if relation is NE:
            return disj((self.atom(self.values[2], NE), self._below(LT), self._negated()._below(LT)))
        return self._below(relation) if relation in (LT, LE) else self._negated()._below(relation.flipped)

    def _negated(self) -> Ranked:
        """The same for -g."""
        made = object.__new__(Ranked)
        made.index, made.u, made.v, made.atom = self.index, -self.u, -self.v, self.atom
        made.values, made.slopes = _negative(self.values), _negative(self.slopes)
        return made

    def _below(self, relation: Relation) -> Formula:
        """The disjunction of the lines."""
        lines = self._linear() if not self.u else self._middle() if self.index == 2 else self._outer()
        return disj(conj((_ranked(self.values, rank, relation, self.atom), when)) for rank, when in lines)

    def _linear(self) -> Lines:
        """All slopes are v."""
        if self.index == 2:
            return [(MIDDLE, TRUE)]
        side = self.atom(self.v, GT if self.index == 1 else LT)
        return [(LEAST, TRUE)] if side == TRUE else [(GREATEST, TRUE), (LEAST, side)]

    def _outer(self) -> Lines:
        table = TABLE[self.index]
        return [(GREATEST, TRUE), *((rank, self._turned(*(self._slope(*s) for s in slopes))) for rank, slopes in table)]

    def _middle(self) -> Lines:
        """Between the others unless the slopes m1 and m3 differ in sign; then least for u > 0, greatest for u < 0."""
        apart = disj((self._slope(GT, LEAST), self._slope(LT, GREATEST)))
        both = conj((self._slope(LE, LEAST), self._slope(GE, GREATEST)))
        convex = self.atom(self.u, GE)
        return [(GREATEST, TRUE), (MIDDLE, disj((convex, apart))), (LEAST, conj((convex, both)))]

    def _turned(self, first: Formula, second: Formula) -> Formula:
        """The first condition, or u <= 0 and the second, which the first implies."""
        if self.u.is_constant:
            return second if self.u and self.u.constant_value() < 0 else first
        return disj((first, conj((self.atom(self.u, LE), second))))

    def _slope(self, relation: Relation, rank: Rank) -> Formula:
        """``slope relation 0`` for the slope of a rank."""
        if relation in (LT, LE):
            return _ranked(self.slopes, rank, relation, self.atom)
        return _ranked(_negative(self.slopes), Rank(4 - rank.value), relation.flipped, self.atom)


def _negative(values: Three) -> Three:
    return -values[0], values[1], -values[2]


def _ranked(values: Three, rank: Rank, relation: Relation, atom: MakeAtom) -> Formula:
    """Whether the number of a rank is < 0 or <= 0, from the symmetric values of three real numbers.

    All are negative iff their polynomial y^3 - E1*y^2 + E2*y - E3 has positive coefficients only, and two are iff these
    change their sign at most once.
    """
    one, two, three = values
    if relation is LT:
        match rank:
            case Rank.GREATEST:
                return conj((atom(one, LT), atom(two, GT), atom(three, LT)))
            case Rank.MIDDLE:
                return disj((conj((atom(one, LT), atom(two, GT))), conj((atom(three, GT), atom(two, LE)))))
        return disj((atom(one, LT), atom(two, LT), atom(three, LT)))
    match rank:
        case Rank.GREATEST:
            return conj((atom(one, LE), atom(two, GE), atom(three, LE)))
        case Rank.MIDDLE:
            return conj((disj((atom(one, LE), atom(two, LE))), disj((atom(three, GE), atom(two, GT)))))
    return disj((atom(one, LE), atom(two, LE), atom(three, LE)))

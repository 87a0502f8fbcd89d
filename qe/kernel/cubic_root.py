"""Sign conditions at the roots of a cubic f = a*x^3 + b*x^2 + c*x + d, a /= 0, recomputed from the theorem.

THEOREM. Let g = u*x^2 + v*x + w, and let E1, E2, E3 be the sum, the sum of the products of two, and the product of the
values of g at the three complex roots of f: trace, sum of the principal minors of order two, and determinant of the
multiplication by g modulo f. Let D be the discriminant of f.
* D < 0, e the real root, z a complex one: E3 = g(e)*|g(z)|^2. If E3 = 0, then g(z) = 0 iff E2 = 0 (for g(e) = 0, E2 is
  |g(z)|^2, and else g(z) = 0 and E2 = 0), and then g(e) = E1. If u = 0, then g(z) = 0 only for g = 0.
* D >= 0: f has the real roots x1 <= x2 <= x3. By Descartes' rule, exact for real roots, at least n of the values are
  negative iff: n = 3: E1 < 0, E2 > 0, E3 < 0; n = 2: E1 < 0 and E2 > 0, or E3 > 0 and E2 <= 0; n = 1: not all values
  are >= 0, which they are for E1, E2, E3 >= 0. Weakly: at least n are <= 0 iff fewer than 4 - n are positive.
* Let m1, m2, m3 be the slopes of g between x2 and x3, x1 and x3, x1 and x2, m_i = u*(-b/a - x_i) + v, with symmetric
  values of their own. If u >= 0, then m1 >= m2 >= m3; if u <= 0, the other way. If n slopes are negative, then
  - g(x3) < 0 needs one more negative value than there are slopes m1, m2 that are not negative, because
    g(x3) < g(x1) iff m2 < 0 (or x1 = x3), and g(x3) < g(x2) iff m1 < 0 (or x2 = x3);
  - these are: both if n = 3, or n = 2 and u <= 0; at least one if n >= 2, or n = 1 and u <= 0.
  For x1 positive slopes take the place of negative ones (turn the line round). For x2 with u >= 0: two negative
  values, or one and m3 <= 0 <= m1 (then g(x2) is the least); with u <= 0: two, and not m1 <= 0 <= m3 (then it is the
  greatest), or three.
* Where g is k*f' (k = u/(3*a) may be 0): f' has the sign of a at x1 and x3, of -a at x2, and is 0 iff D = 0 and the
  root is double: always at x2; at x1 iff a*q <= 0, at x3 iff a*q >= 0, with q = 27*a^2*f(-b/(3*a)).
* Some xk has g(xk) < 0 iff one value is negative; g(xk) = 0 iff E3 = 0; g(xk) /= 0 iff E1 or E2 is not 0.
Weispfenning 1994 (cubic roots by their real type); Kosta 2016.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation
from qe.kernel.limits import check_power

EQ, NE, LT, LE, GT, GE = Relation.EQ, Relation.NE, Relation.LT, Relation.LE, Relation.GT, Relation.GE

SOME = 4
"""In place of a number of a root: one of x1, x2, x3, whichever."""

Values = tuple[Poly, Poly, Poly]
Matrix = list[list[Poly]]


def discriminant(coefficients: Sequence[Poly]) -> Poly:
    """D, by 4*p^3 - q^2 = 27*a^2*D for p = b^2 - 3*a*c and the q of the theorem."""
    _, c, b, a = coefficients
    p, q = b * b - 3 * (a * c), _inflection(coefficients)
    return (4 * (p * p * p) - q * q).exact_divide(27 * (a * a))


def existence(coefficients: Sequence[Poly], index: int) -> Formula:
    """Where, beside a /= 0, the root with this number is real."""
    return atom(discriminant(coefficients), GE if index else LT)


def at_root(f: Poly, relation: Relation, x: int, coefficients: Sequence[Poly], index: int) -> Formula:
    """``f relation 0`` at the root with this number; 0: the only one, where D < 0."""
    w, v, u = _reduced(f, x, coefficients)
    if not u and not v:
        return atom(w, relation)
    if relation in (GT, GE):
        return _at_root(-u, -v, -w, relation.flipped, coefficients, index)
    return _at_root(u, v, w, relation, coefficients, index)


def _at_root(u: Poly, v: Poly, w: Poly, relation: Relation, coefficients: Sequence[Poly], index: int) -> Formula:
    """For =, /=, <, <= and g not constant."""
    values = _values(u, v, w, coefficients)
    if index == 0:
        return _at_only_root(values, relation, linear=not u)
    if index == SOME:
        return _at_some_root(values, relation)
    if _is_slope(u, v, w, coefficients):
        return _slope_at_root(u, relation, coefficients, index)
    if relation is EQ:
        up = _below(-u, -v, _negated(values), LE, coefficients, index)
        return conj((atom(values[2], EQ), _below(u, v, values, LE, coefficients, index), up))
    if relation is NE:
        up = _below(-u, -v, _negated(values), LT, coefficients, index)
        return disj((atom(values[2], NE), _below(u, v, values, LT, coefficients, index), up))
    return _below(u, v, values, relation, coefficients, index)


def _below(u: Poly, v: Poly, values: Values, relation: Relation, coefficients: Sequence[Poly], index: int) -> Formula:
    """Third and fourth part of the theorem: g < 0 or g <= 0 at x1, x2 or x3."""
    one, two, three = (_at_least(n, values, relation) for n in (1, 2, 3))
    if not u:
        if index == 2:
            return two
        falling = atom(v, LT if index == 3 else GT)
        return disj((three, conj((one, falling))))
    slopes = _slopes(u, v, coefficients)
    if index == 2:
        above, under = _at_least(3, _negated(slopes), LT), _at_least(3, slopes, LT)
        turn = conj((_at_least(1, slopes, LE), _at_least(1, _negated(slopes), LE)))
        return disj((three, conj((two, disj((atom(u, GE), above, under)))), conj((atom(u, GE), one, turn))))
    steep = slopes if index == 3 else _negated(slopes)
    n1, n2, n3 = (_at_least(n, steep, LT) for n in (1, 2, 3))
    return disj((three, conj((two, _either(u, n2, n1))), conj((one, _either(u, n3, n2)))))


def _either(u: Poly, rising: Formula, falling: Formula) -> Formula:
    """``rising``, or ``falling``, which it implies, where u <= 0."""
    if u.is_constant:
        return falling if u and u.constant_value() < 0 else rising
    return disj((rising, conj((atom(u, LE), falling))))


def _at_least(n: int, values: Values, relation: Relation) -> Formula:
    """At least n of three real numbers are < 0 (<= 0), from their symmetric values."""
    e1, e2, e3 = values
    if n == 1:
        return disj(atom(e, relation) for e in values)
    if n == 3:
        return conj((atom(e1, relation), atom(e2, GT if relation is LT else GE), atom(e3, relation)))
    if relation is LT:
        return disj((conj((atom(e1, LT), atom(e2, GT))), conj((atom(e3, GT), atom(e2, LE)))))
    return conj((disj((atom(e1, LE), atom(e2, LE))), disj((atom(e3, GE), atom(e2, GT)))))


def _negated(values: Values) -> Values:
    return -values[0], values[1], -values[2]


def _at_only_root(values: Values, relation: Relation, *, linear: bool) -> Formula:
    e1, e2, e3 = values
    if linear:
        return atom(e3, relation)
    complex_zero = conj((atom(e3, EQ), atom(e2, EQ)))
    if relation is NE:
        return disj((atom(e3, NE), conj((atom(e2, EQ), atom(e1, NE)))))
    if relation is LT:
        return disj((atom(e3, LT), conj((complex_zero, atom(e1, LT)))))
    vanishing = conj((atom(e3, EQ), disj((atom(e2, NE), atom(e1, relation)))))
    return vanishing if relation is EQ else disj((atom(e3, LT), vanishing))


def _at_some_root(values: Values, relation: Relation) -> Formula:
    if relation is EQ:
        return atom(values[2], EQ)
    if relation is NE:
        return disj((atom(values[0], NE), atom(values[1], NE)))
    return _at_least(1, values, relation)


def _is_slope(u: Poly, v: Poly, w: Poly, coefficients: Sequence[Poly]) -> bool:
    """Whether g is proportional to f'."""
    _, c, b, a = coefficients
    return 3 * (a * v) == 2 * (b * u) and 3 * (a * w) == c * u


def _slope_at_root(u: Poly, relation: Relation, coefficients: Sequence[Poly], index: int) -> Formula:
    """Fifth part: g = u*f'/(3*a)."""
    disc, q = discriminant(coefficients), coefficients[3] * _inflection(coefficients)
    sign = -u if index == 2 else u
    double = [atom(disc, EQ), *([atom(q, LE)] if index == 1 else [atom(q, GE)] if index == 3 else [])]
    simple = [atom(disc, NE), *([atom(q, GT)] if index == 1 else [atom(q, LT)] if index == 3 else [])]
    match relation:
        case Relation.EQ:
            return disj((conj(double), atom(u, EQ)))
        case Relation.NE:
            return conj((disj(simple), atom(u, NE)))
        case Relation.LT:
            return conj((disj(simple), atom(sign, LT)))
    return disj((conj(double), atom(sign, LE)))


def _inflection(coefficients: Sequence[Poly]) -> Poly:
    """q."""
    d, c, b, a = coefficients
    return 2 * (b * b * b) - 9 * (a * b * c) + 27 * (a * a * d)


# --- arithmetic modulo the cubic -----------------------------------------------------------------


def _reduced(f: Poly, x: int, coefficients: Sequence[Poly]) -> tuple[Poly, Poly, Poly]:
    """w, v, u of a polynomial that has the sign of f at the roots: of a^k*f modulo the cubic, k even."""
    parts, a = list(f.coefficients(x)), coefficients[3]
    check_power(a, len(parts))
    steps = 0
    while len(parts) > 3:
        top = parts.pop()
        if top:
            steps += 1
            start = len(parts) - 3
            parts = [a * p for p in parts]
            for k, lower in enumerate(coefficients[:3], start=start):
                parts[k] = parts[k] - top * lower
    if steps % 2:
        parts = [a * p for p in parts]
    w, v, u = (*parts, *(a.ring.constant(0) for _ in range(3 - len(parts))))
    return w, v, u


def _values(u: Poly, v: Poly, w: Poly, coefficients: Sequence[Poly]) -> Values:
    """a^2 times the symmetric values of g."""
    a = coefficients[3]
    by_x = _by_x(coefficients)
    square = _product(by_x, by_x)
    whole = [
        [u * square[i][j] + a * v * by_x[i][j] + (a * a * w if i == j else a.ring.constant(0)) for j in range(3)]
        for i in range(3)
    ]
    trace, minors, determinant = _symmetric(whole)
    return trace, minors.exact_divide(a**2), determinant.exact_divide(a**4)


def _slopes(u: Poly, v: Poly, coefficients: Sequence[Poly]) -> Values:
    """a^2 times the symmetric values of the slopes."""
    _, _, b, a = coefficients
    by_x = _by_x(coefficients)
    whole = [[(a * v - b * u if i == j else a.ring.constant(0)) - u * by_x[i][j] for j in range(3)] for i in range(3)]
    trace, minors, determinant = _symmetric(whole)
    return a * trace, minors, determinant.exact_divide(a)


def _by_x(coefficients: Sequence[Poly]) -> Matrix:
    """a times the matrix of the multiplication by x, in the basis 1, x, x^2."""
    d, c, b, a = coefficients
    zero = a.ring.constant(0)
    return [[zero, zero, -d], [a, zero, -c], [zero, a, -b]]


def _product(left: Matrix, right: Matrix) -> Matrix:
    zero = left[0][0].ring.constant(0)
    return [[sum((left[i][k] * right[k][j] for k in range(3)), zero) for j in range(3)] for i in range(3)]


def _symmetric(m: Matrix) -> Values:
    """Trace, sum of the principal minors of order two, determinant."""

    def minor(i: int, j: int, k: int, n: int) -> Poly:
        return m[i][k] * m[j][n] - m[i][n] * m[j][k]

    trace = m[0][0] + m[1][1] + m[2][2]
    minors = minor(0, 1, 0, 1) + minor(0, 2, 0, 2) + minor(1, 2, 1, 2)
    determinant = m[0][0] * minor(1, 2, 1, 2) - m[0][1] * minor(1, 2, 0, 2) + m[0][2] * minor(1, 2, 0, 1)
    return trace, minors, determinant


# --- one thing at a time ---------------------------------------------------------------------------


def asks_one(formula: Formula, x: int, coefficients: Sequence[Poly]) -> bool:
    """Whether "at some root" may be said of every atom by itself: no two members of a conjunction depend on the root.

    "Some" distributes over disjunctions, and over a conjunction with what does not depend on it.
    """
    match formula:
        case And(args):
            depending = sum(_depends(a, x, coefficients) for a in args)
            return depending <= 1 and all(asks_one(a, x, coefficients) for a in args)
        case Or(args):
            return all(asks_one(a, x, coefficients) for a in args)
    return isinstance(formula, Atom | Constant) or not formula.ring or formula.ring.names[x] not in formula.free


def _depends(formula: Formula, x: int, coefficients: Sequence[Poly]) -> bool:
    match formula:
        case And(args) | Or(args):
            return any(_depends(a, x, coefficients) for a in args)
        case Atom(poly, _) if poly.degree(x):
            _, v, u = _reduced(poly, x, coefficients)
            return bool(u or v)
    return False

"""Real root isolation of integer polynomials by Descartes' rule (Vincent–Collins–Akritas bisection).

Input is squarefree; output are disjoint intervals with dyadic ends, each with exactly one root, either
a point (lo = hi: the root itself) or an open interval whose ends are not roots.
"""

from __future__ import annotations

from flint import arb, fmpq, fmpz, fmpz_poly

from qe.errors import InternalError
from qe.exact.balls import ball_sign, precision
from qe.exact.univariate import sign_changes

Interval = tuple[fmpq, fmpq]

_SHIFT = fmpz_poly([1, 1])
_HALF = fmpq(1, 2)
LONG_DEGREE = 16
"""From this degree on, balls are tried before exact values, whose numerators have the degree times as many digits."""


def sign_at(p: fmpz_poly, value: fmpq) -> int:
    """The sign of p at a rational number: by balls where they exclude zero, exactly otherwise."""
    if p.degree() >= LONG_DEGREE:
        for bits in (128, 512):
            with precision(bits):
                sign = ball_sign(p(arb(value)))
            if sign:
                return sign
    result = p(value)
    return int(result > 0) - int(result < 0)


def _log2_root_bound(p: fmpz_poly) -> int:
    """k such that every real root has absolute value < 2^k (Fujiwara's bound, rounded up)."""
    coefficients = p.coeffs()
    n = len(coefficients) - 1
    lead = abs(int(coefficients[-1])).bit_length() - 1
    best = -(10**9)
    for i, c in enumerate(coefficients[:-1]):
        if c:
            best = max(best, -((lead - abs(int(c)).bit_length()) // (n - i)))
    return best + 2


def _scaled(p: fmpz_poly, k: int) -> fmpz_poly:
    """A positive multiple of p(2^k x)."""
    return fmpz_poly([c << k * i + max(0, -k * p.degree()) for i, c in enumerate(p.coeffs())])


def _positive_roots(p: fmpz_poly) -> list[Interval]:
    """Isolating intervals of the positive roots; p(0) != 0."""
    if sign_changes(p.coeffs()) == 0:
        return []
    k = _log2_root_bound(p)
    scale = fmpq(2) ** k
    roots: list[Interval] = []
    # entries: q whose roots in (0,1) are those of p in scale*(c/2^d, (c+1)/2^d)
    pending = [(_scaled(p, k), fmpz(0), 0)]
    while pending:
        q, c, depth = pending.pop()
        # sign variations of (x+1)^n q(1/(x+1)): an upper bound, exact at 0 and 1, for roots in (0, 1)
        bound = sign_changes(fmpz_poly(q.coeffs()[::-1])(_SHIFT).coeffs())
        width = scale / fmpz(2) ** depth
        if bound == 0:
            continue
        if bound == 1:
            roots.append((width * c, width * (c + 1)))
            continue
        left = _scaled(q, -1)
        right = left(_SHIFT)
        if right[0] == 0:
            middle = width * (2 * c + 1) * _HALF
            roots.append((middle, middle))
            right = fmpz_poly(right.coeffs()[1:])
            left = left / fmpz_poly([-1, 1])
        pending.append((right, 2 * c + 1, depth + 1))
        pending.append((left, 2 * c, depth + 1))
    return roots


def isolate(p: fmpz_poly) -> list[Interval]:
    """The real roots of a squarefree polynomial of positive degree, ascending.

    Open intervals have nonzero values of opposite sign at their ends. (An end can be a root found as a point,
    in which case it is pulled in.)
    """
    if p.degree() == 1:
        root = fmpq(-p[0], p[1])
        return [(root, root)]
    roots: list[Interval] = []
    rest = p
    if p[0] == 0:
        roots.append((fmpq(0), fmpq(0)))
        rest = fmpz_poly(p.coeffs()[1:])
    mirrored = fmpz_poly([-c if i % 2 else c for i, c in enumerate(rest.coeffs())])
    roots += [(-hi, -lo) for lo, hi in _positive_roots(mirrored)]
    roots += _positive_roots(rest)
    roots.sort(key=lambda pair: pair[0] + pair[1])
    points = {lo for lo, hi in roots if lo == hi}
    if not points:
        return roots
    for point in points - {0}:
        rest = rest / fmpz_poly([-point.p, point.q])
    return [_open_ends(rest, points, pair) for pair in roots]


def _open_ends(rest: fmpz_poly, points: set[fmpq], pair: Interval) -> Interval:
    """Shrink an open interval until neither end is one of ``points``, the roots found as points.

    ``rest`` is the polynomial without these roots: it has opposite signs at the ends even where both are roots.
    """
    lo, hi = pair
    if lo == hi:
        return pair
    below = sign_at(rest, lo)
    while lo in points or hi in points:
        middle = (lo + hi) * _HALF
        sign = sign_at(rest, middle)
        if sign == 0:
            return middle, middle
        if sign == below:
            lo = middle
        else:
            hi = middle
    return lo, hi


def simplest_between(lo: fmpq, hi: fmpq) -> fmpq:
    """The rational of smallest denominator, then smallest magnitude, in the open interval (lo, hi)."""
    if lo >= hi:
        raise InternalError(f"no rational number lies between {lo} and {hi}")
    if lo < 0 < hi:
        return fmpq(0)
    if hi <= 0:
        return -_simplest_positive(-hi, -lo)
    return _simplest_positive(lo, hi)


def _simplest_positive(lo: fmpq, hi: fmpq) -> fmpq:
    """The simplest rational in (lo, hi), 0 <= lo < hi, along the continued fraction both ends share."""
    a, b, c, d = int(lo.p), int(lo.q), int(hi.p), int(hi.q)
    # the convergent (p1/q1 after p0/q0) accumulates the common partial quotients
    p0, q0, p1, q1 = 0, 1, 1, 0
    while True:
        whole = a // b
        if (whole + 1) * d < c:
            step = whole + 1
            break
        p0, q0, p1, q1 = p1, q1, p1 * whole + p0, q1 * whole + q0
        a, b, c, d = d, c - whole * d, b, a - whole * b  # reciprocals of the remainders, ends exchanged
        if d == 0:  # the upper end is infinite: the smallest integer above a/b
            step = a // b + 1
            break
    return fmpq(p1 * step + p0, q1 * step + q0)

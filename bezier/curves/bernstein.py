"""Univariate polynomials on [0, 1] in Bernstein form, exactly, over any ordered field.

A polynomial of degree at most n is the tuple (b_0, ..., b_n) with p(t) = sum_k C(n,k) t^k (1-t)^(n-k) b_k.
Facts used (Farouki, "The Bernstein polynomial basis: a centennial retrospective", CAGD 2012, sections 3-5):
p(0) = b_0, p(1) = b_n; the range of p on [0, 1] lies between min b_k and max b_k; the number of sign changes
of (b_k) bounds the number of roots in (0, 1) and differs from it by an even number.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from math import comb, lcm
from typing import Any

from bezier.curves.scalar import is_zero, sign

Coefficients = tuple[Any, ...]
HALF = Fraction(1, 2)


def _whole(values: Sequence[Any]) -> tuple[list[Any], int]:
    """Integers and what to divide them by, for rational numbers; other numbers as they are, by 1.

    A fraction finds a greatest common divisor at every operation, integers only once at the end.
    """
    if not all(isinstance(c, (int, Fraction)) for c in values):
        return list(values), 1
    below = lcm(*(c.denominator for c in values))
    return [c.numerator * (below // c.denominator) for c in values], below


def _over(number: Any, below: int) -> Any:
    if isinstance(number, int):
        return Fraction(number, below)
    return number if below == 1 else number * Fraction(1, below)


def _rows(b: Sequence[Any], t: Any) -> Iterator[tuple[list[Any], int]]:
    """The rows of de Casteljau's algorithm, each with what to divide it by."""
    row, below = _whole(b)
    is_whole = isinstance(row[0], int) and isinstance(t, (int, Fraction))
    up, all_of = t.as_integer_ratio() if is_whole else (t, 1)
    rest = all_of - up
    yield row, below
    while len(row) > 1:
        pairs = pairwise(row)
        row = [rest * x + up * y for x, y in pairs] if is_whole else [x + t * (y - x) for x, y in pairs]
        below *= all_of
        yield row, below


def value(b: Sequence[Any], t: Any) -> Any:
    """p(t) by de Casteljau's algorithm."""
    *_, ((last,), below) = _rows(b, t)
    return _over(last, below)


def split(b: Sequence[Any], t: Any = HALF) -> tuple[Coefficients, Coefficients]:
    """The Bernstein coefficients on [0, t] and on [t, 1], each mapped to [0, 1]."""
    ends = [(_over(row[0], below), _over(row[-1], below)) for row, below in _rows(b, t)]
    return tuple(first for first, _ in ends), tuple(last for _, last in reversed(ends))


def elevate(b: Sequence[Any], degree: int) -> Coefficients:
    """The same polynomial with ``degree`` + 1 coefficients (degree elevation)."""
    return multiply(b, (1,) * (degree + 2 - len(b))) if len(b) <= degree else tuple(b)  # 1 in Bernstein form


def add(a: Sequence[Any], b: Sequence[Any]) -> Coefficients:
    """The sum, after raising the lower degree."""
    degree = max(len(a), len(b)) - 1
    return tuple(x + y for x, y in zip(elevate(a, degree), elevate(b, degree), strict=True))


def negate(b: Sequence[Any]) -> Coefficients:
    """The negative polynomial."""
    return tuple(-x for x in b)


def multiply(a: Sequence[Any], b: Sequence[Any]) -> Coefficients:
    """The product: c_k = sum_{i+j=k} C(m,i) C(n,j) / C(m+n,k) a_i b_j (Farouki 2012, section 4)."""
    m, n = len(a) - 1, len(b) - 1
    (one, below), (other, under) = _whole(a), _whole(b)
    sums = convolved([comb(m, i) * x for i, x in enumerate(one)], [comb(n, j) * y for j, y in enumerate(other)])
    return tuple(_over(s, comb(m + n, k) * below * under) for k, s in enumerate(sums))


def convolved(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    """The sums of a_i b_j with i + j = k, for all k."""
    if len(a) == 1 and a[0] == 1:
        return list(b)
    if len(b) == 1 and b[0] == 1:
        return list(a)
    out: list[Any] = [0] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            out[i + j] += x * y
    return out


def to_power(b: Sequence[Any]) -> Coefficients:
    """Coefficients of 1, t, t^2, ..., without leading zeros (() for the zero polynomial)."""
    n, (numbers, below) = len(b) - 1, _whole(b)
    sums = (sum((-1) ** (k - i) * comb(k, i) * numbers[i] for i in range(k + 1)) for k in range(n + 1))
    return trim([_over(comb(n, k) * total, below) for k, total in enumerate(sums)])


def from_power(p: Sequence[Any]) -> Coefficients:
    """The Bernstein coefficients of a polynomial given by its coefficients of 1, t, t^2, ..."""
    n, (numbers, below) = max(len(p) - 1, 0), _whole(p or (0,))
    shared = lcm(*(comb(n, i) for i in range(n + 1)))
    shares = [shared // comb(n, i) * number for i, number in enumerate(numbers)]
    return tuple(_over(sum(comb(k, i) * shares[i] for i in range(k + 1)), below * shared) for k in range(n + 1))


def restrict(b: Sequence[Any], low: Fraction, high: Fraction) -> Coefficients:
    """The Bernstein coefficients on [low, high], 0 <= low < high <= 1, mapped to [0, 1]."""
    right = split(b, low)[1] if low else tuple(b)
    return right if high == 1 else split(right, (high - low) / (1 - low))[0]


def sign_changes(b: Sequence[Any]) -> int:
    """Sign changes of the coefficients, zeros left out: at least the number of roots in (0, 1)."""
    signs = [s for s in map(sign, b) if s]
    return sum(x != y for x, y in pairwise(signs))


# --- polynomials by their coefficients of 1, t, t^2, ... -----------------------------------------


def trim(p: Sequence[Any]) -> Coefficients:
    """Without leading zero coefficients."""
    end = len(p)
    while end and is_zero(p[end - 1]):
        end -= 1
    return tuple(p[:end])


def power_multiply(a: Sequence[Any], b: Sequence[Any]) -> Coefficients:
    """The product of two polynomials in power form."""
    if not a or not b:
        return ()
    (one, below), (other, under) = _whole(a), _whole(b)
    return tuple(_over(s, below * under) for s in convolved(one, other))


def divide(a: Sequence[Any], b: Sequence[Any]) -> tuple[Coefficients, Coefficients]:
    """Quotient and remainder of power forms over a field; ``b`` is not zero."""
    rest, lead = list(trim(a)), b[-1]
    quotient: list[Any] = [Fraction(0)] * max(len(rest) - len(b) + 1, 0)
    while len(rest) >= len(b):
        shift, factor = len(rest) - len(b), rest[-1] / lead
        quotient[shift] = factor
        for i, y in enumerate(b[:-1]):
            rest[shift + i] = rest[shift + i] - factor * y
        rest = list(trim(rest[:-1]))
    return trim(quotient), tuple(rest)


def gcd(a: Sequence[Any], b: Sequence[Any]) -> Coefficients:
    """The monic greatest common divisor of power forms, by Euclid with monic remainders, which keeps them short."""
    x, y = trim(a), _monic(trim(b))
    while y:
        x, y = y, _monic(divide(x, y)[1])
    return _monic(x)


def _monic(p: Coefficients) -> Coefficients:
    if not p:
        return p
    scale = 1 / p[-1]  # once: inverses are what is slow in a number field
    return tuple(c * scale for c in p)


def power_derivative(p: Sequence[Any]) -> Coefficients:
    """The derivative of a power form."""
    return tuple(k * c for k, c in enumerate(p))[1:]


Numbers = tuple[Any, ...]


def halves(b: Numbers) -> tuple[Numbers, Numbers]:
    """Positive multiples of the Bernstein coefficients on [0, 1/2] and [1/2, 1]: by 2^degree for integers, which stay
    integers, so that polynomials of one degree keep their quotients, and by 1 for other numbers."""
    if not all(isinstance(c, int) for c in b):
        return split(b)
    n = len(b) - 1
    row, left, right = list(b), [b[0] << n], [b[-1] << n]
    for k in range(1, n + 1):
        row = [x + y for x, y in pairwise(row)]
        left.append(row[0] << (n - k))
        right.append(row[-1] << (n - k))
    return tuple(left), tuple(reversed(right))

"""Cells of a cylindrical description as MathML: bounds as radicals where the degree is at most two."""

from __future__ import annotations

from math import gcd, isqrt

from bezier.report import mathml
from qe.cells.pieces import Piece, Range, RootFunction
from qe.exact.ring import Poly
from qe.io.mathml import bracketed


def cell(piece: Piece) -> list[str]:
    """One ``<math>`` element per variable."""
    return [mathml.math(bounds(r)) for r in piece.ranges]


def bounds(item: Range) -> str:
    """``lower <= x < upper``, or ``x = value``."""
    middle = mathml.name(item.variable)
    if item.is_point and item.lower is not None:
        return f"<mrow>{middle}<mo>=</mo>{root_function(item.lower)}</mrow>"
    left = "" if item.lower is None else f"{root_function(item.lower)}<mo>{_relation(item.lower_closed)}</mo>"
    right = "" if item.upper is None else f"<mo>{_relation(item.upper_closed)}</mo>{root_function(item.upper)}"
    free = "" if left or right else "<mo>∈</mo><mi>ℝ</mi>"
    return f"<mrow>{left}{middle}{right}{free}</mrow>"


def _relation(closed: bool) -> str:
    return "≤" if closed else "&lt;"


def root_function(root: RootFunction) -> str:
    """A root of a polynomial in its main variable over the earlier variables."""
    if root.value is not None:
        return mathml.number(root.value)
    poly = root.poly
    c = poly.coefficients(poly.level)
    if len(c) == 2:
        return _fraction(mathml.polynomial(-c[0]), c[1])
    if len(c) == 3 and c[2].is_constant:
        return _quadratic(c[0], c[1], c[2].constant_value(), root.k)
    inside = f"{mathml.polynomial(poly)}<mo>,</mo>{mathml.name(poly.ring.names[poly.level])}"
    return f"<mrow><msub><mi>root</mi><mn>{root.k}</mn></msub>{bracketed(inside)}</mrow>"


def _quadratic(c: Poly, b: Poly, a: int, k: int) -> str:
    """The k-th root of a x^2 + b x + c, a > 0: (-b -+ s sqrt(d)) / 2a, the square s^2 taken out, in lowest terms."""
    inside = b * b - 4 * a * c
    s = _square_part(abs(inside.normal()[0])) or 1
    common = gcd(2 * a, gcd(s, abs(b.normal()[0])) if b else s)
    inside, front = inside.exact_divide(s * s), (-b).exact_divide(common)
    factor, below = s // common, 2 * a // common
    radical = f"<msqrt>{mathml.polynomial(inside)}</msqrt>"
    radical = radical if factor == 1 else f"<mrow><mn>{factor}</mn>{radical}</mrow>"
    start = mathml.polynomial(front) if front else ""
    sign = "<mo>−</mo>" if k == 1 else "<mo>+</mo>" if start else ""
    top = f"<mrow>{start}{sign}{radical}</mrow>"
    return top if below == 1 else f"<mfrac>{top}<mn>{below}</mn></mfrac>"


def _square_part(n: int) -> int:
    """The largest s with s^2 dividing n, for factors found by trial division up to a bound."""
    s, p = 1, 2
    while p * p <= n and p < 1000:
        while n % (p * p) == 0:
            n //= p * p
            s *= p
        n = n // p if n % p == 0 else n
        p += 1
    root = isqrt(n)
    return s * root if root > 1 and root * root == n else s


def _fraction(top: str, bottom: Poly) -> str:
    if bottom.is_constant and bottom.constant_value() == 1:
        return top
    return f"<mfrac>{top}{mathml.polynomial(bottom)}</mfrac>"

"""Length, area and volume in closed form, as SymPy numbers, where there is one that is known here.

A bounded piece is integrated from its last variable to its first. The ends may be polynomials, quotients with a
denominator in the first variable, and ``(p + sqrt(q))/d`` with q of degree at most 2; a slice of space between the two
sheets of an ellipsoid has the area ``pi D/(8 (-A)^(3/2))``, where their discriminant is A y^2 + B y + C with A < 0 and
D = B^2 - 4AC. With r = sqrt(q), integrals of P r come from an ansatz: P q = Q' q + Q q'/2 + c, so that
``∫ P r = Q r + c ∫ 1/r``, and ``∫ 1/r`` is an arc sine or a logarithm (Bronstein, Symbolic Integration I).
The sum is compared with the enclosure that ``Region.volume`` proves.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import sympy

from qe.decomposition.pieces import Piece, Range, RootFunction
from qe.errors import Unable
from qe.exact.ring import Poly
from qe.io.sympy_reader import number_to_sympy
from qe.regions.region import Region

CHECKED = Fraction(1, 50)
"""The relative error of the enclosure in which the sum has to lie."""
ROUNDING = Fraction(1, 10**20)
SHORT = 400
"""Operations in a sum up to which SymPy is asked for a shorter form."""

Expression = Any
Parts = Mapping[Expression, Expression]
"""A sum of c sqrt(q), by q, with rational functions c of the first variable; q = 1 stands for the rational part."""
_ONE = sympy.S.One


def measure(region: Region) -> Expression:
    """The measure of a region in one to three variables. Raises ``Unable`` where no closed form is found."""
    if len(region.order) > 3:
        raise Unable("closed forms of volumes are known in up to three variables; volume encloses those of others")
    whole = [p for p in region.cells if p.dimension == len(region.order)]
    if any(r.lower is None or r.upper is None for p in whole for r in p.ranges):
        raise Unable("the region is unbounded")
    low, high = region.volume(float(CHECKED))
    total = sum((_measured(piece) for piece in whole), sympy.S.Zero)
    value = sympy.N(total, 30)
    if not value.is_real or not low * (1 - ROUNDING) <= Fraction(str(value)) <= high * (1 + ROUNDING):
        raise Unable("no closed form was found")
    return sympy.simplify(total) if total.count_ops() < SHORT else total


def _measured(piece: Piece) -> Expression:
    ring = piece.table.factors[0][0].ring
    x, *others = symbols = [sympy.Symbol(f"x{k}", real=True) for k in range(ring.size)]
    ends = [_end(end, symbols)[0] for end in _both(piece.ranges[0])]
    if len(piece.ranges) == 1:
        return ends[1] - ends[0]
    inner = others[0]
    if len(piece.ranges) == 3:
        if (area := _ellipse(piece, symbols)) is not None:
            return _integral(area, _ONE, x, ends)
        low, high = (_polynomial(end, symbols) for end in _both(piece.ranges[2]))
        inner = sympy.integrate(sympy.Poly(high - low, inner).as_expr(), inner)
    width = _between(inner, others[0], *(_end(end, symbols) for end in _both(piece.ranges[1])))
    return sum((_integral(c, q, x, ends) for q, c in width.items()), sympy.S.Zero)


def _both(r: Range) -> tuple[RootFunction, RootFunction]:
    """Both ends of a bounded range."""
    assert r.lower is not None and r.upper is not None
    return r.lower, r.upper


def _ellipse(piece: Piece, symbols: list[Expression]) -> Expression | None:
    """The area over a value of the first variable between the two sheets of an ellipsoid; None of any other slice."""
    (y0, y1), (z0, z1) = (_both(r) for r in piece.ranges[1:])
    if z0.poly == z1.poly and z0.poly.degree(2) == 2 and y0.poly == y1.poly and y0.poly != z0.poly:
        c = z0.poly.coefficients(2)
        discriminant = c[1] * c[1] - 4 * (c[2] * c[0])
        if discriminant.normal()[1] == y0.poly and y0.poly.degree(1) == 2 and c[2].is_constant:
            k, j, i = (_expression(part, symbols) for part in discriminant.coefficients(1))
            if i.is_number and i.is_negative:
                lead = abs(_expression(c[2], symbols))
                return sympy.expand(sympy.pi * (j**2 - 4 * i * k) / (8 * sympy.sqrt(-i) ** 3) / lead)
    return None


def _polynomial(root: RootFunction, symbols: list[Expression]) -> Expression:
    """An end of the third variable that is a polynomial in the others."""
    term, root_part, _ = _end(root, symbols)
    if root_part != 0 or not term.is_polynomial(*symbols):
        raise Unable("no closed form was found: a curved surface that is no ellipsoid")
    return term


def _end(root: RootFunction, symbols: list[Expression]) -> tuple[Expression, Expression, Expression]:
    """Rational functions a and b of the first variable, and q, with a + b sqrt(q) for an end."""
    if root.value is not None:
        return number_to_sympy(root.value), sympy.S.Zero, _ONE
    c = [_expression(part, symbols) for part in root.poly.coefficients(root.poly.level)]
    if len(c) == 2:
        return sympy.together(-c[0] / c[1]), sympy.S.Zero, _ONE
    if len(c) == 3 and c[2].is_number:
        sign = -1 if (root.k == 1) == c[2].is_positive else 1
        inside = _without_squares(sympy.expand(c[1] ** 2 - 4 * c[2] * c[0]), symbols[0])
        return -c[1] / (2 * c[2]), sign / (2 * c[2]), inside
    raise Unable("no closed form was found: an end of degree above 2")


def _without_squares(q: Expression, x: Expression) -> Expression:
    """The radicand, if it has the first variable only and no square factor, whose root would change its sign."""
    if q.free_symbols - {x}:
        raise Unable("no closed form was found: a square root of several variables")
    if any(power > 1 for _, power in sympy.factor_list(q, x)[1]):
        raise Unable("no closed form was found: a square root that is a polynomial in places")
    return q


def _between(inner: Expression, y: Expression, *ends: tuple[Expression, Expression, Expression]) -> Parts:
    """The difference of the values of a polynomial of the second variable at two ends, a + b sqrt(q) each."""
    total: dict[Expression, Expression] = {}
    for sign, (a, b, q) in zip((-1, 1), ends, strict=True):
        root = sympy.Dummy()
        for (k,), c in sympy.Poly(inner.subs(y, a + b * root), root).terms():
            under = q if k % 2 else _ONE
            total[under] = total.get(under, 0) + sign * c * q ** (k // 2)
    return {q: e for q, c in total.items() if (e := sympy.together(sympy.expand(c))) != 0}


def _integral(c: Expression, q: Expression, x: Expression, ends: list[Expression]) -> Expression:
    """The integral of c sqrt(q) between the ends."""
    if q.is_number:
        antiderivative = sympy.sqrt(q) * _rational(c, x)
    elif not c.is_polynomial(x) or sympy.degree(q, x) > 2:
        raise Unable("no closed form was found: an elliptic integral, perhaps")
    else:
        antiderivative = _with_root(sympy.Poly(c, x), sympy.Poly(q, x), x)
    return _at(antiderivative, x, ends[1]) - _at(antiderivative, x, ends[0])


def _rational(c: Expression, x: Expression) -> Expression:
    antiderivative = sympy.integrate(c, x)
    if antiderivative.has(sympy.Integral, sympy.RootSum):
        raise Unable("no closed form was found: a logarithm at roots of a polynomial")
    return antiderivative.replace(sympy.log, lambda argument: sympy.log(sympy.Abs(argument)))


def _with_root(p: Any, q: Any, x: Expression) -> Expression:
    """An antiderivative of p sqrt(q) for q of degree 1 or 2."""
    size = p.degree() + q.degree() + (q.degree() == 1)
    unknown = sympy.symbols(f"u:{size}")
    rest = sympy.Symbol("c") if q.degree() == 2 else sympy.S.Zero
    ansatz = sympy.Poly(sum(u * x**k for k, u in enumerate(unknown)), x)
    equation = ansatz.diff(x) * q + ansatz * q.diff(x) / 2 + rest - p * q
    solved = sympy.linsolve(sympy.Poly(equation, x).all_coeffs(), *unknown, *([rest] if rest != 0 else []))
    values = dict(zip((*unknown, *([rest] if rest != 0 else [])), next(iter(solved)), strict=True))
    root = sympy.sqrt(q.as_expr())
    part = ansatz.as_expr().subs(values) * root
    if rest == 0:
        return part
    a, b, c = q.all_coeffs()
    if a.is_negative:
        inverse = -sympy.asin((2 * a * x + b) / sympy.sqrt(b**2 - 4 * a * c)) / sympy.sqrt(-a)
    else:
        inverse = sympy.log(sympy.Abs(2 * a * x + b + 2 * sympy.sqrt(a) * root)) / sympy.sqrt(a)
    return part + values[rest] * inverse


def _at(antiderivative: Expression, x: Expression, end: Expression) -> Expression:
    value = antiderivative.subs(x, end)
    value = value.replace(lambda e: isinstance(e, sympy.asin), lambda e: sympy.asin(sympy.simplify(e.args[0])))
    if not value.is_finite:
        raise Unable("no closed form was found: an end at which a term has no value")
    return value


def _expression(poly: Poly, symbols: list[Expression]) -> Expression:
    return sympy.Add(
        *(c * sympy.Mul(*(s**e for s, e in zip(symbols, exponents, strict=True))) for exponents, c in poly.terms())
    )

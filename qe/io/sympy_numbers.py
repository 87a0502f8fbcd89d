"""Real algebraic numbers as SymPy numbers and back, exactly. SymPy is imported when a function here is called."""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction
from typing import Any

from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.io.terms import decimal
from qe.spelling import NUMBERS

_SYMBOLS = dict(zip(NUMBERS, ("pi", "E", "EulerGamma", "Catalan")))


def symbol_of(name: str) -> Any:
    """The SymPy symbol of a variable, the number where the name is that of one (``qe.formula.numbers``)."""
    import sympy

    return getattr(sympy, _SYMBOLS[name]) if name in _SYMBOLS else sympy.Symbol(name)


def numbers_in(expression: Any) -> list[str]:
    """The names of the numbers that are not algebraic in a SymPy expression."""
    import sympy

    return [name for name in _SYMBOLS if symbol_of(name) in expression.atoms(sympy.NumberSymbol)]


def decimal_of(number: Any) -> Fraction:
    """The decimal number that a finite SymPy ``Float`` prints: all digits it holds to be known, in base ten."""
    text = str(number)
    return -decimal(text[1:]) if text.startswith("-") else decimal(text)


def number_to_sympy(number: RealAlgebraic) -> Any:
    """The SymPy number that equals ``number``: a ``Rational``, ``(p + q*sqrt(d))/r``, or a ``CRootOf``."""
    import sympy

    if number.is_rational:
        value = number.as_fraction()
        return sympy.Rational(value.numerator, value.denominator)
    coefficients = [sympy.Integer(c) for c in reversed(number.minimal_polynomial)]
    if number.degree == 2:
        a, b, c = coefficients
        root = sympy.sqrt(b**2 - 4 * a * c) / (2 * a)
        return -b / (2 * a) + (root if number.index else -root)
    # SymPy, too, numbers the real roots of an irreducible polynomial from the smallest, before the complex ones
    return sympy.CRootOf(sympy.Poly(coefficients, sympy.Symbol("x")), number.index, radicals=False)


def number_from_sympy(number: object) -> RealAlgebraic | None:
    """The real algebraic number that a SymPy expression without symbols is; None for any other object.

    It is the root of its minimal polynomial that its decimal digits tell from the others.
    """
    import sympy

    if not isinstance(number, sympy.Expr) or not number.is_number or number.is_real is not True:
        return None
    try:
        minimal = sympy.minimal_polynomial(number, sympy.Symbol("x"), polys=True)
    except (sympy.polys.polyerrors.BasePolynomialError, RuntimeError):  # not algebraic, or SymPy cannot tell
        return None
    coefficients = [int(c) for c in reversed(minimal.clear_denoms(convert=True)[1].all_coeffs())]
    for digits in (30, 120, 480, 1920):
        value = decimal_of(number.evalf(digits))
        error = Fraction(1 + abs(value), 10 ** (digits - 5))
        with suppress(InputError):  # more than one root there
            return RealAlgebraic.from_root(coefficients, value - error, value + error)
    return None

"""Python's protocol of real numbers (``numbers.Real``) for exact numbers.

Whatever is exact stays exact: integers, fractions, ``Decimal`` and, in comparisons, the value that a float is.
Arithmetic with a float is that of floats. Nothing compares with what is not a number;
every comparison but ``!=`` fails there.
"""

from __future__ import annotations

import math
import operator
import re
from abc import abstractmethod
from collections.abc import Callable
from decimal import ROUND_05UP, Context, Decimal
from fractions import Fraction
from numbers import Rational, Real
from typing import TYPE_CHECKING, Any, Self, TypeVar

from qe.exact.algebraic_text import in_latex
from qe.services import SymPyForm

if TYPE_CHECKING:
    from flint import arb

T = TypeVar("T")
Operation = Callable[[Any, Any], Any]

_SPECIFICATION = re.compile(r"((?:.?[<>=^])?[-+ ]?0?\d*,?)(\.\d+)?([eEfFgG%]?)")
"""A format for a number: fill and width, precision, kind."""

FIRST_BITS = 64


def exact(value: object) -> Fraction | float | None:
    """The value of a real number of another library, exactly; an infinite float or one that is no number as it is.

    None for anything else. Numbers of numpy and mpmath are known by what they offer; neither is loaded.
    """
    if isinstance(value, Rational):
        return Fraction(int(value.numerator), int(value.denominator))
    if isinstance(value, Decimal):
        return Fraction(value) if value.is_finite() else math.nan if value.is_nan() else float(value)
    if (parts := getattr(value, "_mpf_", None)) is not None:  # of mpmath: sign, mantissa, exponent, bits
        sign, mantissa, exponent, _ = parts
        if not mantissa and exponent:
            return float(value)  # type: ignore[arg-type]
        return Fraction(-int(mantissa) if sign else int(mantissa)) * Fraction(2) ** int(exponent)
    if isinstance(value, complex):
        return exact(value.real) if not value.imag else None
    if not isinstance(value, Real) or isinstance(value, PythonNumber):
        return None
    try:
        return Fraction(*map(int, value.as_integer_ratio()))  # type: ignore[attr-defined]
    except (AttributeError, ValueError, OverflowError):
        return float(value)


def exact_operand(value: object) -> Fraction | None:
    """The value of a number with which arithmetic is exact; none of SymPy's, which has an arithmetic of its own."""
    is_exact = isinstance(value, Rational | Decimal) and not hasattr(value, "free_symbols")
    result = exact(value) if is_exact else None
    return result if isinstance(result, Fraction) else None


def _comparison(operation: Callable[[float, int], bool]) -> Callable[[Any, object], bool]:
    def holds(self: PythonNumber, other: object) -> bool:
        sign = self._order(other)
        return NotImplemented if sign is None else operation(sign, 0)

    return holds


def _arithmetic(operation: Operation) -> tuple[Callable[[Any, object], Any], ...]:
    """An operator and the one that Python calls where the number is on the right; division is by the inverse."""
    divides = operation is operator.truediv
    used = operator.mul if divides else operation

    def left(self: PythonNumber, other: object) -> Any:
        value = self._operand(other)
        if value is None:
            return in_floats(operation, self, other)
        return self._with(used, value.inverse() if divides else value)

    def right(self: PythonNumber, other: object) -> Any:
        value = self._operand(other)
        if value is None:
            return in_floats(operation, other, self)
        return value._with(used, self.inverse() if divides else self)

    return left, right


class PythonNumber(SymPyForm):
    """What Python asks of a real number, for a class that has ``compare``, ``interval`` and its like.

    ``int``, ``round``, ``floor``, ``//`` and formats are right to the last digit; ``round(x, n)`` is a ``Fraction``.
    """

    __slots__ = ()

    @property
    @abstractmethod
    def is_rational(self) -> bool:
        """Whether it is a rational number."""

    @abstractmethod
    def as_fraction(self) -> Fraction:
        """The value of a rational number; ``InputError`` otherwise."""

    @abstractmethod
    def interval(self, bits: int = FIRST_BITS) -> tuple[Fraction, Fraction]:
        """Rational numbers lo <= self <= hi, close together."""

    @abstractmethod
    def sign(self) -> int:
        """-1, 0 or 1."""

    @abstractmethod
    def _order(self, other: object) -> float | None:
        """The sign of ``self - other``; not a number where there is none, None for what is no number at all."""

    @abstractmethod
    def ball(self, bits: int = FIRST_BITS) -> arb:
        """A ball around the number with about ``bits`` bits of relative accuracy."""

    @abstractmethod
    def _operand(self, other: object) -> Self | None:
        """What arithmetic with it takes, as a number of this kind; None for what it cannot take exactly."""

    @abstractmethod
    def _with(self, operation: Operation, other: Self) -> Self:
        """The sum, the difference or the product: ``operation`` is Python's."""

    @abstractmethod
    def _power(self, exponent: int) -> Self: ...

    @abstractmethod
    def inverse(self) -> Self:
        """1/self; ``ZeroDivisionError`` for zero."""

    def __init_subclass__(cls) -> None:
        Real.register(cls)

    def _repr_latex_(self) -> str:
        return f"${in_latex(self)}$"

    # --- order -------------------------------------------------------------------------------------------
    __lt__ = _comparison(operator.lt)
    __le__ = _comparison(operator.le)
    __gt__ = _comparison(operator.gt)
    __ge__ = _comparison(operator.ge)

    def __bool__(self) -> bool:
        return self.sign() != 0

    def __float__(self) -> float:
        return float(self.ball(64).mid())

    def _mpmath_(self, precision: int, rounding: str) -> str:
        """What mpmath makes a number of, with more digits than it keeps."""
        return f"{self:.{precision // 3 + 9}e}"

    # --- rounding ----------------------------------------------------------------------------------------
    def _rounded_by(self, function: Callable[[Fraction], T]) -> T:
        """The value of a function that changes at rational numbers only."""
        if self.is_rational:
            return function(self.as_fraction())
        bits = FIRST_BITS
        while True:
            low, high = map(function, self.interval(bits))
            if low == high:
                return low
            bits *= 2

    def __floor__(self) -> int:
        return self._rounded_by(math.floor)

    def __ceil__(self) -> int:
        return self._rounded_by(math.ceil)

    def __trunc__(self) -> int:
        return self._rounded_by(math.trunc)

    __int__ = __trunc__

    def __round__(self, digits: int | None = None) -> int | Fraction:
        return self._rounded_by(lambda value: round(value, digits))

    def __format__(self, specification: str) -> str:
        parts = _SPECIFICATION.fullmatch(specification)
        if parts is None or not (parts[2] or parts[3]):
            return format(str(self), specification)
        layout, precision, kind = parts.groups()
        precision = precision or ".6"
        return self._rounded_by(
            lambda value: format(_decimal(value, int(precision[1:])), layout + precision + (kind or "g"))
        )

    # --- arithmetic --------------------------------------------------------------------------------------
    __add__, __radd__ = _arithmetic(operator.add)
    __sub__, __rsub__ = _arithmetic(operator.sub)
    __mul__, __rmul__ = _arithmetic(operator.mul)
    __truediv__, __rtruediv__ = _arithmetic(operator.truediv)

    def __pow__(self, exponent: object) -> Any:
        if isinstance(exponent, int):
            return self._power(exponent)
        return in_floats(operator.pow, self, exponent) if isinstance(exponent, float) else NotImplemented

    @abstractmethod
    def __neg__(self) -> Self: ...

    def __pos__(self) -> Self:
        return self

    def __abs__(self) -> Self:
        return -self if self.sign() < 0 else self

    def __floordiv__(self, other: Any) -> Any:
        return _floor(self / other)

    def __rfloordiv__(self, other: Any) -> Any:
        return _floor(other / self)

    def __mod__(self, other: Any) -> Any:
        return self - (self // other) * other

    def __rmod__(self, other: Any) -> Any:
        return other - (other // self) * self

    __divmod__, __rdivmod__, __complex__ = Real.__divmod__, Real.__rdivmod__, Real.__complex__
    real, imag, conjugate = Real.real, Real.imag, Real.conjugate

    def __rpow__(self, base: object) -> Any:
        return in_floats(operator.pow, base, self) if isinstance(base, float) else NotImplemented


def in_floats(operation: Operation, left: object, right: object) -> Any:
    """The operation of two numbers, one of which is a float; ``NotImplemented`` for anything else."""
    other = right if isinstance(left, PythonNumber) else left
    if isinstance(other, PythonNumber) or not isinstance(other, Real) or hasattr(other, "free_symbols"):
        return NotImplemented
    return operation(float(left), float(right))  # type: ignore[arg-type]


def _floor(value: Any) -> Any:
    return float(math.floor(value)) if isinstance(value, float) else math.floor(value)


def _decimal(value: Fraction, digits: int) -> Decimal:
    """A decimal that rounds to so many digits as the value does: what is cut off leaves a trace in its last digit."""
    places = digits + 12 + max(0, value.numerator.bit_length() - value.denominator.bit_length()) // 3
    context = Context(prec=places, rounding=ROUND_05UP, Emax=10**9, Emin=-(10**9))
    return context.divide(Decimal(value.numerator), Decimal(value.denominator))

"""Test points: where a one-variable formula is tried (Loos & Weispfenning 1993; Weispfenning 1997).

All coefficients are free of the eliminated variable. A point makes sense where its ``guard`` holds.
``epsilon`` is +1 (or -1) for the point plus (or minus) a positive infinitesimal, else 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from qe.exact.algebraic import RealAlgebraic
from qe.exact.ring import Poly, format_poly


@dataclass(frozen=True, slots=True)
class Infinity:
    """A value above (sign 1) or below (sign -1) every root of every polynomial of the formula."""

    sign: int

    def __str__(self) -> str:
        return "infinity" if self.sign > 0 else "-infinity"


@dataclass(frozen=True, slots=True)
class LinearRoot:
    """-b/a, where a /= 0."""

    a: Poly
    b: Poly
    epsilon: int = 0

    def __str__(self) -> str:
        if self.a.is_constant:
            value = self.a.constant_value()
            top = _bracket(-self.b if value > 0 else self.b)
            text = top if abs(value) == 1 else f"{top}/{abs(value)}"
        else:
            text = f"{_bracket(-self.b)}/{_bracket(self.a)}"
        return text + _suffix(self.epsilon)


@dataclass(frozen=True, slots=True)
class QuadraticRoot:
    """(-b + branch*sqrt(b^2 - 4*a*c))/(2*a), where a /= 0 and b^2 - 4*a*c >= 0; branch is 1 or -1.

    The derivative of a*x^2 + b*x + c there is branch*sqrt(b^2 - 4*a*c): ``branch`` is the direction in which
    the parabola crosses zero, whatever the sign of a.
    """

    a: Poly
    b: Poly
    c: Poly
    branch: int
    epsilon: int = 0

    @property
    def discriminant(self) -> Poly:
        return self.b * self.b - 4 * (self.a * self.c)

    def __str__(self) -> str:
        sign = "+" if self.branch > 0 else "-"
        top = f"sqrt({format_poly(self.discriminant)})"
        top = f"{format_poly(-self.b)} {sign} {top}" if self.b else top if self.branch > 0 else f"-{top}"
        bottom = 2 * self.a
        return f"({top})/{_bracket(bottom)}" + _suffix(self.epsilon)


SOME = 4


@dataclass(frozen=True, slots=True)
class CubicRoot:
    """A real root of the cubic with these ``coefficients`` (from degree 0 up), the last one not 0.

    ``index`` 0: the only one, where the discriminant is negative; k = 1, 2, 3: the k-th smallest, each counted as often
    as it is a root, where it is not. ``SOME``: whichever of these three, for formulas that ask one thing of it
    at a time (``clusters``).
    """

    coefficients: tuple[Poly, Poly, Poly, Poly]
    index: int
    epsilon: int = 0

    @property
    def discriminant(self) -> Poly:
        """a^4 times the squares of the differences of the roots."""
        d, c, b, a = self.coefficients
        return b * b * c * c - 4 * (a * c * c * c + b * b * b * d) + 18 * (a * b * c * d) - 27 * (a * a * d * d)

    def __str__(self) -> str:
        d, c, b, a = map(_bracket, self.coefficients)
        which = "a root" if self.index == SOME else f"root {self.index} of 3" if self.index else "the root"
        return f"({which} of {a}*x^3 + {b}*x^2 + {c}*x + {d})" + _suffix(self.epsilon)


@dataclass(frozen=True, slots=True)
class Value:
    """A number, found by sampling where no other variable occurred."""

    number: Fraction | RealAlgebraic

    def __str__(self) -> str:
        return str(self.number)


Root = LinearRoot | QuadraticRoot | CubicRoot
SymbolicPoint = Infinity | Root
TestPoint = SymbolicPoint | Value


def _suffix(epsilon: int) -> str:
    return "" if not epsilon else " + epsilon" if epsilon > 0 else " - epsilon"


def _bracket(p: Poly) -> str:
    text = format_poly(p)
    return text if p.term_count() <= 1 and not text.startswith("-") and "*" not in text else f"({text})"

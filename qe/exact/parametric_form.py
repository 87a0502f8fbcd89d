"""Conditions as quadratic polynomials in the quantified variables, with coefficients in the parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.exact.quadratic_form import Quadratic
from qe.exact.ring import Poly


@dataclass(frozen=True, slots=True)
class ParametricForm:
    """y^T H y / 2 + b(p).y + c(p): a constant Hessian, the other coefficients polynomials in the parameters p."""

    hessian: tuple[tuple[Fraction, ...], ...]
    gradient: tuple[Poly, ...]
    constant: Poly

    def at(self, parameters: Sequence[Fraction]) -> Quadratic:
        """The quadratic polynomial over a rational point."""
        values = (*parameters, *(Fraction(0) for _ in self.gradient))
        gradient = tuple(b.evaluate(values) if b else Fraction(0) for b in self.gradient)
        return Quadratic(self.hessian, gradient, self.constant.evaluate(values))


def parametric_form(poly: Poly, variables: Sequence[int]) -> ParametricForm | None:
    """The form of a polynomial of which these are the quantified variables, or None."""
    size = len(variables)
    hessian = [[Fraction(0)] * size for _ in range(size)]
    gradient, constant = [poly.ring.constant(0)] * size, poly.ring.constant(0)
    for exponents, coefficient in poly.collected(variables).items():
        match [k for k, e in enumerate(exponents) for _ in range(e)]:
            case []:
                constant = coefficient
            case [i]:
                gradient[i] = coefficient
            case [i, j] if coefficient.is_constant:
                hessian[i][j] += coefficient.constant_value()
                hessian[j][i] += coefficient.constant_value()
            case _:
                return None
    return ParametricForm(tuple(map(tuple, hessian)), tuple(gradient), constant)

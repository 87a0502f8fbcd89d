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


def parametric_form(poly: Poly, free: int) -> ParametricForm | None:
    """The form of a polynomial whose variables from index ``free`` on are the quantified ones, or None."""
    ring = poly.ring
    size = ring.size - free
    hessian = [[Fraction(0)] * size for _ in range(size)]
    linear: list[dict[tuple[int, ...], int]] = [{} for _ in range(size)]
    constant: dict[tuple[int, ...], int] = {}
    for exponents, coefficient in poly.terms():
        inner = [k for k in range(size) for _ in range(exponents[free + k])]
        outer = (*exponents[:free], *((0,) * size))
        if len(inner) > 2 or (len(inner) == 2 and any(outer)):
            return None
        if len(inner) == 2:
            i, j = inner
            hessian[i][j] += coefficient
            hessian[j][i] += coefficient
        elif inner:
            linear[inner[0]][outer] = coefficient
        else:
            constant[outer] = coefficient
    gradient = tuple(ring.from_terms(terms) for terms in linear)
    return ParametricForm(tuple(map(tuple, hessian)), gradient, ring.from_terms(constant))

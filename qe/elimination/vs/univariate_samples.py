"""Formulas on a line: one free variable, the others fixed to real algebraic numbers. Solutions by sampling."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.fibre_stack import isolate_over
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.formula.build import convert
from qe.formula.evaluate import substituted, truth_under
from qe.formula.syntax import Formula
from qe.formula.traverse import has_root_atoms, polynomials

Number = Fraction | RealAlgebraic
Values = Mapping[str, Number]


def solution(formula: Formula, variable: str, values: Values) -> Number | None:
    """A value of ``variable`` for which the formula holds, the others having the given values; None if none.

    THEOREM: the truth is constant between neighbouring roots of the formula's polynomials, so trying every root
    and one rational number between each two (preferred, simple ones first) decides, by exact evaluation.
    Raises ``Unable`` for formulas with root atoms.
    """
    algebraic: dict[str, RealAlgebraic] = {}
    rational: dict[str, Fraction] = {}
    for name, value in values.items():
        if name == variable:
            continue
        if isinstance(value, RealAlgebraic) and not value.is_rational:
            algebraic[name] = value
        else:
            rational[name] = value if isinstance(value, Fraction) else value.as_fraction()
    if has_root_atoms(formula):
        raise Unable("no witness for a formula with root atoms")
    formula = substituted(formula, rational)
    used = [name for name in formula.free if name in algebraic]
    ring = Ring.of((*used, variable))
    line, point = convert(formula, ring), Point.of(ring, [algebraic[name] for name in used])
    polys = polynomials(line)
    fixed = {p: point.sign(p) for p in polys if not p.degree(point.depth)}
    stack = isolate_over(point, tuple(p for p in polys if p.degree(point.depth)))
    signs = stack.sign_maps()
    sectors = sorted(enumerate(stack.samples), key=lambda sector: (sector[1].denominator, abs(sector[1])))
    for position in (*(2 * k for k, _ in sectors), *range(1, len(signs), 2)):
        if truth_under(line, (signs[position] | fixed).get) is True:
            return stack.sample(position).number(point.depth)
    return None

"""Formulas on a line: one free variable, the others fixed to real algebraic numbers. Solutions by sampling."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.fibre_stack import isolate_over
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.formula.build import atom, convert
from qe.formula.evaluate import truth_under
from qe.formula.syntax import Atom, Atomic, Formula
from qe.formula.traverse import map_atoms, polynomials

Number = Fraction | RealAlgebraic
Values = Mapping[str, Number]


def solution(formula: Formula, variable: str, values: Values) -> Number | None:
    """A value of ``variable`` for which the formula holds, the others having the given values; None if none.

    THEOREM: the truth is constant between neighbouring roots of the formula's polynomials, so trying every root
    and one rational number between each two (preferred, simple ones first) decides, by exact evaluation.
    Raises ``Unable`` for formulas with root atoms.
    """
    algebraic: dict[str, RealAlgebraic] = {}
    for name, value in values.items():
        if name == variable:
            continue
        if isinstance(value, RealAlgebraic) and not value.is_rational:
            algebraic[name] = value
        else:
            formula = _at(formula, name, value if isinstance(value, Fraction) else value.as_fraction())
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


def _at(formula: Formula, name: str, value: Fraction) -> Formula:
    """The formula with a variable set to a rational number."""

    def change(atomic: Atomic) -> Formula:
        i = atomic.poly.ring.index.get(name)
        if not isinstance(atomic, Atom):
            raise Unable("no witness for a formula with root atoms")
        if i is None or not atomic.poly.degree(i):
            return atomic
        return atom(atomic.poly.at_rational(i, value), atomic.relation)

    return map_atoms(formula, change)

"""An independent decision of formulas in one variable: try all roots and a number between each two."""

from fractions import Fraction
from itertools import pairwise

from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.build import atom
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or
from qe.formula.traverse import map_atoms, polynomials


def specialise(formula: Formula, values: dict[str, Fraction]) -> Formula:
    """The formula with some variables set to rational numbers."""

    def change(found: Atom) -> Formula:
        poly = found.poly
        for name, value in values.items():
            poly = poly.at_rational(poly.ring.index[name], value)
        return atom(poly, found.relation)

    return map_atoms(formula, change)


def samples(polys: list[Poly], x: int) -> list[RealAlgebraic]:
    """All roots of the univariate polynomials, and numbers between and beyond them, ascending."""
    roots = sorted({r for p in polys if p.degree(x) for r in real_roots(p.to_univariate(x))})
    if not roots:
        return [RealAlgebraic.rational(0)]
    out = [roots[0] - 1]
    for a, b in pairwise(roots):
        out += [a, RealAlgebraic.rational(between(a, b))]
    return [*out, roots[-1], roots[-1] + 1]


def between(a: RealAlgebraic, b: RealAlgebraic) -> Fraction:
    bits = 16
    while True:
        lo, hi = a.interval(bits)[1], b.interval(bits)[0]
        if lo < hi:
            return (lo + hi) / 2
        bits *= 2


def sign_at(poly: Poly, x: int, value: RealAlgebraic) -> int:
    """The sign of a polynomial in variable x alone."""
    if poly.is_constant:
        c = poly.constant_value()
        return (c > 0) - (c < 0)
    line = Ring.of((poly.ring.names[x],))
    return Point.of(line, [value]).sign(poly.convert(line))


def holds(formula: Formula, x: int, value: RealAlgebraic) -> bool:
    """Whether the formula, in variable x alone, holds at the number."""
    match formula:
        case Constant(truth):
            return truth
        case Atom(poly, relation):
            return relation.holds(sign_at(poly, x, value))
        case And(args):
            return all(holds(a, x, value) for a in args)
        case Or(args):
            return any(holds(a, x, value) for a in args)
        case Not(arg):
            return not holds(arg, x, value)
    raise AssertionError(formula)


def satisfiable(formula: Formula, x: int) -> bool:
    """Whether the formula, in variable x alone, has a solution."""
    return any(holds(formula, x, v) for v in samples(polynomials(formula), x))

"""Formulas on a line: one free variable, the others fixed to real algebraic numbers. Solutions by sampling."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import pairwise

from qe.elimination.vs.plan import occurring
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.balls import lower_end, upper_end
from qe.exact.isolate import simplest_between
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Fibre, FibreRoot, Point
from qe.formula.build import atom, convert
from qe.formula.evaluate import truth_under
from qe.formula.syntax import Atom, Formula, RootAtom
from qe.formula.traverse import map_atoms, polynomials, ring_of

Number = Fraction | RealAlgebraic
Values = Mapping[str, Number]


def solution(formula: Formula, variable: str, values: Values) -> Number | None:
    """A value of ``variable`` for which the formula holds, the others having the given values; None if none.

    THEOREM: the truth is constant between neighbouring roots of the formula's polynomials, so trying every root
    and one rational number between each two (preferred, simple ones first) decides, by exact evaluation.
    Raises ``Unable`` for formulas with root atoms.
    """
    line = _Line(formula, variable, values)
    for number in line.samples():
        if line.holds(number):
            return number if isinstance(number, Fraction) else _plain(number)
    return None


Root = RealAlgebraic | FibreRoot


class _Line:
    """The formula on the line where only ``variable`` is free: its polynomials' roots, and its truth between them."""

    __slots__ = ("formula", "point", "ring", "var")

    def __init__(self, formula: Formula, variable: str, values: Values) -> None:
        algebraic: dict[str, RealAlgebraic] = {}
        for name, value in values.items():
            if name == variable:
                continue
            if isinstance(value, RealAlgebraic) and not value.is_rational:
                algebraic[name] = value
            else:
                formula = _at(formula, name, value if isinstance(value, Fraction) else value.as_fraction())
        ring = ring_of(formula)
        used = () if ring is None else tuple(n for n in algebraic if ring.index[n] in occurring(formula))
        self.ring = Ring.of((*used, variable))
        self.var = len(used)
        self.formula = convert(formula, self.ring)
        self.point = Point.of(self.ring, [algebraic[n] for n in used])

    def samples(self) -> Iterator[Fraction | Root]:
        """Rational numbers between the roots (and beyond them), simple ones first; then the roots."""
        roots, ends = self._roots()
        between: list[Fraction] = []
        for k in range(len(roots) + 1):
            lo = ends[k - 1][1] if k else None
            hi = ends[k][0] if k < len(roots) else None
            between.append(_simple(lo, hi))
        yield from sorted(between, key=lambda q: (q.denominator, abs(q)))
        yield from roots

    def holds(self, number: Fraction | Root) -> bool:
        """Whether the formula holds at the number, exactly."""
        value = number if not isinstance(number, Fraction) else RealAlgebraic.rational(number)
        there = self.point.extend(value)
        return truth_under(self.formula, there.sign) is True

    def _roots(self) -> tuple[list[Root], list[tuple[Fraction, Fraction]]]:
        """The roots of all polynomials, ascending, with disjoint intervals around them."""
        roots: list[Root]
        if self.var == 0:
            numbers = {r for p in polynomials(self.formula) for r in real_roots(p.to_univariate(0))}
            roots = [*sorted(numbers)]
        else:
            total = self._product()
            if total is None:
                return [], []
            fibre = Fibre(self.point, self.var, total.coefficients(self.var))
            fibre.strip()
            roots = [FibreRoot(fibre, k) for k in range(len(fibre.roots()))]
        bits = 64
        while True:
            ends = [_ends(r, bits) for r in roots]
            if all(a[1] < b[0] for a, b in pairwise(ends)):
                return roots, ends
            bits *= 2

    def _product(self) -> Poly | None:
        """The product of the polynomials that do not vanish identically on the line; None if there is none."""
        total: Poly | None = None
        for p in polynomials(self.formula):
            if not p.degree(self.var) or all(self.point.vanishes(c) for c in p.coefficients(self.var)):
                continue
            total = p if total is None else total * p
        return total


def _plain(number: Root) -> Number:
    value = number.number() if isinstance(number, FibreRoot) else number
    return value.as_fraction() if value.is_rational else value


def _ends(root: Root, bits: int) -> tuple[Fraction, Fraction]:
    if isinstance(root, RealAlgebraic):
        return root.interval(bits)
    ball = root.ball(bits)
    lo, hi = lower_end(ball), upper_end(ball)
    return Fraction(int(lo.p), int(lo.q)), Fraction(int(hi.p), int(hi.q))


def _simple(lo: Fraction | None, hi: Fraction | None) -> Fraction:
    """A simple rational number strictly between the ends (None: no end)."""
    if (lo is None or lo < 0) and (hi is None or hi > 0):
        return Fraction(0)
    if hi is None:
        assert lo is not None
        return Fraction(lo.__floor__() + 1)
    if lo is None:
        return Fraction(hi.__ceil__() - 1)
    q = simplest_between(RealAlgebraic.rational(lo).as_fmpq(), RealAlgebraic.rational(hi).as_fmpq())
    return Fraction(int(q.p), int(q.q))


def _at(formula: Formula, name: str, value: Fraction) -> Formula:
    """The formula with a variable set to a rational number."""

    def change(found: Atom | RootAtom) -> Formula:
        i = found.poly.ring.index.get(name)
        if isinstance(found, RootAtom):
            raise Unable("no witness for a formula with root atoms")
        if i is None or not found.poly.degree(i):
            return found
        return atom(found.poly.at_rational(i, value), found.relation)

    return map_atoms(formula, change)

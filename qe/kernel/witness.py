"""Checker for certificates of kind "witness": real numbers that satisfy a quantifier-free formula.

Payload: ``order`` (variable names), ``matrix`` (the formula), ``values`` (one per variable: a rational number, or
``{"polynomial": text in that variable, "interval": [low, high]}`` for its only root there). Signs of the formula's
polynomials at the point are decided exactly by ``qe.kernel.arithmetic.triangular``.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from qe.exact.ring import Poly, Ring
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or
from qe.kernel.arithmetic.fibre import RationalFibre, fibre, values
from qe.kernel.arithmetic.triangular import Coordinate, Point
from qe.kernel.limits import check_value
from qe.options import Budget
from qe.proof.entry import Entry, Json, formula_from_json


def check_witness(payload: dict[str, Json], budget: Budget | None = None) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    order, matrix, numbers = Entry(payload, "payload").fields("order", "matrix", "values")
    names = order.names()
    ring = Ring.of(names)
    formula = formula_from_json(matrix, ring)
    listed = list(numbers.items())
    if len(listed) != len(names):
        raise numbers.fail(f"expected {len(names)} values")
    point, rationals = Point(budget=budget), {}
    for i, entry in enumerate(listed):
        number = _number(entry, ring, i, budget)
        if isinstance(number, Coordinate):
            point = point.extended(number)
        else:
            rationals[i] = number
    if not _holds(formula, _Signs(point, rationals), matrix):
        raise matrix.fail("the values do not satisfy the formula")


def _number(entry: Entry, ring: Ring, i: int, budget: Budget | None) -> Fraction | Coordinate:
    if isinstance(entry.value, str):
        return entry.rational()
    polynomial, interval = entry.fields("polynomial", "interval")
    poly = polynomial.polynomial(ring)
    ends = [e.rational() for e in interval.items()]
    if poly.variables != (i,):
        raise polynomial.fail(f"expected a polynomial in {ring.names[i]}")
    if len(ends) != 2 or ends[0] >= ends[1]:
        raise interval.fail("expected two ascending ends")
    for end in ends:
        check_value(poly, i, end)
    f = fibre(Point(budget=budget), poly, i)
    assert isinstance(f, RationalFibre)
    if 0 in f.signs(values((ends[0], ends[1]))) or f.count_between(ends[0], ends[1]) != 1:
        raise interval.fail("expected exactly one root between two ends that are no roots")
    found = f.coordinate(ends[0], ends[1])
    if found is None:
        raise interval.fail("the root could not be represented")
    return found


class _Signs:
    """The signs of polynomials at the point, each found once."""

    def __init__(self, point: Point, rationals: dict[int, Fraction]) -> None:
        self.point, self.rationals, self.known = point, rationals, dict[Poly, int]()

    def __call__(self, poly: Poly) -> int:
        found = self.known.get(poly)
        if found is None:
            found = self.known[poly] = self._sign(poly)
        return found

    def _sign(self, poly: Poly) -> int:
        rational = [i for i in poly.variables if i in self.rationals]
        for i in rational:
            check_value(poly, i, self.rationals[i])
        if len(rational) == len(poly.variables):
            value = sum((c * self._product(powers) for powers, c in poly.sparse_terms()), Fraction(0))
            return (value > 0) - (value < 0)
        for i in rational:
            poly = poly.at_rational(i, self.rationals[i])
        return self.point.sign(poly)

    def _product(self, powers: Iterable[tuple[int, int]]) -> Fraction:
        value = Fraction(1)
        for i, exponent in powers:
            value *= self.rationals[i] ** exponent
        return value


def _holds(formula: Formula, sign: _Signs, entry: Entry) -> bool:
    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return relation.holds(sign(poly))
        case Not(arg):
            return not _holds(arg, sign, entry)
        case And(args):
            return all(_holds(a, sign, entry) for a in args)
        case Or(args):
            return any(_holds(a, sign, entry) for a in args)
    raise entry.fail("expected a quantifier-free formula without root atoms")

"""Checker for certificates of kind "witness": real numbers that satisfy a quantifier-free formula.

Payload: ``order`` (variable names), ``matrix`` (the formula), ``values`` (one per variable: a rational number, or
``{"polynomial": text in that variable, "interval": [low, high]}`` for its only root there). Signs of the formula's
polynomials at the point are decided exactly by ``qe.exact.triangular``.
"""

from __future__ import annotations

from fractions import Fraction

from qe.certify.limits import check_value
from qe.evidence.entry import Entry, Json, formula_from_json
from qe.exact.fibre import RationalFibre, fibre, values
from qe.exact.ring import Poly, Ring
from qe.exact.triangular import Coordinate, Point
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or
from qe.options import Budget


def check_witness(payload: dict[str, Json], budget: Budget | None = None) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    order, matrix, numbers = Entry(payload, "payload").fields("order", "matrix", "values")
    names = tuple(e.text() for e in order.items())
    if len(set(names)) != len(names):
        raise order.fail("a variable is listed twice")
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
    if not _holds(formula, point, rationals, matrix):
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


def _holds(formula: Formula, point: Point, rationals: dict[int, Fraction], entry: Entry) -> bool:
    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return relation.holds(_sign(poly, point, rationals))
        case Not(arg):
            return not _holds(arg, point, rationals, entry)
        case And(args):
            return all(_holds(a, point, rationals, entry) for a in args)
        case Or(args):
            return any(_holds(a, point, rationals, entry) for a in args)
    raise entry.fail("expected a quantifier-free formula without root atoms")


def _sign(poly: Poly, point: Point, rationals: dict[int, Fraction]) -> int:
    for i, value in rationals.items():
        if poly.degree(i):
            check_value(poly, i, value)
            poly = poly.at_rational(i, value)
    return point.sign(poly)

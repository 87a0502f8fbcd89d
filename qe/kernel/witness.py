"""Checker for certificates of kind "witness": real numbers that satisfy a quantifier-free formula.

Payload: ``order`` (variable names), ``matrix`` (the formula), ``values`` (one per variable: a rational number, or
``{"polynomial": text in that variable, "interval": [low, high]}`` for its only root there). Signs of the formula's
polynomials at the point are decided exactly by ``qe.kernel.arithmetic.triangular``.
"""

from __future__ import annotations

from fractions import Fraction

from qe.exact.ring import Ring
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or
from qe.kernel.arithmetic.fibre import RationalFibre, fibre, values
from qe.kernel.arithmetic.products import FactorLists
from qe.kernel.arithmetic.triangular import Coordinate, Point
from qe.kernel.limits import check_value
from qe.kernel.line import Sample
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
    sample = Sample(FactorLists(ring, ()), Point(budget=budget), {}, [], (0,))
    for i, entry in enumerate(listed):
        sample = sample.extended(_number(entry, ring, i, budget), [], alone=True)
    if not _holds(formula, sample, matrix):
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


def _holds(formula: Formula, sample: Sample, entry: Entry) -> bool:
    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return relation.holds(sample.sign(poly))
        case Not(arg):
            return not _holds(arg, sample, entry)
        case And(args):
            return all(_holds(a, sample, entry) for a in args)
        case Or(args):
            return any(_holds(a, sample, entry) for a in args)
    raise entry.fail("expected a quantifier-free formula without root atoms")

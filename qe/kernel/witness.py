"""Rule "instance": a block of one kind decided by a point.

THEOREM. ex v. f is true if f holds at real numbers for v. all v. f is the negation of ex v. not f.

Evidence: ``order`` and ``values``: variables, and a number for each. A number is rational, or
``{"polynomial": text in that variable, "interval": [low, high]}`` for the only root there. Signs of the formula's
polynomials at the point are decided exactly by ``qe.kernel.arithmetic.triangular``.
"""

from __future__ import annotations

from fractions import Fraction

from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import FALSE, TRUE, Exists
from qe.formula.traverse import map_atoms
from qe.kernel.arithmetic.fibre import RationalFibre, fibre
from qe.kernel.arithmetic.products import FactorLists
from qe.kernel.arithmetic.triangular import Coordinate, Point
from qe.kernel.block import existential
from qe.kernel.limits import check_value
from qe.kernel.line import Sample
from qe.kernel.step import Claim, Context, Limits, only
from qe.options import Budget
from qe.proof.entry import Entry


def check_instance(claim: Claim, context: Context, limits: Limits) -> None:
    """The body holds at the point."""
    order, numbers = only(claim, "order", "values")
    before, after = existential(claim)
    if not isinstance(before, Exists) or before.free or after != TRUE:
        raise claim.fail("expected a sentence of one block, and that a point decides it")
    names = order.names()
    if not set(before.body.free) <= set(names) <= set(claim.ring.names):
        raise order.fail("other variables than those of the sentence")
    ring, listed = Ring.of(names), list(numbers.items())
    if len(listed) != len(names):
        raise numbers.fail(f"expected {len(names)} values")
    sample = Sample(FactorLists(ring, ()), Point(budget=limits.budget), {}, [], (0,))
    for i, entry in enumerate(listed):
        sample = sample.extended(_number(entry, ring, i, limits.budget), [], alone=True)
    body = convert(claim.plain(before.body), ring)
    if map_atoms(body, lambda a: TRUE if a.relation.holds(sample.sign(a.poly)) else FALSE) != TRUE:
        raise numbers.fail("the values do not satisfy the formula")


def _number(entry: Entry, ring: Ring, i: int, budget: Budget) -> Fraction | Coordinate:
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
    found = f.only_root(ends[0], ends[1])
    if found is None:
        raise interval.fail("expected exactly one root between two ends that are no roots")
    return found

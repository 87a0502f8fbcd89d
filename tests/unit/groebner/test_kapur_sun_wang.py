"""Comprehensive Gröbner systems: branches specialize to the bases at their points; faithful ones lie in the ideal."""

import pickle
from dataclasses import replace
from fractions import Fraction
from itertools import product
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.exact.block_order import BlockOrder
from qe.exact.groebner import MonomialOrder, groebner_basis
from qe.exact.ring import Poly, Ring
from qe.groebner.faithful import with_faithful
from qe.groebner.kapur_sun_wang import segments
from qe.groebner.reduction import Divisor, cleared, divides, joined, monomial, reduced_basis, remainder
from qe.groebner.segment import Segment, monomial_names
from qe.options import Budget
from tests.strategies import polynomials
from tests.tables import each
from tests.unit.exact.ideal_membership import in_ideal
from tests.unit.groebner.support import places

# Segments: how they are made and reduced, and what lies in them.

RING = Ring.of(("a", "b", "x", "y"))
A, B, X, Y = (RING.var(name) for name in RING.names)
BLOCK = BlockOrder((2, 3), (0, 1))
POINTS = [(Fraction(a), Fraction(b)) for a, b in product((-2, -1, 0, 1, 2), repeat=2)]


def at(poly: Poly, point: tuple[Fraction, Fraction]) -> Fraction:
    return poly.evaluate((*point, 0, 0))


def lies_in(point: tuple[Fraction, Fraction], segment: Segment) -> bool:
    zero = all(not at(p, point) for p in segment.equal) and all(at(p, point) for p in segment.nonzero)
    return zero and (not segment.some or any(at(p, point) for p in segment.some))


SYSTEMS = [
    [A * X - B, X**2 - Y],
    [A * X + Y - 1, X + A * Y - 1],
    [A * X**2 + B * X + 1],
    [A * X, B * Y, X * Y - 1],
    [A, B * X - 1],
    [A * B - 1, X - Y],
    [(A - B) * X * Y, Y**2 - A],
]


@pytest.mark.parametrize("polys", SYSTEMS, ids=str)
def test_every_point_lies_in_one_segment_and_the_basis_specialises(polys: list[Poly]) -> None:
    found = list(segments(polys, BLOCK, Budget(60)))
    for point in POINTS:
        assert sum(lies_in(point, s) for s in found) == 1
    chance = Random(1)
    for segment in found:
        for place in places(segment.equal, segment.nonzero, segment.some, (0, 1), chance)[:2]:
            assert place.leads(polys, BLOCK) == set(segment.leads)
            assert place.ideal(polys, BLOCK) == place.ideal(segment.basis, BLOCK) if segment.basis else True


def test_only_the_points_that_are_asked_about() -> None:
    whole = list(segments([A * X - B], BLOCK, Budget(60)))
    asked = list(segments([A * X - B], BLOCK, Budget(60), equal=[A * B], nonzero=[A - 1]))
    for point in POINTS:
        a, b = point
        expected = int(a * b == 0 and a != 1)
        assert sum(lies_in(point, s) for s in whole) == 1 and sum(lies_in(point, s) for s in asked) == expected
    assert len(list(segments([X], BLOCK, Budget(60), equal=[A], nonzero=[A**2]))) == 0
    assert next(segments([X], BLOCK, Budget(60), nonzero=[RING.constant(3)])).nonzero == ()


def test_the_quadratic_equation() -> None:
    """Where the leading coefficient does not vanish, where it does, and where nothing is left but a contradiction."""
    found = list(segments([A * X**2 + B * X + 1], BLOCK, Budget(60)))
    leads = {s.leads for s in found}
    assert leads == {((2, 0),), ((1, 0),), ((0, 0),)}
    (unit,) = [s for s in found if s.is_unit]
    assert lies_in((Fraction(0), Fraction(0)), unit) and not lies_in((Fraction(0), Fraction(1)), unit)


def test_the_zero_ideal() -> None:
    (found,) = segments([RING.constant(0)], BLOCK, Budget(60))
    assert found.basis == () and found.equal == () and found.dimension == 2


def segment(
    *basis: Poly, equal: tuple[Poly, ...] = (), nonzero: tuple[Poly, ...] = (), some: tuple[Poly, ...] = ()
) -> Segment:
    return Segment(BLOCK, equal, nonzero, some, basis)


@each(
    ((), (), 2, False),
    ((RING.constant(1),), ((0, 0),), -1, True),
    ((A * X - B,), ((1, 0),), 1, False),
    ((A * X - B, Y**2 - X), ((1, 0), (0, 2)), 0, False),
    ((X * Y - 1,), ((1, 1),), 1, False),
)
def test_leading_monomials_and_dimension(basis: tuple[Poly, ...], leads: object, dimension: int, unit: bool) -> None:
    found = segment(*basis)
    assert (found.leads, found.dimension, found.is_unit) == (leads, dimension, unit)


def test_reduction_modulo_basis_and_equations() -> None:
    plain = segment(A * X - B, nonzero=(A,))
    assert plain.base is None and plain.reduce(X * Y) == (A, B * Y)
    bound = segment(X - A, equal=(A**2 - B,))
    assert bound.base is not None and bound.reduce(X**2) == (RING.constant(1), B)
    assert bound.reduce(X**2 - B)[1] == RING.constant(0)


def test_what_is_remembered_is_not_pickled() -> None:
    one = segment(X - A, equal=(A**2 - B,), some=(B,))
    assert one.base is not None and one.leads
    again = pickle.loads(pickle.dumps(one))
    assert again == one and set(vars(again)) == {
        "block",
        "equal",
        "nonzero",
        "some",
        "basis",
        "elements",
        "faithful",
    }


def test_names_of_monomials() -> None:
    assert [monomial_names(e, ("x", "y")) for e in ((0, 0), (1, 0), (2, 1), (0, 3))] == ["1", "x", "x^2*y", "y^3"]


@given(polynomials(RING, max_degree=3))
def test_a_polynomial_is_its_terms(poly: Poly) -> None:
    terms = BLOCK.terms(poly)
    assert joined(terms, BLOCK, RING) == poly
    assert [BLOCK.order.key(e) for e in terms] == sorted(map(BLOCK.order.key, terms), reverse=True)
    if poly:
        divisor = Divisor(poly, BLOCK)
        assert divisor.lead == BLOCK.lead(poly)
        assert joined(dict([divisor.lead, *divisor.tail]), BLOCK, RING) == poly


def test_monomials() -> None:
    assert monomial(BLOCK, (2, 1), A + 1) == (A + 1) * X**2 * Y
    assert divides((1, 0), (1, 3)) and divides((0, 0), (0, 0)) and not divides((1, 1), (2, 0))


@given(polynomials(RING, max_degree=3), polynomials(RING, max_degree=2), polynomials(RING, max_degree=2))
def test_the_remainder_differs_by_a_combination(poly: Poly, one: Poly, other: Poly) -> None:
    divisors = [Divisor(p, BLOCK) for p in (one, other) if p and not BLOCK.is_free(p)]
    scale, rest = remainder(poly, divisors, BLOCK, None)
    assert BLOCK.is_free(scale) and scale
    assert not divisors or in_ideal(scale * poly - rest, [d.poly for d in divisors])
    assert divisors or (scale, rest) == (RING.constant(1), poly)
    for exponents in BLOCK.terms(rest):
        assert not any(divides(d.lead[0], exponents) for d in divisors)


def test_scales_are_as_small_as_the_coefficients_allow() -> None:
    assert remainder(A * X, [Divisor(A * X - B, BLOCK)], BLOCK, None) == (RING.constant(1), B)
    assert remainder(X, [Divisor(A * X - B, BLOCK)], BLOCK, None) == (A, B)
    assert remainder(A * X, [Divisor(A**2 * X - B, BLOCK)], BLOCK, None) == (A, B)
    assert remainder(X**2, [Divisor(A * X - B, BLOCK)], BLOCK, None) == (A**2, B**2)
    assert remainder(X - Y, [Divisor(X - Y, BLOCK)], BLOCK, None) == (RING.constant(1), RING.constant(0))


def test_coefficients_are_reduced_where_the_segment_has_equations() -> None:
    base = groebner_basis([A**2 - B], variables=(2, 3, 0, 1))
    assert base is not None
    scale, rest = remainder(A**2 * Y, [Divisor(X - A, BLOCK)], BLOCK, base)
    assert (scale, rest) == (RING.constant(1), B * Y)
    assert remainder(A**2 * X - A * B, [Divisor(X - A, BLOCK)], BLOCK, base)[1] == RING.constant(0)


@each(
    (A * X + A * B, X + B),
    (-2 * A * X - 2 * A, X + 1),
    (A * X + B, A * X + B),
    ((A + B) * X**2 + (A**2 - B**2) * Y, X**2 + (A - B) * Y),
    (6 * X, X),
)
def test_content_is_divided_out(poly: Poly, expected: Poly) -> None:
    assert cleared(poly, BLOCK) == expected.normal()[1]


def test_a_reduced_basis() -> None:
    found = reduced_basis([X * Y + A * X + X, Y - B, X**2 - Y], BLOCK, None)
    assert found[0] == Y - B or found[0] == (Y - B).normal()[1]
    leads = [BLOCK.lead(p)[0] for p in found]
    assert leads == sorted(leads, key=BLOCK.order.key)
    for k, p in enumerate(found):
        others = [Divisor(q, BLOCK) for i, q in enumerate(found) if i < k]
        assert not any(divides(d.lead[0], e) for d in others for e in list(BLOCK.terms(p))[1:])


@given(st.sampled_from(tuple(MonomialOrder)))
def test_the_lead_follows_the_order(order: MonomialOrder) -> None:
    block = BlockOrder((2, 3), (0, 1), order)
    expected = (1, 0) if order is MonomialOrder.LEX else (0, 2)
    assert Divisor(A * X + B * Y**2, block).lead[0] == expected


# Elements of the given ideal with the values of a segment's basis on the segment.


@pytest.mark.parametrize(
    "polys",
    [(A * X - B, B * Y - A), (A * X**2 + B * X + 1,), (A * X + Y - 1, X + A * Y - 1), (A * X, B * Y, X * Y - 1)],
    ids=str,
)
def test_faithful_elements(polys: tuple[Poly, ...]) -> None:
    for segment in with_faithful(list(segments(polys, BLOCK, Budget(60))), polys, (), Budget(60)):
        found = segment.faithful
        assert found is not None and len(found) == len(segment.elements)
        for f, g in zip(found, segment.elements):
            assert in_ideal(f, polys)
            assert in_ideal(f, (*segment.equal, g)) if segment.equal else f == g


def test_they_differ_from_the_elements_where_the_equations_were_used() -> None:
    polys = (A * X - B, B * Y - A)
    found = with_faithful(list(segments(polys, BLOCK, Budget(60))), polys, (), Budget(60))
    assert any(s.faithful != s.elements for s in found)


def test_without_equations_or_polynomials_the_elements_are_faithful() -> None:
    (segment,) = segments([X - Y], BLOCK, Budget(60))
    bound = replace(segment, equal=(A,))
    for one, polys in ((segment, (X - Y,)), (bound, (RING.constant(0),))):
        assert with_faithful([one], polys, (), Budget(60))[0].faithful == one.elements


def test_minimal_polynomials_of_constants_belong_to_the_ideal() -> None:
    """b stands for the square root of 2: where nothing else vanishes, the elements themselves are faithful."""
    polys, modulus = (A * X - B, A * Y - 1), B**2 - 2
    generic, *_, special = with_faithful(
        list(segments(polys, BLOCK, Budget(60), equal=(modulus,))), polys, (modulus,), Budget(60)
    )
    assert generic.faithful == generic.elements
    assert special.faithful is not None and all(in_ideal(f, (*polys, modulus)) for f in special.faithful)

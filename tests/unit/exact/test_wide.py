"""Polynomials in rings with many variables do what those in a ring of their own variables do."""

import pickle
from fractions import Fraction
from math import prod

from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.ring import WIDE, Poly, Ring, format_poly
from qe.exact.wide import LinearPoly, WidePoly

BIG = Ring.of(f"y{i}" for i in range(2 * WIDE))
NAMES = ("y3", f"y{WIDE - 1}", f"y{WIDE}", f"y{2 * WIDE - 1}")
SMALL = Ring.of(NAMES)
PLACES = tuple(BIG.index[name] for name in NAMES)
COEFFICIENTS = st.integers(-9, 9) | st.integers(-(10**40), 10**40)
EXPONENTS = st.tuples(*(st.integers(0, 2) for _ in NAMES))
POLYS = st.dictionaries(EXPONENTS, COEFFICIENTS, max_size=4).map(
    lambda terms: SMALL.from_terms({e: c for e, c in terms.items() if c})
)
RATIONALS = st.fractions(-5, 5, max_denominator=9)


def wide(small: Poly) -> Poly:
    made = small.convert(BIG)
    assert isinstance(made, WidePoly)
    return made


def same(small: Poly, large: Poly) -> None:
    """That the two are one polynomial, in every figure, and that the large one agrees with a plain one."""
    plain = Poly(BIG, large.p)  # what remembers nothing
    assert large.convert(SMALL) == small and small.convert(BIG) == large == plain
    assert hash(large) == hash(plain) and pickle.loads(pickle.dumps(large)) == large
    assert large.variables == plain.variables == tuple(PLACES[i] for i in small.variables)
    assert large.degrees == plain.degrees and large.terms() == plain.terms()
    assert [large.degree(i) for i in PLACES] == list(small.degrees)
    assert sorted(large.sparse_terms()) == sorted(plain.sparse_terms())
    assert format_poly(large) == format_poly(small) and large.is_constant == small.is_constant


@settings(max_examples=25)
@given(POLYS, POLYS, st.integers(-3, 3))
def test_arithmetic(f, g, number):
    large, other = wide(f), wide(g)
    same(f, large)
    same(f + g, large + other)
    same(f + (-f), large + (-large))
    same(f - g, large - other)
    same(f * g, large * other)
    same(number - f, number - large)
    same(number * f + number, number * large + number)
    same(f**2, large**2)
    same(f, large + Poly(BIG, other.p) - other)  # with one that remembers nothing


@settings(max_examples=25)
@given(POLYS, POLYS)
def test_algebra(f, g):
    large, other = wide(f), wide(g)
    if f and g:
        same(f.gcd(g * f), large.gcd(other * large))
    if f:
        (unit, parts), (large_unit, large_parts) = f.factors(), large.factors()
        assert unit == large_unit and [e for _, e in parts] == [e for _, e in large_parts]
        for (a, _), (b, _) in zip(parts, large_parts, strict=True):
            same(a, b)
        same(f.normal()[1], large.normal()[1])
        assert f.normal()[0] == large.normal()[0]
    for i, place in enumerate(PLACES):
        same(f.derivative(i), large.derivative(place))
        same(f.resultant(g, i), large.resultant(other, place))
        if f.degree(i):
            same(f.discriminant(i), large.discriminant(place))
        for a, b in zip(f.coefficients(i), large.coefficients(place), strict=True):
            same(a, b)


@settings(max_examples=25)
@given(POLYS, POLYS, st.tuples(*(RATIONALS for _ in NAMES)))
def test_substitution(f, g, values):
    large, other = wide(f), wide(g)
    point = [Fraction(0)] * BIG.size
    for place, value in zip(PLACES, values, strict=True):
        point[place] = value
    assert f.evaluate(values) == large.evaluate(point)
    for i, place in enumerate(PLACES):
        same(f.compose({i: g}), large.compose({place: other}))
        same(f.at_rational(i, values[i]), large.at_rational(place, values[i]))
        if f.variables == (i,):
            assert f.to_univariate(i) == large.to_univariate(place)
    assert large.at_rational(0, 3) == large
    put = large.at_rationals(dict(zip(PLACES, values, strict=True)))
    assert put.is_constant and (put.constant_value() if put else 0) * f.evaluate(values) >= 0
    assert bool(put) is bool(f.evaluate(values))


@settings(max_examples=10)
@given(st.lists(COEFFICIENTS.filter(bool), min_size=WIDE + 2, max_size=2 * WIDE), st.integers(-9, 9))
def test_a_polynomial_with_more_variables_than_are_few(coefficients, constant):
    """It called itself without an end where a point was put in."""
    linear = sum((BIG.gen(i) * c for i, c in enumerate(coefficients)), start=BIG.constant(constant))
    for f, degree in ((linear, 1), (linear * BIG.gen(0), 2)):
        plain = Poly(BIG, f.p)
        assert isinstance(f, WidePoly) and len(f.variables) == len(coefficients)
        assert f.terms() == plain.terms() and f.total_degree == degree
        point = [Fraction(i % 5, 1 + i % 3) for i in range(BIG.size)]
        assert f.evaluate(point) == plain.evaluate(point)
        for step in (1, 2):  # all variables, and half of them
            put = f.at_rationals({i: point[i] for i in range(0, BIG.size, step)})
            assert put.evaluate(point) * f.evaluate(point) > 0 or put.evaluate(point) == f.evaluate(point) == 0
        assert f.at_rational(1, Fraction(2, 3)) == plain.at_rational(1, Fraction(2, 3))
        assert f.gcd(f * 2) == plain.gcd(plain * 2)


@given(
    st.sampled_from((3, 40)),
    st.dictionaries(st.lists(st.integers(0, 39), max_size=4).map(tuple), st.integers(-9, 9).filter(bool), min_size=1),
)
def test_a_combination_of_products_of_names(size: int, terms: dict[tuple[int, ...], int]) -> None:
    """It is the sum of the products, in rings of many variables too, where its hash does not depend on the way."""
    ring = Ring.of([f"x{k}" for k in range(size)])
    by_names: dict[tuple[str, ...], int] = {}
    for indices, c in terms.items():
        by_names[tuple(sorted(ring.names[i % size] for i in indices))] = c
    total = ring.constant(0)
    for names, c in by_names.items():
        total += prod(map(ring.var, names), start=ring.constant(c))
    made = ring.combination(by_names)
    assert made == total and hash(made) == hash(total) and made.variables == total.variables
    assert made.normal() == total.normal() and made.degrees == total.degrees
    assert hash(-made) == hash(-total) and (-made).variables == total.variables


LINEAR = st.tuples(st.lists(COEFFICIENTS, min_size=4, max_size=4), COEFFICIENTS).map(
    lambda parts: sum((SMALL.gen(i) * c for i, c in enumerate(parts[0])), start=SMALL.constant(parts[1]))
)


@given(LINEAR, LINEAR, st.integers(-9, 9), RATIONALS)
def test_linear_forms_stay_lists(f, g, number, value):
    """So that as many dense ones as there are variables are read, sent to other processes and checked at all."""
    if f.is_constant:
        return
    large, other = wide(f), wide(g)
    for made in (large, pickle.loads(pickle.dumps(large)), large.normal()[1], number + large, -large, 3 * large):
        assert isinstance(made, LinearPoly) and "p" not in made.__dict__
    same(f + g, large + other)
    same(f - g, large - other)
    same(number - f, number - large)
    same(number - f, BIG.constant(number) - large)
    same(f + number, BIG.constant(number) + large)
    same(f * g, large * other)
    same(number * f, number * large)
    same(f * number, BIG.constant(number) * large)
    same(f.normal()[1], large.normal()[1])
    assert large.normal()[0] == f.normal()[0] and large.term_count() == f.term_count()
    assert large.height_bits() == f.height_bits()
    for i, place in enumerate(PLACES):
        assert len(f.coefficients(i)) == len(large.coefficients(place))
        for a, b in zip(f.coefficients(i), large.coefficients(place), strict=True):
            same(a, b)
        same(f.at_rational(i, value), large.at_rational(place, value))
    assert f.factors()[0] == large.factors()[0]
    same(f.factors()[1][0][0], large.factors()[1][0][0])

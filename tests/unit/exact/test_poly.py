"""Polynomials against their terms: what each operation means, worked out with dictionaries."""

import pickle
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.errors import BudgetExceeded, InternalError
from qe.exact.poly import Poly, Ring, format_poly

RING = Ring.of(("x", "y", "z"))
X, Y, Z = (RING.gen(i) for i in range(3))
TERMS = st.dictionaries(st.tuples(*[st.integers(0, 3)] * 3), st.integers(-9, 9).filter(bool), max_size=5)
POINT = st.tuples(*[st.fractions(-3, 3, max_denominator=4)] * 3)
FEW = settings(max_examples=15)


def value(terms: dict[tuple[int, ...], int], point: tuple[Fraction, ...]) -> Fraction:
    return sum((c * point[0] ** e[0] * point[1] ** e[1] * point[2] ** e[2] for e, c in terms.items()), Fraction(0))


@FEW
@given(TERMS, TERMS, POINT, st.integers(-3, 3))
def test_arithmetic(one: dict, other: dict, point: tuple[Fraction, ...], k: int) -> None:
    p, q = RING.from_terms(one), RING.from_terms(other)
    a, b = value(one, point), value(other, point)
    assert p.evaluate(point) == a
    for made, expected in (
        (p + q, a + b),
        (p - q, a - b),
        (p * q, a * b),
        (-p, -a),
        (p**2, a * a),
        (p + k, a + k),
        (k + p, a + k),
        (p - k, a - k),
        (k - p, k - a),
        (k * p, k * a),
        (p.compose({0: q, 2: X}), value(one, (b, point[1], point[0]))),
    ):
        assert made.evaluate(point) == expected
    assert not q or (p * q).exact_divide(q) == p
    assert (p * 6).exact_divide(3) == p + p
    assert (p == q) is (one == other) and (p != q or hash(p) == hash(q)) and bool(p) is bool(one)


@FEW
@given(TERMS, POINT)
def test_structure(terms: dict, point: tuple[Fraction, ...]) -> None:
    p = RING.from_terms(terms)
    assert dict(p.terms()) == terms and [e for e, _ in p.terms()] == sorted(terms, key=lambda e: e[::-1], reverse=True)
    assert p.sparse_terms() == [(tuple((i, k) for i, k in enumerate(e) if k), c) for e, c in p.terms()]
    assert RING.from_sparse(p.sparse_terms()) == p == pickle.loads(pickle.dumps(p))
    assert p.degrees == tuple(max((e[i] for e in terms), default=0) for i in range(3)) and p.degree(1) == p.degrees[1]
    assert p.variables == tuple(i for i in range(3) if p.degrees[i]) and p.level == max(p.variables, default=-1)
    assert p.is_constant is (not p.variables) and p.total_degree == max(map(sum, terms), default=0)
    assert p.term_count() == len(terms)
    assert p.height_bits() == max((abs(c).bit_length() for c in terms.values()), default=0)
    for i in range(3):
        parts = p.coefficients(i)
        assert sum((c * RING.gen(i) ** k for k, c in enumerate(parts)), start=RING.constant(0)) == p
        assert all(not c.degree(i) for c in parts) and (not p or p.leading(i) == parts[-1] != RING.constant(0))
        lower = {(*e[:i], e[i] - 1, *e[i + 1 :]): c * e[i] for e, c in terms.items() if e[i]}
        assert dict(p.derivative(i).terms()) == lower
        number = point[i]
        assert p.at_rational(i, number).evaluate(point) == p.evaluate(
            (*point[:i], number, *point[i + 1 :])
        ) * number.denominator ** (p.degree(i) if number.denominator > 1 else 0)
    for inside in ((0,), (1, 2), (2, 0), ()):
        collected = p.collected(inside)
        whole = RING.constant(0)
        for exponents, c in collected.items():
            assert c and not set(c.variables) & set(inside)
            for i, k in zip(inside, exponents, strict=True):
                c = c * RING.gen(i) ** k
            whole = whole + c
        assert whole == p
        assert set(p.coefficients_in(inside)) == set(collected.values())
        assert len(set(p.coefficients_in(inside))) == len(p.coefficients_in(inside))


@FEW
@given(TERMS, TERMS, TERMS)
def test_algebra(one: dict, other: dict, third: dict) -> None:
    p, q, r = (RING.from_terms(terms) for terms in (one, other, third))
    unit, primitive = p.normal()
    assert primitive * unit == p
    if p:
        assert primitive.normal() == (1, primitive) and (-p * 3).normal() == (-3 * unit, primitive)
        unit, factors = p.factors()
        whole = RING.constant(unit)
        for f, e in factors:
            assert f.factors() == (1, ((f, 1),)) and f.normal() == (1, f)
            whole = whole * f**e
        assert whole == p
    else:
        assert (unit, primitive) == (0, p)
    if p and r:
        common = (p * r).gcd(q * r)
        assert not common or (p * r).exact_divide(common) * common == p * r
        assert common.total_degree >= r.total_degree
    for i in range(3):
        if p and r and r.degree(i):
            assert not (p * r).resultant(r, i)
        degree = p.degree(i)
        parts = p.coefficients(i)
        image = sum((c * X**k * (Y + 1) ** (degree - k) for k, c in enumerate(parts)), start=RING.constant(0))
        assert p.at_quotient(i, X, Y + 1) == image


def test_resultants_and_discriminants() -> None:
    quadratic = X * Z**2 + Y * Z + 7
    assert quadratic.discriminant(2) == Y**2 - 28 * X
    assert (Z - X).resultant(Z - Y, 2).normal()[1] == (Y - X).normal()[1]
    assert X.resultant(Y, 2) == RING.constant(1) and X.resultant(Z**3 - Y, 2) == X**3
    assert (Z**3 - Y).resultant(X, 2) == X**3
    assert [int(c) for c in (3 * Z**2 - 5).to_univariate(2)] == [-5, 0, 3]


@given(TERMS, st.permutations("wxyz"), st.integers(0, 1))
def test_another_ring_has_the_same_terms(terms: dict, order: list[str], spare: int) -> None:
    """Also in a ring of as many variables in another order, of which FLINT has the same context."""
    p = RING.from_terms(terms)
    there = Ring.of([name for name in order if spare or name != "w"])
    by_name = {frozenset((n, k) for n, k in zip("xyz", e, strict=True) if k): c for e, c in p.terms()}
    moved = p.convert(there)
    assert by_name == {frozenset((n, k) for n, k in zip(there.names, e, strict=True) if k): c for e, c in moved.terms()}
    assert moved.convert(RING) == p and hash(moved.convert(RING)) == hash(p)


def test_other_rings() -> None:
    wider = Ring.of(("z", "w", "x", "y"))
    moved = (X * Y**2 - 3 * Z).convert(wider)
    assert moved.terms() == (wider.var("x") * wider.var("y") ** 2 - 3 * wider.var("z")).terms()
    assert moved.ring is wider and moved.convert(RING) == X * Y**2 - 3 * Z and X.convert(RING) is X
    with pytest.raises(InternalError, match="not in"):
        (X + Y).convert(Ring.of(("x",)))
    for wrong in (Poly.__add__, Poly.__sub__, Poly.__mul__, Poly.gcd):
        with pytest.raises(InternalError, match="different rings"):
            wrong(X, wider.var("x"))
    assert wider.var("x") != X and Ring.of(iter("xyz")) is RING and pickle.loads(pickle.dumps(RING)) is RING
    with pytest.raises(InternalError, match="repeated"):
        Ring.of(("x", "x"))
    with pytest.raises(InternalError, match="negative"):
        RING.from_terms({(0, -1, 0): 1})


def test_a_ring_without_variables() -> None:
    empty = Ring.of(())
    seven = empty.from_terms({(): 7})
    assert seven.is_constant and seven.constant_value() == 7 and seven.evaluate(()) == 7 and seven.terms() == [((), 7)]
    assert seven.compose({}) is seven and empty.constant(0).terms() == [] and seven.degrees == ()


def test_text_and_limits() -> None:
    assert [format_poly(p) for p in (X**2 - 2 * X * Y + 1, -Z, RING.constant(0))] == ["x^2 - 2*x*y + 1", "-z", "0"]
    assert repr(X - 1) == "Poly(x - 1)" and format_poly(X * Y, str.upper) == "X*Y"
    wide = sum((X**i * Y**j for i, j in product(range(4), repeat=2)), start=RING.constant(0))
    assert wide.at_quotient(0, Z + Y, Z - 2, most_terms=1000) == wide.at_quotient(0, Z + Y, Z - 2)
    with pytest.raises(BudgetExceeded, match="grows too large"):
        wide.at_quotient(0, Z + Y, Z - 2, most_terms=20)
    stored = RING.cache
    assert RING.remembered("a key", lambda: 1) == RING.remembered("a key", lambda: 2) == 1
    assert stored["a key"] == 1

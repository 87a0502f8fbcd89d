"""Gröbner bases modulo primes and from them, of packed exponents, of ideals that are translated."""

from fractions import Fraction

import pytest
from flint import fmpz_mpoly_ctx, fmpz_mpoly_vec
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.errors import Unable
from qe.exact import modular_groebner
from qe.exact.block_order import BlockOrder, parametric_basis
from qe.exact.groebner import Limits, MonomialOrder, groebner_basis
from qe.exact.modular_groebner import FIRST_PRIME, Work, _fraction, _is_basis, modular_basis
from qe.exact.packed import PackedMonomials
from qe.exact.quotient import Quotient
from qe.exact.ring import Poly, Ring
from tests.strategies import polynomials, rationals
from tests.tables import each
from tests.unit.exact.famous_systems import Terms, cyclic, katsura

# Bases by F4 modulo primes: the same as FLINT's, proved over Q, and used where FLINT's algorithm gets long.

LONG = Limits(elements=600, terms=4000, bits=40_000, modular=True)


def in_ring(polys: list[Terms]) -> list[Poly]:
    width = len(next(iter(polys[0])))
    ring = Ring.of(tuple(f"u{k}" for k in range(width)))
    return [ring.from_terms(p) for p in polys]


def reduced(polys: list[dict[tuple[int, ...], int]], size: int) -> set[str]:
    """The reduced basis of what has to be a basis, as text."""
    context = fmpz_mpoly_ctx.get([f"v{k}" for k in range(size)], "degrevlex")
    found = fmpz_mpoly_vec([context.from_dict(p) for p in polys], context)
    assert found.is_groebner()
    return {str(g) for g in found.autoreduction(groebner=True)}


def plain_reduced(polys: list[Terms], size: int) -> set[str]:
    context = fmpz_mpoly_ctx.get([f"v{k}" for k in range(size)], "degrevlex")
    found = fmpz_mpoly_vec([context.from_dict(p) for p in polys], context).buchberger_naive()
    return {str(g) for g in found.autoreduction(groebner=True)}


@each(katsura(3), katsura(4), cyclic(4), cyclic(5))
def test_known_systems(polys: list[Terms]) -> None:
    size = len(next(iter(polys[0])))
    assert reduced(modular_basis(polys, size), size) == plain_reduced(polys, size)


BIG = st.one_of(st.integers(-3, 3), st.sampled_from([FIRST_PRIME, -FIRST_PRIME, FIRST_PRIME + 1, 10**30])).filter(bool)
POLYS = st.lists(
    st.dictionaries(st.tuples(*(st.integers(0, 2),) * 3), BIG, min_size=1, max_size=4), min_size=1, max_size=3
)


@settings(max_examples=60)
@given(POLYS)
def test_what_flint_finds(polys: list[Terms]) -> None:
    """Also where a coefficient vanishes modulo the first prime, or grows."""
    assert reduced(modular_basis(polys, 3), 3) == plain_reduced(polys, 3)


def test_solutions_that_go_to_infinity_modulo_the_first_prime() -> None:
    # x*(p*x - 1), x*(x - y): modulo p the only solutions have x = 0
    polys: list[Terms] = [{(2, 0): FIRST_PRIME, (1, 0): -1}, {(2, 0): 1, (1, 1): -1}, {(0, 2): 1, (0, 1): -1}]
    assert reduced(modular_basis(polys, 2), 2) == plain_reduced(polys, 2)


def test_polynomials_that_are_one_modulo_the_first_prime() -> None:
    polys: list[Terms] = [{(1, 0): 1, (0, 1): 1}, {(1, 0): 1, (0, 1): FIRST_PRIME + 1}]
    assert reduced(modular_basis(polys, 2), 2) == {"v0", "v1"}


def test_a_candidate_that_is_no_basis_is_refused() -> None:
    polys = katsura(3)
    monomials = PackedMonomials(5, 20)
    given_ = [modular_groebner._homogeneous(p, monomials) for p in polys]
    context = fmpz_mpoly_ctx.get([f"v{k}" for k in range(5)], "degrevlex")
    vector = fmpz_mpoly_vec(
        [context.from_dict({monomials.exponents(m): c for m, c in g.items()}) for g in given_], context
    )
    right = [{tuple(map(int, e)): int(c) for e, c in g.terms()} for g in vector.buchberger_naive()]
    assert _is_basis(right, given_, monomials)
    for k, g in enumerate(right):
        for e in g:
            wrong = [*right[:k], {**g, e: g[e] + 1}, *right[k + 1 :]]
            assert not _is_basis(wrong, given_, monomials)
    assert not _is_basis(right[1:], given_, monomials)
    # a basis of a larger ideal is not told from the right one here: the leading monomials modulo a prime do that


@given(st.integers(-(10**6), 10**6), st.integers(1, 10**6))
def test_fractions_come_back(top: int, bottom: int) -> None:
    modulus = FIRST_PRIME * 67108837 * 67108819
    value = Fraction(top, bottom)
    residue = value.numerator * pow(value.denominator, -1, modulus) % modulus
    assert _fraction(residue, modulus) == (value.numerator, value.denominator)


def test_the_limits_of_work() -> None:
    with pytest.raises(Unable, match="past its limits"):
        modular_basis(katsura(4), 5, Work(learning=1000))
    with pytest.raises(Unable, match="coefficients"):
        modular_basis(katsura(4), 5, Work(following=1000))


def test_cyclic_six_is_found_where_it_was_out_of_reach() -> None:
    polys = in_ring(cyclic(6))
    assert groebner_basis(polys, limits=Limits(elements=150, terms=1000, bits=1000)) is None
    basis = groebner_basis(polys, limits=LONG)
    assert basis is not None and len(basis.polys) == 45
    assert Quotient(basis).size == 156
    assert all(basis.contains(p) for p in polys)


def test_lexicographic_bases_by_change_of_order() -> None:
    polys = in_ring(katsura(4))
    basis = parametric_basis(polys, BlockOrder(tuple(range(5)), (), MonomialOrder.LEX))
    assert sorted(len(p.variables) for p in basis) == [1, 2, 2, 2, 2]
    graded = groebner_basis(polys, limits=LONG)
    assert graded is not None and all(graded.contains(p) for p in basis)


@pytest.mark.deep
def test_katsura_seven() -> None:
    basis = groebner_basis(in_ring(katsura(7)), limits=LONG)
    assert basis is not None and Quotient(basis).size == 128


@pytest.mark.deep
@settings(max_examples=500)
@given(POLYS)
def test_what_flint_finds_often(polys: list[Terms]) -> None:
    assert reduced(modular_basis(polys, 3), 3) == plain_reduced(polys, 3)


# Packed monomials: products, order, divisibility, least common multiples.

MONOMIALS = PackedMonomials(4, 12)
EXPONENTS = st.tuples(*(st.integers(0, 9),) * 4)
packed = MONOMIALS.packed


@given(EXPONENTS, EXPONENTS)
def test_integers_behave_as_the_monomials_do(a: tuple[int, ...], b: tuple[int, ...]) -> None:
    key = MonomialOrder.DEGREVLEX.key
    assert MONOMIALS.exponents(packed(a)) == a and MONOMIALS.degree(packed(a)) == sum(a)
    assert packed(a) + packed(b) == packed([i + j for i, j in zip(a, b, strict=True)])
    assert (packed(a) < packed(b)) == (key(a) < key(b))
    assert MONOMIALS.exponents(MONOMIALS.lcm(packed(a), packed(b))) == tuple(map(max, a, b))
    divides = all(i <= j for i, j in zip(a, b, strict=True))
    assert MONOMIALS.divides(MONOMIALS.fields(packed(a)), MONOMIALS.fields(packed(b))) == divides
    assert MONOMIALS.are_coprime(packed(a), packed(b)) == (not any(i and j for i, j in zip(a, b, strict=True)))


def test_a_degree_that_does_not_fit() -> None:
    assert packed((1023, 0, 0, 0))
    with pytest.raises(Unable):
        packed((1000, 0, 0, 24))


# Polynomials with numbers put in.

RING = Ring.of(("x", "y", "z"))
POINT = st.tuples(rationals(), rationals(), rationals())


@given(polynomials(RING, max_degree=3), st.dictionaries(st.integers(0, 2), rationals()), POINT)
def test_numbers_put_in(p: Poly, values: dict[int, Fraction], at: tuple[Fraction, ...]) -> None:
    found = p.at_rationals(values)
    there = p.evaluate([values.get(i, v) for i, v in enumerate(at)])
    here = found.evaluate(list(at))
    assert (here > 0) - (here < 0) == (there > 0) - (there < 0)
    assert not {*values} & {*found.variables}

"""The Groebner engine: reduced bases, normal forms with their scalar, elimination blocks, limits."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.errors import InternalError
from qe.exact.groebner import Limits, MonomialOrder, groebner_basis
from qe.exact.quadratic_form import independent_rows
from qe.exact.ring import Poly, Ring
from qe.rules.equations import combined
from tests.strategies import polynomials

RING = Ring.of(("x", "y", "z"))
x, y, z = (RING.gen(i) for i in range(3))


def small() -> st.SearchStrategy[Poly]:
    exponents = st.tuples(*[st.integers(0, 2)] * 3)
    return st.dictionaries(exponents, st.integers(-3, 3), min_size=1, max_size=3).map(RING.from_terms)


def test_cyclic_3() -> None:
    basis = groebner_basis([x + y + z, x * y + y * z + z * x, x * y * z - 1])
    assert basis is not None
    assert set(basis.polys) == {x + y + z, x**2 + x * y + y**2, x**3 - 1}
    assert not basis.is_unit
    assert basis.contains(y**3 - 1) and not basis.contains(x - 1)


def test_contradiction() -> None:
    basis = groebner_basis([x - y, x - y - 1])
    assert basis is not None and basis.is_unit


def test_elimination_block() -> None:
    ring = Ring.of(("u", "v", "x", "y", "z"))
    u, v, a, b, c = (ring.gen(i) for i in range(5))
    basis = groebner_basis([a - u * v, b - u**2, c - v**2], variables=(0, 1, 2, 3, 4), heavy=2)
    assert basis is not None
    assert basis.free_of((0, 1)) == ((b * c - a**2).normal()[1],)


def test_lexicographic_order_is_triangular() -> None:
    basis = groebner_basis([x**2 + y**2 - 4, x * y - 1], variables=(0, 1), order=MonomialOrder.LEX)
    assert basis is not None
    assert basis.free_of((0,)) == (y**4 - 4 * y**2 + 1,)


def test_limits_stop_it() -> None:
    hard = [x**5 + y**4 + z**3 - 1, x**3 + y**3 + z**2 - 1, x * y**3 * z - x**4 - 7]
    assert groebner_basis(hard, limits=Limits(4, 10, 20)) is None


def test_unknown_variables_are_refused() -> None:
    basis = groebner_basis([x - 1, x**2 - y], variables=(0, 1))
    assert basis is not None
    with pytest.raises(InternalError):
        basis.reduce(z)


@settings(max_examples=60, deadline=None)
@given(st.lists(small(), min_size=1, max_size=3), small(), st.lists(small(), min_size=3, max_size=3))
def test_normal_forms(generators: list[Poly], poly: Poly, factors: list[Poly]) -> None:
    """Members reduce to 0; s*p - r is a member; p and p + member have proportional normal forms."""
    if not any(generators):
        return
    basis = groebner_basis(generators, variables=(2, 1, 0), limits=Limits(40, 100, 300))
    if basis is None:
        return
    member = sum((g * f for g, f in zip(generators, factors, strict=False)), RING.constant(0))
    assert basis.contains(member)
    scale, rest = basis.reduce(poly)
    assert scale != 0 and basis.contains(poly * scale - rest)
    other_scale, other = basis.reduce(poly + member)
    assert rest * other_scale == other * scale


def test_value_on_the_variety() -> None:
    basis = groebner_basis([x**2 - y, y * x - 8], variables=(0, 1))
    assert basis is not None
    p = 3 * x**5 - y**2 * x + 7
    scale, rest = basis.reduce(p)
    at = (Fraction(2), Fraction(4), Fraction(0))
    assert rest.evaluate(at) == scale * p.evaluate(at)


@given(st.lists(polynomials(Ring.of(("x", "y", "z")), max_degree=3, max_terms=5), min_size=1, max_size=4))
def test_linear_combinations_span_the_same_space(given_polys: list[Poly]) -> None:
    polys = [p for p in given_polys if p]
    if not polys:
        return
    made = combined(polys)
    monomials = sorted({e for p in polys for e, _ in p.terms()})

    def rank(listing: list[Poly]) -> int:
        return len(independent_rows([[Fraction(dict(p.terms()).get(e, 0)) for e in monomials] for p in listing]))

    assert {e for p in made for e, _ in p.terms()} <= set(monomials)
    assert len(made) == rank(list(made)) == rank(polys) == rank([*polys, *made])

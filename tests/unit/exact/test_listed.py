"""Polynomials whose terms are known are those that FLINT has."""

from hypothesis import given

from qe.exact.listed import ListedPoly, combination
from qe.exact.ring import Poly, Ring
from tests.unit.exact.test_wide import BIG, NAMES, POLYS, same


def names_of(small: Poly) -> dict[tuple[str, ...], int]:
    return {tuple(sorted(NAMES[i] for i, k in powers for _ in range(k))): c for powers, c in small.sparse_terms()}


@given(POLYS)
def test_they_are_the_polynomials_with_these_terms(small: Poly) -> None:
    if not small:
        return
    made = [combination(BIG, names_of(small)) for _ in range(2)]
    assert isinstance(made[0], ListedPoly) and "p" not in made[0].__dict__
    (unit, primitive), (plain_unit, plain) = made[0].normal(), small.convert(BIG).normal()
    assert unit == plain_unit and hash(primitive) == hash(plain) and "p" not in primitive.__dict__
    assert primitive == plain and made[0].variables == small.convert(BIG).variables
    assert (made[0].total_degree, made[0].term_count(), bool(made[0])) == (small.total_degree, small.term_count(), True)
    same(small, made[1])
    same(small + 1, made[1] + 1)


def test_few_names_have_a_plain_ring() -> None:
    ring = Ring.of(("x", "y"))
    assert combination(ring, {("x", "y"): 2, (): -1}) == 2 * ring.var("x") * ring.var("y") - 1

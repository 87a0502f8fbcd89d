"""The criteria of Gebauer and Möller keep enough pairs: what passes with them is a Groebner basis."""

from flint import fmpz_mpoly_ctx, fmpz_mpoly_vec
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.critical_pairs import CriticalPairs
from qe.exact.modular_groebner import _is_basis
from qe.exact.packed import PackedMonomials

MONOMIALS = PackedMonomials(3, 14)
CONTEXT = fmpz_mpoly_ctx.get(["v0", "v1", "v2"], "degrevlex")
EXPONENTS = st.tuples(*(st.integers(0, 2),) * 3)
BINOMIALS = st.dictionaries(EXPONENTS, st.sampled_from([1, -1]), min_size=1, max_size=2)


@settings(max_examples=150)
@given(st.lists(BINOMIALS, min_size=2, max_size=5), st.integers(0, 9), st.randoms(use_true_random=False))
def test_the_pairs_that_are_kept_tell_bases_from_others(polys, left_out, random) -> None:  # type: ignore[no-untyped-def]
    """Bases, bases without one element, and what was given, in any order."""
    given_ = [CONTEXT.from_dict(p) for p in polys]
    basis = list(fmpz_mpoly_vec(given_, CONTEXT).buchberger_naive())
    random.shuffle(basis)
    for found in (given_, basis, [g for k, g in enumerate(basis) if k != left_out % len(basis)]):
        if found:
            terms = [{tuple(map(int, e)): int(c) for e, c in g.terms()} for g in found]
            assert _is_basis(terms, [], MONOMIALS) == fmpz_mpoly_vec(found, CONTEXT).is_groebner()


def test_pairs_of_one_degree_are_taken_together() -> None:
    pairs = CriticalPairs(MONOMIALS)
    for exponents in ((2, 0, 0), (1, 1, 0), (0, 1, 1)):
        pairs.add(MONOMIALS.packed(exponents))
    first, second = (MONOMIALS.packed(e) for e in ((1, 1, 1), (2, 1, 0)))
    assert pairs.taken() == [(second, 0, 1), (first, 1, 2)] and not pairs.pairs


def test_leading_monomials_that_are_multiples_of_later_ones_are_dead() -> None:
    pairs = CriticalPairs(MONOMIALS)
    for exponents in ((2, 1, 0), (0, 0, 2), (1, 0, 0)):
        pairs.add(MONOMIALS.packed(exponents))
    assert pairs.alive == [1, 2]

"""F4 modulo primes: what is learned with one prime holds for others, and gives what Buchberger's algorithm gives."""

from dataclasses import replace

import pytest
from flint import nmod_mpoly_ctx

from qe.errors import Unable
from qe.exact.f4 import Trace, Unlucky, learned
from qe.exact.packed import PackedMonomials
from tests.tables import each
from tests.unit.exact.famous_systems import Terms, cyclic, katsura

PRIMES = (67108859, 67108837, 67108819)


def homogeneous(polys: list[Terms], monomials: PackedMonomials) -> list[dict[int, int]]:
    found = []
    for p in polys:
        degree = max(map(sum, p))
        found.append({monomials.packed((*e, degree - sum(e))): c for e, c in p.items()})
    return found


@each(katsura(3), cyclic(4))
def test_every_prime_has_a_groebner_basis_of_the_ideal(polys: list[Terms]) -> None:
    monomials = PackedMonomials(len(next(iter(polys[0]))) + 1, 16)
    given = homogeneous(polys, monomials)
    trace = learned(given, monomials, PRIMES[0], 10**9)
    values = [[c for _, c in sorted(g.items(), reverse=True)] for g in given]
    tails, good = trace.followed(values, PRIMES)
    assert good == [True] * 3
    for k, p in enumerate(PRIMES):
        context = nmod_mpoly_ctx.get([f"v{i}" for i in range(monomials.size)], modulus=p, ordering="degrevlex")
        basis = []
        for head, monomials_of, numbers in zip(trace.heads, trace.tails, tails, strict=True):
            terms = {monomials.exponents(m): int(c) for m, c in zip(monomials_of, numbers[:, k], strict=True)}
            basis.append(context.from_dict({monomials.exponents(head): 1, **terms}))
        assert _reduces_to_zero(
            basis, [context.from_dict({monomials.exponents(m): c % p for m, c in g.items()}) for g in given]
        )
        pairs = [(f, g) for i, f in enumerate(basis) for g in basis[:i]]
        assert _reduces_to_zero(basis, [_s_polynomial(f, g, context) for f, g in pairs])


def _s_polynomial(f, g, context):  # type: ignore[no-untyped-def]
    a, b = ([int(e) for e in p.monomial(0)] for p in (f, g))
    top = [max(i, j) for i, j in zip(a, b, strict=True)]
    left, right = (context.from_dict({tuple(t - e for t, e in zip(top, m, strict=True)): 1}) for m in (a, b))
    return left * f - right * g


def _reduces_to_zero(basis, polys) -> bool:  # type: ignore[no-untyped-def]
    """By division with remainder, term by term, with code of its own."""
    leads = [tuple(int(e) for e in g.monomial(0)) for g in basis]
    for p in polys:
        while p:
            top = tuple(int(e) for e in p.monomial(0))
            fitting = [k for k, lead in enumerate(leads) if all(a <= b for a, b in zip(lead, top, strict=True))]
            if not fitting:
                return False
            shift = tuple(b - a for a, b in zip(leads[fitting[0]], top, strict=True))
            p = p - basis[fitting[0]] * p.context().from_dict({shift: int(p.coefficient(0))})
    return True


def test_primes_that_do_not_fit_are_told() -> None:
    monomials = PackedMonomials(3, 12)
    x, y = monomials.packed((1, 0, 0)), monomials.packed((0, 1, 0))
    p = PRIMES[0]
    with pytest.raises(Unlucky):
        learned([{x: p, y: 1}], monomials, p, 10**6)
    # x + y and x + (q + 1)*y: modulo q they are one polynomial, modulo p they are two
    given = [{x: 1, y: 1}, {x: 1, y: PRIMES[1] + 1}]
    trace = learned(given, monomials, p, 10**6)
    _, good = trace.followed([[1, 1], [1, PRIMES[1] + 1]], PRIMES[1:])
    assert good == [False, True]


def test_entries_where_the_first_prime_had_none_are_seen() -> None:
    monomials = PackedMonomials(5, 16)
    given = homogeneous(katsura(3), monomials)
    trace = learned(given, monomials, PRIMES[0], 10**9)
    values = [[c for _, c in sorted(g.items(), reverse=True)] for g in given]
    for k, step in enumerate(trace.steps):
        longest = max(range(len(step.supports)), key=lambda j: len(step.supports[j]))
        shorter = [c[:-1] if j == longest else c for j, c in enumerate(step.supports)]
        steps = [*trace.steps[:k], replace(step, supports=tuple(shorter)), *trace.steps[k + 1 :]]
        with pytest.raises(Unlucky):
            Trace(steps, trace.heads, trace.tails).followed(values, PRIMES)


def test_the_work_is_limited() -> None:
    monomials = PackedMonomials(6, 16)
    with pytest.raises(Unable):
        learned(homogeneous(katsura(4), monomials), monomials, PRIMES[0], 10_000)

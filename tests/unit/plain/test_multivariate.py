"""Polynomials in several variables in plain Python are those of FLINT."""

import random

import flint
import pytest

import qe.plain.flint as plain
from tests.tables import each
from tests.unit.plain.compared import factors, same, shown, terms


@each(
    lambda p, q, r: p + q,
    lambda p, q, r: p - q,
    lambda p, q, r: 7 - p * 2 + q,
    lambda p, q, r: p * q,
    lambda p, q, r: -p,
    lambda p, q, r: p**3,
    lambda p, q, r: p**0,
    lambda p, q, r: p / q,
    lambda p, q, r: p / 3,
    lambda p, q, r: p * q / q,
    lambda p, q, r: divmod(p, q),
    lambda p, q, r: divmod(p * q * q, q),
    lambda p, q, r: p.gcd(q),
    lambda p, q, r: (p * r).gcd(q * r),
    lambda p, q, r: p.derivative(0),
    lambda p, q, r: p.primitive(),
    lambda p, q, r: p.content(),
    lambda p, q, r: [p.degrees(), p.total_degree(), p.is_constant(), p.leading_coefficient(), len(p), p.coeffs()],
    lambda p, q, r: [p == q, p == p * 1, bool(p), p - p == 0],
    lambda p, q, r: p.subs({0: 3}),
    lambda p, q, r: p.subs({2: 0}),
    lambda p, q, r: p(2, -3, 5),
    lambda p, q, r: p.compose(q, r, q, ctx=q.context()),
    lambda p, q, r: p.resultant(q, 1) if min(p.degrees()[1], q.degrees()[1]) > 0 else 0,
    lambda p, q, r: (p * r).resultant(q * r, 0) if min((p * r).degrees()[0], (q * r).degrees()[0]) > 0 else 0,
    lambda p, q, r: p.discriminant(2) if p.degrees()[2] > 0 else 0,
    lambda p, q, r: (p * r).discriminant(2) if (p * r).degrees()[2] > 0 else 0,
)
def test_operations(operation) -> None:
    rng = random.Random(1)
    for _ in range(40):
        assert same(operation, *(terms(rng, 3, count, 2) or {(0, 0, 0): 0} for count in (5, 4, 3)))


def test_other_contexts() -> None:
    """Into more variables and into fewer, as ``Ring`` does it: never where the context stays."""
    rng = random.Random(2)
    for _ in range(40):
        given = terms(rng, 3, 5, 2)
        used = [i for i in range(3) if any(e[i] for e in given)]
        places = dict(zip(used, rng.sample(range(5), len(used)), strict=True))
        results = []
        for lib in (flint, plain):
            here, there = (lib.fmpz_mpoly_ctx.get(tuple(f"v{i}" for i in range(n)), "lex") for n in (3, 5))
            moved = here.from_dict(given).project_to_context(there, places)
            back = moved.project_to_context(here, {k: i for i, k in places.items()})
            results.append(shown([moved, back, here.from_dict(given)]))
        assert results[0] == results[1] and results[0][1] == results[0][2]


@each(1, 2, 3, 5)
def test_factors(variables: int) -> None:
    rng = random.Random(variables)
    for _ in range(25):
        sizes = ((4, 2), (3, 1), (2, 2))
        given = (terms(rng, variables, count, degree) or {(0,) * variables: 4} for count, degree in sizes)
        assert same(lambda p, q, r: factors(p * q * q * r), *given)


@pytest.mark.deep
def test_factors_of_many_products() -> None:
    rng = random.Random(7)
    for _ in range(5000):
        given = (terms(rng, 3, count, degree) or {(0, 0, 0): 1} for count, degree in ((6, 3), (4, 2), (3, 2)))
        assert same(lambda p, q, r: factors(p * q * r * r), *given)


def test_factors_whose_leading_coefficients_share_factors() -> None:
    """The product of (y*x^2 + a)(y*x^2 + b)(2*y*x + 1) with a, b in the other variables."""
    one = {(2, 1, 0): 1, (0, 0, 2): 1, (0, 0, 0): 1}
    two = {(2, 1, 0): 1, (0, 1, 1): -3, (0, 0, 0): -7}
    assert same(lambda p, q, r: factors(p * q * r), one, two, {(1, 1, 0): 2, (0, 0, 0): 1})


def test_values_and_parts_at_fractions() -> None:
    rng = random.Random(3)
    for _ in range(40):
        given = terms(rng, 3, 5, 3) or {(0, 0, 0): 1}
        point = [(rng.randint(-9, 9), rng.randint(1, 9)) for _ in range(3)]
        results = []
        for lib in (flint, plain):
            names = ("v0", "v1", "v2")
            p = lib.fmpz_mpoly_ctx.get(names, "lex").from_dict(given)
            q = lib.fmpq_mpoly(p, lib.fmpq_mpoly_ctx.get(names, "lex"))
            results.append([shown(q(*(lib.fmpq(*x) for x in point))), shown(q.subs({1: lib.fmpq(*point[1])}))])
        assert results[0] == results[1]


def test_exponents_out_of_reach_are_an_overflow_and_no_other_monomial() -> None:
    context = plain.fmpz_mpoly_ctx.get(("v0", "v1"), "lex")
    x, y = context.gens()
    big = y ** (2**31 - 1)
    assert big.degrees() == (0, 2**31 - 1)
    for wrong in (lambda: big * y, lambda: (big + x) * (big + 1), lambda: y ** (2**31)):
        with pytest.raises(OverflowError):
            wrong()
    with pytest.raises(OverflowError):
        context.from_dict({(0, 2**32): 1})
    assert divmod(x, big) == (0, x) and not divmod(x * big, big)[1]

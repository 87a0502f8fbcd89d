"""Polynomials in one variable, and numbers, in plain Python are those of FLINT."""

import random
from fractions import Fraction

import flint
import pytest

import qe.plain.flint as plain
from tests.tables import each
from tests.unit.plain.compared import coefficients, factors, number, same, shown


@each(
    lambda p, q: p + q,
    lambda p, q: p - q,
    lambda p, q: p * q,
    lambda p, q: -p,
    lambda p, q: p * 3 - 5 * q,
    lambda p, q: p.gcd(q),
    lambda p, q: (p * q).gcd(p * p),
    lambda p, q: divmod(p, q),
    lambda p, q: p // q,
    lambda p, q: p % q,
    lambda p, q: p / q,
    lambda p, q: p * q / q,
    lambda p, q: p.derivative(),
    lambda p, q: p(q),
    lambda p, q: [p.degree(), p.content(), p.leading_coefficient(), p.height_bits(), p[0], p[3], p[99]],
    lambda p, q: [p == q, p == p * 1, bool(p)],
)
def test_operations(operation) -> None:
    rng = random.Random(1)
    assert all(same(operation, coefficients(rng, 6), coefficients(rng, 4)) for _ in range(60))


def test_factors() -> None:
    rng = random.Random(2)
    for _ in range(60):
        assert same(lambda p, q, r: factors(p * q * q * r), *(coefficients(rng, d) for d in (5, 2, 3)))


@each(
    [1, 0, -10, 0, 1],
    [576, 0, -960, 0, 352, 0, -40, 0, 1],
    [-1] + [0] * 14 + [1],
    [0, 0, 0, 1],
    [-4, 0, 9],
    [2**80, 0, -(3**60)],
    [1] * 21,
)
def test_polynomials_that_split_modulo_every_prime_or_have_many_factors(given: list[int]) -> None:
    assert same(factors, given)


def test_values_at_fractions() -> None:
    rng = random.Random(3)
    for _ in range(60):
        p, q, given = number(rng), abs(number(rng)) + 1, coefficients(rng, 5)
        values = [lib.fmpz_poly(given)(lib.fmpq(p, q)) for lib in (flint, plain)]
        assert shown(values[0]) == shown(values[1])


def test_fractions_stay_fractions_of_their_kind() -> None:
    x, y = plain.fmpq(6, -4), plain.fmpq(1, 3)
    for value in (x + y, x - 1, 1 - x, x * y, 2 * x, x / y, 1 / x, -x, abs(x), x**2, x**-1, min(x, y)):
        assert isinstance(value, plain.fmpq)
    assert (x.p, x.q) == (-3, 2) and x < y and x == Fraction(-3, 2) and hash(x) == hash(Fraction(-3, 2))
    with pytest.raises(ZeroDivisionError):
        plain.fmpq(1, 0)


def test_determinants() -> None:
    rng = random.Random(4)
    for size in (0, 1, 2, 3, 5, 5, 5, 7):
        rows = [[rng.choice((0, 0, number(rng))) for _ in range(size)] for _ in range(size)]
        assert plain.fmpz_mat(rows).det() == int(flint.fmpz_mat(rows).det() if rows else 1)

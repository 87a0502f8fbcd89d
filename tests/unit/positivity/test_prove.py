"""Polynomials that are nowhere negative: each way, its identities multiplied out, and what must not be claimed."""

import builtins
import random
from fractions import Fraction
from itertools import permutations
from math import prod

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.io.text import read_polynomial
from qe.positivity import gram
from qe.positivity.binomials import binomial_squares
from qe.positivity.gram import sum_of_squares
from qe.positivity.identity import Positive
from qe.positivity.ordered import ordered_differences
from qe.positivity.prove import nowhere_negative
from tests.tables import each

RING = Ring.of(("x", "y", "z"))
EVERY = frozenset(range(3))
NOWHERE: frozenset[int] = frozenset()


def poly_of(text: str) -> Poly:
    return read_polynomial(text)[0].convert(RING)


def check(poly: Poly, proof: Positive, orthant: frozenset[int]) -> None:
    """The identities are identities, and the polynomial stands in the first ones with a negative number alone."""
    gens = {RING.gen(i) for i in orthant}
    for identity in proof.identities:
        total = RING.constant(0)
        for c, powers in identity.terms:
            term = RING.constant(c)
            for base, exponent in powers:
                term = term * base**exponent
            total = total + term
        assert not total
    (c, powers), *rest = proof.identities[0].terms
    assert c < 0 and powers == ((poly, 1),)
    assert all(c > 0 for c, _ in rest)
    if len(proof.identities) == 1:
        assert all(e % 2 == 0 or base in gens for _, powers in rest for base, e in powers)
        if proof.strict:
            assert any(not powers for _, powers in rest)


@each(
    ("x^4 + y^4 + z^4 + 1 - 4*x*y*z", NOWHERE, False),
    ("x^4 + y^4 + z^4 + 2 - 4*x*y*z", NOWHERE, True),
    ("x^4 - x^2 + 1", NOWHERE, True),
    ("(x + y)*(y + z)*(z + x) - 8*x*y*z", EVERY, False),
    ("x^3*z^2 + x - 2*x^2*z", frozenset({0}), False),
    ("x^2 + 2*x*y + y^2", NOWHERE, False),
)
def test_binomial_squares(text: str, orthant: frozenset[int], strict: bool) -> None:
    poly = poly_of(text)
    proof = binomial_squares(poly, orthant)
    assert proof is not None and proof.strict is strict
    check(poly, proof, orthant)


def exact(poly: Poly, proof: Positive, orthant: frozenset[int]) -> bool:
    """Whether a single identity gives the polynomial as a sum of squares times variables of the orthant."""
    (identity,), gens = proof.identities, {poly.ring.gen(i) for i in orthant}
    total = poly.ring.constant(0)
    for c, powers in identity.terms:
        total = total + prod((base**e for base, e in powers), start=poly.ring.constant(c))
    signs = all(c > 0 and all(e % 2 == 0 or b in gens for b, e in powers) for c, powers in identity.terms[1:])
    return not total and identity.terms[0][0] < 0 and identity.terms[0][1] == ((poly, 1),) and signs


@each(3, 4, 5, 6)
def test_the_arithmetic_mean_is_at_least_the_geometric_one(n: int) -> None:
    ring = Ring.of(tuple(f"x{i}" for i in range(n)))
    gens, everywhere = [ring.gen(i) for i in range(n)], frozenset(range(n))
    poly = sum(gens, ring.constant(0)) ** n - prod(gens, start=ring.constant(n**n))
    proof = binomial_squares(poly, everywhere)
    assert proof is not None and exact(poly, proof, everywhere)
    assert binomial_squares(poly - prod(gens, start=ring.constant(1)), everywhere) is None


def test_exchanges_that_do_not_keep_the_monomials_of_squares_are_not_used() -> None:
    """Where there are too many monomials some are left out, and what is left may be less symmetric."""
    text = """8*(a^4 + b^4 + c^4 + a^3*b + a*b^3 + a^3*c + b^3*c + a*c^3 + b*c^3 + a^3*d + b^3*d + c^3*d)
        - 4*(a^2*b*c + a*b^2*c + a*b*c^2) - a*b*c*d + a^2*b*d + a*b^2*d + a^2*c*d + b^2*c*d + a*c^2*d + b*c^2*d
        + a*b*d^2 + a*c*d^2 + b*c*d^2"""
    poly = read_polynomial(text)[0]
    everywhere = frozenset(range(4))
    proof = binomial_squares(poly, everywhere)
    assert proof is None or exact(poly, proof, everywhere)


@settings(max_examples=60, deadline=None)
@given(st.randoms(use_true_random=False))
def test_squares_of_symmetric_polynomials_add_up(rng: random.Random) -> None:
    """Monomials with all that exchanges of the first variables make of them, times signs at random."""
    size = rng.choice((3, 4, 4, 5))
    ring, degree = Ring.of(tuple(f"x{i}" for i in range(size))), rng.choice((3, 4))
    moved, poly = rng.choice((size, size - 1)), ring.constant(0)
    for c in [rng.randint(-4, 9) for _ in range(4)]:
        places = [rng.randrange(size) for _ in range(degree)]
        orders = permutations(range(moved))
        images = {tuple(sorted(order[k] if k < moved else k for k in places)) for order in orders}
        poly += sum((prod(map(ring.gen, image), start=ring.constant(c)) for image in images), ring.constant(0))
    everywhere = frozenset(range(size))
    proof = None if poly.is_constant else binomial_squares(poly, everywhere)
    assert proof is None or exact(poly, proof, everywhere)


@each(
    "x^3 + y^3 + z^3 - 3*x*y*z",
    "x^2*(x - y)*(x - z) + y^2*(y - x)*(y - z) + z^2*(z - x)*(z - y)",
    "x^2*y + y^2*z + z^2*x - 3*x*y*z",
)
def test_ordered_differences(text: str) -> None:
    poly = poly_of(text)
    proof = ordered_differences(poly, EVERY)
    assert proof is not None and not proof.strict and len(proof.identities) == 7
    check(poly, proof, EVERY)
    assert ordered_differences(poly, frozenset({0, 1})) is None
    assert ordered_differences(poly - RING.gen(0) ** 3, EVERY) is None


@each(
    ("2*x^4 + 2*x^3*y - x^2*y^2 + 5*y^4", False),
    ("(x^2 - y + 1)^2 + (x + y*z - 2)^2 + (z - 1)^2", False),
    ("(x^2 - y + 1)^2 + (x + y*z - 2)^2 + (z - 1)^2 + 1", True),
    ("(x^2 + y^2 + z^2)*(x^4*y^2 + x^2*y^4 + z^6 - 3*x^2*y^2*z^2)", False),
    ("x^4 - x^2*y^2 + 1/4*y^4", False),
)
def test_gram_matrices(text: str, strict: bool) -> None:
    pytest.importorskip("clarabel")
    poly = poly_of(text)
    proof = sum_of_squares(poly)
    assert proof is not None and proof.strict is strict
    check(poly, proof, NOWHERE)


@each(
    "x^4*y^2 + x^2*y^4 + 1 - 3*x^2*y^2 - 1/1000",  # below the Motzkin polynomial, which is 0 at (1, 1)
    "x^4 - 2*x^2 + 999/1000",
    "x*y*z",
    "x^3 + y^3",
    "-x^2 - y^2 - z^2",
    "x^2*y^2 - x",
)
def test_what_takes_negative_values(text: str) -> None:
    poly = poly_of(text)
    for prove in (lambda p: nowhere_negative(p, NOWHERE), sum_of_squares, lambda p: binomial_squares(p, NOWHERE)):
        assert prove(poly) is None


def cleared(terms: list[tuple[str, str]], bound: str) -> str:
    """The sum of the quotients less the bound, times all denominators."""
    product = "*".join(f"({bottom})" for _, bottom in terms)
    others = ("*".join(f"({b})" for j, (_, b) in enumerate(terms) if j != i) for i in range(len(terms)))
    return (
        " + ".join(f"({top})*{rest}" for (top, _), rest in zip(terms, others, strict=True)) + f" - ({bound})*{product}"
    )


@each(
    cleared([("2*a", "b + c"), ("2*b", "c + d"), ("2*c", "d + e"), ("2*d", "e + a"), ("2*e", "a + b")], "5"),  # Shapiro
    cleared(
        [("a^3", "b + c + d"), ("b^3", "c + d + a"), ("c^3", "d + a + b"), ("d^3", "a + b + c")], "(a + c)*(b + d)/3"
    ),
    "a^3*b^2*(a^2 + b^2 + c^2 + d^2 - a*b - b*c - c*d)",
)
def test_squares_times_products_of_variables(text: str) -> None:
    """Shapiro's inequality in five variables (Mitrinović 1970, 2.23), problem 24 of the shortlist of the International
    Mathematical Olympiad 1990, and a form times a monomial."""
    pytest.importorskip("clarabel")
    poly = read_polynomial(text)[0]
    everywhere = frozenset(range(poly.ring.size))
    proof = sum_of_squares(poly, everywhere)
    assert proof is not None
    assert exact(poly, proof, everywhere)
    assert sum_of_squares(poly - poly.ring.gen(0) ** poly.total_degree, everywhere) is None


@each(
    ("b^2*c^2 - b^2*a^2 - 2*b^2*c*x + b^2*x^2 + a^2*y^2", False),  # negative where c = x and y = 0
    ("13*x^3 + 38*x^2*y + 41*x*y^2 + 20*y^3 - x^2*z - 3*x*y*z - 2*y^2*z", True),  # negative for large z
)
def test_negative_values_are_seen_before_a_program_is_solved(
    text: str, signed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gram, "_inside", lambda *rest: pytest.fail("a program was solved"))
    poly = read_polynomial(text)[0]
    assert sum_of_squares(poly, frozenset(range(poly.ring.size)) if signed else NOWHERE) is None


@settings(deadline=None, max_examples=30, derandomize=True)
@given(st.integers(0, 10**9))
def test_no_sum_of_squares_is_claimed_where_a_value_is_negative(seed: int) -> None:
    """Forms with a zero inside the orthant, which turn negative beside it where a small multiple is taken away."""
    rng = random.Random(seed)
    squares = [random_poly(rng, 2, 4) ** 2 * RING.gen(rng.randrange(3)) for _ in range(2)]
    poly = sum(squares, RING.constant(0)) - RING.from_terms({(1, 1, 1): rng.randint(0, 3)})
    proof = sum_of_squares(poly, EVERY) if poly else None
    point = [Fraction(rng.randint(0, 9), rng.randint(1, 5)) for _ in range(3)]
    if proof is not None:
        check(poly, proof, EVERY)
        assert poly.evaluate(point) >= 0


def test_the_motzkin_polynomial_is_no_sum_of_squares() -> None:
    assert sum_of_squares(poly_of("x^4*y^2 + x^2*y^4 + z^6 - 3*x^2*y^2*z^2")) is None


def test_without_the_library_the_exact_ways_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def absent(name: str, *rest: object) -> object:
        if name == "clarabel":
            raise ImportError(name=name)
        return real(name, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(builtins, "__import__", absent)
    gram.sum_of_squares.cache_clear()
    assert sum_of_squares(poly_of("2*x^4 + 2*x^3*y - x^2*y^2 + 5*y^4 + z^4")) is None
    assert nowhere_negative(poly_of("x^4 + y^4 + z^4 + 5 - 4*x*y*z"), NOWHERE) is not None
    gram.sum_of_squares.cache_clear()


def random_poly(rng: random.Random, degree: int, terms: int) -> Poly:
    exponents = [tuple(rng.randint(0, degree) for _ in range(3)) for _ in range(terms)]
    return sum((RING.from_terms({e: rng.randint(-3, 3)}) for e in exponents if sum(e) <= degree), RING.constant(0))


@given(st.integers(0, 10**6), st.sets(st.integers(0, 2)))
def test_what_is_proved_has_no_negative_value(seed: int, orthant: set[int]) -> None:
    rng = random.Random(seed)
    squares = [random_poly(rng, 2, 3) ** 2 for _ in range(2)]
    poly = sum(squares, RING.constant(rng.randint(-1, 1))) + random_poly(rng, 4, 2)
    where = frozenset(orthant)
    for proof in (binomial_squares(poly, where), ordered_differences(poly, where), nowhere_negative(poly, where)):
        if proof is None:
            continue
        check(poly, proof, where)
        for _ in range(20):
            point = [rng.randint(-4, 4) for _ in range(3)]
            value = poly.evaluate([abs(v) if i in where else v for i, v in enumerate(point)])
            assert value > 0 if proof.strict else value >= 0


@settings(max_examples=10)
@given(st.integers(0, 10**6))
def test_sums_of_squares_are_found(seed: int) -> None:
    pytest.importorskip("clarabel")
    rng = random.Random(seed)
    poly = sum((random_poly(rng, 2, 4) ** 2 for _ in range(3)), RING.constant(1))
    poly = poly + RING.gen(0) ** 4 + RING.gen(1) ** 4 + RING.gen(2) ** 4
    proof = sum_of_squares(poly)
    assert proof is not None
    check(poly, proof, NOWHERE)

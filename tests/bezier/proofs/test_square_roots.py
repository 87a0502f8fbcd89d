"""The numbers of joint positions in certificates: square roots, nested ones, and angles that they bound."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import atan2, cos, pi, sin, sqrt
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bezier.arm.reader import read_exact
from bezier.arm.roots_of_squares import square_roots
from bezier.proofs import square_roots as sr
from bezier.proofs.families import bounded
from bezier.proofs.nested_roots import Nested, Place, nested, turns
from bezier.proofs.square_roots import ONE, Polynomial, Surd
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic

SURDS = st.lists(
    st.tuples(st.sampled_from([1, 2, 3, 5, 6, 10, 15, 293]), st.fractions(-9, 9, max_denominator=7)), max_size=4
)


@settings(max_examples=25)
@given(SURDS, SURDS)
def test_numbers(one: list[tuple[int, Fraction]], other: list[tuple[int, Fraction]]) -> None:
    a, b = Surd.of(one), Surd.of(other)
    x, y = (sum(float(q) * sqrt(d) for d, q in pairs) for pairs in (one, other))
    for exact, near in ((a + b, x + y), (a - b, x - y), (a * b, x * y)):
        assert abs(float(exact) - near) <= 1e-9
    if a:
        assert a * a.inverse() == ONE
        assert a.sign() == (1 if x > 0 else -1) or abs(x) < 1e-9
    assert (a - a).sign() == 0 and (a * b).sign() == a.sign() * b.sign()


def test_a_sign_that_is_hard_to_see() -> None:
    """sqrt 2 against a convergent of its continued fraction."""
    p, q = 1, 1
    for _ in range(120):
        p, q = p + 2 * q, p + q
    gap = Surd.of([(2, Fraction(1)), (1, -Fraction(p, q))])
    assert gap.sign() == (1 if p * p < 2 * q * q else -1)


@settings(max_examples=15)
@given(st.lists(st.integers(-4, 4), min_size=1, max_size=4), st.lists(st.integers(-4, 4), min_size=1, max_size=3))
def test_tarskis_query(roots: list[int], other: list[int]) -> None:
    p, s = Polynomial((ONE,)), Polynomial((ONE,))
    for r in roots:
        p = p * Polynomial((Surd.rational(-r), ONE))
    for r in other:
        s = s * Polynomial((Surd.of([(2, Fraction(-r))]), ONE))

    def sign(x: int) -> int:
        values = [x - r * sqrt(2) for r in other]
        return 0 if 0 in values else (-1) ** sum(v < 0 for v in values)

    assert sr.tarski(p, s) == sum(map(sign, set(roots)))
    inside = {r for r in roots if r > -1}
    half = Fraction(-1, 2), Fraction(9, 2)
    assert sr.tarski(p, s, half) == sum(map(sign, inside))
    assert sr.tarski(p * Polynomial((ONE, Surd(()), ONE)), Polynomial((ONE,))) == len(set(roots))


def test_a_large_square_under_a_square_root() -> None:
    """Three times the square of a large prime was not recognised: there was no certificate."""
    for large in (2**61 - 1, (2**61 - 1) * (2**89 - 1), 10**40 + 121):
        for d in (2, 3, 6):
            root = RealAlgebraic.from_root([-d * large * large, 0, 7], 0, large * 3)
            assert square_roots(root) == {7 * d: Fraction(large, 7)}


def test_coordinates_as_square_roots() -> None:
    assert square_roots(read_exact("44*sqrt(2) + 8*sqrt(293) + 120")) == {1: 120, 2: 44, 293: 8}
    assert square_roots(read_exact("1/3*sqrt(8) - 1/7")) == {1: Fraction(-1, 7), 2: Fraction(2, 3)}
    assert square_roots(read_exact("sqrt(2) + sqrt(3)/2 + sqrt(5) + 90")) == {1: 90, 2: 1, 3: Fraction(1, 2), 5: 1}
    quotient = square_roots(read_exact("1/(sqrt(2) + sqrt(3) + 1)"))
    assert quotient == {1: Fraction(1, 2), 2: Fraction(1, 4), 6: Fraction(-1, 4)}


@pytest.mark.parametrize(
    "coefficients", [[-2, 0, 0, 1], [2, 0, -4, 0, 1], [1, -3, 0, 1], [-2, 0, 0, 0, 1], [-1, -1, 0, 0, 1]]
)
def test_numbers_that_are_no_sums_of_square_roots(coefficients: list[int]) -> None:
    """A number without other real conjugates is no empty sum."""
    with pytest.raises(Unable, match="sums of square roots"):
        square_roots(RealAlgebraic.by_index(coefficients, 0))


def root(value: Nested) -> Nested:
    return max(value.square_roots(), key=lambda v: v.sign())


def test_roots_of_constants_are_told_apart() -> None:
    two, three = (root(nested(Surd.rational(k))) for k in (2, 3))
    assert (two * three - root(nested(Surd.rational(6)))).sign() == 0
    assert (two - three).sign() == -1 and (two * two - nested(Surd.rational(2))).sign() == 0


def test_a_nested_root_that_is_none() -> None:
    """sqrt(3 + 2 sqrt 2) = 1 + sqrt 2, and a number that is larger by 10^-200."""
    two = root(nested(Surd.rational(2)))
    whole = root(nested(Surd.rational(3)) + two.by(Surd.rational(2)))
    gap = whole - two - nested(ONE)
    assert gap.sign() == 0
    assert (gap + nested(Surd.rational(Fraction(1, 10**200)))).sign() == 1


@settings(max_examples=20)
@given(st.lists(st.integers(-3, 3), min_size=6, max_size=6))
def test_signs_over_a_root_of_a_polynomial(k: list[int]) -> None:
    """t = sqrt 2 + sqrt 3 as a root of t^4 - 10 t^2 + 1."""
    one, zero = ONE, Surd(())
    place = Place.of(Polynomial((one, zero, Surd.rational(-10), zero, one)), (Fraction(3), Fraction(4)))
    t = nested(place.value(Polynomial((zero, one))))
    m = root(t * t + t.unit)
    value = t.unit.by(Surd.rational(k[0])) + t.by(Surd.rational(k[1])) + (t * t * t).by(Surd.rational(k[2]))
    value = value * m.by(Surd.rational(k[3])) + t.by(Surd.rational(k[4])) + m.by(Surd.rational(k[5]))
    x = sqrt(2) + sqrt(3)
    y = sqrt(x * x + 1)
    near = (k[0] + k[1] * x + k[2] * x**3) * y * k[3] + k[4] * x + k[5] * y
    assert value.sign() == (0 if abs(near) < 1e-9 else 1 if near > 0 else -1)
    assert (value * value - value * value).sign() == 0


def test_zero_over_a_root_that_intervals_do_not_tell() -> None:
    one, zero = ONE, Surd(())
    squared = Polynomial((Surd.rational(-2), zero, one)) * Polynomial((Surd.rational(5), one))
    place = Place.of(squared, (Fraction(1), Fraction(2)))  # sqrt 2, though the modulus is not irreducible
    gap = nested(place.value(Polynomial((Surd.rational(-2), zero, one))))
    assert gap.sign() == 0 and next(iter(gap.square_roots())).sign() == 0


def test_turns() -> None:
    found: Sequence[Any] = list(turns(*(nested(Surd.rational(v)) for v in (1, 2, 2, 1))))
    assert len(found) == 2
    for joint in found:
        assert (joint.c + joint.s.by(Surd.rational(2)) - joint.w.by(Surd.rational(2))).sign() == 0
        assert (joint.c * joint.c + joint.s * joint.s - joint.w * joint.w).sign() == 0
    assert len(list(turns(*(nested(Surd.of([(d, Fraction(v))])) for d, v in ((1, 1), (1, 1), (2, 1), (1, 1)))))) == 1
    assert not list(turns(*(nested(Surd.rational(v)) for v in (1, 1, 3, 1))))


Payload = dict[str, Any]


@given(*[st.integers(-5, 5)] * 3, st.integers(1, 9))
def test_angles_with_a_bounded_wave(a: int, b: int, c: int, square: int) -> None:
    arcs = bounded(*(nested(Surd.rational(v)) for v in (a, b, c, square)))
    ends = [] if arcs is None else [[_direction(end) for end in arc] for arc in arcs]
    for k in range(24):
        angle = k * 2 * pi / 24 + 0.05
        value = abs(a * cos(angle) + b * sin(angle) + c) - sqrt(square)
        if abs(value) > 1e-9:
            held = arcs is None or any((angle - low) % (2 * pi) <= (high - low) % (2 * pi) for low, high in ends)
            assert held == (value < 0)


def _direction(joint: Any) -> float:
    c, s = (sum(map(float, ends)) / 2 for ends in joint.intervals() or ())
    return atan2(s, c)

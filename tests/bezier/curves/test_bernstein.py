"""Bernstein forms: rational numbers go through integers, all others through their own arithmetic, with one result."""

from __future__ import annotations

from fractions import Fraction
from math import comb

from hypothesis import given
from hypothesis import strategies as st

from bezier.curves import bernstein as bs
from bezier.curves.bernstein import exact, halves


class Plain:
    """A rational number that does not say so, as an element of a number field does not."""

    def __init__(self, value: Fraction | int) -> None:
        self.value = Fraction(value)

    def __add__(self, other: object) -> Plain:
        return Plain(self.value + _plain(other))

    def __sub__(self, other: object) -> Plain:
        return Plain(self.value - _plain(other))

    def __mul__(self, other: object) -> Plain:
        return Plain(self.value * _plain(other))

    def __neg__(self) -> Plain:
        return Plain(-self.value)

    def __lt__(self, other: object) -> bool:
        return self.value < _plain(other)

    def __gt__(self, other: object) -> bool:
        return self.value > _plain(other)

    def __eq__(self, other: object) -> bool:
        return self.value == _plain(other)

    def __bool__(self) -> bool:
        return bool(self.value)

    __radd__, __rmul__, __hash__ = __add__, __mul__, None


def _plain(value: object) -> Fraction:
    return value.value if isinstance(value, Plain) else Fraction(value)  # type: ignore[call-overload,no-any-return]


NUMBERS = st.one_of(st.integers(-9, 9), st.fractions(-50, 50, max_denominator=60), st.just(Fraction(10**40 + 1, 3**30)))
FORMS = st.lists(NUMBERS, min_size=1, max_size=7)
PARAMETERS = st.fractions(0, 1, max_denominator=12)


def hidden(form: list[Fraction]) -> list[Plain]:
    return [Plain(c) for c in form]


def shown(form: object) -> list[Fraction]:
    return [_plain(c) for c in form]  # type: ignore[attr-defined]


def defined(form: list[Fraction], t: Fraction) -> Fraction:
    n = len(form) - 1
    return sum((comb(n, k) * t**k * (1 - t) ** (n - k) * c for k, c in enumerate(form)), Fraction(0))


@given(FORMS, FORMS, PARAMETERS)
def test_both_ways_agree_with_the_definition(a: list[Fraction], b: list[Fraction], t: Fraction) -> None:
    assert bs.value(a, t) == defined(a, t) == _plain(bs.value(hidden(a), t))
    product = bs.multiply(a, b)
    assert len(product) == len(a) + len(b) - 1 and bs.value(product, t) == defined(a, t) * defined(b, t)
    assert list(product) == shown(bs.multiply(hidden(a), hidden(b)))
    for part, other, u in zip(bs.split(a, t), bs.split(hidden(a), t), (t / 2, t + (1 - t) / 2), strict=True):
        assert list(part) == shown(other) and len(part) == len(a)
        assert bs.value(part, Fraction(1, 2)) == defined(a, u)


@given(FORMS, st.integers(0, 9), PARAMETERS)
def test_raising_the_degree(a: list[Fraction], degree: int, t: Fraction) -> None:
    raised = bs.elevate(a, degree)
    assert len(raised) == max(len(a), degree + 1) and list(raised) == shown(bs.elevate(hidden(a), degree))
    assert defined(list(raised), t) == defined(a, t)


@given(FORMS, FORMS, PARAMETERS)
def test_power_forms(a: list[Fraction], b: list[Fraction], t: Fraction) -> None:
    power = bs.to_power(a)
    assert sum((c * t**k for k, c in enumerate(power)), Fraction(0)) == defined(a, t)
    assert not power or power[-1] != 0
    assert defined(list(bs.from_power(power)), t) == defined(a, t)
    assert list(bs.from_power(power)) == shown(bs.from_power(hidden(list(power))))
    assert list(bs.power_multiply(a, b)) == shown(bs.power_multiply(hidden(a), hidden(b)))
    assert bs.power_multiply(a, ()) == bs.power_multiply((), b) == ()


PLACES = [Fraction(k, 4) for k in range(5)]


def value(b, t: Fraction) -> Fraction:
    n = len(b) - 1
    return sum((comb(n, k) * t**k * (1 - t) ** (n - k) * c for k, c in enumerate(b)), Fraction(0))


@given(st.lists(st.integers(-9, 9), min_size=1, max_size=6))
def test_integers_stay_integers(b: list[int]) -> None:
    left, right = halves(tuple(b))
    factor = 2 ** (len(b) - 1)
    assert all(isinstance(c, int) for c in left + right)
    for t in PLACES:
        assert value(left, t) == factor * value(b, t / 2)
        assert value(right, t) == factor * value(b, (1 + t) / 2)


@given(st.lists(st.fractions(-3, 3, max_denominator=5), min_size=1, max_size=5))
def test_fractions_are_split_as_they_are(b: list[Fraction]) -> None:
    left, right = halves(tuple(b))
    for t in PLACES:
        assert value(left, t) == value(b, t / 2) and value(right, t) == value(b, (1 + t) / 2)


def test_integers_ready_for_division() -> None:
    found = exact((1, Fraction(1, 2), -3))
    assert found == (1, Fraction(1, 2), -3) and all(isinstance(c, Fraction) for c in found)

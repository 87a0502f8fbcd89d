"""Combinations found by the search for certificates: an identity, checked by arithmetic."""

from qe.exact.ring import Poly, Ring
from qe.options import Budget
from qe.proving.elimination_chain import chain, member
from tests.tables import each

RING = Ring.of(("a", "b", "x", "y"))
A, B, X, Y = (RING.var(name) for name in RING.names)


@each(
    (B**2 - A, [X**2 - A, X - B]),
    (X**3 - A * X, [X**2 - A]),
    (X * Y - B, [X - A, A * Y - B]),
    (RING.constant(1), [X, A * X - 1]),
    (X**2 + Y**2 - 1, [X - A, Y - B, A**2 + B**2 - 1]),
    (X * Y - B, [X - X, X - A, Y - Y, A * Y - B]),
)
def test_members_with_their_combination(target: Poly, generators: list[Poly]) -> None:
    found = member(target, generators, Budget(60))
    assert found is not None
    scale, factors = found
    total = sum((f * g for f, g in zip(factors, generators, strict=True)), RING.constant(0))
    assert scale and scale * target == total


@each((X, [X**2]), (A, [X - A]), (X * Y - 1, [X - Y]), (X, [X - X]))
def test_others_are_none(target: Poly, generators: list[Poly]) -> None:
    assert member(target, generators, Budget(60)) is None


def test_nothing_is_eliminated_from_a_polynomial_that_is_zero() -> None:
    """`bezier compare` ended with an internal error, where a curve lies on a bound of its interval."""
    assert chain([X - X, X - A], 2, bool, Budget(60)) is None

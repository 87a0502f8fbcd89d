"""One stack over a sample point, whole or restricted to a constraint; nullified factors."""

from fractions import Fraction

from qe.decomposition.stack import is_nullified, restricted_stack, stack_over
from qe.exact.algebraic import RealAlgebraic
from qe.exact.ring import Ring
from qe.exact.sample import Point

RING = Ring.of(("a", "x"))
A, X = RING.gen(0), RING.gen(1)
FACTORS = (X**2 - A, X - 1, A * X - 2, X**2 + 1)
ROOT2 = RealAlgebraic.from_root([-2, 0, 1], 1, 2)


def at(value: Fraction | RealAlgebraic) -> Point:
    return Point.of(RING, [value])


def test_a_whole_stack() -> None:
    stack = stack_over(at(Fraction(1)), FACTORS, (0, 1, 2, 3), lazard=False)
    assert stack.sections == ((0,), (0, 1), (2,))
    assert list(stack.texts) == ["+--+", "0--+", "---+", "00-+", "++-+", "++0+", "++++"]
    assert len(stack.sectors) == 4 and not stack.restricted and stack.nullified == ()
    assert stack.sectors[0] < -1 < stack.sectors[1] < 1 < stack.sectors[2] < 2 < stack.sectors[3]
    assert stack.sample(3).number(1) == 1 and stack.sample(4).number(1) == stack.sectors[2]


def test_used_factors_keep_their_numbers() -> None:
    stack = stack_over(at(Fraction(1)), FACTORS, (1, 3), lazard=False)
    assert stack.sections == ((1,),) and list(stack.texts) == ["-+", "0+", "++"]


def test_a_nullified_factor() -> None:
    polys = (A * X, X - 1)
    stack = stack_over(at(Fraction(0)), polys, (0, 1), lazard=False)
    assert stack.nullified == (0,) and stack.sections == ((1,),) and list(stack.texts) == ["0-", "00", "0+"]
    assert is_nullified(at(Fraction(0)), A * X) and not is_nullified(at(Fraction(1)), A * X)
    assert is_nullified(at(ROOT2), (A**2 - 2) * X + A**2 - 2) and not is_nullified(at(ROOT2), (A**2 - 2) * X + 1)


def test_a_stack_restricted_to_a_constraint() -> None:
    """Only the sections of the constraint; the others' signs are known there, and open between."""
    stack = restricted_stack(at(Fraction(1)), FACTORS, (0, 1, 2, 3), frozenset({0}))
    assert stack.restricted and stack.sections == ((0,), (0,))
    assert list(stack.texts) == ["+???", "0--+", "-???", "00-+", "+???"]
    assert stack.sample(1).number(1) == -1


def test_a_common_root_over_an_irrational_sample() -> None:
    """x = a is a common root of the constraint and another factor: a zero that no approximation shows."""
    polys = (X**2 - 2, X - A, X + A - 3)
    stack = restricted_stack(at(ROOT2), polys, (0, 1, 2), frozenset({0}))
    assert list(stack.texts) == ["+??", "0--", "-??", "00-", "+??"]

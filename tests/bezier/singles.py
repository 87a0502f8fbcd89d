"""Tasks of Method 1 for the tests."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from hypothesis import strategies as st

from bezier.input.task import Axis, Task, index_pair, task
from qe.errors import InputError

QUARTERS = st.integers(-8, 8).map(lambda k: Fraction(k, 4))
HEIGHTS = st.integers(1, 8).map(lambda k: Fraction(k, 4))


def axis(name: str, start: Any, goal: Any, height: Any = None) -> Axis:
    """An axis with exact numbers."""
    return Axis(name, Fraction(start), Fraction(goal), None if height is None else Fraction(height))


FLAT = axis("z", 0, 0)


def unit_task(degree: int, a: Any, b: Any, *axes: Axis) -> Task:
    """A task with x from 0 to 1."""
    return task(degree, (Fraction(0), Fraction(1)), (Fraction(a), Fraction(b)), axes)


@st.composite
def tasks(draw: Any, low: int = 3, high: int = 6, both: bool = False) -> Task:
    """A task with x from 0 to 1 whose interval has p and q; one raised axis, or two."""
    degree = draw(st.integers(low, high))
    p = draw(st.integers(1, degree - 2))
    q = draw(st.integers(p + 1, degree - 1))
    share = st.integers(0, 5).map(lambda k: Fraction(k, 6))
    a, b = (p + 1 - draw(share)) / Fraction(degree), (q + draw(share)) / Fraction(degree)
    if a == b:
        b += Fraction(1, 6 * degree)
    raised = [Axis("y", draw(QUARTERS), draw(QUARTERS), draw(HEIGHTS))]
    other = Axis("z", abs(draw(QUARTERS)), abs(draw(QUARTERS)), draw(HEIGHTS)) if both else FLAT
    return unit_task(degree, a, b, *raised, other)


def has_indices(degree: int, a: Fraction, b: Fraction) -> tuple[int, int] | None:
    """p and q for x from 0 to 1, or None where they are refused."""
    try:
        return index_pair(degree, (Fraction(0), Fraction(1)), (a, b))
    except InputError:
        return None

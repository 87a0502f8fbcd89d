"""Open cells of convex sets, and the walls between true and false ones."""

from fractions import Fraction as F
from itertools import pairwise

from hypothesis import given, settings
from hypothesis import strategies as st

from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.projection import factor_lists
from qe.elimination.critical.open_cells import OpenCells, true_run
from qe.exact.fibre_stack import isolate_over
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.options import Budget

PLANE = Ring.of(("x", "y"))
X, Y = PLANE.gen(0), PLANE.gen(1)


def disc(values: tuple[F, ...]) -> bool:
    return values[0] ** 2 + values[1] ** 2 <= 4


def explored(polys: list[Poly], holds=disc, hint=(F(0), F(0))) -> OpenCells:
    levels = factor_lists(polys, 2, BROWN_MCCALLUM, Budget())
    found = OpenCells(levels, holds, Budget(), hint)
    found.explore(Point(PLANE))
    return found


def test_only_the_boundary_is_a_wall() -> None:
    polys = [X * X + Y * Y - 4, X * X + Y * Y - 1, X - Y, Y * Y - X - 3]
    found = explored(polys)
    assert found.walls() == {X * X + Y * Y - 4}
    assert all(disc(values) for values in found.inside)
    assert found.decided <= 60  # of 98


def test_the_hint_may_be_wrong() -> None:
    assert explored([X * X + Y * Y - 4], hint=(F(50), F(-7))).walls() == {X * X + Y * Y - 4}


def test_no_true_cell() -> None:
    found = explored([X * X + Y * Y - 4], holds=lambda values: False)
    assert not found.inside and not found.walls()


def test_a_run_is_found_from_any_side_with_few_tests() -> None:
    samples = [F(k) for k in range(64)]
    for start, stop in ((0, 64), (5, 6), (20, 50), (0, 1), (63, 64), (3, 3)):
        for near in (-1, 7, 40, 99):
            asked = list[int]()

            def test(k: int, run: range = range(start, stop), asked: list[int] = asked) -> bool:
                asked.append(k)
                return k in run

            assert true_run(samples, F(near), test) == range(start, stop) or start == stop
            away = min((abs(k - near) for k in range(start, stop)), default=64)
            assert len(asked) <= 2 * away + 14


NUMBERS = st.integers(-3, 3)
HALVES = st.tuples(NUMBERS, NUMBERS, st.integers(0, 5)).filter(lambda h: h[0] or h[1])


@given(st.lists(HALVES, min_size=1, max_size=5), NUMBERS)
@settings(max_examples=60, deadline=None)
def test_no_wall_is_lost_in_a_stack_between_the_ends(halves: list[tuple[int, int, int]], near: int) -> None:
    """Lines of which none is a wall make many stacks, of which bisection needs few."""
    bounds = [X * X + Y * Y - 16, *(a * X + b * Y - c for a, b, c in halves)]

    def holds(values: tuple[F, ...]) -> bool:
        return all(f.sign_at(values) <= 0 for f in bounds)

    found = explored([*bounds, *(2 * X - k for k in range(-9, 10, 3))], holds, (F(near), F(0)))
    walls = set[Poly]()
    first = isolate_over(Point(PLANE), found.levels[0])
    for k, x in enumerate(first.samples):
        stack = isolate_over(first.sample(2 * k), found.levels[1])
        truths = [holds((x, y)) for y in stack.samples]
        changes = (stack.sections[i] for i, (a, b) in enumerate(pairwise(truths)) if a is not b)
        walls |= {found.levels[1][j] for section in changes for j in section.members}
    assert found.walls() == walls

"""Counts and balls settle multiple and common roots over a point as exact arithmetic at the point does."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.projection import factor_lists
from qe.exact import fibre_stack, sample
from qe.exact.fibre_stack import Isolation, isolate_over
from qe.exact.from_projection import discriminant, have_common_root, most_distinct, resultant
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.options import Budget
from qe.proof.cells import SIGN_OF

RING = Ring.of(("a", "b", "c", "x"))
A, B, C, X = (RING.gen(i) for i in range(4))

TOWERS = st.tuples(
    st.sampled_from([A**2 - 2, A**2 - A - 3, A - 2]),
    st.sampled_from([B**2 - A - 3, B**2 - A * B - 1, B**3 - A]),
    st.sampled_from([C**2 - B - 5, C**2 - C * B - A - 4]),
)


def over(tower: tuple[Poly, ...], which: list[int]) -> Point:
    """A point of the tower, each coordinate one of the real roots."""
    point = Point(RING)
    for f, k in zip(tower, which, strict=True):
        found = isolate_over(point, (f,))
        point = found.sample(2 * (k % len(found.sections)) + 1)
    return point


def shape_of(found: Isolation) -> list[tuple[tuple[int, ...], str]]:
    """Which polynomials vanish on the sections, and about where they are."""
    assert all(s.value is not None for s in found.sections)
    return [(tuple(s.members), f"{float(s.ball(128).mid()):.9g}") for s in found.sections]


def without_counts(point: Point, polys: tuple[Poly, ...]) -> Isolation:
    """The same stack by exact arithmetic at the point alone."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fibre_stack, "seen_to_be_equal", lambda *given: None)
        patch.setattr(sample, "most_distinct", lambda *given: None)
        return isolate_over(Point(RING, point.parent, point.value, point.zeros), polys)


@settings(max_examples=25)
@given(
    TOWERS,
    st.lists(st.integers(0, 2), min_size=3, max_size=3),
    st.sampled_from([RING.constant(1), A, B - 1, C, A + C, B - C]),
    st.sampled_from([RING.constant(3), A, B, C]),
    st.sampled_from(["double", "common", "both", "close"]),
)
def test_counts_agree_with_exact_arithmetic_over_towers(
    tower: tuple[Poly, ...], which: list[int], first: Poly, second: Poly, kind: str
) -> None:
    """Polynomials that have double and common roots over the point only, since the tower's polynomials vanish there."""
    point, hidden = over(tower, which), tower[2]
    u, v = X - first, X**2 + second * X - 1
    polys = {
        "double": (u**2 * v + hidden, v),
        "common": (u * v + hidden, u * (X**2 + 1)),
        "both": (u**2 * v + hidden * X, u * v + hidden),
        "close": (u * (1 << 150) + 1, u * v),
    }[kind]
    for f in polys:  # what the projection would compute
        discriminant(f, 3)
    resultant(polys[0], polys[1], 3)
    assert shape_of(isolate_over(point, polys)) == shape_of(without_counts(point, polys))


def test_no_arithmetic_at_the_point_where_counts_settle_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """A double root and a common root over a tower of degree 8, of polynomials with these projection factors."""
    f, g = X**4 - 2 * C * X**2 + B + 5 + X * (C**2 - B - 5), X**3 - C * X + A * X**2 - A * C + C**2 - B - 5
    point = over((A**2 - 2, B**2 - A - 3, C**2 - B - 5), [1, 1, 1])
    expected = shape_of(without_counts(point, (X**2 - C, g)))
    resultant(X**2 - C, g, 3)
    with monkeypatch.context() as patch:
        patch.setattr(sample.Fibre, "_make_squarefree", lambda self: pytest.fail("a remainder sequence was asked for"))
        patch.setattr(fibre_stack, "_equal", lambda *given: pytest.fail("exact arithmetic was asked for"))
        line = (X - C) ** 2 * (X + 1) + C**2 - B - 5
        discriminant(line, 3)
        assert len(isolate_over(point, (line,)).sections) == 2
        # x = ±sqrt(c) are two common roots: the counts leave that to exact arithmetic
        with pytest.raises(pytest.fail.Exception):
            isolate_over(point, (X**2 - C, g))
        h = (X - C) * (X**2 + 1) + C**2 - B - 5
        resultant(h, X - C, 3)
        assert shape_of(isolate_over(point, (h, X - C))) == [((0, 1), f"{float(point.ball(2, 64).mid()):.9g}")]
    assert shape_of(isolate_over(point, (X**2 - C, g))) == expected
    discriminant(f, 3)  # two double roots, one less than the count expects
    assert len(isolate_over(point, (f,)).sections) == len(without_counts(point, (f,)).sections) == 2


def test_what_the_projection_knows_of_a_sample() -> None:
    ring = Ring.of(("sample", "x"))  # no other test asks this ring
    a, x = ring.gen(0), ring.gen(1)
    f, g = x**2 + a * x + 1, a * x**2 + 1
    point = isolate_over(Point(ring), (a - 2,)).sample(1)
    assert (
        most_distinct(point.sign, f, 1, 2) is None and have_common_root(point.sign, f, g, 1) is None
    )  # nothing was computed yet
    lists = factor_lists([f, g], 2, LAZARD, Budget())
    assert lists[1] == (f, g) or lists[1] == (g, f)
    assert most_distinct(point.sign, f, 1, 2) == 1
    assert have_common_root(point.sign, f, g, 1) is False
    zero = isolate_over(Point(ring), (a,)).sample(1)
    assert most_distinct(zero.sign, f, 1, 2) == 2
    assert most_distinct(zero.sign, g, 1, 0) is None  # two leading coefficients are lost: the discriminant says nothing


def test_nullified_polynomials_are_left_to_exact_arithmetic() -> None:
    """The resultant with a nullified polynomial vanishes, whatever the Lazard evaluation does."""
    ring = Ring.of(("a", "x"))
    a, x = ring.gen(0), ring.gen(1)
    f, g = a * x - a * 3 + a**2, (x - 3) * (x - 5)
    resultant(f, g, 1)
    zero = isolate_over(Point(ring), (a,)).sample(1)
    found = isolate_over(zero, (f, g), lazard=True)
    assert [tuple(s.members) for s in found.sections] == [(0, 1), (1,)] and found.nullified == (0,)


def test_a_nullified_polynomial_whose_lazard_evaluation_shares_a_root() -> None:
    """Over a = sqrt(2) the first is zero and its Lazard evaluation 2a(x^2 - 3); the second is x^2 - 3 there."""
    ring = Ring.of(("a", "x"))
    a, x = ring.gen(0), ring.gen(1)
    f, g = (a**2 - 2) * (x**2 - 3) + (a**2 - 2) ** 2 * a, x**2 - 3 + (a**2 - 2) * x
    resultant(f, g, 1)
    point = isolate_over(Point(ring), (a**2 - 2,)).sample(3)
    found = isolate_over(point, (f, g), lazard=True)
    assert [tuple(s.members) for s in found.sections] == [(0, 1), (0, 1)] and found.nullified == (0,)


@settings(max_examples=10)
@given(TOWERS, st.lists(st.integers(0, 3), min_size=3, max_size=3))
def test_a_stack_by_the_shapes_of_another_one(tower: tuple[Poly, ...], which: list[int]) -> None:
    point = over(tower, which)
    f, g = (X**2 - C) * (X - B), X**4 - A * X - B
    core = isolate_over(point, (g,))
    found, fresh = isolate_over(point, (g, f), known=core.shapes), isolate_over(point, (g, f))
    assert found.shapes[g] is core.shapes[g] is not fresh.shapes[g]
    assert found.texts == fresh.texts and shape_of(found) == shape_of(fresh)


def test_roots_kept_for_points_above_are_those_of_every_point_and_refined_apart() -> None:
    """What does not look at the last coordinate is isolated once; a stack that refines it changes no other stack."""
    ring = Ring.of(("a", "b", "x"))
    a, b, x = (ring.gen(i) for i in range(3))
    below = isolate_over(Point(ring), (a - 3,)).sample(1)
    polys = (x**3 - a * x + 1, (x - a) ** 2 * (x**2 - a), (x**2 - 3) * 10**40 - b)
    first, second = (isolate_over(below, (b - k,)).sample(1) for k in (1, 2))
    stacks = [isolate_over(point, polys) for point in (first, second, first)]
    assert len({id(point.supporting(polys[0])) for point in (first, second)}) == 1
    for stack, k in zip(stacks, (1, 2, 1), strict=True):
        alone = isolate_over(isolate_over(isolate_over(Point(ring), (a - 3,)).sample(1), (b - k,)).sample(1), polys)
        assert stack.texts == alone.texts and stack.samples == alone.samples
        assert max(section.bits for section in stack.sections) > 64  # x^2 = 3 and a root next to it
    values = [section.value for stack in stacks for section in stack.sections if section.bits > 64]
    assert len({id(value) for value in values}) == len(values)


def test_signs_over_an_algebraic_point_by_simple_roots_and_by_evaluation() -> None:
    point = over((A**2 - 2, B**2 - A - 3, C**2 - B - 5), [1, 1, 1])
    polys = (A * X**2 - B, (X - C) ** 2 * (A - X), (X - A) ** 3, -X - B, X**2 + C, X**4 - A * X - B)
    found = isolate_over(point, polys)
    for position, text in enumerate(found.texts):
        assert [SIGN_OF[c] for c in text] == [found.sample(position).sign(p) for p in polys]

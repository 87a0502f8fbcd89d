"""Which places where a formula can turn true are among the points that are tried."""

from __future__ import annotations

import pytest

from qe.errors import CertificateRejected
from qe.formula.syntax import TRUE
from qe.kernel.elimination_points import Tried
from qe.kernel.turning_cover import Cover, mixed
from qe.kernel.virtual_substitution import TestPoint
from tests.unit.certify.claims import RING, formula, limits, poly

X = RING.index["x"]


def tried(*points: tuple[TestPoint | None, str, str]) -> list[Tried]:
    """(point, guard, formula that stays) of each."""
    return [Tried(point, formula(guard), formula(text), ()) for point, guard, text in points]


def root(text: str, shift: int = 0) -> TestPoint:
    """The root of a polynomial that is linear in x."""
    return TestPoint(poly(text).normal()[1].coefficients(X), 0, shift)


def cover(original: str, *points: tuple[TestPoint | None, str, str]) -> Cover:
    return Cover(X, formula(original), tried(*points), limits())


def test_mixed() -> None:
    assert mixed(formula("x = a or x = b and a > 0"))
    assert not mixed(formula("x = a or x = b")) and not mixed(formula("x = a"))


def test_the_end_of_a_half_line() -> None:
    """x > a turns true just right of a, x >= a at a itself, x < a at minus infinity only."""
    strict, weak = (root("x - a", 1), "true", "true"), (root("x - a"), "true", "true")
    assert cover("x > a", strict).ends(formula("x > a"), (), 1) == [(0, TRUE)]
    assert cover("x > a", weak).ends(formula("x > a"), (), 1) is None
    assert cover("x >= a", weak).ends(formula("x >= a"), (), 1) == [(0, TRUE)]
    assert cover("x >= a", strict).ends(formula("x >= a"), (), 1) is None
    assert cover("x < a").ends(formula("x < a"), (), 1) == []
    assert cover("x < a", (root("x - a", -1), "true", "true")).ends(formula("x < a"), (), -1) == [(0, TRUE)]
    assert cover("a > 0").ends(formula("a > 0"), (), 1) == []


def test_a_point_counts_only_where_its_guard_and_formula_follow() -> None:
    at = root("x - a", 1)
    both = formula("x > a and b > 0")
    assert cover("x > a and b > 0", (at, "b > 0", "true")).ends(both, (), 1) == [(0, TRUE)]
    assert cover("x > a and b > 0", (at, "b > 1", "true")).ends(both, (), 1) is None
    assert cover("x > a and b > 0", (at, "true", "b > 0")).ends(both, (), 1) == [(0, TRUE)]
    assert cover("x > a and b > 0", (at, "true", "c > 0")).ends(both, (), 1) is None


def test_every_part_of_a_disjunction_needs_its_point() -> None:
    a, b = (root("x - a", 1), "true", "true"), (root("x - b", 1), "true", "true")
    either = formula("x > a or x > b")
    assert cover("x > a or x > b", a, b).ends(either, (), 1) == [(0, TRUE), (1, TRUE)]
    short = cover("x > a or x > b", a)
    assert short.ends(either, (), 1) is None and "can turn true" in short.missing


def test_one_equation_of_a_conjunction_is_enough() -> None:
    found = cover("x = a and x > b", (root("x - a"), "true", "true")).ends(formula("x = a and x > b"), (), 1)
    assert found == [(0, TRUE)]
    other = cover("x = a and x > b", (root("x - b", 1), "true", "true"))
    assert other.ends(formula("x = a and x > b"), (), 1) is None


def test_an_equation_that_degenerates_needs_more() -> None:
    """Where b = 0 the equation b*x = 0 says nothing: the problem is kept there, or x > a met, too."""
    text = "b*x = 0 and x > a"
    lead = TestPoint((RING.constant(0), RING.var("b")), 0, 0)
    zero = (TestPoint((RING.constant(0), RING.constant(1)), 0, 0), "true", "true")
    kept, turn = (None, "b = 0", "true"), (root("x - a", 1), "true", "true")
    for point in (zero, (lead, "true", "true")):
        whole = cover(text, point, kept).ends(formula(text), (), 1)
        alone = cover(text, point).ends(formula(text), (), 1)
        both = cover(text, point, turn).ends(formula(text), (), 1)
        if whole is not None:
            assert alone is None and both is not None
            assert [k for k, _ in whole] == [0, 1] and whole[1][1] == formula("b = 0")
            return
    raise AssertionError("neither way to write the point 0 is known")


def test_far_ends() -> None:
    right = (TestPoint((), 0, 1), "true", "true")
    assert cover("x > a", right).far(formula("x > a"), -1, ()) == [(0, TRUE)]
    assert cover("x > a", right).far(formula("x > a"), 1, ()) is None
    assert cover("x > a", (None, "true", "true")).far(formula("x > a"), 1, ()) == [(0, TRUE)]


def test_only_earlier_points_count_where_that_is_asked() -> None:
    at = (root("x - a", 1), "true", "true")
    from qe.kernel.turning_points import Turn

    turn = Turn(root("x - a", 1), ())
    assert cover("x > a", at).meets(turn, formula("x > a"), 1) == [(0, TRUE)]
    assert cover("x > a", at).meets(turn, formula("x > a"), 0) is None


def test_what_has_no_places() -> None:
    with pytest.raises(CertificateRejected, match="and/or combination"):
        cover("true").ends(formula("ex y. y > x"), (), 1)
    with pytest.raises(CertificateRejected, match="too high"):
        cover("true").ends(formula("x^4 + a*x > b"), (), 1)

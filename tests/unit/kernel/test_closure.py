"""Closure under projection: every polynomial that a theorem needs has to be a product of listed factors."""

from __future__ import annotations

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.kernel.arithmetic.products import FactorLists
from qe.kernel.closure import check_closure, nullification_witnesses
from qe.options import Budget, Projection

BROWN, LAZARD = Projection.BROWN_MCCALLUM, Projection.LAZARD
RING = Ring.of(("x", "y"))
NO: tuple[tuple[int, ...], ...] = ()


def poly(text: str) -> Poly:
    return convert(read(f"{text} = 0"), RING).poly  # type: ignore[attr-defined,no-any-return]


def objection(
    low: str, high: str, projection: Projection = BROWN, constraints: tuple[tuple[int, ...], ...] = NO
) -> str:
    """What is objected to lists for x and for y."""
    lists = tuple(tuple(poly(f) for f in level.split(", ") if f) for level in (low, high))
    try:
        check_closure(FactorLists(RING, lists), projection, constraints, Budget())
    except CertificateRejected as error:
        return f"{error.step}: {error.reason}"
    return ""


@pytest.mark.parametrize(
    ("low", "high", "projection", "reason"),
    [
        ("x", "y^2 - x", BROWN, ""),
        ("x", "y^2 - x", LAZARD, ""),
        ("x + 1", "y^2 - x", BROWN, "factors[1][0]: its discriminant"),
        ("x", "x*y - 1", BROWN, ""),
        ("x + 1", "x*y - 1", BROWN, "factors[1][0]: its leading coefficient"),
        ("x", "x*y - x - 1", BROWN, ""),
        ("x", "x*y - x - 1", LAZARD, "factors[1][0]: its trailing coefficient"),
        ("x, x + 1", "x*y - x - 1", LAZARD, ""),
        ("x", "y - x, y + x", BROWN, ""),
        ("x + 1", "y - x, y + x", BROWN, "factors[1][1]: its resultant with payload.factors[1][0]"),
        ("x, x - 1", "y - x, y^2 - x", BROWN, ""),
        ("x", "y - x, y^2 - x", BROWN, "factors[1][1]: its resultant"),
        ("", "y, y^2 + 1", LAZARD, ""),  # y has no trailing coefficient, and needs none
        ("x", "y, x*y", BROWN, "is zero: the list is not squarefree"),
        ("x", "y^2 - 2*x*y + x^2", BROWN, "is zero: the list is not squarefree"),
        ("x + 1", "y^2 - x - 1", "other", "no theorem for"),
    ],
)
def test_what_a_projection_needs(low: str, high: str, projection: Projection, reason: str) -> None:
    found = objection(low, high, projection)
    assert reason in found and bool(found) is bool(reason), found


THREE = "y - 1, y^2 - x, y - x"


def test_a_constraint_on_the_last_level_needs_less() -> None:
    """Resultants with y - 1 alone, which are 1 - x: not the discriminant of y^2 - x, nor its resultant with y - x."""
    assert objection("x - 1", THREE, constraints=((), (0,))) == ""
    assert "discriminant" in objection("x - 1", THREE)
    assert "resultant" in objection("x", THREE, constraints=((), (0,)))
    assert "discriminant" in objection("x - 1", THREE, constraints=((), (1,)))
    assert objection("x, x - 1", THREE, constraints=((), (1,))) == ""


@pytest.mark.parametrize("constraints", [((0,),), ((), (0,), ()), ((), (3,)), ((), (1, 0)), ((), (-1, 0))])
def test_lists_that_are_no_constraints(constraints: tuple[tuple[int, ...], ...]) -> None:
    assert "payload.constraints" in objection("x, x - 1", THREE, constraints=constraints)


def test_no_constraint_restricts_lazard_projection() -> None:
    assert "no theorem restricts" in objection("x, x - 1", THREE, LAZARD, ((), (0,)))
    assert objection("x, x - 1", THREE, LAZARD, ((), ())) == ""


def test_a_level_below_a_constraint_keeps_its_discriminants() -> None:
    """Only on the last level are those of the other factors left out."""
    ring = Ring.of(("x", "y", "z"))
    x, y, z = (ring.gen(i) for i in range(3))

    def accepted(low: Poly) -> bool:
        lists = FactorLists(ring, ((low,), (y - 1, y**2 - x), (z,)))
        try:
            check_closure(lists, BROWN, ((), (0,), ()), Budget())
        except CertificateRejected as error:
            assert "discriminant" in error.reason
            return False
        return True

    assert not accepted(x - 1)
    lists = FactorLists(ring, ((x, x - 1), (y - 1, y**2 - x), (z,)))
    closure = check_closure(lists, BROWN, ((), (0,), ()), Budget())
    assert closure.constraints == (frozenset(), frozenset((0,)), frozenset())
    assert set(closure.discriminants[1]) == {0, 1} and set(closure.resultants[1]) == {(0, 1)}


def test_witnesses_against_nullification_lie_in_the_ideal_of_the_coefficients() -> None:
    ring = Ring.of(("x", "y", "z"))
    x, y, z = (ring.gen(i) for i in range(3))
    found = nullification_witnesses(x * z + y - 1, 2)
    assert set(found) == {x, y - 1}
    found = nullification_witnesses((x * y - 1) * z + x + y, 2)
    assert any(w in (x**2 + 1, -(x**2) - 1) for w in found)
    for witness in nullification_witnesses((x - y) * z**2 + (x + y - 2) * z, 2):
        assert not witness.at_rational(0, 1).at_rational(1, 1)  # it vanishes where all coefficients do

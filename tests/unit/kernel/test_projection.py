"""Closure under projection: every polynomial that a theorem needs has to be a product of listed factors."""

from __future__ import annotations

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.kernel.arithmetic.products import FactorLists
from qe.kernel.projection import Projected, nullification_witnesses
from qe.options import Budget

BROWN, LAZARD = False, True
RING = Ring.of(("x", "y"))


def poly(text: str) -> Poly:
    return convert(read(f"{text} = 0"), RING).poly  # type: ignore[attr-defined,no-any-return]


def objection(low: str, high: str, evaluates: bool = BROWN, core: tuple[int, ...] | None = None, **order: bool) -> str:
    """What is objected to lists for x and for y."""
    lists = tuple(tuple(poly(f) for f in level.split(", ") if f) for level in (low, high))
    everything = frozenset(range(len(lists[1])))
    try:
        projection = Projected(FactorLists(RING, lists), Budget(), evaluates=evaluates)
        if core is None:
            projection.closed()
        else:
            projection.needed(1, everything, frozenset(core), **order)
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
        ("x", "y, x*y", BROWN, "is zero: they are not squarefree"),
        ("x", "y^2 - 2*x*y + x^2", BROWN, "is zero: they are not squarefree"),
    ],
)
def test_what_a_projection_needs(low: str, high: str, projection: bool, reason: str) -> None:
    found = objection(low, high, projection)
    assert reason in found and bool(found) is bool(reason), found


THREE = "y - 1, y^2 - x, y - x"


def test_beside_a_core_less_is_needed() -> None:
    """Resultants with y - 1 alone, which are 1 - x: not the discriminant of y^2 - x, nor its resultant with y - x."""
    assert objection("x - 1", THREE, core=(0,), order=False) == ""
    assert "discriminant" in objection("x - 1", THREE)
    assert "resultant" in objection("x", THREE, core=(0,), order=False)
    assert "discriminant" in objection("x - 1", THREE, core=(1,), order=False)
    assert objection("x, x - 1", THREE, core=(1,), order=False) == ""


def test_where_the_order_is_needed_the_others_keep_their_discriminants() -> None:
    assert "discriminant" in objection("x - 1", THREE, core=(0,), order=True)
    assert objection("x, x - 1", THREE, core=(0,), order=True) == ""
    assert "leading coefficient" in objection("x - 2", "y - 1, x*y - 2", core=(0,), order=True)
    assert objection("x - 2", "y - 1, x*y - 2", core=(0,), order=False) == ""


def test_what_is_needed_are_factors_of_lower_level() -> None:
    lists = FactorLists(RING, ((poly("x"), poly("x - 1"), poly("x - 2")), (poly("y - 1"), poly("y^2 - x"))))
    projection = Projected(lists, Budget(), evaluates=BROWN)
    both, one = frozenset((0, 1)), frozenset((0,))
    assert projection.needed(1, both, both, order=True) == {(0, 0), (0, 1)}
    assert projection.needed(1, both, one, order=False) == {(0, 1)}
    assert projection.needed(1, one, one, order=True) == set()


def test_witnesses_against_nullification_lie_in_the_ideal_of_the_coefficients() -> None:
    ring = Ring.of(("x", "y", "z"))
    x, y, z = (ring.gen(i) for i in range(3))
    found = nullification_witnesses(x * z + y - 1, 2)
    assert set(found) == {x, y - 1}
    found = nullification_witnesses((x * y - 1) * z + x + y, 2)
    assert any(w in (x**2 + 1, -(x**2) - 1) for w in found)
    for witness in nullification_witnesses((x - y) * z**2 + (x + y - 2) * z, 2):
        assert not witness.at_rational(0, 1).at_rational(1, 1)  # it vanishes where all coefficients do


@pytest.mark.parametrize("name", ["resultant", "discriminant"])
def test_what_the_library_computes_is_compared_with_a_second_route(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert objection("x, x - 1", THREE) == ""
    monkeypatch.setattr(Poly, name, lambda f, *rest: f.ring.constant(1))
    assert "two ways" in objection("x, x - 1", THREE)

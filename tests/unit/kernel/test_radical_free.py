"""Sets of points without square roots: vertices and crossings of parabolas, each with its side condition."""

from __future__ import annotations

from typing import Any

import pytest

from qe.proof.entry import poly_to_text
from tests.unit.certify.claims import objection, poly
from tests.unit.kernel.test_elimination_points import RULE, by, point

FAR = point([], -1), point([], 1)
ROOTS = point(["-a", "1"])


def free(quadratics: list[str], *points: dict[str, Any]) -> dict[str, Any]:
    return by(*FAR, *points, side=0, quadratics=quadratics)


VERTEX = point(["0", "1"])  # of x^2 + b, at 0
PARABOLA = "b + x^2"


def accepted(text: str, evidence: dict[str, Any]) -> str:
    """What is objected to beside the answer, which the points give."""
    found = objection(RULE, text, "c = 7", evidence)
    return "" if "not the disjunction" in found else found


@pytest.mark.parametrize(
    ("text", "quadratics", "points"),
    [
        ("ex x. x^2 + b < 0 and x > a", ["x^2 + b"], [VERTEX, point(["-a", "1"], 1), point(["-a", "1"], -1)]),
        ("ex x. x^2 + b <= 0 and x >= a", ["x^2 + b"], [VERTEX, ROOTS]),
        ("ex x. x^2 - a < 0 and (x - 1)^2 - b < 0", ["x^2 - a", "x^2 - 2*x + 1 - b"], None),
    ],
)
def test_vertices_and_crossings(text: str, quadratics: list[str], points: list[Any] | None) -> None:
    if points is None:  # vertices 0 and 1, and x^2 - a = (x - 1)^2 - b
        crossing = poly("a - b + 1 - 2*x")
        c, d = crossing.coefficients(3)
        points = [VERTEX, point(["-1", "1"]), point([poly_to_text(c), poly_to_text(d)])]
    assert accepted(text, free([poly_to_text(poly(q)) for q in quadratics], *points)) == ""
    for k in range(len(points)):
        fewer = free([poly_to_text(poly(q)) for q in quadratics], *points[:k], *points[k + 1 :])
        if "x > a" not in text:
            assert "no point for" in accepted(text, fewer), k


@pytest.mark.parametrize(
    ("text", "quadratics", "reason"),
    [
        ("ex x. x^2 + b = 0 and x > a", ["x^2 + b"], "stands in"),  # an equation needs its roots
        ("ex x. (x^2 + b)*(x - a) < 0 and x > a", ["x^2 + b"], "stands in"),
        ("ex x. x^2 + b < 0 and x > a", ["x - a"], "not of degree 2"),
        ("ex x. x^2 - a < 0 and (x^2 - b < 0 or x > c)", ["x^2 - a", "x^2 - b"], "stands in"),
        ("ex x. x^2 - a < 0 and (x - 1)^2 - b > 0", ["x^2 - a", "x^2 - 2*x + 1 - b"], "stands in"),
        ("ex x. x^2 - a < 0 and x^2 - b < 0", ["x^2 - a", "x - b"], "not of degree 2"),
    ],
)
def test_what_breaks_a_side_condition(text: str, quadratics: list[str], reason: str) -> None:
    listed = [poly_to_text(poly(q)) for q in quadratics]
    points = [VERTEX, ROOTS, point(["-a", "1"], 1), point(["-a", "1"], -1), point(["-1", "1"])]
    assert reason in accepted(text, free(listed, *points))


def test_a_leading_coefficient_that_may_be_negative_keeps_the_problem() -> None:
    """c*x^2 + b < 0 and x^2 - a < 0: where c <= 0 the vertices are no help."""
    text = "ex x. c*x^2 - b < 0 and x^2 - a < 0"
    listed = [poly_to_text(poly(q)) for q in ("c*x^2 - b", "x^2 - a")]
    vertex = point(["0", "2*c"], guard="c > 0")
    assert "does not hold" in accepted(text, free(listed, vertex, VERTEX))
    kept = point(None, guard="c <= 0")
    assert accepted(text, free(listed, vertex, VERTEX, kept)) == ""
    known = "ex x. c > 0 and c*x^2 - b < 0 and x^2 - a < 0"
    assert accepted(known, free(listed, vertex, VERTEX)) == ""

"""Formulas in scenes: in the way as obstacles, as workspaces, in the plane and in space; what is undecided says so."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

import qe
from bezier.scenes.barrier import Wall
from bezier.scenes.cells import Cell
from bezier.scenes.route import Blocked, decided, proved
from qe.options import Budget
from tests.bezier.scenes.test_route import SCENE, read_scene
from tests.tables import each

DISC = {"kind": "disc", "centre": [5, "15/2"]}
STRIP = "(x - 5 - (y - 5)^2/20)^2 <= 2"


def formula(text: str) -> dict[str, Any]:
    return {"kind": "formula", "formula": text}


@each(
    ("an ellipse", [formula("(x - 5)^2/4 + (y - 5)^2/9 <= 1")], False),
    ("a bent strip", [formula(STRIP)], True),
    ("a gap of a thousandth", [formula(f"{STRIP} & y <= 7"), formula(f"{STRIP} & y >= 7.001")], False),
    ("a quartic and a disc", [formula("(x-5)^4 + (y-2)^4 <= 20"), {**DISC, "radius": "3.45"}], True),
    ("a smaller disc", [formula("(x-5)^4 + (y-2)^4 <= 20"), {**DISC, "radius": "2.9"}], False),
    ("what has quantifiers", [formula("E u. u^2 <= 1 & (x - 5 - u)^2 <= 1 & y >= 0")], True),
)
def test_formulas_are_in_the_way(what: str, listed: list[Any], blocked: bool) -> None:
    scene = read_scene({**SCENE, "obstacle": listed})
    found = decided(scene, Budget(60))
    found.check()
    assert found.blocked is blocked
    if isinstance(found, Blocked) and found.walls and len(listed) == 1:  # a wall that leaves the formula has no proof
        ends = [replace(wall, end=(wall.end[0] + 1, wall.end[1])) for wall in found.walls if isinstance(wall, Wall)]
        with pytest.raises(qe.Unable):
            proved(replace(found, walls=tuple(ends)).sentences, Budget(20))


def test_a_workspace_may_be_a_formula() -> None:
    """What it leaves out is open: its boundary may be used."""
    pear, bar = formula("((x-5)^2 - 9)^2/100 + (y-5)^2/9 <= 1"), {"kind": "box", "low": [4, 0], "high": [6, 10]}
    for listed, blocked in ([bar], True), ([], False):
        scene = read_scene({**SCENE, "domain": [SCENE["domain"], pear], "obstacle": listed})
        found = decided(scene, Budget(60))
        found.check()
        assert found.blocked is blocked
    assert scene.blocked_at((Fraction(5), Fraction(9))) == "outside the domain" and not scene.blocked_at(scene.start)


def test_a_wall_of_formulas_in_space_is_proved_by_sentences() -> None:
    wall = formula("(x - 5)^2 <= 16 + y^2/20 | x >= 10 & y^2 + z^2 <= 1")
    space = {"domain": {"low": [0] * 3, "high": [10] * 3}, "start": ["1/4", 0, 5], "goal": ["39/4", 0, 8]}
    found = decided(read_scene({**space, "obstacle": [wall]}), Budget(60))
    assert isinstance(found, Blocked)
    found.check()
    first = found.walls[0]
    assert isinstance(first, Cell)
    wide = Cell.box(tuple(c - 2 for c in first.corners[0]), tuple(c + 9 for c in first.corners[0]))
    with pytest.raises((qe.CertificateRejected, qe.Unable)):
        proved(replace(found, walls=(wide, *found.walls[1:])).sentences, Budget(20))


@each("y = (x-1)^2 + 4 & y <= 6 | y = 6 & (x-1)^2 <= 2", "(x-5)^2 + (y-2)^2 <= 4 | (x-5)^2 + (y-7)^2 <= 9")
def test_what_touches_is_undecided(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bezier.scenes.region.SMALLEST", Fraction(1, 64))
    with pytest.raises(qe.Unable, match="boundary of a formula"):
        decided(read_scene({**SCENE, "obstacle": [formula(text)]}), Budget(60))


@each(
    ("a circle", ["(x-5)^2 + (y-5)^2 = 9"], [5, 5], True),
    ("of two arcs", ["(x-5)^2 + (y-5)^2 = 9 & x <= 5", "(x-5)^2 + (y-5)^2 = 9 & x >= 4"], [5, 5], True),
    ("with a gap", ["(x-5)^2 + (y-5)^2 = 9 & x <= 6"], [5, 5], False),
    ("a cubic from rim to rim", ["y - 5 = (x-5)^3 - x"], [1, 5], True),
    ("the other side of it", ["y - 5 = (x-5)^3 - x"], [9, 1], False),
)
def test_a_curve_in_the_way_separates_by_its_signs(
    what: str, texts: list[str], start: list[int], blocked: bool
) -> None:
    scene = read_scene({**SCENE, "start": start, "obstacle": list(map(formula, texts))})
    known = decided(scene, Budget(60))
    known.check()
    assert known.blocked is blocked
    if not isinstance(known, Blocked):
        return
    assert known.divider is not None
    open_scene = read_scene({**SCENE, "start": start, "obstacle": [formula(f"{t} & y <= 6") for t in texts]})
    altered = [
        replace(known, divider=replace(known.divider, terms=known.divider.terms[1:])),
        replace(known, scene=open_scene),
        replace(known, scene=replace(scene, start=scene.goal)),
        replace(known, divider=None),
    ]
    for other in altered:
        with pytest.raises(qe.CertificateRejected):
            other.check()
    strict = replace(known, scene=open_scene, divider=replace(known.divider, strict=True))
    with pytest.raises(qe.Unable):
        proved(strict.sentences, Budget(20))

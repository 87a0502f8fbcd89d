"""Formulas in scenes: in the way as obstacles, as workspaces, in the plane and in space; what is undecided says so."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import pi, tan
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


@each(("4.6", False), ("4.5", True))
def test_formulas_keep_their_margins(level: str, blocked: bool) -> None:
    """An ellipse and a box above, by the sum of the margins and a little more, just so, and less."""
    low, high = formula("(x-5)^2 + 4*(y-2)^2 <= 4"), {"kind": "box", "low": [4, level], "high": [6, 10]}
    scene = read_scene({**SCENE, "obstacle": [{**low, "margin": "1/2"}, high], "margin": "1/2"})
    found = decided(scene, Budget(60))
    found.check()
    assert found.blocked is blocked


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


TOUCHING = {
    "two discs": ["(x-5)^2 + (y-2)^2 <= 9", "(x-5)^2 + (y-15/2)^2 <= 25/4"],
    "parts of one formula": ["(x-5)^2 + (y-2)^2 <= 4 | (x-5)^2 + (y-7)^2 <= 9 | x = 5 & y <= 1"],
    "obliquely": ["(x-2)^2 + (y-2)^2 <= 9", "(x-34/5)^2 + (y-28/5)^2 <= 9", "x >= 6 & y >= 6"],
    "a node": ["((x-5)^2 + (y-5)^2)^2 <= 25*((y-5)^2 - (x-5)^2)"],
    "along a curve": [f"4*(x-5)^2 + (y-5)^2 <= 36 & 10*y {s} x^2" for s in ("<=", ">=")],
    "at a corner in Q(sqrt(2))": [
        "y >= 5 & y <= 8 & x^2 - 18 >= y - 5 & x <= 8",
        "y <= 5 & 2*(x^2 - 18) <= y - 5",
        "x = 7 & y >= 8",
    ],
    "arcs around a point": ["y = (x-9)^2/2 + 1 & y <= 5", "y = 9 - (x-9)^2/2 & y >= 5"],
}


@pytest.mark.parametrize("name", TOUCHING)
def test_what_touches_leaves_no_passage(name: str) -> None:
    """It was undecided: small cells do not tell."""
    goal = {"goal": [9, 5]} if "arcs" in name else {}
    start = {"start": [1, 9], "goal": [9, 1]} if name == "obliquely" else goal
    listed = list(map(formula, TOUCHING[name]))
    found = decided(read_scene({**SCENE, **start, "obstacle": listed}), Budget(60))
    assert isinstance(found, Blocked)
    found.check()


@each(
    ("(x-5)^2*(y-3)^2 <= 0", True),
    ("(x-5)^2*(y-3) = 0 & y >= 3", True),
    ("-((x-5)*(x^2-35))^2 >= 0", True),
    ("(x-5)^2 + (y-3)^2 <= 0", False),
    ("(x-12)^4*((x-5)^2 + (y-5)^2 - 4) <= 0", False),
)
def test_squares_in_conditions_are_decided(text: str, blocked: bool) -> None:
    """They were undecided after minutes: no sign changes where a square is 0."""
    found = decided(read_scene({**SCENE, "obstacle": [formula(text)]}), Budget(20))
    found.check()
    assert found.blocked is blocked


def test_what_small_cells_do_not_decide_is_soon_given_up() -> None:
    """It took six times as long once cells lay along curves: now fewer of them are tried."""
    with pytest.raises(qe.Unable, match="undecided"):
        decided(read_scene({**SCENE, "obstacle": [formula("(x-5)^2*(y-3)^2 <= 1/10^20")]}), Budget(20))


def test_a_gap_of_a_thousandth_between_discs_is_a_passage() -> None:
    listed = [formula("(x-5)^2 + (y-2)^2 <= 9"), formula("(x-5)^2 + (y-7501/1000)^2 <= 25/4")]
    found = decided(read_scene({**SCENE, "obstacle": listed}), Budget(60))
    found.check()
    assert not found.blocked


@each(
    ("upright", ["(x-5)^2 + (y-2)^2 <= 9", "(x-5)^2 + (y-750001/100000)^2 <= 25/4"], {}),
    ("touching the box", ["(x-5)^2 + (y-9/4)^2 <= 81/16", "(x-5)^2 + (y-1450001/200000)^2 <= (549999/200000)^2"], {}),
    ("obliquely", ["(x-2)^2 + (y-2)^2 <= 9", "(x-6800008/1000000)^2 + (y-5600006/1000000)^2 <= 9"], {"goal": [9, 1]}),
    daily=2,
)
def test_a_gap_of_a_millionth_of_the_box_is_a_passage(what: str, texts: list[str], more: dict[str, Any]) -> None:
    """It was undecided: square cells as small as the gap are too many."""
    also = ["x >= 6 & y >= 6"] if more else []
    start = {"start": [1, 9], **more} if more else {}
    found = decided(read_scene({**SCENE, **start, "obstacle": list(map(formula, [*texts, *also]))}), Budget(60))
    found.check()
    assert not found.blocked


FOUR = [
    "y = 8 - (x-5)^2/9 & x >= 2 & x <= 8",
    "y = 2 + (x-5)^2/9 & x >= 2 & x <= 8",
    "x = 8 - (y-5)^2/9 & y >= 2 & y <= 8",
    "x = 2 + (y-5)^2/9 & y >= 2 & y <= 8",
]


def ring_of(count: int, bend: str = "1") -> list[str]:
    """Arcs between neighbouring points on a circle of radius 3 about (5, 5)."""
    halves = [Fraction(round(100 * tan(pi * k / count + 0.05)), 100) for k in range(count)]
    points = [(5 + 3 * (1 - t * t) / (1 + t * t), 5 + 6 * t / (1 + t * t)) for t in halves]
    result = []
    for (a, b), (c, d) in pairwise([*points, points[0]]):
        along = f"(({c - a})*(x - ({a})) + ({d - b})*(y - ({b})))/({(c - a) ** 2 + (d - b) ** 2})"
        beside = f"({c - a})*(y - ({b})) - ({d - b})*(x - ({a}))"
        result.append(f"{beside} + {bend}*{along}*(1 - {along}) = 0 & {along} >= 0 & {along} <= 1")
    return result


PLANE = {"start": [-8, 0], "goal": [8, 0], "domain": {"low": [-9, -5], "high": [9, 5]}}
ACROSS = {"start": [-8, 0, 0], "goal": [8, 0, 0], "domain": {"low": [-9, -5, -5], "high": [9, 5, 5]}}


@each(("x = 0", True), ("2*x = 0 & y <= 100", True), ("x^3 = 0 & y <= 4", False), ("z = 0 & y = 0 & x^2 <= 1", False))
def test_a_plane_through_the_middle_of_the_box_is_a_wall(text: str, blocked: bool) -> None:
    """Its polynomial has no other terms to which its value is small: such walls were undecided."""
    found = decided(read_scene({**ACROSS, "obstacle": [formula(text)]}), Budget(60))
    found.check()
    assert isinstance(found, Blocked) is blocked


@each("x = 0 & y^2 <= 24", "x = 1/3 & y^2 <= 16", "x = 0 & y <= 24/5 & y >= -24/5", "x = y/100 & y^2 <= 24")
def test_a_way_leads_past_the_ends_of_a_thin_wall(text: str) -> None:
    """Cells were cut again and again along lines that only touch them, and the way stayed undecided."""
    found = decided(read_scene({**PLANE, "obstacle": [formula(text)]}), Budget(60))
    found.check()
    assert not isinstance(found, Blocked)


def test_a_segment_on_the_way_has_boxes_without_height() -> None:
    """Slopes of its polynomial there were divided by the height 0: an internal error."""
    found = decided(read_scene({**PLANE, "obstacle": [formula("y = 0 & x^2 <= 1")]}), Budget(60))
    found.check()
    assert not isinstance(found, Blocked)


@each((FOUR, True), (ring_of(5), False), (ring_of(6), False), (ring_of(12, "1/2"), False))
def test_a_closed_chain_of_arcs_blocks_and_without_one_it_does_not(arcs: list[str], is_decided: bool) -> None:
    """Four took 22 seconds, five were undecided; later those of twelve, which start sees from inside of all."""
    ring = {**SCENE, "start": [5, 5], "goal": ["1/2", 5]}
    found = decided(read_scene({**ring, "obstacle": list(map(formula, arcs))}), Budget(100))
    found.check()
    assert isinstance(found, Blocked) and len(found.divider) >= len(arcs)
    other = replace(found, scene=read_scene({**ring, "obstacle": list(map(formula, arcs[1:]))}))
    with pytest.raises((qe.CertificateRejected, qe.Unable)):
        other.check()
    assert not is_decided or not decided(other.scene, Budget(60)).blocked


@pytest.mark.parametrize("shape", ["ball", "ellipsoid"])
def test_shells_in_space_block(shape: str) -> None:
    shells = {"ball": ["z >= 5", "z <= 5"], "ellipsoid": ["x >= y", "x <= y & z >= 4", "x <= y & z <= 4"]}
    text = "4*((x-5)^2 + (y-5)^2) + (z-5)^2 = 9" if shape == "ellipsoid" else "(x-5)^2 + (y-5)^2 + (z-5)^2 = 9"
    space = {"domain": {"low": [0] * 3, "high": [10] * 3}, "start": [5, 5, 5], "goal": [9, 9, 9]}
    found = decided(read_scene({**space, "obstacle": [formula(f"{text} & {s}") for s in shells[shape]]}), Budget(60))
    found.check()
    assert found.blocked


def test_what_is_seen_in_floating_point_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Arcs with a gap, of which it is said that they divide."""
    ring = {**SCENE, "start": [5, 5], "goal": ["1/2", 5]}
    known = decided(read_scene({**ring, "obstacle": list(map(formula, FOUR))}), Budget(100))
    assert isinstance(known, Blocked)
    for seen in (known.divider, known.divider[:1], known.divider[1:]):
        monkeypatch.setattr("bezier.scenes.route.seen_from", lambda scene, point, seen=seen: seen)
        other = decided(read_scene({**ring, "obstacle": list(map(formula, FOUR[:3]))}), Budget(60))
        other.check()
        assert not other.blocked


def test_a_wall_or_a_divider_that_is_not_in_the_way_has_no_proof() -> None:
    for name, altered in (("two discs", "walls"), ("arcs around a point", "divider")):
        goal = {"goal": [9, 5]} if altered == "divider" else {}
        known = decided(read_scene({**SCENE, **goal, "obstacle": list(map(formula, TOUCHING[name]))}), Budget(60))
        assert isinstance(known, Blocked)
        for k in range(len(getattr(known, altered))):
            part = [p for i, p in enumerate(getattr(known, altered)) if i != k]
            other = replace(known, **{altered: tuple(part)})
            with pytest.raises((qe.CertificateRejected, qe.Unable)):
                proved(other.sentences, Budget(20))
                other.check()


@each(("y <= 5", True), ("y <= 4.999", False))
def test_a_touch_at_the_root_of_a_cubic_is_no_passage(below: str, blocked: bool) -> None:
    """It was undecided: no wall with rational ends goes through it."""
    listed = [formula("y >= (x^3 - 30*x - 20)^2/400 + 5"), formula(below)]
    found = decided(read_scene({**SCENE, "start": [1, "51/10"], "goal": [9, "51/10"], "obstacle": listed}), Budget(60))
    found.check()
    assert found.blocked is blocked
    assert not isinstance(found, Blocked) or max(c.degree for c in found.divider) == 6
    if isinstance(found, Blocked):
        other = replace(found, divider=tuple(c for c in found.divider if c.degree != 3))
        with pytest.raises((qe.CertificateRejected, qe.Unable)):
            other.check()


def test_what_touches_at_a_place_without_a_rational_line_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bezier.scenes.region.SMALLEST", Fraction(1, 64))
    listed = [formula("y >= ((x-3)^2 - 2)^2 + 5"), formula("y <= 5 & x <= 6"), formula("x = 6 & y <= 7")]
    with pytest.raises(qe.Unable, match="boundary of a formula"):
        decided(read_scene({**SCENE, "start": [1, "26/5"], "goal": [9, 3], "obstacle": listed}), Budget(60))


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
    (divider,) = known.divider
    open_scene = read_scene({**SCENE, "start": start, "obstacle": [formula(f"{t} & y <= 6") for t in texts]})
    altered = [
        replace(known, divider=(replace(divider, terms=divider.terms[1:]),)),
        replace(known, scene=open_scene),
        replace(known, scene=replace(scene, start=scene.goal)),
        replace(known, divider=()),
    ]
    for other in altered:
        with pytest.raises(qe.CertificateRejected):
            other.check()
    strict = replace(known, scene=open_scene, divider=(replace(divider, strict=True),))
    with pytest.raises(qe.Unable):
        proved(strict.sentences, Budget(20))

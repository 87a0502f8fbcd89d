"""Scenes: every answer against a flood of a grid, every proof against broken ones, both doors the same."""

from __future__ import annotations

import json
import random
from collections import deque
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.ndimage import label

import bezier
import qe
from bezier.cli import main
from bezier.conic import Conic
from bezier.curves.curve import Bezier
from bezier.curves.scalar import dot, subtract
from bezier.interface.function import table_value
from bezier.pictures.obstacles import excess
from bezier.scenes import route as route_module
from bezier.scenes.barrier import barrier
from bezier.scenes.bound import least_length
from bezier.scenes.cells import Cell, FreeCells
from bezier.scenes.region import decomposed
from bezier.scenes.route import Blocked, Route, Wish, checked, decided, proved
from bezier.scenes.scene import Scene, given_scene, load_scene
from bezier.scenes.sentences import COVERED, covering, inside
from bezier.scenes.solid import Solid, directions, nearest
from experiments.problem import ROOT
from qe.exact.ring import Ring
from qe.formula.syntax import FALSE, TRUE
from qe.options import Budget
from tests.tables import each

WALLS = [{"kind": "box", "low": [4, 0], "high": [6, 5]}, {"kind": "box", "low": [4, 5], "high": [6, 10]}]
SCENE: dict[str, Any] = {
    "domain": {"low": [0, 0], "high": [10, 10]},
    "start": [1, 5],
    "goal": [9, 5],
    "obstacle": WALLS,
}
HALF = Fraction(1, 2)
SHARED = ROOT.parent / "shared" / "corpora" / "scenes"


def read_scene(given: Any) -> Scene:
    return given_scene(given, "scene", table_value)


def slit(gap: Fraction) -> dict[str, Any]:
    return {**SCENE, "obstacle": [WALLS[0], {**WALLS[1], "low": [4, 5 + gap]}]}


@each(*range(1, 13), daily=4)
def test_a_slit_is_free_however_narrow(digits: int) -> None:
    found = bezier.route(slit(Fraction(1, 10**digits)))
    assert isinstance(found, bezier.Route)
    found.check()


def test_touching_obstacles_leave_no_passage() -> None:
    found = bezier.route(SCENE)
    assert isinstance(found, bezier.Blocked) and found.start_side and found.goal_side
    found.check()
    assert found.certificate is not None and qe.verify(found.certificate).accepted


def boxes(rng: random.Random, dimension: int) -> dict[str, Any]:
    """A random scene whose corners are whole numbers."""
    listed = []
    for _ in range(rng.randint(4, 14)):
        low = [rng.randint(0, 9) for _ in range(dimension)]
        listed.append({"kind": "box", "low": low, "high": [min(10, a + rng.randint(0, 5)) for a in low]})
    half, end = [Fraction(1, 2)] * dimension, [Fraction(19, 2)] * dimension
    return {
        "domain": {"low": [0] * dimension, "high": [10] * dimension},
        "start": half,
        "goal": end,
        "obstacle": listed,
    }


def flooded(scene: Any, step: Fraction) -> bool:
    """Whether a walk on a grid of points, each step of which is clear of all obstacles, leads from start to goal."""
    seen, waiting = {scene.start}, deque([scene.start])
    while waiting:
        point = waiting.popleft()
        if point == scene.goal:
            return True
        for k in range(scene.dimension):
            for d in (-step, step):
                other = (*point[:k], point[k] + d, *point[k + 1 :])
                inside = all(part.contains(other) for part in scene.domain)
                clear = inside and not any(b.meets(point, other) for b in scene.solids)
                if clear and other not in seen:
                    seen.add(other)
                    waiting.append(other)
    return False


def flooded_boxes(scene: Any) -> bool:
    """The same for boxes with whole corners and steps of a half, by floats: such a step is clear where its ends are."""
    ticks = np.arange(0, 10.25, 0.5)
    grid = np.stack(np.meshgrid(*[ticks] * scene.dimension, indexing="ij"), axis=-1)
    free = np.ones(grid.shape[:-1], dtype=bool)
    for body in scene.obstacles:
        low, high = (np.array(c, dtype=float) for c in body.low_high())
        free &= np.any((grid < low) | (grid > high), axis=-1)
    parts, _ = label(free)
    start, goal = (parts[tuple(int(2 * c) for c in p)] for p in (scene.start, scene.goal))
    return bool(start and start == goal)


def check(scene: Any) -> bool:
    """Whether it is free; the flood says the same, and the proof stands."""
    found = decided(scene, Budget(60))
    found.check()
    assert found.blocked is not flooded_boxes(scene)
    return not found.blocked


def test_boxes_agree_with_a_flood_of_the_grid() -> None:
    rng, free = random.Random(4), 0
    for k in range(12):
        free += check(read_scene(boxes(rng, 3 if k % 6 == 0 else 2)))
    assert 2 < free < 10


@pytest.mark.deep
def test_many_boxes_agree_with_a_flood_of_the_grid() -> None:
    rng = random.Random(8)
    for k in range(500):
        check(read_scene(boxes(rng, 3 if k % 5 == 0 else 2)))


def mixed(rng: random.Random, kinds: str = "disc box capsule polyhedron half_plane") -> Scene:
    """A random scene of the plane, start and goal at free points of half a grid; many bodies touch."""
    listed = list[dict[str, Any]]()

    def point() -> list[int]:
        return [rng.randint(0, 10), rng.randint(0, 10)]

    for _ in range(rng.randint(4, 14)):
        kind, at = rng.choice(kinds.split()), [rng.randint(1, 9), rng.randint(1, 9)]
        entry: dict[str, Any] = {"kind": kind}
        if kind == "disc":
            entry |= {"centre": at, "radius": Fraction(rng.randint(2, 9), 4)}
        elif kind == "box":
            entry |= {"low": at, "high": [min(10, c + rng.randint(0, 4)) for c in at]}
        elif kind == "capsule":
            entry |= {"start": at, "end": [at[0] + rng.randint(1, 3), rng.randint(0, 10)], "radius": Fraction(1, 4)}
        elif kind == "polyhedron":
            corners = [at, [at[0] + rng.randint(1, 4), at[1]], point(), [at[0], at[1] - rng.randint(1, 3)]]
            entry |= {"vertices": corners, "margin": Fraction(rng.randint(0, 2), 4)}
        else:
            entry |= {"normal": [rng.randint(-3, 3), rng.choice([-2, 1, 3])], "offset": rng.randint(-15, 1)}
        listed.append(entry)
    disc, box = {"kind": "disc", "centre": [5, 5], "radius": 7}, {"low": [0, 0], "high": [10, 10]}
    corners = [[0, 0], [10, 0], [12, 5], [10, 10], [0, 10], [-1, 5]]
    ring = {"kind": "annulus", "centre": [5, 5], "inner": rng.randint(1, 3), "outer": 7}
    domain = rng.choice([box, disc, [box, disc], ring, {"kind": "polygon", "vertices": corners}])
    scene = read_scene({"domain": domain, "start": [1, 1], "goal": [9, 9], "obstacle": listed})
    places = [(HALF * i, HALF * j) for i in range(21) for j in range(21)]
    free = [p for p in places if scene.blocked_at(p) is None] or [scene.start, scene.goal]
    return replace(scene, start=rng.choice(free), goal=rng.choice(free))


def decide_twice(scene: Scene) -> Blocked | Route:
    """The answer; what separates and what joins are found independently, and exactly one of them is."""
    found = decided(scene, Budget(120))
    if any(scene.blocked_at(p) for p in (scene.start, scene.goal)):
        assert found.blocked
        return found
    joined = route_module._joined(scene, decomposed(scene, 1, Budget(120)).free)
    assert (joined is None) is bool(barrier(scene)) is found.blocked
    found.check()
    return found


def test_the_plane_is_decided_completely() -> None:
    rng = random.Random(12)
    free = [decide_twice(mixed(rng, "disc" if k % 2 else "disc box capsule polyhedron half_plane")) for k in range(3)]
    assert 0 < sum(isinstance(f, Route) for f in free) < 3


@pytest.mark.deep
def test_many_scenes_of_the_plane_are_decided_completely() -> None:
    rng = random.Random(2)
    for k in range(500):
        scene = mixed(rng, "disc box" if k % 2 else "disc box capsule polyhedron half_plane")
        found = decide_twice(scene)
        if found.blocked and not any(scene.blocked_at(p) for p in (scene.start, scene.goal)):
            assert not flooded(scene, HALF)


@each((Fraction(0), True), (Fraction(1, 10**12), False), (Fraction(-1, 10**12), True), daily=2)
def test_discs_that_touch_are_a_wall_and_a_narrow_gap_is_none(gap: Fraction, blocked: bool) -> None:
    """Eight discs of radius 1 around the start, one of them smaller by the gap."""
    around = [(-2, -2), (0, -2), (2, -2), (2, 0), (2, 2), (0, 2), (-2, 2), (-2, 0)]
    listed = [{"kind": "disc", "centre": at, "radius": 1} for at in around]
    listed[3] = {**listed[3], "radius": 1 - gap}
    domain = {"kind": "disc", "centre": [0, 0], "radius": 9}
    found = bezier.route({"domain": domain, "start": [0, 0], "goal": [0, 9], "obstacle": listed})
    assert found.blocked is blocked
    found.check()


@each((Fraction(0), True), (Fraction(1, 10**12), False))
def test_a_disc_may_touch_the_rim_of_a_round_workspace(gap: Fraction, blocked: bool) -> None:
    ring = {"kind": "annulus", "centre": [0, 0], "inner": 1, "outer": 3}
    discs = [{"kind": "disc", "centre": [x, 0], "radius": 1 - gap} for x in (-2, 2)]
    found = bezier.route({"domain": ring, "start": [0, 2], "goal": [0, -2], "obstacle": discs})
    assert found.blocked is blocked
    found.check()


def test_a_start_on_the_rim_of_a_hole_leads_somewhere() -> None:
    """It was undecided: the polygon around the hole, which is open, was not kept from its boundary."""
    ring = {"kind": "annulus", "centre": [5, 5], "inner": 3, "outer": 7}
    disc = {"kind": "disc", "centre": [6, 8], "radius": "3/4"}
    found = bezier.route({"domain": ring, "start": [5, 8], "goal": [10, 8], "obstacle": [disc]})
    assert not found.blocked
    found.check()


@each(
    ("a bar across the workspace", [{"kind": "capsule", "start": [0, 5], "end": [10, 6], "radius": "1/2"}], True),
    ("a bar that ends", [{"kind": "capsule", "start": [0, 5], "end": [9, 6], "radius": "1/2"}], False),
    ("a margin closes it", [{"kind": "box", "low": [0, 5], "high": [9, 6], "margin": 1}], True),
    ("a flat wall", [{"kind": "box", "low": [0, 5], "high": [10, 5]}], True),
    ("a half-plane", [{"kind": "half_plane", "normal": [-1, 1], "offset": 0}], False),
    ("two half-planes", [{"kind": "half_plane", "normal": n, "offset": -5} for n in ([1, -1], [-1, 1])], False),
    ("a polygon", [{"kind": "polygon", "vertices": [[0, 4], [10, 5], [0, 6]]}], True),
)
def test_kinds_of_obstacles_in_the_plane(what: str, listed: list[Any], blocked: bool) -> None:
    found = bezier.route({**SCENE, "start": [5, 1], "goal": [6, 9], "obstacle": listed})
    assert found.blocked is blocked or what == "a half-plane"
    found.check()


BALL = {"kind": "ball", "centre": [0, 0, 0], "radius": 5}


@each(
    ({"kind": "half_ball", "centre": [0, 0, 0], "radius": 5}, [], False),
    ({"kind": "cylinder", "centre": [0, 0], "radius": 5, "bottom": 0, "top": 3}, [], False),
    ({"kind": "annulus", "centre": [0, 0], "inner": 1, "outer": 5, "bottom": 0, "top": 3}, [], False),
    (BALL, [{"kind": "polyhedron", "vertices": [[0, y, z] for y in (-6, 6) for z in (-6, 6)] + [[1, 0, 0]]}], True),
    (BALL, [{"kind": "box", "low": [0, -6, -6], "high": [0, 6, 6]}], True),
    (BALL, [{"kind": "cylinder", "centre": [0, 0], "radius": 2}], False),
    (BALL, [{"kind": "capsule", "start": [0, -6, 1], "end": [0, 6, 1], "radius": 1}], False),
    (BALL, [{"kind": "half_space", "normal": [0, 0, 1], "offset": "1/2"}], False),
    pytest.param(BALL, [{"kind": "ball", "centre": [0, 0, 0], "radius": 3}], False, marks=pytest.mark.deep),
    (BALL, [{"kind": "ball", "centre": [0, 0, 0], "radius": 8}], True),
    daily=3,
)
def test_workspaces_and_obstacles_in_space(domain: Any, listed: list[Any], blocked: bool) -> None:
    found = bezier.route({"domain": domain, "start": ["-4.5", 0, 1], "goal": ["4.5", 0, 1], "obstacle": listed})
    assert found.blocked is blocked
    found.check()


@each("plane10", "window", "slit", "blocked", "touching", "space10")
def test_the_scenes_that_peers_were_run_on(name: str) -> None:
    if not SHARED.is_dir():
        pytest.skip("no folder of scenes beside the project")
    found = bezier.route(SHARED / f"{name}.json")
    found.check()
    assert found.blocked is (name in ("blocked", "touching"))


def test_nearest_points_and_separators_are_those_of_samples() -> None:
    rng = random.Random(1)
    for size in (2, 3):
        for _ in range(40):
            ones, others = ([tuple(Fraction(rng.randint(-9, 9)) for _ in range(size)) for _ in range(5)] for _ in "ab")
            p, q = nearest(ones, others)
            away = subtract(p, q)
            assert min(dot(away, a) for a in ones) == dot(away, p)  # the planes across the ends hold one hull each
            assert max(dot(away, b) for b in others) == dot(away, q)
            if any(away):
                assert dot(away, p) > dot(away, q)
            else:  # they meet: no coordinate separates them
                ends = [(min(c), max(c), min(d), max(d)) for c, d in zip(zip(*ones), zip(*others), strict=True)]
                assert all(a <= d and c <= b for a, b, c, d in ends)


def test_a_broken_search_proves_nothing_false(monkeypatch: pytest.MonkeyPatch) -> None:
    """Obstacles are dropped before the cells are made: no path through them and no false barrier is accepted."""
    rng, refused = random.Random(3), 0
    real = FreeCells.of

    def broken(domain: Cell, walls: Any, budget: Budget) -> FreeCells:
        return real(domain, [w for w in walls if rng.random() < 0.6], budget)

    monkeypatch.setattr(FreeCells, "of", staticmethod(broken))
    monkeypatch.setattr("bezier.scenes.route.shortened", lambda points, obstacles: (points[0], points[-1]))
    for k in range(30):
        scene = read_scene(boxes(rng, 3 if k % 4 == 0 else 2))
        try:
            found = decided(scene, Budget(60))
        except qe.Unable:
            refused += 1
            continue
        found.check()
        assert found.blocked is not flooded_boxes(scene)
    assert refused > 5


def test_half_spaces_that_cut_bodies_prove_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """That they hold the bodies was believed: drawn in a little, they gave proofs of paths through the rims."""
    disc = {"kind": "disc", "centre": [5, 5], "radius": 1}
    scene = read_scene({**SCENE, "obstacle": [disc, {**WALLS[0], "high": [6, 3], "margin": "1/4"}]})
    real, height = Solid.around, Fraction(6) - Fraction(1, 10**9)
    corners = [(Fraction(1), Fraction(5)), (Fraction(1), height), (Fraction(9), height), (Fraction(9), Fraction(5))]
    monkeypatch.setattr(Solid, "around", lambda body, normals: [(n, c - HALF / 500) for n, c in real(body, normals)])
    with pytest.raises(qe.Unable, match="not proved: curve 2"):
        list(route_module.cleared(Route(scene, tuple(pairwise(corners)), None), Budget(20)))
    for body in scene.solids:
        assert all(map(body.is_behind, real(body, directions(2, 3))))
        assert not any(map(body.is_behind, body.around(directions(2, 3))))


def test_altered_answers_are_refused() -> None:
    free, barred = bezier.route(slit(Fraction(1, 1000))), bezier.route(SCENE)
    assert isinstance(free, bezier.Route) and isinstance(barred, bezier.Blocked)
    for altered in (
        replace(free, curves=((free.points[0], free.points[-1]),)),
        replace(free, curves=free.curves[:-1]),
        replace(free, curves=(free.curves[0], ((Fraction(7), Fraction(7)), free.points[-1]))),  # it jumps
        replace(free, scene=barred.scene),
        replace(barred, scene=free.scene),
        replace(barred, goal_side=barred.start_side),
        replace(barred, walls=barred.walls[1:]),
        replace(barred, walls=(replace(barred.walls[0], end=(Fraction(1), Fraction(2))), *barred.walls[1:])),
        replace(barred, around=Cell.box((Fraction(2),) * 2, (Fraction(3),) * 2)),
        replace(barred, certificate=free.certificate),
        replace(barred, certificate=None),
    ):
        with pytest.raises(qe.CertificateRejected):
            altered.check()


def test_every_digit_of_a_stored_certificate_counts() -> None:
    """One altered digit of the digest was accepted: each member was looked at, and not the whole."""
    known = bezier.route(SCENE)
    assert known.certificate is not None
    text = known.certificate.to_json()
    places = [k for k, c in enumerate(text) if c.isdigit()]
    for k in {*random.Random(1).sample(places, 12), places[-1]}:
        altered = text[:k] + str((int(text[k]) + 1) % 10) + text[k + 1 :]
        with pytest.raises((qe.CertificateRejected, qe.InputError)):
            known.check(qe.Certificate.from_json(altered))


def test_formulas_of_bodies_say_what_belongs_to_them() -> None:
    """Against the distance from the core: a polygon with margin, a capsule, a disc, a flat box, a half-plane."""
    rng, ring = random.Random(7), Ring.of(("x", "y"))
    for _ in range(4):
        for body in mixed(rng).obstacles:
            for _ in range(3):
                point = tuple(Fraction(rng.randint(0, 80), 8) for _ in range(2))
                p, q = nearest(body.corners, [point])
                belongs = dot(subtract(p, q), subtract(p, q)) <= body.radius**2
                said = inside(body, [ring.constant(int(8 * c)) for c in point], 8)
                assert body.contains(point) is belongs is (said == TRUE)


@each((1, 0), (2, 1), (3, 1), (3, 2), (4, 2))
def test_a_short_path_is_proved_and_as_smooth_as_asked(degree: int, continuity: int) -> None:
    scene = {**SCENE, "start": [1, 4], "goal": [9, 4], "obstacle": [WALLS[0]]}
    found = bezier.route(scene, shortest=True, degree=degree, continuity=continuity)
    assert isinstance(found, Route) and found.at_least is not None
    found.check()
    least = 2 * 10**0.5 + 2
    assert least * 0.999 < found.at_least < least < found.length < least * 1.01
    for one, other in pairwise(found.curves):
        slopes = [subtract(one[-1], one[-2]), subtract(other[1], other[0])]
        assert one[-1] == other[0] and (continuity < 1 or slopes[0] == slopes[1])
        if continuity > 1:
            ends = one[-3:], other[:3]
            bends = [subtract(subtract(c, b), subtract(b, a)) for a, b, c in ends]
            assert bends[0] == bends[1]
    samples = np.array([[float(c) for c in p] for curve in found.curves for p in Bezier(curve).split()[0].points])
    assert len(samples) and not np.any(np.all((samples > [4, 0]) & (samples < [6, 5]), axis=1))
    assert found.bound is not None
    for altered in (
        replace(found, bound=replace(found.bound, slack=found.bound.slack * 2)),
        replace(found, bound=replace(found.bound, levels=found.bound.levels[1:])),
        replace(found, bound=replace(found.bound, slack=-found.bound.slack - 1)),
        replace(found, bound=replace(found.bound, levels=tuple((k, (n, 2 * c)) for k, (n, c) in found.bound.levels))),
        replace(found, curves=found.curves[1:]),
        replace(found, curves=(tuple(reversed(found.curves[0])), *found.curves[1:])),
    ):
        with pytest.raises(qe.CertificateRejected):
            altered.check()


def test_a_broken_proposer_of_lengths_proves_nothing_false(monkeypatch: pytest.MonkeyPatch) -> None:
    """The solver's answer is disturbed: paths stay clear and bounds below the length, or there is none."""
    rng, real, scene = (
        random.Random(5),
        Conic.solved,
        {**SCENE, "start": [1, 4], "goal": [9, 4], "obstacle": [WALLS[0]]},
    )

    def broken(self: Conic) -> list[float] | None:
        values = real(self)
        return values and [v * rng.uniform(0.9, 1.1) if rng.random() < share else v for v in values]

    monkeypatch.setattr(Conic, "solved", broken)
    for share in (0.01, 0.1, 0.5, 1.0):
        try:
            found = decided(read_scene(scene), Budget(120), wish=Wish())
        except qe.Unable:
            continue
        found.check()
        assert isinstance(found, Route) and found.at_least is not None
        assert found.at_least < 2 * 10**0.5 + 2 < found.length


def test_half_a_door_gives_no_false_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    """Which doors there are was believed: with the upper halves of them the bound was longer than the shortest path."""
    scene = read_scene({**SCENE, "start": [1, 4], "goal": [9, 4], "obstacle": [WALLS[0]]})
    real, half = FreeCells.of, ((Fraction(0), Fraction(1)), Fraction(15, 2))

    def broken(domain: Cell, walls: Any, budget: Budget) -> FreeCells:
        free = real(domain, walls, budget)
        upper = tuple({j: door.cut(half)[1] or door for j, door in doors.items()} for doors in free.doors)
        return replace(free, doors=upper)

    monkeypatch.setattr(FreeCells, "of", staticmethod(broken))
    bound, known = least_length(scene, Budget())
    assert bound.value > 2 * 10**0.5 + 2
    with pytest.raises(qe.Unable, match="left by doors"):
        proved({k: v for k, v in bound.sentences.items() if k not in dict(known)}, Budget(60))


def test_a_certificate_says_itself_which_path_it_is_about(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """--check without the options of --certificate was rejected: another path was found again. Altered ones are."""
    scene, file, proof = (
        {**SCENE, "start": [1, 4], "goal": [9, 4], "obstacle": WALLS[:1]},
        *(tmp_path / name for name in ("scene.json", "proof.json")),
    )
    file.write_text(json.dumps(scene))
    assert main(["route", str(file), "--shortest", "--degree", "2", "--certificate", str(proof)]) == 0
    said = capsys.readouterr().out
    assert main(["route", str(file), "--check", str(proof)]) == 0
    assert capsys.readouterr().out == f"{said}accepted\n"
    given, rng = qe.Certificate.from_json(proof.read_text()), random.Random(3)
    for moved in ({**scene, "goal": [9, 5]}, {**scene, "obstacle": WALLS}):
        with pytest.raises(qe.CertificateRejected):
            checked(read_scene(moved), given)
    for _ in range(40):
        parts = [[member.label, member.certificate] for member in given.payload]  # type: ignore[union-attr]
        part = rng.choice([p for p in parts if any(c.isdigit() for c in p[0])])
        k = rng.choice([k for k, c in enumerate(part[0]) if c.isdigit()])
        part[0] = f"{part[0][:k]}{rng.choice(['7/', '1', ' ', '; '])}{part[0][k:]}"
        with pytest.raises(qe.CertificateRejected):
            checked(read_scene(scene), qe.Certificate.bundle([(label, proved) for label, proved in parts]))


def test_an_obstacle_of_a_high_degree_is_not_left_out_of_a_check() -> None:
    """A certificate that false is false was accepted for each curve along which a polynomial has a degree above 64."""
    wall = {"kind": "formula", "formula": "(x - 5)^66 <= 1"}
    scene = read_scene({**SCENE, "obstacle": [wall]})
    nothing = qe.Certificate.derivation(("t",), FALSE, [], FALSE)
    through = Route(scene, ((scene.start, scene.goal),), None)
    for name in ("curve 1", "curve 1: 1 5; 9 5"):
        with pytest.raises(qe.CertificateRejected):
            through.check(qe.Certificate.bundle([(name, nothing)]))
        with pytest.raises((qe.CertificateRejected, qe.Unable)):
            checked(scene, qe.Certificate.bundle([(name, nothing)]))


def test_what_is_proved_of_one_curve_is_nothing_about_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a curve has no sentence (a polynomial along it has too high a degree), no certificate is enough."""
    scene, usual = read_scene({**SCENE, "obstacle": [{"kind": "formula", "formula": "y <= 1"}]}), route_module.meeting
    aside = (scene.start[0], scene.start[1] + 1)
    two = Route(scene, ((scene.start, aside), (aside, scene.goal)), None)
    first, second = route_module.cleared(two, Budget())
    two.check(qe.Certificate.bundle([first, second]))
    monkeypatch.setattr(
        route_module, "meeting", lambda curve, whole: usual(curve, whole) if curve.points[0][1] == 5 else None
    )
    with pytest.raises(qe.CertificateRejected):
        two.check(qe.Certificate.bundle([first]))


@pytest.mark.deep
@each("plane10", "window")
def test_short_paths_of_the_scenes_that_peers_were_run_on(name: str) -> None:
    if not SHARED.is_dir():
        pytest.skip("no folder of scenes beside the project")
    found = bezier.route(SHARED / f"{name}.json", shortest=True)
    assert isinstance(found, Route) and found.at_least is not None
    assert found.length < {"plane10": 13, "window": 10.3}[name]
    assert found.length < found.at_least * Fraction(101, 100)
    found.check()


def test_the_example_in_toml_is_planned_and_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, picture = ROOT / "examples" / "scenes" / "ring.toml", tmp_path / "ring.svg"
    assert main(["route", str(file), "--picture", str(picture)]) == 0
    assert "clear of all obstacles" in capsys.readouterr().out
    assert "<svg" in picture.read_text() and picture.read_text().count("<path") > 9


@each((".png", b"\x89PNG"), (".pdf", b"%PDF"), (".SVG", b"<?xml"))
def test_a_picture_is_what_its_ending_says(ending: str, begin: bytes, tmp_path: Path) -> None:
    """It was SVG under every name."""
    file, picture = ROOT / "examples" / "scenes" / "slit.json", tmp_path / f"slit{ending}"
    assert main(["route", str(file), "--picture", str(picture)]) == 0
    assert picture.read_bytes().startswith(begin)


@each(
    ("route", "examples/scenes/slit.json", "--picture", "x.jpg", ".svg or .png or .pdf"),
    ("route", "examples/scenes/slit.json", "--picture", "x", ".svg or .png or .pdf"),
    ("route", "examples/scenes/slit.json", "--page", "x.svg", ".html"),
    ("chain", "examples/chains/plane.toml", "--page", "x.png", ".html"),
    ("retime", "examples/joints/path.csv", "--page", "x.txt", ".html"),
    ("certify", "examples/joints/path.csv", "--page", "x.svg", ".html"),
)
def test_other_endings_are_refused_in_one_line(
    command: str, file: str, option: str, name: str, expected: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    more = ["--limits", str(ROOT / "examples/joints/limits.toml")] if command == "retime" else []
    assert main([command, str(ROOT / file), *more, option, str(tmp_path / name)]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and f"{option} {tmp_path / name}: expected a name that ends in {expected}" in said
    assert not (tmp_path / name).exists()


@each(("free", 0, 5), ("blocked", 3, 10))
def test_the_page_of_a_scene_in_space_can_be_turned(word: str, status: int, wide: int, tmp_path: Path) -> None:
    file, page = tmp_path / "scene.json", tmp_path / "page.html"
    wall = {"kind": "box", "low": [4, 0, 0], "high": [6, wide, 10]}
    domain = {"low": [0, 0, 0], "high": [10, 10, 10]}
    file.write_text(json.dumps({"domain": domain, "start": [1, 1, 1], "goal": [9, 9, 9], "obstacle": [wall]}))
    assert main(["route", str(file), "--page", str(page)]) == status
    assert "data-scene" in page.read_text() and f">{word}<" in page.read_text()


def test_an_obstacle_without_an_inside_is_drawn() -> None:
    """A curve was nowhere to be seen on the picture of a free route."""
    curve = {"kind": "formula", "formula": "y = x^2/10 & x >= 2"}
    square = {"low": [0, 0], "high": [10, 10]}
    (body,) = read_scene({"domain": square, "start": [1, 5], "goal": [9, 5], "obstacle": [curve]}).formulas
    axis = np.linspace(0, 10, 101)
    x, y = np.nonzero(excess(body.pieces, [axis, axis, np.zeros(1)])[:, :, 0] >= 0)
    assert len(x) > 80 and axis[x].min() > 1.85 and np.abs(axis[y] - axis[x] ** 2 / 10).max() < 0.35


@each(
    "route examples/scenes/slit.json",
    "chain examples/chains/plane.toml",
    *(f"{name} examples/joints/path.csv --limits examples/joints/limits.toml" for name in ("certify", "retime")),
)
def test_what_is_no_certificate_is_named(words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "x.json"
    file.write_text("{}")
    command, *rest = (str(ROOT / word) if word.startswith("examples") else word for word in words.split())
    assert main([command, *rest, "--check", str(file)]) == 2
    assert f"{file}: not a certificate" in capsys.readouterr().err


def test_a_wall_is_in_its_body_by_its_sides_and_not_by_the_corners_it_names() -> None:
    ball = {"kind": "ball", "centre": [0, 0, 0], "radius": 9}
    scene = {"domain": BALL, "start": ["-4.5", 0, 1], "goal": ["4.5", 0, 1], "obstacle": [{**ball, "radius": 1}]}
    given = read_scene(scene)
    low, high = (tuple(Fraction(s) for s in p) for p in ([-1, -9, -9], [1, 9, 9]))
    wide, small = Cell.box(low, high), Cell.box(given.obstacles[0].corners[0], given.obstacles[0].corners[0])
    sides = [
        Cell.box(*ends)
        for ends in ((tuple(Fraction(-9) for _ in "xyz"), (low[0], *high[1:])), ((high[0], *low[1:]), high))
    ]
    assert dict(covering(given, wide, [], sides))[COVERED] != TRUE
    for wall in (wide, replace(wide, corners=small.corners)):
        with pytest.raises(qe.CertificateRejected, match="corners"):
            dict(covering(given, wide, [wall], sides))


def test_both_doors_say_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, proof = tmp_path / "scene.json", tmp_path / "proof.json"
    for scene, status in ((SCENE, 3), ({**SCENE, "obstacle": WALLS[:1]}, 0), ({**SCENE, "start": [5, 5]}, 3)):
        file.write_text(json.dumps(scene))
        command = ["route", str(file), "--json"]
        assert main([*command, "--certificate", str(proof)]) == status
        assert json.loads(capsys.readouterr().out) == json.loads(json.dumps(bezier.route(scene).to_json()))
        if scene["start"] != [5, 5]:
            assert main([*command, "--check", str(proof)]) == status
            assert json.loads(capsys.readouterr().out)["checked"]


@each(
    (3, "mapping"),
    ("no such file.json", "no such file"),
    ({**SCENE, "start": [1]}, "start"),
    ({**SCENE, "goal": [1, 2, 3]}, "goal"),
    ({**SCENE, "domain": {"low": [1, 1], "high": [0, 2]}}, "domain"),
    ({**SCENE, "obstacle": {"kind": "box"}}, "obstacle"),
    ({**SCENE, "obstacle": [{"kind": "cone"}]}, "obstacle[0].kind"),
    ({**SCENE, "obstacle": [{"kind": "ball", "centre": [1, 1], "radius": 1, "rad": 2}]}, "radius is probably meant"),
    ({**SCENE, "stat": [1, 2]}, "start is probably meant"),
    ({**SCENE, "domain": {"kind": "annulus", "centre": [0, 0], "inner": 2, "outer": 1}}, "inner"),
    ({**SCENE, "domain": {"kind": "half_plane", "normal": [0, 1], "offset": 1}}, "bounded"),
    ({**SCENE, "obstacle": [{"kind": "ball", "centre": [1, 1], "radius": 0}]}, "radius"),
    ({**SCENE, "obstacle": [{"kind": "ball", "centre": "here", "radius": 1}]}, "centre"),
    ({**SCENE, "obstacle": [{"kind": "formula"}]}, "formula in x"),
    ({**SCENE, "obstacle": [{"kind": "formula", "formula": "x^2 + y^2 < 1"}]}, "closed"),
    ({**SCENE, "obstacle": [{"kind": "formula", "formula": "x^2 + z^2 <= 1"}]}, "x and y"),
    ({**SCENE, "obstacle": [{"kind": "formula", "formula": "x <="}]}, "obstacle[0].formula"),
    ({**SCENE, "obstacle": [{"kind": "formula", "formula": "x^2 + y^2 < 1"}], "margin": 1}, "closed"),
    ({**SCENE, "domain": {"kind": "formula", "formula": "x^2 + y^2 <= 1"}}, "bounded"),
)
def test_bad_scenes_are_one_line_that_names_the_entry(scene: object, word: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        bezier.route(scene)
    assert word in str(caught.value).lower() and "\n" not in str(caught.value)


def test_decimals_of_a_json_scene_are_exact(tmp_path: Path) -> None:
    """They were refused as floats."""
    text = '{"domain": {"low": [0, 0], "high": [10, 10.1]}, "start": [1, 0.1], "goal": [9, 5]}'
    (tmp_path / "s.json").write_text(text)
    assert load_scene(tmp_path / "s.json").start == (1, Fraction(1, 10))

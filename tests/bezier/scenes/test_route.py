"""Scenes: every answer against a flood of a grid, every proof against broken ones, both doors the same."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections import deque
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import bezier
import qe
from bezier.scenes import cells as cell_module
from bezier.scenes.route import decided
from bezier.scenes.scene import SolidBall, read_scene
from experiments.problem import ROOT
from qe.options import Budget
from tests.tables import each

WALLS = [{"kind": "box", "low": [4, 0], "high": [6, 5]}, {"kind": "box", "low": [4, 5], "high": [6, 10]}]
SCENE: dict[str, Any] = {
    "domain": {"low": [0, 0], "high": [10, 10]},
    "start": [1, 5],
    "goal": [9, 5],
    "obstacle": WALLS,
}
SHARED = ROOT.parent / "shared" / "corpora" / "scenes"


def slit(gap: Fraction) -> dict[str, Any]:
    return {**SCENE, "obstacle": [WALLS[0], {**WALLS[1], "low": [4, 5 + gap]}]}


@each(*range(1, 13))
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
                clear = scene.domain.contains(other) and not any(b.meets(point, other) for b in scene.obstacles)
                if clear and other not in seen:
                    seen.add(other)
                    waiting.append(other)
    return False


def check(scene: Any, step: Fraction) -> bool:
    """Whether it is free; the flood says the same, and the proof stands."""
    found = decided(scene, Budget(60))
    found.check()
    if any(scene.blocked_at(p) for p in (scene.start, scene.goal)):
        assert found.blocked
    else:
        assert found.blocked is not flooded(scene, step)
    return not found.blocked


def test_boxes_agree_with_a_flood_of_the_grid() -> None:
    rng, free = random.Random(4), 0
    for k in range(20):
        free += check(read_scene(boxes(rng, 3 if k % 4 == 0 else 2)), Fraction(1, 2))
    assert 2 < free < 18


@pytest.mark.deep
def test_many_boxes_agree_with_a_flood_of_the_grid() -> None:
    rng = random.Random(8)
    for k in range(500):
        check(read_scene(boxes(rng, 3 if k % 5 == 0 else 2)), Fraction(1, 2))


def discs(rng: random.Random) -> dict[str, Any]:
    listed = [
        {"kind": "ball", "centre": [rng.randint(1, 9), rng.randint(1, 9)], "radius": Fraction(rng.randint(2, 9), 4)}
        for _ in range(rng.randint(4, 10))
    ]
    return {**SCENE, "start": ["1/4", "1/4"], "goal": ["39/4", "39/4"], "obstacle": listed}


def test_discs_never_contradict_a_walk_and_are_seldom_undecided() -> None:
    rng, undecided, free = random.Random(12), 0, 0
    for _ in range(15):
        scene = read_scene(discs(rng))
        try:
            found = decided(scene, Budget(60))
        except qe.Unable:
            undecided += 1
            continue
        found.check()
        free += not found.blocked
        if found.blocked:
            assert not flooded(scene, Fraction(1, 4))
    assert undecided <= 2 and 1 < free < 14  # discs that touch are undecided


@each("plane10", "window", "slit", "blocked", "touching", "space10")
def test_the_scenes_that_peers_were_run_on(name: str) -> None:
    if not SHARED.is_dir():
        pytest.skip("no folder of scenes beside the project")
    found = bezier.route(SHARED / f"{name}.json")
    found.check()
    assert found.blocked is (name in ("blocked", "touching"))


def test_slices_of_a_ball_are_inside_and_around_it() -> None:
    rng = random.Random(1)
    for dimension in (2, 3):
        centre = tuple(Fraction(rng.randint(-9, 9), 7) for _ in range(dimension))
        ball = SolidBall(centre, Fraction(rng.randint(1, 9), 5))
        for steps in (2, 3, 8):
            inner, outer = ball.inner(steps), ball.outer(steps)
            for _ in range(200):
                point = tuple(c + ball.radius * Fraction(rng.randint(-20, 20), 20) for c in centre)
                assert ball.contains(point) or not any(box.contains(point) for box in inner)
                assert not ball.contains(point) or any(box.contains(point) for box in outer)


def test_a_broken_search_proves_nothing_false(monkeypatch: pytest.MonkeyPatch) -> None:
    """Obstacles are dropped before the cells are made: no path through them and no false barrier is accepted."""
    rng, refused = random.Random(3), 0
    real = cell_module.CellGrid.of

    def broken(scene: Any, walls: Any) -> Any:
        return real(scene, [w for w in walls if rng.random() < 0.6])

    monkeypatch.setattr(cell_module.CellGrid, "of", staticmethod(broken))
    monkeypatch.setattr("bezier.scenes.route.shortened", lambda points, obstacles: (points[0], points[-1]))
    for k in range(30):
        scene = read_scene(boxes(rng, 3 if k % 4 == 0 else 2))
        try:
            found = decided(scene, Budget(60))
        except qe.Unable:
            refused += 1
            continue
        found.check()
        if not any(scene.blocked_at(p) for p in (scene.start, scene.goal)):
            assert found.blocked is not flooded(scene, Fraction(1, 2))
    assert refused > 5


def test_altered_answers_are_refused() -> None:
    free, barred = bezier.route(slit(Fraction(1, 1000))), bezier.route(SCENE)
    assert isinstance(free, bezier.Route) and isinstance(barred, bezier.Blocked)
    for altered in (
        replace(free, points=(free.points[0], free.points[-1])),
        replace(free, points=free.points[:-1]),
        replace(free, scene=barred.scene),
        replace(barred, scene=free.scene),
        replace(barred, goal_side=barred.start_side),
        replace(barred, walls=(*barred.walls, replace(barred.walls[0], low=(Fraction(0), Fraction(0))))),
        replace(barred, certificate=free.certificate),
        replace(barred, certificate=None),
    ):
        with pytest.raises(qe.CertificateRejected):
            altered.check()


def test_both_doors_say_the_same(tmp_path: Path) -> None:
    file, proof = tmp_path / "scene.json", tmp_path / "proof.json"
    for scene, status in ((SCENE, 3), ({**SCENE, "obstacle": WALLS[:1]}, 0), ({**SCENE, "start": [5, 5]}, 3)):
        file.write_text(json.dumps(scene))
        command = [sys.executable, "-m", "bezier", "route", str(file), "--json"]
        done = subprocess.run([*command, "--certificate", str(proof)], capture_output=True, text=True, check=False)
        assert done.returncode == status
        assert json.loads(done.stdout) == json.loads(json.dumps(bezier.route(scene).to_json()))
        again = subprocess.run([*command, "--check", str(proof)], capture_output=True, text=True, check=False)
        assert (again.returncode == status and json.loads(again.stdout)["checked"]) or scene["start"] == [5, 5]


@each(
    (3, "mapping"),
    ("no such file.json", "no such file"),
    ({**SCENE, "start": [1]}, "start"),
    ({**SCENE, "goal": [1, 2, 3]}, "dimension"),
    ({**SCENE, "domain": {"low": [1, 1], "high": [0, 2]}}, "domain"),
    ({**SCENE, "obstacle": {"kind": "box"}}, "obstacle"),
    ({**SCENE, "obstacle": [{"kind": "cone"}]}, "obstacle 1"),
    ({**SCENE, "obstacle": [{"kind": "ball", "centre": [1, 1], "radius": 0}]}, "radius"),
    ({**SCENE, "obstacle": [{"kind": "ball", "centre": "here", "radius": 1}]}, "centre"),
)
def test_bad_scenes_are_one_line_that_names_the_entry(scene: object, word: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        bezier.route(scene)
    assert word in str(caught.value).lower() and "\n" not in str(caught.value)

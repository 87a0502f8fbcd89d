"""Trajectories in scenes: every kind of obstacle and workspace against distances of samples by other formulas."""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction as F
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from matplotlib.path import Path as Outline
from scipy.interpolate import CubicSpline

import bezier
import qe
from bezier.cli.app import main
from bezier.input.toml_table import Table
from bezier.trajectories.command import Certified
from bezier.trajectories.piecewise import Trajectory
from bezier.trajectories.readers import from_scipy
from qe.errors import InputError
from qe.exact.rational_poly import RationalPoly
from tests.tables import each

Away = Callable[[Any], Any]
"""How far points (n, d) are from a body, nothing or less inside."""
TIMES = np.linspace(0, 3, 4001)
ELL = [[-2, -2], [2, -2], [2, 0], [0, 0], [0, 2], [-2, 2]]


def segment(a: Any, b: Any) -> Away:
    a, b = np.array(a, dtype=float), np.array(b, dtype=float)

    def away(p: Any) -> Any:
        share = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        return np.linalg.norm(p - a - share[:, None] * (b - a), axis=1)

    return away


def outline(corners: Any) -> Away:
    sides = [segment(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
    return lambda p: np.where(Outline(corners).contains_points(p), -1, 1) * np.min([s(p) for s in sides], axis=0)


def cuboid(low: Any, high: Any) -> Away:
    return lambda p: np.linalg.norm(np.maximum(np.maximum(np.array(low) - p, p - np.array(high)), 0), axis=1)


def half(normal: Any, offset: float) -> Away:
    return lambda p: (p @ np.array(normal) - offset) / np.linalg.norm(normal)


KINDS: list[tuple[int, dict[str, Any], Away]] = [
    (2, {"kind": "capsule", "start": [-1, 1], "end": [2, 0], "radius": "1/2"}, segment([-1, 1], [2, 0])),
    (2, {"kind": "half_plane", "normal": [1, 2], "offset": -2, "margin": "1/2"}, half([1, 2], -2)),
    (2, {"kind": "polygon", "vertices": ELL, "margin": "1/2"}, outline(ELL)),
    (2, {"kind": "box", "low": [-1, -2], "high": [1, 1], "margin": "1/2"}, cuboid([-1, -2], [1, 1])),
    (2, {"kind": "disc", "centre": [1, 0], "radius": "1/2"}, lambda p: np.linalg.norm(p - [1, 0], axis=1)),
    (3, {"kind": "mesh", "file": "box.stl", "margin": "1/2"}, cuboid([-1, -1, -1], [1, 1, 1])),
    (3, {"kind": "capsule", "start": [-1, 1, 0], "end": [2, 0, 1], "radius": "1/2"}, segment([-1, 1, 0], [2, 0, 1])),
    (3, {"kind": "half_space", "normal": [0, 2, 1], "offset": -3, "margin": "1/2"}, half([0, 2, 1], -3)),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made: Path = tmp_path_factory.mktemp("scene")
    trimesh.creation.box((2, 2, 2)).export(made / "box.stl")
    return made


def motion(seed: int, size: int, wide: float = 2) -> CubicSpline:
    places = np.random.default_rng(seed).uniform(-wide, wide, (4, size)) + 7 * (seed % 2)
    return CubicSpline(range(4), places.round(1))


def certified(folder: Path, moving: CubicSpline, scene: dict[str, Any], capsys: Any, *words: str) -> dict[str, Any]:
    np.savez(folder / "m.npz", c=moving.c, x=moving.x)
    (folder / "s.json").write_text(json.dumps(scene))
    given = ["certify", str(folder / "m.npz"), "--scene", str(folder / "s.json"), "--json"]
    assert main([*given, *words]) == 0
    result: dict[str, Any] = json.loads(capsys.readouterr().out)
    return result


@each(*range(len(KINDS)), daily=2)
def test_what_is_met_is_what_samples_meet(k: int, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    size, table, away = KINDS[k]
    seen, proof = set(), str(folder / "c.json")
    for seed in range(6):
        moving = motion(seed, size)
        result = certified(folder, moving, {"obstacle": [table]}, capsys, "--certificate", proof)
        apart = away(moving(TIMES)) - 0.5
        if abs(apart.min()) > 1e-2:
            assert result["kept"] is bool(apart.min() > 0)
            seen.add(result["kept"])
        assert qe.verify(qe.Certificate.from_json(Path(proof).read_text())).accepted
    assert seen == {True, False}


def test_a_certificate_about_a_mesh_says_that_its_parts_cover_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    proof = folder / "c.json"
    scene = {"obstacle": [{"kind": "mesh", "file": "box.stl", "shift": [20, 0, 0]}]}
    certified(folder, motion(1, 3), scene, capsys, "--certificate", str(proof))
    certified(folder, motion(1, 3), scene, capsys, "--check", str(proof))
    given = qe.Certificate.from_json(proof.read_text())
    assert isinstance(given.payload, tuple) and any("cells cover the box around it" in m.label for m in given.payload)
    proof.write_text(qe.Certificate.bundle([(m.label, m.certificate) for m in given.payload[:-1]]).to_json())
    words = ["certify", str(folder / "m.npz"), "--scene", str(folder / "s.json"), "--check", str(proof)]
    assert main(words) == 4
    capsys.readouterr()


@each("ball", "annulus", "box")
def test_a_workspace_is_left_where_samples_leave_it(
    kind: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    domain = {
        "ball": {"kind": "ball", "centre": [0, 0], "radius": 5},
        "annulus": {"kind": "annulus", "centre": [0, 0], "inner": "1/2", "outer": 6},
        "box": {"low": [-4, -4], "high": [4, "9/2"]},
    }[kind]
    seen = set()
    for seed in range(0, 24, 2):
        moving = motion(seed, 2, 4)
        x, y = moving(TIMES).T
        r = np.hypot(x, y)
        beyond = {
            "ball": r - 5,
            "annulus": np.maximum(r - 6, 0.5 - r),
            "box": np.maximum(np.maximum(x - 4, y - 4.5), np.maximum(-4 - x, -4 - y)),
        }[kind].max()
        if abs(beyond) > 1e-2:
            kept = certified(folder, moving, {"domain": domain}, capsys)["kept"]
            assert kept is bool(beyond < 0)
            seen.add(kept)
    assert seen == {True, False}


def test_a_half_plane_counts_far_from_where_the_point_begins_and_ends() -> None:
    """Bodies without end were cut to a box around the workspace, which a trajectory need not have."""
    moving = CubicSpline([0, 1, 2], [[0, 0], [50, 0], [0, 0]])
    wall = {"kind": "half_plane", "normal": [-1, 0], "offset": -40}
    assert not bezier.certify(moving, obstacles=[wall]).kept
    assert bezier.certify(moving, obstacles=[{**wall, "offset": -60}]).kept
    table = Table({"domain": {"low": ["-1", "-1"], "high": ["1", "1"]}, "obstacle": [wall]})
    left = Certified.of(from_scipy(moving), (), table, F(0))
    assert not left.kept and not left.clear


def test_a_scene_of_another_dimension_is_one_clear_line() -> None:
    with pytest.raises(InputError, match="a trajectory of 2 or 3 axes, found 1"):
        bezier.certify(CubicSpline([0, 1], [0, 1]), obstacles=[{"kind": "disc", "centre": [0, 0], "radius": 1}])
    with pytest.raises(InputError, match=r"obstacles\[0\].kind: expected one of .*found \"cylinder\""):
        bezier.certify(motion(0, 2), obstacles=[{"kind": "cylinder", "centre": [0, 0], "radius": 1}])


def test_what_has_no_proof_is_not_left_out_of_a_certificate() -> None:
    """A plane touched at an irrational time: the certificate was an empty bundle, which its own check rejected."""
    touching = Trajectory(("x", "y"), (F(0), F(1)), ((RationalPoly.of([0, 1]), RationalPoly.of([1, 0, -4, 0, 4])),))
    found = Certified.of(touching, [], Table({"obstacle": [{"kind": "formula", "formula": "y <= 0"}]}, ""), F(0))
    assert not found.clear
    with pytest.raises(qe.Unable, match="irrational time"):
        found.certificate

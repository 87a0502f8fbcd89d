"""Regions and radii of validity against bisection with clarabel on a model of its own; altered certificates; hulls."""

from __future__ import annotations

import json
import random
from fractions import Fraction
from typing import Any

import clarabel
import numpy as np
import pytest
from scipy import sparse
from scipy.spatial import ConvexHull

import bezier
import qe
from bezier.chains import proposals
from bezier.chains.region import Hull
from bezier.cli.app import main
from qe.errors import InputError, Unable
from tests.tables import each

PLANE = [[0, 0], [2, 1], [3, 3], [5, 2], [6, 4]]


def chain(points: Any, **given: Any) -> Any:
    return bezier.chain(start=points[0], via=points[1:-1], goal=points[-1], **given)


def excess(points: Any, radius: float) -> float:
    """By how much the ball has to grow for a C2 cubic chain: all control points are variables, joins are equations."""
    points = np.array(points, dtype=float)
    n, d = len(points) - 1, points.shape[1]
    width = 2 * n * d + 1

    def line(*terms: tuple[int, int, float]) -> tuple[np.ndarray, np.ndarray]:
        block, right = np.zeros((d, width)), np.zeros(d)
        for k, j, w in terms:
            if j in (0, 3):
                right -= w * points[k + (j == 3)]
            else:
                block[:, (2 * k + j - 1) * d : (2 * k + j) * d] += w * np.eye(d)
        return block, right

    equations = []
    for k in range(n - 1):
        equations.append(line((k, 3, 1), (k, 2, -1), (k + 1, 1, -1), (k + 1, 0, 1)))
        equations.append(line((k, 3, 1), (k, 2, -2), (k, 1, 1), (k + 1, 2, -1), (k + 1, 1, 2), (k + 1, 0, -1)))
    rows, right = [b for b, _ in equations], [r for _, r in equations]
    cones = [clarabel.ZeroConeT(sum(len(r) for r in right))]
    for at in range(2 * n):
        head = np.zeros((1, width))
        head[0, -1] = -1
        rows += [head, -np.eye(width)[at * d : (at + 1) * d]]
        right += [np.array([radius]), np.zeros(d)]
        cones.append(clarabel.SecondOrderConeT(d + 1))
    cost = np.zeros(width)
    cost[-1] = 1
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    zero, matrix = sparse.csc_matrix((width, width)), sparse.csc_matrix(np.concatenate(rows))
    answer = clarabel.DefaultSolver(zero, cost, matrix, np.concatenate(right), cones, settings).solve()
    return max(float(answer.x[-1]), float(np.linalg.norm(points, axis=1).max()) - radius)


def reach(points: Any, k: int, way: Any, radius: float) -> float:
    """How far point k may go in a direction, by bisection."""
    low, high = 0.0, 3 * radius
    while high - low > 1e-8:
        middle = (low + high) / 2
        moved = [np.array(p, dtype=float) + (middle * way if i == k else 0) for i, p in enumerate(points)]
        low, high = (middle, high) if excess(moved, radius) <= 1e-10 else (low, middle)
    return low


@each(*range(6), daily=2)
def test_the_radius_of_validity_is_that_of_bisection(seed: int) -> None:
    chance = random.Random(seed)
    points = [[Fraction(chance.randint(-40, 40), 10) for _ in range(2)] for _ in range(5)]
    k, radius = chance.randint(1, 3), Fraction(13, 2)
    made = chain(points, radius=radius)
    if not made.feasible:
        with pytest.raises(Unable):
            made.validity(f"via[{k - 1}]")
        return
    found = made.validity(f"via[{k - 1}]")
    assert found.low <= found.high <= found.low * (1 + Fraction(2, 10**6)) and qe.verify(found.certificate).accepted
    way = np.array([float(c) for c in found.towards])
    exact = reach(points, k, way / np.linalg.norm(way), float(radius))
    assert float(found.low) * (1 - 1e-6) - 1e-7 <= exact <= float(found.high) * (1 + 1e-6) + 1e-7
    for turn in np.linspace(0, 2 * np.pi, 7)[:-1]:
        assert reach(points, k, np.array([np.cos(turn), np.sin(turn)]), float(radius)) >= float(found.low) - 1e-7


@each("start", *(pytest.param(name, marks=pytest.mark.deep) for name in ("via[1]", "C2.1")))
def test_regions_are_proved_from_both_sides(name: str) -> None:
    found = chain(PLANE, radius=8).region(name)
    assert found.gap <= Fraction(1, 1000) and qe.verify(found.certificate).accepted
    assert all(sum(a * x for a, x in zip(n, p, strict=True)) <= b for p in found.inner for n, b in found.outer)
    if name.startswith("C"):
        return
    k = 2 if name == "via[1]" else 0
    centre = np.mean([[float(c) for c in p] for p in found.inner], axis=0)
    for turn in np.linspace(0.1, 6, 6):
        way = np.array([np.cos(turn), np.sin(turn)])
        farthest = [
            (float(b) - np.dot(n, centre)) / np.dot(n, way) for n, b in _floats(found.outer) if np.dot(n, way) > 0
        ]
        moved = [centre if i == k else p for i, p in enumerate(PLANE)]
        assert reach(moved, k, way, 8.0) == pytest.approx(min(farthest), rel=2e-3)


def _floats(outer: Any) -> list[tuple[Any, float]]:
    return [(np.array([float(c) for c in n]), float(b)) for n, b in outer]


@pytest.mark.deep
def test_regions_in_space_and_of_infeasible_chains() -> None:
    points = [[1, -5, -1], [-2, -4, 4], [-1, 6, 1], [1, 2, 2], [-4, -1, -3]]
    none = chain(points, radius="6.5")
    found = none.region("via[1]")
    assert found.gap <= Fraction(1, 20) and qe.verify(found.certificate).accepted
    assert any(sum(a * x for a, x in zip(n, points[2], strict=True)) > b for n, b in found.outer)
    with pytest.raises(Unable, match="where it is"):
        none.validity("via[1]")


def test_a_broken_proposer_gives_no_wrong_region(monkeypatch: pytest.MonkeyPatch) -> None:
    right = chain(PLANE[:4], radius=6).region("start", Fraction(1, 10))
    honest, chance = proposals.best, random.Random(5)

    def broken(*given: Any) -> Any:
        answer = honest(*given)
        point = tuple(tuple(c + chance.choice((0, 0, 0, 1e-3, -2)) for c in p) for p in answer.point)
        return proposals.Proposal(
            point, tuple(w * chance.choice((1, 1, 1, 0.5, -1)) for w in answer.weights), answer.excess
        )

    made = chain(PLANE[:4], radius=6)
    monkeypatch.setattr(proposals, "best", broken)
    for _ in range(3):
        try:
            found = made.region("start", Fraction(1, 2))
        except Unable:
            continue
        for p in found.inner:
            assert all(sum(a * x for a, x in zip(n, p, strict=True)) <= b for n, b in right.outer)
        for p in right.inner:
            assert all(sum(a * x for a, x in zip(n, p, strict=True)) <= b for n, b in found.outer)


@pytest.mark.parametrize("dimension", [2, 3])
def test_hulls_are_those_of_qhull(dimension: int) -> None:
    chance = random.Random(dimension)
    points = [tuple(Fraction(chance.randint(-999, 999)) for _ in range(dimension)) for _ in range(40)]
    made = Hull(dimension)
    for p in points:
        made.add(p)
    assert all(f.beyond(p) <= 0 for f in made.facets for p in points)
    other = ConvexHull(np.array([[float(c) for c in p] for p in points]))
    assert set(made.corners) == set(other.vertices.tolist()) and len(made.facets) == len(other.equations)
    flat = Hull(dimension)
    for k in range(6):
        flat.add((Fraction(k),) * dimension)
    assert not flat.facets


def test_the_command_says_where(capsys: pytest.CaptureFixture[str], tmp_path: Any) -> None:
    file, page = tmp_path / "chain.toml", tmp_path / "page.html"
    file.write_text("start = [0, 0]\nvia = [[2, 1]]\ngoal = [3, 3]\nradius = 6\n")
    assert main(["chain", str(file), "--region", "via[0]", "--page", str(page), "--json"]) == 0
    data = json.loads(capsys.readouterr().out)["region"]
    assert len(data["inner"]) == len(data["outer"]) and len(data["may move by"]) == 2
    assert "where via[0] may be" in page.read_text()
    assert main(["chain", str(file), "--region", "via[7]"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "expected one of" in line


def test_wrong_names_and_accuracies_are_refused() -> None:
    made = chain(PLANE, radius=8)
    for name in ("via[7]", "C9.1", "C1.9", "x"):
        with pytest.raises(InputError, match="expected one of"):
            made.region(name)
    for name, accuracy, word in ((3, None, "name"), ("start", "x", "accuracy"), ("start", 0, "accuracy")):
        with pytest.raises(InputError, match=word):
            made.region(name, accuracy)
    with pytest.raises(InputError, match="bounds"):
        chain(PLANE[:3], radius=8, max_length=20).region("via[0]")


def test_regions_within_half_spaces_alone_were_called_unbounded() -> None:
    """Rounded multipliers cannot prove a linear bound without a ball; the simplex method gives vertices exactly."""
    box = [((1, 0), -15), ((-1, 0), -15), ((0, 1), -12), ((0, -1), -12)]
    made = bezier.chain(start=(0, 0), via=[(3, 2), (6, 2)], goal=(10, 0), half_spaces=box)
    found = made.region("via[0]")
    assert sorted(found.inner) == [(-15, -12), (-15, 12), (15, -12), (15, 12)] and found.gap == 0
    assert len(found.outer) == 4 and qe.verify(found.certificate).accepted
    assert str(made.validity("via[0]")).startswith("via[0] may move by 10 in every direction")
    with pytest.raises(Unable, match="unbounded"):
        bezier.chain(start=(0, 0), via=[(3, 2)], goal=(10, 0), half_spaces=box[:3]).region("via[0]")

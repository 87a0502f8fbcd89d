"""Chains, timed paths and scenes side by side with what people use: clarabel on a model of its own, toppra, a flood.

Chains: cubic, C2, in a ball, least sum of squared legs. clarabel gets all control points as variables and the joins as
equations; it gives numbers, no proof. Paths: natural cubic splines timed by toppra for |v| <= 1, |a| <= 2; our part is
``bezier.certify``, which says exactly where the limits are broken, and the slowing-down that repairs it, and
``bezier.retime``, the least time from both sides. Scenes:
``bezier.route``, next to a flood of a grid of 200 points a side that proves nothing. Cases come
from ``shared/corpora/scenes`` next to the project where it is, else from a seed.
"""

from __future__ import annotations

import json
import random
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

import bezier
import qe
from bezier.pictures.route import inline
from bezier.report import html
from bezier.report.chain import pictures
from bezier.report.html import Card, Page, Section, document
from bezier.trajectories.piecewise import Trajectory
from qe.errors import Unable

CORPUS = Path(__file__).resolve().parents[2] / "shared" / "corpora" / "scenes"
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class ChainRow:
    """One chain: what is proved, what clarabel says; seconds of processor time."""

    via: int
    ours: str
    value: float | None
    gap: float | None
    seconds: float
    accepted: bool
    clarabel: str
    clarabel_value: float | None
    clarabel_seconds: float | None

    @property
    def agrees(self) -> bool:
        """Whether both say the same, values within 1e-8."""
        if self.clarabel_value is None or self.value is None:
            return (self.clarabel_value is None) == (self.value is None) or self.clarabel == "not installed"
        return abs(self.value - self.clarabel_value) <= 1e-8 * abs(self.value) + 1e-8


@dataclass(frozen=True, slots=True)
class PathRow:
    """One path as toppra times it, and what is proved of that."""

    axes: int
    intervals: int
    duration: float
    toppra_seconds: float
    kept: bool
    worst: str
    slower_by: float | None
    seconds: float
    ours: float
    at_least: float
    our_seconds: float


@dataclass(frozen=True, slots=True)
class SceneRow:
    """One scene: what is proved, the length and its bound, and whether a flood gets through (None in space)."""

    name: str
    obstacles: int
    ours: str
    seconds: float
    accepted: bool
    flood: bool | None
    length: float | None
    at_least: float | None


def timed(work: Callable[[], T]) -> tuple[T, float]:
    """What it gives, and its processor time."""
    start = time.process_time()
    return work(), time.process_time() - start


# --- chains ---------------------------------------------------------------------------------------------------
def chain_cases(count: int) -> Iterator[tuple[list[Any], Any]]:
    """Points and radius."""
    if (CORPUS / "chains.json").exists():
        yield from ((c["points"], c["radius"]) for c in json.loads((CORPUS / "chains.json").read_text())[:count])
        return
    chance = random.Random(28)
    for _, via in zip(range(count), (2, 2, 3, 5, 5, 8, 12, 12, 20, 30, 30, 50), strict=False):
        points = [[chance.randint(-600, 600) / 100 for _ in range(3)] for _ in range(via + 2)]
        yield points, round(1.03 * max(float(np.linalg.norm(p)) for p in points), 2)


def chain_row(points: Sequence[Any], radius: Any) -> tuple[ChainRow, Any]:
    """The comparison, and our plan (None where nothing was proved)."""
    plan, why = None, ""
    start = time.process_time()
    try:
        plan = bezier.chain(start=points[0], via=points[1:-1], goal=points[-1], radius=radius)
    except Unable as error:
        why = str(error)
    seconds = time.process_time() - start
    other, other_seconds = timed(lambda: clarabel_chain(points, float(radius)))
    status, least = other
    value = None if plan is None or plan.value is None else float(plan.value)
    gap = None if plan is None or plan.value is None else float(plan.value - (plan.bound or 0)) / (value or 1)
    ours = why or ("" if plan is None else str(plan))
    accepted = plan is not None and qe.verify(plan.certificate).accepted
    row = ChainRow(len(points) - 2, ours, value, gap, seconds, accepted, status, least, other_seconds)
    return row, plan


def clarabel_chain(points: Sequence[Any], radius: float) -> tuple[str, float | None]:
    """clarabel's status and least sum of squared legs of the C2 cubic chain in the ball; None where it says none."""
    try:
        import clarabel
        from scipy import sparse
    except ImportError:
        return "not installed", None
    corners = np.array(points, dtype=float)
    n, d = len(corners) - 1, corners.shape[1]
    width = 2 * n * d

    def line(*terms: tuple[int, int, float]) -> tuple[Any, Any]:
        block, right = np.zeros((d, width)), np.zeros(d)
        for k, j, w in terms:
            if j in (0, 3):
                right -= w * corners[k + (j == 3)]
            else:
                block[:, (2 * k + j - 1) * d : (2 * k + j) * d] += w * np.eye(d)
        return block, right

    joins = [line((k, 3, 1), (k, 2, -1), (k + 1, 1, -1), (k + 1, 0, 1)) for k in range(n - 1)]
    joins += [line((k, 2, -2), (k, 1, 1), (k + 1, 2, -1), (k + 1, 1, 2)) for k in range(n - 1)]
    legs = [line((k, j + 1, 1.0), (k, j, -1.0)) for k in range(n) for j in range(3)]
    hessian = sum(2 * block.T @ block for block, _ in legs)
    linear = sum(-2 * block.T @ right for block, right in legs)
    rows, right = [b for b, _ in joins], [r for _, r in joins]
    cones = [clarabel.ZeroConeT(sum(len(r) for r in right))] if joins else []
    for at in range(2 * n):
        rows += [np.zeros((1, width)), -np.eye(width)[at * d : (at + 1) * d]]
        right += [np.array([radius]), np.zeros(d)]
        cones.append(clarabel.SecondOrderConeT(d + 1))
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = 1e-11
    quadratic, matrix = sparse.csc_matrix(np.triu(hessian)), sparse.csc_matrix(np.concatenate(rows))
    answer = clarabel.DefaultSolver(quadratic, linear, matrix, np.concatenate(right), cones, settings).solve()
    solved = str(answer.status) in ("Solved", "AlmostSolved") and np.linalg.norm(corners, axis=1).max() <= radius
    x = np.array(answer.x)
    return str(answer.status), float(sum(np.sum((b @ x - r) ** 2) for b, r in legs)) if solved else None


# --- paths ----------------------------------------------------------------------------------------------------
def path_cases(count: int) -> Iterator[list[Any]]:
    """Points in 3 and 6 axes."""
    if (CORPUS / "paths.json").exists():
        yield from (c["points"] for c in json.loads((CORPUS / "paths.json").read_text())[:count])
        return
    chance = random.Random(5)
    for k in range(count):
        yield [[chance.uniform(-1, 1) for _ in range(3 if k % 2 else 6)] for _ in range(8)]


def toppra_law(points: Sequence[Any], intervals: int) -> tuple[Any, Any] | None:
    """The spline and (times, s, s', s'') of toppra; None where it is not installed."""
    try:
        import toppra
        from scipy.interpolate import CubicSpline
        from toppra import algorithm, constraint
    except ImportError:
        return None
    toppra.setup_logging("ERROR")
    path = CubicSpline(np.linspace(0, 1, len(points)), points, bc_type="natural")
    geometric = toppra.SplineInterpolator(path.x, path(path.x), bc_type="natural")
    bounds = np.array([[-1.0, 1.0]] * len(points[0]))
    limits = [constraint.JointVelocityConstraint(bounds), constraint.JointAccelerationConstraint(2 * bounds)]
    grid = np.linspace(0, 1, intervals + 1)
    law = algorithm.TOPPRA(limits, geometric, gridpoints=grid, parametrizer="ParametrizeConstAccel")
    answer = law.compute_trajectory(0, 0)
    return path, (answer._ts, answer._ss, answer._velocities, answer._us)


def path_row(points: Sequence[Any], intervals: int) -> tuple[PathRow, Any] | None:
    """What toppra's timing keeps, proved; None without toppra."""
    from bezier.trajectories.exact import composed
    from bezier.trajectories.readers import from_scipy
    from qe.exact.rational_poly import RationalPoly

    made, toppra_seconds = timed(lambda: toppra_law(points, intervals))
    if made is None:
        return None
    path, law = made
    times, s, speed, force = ([Fraction(float(x)) for x in part] for part in law)
    laws = [RationalPoly.of([s[i], speed[i], force[i] / 2]) for i in range(len(times) - 1)]
    trajectory: Trajectory = composed(from_scipy(path), times, laws)
    result, seconds = timed(lambda: bezier.certify(trajectory, velocity=1, acceleration=2))
    fastest, our_seconds = timed(lambda: bezier.retime(path, velocity=1, acceleration=2))
    worst, factor = result.verdict.worst, result.slower_by
    words = "" if worst is None else f"{worst.limit.words(trajectory.names)} {worst.value:.6g}"
    slower = None if factor is None else float(factor)
    axes, duration = len(points[0]), float(times[-1] - times[0])
    ours = float(fastest.duration), float(fastest.bound), our_seconds
    return PathRow(axes, intervals, duration, toppra_seconds, result.kept, words, slower, seconds, *ours), result


# --- scenes ---------------------------------------------------------------------------------------------------
def scene_cases() -> Iterator[tuple[str, Any]]:
    """Name and scene."""
    files = sorted(f for f in CORPUS.glob("*.json") if f.stem not in ("chains", "paths"))
    yield from ((f.stem, f) for f in files)
    if not files:
        walls = [{"kind": "box", "low": [4, 0], "high": [6, 5]}, {"kind": "box", "low": [4, "5.01"], "high": [6, 10]}]
        domain = {"low": [0, 0], "high": [10, 10]}
        yield "slit", {"domain": domain, "start": [1, 5], "goal": [9, 5], "obstacle": walls}


def scene_row(name: str, given: Any) -> tuple[SceneRow, Any]:
    """What is proved of a scene, and the answer."""
    answer, seconds = timed(lambda: bezier.route(given, shortest=True))
    accepted = answer.certificate is not None and qe.verify(answer.certificate).accepted
    ours = "blocked" if isinstance(answer, bezier.Blocked) else f"path of {len(answer.curves)} curves"
    flood = flooded(answer.scene) if answer.scene.dimension == 2 else None
    lengths = (
        (None, None) if isinstance(answer, bezier.Blocked) else (float(answer.length), float(answer.at_least or 0))
    )
    return SceneRow(name, len(answer.scene.obstacles), ours, seconds, accepted, flood, *lengths), answer


def flooded(scene: Any, count: int = 200) -> bool:
    """Whether free points of a grid lead from start to goal, in floats."""
    from scipy.ndimage import label

    low, high = (np.array(c, dtype=float) for c in (scene.low, scene.high))
    ticks = [np.linspace(a, b, count) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1)
    free = np.ones(grid.shape[:-1], dtype=bool)
    coordinates = [*np.moveaxis(grid, -1, 0), 0.0]
    for body in scene.solids:
        for piece in body.pieces:
            free &= np.any([_value(c, coordinates) < 0 for c in piece], axis=0)
    parts, _ = label(free)
    at = [
        tuple(np.round((np.array(p, dtype=float) - low) / (high - low) * (count - 1)).astype(int))
        for p in (scene.start, scene.goal)
    ]
    return bool(parts[at[0]] and parts[at[0]] == parts[at[1]])


def _value(condition: Any, at: Sequence[Any]) -> Any:
    return sum(float(c) * at[0] ** i * at[1] ** j * at[2] ** k for (i, j, k), c in condition.terms)


# --- the page -------------------------------------------------------------------------------------------------
def run(out: Path, count: int, note: Callable[[str], object]) -> list[Path]:
    """All comparisons; the page and the data are written into a folder. The files."""
    chains, drawn = list[ChainRow](), list[tuple[str, str]]()
    for points, radius in chain_cases(count):
        row, plan = chain_row(points, radius)
        chains.append(row)
        note(f"chain of {row.via} via points: {row.ours} ({row.seconds:.2f} s); clarabel: {row.clarabel}")
        if plan is not None and row.via <= 12 and len(drawn) < 6:
            drawn += [(svg, f"{row.via} via points: {words}") for svg, words in pictures(plan.chain, plan.curves)[:1]]
    paths = []
    for points in path_cases(count):
        for intervals in (100, 1000):
            if (made := path_row(points, intervals)) is None:
                note("paths: toppra is not installed")
                break
            paths.append(made[0])
            note(f"path in {made[0].axes} axes, toppra with {intervals}: {made[0].worst or 'all limits kept'}")
    scenes = []
    for name, given in scene_cases():
        scene, answer = scene_row(name, given)
        scenes.append(scene)
        note(f"scene {name}: {scene.ours} ({scene.seconds:.2f} s)")
        drawn.append((inline(answer), f"{name}: {scene.ours}"))
    out.mkdir(parents=True, exist_ok=True)
    data = {
        "chains": [asdict(row) for row in chains],
        "paths": [asdict(row) for row in paths],
        "scenes": [asdict(row) for row in scenes],
    }
    files = [out / "planning.json", out / "planning.html"]
    files[0].write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    files[1].write_text(document(page(chains, paths, scenes, drawn)), encoding="utf-8")
    return files


def page(
    chains: Sequence[ChainRow], paths: Sequence[PathRow], scenes: Sequence[SceneRow], drawn: Sequence[tuple[str, str]]
) -> Page:
    """The tables and the pictures."""
    lines = [
        (
            str(row.via),
            row.ours,
            f"{row.seconds:.3f}",
            html.toned("accepted" if row.accepted else "none", row.accepted),
            row.clarabel if row.clarabel_value is None else f"{row.clarabel_value:.10g}",
            "" if row.clarabel_seconds is None else f"{row.clarabel_seconds:.3f}",
            html.toned("yes" if row.agrees else "NO", row.agrees),
        )
        for row in chains
    ]
    head = ("via points", "proved", "s", "certificate", "clarabel", "s", "agree")
    timings = [
        (
            str(row.axes),
            str(row.intervals),
            f"{row.duration:.6g}",
            f"{row.toppra_seconds:.3f}",
            html.toned("kept" if row.kept else row.worst, row.kept),
            "" if row.slower_by is None else f"{row.slower_by:.6f}",
            f"{row.seconds:.3f}",
            f"{row.ours:.6g}",
            f"{row.at_least:.6g}",
            f"{row.our_seconds:.3f}",
        )
        for row in paths
    ]
    below = ("axes", "intervals", "duration", "toppra, s", "worst of |v| <= 1, |a| <= 2", "repaired by", "proof, s")
    table = html.table(
        (*below, "ours, kept", "at least", "ours, s"), timings, numbers=(0, 1, 2, 3, 5, 6, 7, 8, 9)
    ) or html.note("toppra is not installed.")
    known = [
        (
            row.name,
            str(row.obstacles),
            row.ours,
            f"{row.seconds:.3f}",
            html.toned("accepted" if row.accepted else "none", row.accepted),
            "" if row.flood is None else "gets through" if row.flood else "does not",
            "" if row.length is None else f"{row.length:.5g}",
            "" if row.at_least is None else f"{row.at_least:.5g}",
        )
        for row in scenes
    ]
    routes = html.table(
        ("scene", "obstacles", "proved", "s", "certificate", "flood of 200 x 200", "length", "none shorter than"),
        known,
        numbers=(1, 3, 6, 7),
    )
    sections = [
        Section("chains", "Chains", html.table(head, lines, numbers=(0, 2, 5)), short="chains"),
        Section("paths", "Paths timed by toppra, certified", table, short="paths"),
        Section("scenes", "Scenes", routes, short="scenes"),
        Section("pictures", "Pictures", html.figures(drawn, wide=True), short="pictures"),
    ]
    broken = sum(not row.kept for row in paths)
    cards = [
        Card("chains that agree", f"{sum(row.agrees for row in chains)} of {len(chains)}"),
        Card("timings that break their limits", f"{broken} of {len(paths)}"),
    ]
    lead = "Chains against clarabel, timed paths of toppra and scenes, proved or refuted. Seconds are processor time."
    return Page(title="Planning side by side", lead=lead, sections=sections, footer="", cards=cards)

"""What the pictures show, as plain floating-point data: one value shared by the PNG files and the web page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bezier.curves.curve import Bezier
from bezier.curves.scalar import same
from bezier.curves.workspace import Condition, WorkspaceKind
from bezier.paths.path import Path
from bezier.pictures.mesh import Array, RegionMesh, region_mesh, sampled
from bezier.pictures.obstacles import ObstaclePicture, obstacle_pictures
from bezier.problem import Problem

COLOURS = {"P": "#2364aa", "Q": "#d1495b", "R": "#2e9e6b"}
"""One colour per curve, used for its control points and for the region's boundary that keeps them in."""
SECOND = {"P2": "#6fb1e8", "Q2": "#e79aa4", "R2": "#8fd3b6"}
"""For the second inner control point of a cubic curve."""
INK, PALE, FLOOR = "#22303c", "#8493a0", "#b08d57"
GRID, SHADE = "#e3e8ec", "#e9edf1"
TABLE = {"P1.z": "#7d6a45", "Q1.z": FLOOR, "R1.z": "#dcc598", "P2.z": "#66583c", "Q2.z": "#c3a36c", "R2.z": "#ecdcbb"}
"""For the boundary that keeps a control point above the table."""
OTHER = ("#8a6fb0", "#3f9aa8", "#c2a92b", "#6b7785", "#8c6239")
"""For all other boundary surfaces, in turn."""
Chart = tuple[str, str]
"""A drawing as SVG text, and what it shows in words."""


@dataclass(frozen=True, slots=True)
class CurvePicture:
    """A curve: its points and its control polygon."""

    name: str
    points: Array
    polygon: Array

    @property
    def colour(self) -> str:
        """The curve's colour."""
        return COLOURS.get(self.name, INK)


@dataclass(frozen=True, slots=True)
class RegionPicture:
    """A region with one label and colour per boundary surface, and the chosen point in it."""

    mesh: RegionMesh
    labels: tuple[str, ...]
    chosen: Array | None = None

    def colour(self, index: int) -> str:
        """The colour of a boundary surface."""
        label = self.labels[index]
        known = {**TABLE, **SECOND, **{f"{letter}1": colour for letter, colour in COLOURS.items()}}
        others = [k for k, name in enumerate(self.labels) if name not in known]
        return known[label] if label in known else OTHER[others.index(index) % len(OTHER)]


@dataclass(frozen=True, slots=True)
class PathPicture:
    """The path in its workspace."""

    radius: float
    has_floor: bool
    curves: tuple[CurvePicture, ...]
    marks: Mapping[str, Array]
    """Named points."""
    region: RegionPicture | None = None
    extra: Mapping[str, RegionPicture] = field(default_factory=dict)
    hatted_names: bool = True
    """Whether their names get hats."""
    obstacles: tuple[ObstaclePicture, ...] = ()
    centre: Array = field(default_factory=lambda: np.zeros(3))
    has_rim: bool = True


@dataclass(frozen=True, slots=True)
class Drawing:
    """The pictures of a plan: what the page shows, and the files written."""

    picture: PathPicture
    files: tuple[str, ...]
    views: tuple[Chart, ...] = ()
    """The coordinate views."""
    charts: tuple[Chart, ...] = ()
    """Further drawings."""
    clearance: tuple[Chart, ...] = ()
    """Heights, distances to the obstacles."""


def path_picture(
    problem: Problem,
    path: Path | None,
    given: Mapping[str, Sequence[Any]],
    *,
    region: RegionPicture | None,
    extra: Mapping[str, RegionPicture] | None = None,
    hatted_names: bool = True,
) -> PathPicture:
    """The picture of a path, or of the given points alone; a place with two names is marked by one."""
    points: dict[str, Sequence[Any]] = dict(given)
    if path is not None:  # the last point of a curve has two names, of which the given one is shown
        points |= {name: p for name, p in path.points.items() if not any(same(p, other) for other in given.values())}
    reach = float(problem.workspace.radius_squared) ** 0.5
    return PathPicture(
        radius=reach,
        has_floor=problem.workspace.kind is WorkspaceKind.HEMISPHERE,
        curves=curve_pictures(path.curves) if path else (),
        marks={name: numbers([point])[0] for name, point in points.items()},
        region=region,
        extra=extra or {},
        hatted_names=hatted_names,
        obstacles=obstacle_pictures(problem.obstacles, reach),
    )


def curve_pictures(curves: Mapping[str, Bezier], count: int = 61) -> tuple[CurvePicture, ...]:
    """Sampled curves with their control polygons."""
    return tuple(CurvePicture(name, sampled(c.points, count), numbers(c.points)) for name, c in curves.items())


def region_picture(
    conditions: Sequence[Condition], named: Sequence[Condition], chosen: Sequence[Any] | None, level: int = 3
) -> RegionPicture | None:
    """The region bounded by ``conditions``; labels are the names of the equal conditions among ``named``."""
    mesh = region_mesh(conditions, level)
    if mesh is None:
        return None
    labels = tuple(_label(condition, named) for condition in conditions)
    return RegionPicture(mesh, labels, None if chosen is None else numbers([chosen])[0])


def _label(condition: Condition, named: Sequence[Condition]) -> str:
    probes = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    for other in named:
        if type(other) is type(condition):
            pairs = [(condition.margin(p), other.margin(p)) for p in probes]
            if all(a * pairs[0][1] == b * pairs[0][0] for a, b in pairs) and any(a for a, _ in pairs):
                return other.name
    return "boundary"


def numbers(points: Sequence[Sequence[Any]]) -> Array:
    """Exact points as floating-point rows."""
    return np.array([[float(c) for c in p] for p in points])


# --- names -----------------------------------------------------------------------------------------------
def boundary(label: str) -> str:
    """A boundary surface in words."""
    if label.endswith(".z"):
        return f"{written(label[:-2])} on the table"
    return f"‖{written(label)}‖ = r" if len(label) == 2 else label


def written(name: str) -> str:
    """A name with a combining hat on its letter and its index lowered."""
    lowered = name[1:].translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))
    return f"{name[0]}\u0302{lowered}" if name[:1] in "PQR" else name

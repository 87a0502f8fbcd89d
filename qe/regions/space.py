"""Pictures of regions in space: the closed surface, lit, what goes on for ever cut by the picture's frame."""

from __future__ import annotations

from math import ceil, floor
from typing import Any

import numpy as np

from qe.exact.ring import Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import Relation
from qe.regions.described import Described as Region
from qe.regions.solid import Array, Solid, Surface, solid

FILL, EDGE, CUT = (0.36, 0.53, 0.72), (0.12, 0.23, 0.36), (0.80, 0.83, 0.86)
MARGIN = 0.06
BEYOND = 4
"""How far the frame reaches beyond what is known of a region that goes on for ever."""
VIEW = (24.0, -58.0)
CREASE = 0.8
"""The cosine between two triangles' normals below which their common edge is drawn."""
LIFT, BACK = 0.02, 0.1
"""How far lines are moved towards the viewer, and inner walls away, as a share of the drawn box."""
TOUCHING = 0.01
"""The distance from a line, as a share of the size, within which a point is not marked."""
FLATTEST = 1 / 5
"""The least side of the drawn box as a share of its greatest one."""

Frame = dict[str, tuple[int | None, int | None]]
"""For each variable the values at which the region is cut."""


def framed(region: Region) -> tuple[Region, Frame]:
    """The region within a box that cuts off whatever goes on for ever, and where the box cuts."""
    frame: Frame = {}
    conditions = []
    ring = Ring.of(region.order)
    for name in region.order:
        lower, upper = region.bounds(name)
        ends = (lower, upper)
        if None not in ends:
            continue
        known = [float(p.sample[name]) for p in region.cells]
        known += [float(end) for end in ends if end is not None]
        beyond = max(BEYOND, ceil((max(known) - min(known)) / 4))
        cut = (
            floor(min(known)) - beyond if lower is None else None,
            ceil(max(known)) + beyond if upper is None else None,
        )
        frame[name] = cut
        if cut[0] is not None:
            conditions.append(atom(ring.var(name) - cut[0], Relation.GE))
        if cut[1] is not None:
            conditions.append(atom(ring.var(name) - cut[1], Relation.LE))
    if not conditions:
        return region, frame
    return region.within(conj(conditions)), frame


def shape_of(region: Region) -> tuple[Solid, Frame]:
    """The surface of a region in three variables, cut by the frame where it goes on for ever, and the frame."""
    if region.is_empty:
        return Solid((), ()), {}
    inside, frame = framed(region)
    if inside.is_empty:
        return Solid((), ()), frame
    return solid(inside.cells, [(-1.0, 1.0)] * 3), frame


def draw_space(shape: Solid, frame: Frame, order: tuple[str, ...], axes: Any) -> None:
    """Draw the surface of a region in three variables on matplotlib's three-dimensional axes."""
    from matplotlib.ticker import MaxNLocator
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    low, high = shape.corners()
    size = np.where(high > low, high - low, max(1.0, float((high - low).max())))
    low, high = (low + high - size * (1 + 2 * MARGIN)) / 2, (low + high + size * (1 + 2 * MARGIN)) / 2
    box = np.maximum(size / size.max(), FLATTEST)
    towards = direction(VIEW)
    drawn = _Drawn(low, size / box, towards)
    for surface in shape.surfaces:
        drawn.add(surface, _cut_faces(surface, order, frame, size))
    curves = [line for line in shape.lines if len(line) > 1]
    for line in shape.lines:
        if len(line) > 1:
            drawn.strokes(line[:-1], line[1:], width=2.0)
        elif not any(np.abs((other - line) / size).max(axis=1).min() < TOUCHING for other in curves):
            axes.scatter(*line.T, color=[EDGE], s=30)
    if drawn.polygons:
        colours = np.array(drawn.colours)
        faces = Poly3DCollection(drawn.polygons, facecolors=colours, edgecolors=colours, linewidths=drawn.widths)
        faces.set_rasterized(True)  # thousands of triangles: as outlines a file of a megabyte
        axes.add_collection3d(faces)
    for axis, start, end, side, name in zip("xyz", low, high, box, order, strict=True):
        getattr(axes, f"set_{axis}lim")(start, end)
        getattr(axes, f"{axis}axis").set_major_locator(MaxNLocator(5 if side > 0.5 else 3))
        getattr(axes, f"set_{axis}label")(name)
    axes.set_box_aspect(box)
    axes.set_proj_type("ortho")
    axes.view_init(*VIEW)
    if frame and (shape.surfaces or shape.lines):
        axes.set_title("pale: cut by the frame, the region goes on", fontsize=9, color="0.35")


def direction(view: tuple[float, float]) -> Array:
    """The unit vector towards a viewer at this elevation and azimuth, in degrees."""
    up, around = np.radians(view)
    return np.array([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])


def _cut_faces(surface: Surface, order: tuple[str, ...], frame: Frame, size: Array) -> Any:
    """Which triangles lie in a plane of the frame."""
    corners = surface.vertices[surface.faces]
    is_cut = np.zeros(len(surface.faces), dtype=bool)
    for axis, name in enumerate(order):
        for cut in frame.get(name, ()):
            if cut is not None:
                is_cut |= (np.abs(corners[:, :, axis] - cut) < 1e-5 * size[axis]).all(axis=1)
    return is_cut


class _Drawn:
    """Polygons and their colours, in data coordinates; ``unit``: data lengths per drawn length."""

    def __init__(self, origin: Array, unit: Array, towards: Array) -> None:
        self.origin, self.unit, self.towards = origin, unit, towards
        self.polygons: list[Array] = []
        self.colours: list[Array] = []
        self.widths: list[float] = []
        side = np.cross([0.0, 0.0, 1.0], towards)
        light = towards + 0.55 * side / np.linalg.norm(side) + np.array([0.0, 0.0, 0.65])
        self.light = light / np.linalg.norm(light)

    def add(self, surface: Surface, cut: Any) -> None:
        """The triangles that a viewer can see, and the creases between them."""
        points = (surface.vertices - self.origin) / self.unit
        normals = _normals(points, surface.faces)
        facing = normals @ self.towards
        seen = facing > 1e-9 if surface.solid else np.ones(len(facing), dtype=bool)
        bright = normals @ self.light if surface.solid else np.abs(normals @ self.light)
        shade = 0.5 + 0.5 * np.clip(bright, 0, 1)
        base = np.where(cut[:, None], np.array(CUT), np.array(FILL))
        # walls between blocks only fill the hair cracks between their sheets: behind all else
        back = np.where(surface.inner[seen], BACK, 0.0)[:, None, None] * self.towards * self.unit
        self.polygons += list(surface.vertices[surface.faces[seen]] - back)
        self.colours += list(np.clip(base[seen] * shade[seen, None] * 1.12, 0, 1))
        self.widths += [0.6] * int(seen.sum())
        starts, stops = _creases(surface, normals, seen)
        self.strokes(surface.vertices[starts], surface.vertices[stops], width=0.6)

    def strokes(self, starts: Array, stops: Array, width: float) -> None:
        """Short lines, sorted by depth with the triangles; moved a little towards the viewer to lie before them."""
        move = LIFT * self.towards * self.unit
        for a, b in zip(starts + move, stops + move, strict=True):
            self.polygons.append(np.array([a, b, b]))
            self.colours.append(np.array(EDGE))
            self.widths.append(width)


def _normals(points: Array, faces: Any) -> Array:
    a, b, c = (points[faces[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    length = np.linalg.norm(across, axis=1, keepdims=True)
    return np.asarray(across / np.where(length > 0, length, 1.0))


def _creases(surface: Surface, normals: Array, seen: Any) -> tuple[Any, Any]:
    """Edges at which the surface turns sharply (of a sheet: its border), as two lists of vertices."""
    faces = surface.faces
    pairs = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    owner = np.tile(np.arange(len(faces)), 3)
    by_edge = np.lexsort(pairs.T)
    pairs, owner = pairs[by_edge], owner[by_edge]
    same = (pairs[1:] == pairs[:-1]).all(axis=1)
    if not surface.solid:
        alone = ~(np.concatenate([[False], same]) | np.concatenate([same, [False]]))
        return pairs[alone, 0], pairs[alone, 1]
    first, second = owner[:-1][same], owner[1:][same]
    flat = (np.linalg.norm(normals, axis=1) < 0.5)[np.stack([first, second])].any(axis=0)
    sharp = (normals[first] * normals[second]).sum(axis=1) < CREASE
    visible = (seen[first] | seen[second]) & ~surface.inner[first] & ~surface.inner[second]
    sharp &= surface.side[first] != surface.side[second]
    chosen = pairs[:-1][same][sharp & visible & ~flat]
    return chosen[:, 0], chosen[:, 1]

"""A scene: a closed box in the plane or in space, closed boxes and balls in it, a start and a goal; all rational."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, product
from math import isqrt
from pathlib import Path

from qe import arguments
from qe.errors import InputError

Point = tuple[Fraction, ...]


@dataclass(frozen=True, slots=True)
class SolidBox:
    """The closed box between two corners."""

    low: Point
    high: Point

    def contains(self, point: Sequence[Fraction]) -> bool:
        """Whether a point is in it, the boundary included."""
        return all(a <= c <= b for a, c, b in zip(self.low, point, self.high, strict=True))

    def meets(self, start: Point, end: Point) -> bool:
        """Whether it has a point in common with a segment."""
        first, last = Fraction(0), Fraction(1)
        for low, high, a, b in zip(self.low, self.high, start, end, strict=True):
            if a == b:
                if not low <= a <= high:
                    return False
                continue
            enters, leaves = sorted(((low - a) / (b - a), (high - a) / (b - a)))
            first, last = max(first, enters), min(last, leaves)
        return first <= last

    def inner(self, steps: int) -> tuple[SolidBox, ...]:
        """Boxes in it: itself."""
        return (self,)

    def outer(self, steps: int) -> tuple[SolidBox, ...]:
        """Boxes around it: itself."""
        return (self,)


@dataclass(frozen=True, slots=True)
class SolidBall:
    """The closed ball, in the plane the disc, of positive radius around a centre."""

    centre: Point
    radius: Fraction

    def contains(self, point: Sequence[Fraction]) -> bool:
        """Whether a point is in it, the boundary included."""
        return sum((a - b) ** 2 for a, b in zip(point, self.centre, strict=True)) <= self.radius**2

    def meets(self, start: Point, end: Point) -> bool:
        """Whether it has a point in common with a segment."""
        along = [b - a for a, b in zip(start, end, strict=True)]
        square = sum(d * d for d in along)
        ahead = sum(d * (c - a) for d, c, a in zip(along, self.centre, start, strict=True))
        t = min(max(ahead / square, Fraction(0)), Fraction(1)) if square else Fraction(0)
        return self.contains([a + t * d for a, d in zip(start, along, strict=True)])

    def inner(self, steps: int) -> tuple[SolidBox, ...]:
        """Boxes in it, one for each of so many slices along each axis but the last."""
        return self._sliced(steps, outer=False)

    def outer(self, steps: int) -> tuple[SolidBox, ...]:
        """Boxes that cover it, one for each of so many slices along each axis but the last."""
        return self._sliced(steps, outer=True)

    def _sliced(self, steps: int, *, outer: bool) -> tuple[SolidBox, ...]:
        ends = [-self.radius + 2 * self.radius * Fraction(i, steps) for i in range(steps + 1)]
        boxes = []
        for slices in product(list(pairwise(ends)), repeat=len(self.centre) - 1):
            far = [max(abs(a), abs(b)) for a, b in slices]
            near = [Fraction(0) if a < 0 < b else min(abs(a), abs(b)) for a, b in slices]
            rest = self.radius**2 - sum(d * d for d in (near if outer else far))
            if rest < 0:
                continue
            scale = (steps * steps * self.radius.denominator) ** 2
            root = Fraction(isqrt(int(rest * scale)) + outer, isqrt(scale))
            shape = [*slices, (-root, root)]
            low, high = (tuple(c + side[k] for c, side in zip(self.centre, shape, strict=True)) for k in (0, 1))
            boxes.append(SolidBox(low, high))
        return tuple(boxes)


Solid = SolidBox | SolidBall


@dataclass(frozen=True, slots=True)
class Scene:
    """``obstacles`` are closed, so that those that touch leave no passage between them; lengths in one unit."""

    domain: SolidBox
    obstacles: tuple[Solid, ...]
    start: Point
    goal: Point

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return len(self.start)

    def blocked_at(self, point: Point) -> str | None:
        """What a point is in the way of: an obstacle, or the end of the domain; None where it is free."""
        if not self.domain.contains(point):
            return "outside the domain"
        known = (k for k, box in enumerate(self.obstacles, start=1) if box.contains(point))
        return next((f"in obstacle {k}" for k in known), None)


def read_scene(given: object, source: str = "scene") -> Scene:
    """A scene from a mapping with ``domain`` (``low``, ``high``), ``start``, ``goal`` and ``obstacle``, a list of
    mappings with ``kind = "box"``, ``low`` and ``high``, or ``kind = "ball"``, ``centre`` (or ``center``) and
    ``radius``; or from the JSON file of one. Numbers are exact: integers, fractions, decimals as text.

    Raises ``qe.InputError``, naming the entry, for anything else.
    """
    if isinstance(given, Scene):
        return given
    if isinstance(given, str | Path):
        try:
            given, source = json.loads(Path(given).read_text()), str(given)
        except OSError as error:
            raise InputError(f"{source}: {error.strerror}: {given}") from None
        except ValueError:
            raise InputError(f"{source}: expected a JSON file, found something else in {given}") from None
    if not isinstance(given, Mapping):
        raise InputError(f"{source}: expected a mapping or a JSON file, found {arguments.shown(given)}")
    start, goal = (_point(given.get(name), f"{source}: {name}") for name in ("start", "goal"))
    domain = _box(given.get("domain"), f"{source}: domain")
    listed = given.get("obstacle", given.get("obstacles", []))
    if not isinstance(listed, Sequence) or isinstance(listed, str):
        raise InputError(f"{source}: obstacle: expected a list, found {arguments.shown(listed)}")
    obstacles = tuple(_obstacle(entry, f"{source}: obstacle {k}") for k, entry in enumerate(listed, start=1))
    points = (goal, domain.low, *(box.low if isinstance(box, SolidBox) else box.centre for box in obstacles))
    if any(len(p) != len(start) for p in points):
        raise InputError(f"{source}: expected points of one dimension, found several")
    return Scene(domain, obstacles, start, goal)


def _obstacle(entry: object, where: str) -> Solid:
    if not isinstance(entry, Mapping) or entry.get("kind") not in ("box", "ball"):
        raise InputError(f"{where}: expected a mapping with kind box or ball, found {arguments.shown(entry)}")
    if entry["kind"] == "box":
        return _box(entry, where)
    centre = _point(entry.get("centre", entry.get("center")), f"{where}: centre")
    radius = Fraction(arguments.rational(entry.get("radius"), f"{where}: radius"))
    if radius <= 0:
        raise InputError(f"{where}: radius: expected a positive number, found {radius}")
    return SolidBall(centre, radius)


def _point(given: object, where: str) -> Point:
    if not isinstance(given, Sequence) or isinstance(given, str) or len(given) not in (2, 3):
        raise InputError(f"{where}: expected 2 or 3 numbers, found {arguments.shown(given)}")
    return tuple(arguments.rational(c, where) for c in given)


def _box(given: object, where: str) -> SolidBox:
    if not isinstance(given, Mapping):
        raise InputError(f"{where}: expected a mapping with low and high, found {arguments.shown(given)}")
    low, high = (_point(given.get(name), f"{where}: {name}") for name in ("low", "high"))
    if len(low) != len(high) or any(a > b for a, b in zip(low, high, strict=False)):
        raise InputError(f"{where}: expected low <= high in each coordinate")
    return SolidBox(low, high)

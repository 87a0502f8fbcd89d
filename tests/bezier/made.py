"""What the tests of curves, arms and plans are made of: numbers, arms and curves, obstacles, tasks of Method 1."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from hypothesis import strategies as st

from bezier.arm.model import Arm
from bezier.curves.containment import Inside, examine_all
from bezier.curves.curve import Bezier
from bezier.curves.workspace import Condition
from bezier.input.task import Axis, Task, index_pair, task
from bezier.obstacles.bodies import Body, Cylinder, HalfSpaceBody, Rounded
from bezier.obstacles.obstacle import Obstacle, ObstacleKind, from_body
from bezier.obstacles.polyhedron import Point, from_corners, parallelepiped, point, segment
from qe.errors import InputError
from qe.exact.field import NumberField

FIELD = NumberField.from_root([-2, 0, 1], 1, 2)


def root2(a: Fraction, b: Fraction = Fraction(0)) -> Any:
    """a + b*sqrt(2)."""
    return FIELD.element([a, b])


small = st.fractions(min_value=-4, max_value=4, max_denominator=6)
unit = st.fractions(min_value=0, max_value=1, max_denominator=12)
surds = st.builds(root2, small, small)


def points(dimension: int = 3, coordinate: Any = small) -> Any:
    """Strategy: points of this dimension."""
    return st.tuples(*[coordinate] * dimension)


def control_points(low: int = 1, high: int = 5, dimension: int = 3, coordinate: Any = small) -> Any:
    """Strategy: lists of control points."""
    return st.lists(points(dimension, coordinate), min_size=low, max_size=high)


Limits = tuple[object, object] | None
Points = Sequence[tuple[Any, ...]]


def arm_text(*rows: str, convention: str = "standard") -> str:
    """An arm with a joint q1, q2, … in each row; semicolons separate the keys of a row."""
    body = "".join(f'[[row]]\njoint = "q{k}"\n{row}\n' for k, row in enumerate(rows, start=1))
    return f'convention = "{convention}"\n{body}'.replace("; ", "\n")


def limited(arm: Arm, *limits: Limits) -> Arm:
    """The arm with these limits of its joints; the others have none."""
    listed = iter([*limits, *[None] * len(arm.joints)])
    rows = []
    for row in arm.rows:
        if row.joint is not None:
            ends = next(listed)
            exact = None if ends is None else (Fraction(str(ends[0])), Fraction(str(ends[1])))
            row = replace(row, joint=replace(row.joint, limits=exact))
        rows.append(row)
    return replace(arm, rows=tuple(rows))


def curves_of(*curves: Points) -> dict[str, Bezier]:
    """The curves with these control points."""
    exact = ([tuple(Fraction(str(c)) for c in p) for p in points] for points in curves)
    return {f"curve {k}": Bezier.of(points) for k, points in enumerate(exact)}


def stays(curve: Bezier, conditions: Iterable[Condition]) -> bool:
    """Whether the whole curve is proved to satisfy the conditions."""
    return all(isinstance(outcome, Inside) for outcome in examine_all(curve, conditions))


def at(*values: Any) -> Point:
    """A point with exact coordinates."""
    return tuple(Fraction(v) for v in values)


def obstacle(body: Body) -> Obstacle:
    """The obstacle that is this body."""
    return from_body("it", ObstacleKind.POLYHEDRON, body)


def obstacle_text(kind: str, name: str | None = None, **keys: object) -> str:
    """An obstacle as it stands in a problem file."""
    given = {"kind": kind, **({} if name is None else {"name": name}), **keys}
    return "\n[[obstacle]]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in given.items())


CRATE_TEXT = obstacle_text("box", "crate", low=[-1, 1, 0], high=[1, 3, 2], margin="1/10")


def ball(centre: Any, radius: Any) -> Obstacle:
    """A ball."""
    return obstacle(Rounded(point(at(*centre)), Fraction(radius)))


CUBE = parallelepiped(at(-1, -1, -1), [at(2, 0, 0), at(0, 2, 0), at(0, 0, 2)])
TURNED = parallelepiped(at(0, 0, 0), [at(3, 4, 0), at(-4, 3, 0), at(0, 0, 1)])
OCTAHEDRON = from_corners([at(2, 0, 0), at(-2, 0, 0), at(0, 2, 0), at(0, -2, 0), at(0, 0, 2), at(0, 0, -2)])
WEDGE = from_corners([at(0, 0, 0), at(3, 0, 0), at(0, 2, 0), at(0, 0, 1)])

radii = st.sampled_from([Fraction(1, 3), Fraction(1), Fraction(5, 2)])
margins = st.sampled_from([Fraction(0), Fraction(1, 4), Fraction(2)])
places = st.tuples(*[st.integers(-3, 3).map(Fraction)] * 3)

rounded = st.one_of(
    st.builds(lambda c, r: Rounded(point(c), r), places, radii),
    st.builds(lambda a, r: Rounded(segment(a, at(a[0] + 1, a[1] - 2, a[2] + 2)), r), places, radii),
    st.builds(Rounded, st.sampled_from([CUBE, TURNED, OCTAHEDRON, WEDGE]), margins),
)
half_spaces = st.builds(HalfSpaceBody, st.sampled_from([at(0, 0, 1), at(1, -2, 2)]), st.integers(-4, 4), margins)
heights = st.sampled_from([(None, None), (Fraction(-1), None), (None, Fraction(1)), (Fraction(-1), Fraction(2))])
cylinders = st.builds(lambda c, r, ends, m: Cylinder((c[0], c[1]), r, *ends, m), places, radii, heights, margins)
bodies = st.one_of(rounded, half_spaces, cylinders)


QUARTERS = st.integers(-8, 8).map(lambda k: Fraction(k, 4))
HEIGHTS = st.integers(1, 8).map(lambda k: Fraction(k, 4))


def axis(name: str, start: Any, goal: Any, height: Any = None) -> Axis:
    """An axis with exact numbers."""
    return Axis(name, Fraction(start), Fraction(goal), None if height is None else Fraction(height))


FLAT = axis("z", 0, 0)


def unit_task(degree: int, a: Any, b: Any, *axes: Axis) -> Task:
    """A task with x from 0 to 1."""
    return task(degree, (Fraction(0), Fraction(1)), (Fraction(a), Fraction(b)), axes)


@st.composite
def tasks(draw: Any, low: int = 3, high: int = 6, both: bool = False) -> Task:
    """A task with x from 0 to 1 whose interval has p and q; one raised axis, or two."""
    degree = draw(st.integers(low, high))
    p = draw(st.integers(1, degree - 2))
    q = draw(st.integers(p + 1, degree - 1))
    share = st.integers(0, 5).map(lambda k: Fraction(k, 6))
    a, b = (p + 1 - draw(share)) / Fraction(degree), (q + draw(share)) / Fraction(degree)
    if a == b:
        b += Fraction(1, 6 * degree)
    raised = [Axis("y", draw(QUARTERS), draw(QUARTERS), draw(HEIGHTS))]
    other = Axis("z", abs(draw(QUARTERS)), abs(draw(QUARTERS)), draw(HEIGHTS)) if both else FLAT
    return unit_task(degree, a, b, *raised, other)


def has_indices(degree: int, a: Fraction, b: Fraction) -> tuple[int, int] | None:
    """p and q for x from 0 to 1, or None where they are refused."""
    try:
        return index_pair(degree, (Fraction(0), Fraction(1)), (a, b))
    except InputError:
        return None

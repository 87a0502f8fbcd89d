"""Inverse kinematics at a pose (a point and an orientation), exactly: ``bezier.arm.parallel_axes`` for planar arms and
six joints with three parallel axes, ``bezier.arm.wrist`` for spherical wrists."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bezier.arm.choices import Choice, backwards
from bezier.arm.inverse import Inverse, Solution, exact_number, listed, solution_of
from bezier.arm.model import Arm, Matrix, inverse
from bezier.arm.parallel_axes import ROOTS, PoseSearch, shape_of
from bezier.arm.roots_of_squares import Rules, fixed
from bezier.arm.wrist import ROOTS as WRIST_ROOTS
from bezier.arm.wrist import Joints, solve_wrist, wrist_of
from bezier.curves.scalar import dot, rational
from qe.errors import InputError
from qe.exact.point_values import Evaluation
from qe.exact.sample import Point

Rotation = tuple[tuple[Any, ...], ...]


def rotation_of(quaternion: Sequence[Any]) -> Rotation:
    """The rotation of a quaternion (w, x, y, z) that is not zero; its length does not matter. Exact."""
    numbers = [rational(exact_number(v, "quaternion")) for v in listed(quaternion, "quaternion: four numbers")]
    if len(numbers) != 4:
        raise InputError(f"quaternion: four numbers (w, x, y, z) expected, {len(numbers)} found")
    w, x, y, z = numbers
    if w is None or x is None or y is None or z is None:
        raise InputError("quaternion: rational numbers expected; its length does not matter")
    size = w * w + x * x + y * y + z * z
    if size == 0:
        raise InputError("quaternion: four numbers expected that are not all 0")
    doubled = 2 / size
    return (
        (1 - doubled * (y * y + z * z), doubled * (x * y - w * z), doubled * (x * z + w * y)),
        (doubled * (x * y + w * z), 1 - doubled * (x * x + z * z), doubled * (y * z - w * x)),
        (doubled * (x * z - w * y), doubled * (y * z + w * x), 1 - doubled * (x * x + y * y)),
    )


def solve_pose(arm: Arm, point: Sequence[Any], rotation: Sequence[Sequence[Any]]) -> Inverse:
    """All solutions at a pose: ``point`` (mm) and the axes of the end effector as the columns of ``rotation``.

    Exact numbers, as for ``bezier.arm.inverse.solve``. Raises ``Unable`` for an arm of another shape, and where the
    pose leaves a joint free and it is not decided whether there are solutions; ``InputError`` for what is no pose.
    """
    expected = "pose: three coordinates and three rows of three numbers"
    point, rotation = listed(point, expected), [listed(row, expected) for row in listed(rotation, expected)]
    if len(point) != 3 or len(rotation) != 3 or any(len(row) != 3 for row in rotation):
        raise InputError(f"{expected} expected")
    numbers = tuple(exact_number(v, "point") for v in point)
    rows = tuple(tuple(exact_number(v, "rotation") for v in row) for row in rotation)
    wrist = wrist_of(arm)
    shape = shape_of(arm) if wrist is None else None
    given = (
        *zip(point, numbers, strict=True),
        *((v, w) for r, s in zip(rotation, rows, strict=True) for v, w in zip(r, s)),
    )
    # elements of the arm's own field need no variable of their own
    roots = WRIST_ROOTS if shape is None else ROOTS
    rules, place = Rules.of(arm.field, roots, [v if getattr(v, "field", None) == arm.field else w for v, w in given])
    entries = rules.given
    pose: Matrix = tuple((*entries[3 * i + 3 : 3 * i + 6], entries[i]) for i in range(3))
    _check_rotation(pose, rules, place)
    if shape is None:
        assert wrist is not None, "one of the two shapes was found"
        solutions = [_solution(arm, *leaf) for leaf in solve_wrist(wrist, rules, place, pose)]
    else:
        wanted = fixed(pose, rules) if not shape.is_reversed else fixed(inverse(pose), rules)
        leaves = PoseSearch(shape, rules, wanted).solutions(place)
        solutions = [_solution(arm, *leaf, is_reversed=shape.is_reversed) for leaf in leaves]
    result = tuple(sorted(solutions, key=lambda s: [v for v in s.angles if v is not None]))
    names = [joint.name for joint in arm.joints]
    free = {name for s in result for name, v in zip(names, s.values, strict=True) if v is None}
    way = -1 if shape is not None and shape.is_reversed else 1
    named = {_named(names[::way], s.values[::way], shape is None) for s in result if None in s.values}
    cases = (*sorted(named), *("two solutions meet: the arm is singular here",) * any(s.multiple for s in result))
    return Inverse(arm, numbers, result, tuple(n for n in names if n in free), cases, rows)


def _named(names: Sequence[str], values: Sequence[Any], is_wrist: bool) -> str:
    """What is special where joints are free; names and values in the direction of the derivation."""
    free = [k for k, value in enumerate(values) if value is None]
    if is_wrist:
        if free == [3, 5]:
            return f"the axes of {names[3]} and {names[5]} are in line"
        place = f"on the axis of {names[0]}" if free[0] == 0 else f"where {names[free[0]]} does not move it"
        return f"the centre of the wrist is {place}"
    if len(free) == 2:
        return f"the axes of {names[free[0]]} and {names[free[1]]} coincide"
    if free[0] == 0:
        return f"the axes of {names[4]} and {names[5]} meet on the axis of {names[0]}"
    return f"the axis of {names[5]} is parallel to those of {names[1]}, {names[2]} and {names[3]}"


def _check_rotation(pose: Matrix, rules: Rules, place: Point) -> None:
    columns = [[row[j] for row in pose] for j in range(3)]
    defects = [dot(a, b) - int(i == j) for i, a in enumerate(columns) for j, b in enumerate(columns) if i <= j]
    (a, b, c) = columns
    across = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    if any(place.sign(rules.tidy(d).top) for d in (*defects, dot(across, c) - 1)):
        raise InputError("rotation: a matrix with orthogonal columns of length 1 and determinant 1 expected")


def _solution(
    arm: Arm, here: Evaluation, known: Joints, multiple: bool, choices: tuple[Choice, ...], is_reversed: bool = False
) -> Solution:
    listed = [known[k] for k in sorted(known)]
    if is_reversed:
        listed = [None if k is None else backwards(k) for k in reversed(listed)]
        choices = tuple(choice.backwards(len(listed)) for choice in choices)
    return solution_of(arm, here, listed, multiple, choices)

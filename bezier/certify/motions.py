"""Rigid motions whose entries are rational numbers and square roots."""

from __future__ import annotations

from collections.abc import Sequence

from bezier.certify.square_roots import ONE, ZERO, Surd

Triple = tuple[Surd, ...]
Motion = tuple[tuple[Triple, Triple, Triple], Triple]
"""Rows of the rotation, and the shift."""

STILL: Motion = (((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE)), (ZERO, ZERO, ZERO))


def dot(a: Sequence[Surd], b: Sequence[Surd]) -> Surd:
    """The scalar product."""
    return sum((x * y for x, y in zip(a, b, strict=True)), ZERO)


def turn(plane: tuple[int, int], angle: tuple[Surd, Surd], shift: Triple) -> Motion:
    """A turn in the plane of two axes, and a shift along the third one: they commute."""
    (c, s), (i, j) = angle, plane
    rows = [list(row) for row in STILL[0]]
    rows[i][i], rows[i][j], rows[j][i], rows[j][j] = c, -s, s, c
    return (tuple(rows[0]), tuple(rows[1]), tuple(rows[2])), shift


def together(first: Motion, second: Motion) -> Motion:
    """The second motion, then the first one."""
    a, b, c = (tuple(dot(row, column) for column in zip(*second[0], strict=True)) for row in first[0])
    return (a, b, c), image(first, second[1])


def image(motion: Motion, point: Sequence[Surd]) -> Triple:
    """Where a point comes to lie."""
    return tuple(dot(row, point) + o for row, o in zip(*motion, strict=True))


def back(motion: Motion) -> Motion:
    """The inverse motion: rotations are orthogonal."""
    rows, shift = motion
    a, b, c = zip(*rows, strict=True)
    return (a, b, c), tuple(-dot(row, shift) for row in (a, b, c))


def is_motion(motion: Motion) -> bool:
    """Whether the rows are orthogonal, of length 1 and of determinant 1."""
    a, b, c = motion[0]
    across = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    pairs = [(a, a, ONE), (b, b, ONE), (a, b, ZERO)]
    return across == c and all(dot(x, y) == value for x, y, value in pairs)

"""The plane through the origin and the two via points, in which regions of Q1 can be decomposed and drawn.

THEOREM. Orthogonal projection onto a plane that contains O, Q0 and R0 maps every control point of formulas (7) and (8),
a combination of Q0, R0 and free points, to the same combination of the projections, and increases no norm. So while
all conditions are balls about O, the region of Q1 in the plane is both the section and the projection of the one in
space. With further conditions it is the region for free points that lie in the plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

from bezier.curves.enclosure import Enclosure, root_enclosure
from bezier.curves.scalar import Vector, dot, exactly, is_zero, scale, subtract
from bezier.methods.control import statements as st
from bezier.methods.control.system import coordinates
from bezier.problem import Problem
from qe.errors import InternalError


@dataclass(frozen=True, slots=True)
class Plane:
    """The points u * first + v * second. Invariant: the two vectors are rational, orthogonal and not zero."""

    first: Vector
    second: Vector

    @staticmethod
    def through(problem: Problem) -> Plane:
        """The plane through O, Q0 and R0, its first axis along R0 - Q0; one of them if the three are on a line."""
        q0, r0 = problem.via
        first = _along(subtract(r0, q0))
        others = [q0, problem.start, problem.goal, *(tuple(Fraction(i == k) for i in range(3)) for k in (2, 1, 0))]
        for other in others:
            across = subtract(other, scale(dot(other, first) / dot(first, first), first))
            if not all(map(is_zero, across)):
                return Plane(first, _along(across))
        raise InternalError("every vector is parallel to one")

    def point(self, u: Fraction, v: Fraction) -> Vector:
        """The point with these coordinates in the plane."""
        return tuple(u * a + v * b for a, b in zip(self.first, self.second, strict=True))

    def place(self, point: Vector) -> Vector:
        """The coordinates of the orthogonal projection of a point."""
        return tuple(dot(point, axis) / exactly(dot(axis, axis)) for axis in (self.first, self.second))

    @property
    def unit_area(self) -> Enclosure:
        """The area of the rectangle of the two axes, in the square of the unit of the points."""
        square = exactly(dot(self.first, self.first) * dot(self.second, self.second))
        return root_enclosure(square, square)

    def section(self, condition: st.Statement, free: Sequence[str]) -> st.Statement:
        """A condition on free points that lie in the plane, in their coordinates there (see ``plane_coordinates``)."""
        pairs = [pair for point in free for pair in zip(coordinates(point), self.terms(point), strict=True)]
        equations = [st.equal(st.name(name), term) for name, term in pairs]
        return st.exists([name for name, _ in pairs], st.every(*equations, condition))

    def terms(self, point: str) -> list[st.Term]:
        """The three coordinates of a control point in the plane, by its ``plane_coordinates``."""
        place, axes = st.names(plane_coordinates(point)), zip(self.first, self.second, strict=True)
        rows = ([st.product(st.number(exactly(a)), c) for a, c in zip(row, place, strict=True)] for row in axes)
        return [st.total(row) for row in rows]


def plane_coordinates(point: str) -> tuple[str, str]:
    """The variables of a control point in the plane: ``q1u, q1v``."""
    return f"{point.lower()}u", f"{point.lower()}v"


def _along(arrow: Vector) -> Vector:
    """A short rational vector in this direction: of length 1 if that is rational, else with coprime integers."""
    values = [exactly(c) for c in arrow]
    common = lcm(*(c.denominator for c in values))
    whole = [int(c * common) for c in values]
    square = Fraction(sum(c * c for c in whole))
    length = root_enclosure(square, square)
    if length.high is not None and length.low == length.high:
        return scale(1 / length.low, tuple(map(Fraction, whole)))
    return scale(Fraction(1, gcd(*whole)), tuple(map(Fraction, whole)))

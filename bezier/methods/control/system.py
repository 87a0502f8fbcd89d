"""Control points that follow from free ones, and the conditions on them: what formulas (7) and (8) share.

A ``Shape`` says which control points a method leaves free and how the joins fix the others; a ``System`` adds the
given points and the conditions of one problem. From it come the formula for the engine, the conditions with the
dependent points substituted, and the exact points and curves for a choice of the free ones. Variables: ``p1x, p1y,
p1z`` for the control point P1, and so on. A norm condition ||v|| <= r is written v.v <= r^2, which is the same for
r >= 0; with symbolic r the condition r >= 0 is written down too.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.curves.curve import Bezier
from bezier.curves.scalar import Vector, add, dot, exactly, scale, sign, subtract
from bezier.curves.workspace import Ball, Condition, HalfSpace
from bezier.methods.control import statements as st

AXES = "xyz"
Combination = tuple[tuple[Fraction, str], ...]
"""sum of coefficient * point."""
At = Callable[[str, int], st.Term]
"""Coordinate i of a point."""


def coordinates(point: str) -> tuple[str, ...]:
    """The three variables of a control point, e.g. ``q1x, q1y, q1z``."""
    return tuple(f"{point.lower()}{axis}" for axis in AXES)


def combination(*terms: tuple[int | Fraction, str]) -> Combination:
    """The terms with a coefficient other than zero."""
    return tuple((Fraction(c), name) for c, name in terms if c)


@dataclass(frozen=True, slots=True)
class OnPoint:
    """A condition on one inner control point: the atom of the formula that it stands for."""

    point: str
    condition: Condition

    @property
    def label(self) -> str:
        """``P1`` for the norm condition, ``P1.z`` for the table, ``P1.half_space[0]`` for a named condition."""
        short = {"ball": "", "floor": ".z"}.get(self.condition.name, f".{self.condition.name}")
        return self.point + short


@dataclass(frozen=True, slots=True)
class Shape:
    """A method's control points."""

    free: tuple[str, ...]
    """Those to be chosen."""
    follows: Mapping[str, Combination]
    """The others inside the curves, from the given and the free ones."""
    inner: tuple[str, ...]
    """Free and dependent ones in the order in which the formula bounds them."""
    curves: Mapping[str, tuple[str, ...]]
    """The control points of each curve."""
    ends: Mapping[str, str]
    """The last points of curves that are given points under another name."""
    route: tuple[str, ...]
    """The objective is the sum of |b - a|^2 over its consecutive points a, b."""

    @property
    def variables(self) -> tuple[str, ...]:
        """The coordinates of the free points."""
        return tuple(v for point in self.free for v in coordinates(point))

    @property
    def quantified(self) -> tuple[str, ...]:
        """The coordinates of the dependent points."""
        return tuple(v for point in self.follows for v in coordinates(point))

    def combination(self, point: str) -> Combination:
        """Any control point in terms of the given and the free ones."""
        return self.follows.get(point, ((Fraction(1), point),))

    def symbolic(self) -> st.Statement:
        """The formula with the given points and r left as parameters ``q0x``, ..., ``r``."""
        radius = st.name("r")
        norms = [st.at_most(st.squares(st.names(coordinates(point))), st.power(radius, 2)) for point in self.inner]
        joins = self.joins(lambda point, i: st.name(coordinates(point)[i]))
        return self.closed([st.at_least(radius, st.number(0)), *joins, *norms])

    def joins(self, at: At) -> list[st.Statement]:
        """The joins: each coordinate of each dependent point; ``at`` gives a coordinate of another point."""
        return [
            st.equal(st.name(variable), _combination(terms, i, at))
            for point, terms in self.follows.items()
            for i, variable in enumerate(coordinates(point))
        ]

    def closed(self, parts: Sequence[st.Statement]) -> st.Statement:
        """The conjunction of the parts with the dependent points existentially quantified."""
        return st.exists(self.quantified, st.every(*parts))


@dataclass(frozen=True, slots=True)
class System:
    """A shape with the given points, and the conditions that one problem puts on the inner control points."""

    shape: Shape
    given: Mapping[str, Vector]
    conditions: tuple[OnPoint, ...]

    # --- formulas ----------------------------------------------------------------------------------

    def statement(self) -> st.Statement:
        """The problem's formula: joins and conditions, the dependent points quantified."""
        return self.shape.closed([*self.joins(), *(statement for _, statement in self.labelled())])

    def labelled(self) -> list[tuple[str, st.Statement]]:
        """Each condition on its control point, under its label."""
        return [(item.label, stated(item.condition, st.names(coordinates(item.point)))) for item in self.conditions]

    def in_free_points(self) -> st.Statement:
        """The conditions with the dependent points in terms of the free ones."""
        return st.every(*(stated(item.condition, self._in_free(item.point)) for item in self.conditions))

    def joins(self) -> list[st.Statement]:
        """One equation for each coordinate of each dependent point, in the order of ``Shape.quantified``."""
        return self.shape.joins(self._at)

    def coordinate(self, point: str, i: int) -> st.Term:
        """Coordinate ``i`` of an inner control point in the free coordinates."""
        return self._in_free(point)[i]

    def objective(self) -> st.Term:
        """The paper's objective in the free coordinates."""
        pairs = pairwise(self.shape.route)
        return st.squares(st.difference(self._at(b, i), self._at(a, i)) for a, b in pairs for i in range(3))

    def _at(self, point: str, i: int) -> st.Term:
        """A coordinate: a number for a given point, a variable otherwise."""
        return st.number(exactly(self.given[point][i])) if point in self.given else st.name(coordinates(point)[i])

    def _in_free(self, point: str) -> list[st.Term]:
        terms = self.shape.combination(point)
        result = [_combination(terms, i, self._at) for i in range(3)]
        return result if point in self.shape.free else [st.bracketed(term) for term in result]

    # --- exact numbers ---------------------------------------------------------------------------

    def points(self, free: Sequence[Vector]) -> dict[str, Vector]:
        """All control points by name, curve by curve, for this choice of the free ones."""
        known = dict(self.given) | dict(zip(self.shape.free, free, strict=True))
        for point, terms in self.shape.follows.items():
            known[point] = _combined(terms, known)
        known |= {end: known[point] for end, point in self.shape.ends.items()}
        order = dict.fromkeys(name for names in self.shape.curves.values() for name in names)
        return {name: known[name] for name in order}

    def curves(self, points: Mapping[str, Vector]) -> dict[str, Bezier]:
        """The curves through these control points."""
        return {name: Bezier.of([points[p] for p in names]) for name, names in self.shape.curves.items()}

    def objective_at(self, points: Mapping[str, Vector]) -> Any:
        """The value of the objective, exactly."""
        arrows = [subtract(points[b], points[a]) for a, b in pairwise(self.shape.route)]
        return sum((dot(arrow, arrow) for arrow in arrows), Fraction(0))

    def active(self, points: Mapping[str, Vector]) -> tuple[str, ...]:
        """Labels of the conditions that hold with equality, exactly."""
        return self._with_margin(0, points)

    def violated(self, points: Mapping[str, Vector]) -> tuple[str, ...]:
        """Labels of the conditions that do not hold, exactly."""
        return self._with_margin(-1, points)

    def _with_margin(self, side: int, points: Mapping[str, Vector]) -> tuple[str, ...]:
        listed = self.conditions
        return tuple(item.label for item in listed if sign(item.condition.margin(points[item.point])) == side)

    def seen_by(self, free: str, points: Mapping[str, Vector]) -> tuple[Condition, ...]:
        """The conditions as conditions on one free point, the other ones fixed; the label is the name of each.

        A point w X + a lies in B(c, r) iff X lies in B((c - a)/w, r/|w|), and in {n.p + k >= 0} iff
        w n.X + (n.a + k) >= 0. Conditions that do not depend on the point are left out.
        """
        result = []
        for item in self.conditions:
            terms = self.shape.combination(item.point)
            weight = sum((c for c, name in terms if name == free), Fraction(0))
            if weight:
                rest = _combined([(c, name) for c, name in terms if name != free], points)
                result.append(_moved(item, weight, rest))
        return tuple(result)


def _combination(terms: Combination, i: int, at: At) -> st.Term:
    """Coordinate i of a combination."""
    return st.combined((coefficient, at(point, i)) for coefficient, point in terms)


def stated(condition: Condition, point: Sequence[st.Term]) -> st.Statement:
    """The condition about a point with these coordinates."""
    if isinstance(condition, Ball):
        away = [
            st.difference(c, st.number(exactly(o))) if o else c for c, o in zip(point, condition.centre, strict=True)
        ]
        return st.at_most(st.squares(away), st.number(exactly(condition.radius_squared)))
    pairs = [(n, c) for n, c in zip(condition.normal, point, strict=True) if n]
    parts = [c if n == 1 else st.product(st.number(exactly(n)), c) for n, c in pairs]
    return st.at_least(parts[0] if len(parts) == 1 else st.total(parts), st.number(exactly(-condition.offset)))


def _combined(terms: Sequence[tuple[Fraction, str]], points: Mapping[str, Vector]) -> Vector:
    total: Vector = (Fraction(0),) * 3
    for coefficient, name in terms:
        total = add(total, scale(coefficient, points[name]))
    return total


def _moved(item: OnPoint, weight: Fraction, rest: Vector) -> Condition:
    condition = item.condition
    if isinstance(condition, Ball):
        centre = scale(1 / weight, subtract(condition.centre, rest))
        return Ball(centre, condition.radius_squared / weight**2, item.label)
    return HalfSpace(scale(weight, condition.normal), condition.margin(rest), item.label)

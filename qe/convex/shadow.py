"""Projections of polyhedra: variables are eliminated while that makes few rows, then the shadow is cut out of space.

A cone that contains the shadow and is not it has a generator outside, which linear programming excludes by a half-space
(Farkas 1902); where all generators belong to the shadow it is the cone (Lassez, Lassez 1992). That takes about as many
steps as the shadow has facets and corners, however many rows there were on the way.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import gcd

from qe.convex.cone import Cone, Vector, combination, dot
from qe.convex.polyhedron import Check, HalfSpace, Polyhedron
from qe.exact.linear_bounds import LinearBounds
from qe.exact.sparse_solve import whole_multiples

_GROWTH = 4
"""Rows that the elimination of a variable may add."""

_UNIT, _SLACK = -1, -2
"""The columns of what is multiplied by the constants, and of e."""


def shadow(polyhedron: Polyhedron, columns: Iterable[int], check: Check) -> Polyhedron | None:
    """The projection along these columns, without rows that others imply; None where it is empty.

    THEOREM. ex x. a_i <= x <= b_j for all i, j iff a_i <= b_j for all i, j (strict where one of both is).
    """
    now: Polyhedron | None = polyhedron
    unknowns = set(columns)
    while unknowns and now is not None:
        check()
        solved = next(((e, j) for e in now.equations for j, c in e.normal if j in unknowns), None)
        if solved is not None:
            j = min((j for j, _ in solved[0].normal if j in unknowns), key=lambda j: abs(solved[0].at(j)))
            now = now.substituted(solved[0], j)
        else:
            j = min(unknowns, key=now.growth)
            growth = now.growth(j)
            if growth > _GROWTH:
                now = now.irredundant(check)
                return None if now is None else _cut_out(now, unknowns, check)
            now = now.combined(j)
            now = now.irredundant(check) if growth > 0 else now
        unknowns.discard(j)
    return None if now is None else now.irredundant(check)


def _cut_out(polyhedron: Polyhedron, columns: set[int], check: Check) -> Polyhedron | None:
    """The same of a polyhedron that is not empty, whose equations have none of the columns.

    THEOREM. A point satisfies all half-spaces, the strict ones strictly, iff for some e > 0 it satisfies them with
    form + e <= 0 in place of form < 0. So the shadow in the other columns and e is closed, and what bounds e there from
    above is strict without it.
    """
    rows = _Rows(polyhedron.halves, columns)
    cone, known = Cone(len(rows.kept)), set[Vector]()
    for column in rows.special:
        cone.cut(tuple(-int(j == column) for j in rows.kept))
    cuts: list[Vector] = []
    while (new := next((v for v in cone.generators() if v not in known), None)) is not None:
        check()
        cut = rows.cut(new, check)
        if cut is None:
            known.add(new)
        else:
            cuts.append(cut)
            cone.cut(cut)
    halves = (rows.half_space(cut) for cut in cuts)
    return Polyhedron(polyhedron.size, polyhedron.equations, tuple(h for h in halves if h)).irredundant(check)


class _Rows:
    """The half-spaces as rows <= 0 of a cone, in the columns and two more; ``kept``: those of its shadow."""

    def __init__(self, halves: Sequence[HalfSpace], columns: set[int]) -> None:
        self.rows = [_row(half) for half in halves]
        self.special = (_UNIT, _SLACK) if any(half.strict for half in halves) else (_UNIT,)
        self.kept = [*self.special, *sorted({j for row in self.rows for j in row if j >= 0} - columns)]
        self.bounds = LinearBounds()
        self.variables = {j: self.bounds.variable() for j in (*self.kept, *sorted(columns))}
        self.forms = [self.bounds.form({self.variables[j]: c for j, c in row.items()}) for row in self.rows]
        for i, x in enumerate(self.forms):
            self.bounds.at_most(x, Fraction(0), strict=False, reason=i)
        self.inside = self._inside()

    def cut(self, point: Vector, check: Check) -> Vector | None:
        """A half-space of the shadow that excludes the point and touches the shadow; None where the point is in it."""
        cut: Vector | None = None
        while (nearer := self._cut(point, check)) is not None:
            cut = nearer
            depth = -dot(cut, self.inside)
            if not depth:
                break
            point = combination(depth, point, dot(cut, point), self.inside)
        return cut

    def half_space(self, cut: Vector) -> HalfSpace | None:
        """What a row of the shadow says for e > 0 where the unit is 1; None for what the others imply."""
        terms = dict(zip(self.kept, cut))
        unit, slack = terms.pop(_UNIT), terms.pop(_SLACK, 0)
        return None if slack < 0 else HalfSpace.of(terms, unit, slack > 0)

    def _cut(self, point: Vector, check: Check) -> Vector | None:
        mark = self.bounds.mark()
        try:
            for j, value in zip(self.kept, point):
                x = self.variables[j]
                self.bounds.at_least(x, Fraction(value), strict=False, reason=None)
                self.bounds.at_most(x, Fraction(value), strict=False, reason=None)
            if self.bounds.conflict(check) is None:
                return None
            weights = whole_multiples({i: w for i, w in self.bounds.contradiction() if isinstance(i, int)})
        finally:
            self.bounds.back(mark)
        total = dict.fromkeys(self.variables, 0)
        for i, w in weights.items():
            for j, c in self.rows[i].items():
                total[j] += w * c
        content = gcd(*total.values()) or 1
        cut = tuple(total.pop(j) // content for j in self.kept)
        if any(w < 0 for w in weights.values()) or any(total.values()) or dot(cut, point) <= 0:
            raise ArithmeticError("no half-space that excludes the point")
        return cut

    def _inside(self) -> Vector:
        """A point of the shadow, as far inside as strict bounds bring it."""
        mark = self.bounds.mark()
        for strict in (True, False):
            self.bounds.at_least(self.variables[_UNIT], Fraction(1), strict=False, reason=None)
            if _SLACK in self.variables:
                self.bounds.at_least(self.variables[_SLACK], Fraction(0), strict=True, reason=None)
            for x in self.forms:
                self.bounds.at_most(x, Fraction(0), strict=strict, reason=None)
            if self.bounds.conflict(lambda: None) is None:
                break
            self.bounds.back(mark)
        values = self.bounds.point()
        self.bounds.back(mark)
        return tuple(whole_multiples({j: values[self.variables[j]] for j in self.kept}).values())


def _row(half: HalfSpace) -> dict[int, int]:
    scale = half.constant.denominator
    row = {j: c * scale for j, c in half.normal}
    if half.constant:
        row[_UNIT] = half.constant.numerator
    if half.strict:
        row[_SLACK] = scale
    return row

"""Polyhedra as rows: a variable less (Fourier 1826, Motzkin 1936), rows that the others imply go, exactly."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

from qe.exact.linear_bounds import LinearBounds

Normal = tuple[tuple[int, int], ...]
"""The coefficients that are not zero, with their columns, in ascending order: coprime integers."""
Check = Callable[[], object]


@dataclass(frozen=True, slots=True)
class HalfSpace:
    """sum of the coefficients times the columns + constant <= 0, or < 0."""

    normal: Normal
    constant: Fraction
    strict: bool

    @staticmethod
    def of(terms: Mapping[int, int], constant: Fraction | int, strict: bool) -> HalfSpace:
        """The same with coprime coefficients."""
        content = gcd(*terms.values()) or 1
        kept = tuple(sorted((j, c // content) for j, c in terms.items() if c))
        return HalfSpace(kept, Fraction(constant) / content, strict)

    def at(self, column: int) -> int:
        """The coefficient of a column."""
        return next((c for j, c in self.normal if j == column), 0)

    def plus(self, other: HalfSpace, mine: int, its: int) -> HalfSpace:
        """mine * this + its * other: both factors positive, or that of an equation."""
        terms = {j: mine * c for j, c in self.normal}
        for j, c in other.normal:
            terms[j] = terms.get(j, 0) + its * c
        return HalfSpace.of(terms, mine * self.constant + its * other.constant, self.strict or other.strict)


@dataclass(frozen=True, slots=True)
class Polyhedron:
    """The points of all half-spaces that satisfy the equations, half-spaces read as = 0; in ``size`` columns."""

    size: int
    equations: tuple[HalfSpace, ...]
    halves: tuple[HalfSpace, ...]

    def irredundant(self, check: Check) -> Polyhedron | None:
        """The same without half-spaces that follow from the others; None where it is empty.

        A half-space follows iff its complement and the others have no common point; one after the other is tested and
        left out at once.
        """
        halves = _tightest(self.halves)
        if halves is None:
            return None
        bounds = LinearBounds()
        columns = [bounds.variable() for _ in range(self.size)]
        forms = [_form(bounds, columns, row) for row in (*self.equations, *halves)]
        for row, x in zip(self.equations, forms):
            if x is None and row.constant:
                return None
            if x is not None and (
                bounds.at_least(x, -row.constant, strict=False, reason=None) is not None
                or bounds.at_most(x, -row.constant, strict=False, reason=None) is not None
            ):
                return None
        kept = dict(zip(forms[len(self.equations) :], halves))
        if any(_below(bounds, x, row) for x, row in kept.items()) or bounds.conflict(check) is not None:
            return None
        for x, row in sorted(kept.items(), key=lambda pair: -len(pair[1].normal)):
            assert x is not None
            bounds.free(x)
            if (
                bounds.at_least(x, -row.constant, strict=not row.strict, reason=None) is not None
                or bounds.conflict(check) is not None
            ):
                bounds.free(x)
                del kept[x]
            else:
                bounds.free(x)
                _below(bounds, x, row)
        equations = tuple(row for row in self.equations if row.normal)
        return Polyhedron(self.size, equations, tuple(kept.values()))

    def growth(self, column: int) -> int:
        """How many half-spaces more there are without a column."""
        signs = [c for row in self.halves for c in (row.at(column),) if c]
        above = sum(c > 0 for c in signs)
        return above * (len(signs) - above) - len(signs)

    def substituted(self, equation: HalfSpace, column: int) -> Polyhedron:
        """Without a column, by an equation that has it."""
        lead = equation.at(column)

        def without(row: HalfSpace) -> HalfSpace:
            factor = row.at(column)
            common = gcd(lead, factor)
            scale = abs(lead) // common
            return row.plus(equation, scale, -factor * scale // lead) if factor else row

        rest = tuple(without(e) for e in self.equations if e is not equation)
        return Polyhedron(self.size, rest, tuple(map(without, self.halves)))

    def combined(self, column: int) -> Polyhedron:
        """Without a column: each upper bound of it with each lower one."""
        above = [(row, c) for row in self.halves if (c := row.at(column)) > 0]
        below = [(row, -c) for row in self.halves if (c := row.at(column)) < 0]
        rest = [row for row in self.halves if not row.at(column)]
        sums = [p.plus(q, d // gcd(c, d), c // gcd(c, d)) for p, c in above for q, d in below]
        return Polyhedron(self.size, self.equations, (*rest, *sums))


def _tightest(halves: Iterable[HalfSpace]) -> tuple[HalfSpace, ...] | None:
    """One half-space of each normal, none without; None where one is empty."""
    best: dict[Normal, HalfSpace] = {}
    for row in halves:
        known = best.get(row.normal)
        if known is None or (row.constant, row.strict) > (known.constant, known.strict):
            best[row.normal] = row
    everything = best.pop((), None)
    if everything is not None and (everything.constant > 0 or (everything.constant == 0 and everything.strict)):
        return None
    return tuple(best.values())


def _form(bounds: LinearBounds, columns: Sequence[int], row: HalfSpace) -> int | None:
    """A variable equal to the terms of a row; None for none."""
    return bounds.form({columns[j]: Fraction(c) for j, c in row.normal}) if row.normal else None


def _below(bounds: LinearBounds, x: int | None, row: HalfSpace) -> bool:
    """Bound a row from above; whether that is a contradiction."""
    return x is not None and bounds.at_most(x, -row.constant, strict=row.strict, reason=None) is not None


def whole(row: HalfSpace) -> tuple[dict[int, int], int]:
    """Integer coefficients and constant of a positive multiple."""
    scale = lcm(1, row.constant.denominator)
    return {j: c * scale for j, c in row.normal}, int(row.constant * scale)

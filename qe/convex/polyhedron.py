"""Polyhedra as rows: a variable less (Fourier 1826, Motzkin 1936), rows that the others imply go, exactly."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd

from qe.convex.linear_rows import LinearRows
from qe.exact.linear_bounds import LinearBounds
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import Formula, Relation

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

    def poly(self, names: Sequence[str], ring: Ring) -> Poly:
        """A positive multiple with whole coefficients, with names for the columns."""
        scale = self.constant.denominator
        poly = ring.from_sparse([(((ring.index[names[j]], 1),), c * scale) for j, c in self.normal])
        return poly + self.constant.numerator

    def condition(self, names: Sequence[str], ring: Ring, relation: Relation | None = None) -> Formula:
        """The comparison that it is, or another one of the same polynomial."""
        return atom(self.poly(names, ring), relation or (Relation.LT if self.strict else Relation.LE))


Sums = dict[HalfSpace | None, list[tuple[HalfSpace, Fraction]]]
"""Why a half-space follows from others: a positive multiple of its form is no more than the sum of these multiples of
theirs; and under None why there is no point: the sum is a positive number, or 0 and one of them strict."""


@dataclass(frozen=True, slots=True)
class Polyhedron:
    """The points of all half-spaces that satisfy the equations, half-spaces read as = 0; in ``size`` columns."""

    size: int
    equations: tuple[HalfSpace, ...]
    halves: tuple[HalfSpace, ...]

    @staticmethod
    def of(system: LinearRows) -> Polyhedron:
        """That of the conditions."""
        halves = [(HalfSpace.of(row.terms, row.constant, row.is_strict), row.is_equation) for row in system.rows]
        equations, others = (tuple(h for h, equal in halves if equal == kind) for kind in (True, False))
        return Polyhedron(len(system.names), equations, others)

    def irredundant(self, check: Check, sums: Sums | None = None) -> Polyhedron | None:
        """The same without half-spaces that follow from the others; None where it is empty. ``sums`` gets the reasons.

        A half-space follows iff its complement and the others have no common point. Each is tested against those that
        are kept so far, so that there are never many more than there will be, then each of these against the others.
        """
        sums = {} if sums is None else sums
        halves = _tightest(self.halves, sums)
        if halves is None or any(row.constant and not row.normal for row in self.equations):
            return None
        bounds = LinearBounds()
        columns = [bounds.variable() for _ in range(self.size)]

        def form(row: HalfSpace) -> int:
            return bounds.form({columns[j]: Fraction(c) for j, c in row.normal})

        def follows(x: int, row: HalfSpace) -> bool:
            bounds.free(x)
            bounds.at_least(x, -row.constant, strict=not row.strict, reason=None)
            if excluded := bounds.conflict(check) is not None:
                sums[row] = _reasons(bounds)
            bounds.free(x)
            return excluded

        equations = tuple(row for row in self.equations if row.normal)
        for row in equations:  # no form has two variables, so that bounds conflict only with those of others
            x = form(row)
            bounds.at_least(x, -row.constant, strict=False, reason=row)
            bounds.at_most(x, -row.constant, strict=False, reason=row)
        kept: dict[HalfSpace, int] = {}
        for row in sorted(halves, key=lambda row: len(row.normal)):
            x = form(row)
            if follows(x, row):
                bounds.forget(x)
            else:
                kept[row] = x
                bounds.at_most(x, -row.constant, strict=row.strict, reason=row)
        if bounds.conflict(check) is not None:
            sums[None] = _reasons(bounds)
            return None
        for row in sorted(kept, key=lambda row: -len(row.normal)):
            if follows(kept[row], row):
                del kept[row]
            else:
                bounds.at_most(kept[row], -row.constant, strict=row.strict, reason=row)
        return Polyhedron(self.size, equations, tuple(row for row in halves if row in kept))

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

    def combined(self, column: int, sums: Sums | None = None) -> Polyhedron:
        """Without a column: each upper bound of it with each lower one. ``sums`` gets of which they are made."""
        above = [(row, c) for row in self.halves if (c := row.at(column)) > 0]
        below = [(row, -c) for row in self.halves if (c := row.at(column)) < 0]
        rest = [row for row in self.halves if not row.at(column)]
        pairs = [((p, d // gcd(c, d)), (q, c // gcd(c, d))) for p, c in above for q, d in below]
        made: Sums = {p.plus(q, mine, its): [(p, Fraction(mine)), (q, Fraction(its))] for (p, mine), (q, its) in pairs}
        if sums is not None:
            sums.update(made)
        return Polyhedron(self.size, self.equations, (*rest, *filter(None, made)))


def _tightest(halves: Iterable[HalfSpace], sums: Sums) -> tuple[HalfSpace, ...] | None:
    """One half-space of each normal, none without; None where one is empty."""
    best: dict[Normal, HalfSpace] = {}
    for row in halves:
        known = best.setdefault(row.normal, row)
        if (row.constant, row.strict) > (known.constant, known.strict):
            best[row.normal], row, known = row, known, row
        if row != known:
            sums[row] = [(known, Fraction(1))]
    everything = best.pop((), None)
    if everything is not None and (everything.constant > 0 or (everything.constant == 0 and everything.strict)):
        sums[None] = sums.get(everything, [])
        return None
    return tuple(best.values())


def _reasons(bounds: LinearBounds) -> list[tuple[HalfSpace, Fraction]]:
    """The half-spaces in a contradiction, beside the one that is tested."""
    return [(row, weight) for row, weight in bounds.contradiction() if isinstance(row, HalfSpace)]

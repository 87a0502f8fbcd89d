"""One line over a sample: where the real roots of its factors are, and the signs that they have between these.

The counting differs from the producers': a sign change between neighbouring rational numbers proves at least one root,
and the total number of distinct real roots comes from enclosures of all complex roots or Sturm's theorem. If every
listed section shows a sign change and the total equals the number of listed sections, each holds exactly one root and
there are no others. A root of even order shows no sign change; it does in the squarefree part.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from qe.errors import CertificateRejected
from qe.exact.ring import Poly
from qe.kernel.arithmetic.fibre import (
    Fibre,
    RationalFibre,
    Simple,
    Values,
    fibre,
    lazard_evaluation,
    lift_up,
    values,
)
from qe.kernel.arithmetic.products import FactorLists, Product, Signs, sign
from qe.kernel.arithmetic.triangular import Coordinate, Point
from qe.kernel.limits import check_value
from qe.proof.cells import Stack

Fail = Callable[[str, str], CertificateRejected]


@dataclass(frozen=True, slots=True)
class Sample:
    """A sample point, and the set around it that it stands for.

    ``point``: the algebraic coordinates; ``rationals``: the rational ones by level. ``signs``: those of factors at the
    point. ``dimensions[d]``: the dimension of the set's projection to the first d variables; where it is 0, the set is
    the point alone. ``below``: the sample without its last coordinate.
    """

    lists: FactorLists
    point: Point
    rationals: dict[int, Fraction]
    signs: Signs
    dimensions: tuple[int, ...]
    below: Sample | None = None
    _polys: dict[tuple[int, int], Poly] = field(default_factory=dict)

    @property
    def depth(self) -> int:
        """How many coordinates it has."""
        return len(self.dimensions) - 1

    @property
    def is_alone(self) -> bool:
        """Whether it stands for itself only."""
        return not self.dimensions[-1]

    def extended(self, number: Fraction | Coordinate, signs: list[int | None], *, alone: bool) -> Sample:
        """The sample one coordinate longer; ``alone``: it stands for no other point of the line over this one."""
        dimensions = (*self.dimensions, self.dimensions[-1] + (not alone))
        point, rationals = self.point, self.rationals
        if isinstance(number, Coordinate):
            point = point.extended(number)
        else:
            rationals = {**rationals, self.depth: number}
        return Sample(self.lists, point, rationals, [*self.signs, signs], dimensions, self)

    def factor(self, level: int, index: int) -> Poly:
        """A factor with the rational coordinates put in."""
        found = self._polys.get((level, index))
        if found is None:
            found = self.lists.lists[level][index] if self.below is None else self.below.factor(level, index)
            last = self.depth - 1
            if last in self.rationals:
                found = self._put(found, last)
            self._polys[level, index] = found
        return found

    def _put(self, f: Poly, level: int) -> Poly:
        if not f.degree(level):
            return f
        check_value(f, level, self.rationals[level])
        return f.at_rational(level, self.rationals[level])

    def sign(self, f: Poly) -> int:
        """The sign of a polynomial at the point."""
        known = {level: self.rationals[level] for level in f.variables if level in self.rationals}
        for level, number in known.items():
            check_value(f, level, number)
        return self.point.sign(f.at_rationals(known))

    def sign_of(self, product: Product) -> int:
        """The sign of a product of factors at the point."""
        known = sign(product, self.signs)
        if known is None:
            known = product.unit
            for level, index, exponent in product.powers:
                known *= self.sign(self.lists.lists[level][index]) ** exponent
        return known

    def is_zero(self, f: Poly) -> bool:
        """Whether a polynomial is zero on the whole line over the point."""
        return not any(self.sign(c) for c in f.coefficients(self.depth) if c)


@dataclass(slots=True)
class Branch:
    """A factor over a sample, with its sign at every sector; ``zero``: on the whole line. ``simple`` has the same real
    roots, all simple (None: not computed)."""

    fibre: Fibre
    signs: list[int]
    zero: bool
    simple: Simple | None


@dataclass(frozen=True, slots=True)
class Line:
    """A line found correct: the factors whose roots are its sections, those that are zero on all of it, and the signs
    of all at every position."""

    stack: Stack
    sample: Sample
    branches: dict[int, Branch]
    zero: frozenset[int]
    signs: list[list[int | None]]
    fail: Fail

    def number(self, position: int) -> Fraction | Coordinate:
        """The value of the variable at a position: at a sector's sample, or at the root between two."""
        j, odd = divmod(position, 2)
        if not odd:
            return self.stack.sectors[j]
        low, high = self.stack.sectors[j : j + 2]
        for branch in sorted((self.branches[i] for i in self.stack.sections[j]), key=lambda b: b.fibre.degree):
            if branch.simple is None:
                branch.simple = branch.fibre.squarefree()  # not needed for counting, so not computed before
            found = branch.simple.coordinate(low, high)
            if found is not None:
                return found
        raise self.fail(f"sections[{j}]", "its root could not be represented")


def line_over(sample: Sample, stack: Stack, constraint: frozenset[int], fail: Fail, *, evaluates: bool) -> Line:
    """The sections are all the real roots of the factors used, each listed where it is; or an error by
    ``fail(entry, reason)``. Where some are the factors of a constraint, and none of these is zero on the whole line,
    the sections are theirs alone. ``evaluates``: a factor that is zero there has the roots of its Lazard evaluation.
    """
    _check_shape(stack, len(sample.lists.lists[sample.depth]), fail)
    at, first = values(tuple(stack.sectors)), [i for i in stack.used if i in constraint]
    branches = {i: _branch(i, sample, stack, at, fail, evaluates) for i in first}
    if not first or any(b.zero for b in branches.values()):
        branches |= {i: _branch(i, sample, stack, at, fail, evaluates) for i in stack.used if i not in branches}
    for j, section in enumerate(stack.sections):
        for i in section:
            if i not in branches:
                raise fail(f"sections[{j}]", f"factor {i} is none of the constraint's")
        for i in section[1:]:
            if not _share(branches[section[0]].fibre, branches[i].fibre, sample.point, at[j : j + 2]):
                raise fail(f"sections[{j}]", f"factors {section[0]} and {i} have no common root there")
    columns: list[list[int | None]] = [[None] * len(stack.positions) for _ in sample.lists.lists[sample.depth]]
    for i, branch in branches.items():
        columns[i][::2], columns[i][1::2] = branch.signs, branch.signs[1:]
    for j, section in enumerate(stack.sections):
        for i in section:
            columns[i][2 * j + 1] = 0
    rows = [list(row) for row in zip(*columns, strict=True)] if columns else [[] for _ in stack.positions]
    return Line(stack, sample, branches, frozenset(i for i, b in branches.items() if b.zero), rows, fail)


def _check_shape(stack: Stack, count: int, fail: Fail) -> None:
    used = stack.used
    if any(a >= b for a, b in pairwise(used)) or (used and not 0 <= used[0] <= used[-1] < count):
        raise fail("used", "not an ascending list of factors of this level")
    if not stack.sectors:
        raise fail("sectors", "no sector")
    for j, (a, b) in enumerate(pairwise(stack.sectors)):
        if a >= b:
            raise fail(f"sectors[{j + 1}]", "the sector samples do not ascend")
    if len(stack.sections) != len(stack.sectors) - 1:
        raise fail("sections", f"{len(stack.sections)} sections between {len(stack.sectors)} sectors")
    for j, section in enumerate(stack.sections):
        if any(a >= b for a, b in pairwise(section)) or not set(used).issuperset(section):
            raise fail(f"sections[{j}]", "not an ascending list of used factors")


def _branch(i: int, sample: Sample, stack: Stack, at: Values, fail: Fail, evaluates: bool) -> Branch:
    k, listed = sample.depth, [j for j, section in enumerate(stack.sections) if i in section]
    f = fibre(sample.point, sample.factor(k, i), k)
    zero = f.degree < 0
    if zero and evaluates:
        original = sample.lists.lists[k][i]
        f = fibre(sample.point, lazard_evaluation(original, sample.point, sample.rationals, k), k)
    elif zero and listed:
        raise fail(f"sections[{listed[0]}]", f"factor {i} is zero on the whole line")
    elif zero:
        return Branch(f, [0] * len(at), True, None)
    signs, simple = roots_and_signs(f, at, listed, lambda entry, reason: fail(entry, f"factor {i}: {reason}"))
    return Branch(f, [0] * len(signs) if zero else signs, zero, simple)


def _share(f: Fibre, g: Fibre, point: Point, ends: Values) -> bool:
    """Whether two polynomials over the point, each with one root between two numbers, have it in common."""
    if isinstance(f, RationalFibre) != isinstance(g, RationalFibre):
        f, g = lift_up(f, point), lift_up(g, point)
    common = f.gcd(g)
    if common.degree < 1:
        return False
    low, high = common.signs(ends)
    if low * high >= 0:
        low, high = common.squarefree().signs(ends)
    return low * high < 0


def roots_and_signs(f: Fibre, at: Values, listed: list[int], fail: Fail) -> tuple[list[int], Simple | None]:
    """The signs of f at the samples, after a check that it has one root in each listed section and no others; and a
    polynomial with the same roots, all simple (None: not computed)."""
    signs = f.signs(at)
    if 0 in signs:
        raise fail(f"sectors[{signs.index(0)}]", "it is zero at this sector sample")
    simple: Simple = f
    changes = _changes(signs)
    if changes != listed:
        simple = f.squarefree()
        changes = _changes(simple.signs(at))
    for j in sorted({*changes}.symmetric_difference(listed)):
        raise fail(f"sections[{j}]", "it has no root here" if j in listed else "it has a root here that is not listed")
    if len(changes) < simple.degree and simple.count() > len(changes):
        raise fail("sections", "a root of it is missing")
    return signs, simple if simple is not f or len(changes) == f.degree or isinstance(f, RationalFibre) else None


def _changes(signs: list[int]) -> list[int]:
    """Where neighbours differ."""
    return [j for j, (a, b) in enumerate(pairwise(signs)) if a != b]

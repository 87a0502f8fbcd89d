"""One line over a sample: where the real roots of its factors are, and the signs that they have between these.

The counting differs from the producers': a sign change between neighbouring rational numbers proves at least one
root, and the total number of distinct real roots comes from the sign of the discriminant or from Sturm's theorem. If
every listed section shows a sign change and the total equals the number of listed sections, each holds exactly one root
and there are no others. A root of even order shows no sign change; it does in the squarefree part.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from qe.errors import CertificateRejected
from qe.exact.ring import Poly
from qe.kernel.arithmetic.fibre import (
    Fibre,
    RationalFibre,
    Simple,
    SimplePart,
    Values,
    fibre,
    lazard_evaluation,
    lift_up,
    values,
)
from qe.kernel.arithmetic.products import FactorLists, Product, Signs, sign
from qe.kernel.arithmetic.triangular import Coordinate, Point
from qe.kernel.limits import check_value
from qe.kernel.projection import DISCRIMINANT, LEADING, RESULTANT, Projected
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
        for level in self.rationals:
            f = self._put(f, level)
        return self.point.sign(f)

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

    index: int
    fibre: Fibre
    signs: list[int]
    zero: bool
    simple: Simple | None


@dataclass(frozen=True, slots=True)
class Line:
    """A line found correct: the factors whose roots are its sections, and the signs of all at every position."""

    stack: Stack
    sample: Sample
    branches: dict[int, Branch]
    signs: list[list[int | None]]
    fail: Fail

    @property
    def zero(self) -> frozenset[int]:
        """The factors that are zero on the whole line."""
        return frozenset(i for i, b in self.branches.items() if b.zero)

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


def line_over(sample: Sample, stack: Stack, constraint: frozenset[int], projection: Projected, fail: Fail) -> Line:
    """The sections are all the real roots of the factors used, each listed where it is; or an error by ``fail(entry,
    reason)``. Where some are the factors of a constraint, and none of these is zero on the whole line, the sections are
    theirs alone.
    """
    _check_shape(stack, len(sample.lists.lists[sample.depth]), fail)
    at, first = values(stack.sectors), [i for i in stack.used if i in constraint]
    lines = _Lines(sample, stack, at, projection, fail)
    branches = lines.branches(first)
    if not first or any(b.zero for b in branches.values()):
        branches |= lines.branches(i for i in stack.used if i not in branches)
    for j, section in enumerate(stack.sections):
        for i in section:
            if i not in branches:
                raise fail(f"sections[{j}]", f"factor {i} is none of the constraint's")
        for other in section[1:]:
            if not lines.share(branches[section[0]], branches[other], at[j : j + 2]):
                raise fail(f"sections[{j}]", f"factors {section[0]} and {other} have no common root there")
    columns: list[list[int | None]] = [[None] * len(stack.positions) for _ in sample.lists.lists[sample.depth]]
    for i, branch in branches.items():
        columns[i][::2], columns[i][1::2] = branch.signs, branch.signs[1:]
    for j, section in enumerate(stack.sections):
        for i in section:
            columns[i][2 * j + 1] = 0
    rows = [list(row) for row in zip(*columns, strict=True)] if columns else [[] for _ in stack.positions]
    return Line(stack, sample, branches, rows, fail)


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


@dataclass(frozen=True, slots=True)
class _Lines:
    """What is the same for all factors of a line."""

    sample: Sample
    stack: Stack
    at: Values
    projection: Projected
    fail: Fail

    def branches(self, indices: Iterable[int]) -> dict[int, Branch]:
        return {i: self._branch(i) for i in indices}

    def _branch(self, i: int) -> Branch:
        sample, k = self.sample, self.sample.depth
        listed = [j for j, section in enumerate(self.stack.sections) if i in section]
        f = fibre(sample.point, sample.factor(k, i), k, leading_nonzero=bool(self._sign(LEADING, i, i)))
        zero = f.degree < 0
        if zero and self.projection.evaluates:
            original = sample.lists.lists[k][i]
            f = fibre(sample.point, lazard_evaluation(original, sample.point, sample.rationals, k), k)
        elif zero and listed:
            raise self.fail(f"sections[{listed[0]}]", f"factor {i} is zero on the whole line")
        elif zero:
            return Branch(i, f, [0] * len(self.at), True, None)
        discriminant = None if zero else self._sign(DISCRIMINANT, i, i)
        if not discriminant and f.degree != sample.lists.lists[k][i].degree(k):
            discriminant = None  # it is zero because the degree drops, which says nothing about multiple roots
        wrong: Fail = lambda entry, reason: self.fail(entry, f"factor {i}: {reason}")  # noqa: E731
        signs, simple = roots_and_signs(f, self.at, listed, discriminant, wrong)
        return Branch(i, f, [0] * len(signs) if zero else signs, zero, simple)

    def _sign(self, what: str, i: int, j: int) -> int | None:
        """The sign of a part of the projection; None where it is not known, or not needed over a single point."""
        product = self.projection.product(what, self.sample.depth, i, j, known=self.sample.is_alone)
        return None if product is None else sign(product, self.sample.signs)

    def share(self, a: Branch, b: Branch, ends: Values) -> bool:
        """Whether the only roots of a and b between two neighbouring sector samples are equal."""
        f, g, point = a.fibre, b.fibre, self.sample.point
        if isinstance(f, RationalFibre) != isinstance(g, RationalFibre):
            f, g = lift_up(f, point), lift_up(g, point)
        if not isinstance(f, RationalFibre) and self._resultant_zero(a, b):
            if min(f.degree, g.degree) == 1:
                return True  # a common root exists, and the polynomial of degree 1 has only this one
            if f.shares_root(g, ends[0][0], ends[1][0]):
                return True
        common = f.gcd(g)
        if common.degree < 1:
            return False
        low, high = common.signs(ends)
        if low * high >= 0:
            low, high = common.squarefree().signs(ends)
        return low * high < 0

    def _resultant_zero(self, a: Branch, b: Branch) -> bool:
        """Whether the resultant is zero for a reason other than two vanishing leading coefficients."""
        if a.zero or b.zero or not any(self._sign(LEADING, n.index, n.index) for n in (a, b)):
            return False
        return self._sign(RESULTANT, *sorted((a.index, b.index))) == 0


def roots_and_signs(
    f: Fibre, at: Values, listed: list[int], discriminant: int | None, fail: Fail
) -> tuple[list[int], Simple | None]:
    """``check_roots``, with the signs of f at the samples.

    First with few signs (``_signs_beside``): where that is accepted, f has no roots but one in each listed section, so
    the others are what they were taken for. Otherwise with all, to name what is wrong.
    """
    signs = _signs_beside(f, at, listed)
    if 0 not in signs:
        with suppress(CertificateRejected):
            return signs, check_roots(f, signs, at, listed, discriminant, fail)
    signs = f.signs(at)
    if 0 in signs:
        raise fail(f"sectors[{signs.index(0)}]", "it is zero at this sector sample")
    return signs, check_roots(f, signs, at, listed, discriminant, fail)


def _signs_beside(f: Simple, at: Values, listed: list[int]) -> list[int]:
    """The signs at the first and last sample and on both sides of the listed sections; elsewhere the last one before.

    So a sign that changes inside a section is seen there, and one that changes outside all of them in no listed one.
    """
    places = sorted({0, len(at) - 1, *listed, *(j + 1 for j in listed)})
    known = dict(zip(places, f.signs([at[k] for k in places]), strict=True))
    signs: list[int] = []
    for k in range(len(at)):
        signs.append(known[k] if k in known else signs[-1])
    return signs


def check_roots(
    f: Simple, signs: list[int], at: Values, listed: list[int], discriminant: int | None, fail: Fail
) -> Simple | None:
    """The listed sections hold exactly one root of f each and there are no others.

    Returns f or a polynomial with the same roots, all simple (None if that was not computed).
    """
    changes = [j for j in range(len(signs) - 1) if signs[j] != signs[j + 1]]
    for j in changes:
        if j not in listed:
            raise fail(f"sections[{j}]", "it has a root here that is not listed")
    if f.degree <= 1 or len(changes) == f.degree:
        if listed != changes:
            raise fail(f"sections[{next(j for j in listed if j not in changes)}]", "it has no root here")
        if len(changes) != f.degree:
            raise fail("sections", "a root of it is missing")
        return f
    if discriminant == 0:
        simple = f.derivative() if f.degree == 2 and not isinstance(f, SimplePart) else f.squarefree()
        return check_roots(simple, _signs_beside(simple, at, listed), at, listed, None, fail) or simple
    if changes == listed:
        missing = _distinct_roots(f, len(changes), discriminant) - len(changes)
        if missing:
            raise fail("sections", f"{missing} root(s) of it missing")
        return f if discriminant or isinstance(f, RationalFibre) else None
    simple = f if discriminant else f.squarefree()
    if simple.degree == f.degree:
        raise fail(f"sections[{next(j for j in listed if j not in changes)}]", "it has no root here")
    return check_roots(simple, _signs_beside(simple, at, listed), at, listed, None, fail) or simple


def _distinct_roots(f: Simple, seen: int, discriminant: int | None) -> int:
    """The number of distinct real roots (at least, if more than ``seen``), of which ``seen`` are known.

    The sign of the discriminant is (-1)^c with c the number of pairs of conjugate nonreal roots (Basu, Pollack,
    Roy, proposition 4.5), also with a formal degree one too high; so the number of real roots is known mod 4.
    """
    if (f.degree - seen) % 2:
        return seen + 1  # nonreal roots come in pairs, so at least one real root was not seen
    if discriminant and f.degree - seen < 4:
        pairs = (f.degree - seen) // 2
        expected = -1 if pairs % 2 else 1
        return seen if expected == discriminant else seen + 2
    return f.count()

"""One stack: it lists exactly the real roots of its factors over the cell's sample, in order, with their signs.

The counting differs from the producers': a sign change between neighbouring sector samples proves at least one
root, and the total number of distinct real roots comes from the sign of the discriminant (already proved on the
cell) or from Sturm's theorem. If every listed section shows a sign change and the total equals the number of
listed sections, each holds exactly one root and there are no others. A root of even order shows no sign change;
it does in the squarefree part. At a level with an equational constraint the sections are the roots of the constraint's
factors; the signs of the other factors are computed at the sections and are unknown between them.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
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
from qe.kernel.arithmetic.products import FactorLists, Signs, sign
from qe.kernel.arithmetic.triangular import Coordinate, Point
from qe.kernel.closure import Closure, nullification_witnesses
from qe.kernel.limits import check_value
from qe.proof.cells import Stack

Fail = Callable[[str, str], CertificateRejected]


@dataclass(frozen=True, slots=True)
class Sample:
    """A sample point and what is known on its cell.

    ``point``: the algebraic coordinates; ``rationals``: the rational ones by level. ``polys[k]``: the factors of
    level k with the rational coordinates substituted. ``signs``: the proved signs. ``dimensions[d]``: the
    dimension of the cell's projection to the first d variables.
    """

    point: Point
    rationals: dict[int, Fraction]
    polys: tuple[tuple[Poly, ...], ...]
    signs: Signs
    dimensions: tuple[int, ...]

    @property
    def depth(self) -> int:
        return len(self.dimensions) - 1

    def extended(self, number: Fraction | Coordinate, signs: list[int | None], *, sector: bool) -> Sample:
        """The sample of a cell of the stack over this one, with the signs proved there."""
        k, dimensions = self.depth, (*self.dimensions, self.dimensions[-1] + sector)
        if isinstance(number, Coordinate):
            return Sample(self.point.extended(number), self.rationals, self.polys, [*self.signs, signs], dimensions)
        for level in self.polys[k:]:
            for f in level:
                check_value(f, k, number)
        polys = tuple(
            tuple(f.at_rational(k, number) if f.degree(k) else f for f in level) if at >= k else level
            for at, level in enumerate(self.polys)
        )
        return Sample(self.point, {**self.rationals, k: number}, polys, [*self.signs, signs], dimensions)


@dataclass(slots=True)
class Branch:
    """One used factor over the sample: ``simple`` has the same real roots, all simple (None: not computed)."""

    index: int
    fibre: Fibre
    signs: list[int]
    nullified: bool
    simple: Simple | None


@dataclass(frozen=True, slots=True)
class Checked:
    """A stack found correct: the signs on every cell (per factor of the level), and its branches.

    ``restricted``: only the sections, those of a constraint, may be decomposed further; ``places``: their samples.
    """

    signs: list[list[int | None]]
    branches: dict[int, Branch]
    nullified: frozenset[int]
    restricted: bool
    places: dict[int, Sample]


class StackChecker:
    """Checks stacks of one table; holds only what the closure check proved."""

    def __init__(self, lists: FactorLists, closure: Closure) -> None:
        self.lists, self.closure = lists, closure
        self._witnesses: dict[tuple[int, int], list[Poly]] = {}

    def check(self, stack: Stack, sample: Sample, fail: Fail) -> Checked:
        """The proved content of the stack, or an error made by ``fail(entry, reason)``."""
        k = sample.depth
        _check_shape(stack, len(self.lists.lists[k]), k == len(self.lists.lists) - 1, fail)
        at = values(stack.sectors)
        listed: dict[int, list[int]] = {i: [] for i in stack.used}
        for j, section in enumerate(stack.sections):
            for i in section:
                listed[i].append(j)
        constraint = self.closure.constraints[k]
        first = [i for i in stack.used if i in constraint]
        branches = {i: self._branch(i, sample, at, listed[i], fail) for i in first}
        restricted = bool(first) and not any(b.nullified for b in branches.values())
        if not restricted:
            if constraint and sample.dimensions[-1]:
                raise fail("used", "the constraint does not restrict the stack, and it stands over more than a point")
            branches |= {i: self._branch(i, sample, at, listed[i], fail) for i in stack.used if i not in branches}
        for j, section in enumerate(stack.sections):
            for i in section:
                if i not in branches:
                    raise fail(f"sections[{j}]", f"factor {i} is none of the constraint's")
            for other in section[1:]:
                if not self._share(branches[section[0]], branches[other], sample, at[j : j + 2]):
                    raise fail(f"sections[{j}]", f"factors {section[0]} and {other} have no common root there")
        nullified = frozenset(i for i, b in branches.items() if b.nullified)
        signs, places = _sign_rows(stack, branches, len(self.lists.lists[k])), dict[int, Sample]()
        checked = Checked(signs, branches, nullified, restricted, places)
        if restricted:
            self._fill_sections(checked, stack, sample, fail)
        return checked

    def _fill_sections(self, checked: Checked, stack: Stack, sample: Sample, fail: Fail) -> None:
        """The signs of the factors besides those of the constraint, at the sample of every section."""
        k = sample.depth
        others = [i for i in stack.used if i not in checked.branches]
        if k < len(self.lists.lists) - 1:
            for i in others:
                self._check_not_nullified(i, sample, fail)
        for j in range(len(stack.sections)):
            row = checked.signs[2 * j + 1]
            number = self.section_coordinate(checked, stack, j, fail)
            place = checked.places[j] = sample.extended(number, row, sector=False)
            for i in others:
                row[i] = place.point.sign(place.polys[k][i])

    def _check_not_nullified(self, i: int, sample: Sample, fail: Fail) -> None:
        """McCallum 2001 needs the factors besides a constraint's delineable too, except on the last level."""
        k = sample.depth
        if not sign(self.closure.leading[k][i], sample.signs):
            if fibre(sample.point, sample.polys[k][i], k).degree < 0:
                raise fail("used", f"factor {i} vanishes identically over the sample: not well-oriented")
            self._check_nowhere_nullified(i, sample, fail)

    # --- one factor ------------------------------------------------------------------------
    def _branch(self, i: int, sample: Sample, at: Values, listed: list[int], fail: Fail) -> Branch:
        k = sample.depth
        poly = sample.polys[k][i]
        known = self.closure.leading[k].get(i)  # None for factors besides a constraint's, over a single point
        lead = sign(known, sample.signs) if known else None
        f = fibre(sample.point, poly, k, leading_nonzero=bool(lead))
        nullified = f.degree < 0
        if nullified:
            self._allow_nullified(i, sample, fail)
            if self.closure.evaluates:
                original = self.lists.lists[k][i]
                f = fibre(sample.point, lazard_evaluation(original, sample.point, sample.rationals, k), k)
            elif listed:
                raise fail(f"sections[{listed[0]}]", f"factor {i} vanishes identically over the sample")
            else:
                return Branch(i, f, [0] * len(at), True, None)
        elif not lead and not self.closure.evaluates:
            self._check_nowhere_nullified(i, sample, fail)
        discriminant = None
        if i in self.closure.discriminants[k] and not nullified:
            discriminant = sign(self.closure.discriminants[k][i], sample.signs)
            if not discriminant and f.degree != self.lists.lists[k][i].degree(k):
                discriminant = None  # it is zero because the degree drops, which says nothing about multiple roots
        signs, simple = roots_and_signs(f, at, listed, discriminant, lambda e, r: fail(e, f"factor {i}: {r}"))
        return Branch(i, f, signs, nullified, simple)

    def _allow_nullified(self, i: int, sample: Sample, fail: Fail) -> None:
        if self.closure.evaluates:
            return
        if sample.dimensions[-1] == 0 and sample.depth == len(self.lists.lists) - 1:
            return  # the cell is one point and the factor is zero on the whole line over it
        raise fail("used", f"factor {i} vanishes identically over the sample: not well-oriented (Brown 2001)")

    def _check_nowhere_nullified(self, i: int, sample: Sample, fail: Fail) -> None:
        """Brown-McCallum: no point of the cell nullifies the factor. A nonzero leading coefficient, which is
        sign-invariant on the cell, proves it; so does any element of the ideal of the coefficients that is
        sign-invariant on the cell and nonzero at the sample.
        """
        k = sample.depth
        if sample.dimensions[-1] == 0 or k == 1:
            # At one point the sample decides. On level 1 the leading coefficient is nonzero on any interval.
            return
        if (k, i) not in self._witnesses:
            self._witnesses[k, i] = nullification_witnesses(self.lists.lists[k][i], k)
        for witness in self._witnesses[k, i]:
            if witness.is_constant:
                if witness:
                    return
                continue
            product = self.lists.decompose(witness)
            if product is not None:
                if sign(product, sample.signs):
                    return
            elif sample.dimensions[witness.level + 1] == 0 and self._sign_at(witness, sample):
                return
        raise fail("used", f"factor {i} may vanish identically at a point of the cell (Brown 2001, theorem 3.1)")

    @staticmethod
    def _sign_at(p: Poly, sample: Sample) -> int:
        for level, value in sample.rationals.items():
            p = p.at_rational(level, value)
        return sample.point.sign(p)

    # --- coincident roots ------------------------------------------------------------------
    def _share(self, a: Branch, b: Branch, sample: Sample, ends: Values) -> bool:
        """Whether the only roots of a and b between two neighbouring sector samples are equal."""
        f, g = a.fibre, b.fibre
        if isinstance(f, RationalFibre) != isinstance(g, RationalFibre):
            f, g = lift_up(f, sample.point), lift_up(g, sample.point)
        if not isinstance(f, RationalFibre) and self._resultant_zero(a, b, sample):
            if min(f.degree, g.degree) == 1:
                return True  # a common root exists, and the polynomial of degree 1 has only this one
            if f.shares_root(g, ends[0][0], ends[1][0]):
                return True
        return have_common_root(f, g, sample.point, ends)

    def _resultant_zero(self, a: Branch, b: Branch, sample: Sample) -> bool:
        """Whether the resultant is zero on the cell for a reason other than two vanishing leading coefficients."""
        k = sample.depth
        i, j = sorted((a.index, b.index))
        if (i, j) not in self.closure.resultants[k] or a.nullified or b.nullified:
            return False
        leading = self.closure.leading[k]
        if not any(sign(leading[n], sample.signs) for n in (i, j) if n in leading):
            return False
        return sign(self.closure.resultants[k][i, j], sample.signs) == 0

    # --- coordinates -----------------------------------------------------------------------
    def section_coordinate(self, checked: Checked, stack: Stack, j: int, fail: Fail) -> Fraction | Coordinate:
        """The number that section j of a checked stack stands for."""
        low, high = stack.sectors[j], stack.sectors[j + 1]
        for branch in sorted((checked.branches[i] for i in stack.sections[j]), key=lambda b: b.fibre.degree):
            if branch.simple is None:
                branch.simple = branch.fibre.squarefree()  # not needed for counting, so not computed before
            found = branch.simple.coordinate(low, high)
            if found is not None:
                return found
        raise fail(f"sections[{j}]", "its root could not be represented")


def have_common_root(f: Fibre, g: Fibre, point: Point, ends: Values) -> bool:
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


def _check_shape(stack: Stack, factors: int, last: bool, fail: Fail) -> None:
    used = stack.used
    if any(a >= b for a, b in pairwise(used)) or (used and not 0 <= used[0] <= used[-1] < factors):
        raise fail("used", "not an ascending list of factors of this level")
    if not last and len(used) != factors:
        raise fail("used", "a factor of this level is missing")
    if not stack.sectors:
        raise fail("sectors", "no sector")
    for j, (a, b) in enumerate(pairwise(stack.sectors)):
        if a >= b:
            raise fail(f"sectors[{j + 1}]", "the sector samples do not ascend")
    if len(stack.sections) != len(stack.sectors) - 1:
        raise fail("sections", f"{len(stack.sections)} sections between {len(stack.sectors)} sectors")
    if len(stack.cells) != 2 * len(stack.sections) + 1:
        raise fail("cells", f"{len(stack.cells)} cells where {2 * len(stack.sections) + 1} are needed")
    known = set(used)
    for j, section in enumerate(stack.sections):
        if not section or any(a >= b for a, b in pairwise(section)) or set(section) - known:
            raise fail(f"sections[{j}]", "not a nonempty ascending list of used factors")


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


def _sign_rows(stack: Stack, branches: dict[int, Branch], factors: int) -> list[list[int | None]]:
    columns: list[list[int | None]] = [[None] * len(stack.cells) for _ in range(factors)]
    for i, branch in branches.items():
        signs = [0] * len(branch.signs) if branch.nullified else branch.signs
        columns[i][::2], columns[i][1::2] = signs, signs[1:]
    for j, section in enumerate(stack.sections):
        for i in section:
            columns[i][2 * j + 1] = 0
    return [list(row) for row in zip(*columns, strict=True)] if columns else [[] for _ in stack.cells]

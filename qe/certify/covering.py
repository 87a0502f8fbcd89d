"""Rule "covering": no values of the block's variables satisfy the body, by a cylindrical algebraic covering.

Evidence: ``order`` of the variables; ``factors`` by level; ``line``, the covering of the first axis. A line has
``used`` (indices of factors of its level), ``sectors`` (ascending rationals), ``sections`` (between two sectors the
factors with a root there, one root in common, or none), and ``intervals``: ``first`` and ``last`` position covered
(sector k is 2*k, what lies between it and the next is 2*k + 1), ``at`` (the position of the sample), ``own`` (the
factors of the level on which it depends, or more), ``lower`` and ``upper`` (one of these with a root at the end, null
where there is none), and either ``false`` (atoms false at the sample that make the body false) or the ``line`` over the
sample.

THEOREM. Let an interval depend on the factors of its false atoms, or on those on which the line over its sample does;
let the factors of its own level (squarefree and coprime, as their discriminants and resultants are not zero) vanish
nowhere on it, or, if it is a point, some of them there; let its finite ends be roots of some of them.
A line whose intervals cover it, each beginning where the one before reaches, depends on the factors of lower level of
its intervals, of leading coefficients, discriminants and pairwise resultants of the factors of each interval, and of
resultants of an upper bound with the next lower bound. If none of its factors is zero on a line over the neighbourhood,
the body is false over every connected neighbourhood of the sample on which the factors it depends on are
order-invariant: the factors are delineable there (McCallum 1998; Brown 2001, theorem 3.1), so the bounds keep their
order. Over the first axis there is nothing to depend on. Ábrahám, Davenport, England, Kremer 2021, section 4.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from qe.certify.arithmetic.fibre import Fibre, Simple, fibre, values
from qe.certify.arithmetic.products import FactorLists, Product, check_lists
from qe.certify.arithmetic.triangular import Coordinate, Point
from qe.certify.block import existential
from qe.certify.closure import checked_discriminant, checked_resultant
from qe.certify.limits import check_value
from qe.certify.stacks import Fail, have_common_root, roots_and_signs
from qe.certify.step import Claim, Context, Limits, only
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.formula.syntax import FALSE, And, Atom, Constant, Exists, Formula, Or
from qe.proof.entry import Entry, formula_from_json

Factor = tuple[int, int]
"""Level and index."""


def check_covering(claim: Claim, context: Context, limits: Limits) -> None:
    """The block is closed, and false by the covering."""
    before, after = existential(claim)
    order, factors, line = only(claim, "order", "factors", "line")
    names = order.names()
    if not isinstance(before, Exists) or not before.body.is_quantifier_free or after != FALSE:
        raise claim.fail("an existential block without solutions, or its negation, expected")
    if not set(before.body.free) <= set(names) or before.free:
        raise order.fail("the variables of the block expected, each once")
    if not set(before.body.free) <= set(before.variables):
        raise claim.fail("a closed block expected")
    ring = Ring.of(names)
    lists = [[f.polynomial(claim.ring).convert(ring).normal()[1] for f in level.items()] for level in factors.items()]
    check_lists(ring, lists)
    walk = _Walk(claim.ring, FactorLists(ring, lists), convert(before.body, ring), limits)
    walk.line(line, _Sample(Point(budget=limits.budget), {}))


@dataclass(frozen=True, slots=True)
class _Sample:
    """A point: its algebraic coordinates, and the rational ones by level."""

    point: Point
    rationals: dict[int, Fraction]

    def reduced(self, f: Poly) -> Poly:
        """The polynomial with the rational coordinates put in."""
        for level, number in self.rationals.items():
            if f.degree(level):
                check_value(f, level, number)
                f = f.at_rational(level, number)
        return f

    def sign(self, f: Poly) -> int:
        """The sign of a polynomial at the point."""
        return self.point.sign(self.reduced(f))

    def extended(self, level: int, number: Fraction | Coordinate) -> _Sample:
        """The point one coordinate longer."""
        if isinstance(number, Coordinate):
            return _Sample(self.point.extended(number), self.rationals)
        return _Sample(self.point, {**self.rationals, level: number})


@dataclass(slots=True)
class _Row:
    """A factor over a sample: its sign in every sector; ``simple`` has the same roots, all simple, where known."""

    fibre: Fibre
    signs: list[int]
    simple: Simple | None


@dataclass(slots=True)
class _Line:
    """The roots of the factors of a line, found correct."""

    sample: _Sample
    sectors: tuple[Fraction, ...]
    sections: list[list[int]]
    rows: dict[int, _Row]

    def sign(self, index: int, position: int) -> int:
        """The sign of a factor at a position."""
        half = position // 2
        return 0 if position % 2 and index in self.sections[half] else self.rows[index].signs[half]

    def roots(self, own: set[int], first: int, last: int) -> list[int]:
        """The positions from ``first`` to ``last`` where one of the factors vanishes."""
        return [p for p in range(first | 1, last + 1, 2) if own & {*self.sections[p // 2]}]

    def number(self, position: int, entry: Entry) -> Fraction | Coordinate:
        """The value of the variable at a position: at a sector's sample, or at the root between two."""
        half = position // 2
        if position % 2 == 0:
            return self.sectors[half]
        for row in sorted((self.rows[i] for i in self.sections[half]), key=lambda row: row.fibre.degree):
            row.simple = row.simple or row.fibre.squarefree()
            found = row.simple.coordinate(self.sectors[half], self.sectors[half + 1])
            if found is not None:
                return found
        raise entry.fail("there is no root at the place of the sample")


@dataclass(slots=True)
class _Walk:
    """The recursion over the lines. ``projected``: discriminants and resultants found so far."""

    given: Ring
    lists: FactorLists
    body: Formula
    limits: Limits
    projected: dict[tuple[int, int, int], Poly] = field(default_factory=dict)

    def line(self, entry: Entry, sample: _Sample) -> set[Factor]:
        """The factors on which the covering of a line depends; it is correct, or ``CertificateRejected``."""
        self.limits.tick()
        level = len(sample.rationals) + len(sample.point.indices)
        if level >= len(self.lists.lists):
            raise entry.fail("a line above the last variable")
        used, sectors, sections, intervals = entry.fields("used", "sectors", "sections", "intervals")
        line = self._roots(sample, level, used, sectors, sections)
        end, reached = 2 * len(line.sectors) - 2, -1
        depends, parts = set[Factor](), list[_Part]()
        for part in intervals.items():
            found = self._interval(part, line, level)
            if found.first > reached + 1 or (found.first == 0) != (not parts):
                raise part.fail("there is a gap before it")
            if parts and parts[-1].last == end:
                raise part.fail("it is superfluous")
            reached = found.last
            parts.append(found)
            depends |= found.below
        if reached != end:
            raise intervals.fail("the line is not covered to its end")
        if level == 0:
            return set()
        for piece in parts:
            depends |= self._projection(sorted(piece.own), line, level, entry)
        for left, right in pairwise(parts):
            depends |= self._neighbours(left, right, level, entry)
        return depends

    def _roots(self, sample: _Sample, level: int, used: Entry, sectors: Entry, sections: Entry) -> _Line:
        """The sections are all the real roots of the factors used, each listed where it is."""
        known = [i.integer() for i in used.items()]
        numbers = tuple(q.rational() for q in sectors.items())
        listed = [[i.integer() for i in section.items()] for section in sections.items()]
        if len(set(known)) < len(known) or any(i >= len(self.lists.lists[level]) for i in known):
            raise used.fail("factors of this level expected, each once")
        if not numbers or any(a >= b for a, b in pairwise(numbers)):
            raise sectors.fail("ascending numbers expected")
        if len(listed) != len(numbers) - 1 or any(len(set(s)) < len(s) or not {*s} <= {*known} for s in listed):
            raise sections.fail("factors used, each once, expected between every two sectors")
        at, rows = values(numbers), dict[int, _Row]()
        for i in known:
            f = fibre(sample.point, sample.reduced(self.lists.lists[level][i]), level)
            if f.degree < 0:
                raise used.fail(f"factor {i} is zero on the whole line")
            places = [j for j, section in enumerate(listed) if i in section]
            wrong: Fail = lambda _, why, i=i: sections.fail(f"factor {i}: {why}")  # type: ignore[misc]  # noqa: E731
            rows[i] = _Row(f, *roots_and_signs(f, at, places, None, wrong))
        for j, section in enumerate(listed):
            for other in section[1:]:
                f, g = rows[section[0]].fibre, rows[other].fibre
                if not have_common_root(f, g, sample.point, at[j : j + 2]):
                    raise sections.fail(f"factors {section[0]} and {other} have no common root")
        return _Line(sample, numbers, listed, rows)

    # --- intervals ------------------------------------------------------------------------------------
    def _interval(self, entry: Entry, line: _Line, level: int) -> _Part:
        names = ("first", "last", "at", "own", "lower", "upper")
        first, last, at, listed, lower, upper, *either = entry.fields(*names, optional=("false", "line"))
        low, high, place = first.integer(), last.integer(), at.integer()
        reasons = [reason for reason in either if reason.value is not None]
        if len(reasons) != 1:
            raise entry.fail("one reason expected")
        if not low <= place <= high <= 2 * len(line.sectors) - 2:
            raise entry.fail("its places do not ascend within the line")
        if reasons[0].path.endswith(".line"):
            depends = self.line(reasons[0], line.sample.extended(level, line.number(place, at)))
        else:
            depends = self._refuted(reasons[0], line, level, place)
        own = {i.integer() for i in listed.items()}
        if not {index for at_level, index in depends if at_level == level} <= own <= set(line.rows):
            raise listed.fail("the factors of this level on which it depends expected, all of them used by the line")
        roots = line.roots(own, low, high)
        if roots and not low == high == roots[0]:
            raise entry.fail("it contains a root of one of its factors")
        if not roots and (low % 2 or high % 2):
            raise entry.fail("an interval that is no root begins and ends with a sector")
        begin = None if low == 0 else low // 2 if roots else low // 2 - 1
        end = None if high == 2 * len(line.sections) else high // 2
        bounds = _bound(lower, own, line, begin), _bound(upper, own, line, end)
        return _Part(low, high, own, {f for f in depends if f[0] < level}, *bounds)

    def _refuted(self, entry: Entry, line: _Line, level: int, place: int) -> set[Factor]:
        """The factors of the atoms, which are false at the sample and make the body false."""
        atoms, depends = set[Formula](), set[Factor]()
        for part in entry.items():
            found = convert(formula_from_json(part, self.given), self.lists.ring)
            if not isinstance(found, Atom) or found.poly.level > level:
                raise part.fail("an atom in the variables up to this one expected")
            product = self._covered(found.poly, part)
            if found.relation.holds(self._sign(product, line, level, place, part)):
                raise part.fail("it is true at the sample")
            atoms.add(found)
            depends |= _factors(product)
        if not _is_false(self.body, atoms):
            raise entry.fail("these atoms do not make the formula false")
        return depends

    def _sign(self, product: Product, line: _Line, level: int, place: int, entry: Entry) -> int:
        sign = product.unit
        for at, index, exponent in product.powers:
            if at == level and index not in line.rows:
                raise entry.fail(f"it has the factor {index} of this level, which its line does not use")
            own = line.sign(index, place) if at == level else line.sample.sign(self.lists.lists[at][index])
            sign *= own if exponent % 2 else own * own
        return sign

    # --- projection -------------------------------------------------------------------------------------
    def _projection(self, own: Sequence[int], line: _Line, level: int, entry: Entry) -> set[Factor]:
        """The factors of leading coefficients, discriminants and resultants, and what keeps a factor from being zero
        on a whole line of the neighbourhood."""
        depends = set[Factor]()
        for place, i in enumerate(own):
            f = self.lists.lists[level][i]
            depends |= _factors(self._covered(f.leading(level), entry))
            depends |= self._not_nullified(f, line.sample, level, entry)
            if f.degree(level) > 1:
                depends |= _factors(self._covered(self._discriminant(level, i), entry))
            for j in own[:place]:
                depends |= _factors(self._covered(self._resultant(level, j, i), entry))
        return depends

    def _not_nullified(self, f: Poly, sample: _Sample, level: int, entry: Entry) -> set[Factor]:
        """Factors whose signs keep a coefficient from vanishing near the sample; f is not zero on the line over it.

        On level 1 the line depends on the leading coefficient, so that it is not zero near the sample, or the
        neighbourhood is the sample alone.
        """
        coefficients = f.coefficients(level)
        if level == 1 or sample.sign(coefficients[-1]) or any(c.is_constant and c for c in coefficients):
            return set()
        for c in coefficients:
            product = self.lists.decompose(c) if c else None
            if product is not None and sample.sign(c):
                return _factors(product)
        raise entry.fail("a factor may be zero on a whole line (Brown 2001, theorem 3.1)")

    def _neighbours(self, left: _Part, right: _Part, level: int, entry: Entry) -> set[Factor]:
        """The factors of the resultant of an upper bound and the next lower bound."""
        if left.upper is None or right.lower is None:
            raise entry.fail("an interval in the middle is unbounded")
        if left.upper == right.lower:
            return set()
        i, j = sorted((left.upper, right.lower))
        return _factors(self._covered(self._resultant(level, i, j), entry))

    def _covered(self, p: Poly, entry: Entry) -> Product:
        product = self.lists.decompose(p)
        if product is None or not product.unit:
            raise entry.fail("it depends on a polynomial that is zero, or no product of listed factors")
        return product

    def _discriminant(self, level: int, i: int) -> Poly:
        return self._once((level, i, i), lambda f, _: checked_discriminant(self.lists, f, level, i))

    def _resultant(self, level: int, i: int, j: int) -> Poly:
        return self._once((level, i, j), lambda f, g: checked_resultant(self.lists, f, g, level, j))

    def _once(self, key: tuple[int, int, int], compute: Callable[[Poly, Poly], Poly]) -> Poly:
        level, i, j = key
        if key not in self.projected:
            self.limits.tick()
            self.projected[key] = compute(self.lists.lists[level][i], self.lists.lists[level][j])
        return self.projected[key]


@dataclass(frozen=True, slots=True)
class _Part:
    """An interval found correct: its positions, the factors on which it depends, of its level and ``below``, and one of
    its level at either end."""

    first: int
    last: int
    own: set[int]
    below: set[Factor]
    lower: int | None
    upper: int | None


def _bound(entry: Entry, own: set[int], line: _Line, section: int | None) -> int | None:
    """The factor whose root, in a section, is an end of an interval; None where it is unbounded."""
    if section is None and entry.value is None:
        return None
    index = entry.integer()
    if section is None or index not in own or index not in line.sections[section]:
        raise entry.fail("a factor of the interval with a root at its end expected")
    return index


def _factors(product: Product) -> set[Factor]:
    return {(level, index) for level, index, _ in product.powers}


def _is_false(formula: Formula, false: set[Formula]) -> bool:
    """Whether a formula without negations is false where these atoms are."""
    match formula:
        case Constant(value):
            return not value
        case And(args):
            return any(_is_false(a, false) for a in args)
        case Or(args):
            return all(_is_false(a, false) for a in args)
    return formula in false

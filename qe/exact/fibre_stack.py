"""All real roots of several polynomials over one sample point, in order and with exact coincidences.

This is the root finding of cylindrical algebraic decomposition: over the point, each polynomial of the next
level becomes univariate; equal roots of different polynomials are recognised exactly (by a common irreducible
factor over Q, or by a greatest common divisor over the tower), never by tolerance.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from fractions import Fraction
from operator import attrgetter
from types import MappingProxyType
from typing import TypeAlias, overload

from flint import arb, fmpq, fmpz_poly

from qe.errors import InternalError
from qe.exact.algebraic import RealAlgebraic, irreducible_factors, irreducible_roots
from qe.exact.balls import EXACT_FROM, FIRST_PRECISION, lower_end, precision, upper_end
from qe.exact.coincidence import Shape, Side, seen_to_be_equal
from qe.exact.isolate import simplest_between
from qe.exact.lazard import lazard_evaluation
from qe.exact.ring import Poly
from qe.exact.sample import Fibre, FibreRoot, Point, common_fibre
from qe.exact.univariate import from_univariate

_CHARACTER = {1: "+", -1: "-", 0: "0"}
_FLIPPED = {"+": "-", "-": "+", "0": "0"}


Root: TypeAlias = tuple[fmpq | RealAlgebraic | FibreRoot, fmpq, fmpq, bool]
"""A value between two rational numbers, and whether its multiplicity is known to be even."""


@dataclass(slots=True)
class Section:
    """A root: its value and the indices of the polynomials that vanish there. ``low`` and ``high``: rational ends of an
    enclosure to ``bits``."""

    value: fmpq | RealAlgebraic | FibreRoot
    members: list[int]
    low: fmpq
    high: fmpq
    bits: int = FIRST_PRECISION
    even: tuple[int, ...] = ()
    """The polynomials of which it is a root of even multiplicity, where that is known (``Over.simple``)."""
    is_shared: bool = False
    """Whether stacks over other points have the value, too: their refinements of it must not depend on each other."""

    def unshared(self) -> fmpq | RealAlgebraic | FibreRoot:
        """The value, with enclosures that only this stack and what stands over it refine."""
        if self.is_shared and isinstance(self.value, RealAlgebraic):
            self.value, self.is_shared = copy(self.value), False
        return self.value

    def ball(self, bits: int | None = None) -> arb:
        """An enclosure of the value, to ``bits`` or to as many as it was isolated with."""
        value = self.unshared()
        return arb(value) if isinstance(value, fmpq) else value.ball(bits or self.bits)

    def refine(self, bits: int) -> None:
        """Enclose the value to so many bits."""
        value, self.bits = self.unshared(), bits
        if not isinstance(value, fmpq):
            x = value.ball(bits)
            self.low, self.high = lower_end(x), upper_end(x)


@dataclass(frozen=True, slots=True)
class Over:
    """A polynomial over a point: its shape there, and its roots, ``is_shared`` with other points.

    ``simple``: the sign below all roots where the multiplicities of the roots are known to be odd but for those of
    ``Section.even``, else None: then the sign is asked for in every sector.
    """

    shape: Shape
    roots: tuple[Root, ...]
    simple: int | None
    is_shared: bool = False

    def sections(self, j: int) -> list[Section]:
        """The roots as sections that are those of polynomial ``j`` alone."""
        first, shared = FIRST_PRECISION, self.is_shared
        return [
            Section(value, [j], low, high, first, (j,) if even else (), shared) for value, low, high, even in self.roots
        ]


class Samples(Sequence[Fraction]):
    """A rational number in every sector between and around sections with these ends, made when somebody looks: of most
    stacks of a last level nobody does."""

    __slots__ = ("_ends", "_values")

    def __init__(self, ends: list[tuple[fmpq, fmpq]]) -> None:
        self._ends = ends
        self._values: tuple[Fraction, ...] | None = None if ends else (Fraction(0),)

    @property
    def values(self) -> tuple[Fraction, ...]:
        """The numbers, ascending."""
        if self._values is None:
            first, last = self._ends[0][0], self._ends[-1][1]
            between = (simplest_between(a[1], b[0]) for a, b in itertools.pairwise(self._ends))
            below, above = Fraction(0), Fraction(0)
            if first <= 0:
                below = Fraction(int(first.ceil()) - 1)
            if last >= 0:
                above = Fraction(int(last.floor()) + 1)
            self._values = (below, *(Fraction(int(q.p), int(q.q)) for q in between), above)
        return self._values

    def __len__(self) -> int:
        return len(self._ends) + 1

    @overload
    def __getitem__(self, k: int) -> Fraction: ...

    @overload
    def __getitem__(self, k: slice) -> tuple[Fraction, ...]: ...

    def __getitem__(self, k: int | slice) -> Fraction | tuple[Fraction, ...]:
        return self.values[k]

    def __eq__(self, other: object) -> bool:
        return self.values == (other.values if isinstance(other, Samples) else other)

    def __hash__(self) -> int:
        return hash(self.values)

    def __reduce__(self) -> tuple[type[tuple[Fraction, ...]], tuple[tuple[Fraction, ...]]]:
        return tuple, (self.values,)


class Isolation:
    """A stack over a point: m sections, and m+1 rational sector samples between and around them.

    Its cells have positions from below: sector k is 2*k, section k is 2*k+1. ``samples``: those of the sectors.
    ``texts``: the signs of the polynomials on every cell of the stack from below, one character of ``+-0`` each;
    ``nullified``: the polynomials that are zero on the whole line (sign 0 throughout).
    """

    __slots__ = ("nullified", "point", "polys", "samples", "sections", "shapes", "texts")

    def __init__(self, point: Point, polys: tuple[Poly, ...], over: Sequence[Over], sections: list[Section]) -> None:
        self.point, self.polys, self.sections = point, polys, tuple(sections)
        self.nullified = tuple(j for j, each in enumerate(over) if each.shape is None)
        self.shapes: Mapping[Poly, Over] = dict(zip(polys, over, strict=True))  # over the point
        self.samples = Samples([(section.low, section.high) for section in sections])
        self.texts = self._texts(over)

    def sample(self, position: int) -> Point:
        """The sample point of a cell."""
        half = position // 2
        if not position % 2:
            value = self.samples[half]
            return self.point.extend(fmpq(value.numerator, value.denominator))
        section = self.sections[half]
        return self.point.extend(section.unshared(), tuple(self.polys[j] for j in section.members))

    def place_of(self, q: Fraction) -> tuple[int, bool]:
        """How many sections lie below a rational number, and whether the next one is that number."""
        number, below = fmpq(q.numerator, q.denominator), 0
        for section in self.sections:
            side = _compared(section.value, number)
            if side >= 0:
                return below, side == 0
            below += 1
        return below, False

    def sign_maps(self) -> list[dict[Poly, int]]:
        """The signs of the polynomials on every cell, from below."""
        return [self._signs(text) for text in self.texts]

    def signs_at(self, position: int) -> dict[Poly, int]:
        """The signs of the polynomials on one cell."""
        return self._signs(self.texts[position])

    def _signs(self, text: str) -> dict[Poly, int]:
        return dict(zip(self.polys, map({"+": 1, "-": -1, "0": 0}.__getitem__, text), strict=True))

    def _texts(self, over: Sequence[Over]) -> list[str]:
        """A polynomial changes its sign at roots of odd multiplicity, and only there; see ``Over.simple``."""

        def in_sector(j: int, sector: int) -> str:
            shape = over[j].shape
            if not isinstance(shape, Fibre):
                return "0"
            sample = self.samples[sector]
            return _CHARACTER[shape.value_sign(fmpq(sample.numerator, sample.denominator))]

        current = [in_sector(j, 0) if o.simple is None else _CHARACTER[o.simple] for j, o in enumerate(over)]
        texts = ["".join(current)]
        for sector, section in enumerate(self.sections, start=1):
            above = []
            for j in section.members:  # only their signs change
                if over[j].simple is None:
                    above.append(in_sector(j, sector))
                else:
                    above.append(current[j] if j in section.even else _FLIPPED[current[j]])
                current[j] = "0"
            texts.append("".join(current))
            for j, character in zip(section.members, above, strict=True):
                current[j] = character
            texts.append("".join(current))
        return texts


def isolate_over(
    point: Point, polys: tuple[Poly, ...], *, lazard: bool = False, known: Mapping[Poly, Over] = MappingProxyType({})
) -> Isolation:
    """The stack of ``polys`` (in variables up to ``point.depth``) over the point.

    With ``lazard`` a polynomial that vanishes identically over the point contributes the roots of its Lazard
    evaluation (McCallum, Parusiński, Păunescu 2019); its sign is 0 all the same. ``known``: the ``shapes`` of another
    stack over the point, whose roots are not looked for again.
    """
    over = [known.get(f) or _over(point, f) for f in polys]
    sections: list[Section] = []
    for j, each in enumerate(over):
        source = _over(point, lazard_evaluation(point, polys[j])) if each.shape is None and lazard else each
        sections += source.sections(j)
    return Isolation(point, polys, over, _separate(point, sections, polys, over))


def _over(point: Point, f: Poly) -> Over:
    """f over the point. Where it is one variable with rational coordinates the result is kept at the lowest point on
    which it depends: it stands over all others above that."""
    var, place = point.depth, point.supporting(f)
    key = (f, var)
    kept: Over | None = None if place is point else place.memory.get(key)
    if kept is None:
        univariate = place.univariate(f, var)
        if univariate is None:
            return _of_fibre(point, f, var)
        kept = _of_integers(univariate, is_shared=place is not point)
        if place is not point:
            place.memory[key] = kept
    return kept


_NULLIFIED = Over(None, (), None)


def _of_integers(shape: fmpz_poly, *, is_shared: bool) -> Over:
    if not shape:
        return _NULLIFIED
    roots: list[Root] = []
    odd = 0
    for q, multiplicity in irreducible_factors(shape):
        even, before = multiplicity % 2 == 0, len(roots)
        if q.degree() == 1:
            value = fmpq(-q[0], q[1])
            roots.append((value, value, value, even))
        else:
            roots += [(root, *_ends(root), even) for root in irreducible_roots(q)]
        odd += 0 if even else len(roots) - before
    return Over(shape, tuple(roots), 1 if (shape.leading_coefficient() > 0) == (odd % 2 == 0) else -1, is_shared)


def _ends(value: RealAlgebraic | FibreRoot) -> tuple[fmpq, fmpq]:
    x = value.ball()
    return lower_end(x), upper_end(x)


def _of_fibre(point: Point, f: Poly, var: int) -> Over:
    reduced = point.reduce(f)
    if not reduced:
        return _NULLIFIED
    fibre = Fibre(point, var, reduced.coefficients(var), f)
    certain = fibre.coefficients[-1].is_constant
    if not certain:
        with precision(EXACT_FROM + 16):
            certain = any(not point.enclose(c, EXACT_FROM).contains(0) for c in fibre.coefficients)
    if not certain and not fibre.strip():
        return _NULLIFIED
    values = [FibreRoot(fibre, i) for i in range(len(fibre.roots()))]
    roots = [(value, *_ends(value), False) for value in values]
    top = fibre.top_of_simple
    return Over(fibre, tuple(roots), None if top is None else top * (-1) ** len(roots))


def _separate(point: Point, sections: list[Section], polys: Sequence[Poly], over: Sequence[Over]) -> list[Section]:
    """Sort, refining until neighbours are certainly apart, or merging where they are provably equal."""
    apart: set[tuple[int, int]] = set()  # pairs proved different: only refine
    while True:
        sections.sort(key=attrgetter("low"))
        clash = next(((a, b) for a, b in itertools.pairwise(sections) if not a.high < b.low), None)
        if clash is None:
            return sections
        a, b = clash
        key = (id(a), id(b)) if id(a) < id(b) else (id(b), id(a))
        if key not in apart:
            in_fibre = isinstance(a.value, FibreRoot) or isinstance(b.value, FibreRoot)
            equal = None if in_fibre else type(a.value) is type(b.value) and bool(a.value == b.value)
            if equal is None and min(a.bits, b.bits) >= EXACT_FROM:
                i, j = a.members[0], b.members[0]
                left, right = Side(a.ball, polys[i], over[i].shape), Side(b.ball, polys[j], over[j].shape)
                equal = seen_to_be_equal(point, left, right)
                equal = _equal(point, a, b) if equal is None else equal
            if equal:
                kept, lost = (a, b) if _weight(a) <= _weight(b) else (b, a)
                sections.remove(lost)
                kept.members, kept.even = sorted({*a.members, *b.members}), (*a.even, *b.even)
                continue
            if equal is not None:
                apart.add(key)
        bits = 2 * max(a.bits, b.bits)
        with precision(bits + 16):
            a.refine(bits)
            b.refine(bits)


def _weight(s: Section) -> int:
    """Cost of computing with the section's value: the degree of its defining polynomial, rational ones first."""
    if isinstance(s.value, fmpq):
        return 0
    if isinstance(s.value, RealAlgebraic):
        return s.value.degree
    return 1000 * (len(s.value.fibre.coefficients) - 1)


def _equal(point: Point, a: Section, b: Section) -> bool:
    """Whether two sections over the point are the same number."""
    left, right = _as_fibre_root(point, a.value), _as_fibre_root(point, b.value)
    if left.fibre is right.fibre:
        return left.index == right.index
    bits = EXACT_FROM
    if _meet_once(left.fibre, right.fibre):
        while True:
            one, other = (list(enumerate(side.fibre.roots(bits))) for side in (left, right))
            pairs = [(i, j) for i, x in one for j, y in other if x.overlaps(y)]
            if len(pairs) == 1:
                return pairs[0] == (left.index, right.index)
            bits *= 2
    common = common_fibre(left.fibre, right.fibre)
    if common is None:
        return False
    while True:
        matches = _matches(common.roots(bits), left.fibre.roots(bits), right.fibre.roots(bits))
        if matches is not None:
            return (left.index, right.index) in matches
        bits *= 2


def _meet_once(f: Fibre, g: Fibre) -> bool:
    """Whether two fibres over a point with one algebraic coordinate are seen to have exactly one common root.

    THEOREM. Let F, G be polynomials in x and y whose leading coefficients in y do not vanish at x = a, and let the real
    number a be a simple root of res_y(F, G). Then F(a, y) and G(a, y) have exactly one common root, and it is real.
    PROOF. The Sylvester matrix over a loses as much rank as the degree of their greatest common divisor (Basu, Pollack,
    Roy 2006, section 4.2), and the order of its determinant at a is at least that; a common root that is not real
    comes with its conjugate.
    """
    point, var = f.point, f.var
    if len(point.algebraic) != 1:
        return False
    (i,) = point.algebraic
    value = point.coordinate(i)
    left, right = (Fibre(point, var, h.source).polynomial() for h in (f, g))
    if not isinstance(value, RealAlgebraic) or any(point.vanishes(h.leading(var)) for h in (left, right)):
        return False
    resultant = point.ring.remembered(("resultant", left, right), lambda: left.resultant(right, var))
    once, rest = divmod(resultant.to_univariate(i), value.poly) if resultant else (resultant, True)
    return not rest and bool(once % value.poly)


def _matches(common: list[arb], left: list[arb], right: list[arb]) -> set[tuple[int, int]] | None:
    """For each common root the pair of indices it equals, once every overlap is unique."""
    result: set[tuple[int, int]] = set()
    for x in common:
        i = [k for k, y in enumerate(left) if y.overlaps(x)]
        j = [k for k, y in enumerate(right) if y.overlaps(x)]
        if len(i) != 1 or len(j) != 1:
            return None
        result.add((i[0], j[0]))
    return result


def _as_fibre_root(point: Point, value: fmpq | RealAlgebraic | FibreRoot) -> FibreRoot:
    if isinstance(value, FibreRoot):
        return value
    number = RealAlgebraic.rational(value) if isinstance(value, fmpq) else value
    f = from_univariate(point.ring, point.depth, number.poly)
    fibre = Fibre(point, point.depth, f.coefficients(point.depth))
    fibre.exact = True
    return FibreRoot(fibre, number.index)


def root_between(point: Point, f: Poly, lo: Fraction, hi: Fraction) -> fmpq | RealAlgebraic | FibreRoot:
    """The only root of f (if nullified, of its Lazard evaluation) over the point strictly between two rationals."""
    stack = isolate_over(point, (f,), lazard=True)
    below, is_root = stack.place_of(lo)
    for section in stack.sections[below + is_root :]:
        if _compared(section.value, fmpq(hi.numerator, hi.denominator)) < 0:
            return section.value
        break
    raise InternalError("no root of the factor between the sector samples")


def _compared(value: fmpq | RealAlgebraic | FibreRoot, q: fmpq) -> int:
    """The sign of the value minus q, exactly."""
    if isinstance(value, fmpq):
        return int(value > q) - int(value < q)
    return value.compare_rational(q)

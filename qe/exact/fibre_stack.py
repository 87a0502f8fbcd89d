"""All real roots of several polynomials over one sample point, in order and with exact coincidences.

This is the root finding of cylindrical algebraic decomposition: over the point, each polynomial of the next
level becomes univariate; equal roots of different polynomials are recognised exactly (by a common irreducible
factor over Q, or by a greatest common divisor over the tower), never by tolerance.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from types import MappingProxyType

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

_CHARACTER = {1: ord("+"), -1: ord("-"), 0: ord("0")}


@dataclass(slots=True)
class Section:
    """A root: its value and the indices of the polynomials that vanish there."""

    value: fmpq | RealAlgebraic | FibreRoot
    members: list[int]
    bits: int = FIRST_PRECISION
    even: tuple[int, ...] = ()
    """The integer polynomials of which it is a root of even multiplicity."""

    def ball(self, bits: int | None = None) -> arb:
        """An enclosure of the value, to ``bits`` or to as many as it was isolated with."""
        value = self.value
        return arb(value) if isinstance(value, fmpq) else value.ball(bits or self.bits)


@dataclass(frozen=True, slots=True)
class Isolation:
    """A stack over a point: m sections, and m+1 rational sector samples between and around them.

    Its cells have positions from below: sector k is 2*k, section k is 2*k+1. ``signs[j][s]`` is the sign of polynomial
    j at sector sample s; ``nullified``: the polynomials that are zero on the whole line (sign 0 throughout).
    """

    point: Point
    polys: tuple[Poly, ...]
    sections: tuple[Section, ...]
    sectors: tuple[fmpq, ...]
    signs: tuple[tuple[int, ...], ...]
    nullified: tuple[int, ...] = field(default=())
    shapes: Mapping[Poly, Shape] = field(default_factory=dict, compare=False, repr=False)  # over the point

    @property
    def samples(self) -> tuple[Fraction, ...]:
        """The sector samples as fractions."""
        return tuple(Fraction(int(q.p), int(q.q)) for q in self.sectors)

    def sample(self, position: int) -> Point:
        """The sample point of a cell."""
        half = position // 2
        if not position % 2:
            return self.point.extend(self.sectors[half])
        section = self.sections[half]
        return self.point.extend(section.value, tuple(self.polys[j] for j in section.members))

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
        return [self._signs(text) for text in self.sign_texts()]

    def signs_at(self, position: int) -> dict[Poly, int]:
        """The signs of the polynomials on one cell."""
        return self._signs(self.sign_texts()[position])

    def _signs(self, text: str) -> dict[Poly, int]:
        return dict(zip(self.polys, map({"+": 1, "-": -1, "0": 0}.__getitem__, text), strict=True))

    def sign_texts(self) -> list[str]:
        """The signs of the polynomials on every cell of the stack from below, one character of ``+-0`` each."""
        current = bytearray(_CHARACTER[row[0]] for row in self.signs)
        texts = [current.decode()]
        for sector, section in enumerate(self.sections, start=1):
            for j in section.members:
                current[j] = _CHARACTER[0]
            texts.append(current.decode())
            for j in section.members:  # only their signs change
                current[j] = _CHARACTER[self.signs[j][sector]]
            texts.append(current.decode())
        return texts


def isolate_over(
    point: Point, polys: tuple[Poly, ...], *, lazard: bool = False, known: Mapping[Poly, Shape] = MappingProxyType({})
) -> Isolation:
    """The stack of ``polys`` (in variables up to ``point.depth``) over the point.

    With ``lazard`` a polynomial that vanishes identically over the point contributes the roots of its Lazard
    evaluation (McCallum, Parusiński, Păunescu 2019); its sign is 0 all the same. ``known``: the ``shapes`` of another
    stack over the point, whose roots are not looked for again.
    """
    var = point.depth
    shapes: list[Shape] = []
    nullified: list[int] = []
    sections: dict[tuple[object, int], Section] = {}
    loose: list[Section] = []
    for j, f in enumerate(polys):
        shape = known[f] if f in known else _specialise(point, f, var)
        shapes.append(shape)
        if shape is None:
            nullified.append(j)
            if lazard:
                residual = lazard_evaluation(point, f)
                _collect(point, var, j, _specialise(point, residual, var), sections, loose)
        else:
            _collect(point, var, j, shape, sections, loose)
    ordered = _separate(point, [*sections.values(), *loose], polys, shapes)
    sectors = _sector_samples(ordered)
    changes: list[list[int]] = [[0] for _ in polys]  # the sectors that begin at one of its roots, and the first
    for sector, section in enumerate(ordered, start=1):
        for j in section.members:
            changes[j].append(-sector if j in section.even else sector)
    signs = tuple(_signs(shape, sectors, own) for shape, own in zip(shapes, changes, strict=True))
    given = dict(zip(polys, shapes, strict=True))
    return Isolation(point, polys, tuple(ordered), tuple(sectors), signs, tuple(nullified), given)


def _specialise(point: Point, f: Poly, var: int) -> Shape:
    """f over the point: integer univariate, a fibre with algebraic coefficients, or None if nullified."""
    univariate = point.univariate(f, var)
    if univariate is not None:
        return univariate or None
    g = point.reduce(f)
    fibre = Fibre(point, var, g.coefficients(var), f)
    with precision(EXACT_FROM + 16):
        certain = any(not point.enclose(c, EXACT_FROM).contains(0) for c in fibre.coefficients)
    return fibre if certain or fibre.strip() else None


def _collect(
    point: Point,
    var: int,
    j: int,
    shape: Shape,
    sections: dict[tuple[object, int], Section],
    loose: list[Section],
) -> None:
    if shape is None:
        return
    if isinstance(shape, Fibre):
        loose += [Section(FibreRoot(shape, i), [j]) for i in range(len(shape.roots()))]
        return
    for q, multiplicity in irreducible_factors(shape):
        values = [fmpq(-q[0], q[1])] if q.degree() == 1 else irreducible_roots(q)
        for index, value in enumerate(values):
            section = sections.setdefault((tuple(q.coeffs()), index), Section(value, []))
            section.members.append(j)
            if multiplicity % 2 == 0:
                section.even = (*section.even, j)


def _separate(point: Point, sections: list[Section], polys: Sequence[Poly], shapes: Sequence[Shape]) -> list[Section]:
    """Sort, refining until neighbours are certainly apart, or merging where they are provably equal."""
    if len(sections) < 2:
        return sections
    apart: set[tuple[int, int]] = set()  # pairs proved different: only refine
    balls: dict[int, arb] = {}
    moved: Iterable[Section] = sections
    while True:
        with precision(max(s.bits for s in sections) + 16):
            balls |= {id(s): s.ball() for s in moved}
        sections.sort(key=lambda s: balls[id(s)].mid())
        clash = next(((a, b) for a, b in itertools.pairwise(sections) if not balls[id(a)] < balls[id(b)]), None)
        if clash is None:
            return sections
        a, b = moved = clash
        key = (id(a), id(b)) if id(a) < id(b) else (id(b), id(a))
        if min(a.bits, b.bits) >= EXACT_FROM and key not in apart:
            i, j = a.members[0], b.members[0]
            left, right = Side(a.ball, polys[i], shapes[i]), Side(b.ball, polys[j], shapes[j])
            equal = seen_to_be_equal(point, left, right)
            if equal or (equal is None and _equal(point, a, b)):
                kept, lost = (a, b) if _weight(a) <= _weight(b) else (b, a)
                sections.remove(lost)
                kept.members, kept.even = sorted({*a.members, *b.members}), (*a.even, *b.even)
                continue
            apart.add(key)
        a.bits = b.bits = 2 * max(a.bits, b.bits)


def _weight(s: Section) -> int:
    """Cost of computing with the section's value: the degree of its defining polynomial, rational ones first."""
    if isinstance(s.value, fmpq):
        return 0
    if isinstance(s.value, RealAlgebraic):
        return s.value.degree
    return 1000 * (len(s.value.fibre.coefficients) - 1)


def _equal(point: Point, a: Section, b: Section) -> bool:
    """Whether two sections over the point are the same number."""
    if not isinstance(a.value, FibreRoot) and not isinstance(b.value, FibreRoot):
        return False  # roots of different irreducible integer polynomials, or different roots of one
    left, right = _as_fibre_root(point, a.value), _as_fibre_root(point, b.value)
    if left.fibre is right.fibre:
        return left.index == right.index
    bits = EXACT_FROM
    if _meet_once(left.fibre, right.fibre):
        while True:
            pairs = _overlaps(left.fibre.roots(bits), right.fibre.roots(bits))
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
    key = ("resultant", left, right)
    resultant = point.ring.cache.get(key)
    if resultant is None:
        resultant = left.resultant(right, var)
        point.ring.remember(key, resultant)
    assert isinstance(resultant, Poly)
    once, rest = divmod(resultant.to_univariate(i), value.poly) if resultant else (resultant, True)
    return not rest and bool(once % value.poly)


def _overlaps(left: list[arb], right: list[arb]) -> list[tuple[int, int]]:
    return [(i, j) for i, x in enumerate(left) for j, y in enumerate(right) if x.overlaps(y)]


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


def _sector_samples(sections: list[Section]) -> list[fmpq]:
    if not sections:
        return [fmpq(0)]
    ends = [
        (s.value, s.value) if isinstance(s.value, fmpq) else (lower_end(x := s.ball()), upper_end(x)) for s in sections
    ]
    first, last = ends[0][0], ends[-1][1]
    samples = [fmpq(0) if first > 0 else fmpq(first.ceil() - 1)]
    samples += [simplest_between(a[1], b[0]) for a, b in itertools.pairwise(ends)]
    samples.append(fmpq(0) if last < 0 else fmpq(last.floor() + 1))
    return samples


def _signs(shape: Shape, sectors: list[fmpq], changes: list[int]) -> tuple[int, ...]:
    """The signs of a polynomial at the sector samples: an integer polynomial changes its sign at roots of odd
    multiplicity (``changes``: minus the sector above a root of even one); of others one evaluation between two roots.
    """
    if shape is None:
        return (0,) * len(sectors)
    signs: list[int] = []
    sign = 1
    if isinstance(shape, fmpz_poly):
        odd = sum(change > 0 for change in changes)
        sign = 1 if (shape.leading_coefficient() > 0) == (odd % 2 == 0) else -1
    for first, end in itertools.pairwise((*changes, len(sectors))):
        if isinstance(shape, fmpz_poly):
            sign = -sign if first > 0 else sign
        else:
            sign = shape.value_sign(sectors[first])
        signs += [sign] * (abs(end) - abs(first))
    return tuple(signs)


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

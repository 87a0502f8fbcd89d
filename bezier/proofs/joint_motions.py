"""Rule "joint motions": all continuous motions of an arm along curves, limits left aside.

The sentence (``sentence``): for all parameters between neighbouring places, the equations of the arm
(``bezier.proofs.arm_sentences``) have exactly so many solutions. First-order logic has no words for motions: how the
solutions go on from there, and the number of chains of them, is checked all the same, by what follows.

An arm whose first joint turns about z, while the other two keep the end point in a plane parallel to z: with a
horizontal unit normal h and e = h x z it is r e + d h + z e_z, d constant. Let W = x² + y² - d² for the point (x, y, z)
of the curve in the frame of the first joint. The point is reached by r with r² = W where Q(r, z) >= 0, in one position
of the two joints for each δ with δ² = Q, and this is continuous in (r, z, δ):

* both turn, links L1, L2 from the centre (a, c): D = (r - a)² + (z - c)², Q = 4 L1² L2² - (D - L1² - L2²)²: the law
  of cosines, δ = 2 L1 L2 sin(elbow); the second joint is free where D = 0, so only where L1 = L2;
* the second turns, the third slides on a line at the distance b: Q = D - b², D = 0 only where b = 0;
* the second slides, the third turns on a radius L: Q = L² - w², w the distance from the line that its centre runs on;
* both slide, orthogonally: one position (no Q).

The first joint is the angle from r e + d h to (x, y), unique where these are not 0. So with A + r B = Q, between
neighbouring zeros of W and of N = A² - W B² the solutions are as many arcs, labelled by the signs (σ, ε) of r and δ.
A motion goes on from an arc to another one iff they have the same limit between them: the same r (σ is the same, or
W = 0), the same δ (ε is the same, or Q = 0), and where (x, y) = 0 the same limit of σ times its direction.

``places``: for each curve intervals around all zeros of W and N; ``factor``: a polynomial in s with one simple zero in
the interval (null: N), powers of which W and N are, times what is not zero there. ``solutions``: the numbers of arcs
in the order of the path; ``through``: the numbers of pairs that go on, between each two of these; ``motions``: the
number of chains from start to goal.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from bezier.proofs import square_roots as sr
from bezier.proofs.arm_rows import ArmChain, read_chain, read_number, read_surd
from bezier.proofs.arm_sentences import ALONG, ArmEquations, between, ring_of, with_roots
from bezier.proofs.branch import read_curve
from bezier.proofs.course import coefficients, seen_from_base
from bezier.proofs.nested_roots import NO_ROOT, Nested, Root, nested
from bezier.proofs.square_roots import ONE, ZERO, Polynomial, Surd, Triple, constant_sign, cross, dot
from qe.errors import Unable
from qe.expert.sentences import Sentence, stated
from qe.formula.build import conj, disj, forall, implies
from qe.formula.syntax import TRUE, Formula
from qe.kernel.step import Limits
from qe.options import Budget
from qe.proof.entry import Entry

Label = tuple[int, int]
Split = tuple[Polynomial, Polynomial]
"""A + r B."""

SIGNS, FOUR, UNIT = (1, -1), Surd.rational(4), Polynomial((ONE,))


@dataclass(frozen=True, slots=True)
class Plane:
    """The last two joints. ``outwards``: e; ``size``: 4 L1² L2², b² or L²; ``rest``: L1² + L2²; ``line``: the direction
    (along e, up) of the second joint that slides. ``may_fold``: whether D may vanish where a point is reached."""

    turns: tuple[bool, ...]
    offset: Surd
    outwards: tuple[Surd, Surd]
    centre: tuple[Surd, Surd]
    size: Surd
    rest: Surd
    line: tuple[Surd, Surd]
    may_fold: bool

    @staticmethod
    def of(chain: ArmChain, entry: Entry) -> Plane:
        """Raises ``CertificateRejected`` for an arm of another shape."""
        if len(chain.turns) != 3 or not chain.turns[0]:
            raise entry.fail("expected three joints, the first of which turns")
        (first, o), (second, b), (_, tip) = chain.constants[1:]
        axis = _column(first)
        radius = dot(tip[:2], tip[:2])
        third = _column(second)
        still = (ZERO, ZERO, tip[2]) if chain.turns[2] else tip  # what the third joint does not turn
        reach = tuple(x + dot(row, still) for x, row in zip(b, second, strict=True))
        outer = tuple(dot(row, third) for row in first)
        size = rest = ZERO
        may_fold = False
        if chain.turns[1]:
            normal, centre = axis, tuple(o)
            is_plane = not (third[0] or third[1]) if chain.turns[2] else not third[2]
            base = tuple(x + n * reach[2] for x, n in zip(o, normal, strict=True))
            if chain.turns[2]:
                inside = dot(b[:2], b[:2])
                size, rest, may_fold = FOUR * inside * radius, inside + radius, not (inside - radius)
                is_plane = is_plane and bool(size)
            else:
                lever = reach[0] * third[1] - reach[1] * third[0]
                size, may_fold = lever * lever, not lever
        else:
            base = centre = tuple(x + dot(row, reach) for x, row in zip(o, first, strict=True))
            normal = outer if chain.turns[2] else cross(axis, outer)
            is_plane = not dot(normal, axis) and (bool(radius) or not chain.turns[2])
            size = radius
        if not is_plane or normal[2] or dot(normal, normal) != ONE:
            raise entry.fail("the second and the third joint are not proved to move in a plane along the first axis")
        along = (normal[1], -normal[0])
        return Plane(
            chain.turns,
            dot(normal, base),
            along,
            (dot(along, centre[:2]), centre[2]),
            size,
            rest,
            (dot(along, axis[:2]), axis[2]),
            may_fold,
        )


@dataclass(frozen=True, slots=True)
class Along:
    """Polynomials in s: x, y, W, D, Q (None where there is none) and N."""

    x: Polynomial
    y: Polynomial
    w: Polynomial
    distance: Split
    quality: Split | None
    norm: Polynomial | None
    plane: Plane

    @staticmethod
    def of(plane: Plane, target: list[Polynomial], entry: Entry) -> Along:
        """Along a curve in the frame of the first joint. Raises ``Unable`` where W or N vanishes everywhere."""
        x, y, z = target
        w = x * x + y * y + Polynomial.of([-(plane.offset * plane.offset)])
        key = frozenset({Root(nested(w))})

        def number(value: Surd) -> Nested:
            return nested(Polynomial.of([value]))

        def split(whole: Nested) -> Split:
            return whole.terms.get(NO_ROOT, Polynomial()), whole.terms.get(key, Polynomial())

        a, c = plane.centre
        across, height = Nested({key: UNIT}) - number(a), nested(z) - number(c)
        d = across * across + height * height
        quality: Nested | None = None
        if plane.turns[1:] == (True, True):
            rest = d - number(plane.rest)
            quality = number(plane.size) - rest * rest
        elif plane.turns[1]:
            quality = d - number(plane.size)
        elif plane.turns[2]:
            r, up = plane.line
            rest = height.by(r) - across.by(up)
            quality = number(plane.size) - rest * rest
        norm = None if quality is None else norm_of(split(quality), w)
        if not w or (norm is not None and not norm):
            raise Unable(f"{entry.path}: the whole curve is on the first axis or along a border")
        return Along(x, y, w, split(d), None if quality is None else split(quality), norm, plane)

    def labels(self, s: Fraction) -> list[Label]:
        """Of the solutions where neither W nor N vanishes."""
        if self.w.at(s).sign() < 0:
            return []
        if self.quality is None:
            return [(side, 1) for side in SIGNS]
        even, odd, norm = (p.at(s).sign() for p in (*self.quality, self.norm or Polynomial()))
        # |A| > |B √W| or less: the sign of A + σ √W B is that of the larger one
        return [(side, end) for side in SIGNS if (even if norm > 0 else side * odd) > 0 for end in SIGNS]

    def empty(self, sign: Callable[[Polynomial], int]) -> frozenset[int] | None:
        """The σ with Q = 0 where polynomials have these signs; None where the second joint is free."""
        if self.quality is None or self.norm is None or sign(self.norm):
            return frozenset()
        if self.plane.may_fold and not sign(norm_of(self.distance, self.w)):
            return None
        even, odd = map(sign, self.quality)
        return frozenset({-even * odd} if even else SIGNS)  # N = A² - W B², so that A = 0 where W = 0


@dataclass(frozen=True, slots=True)
class Between:
    """What holds between two neighbouring intervals: whether W = 0, the σ with Q = 0, and what σ is multiplied by where
    the direction of (x, y) turns into the opposite one on the axis (0: into another one)."""

    vanishes: bool
    empty: frozenset[int]
    turn: int

    def goes_on(self, plane: Plane, one: Label, other: Label) -> bool:
        """Whether two arcs have the same limit."""
        if self.vanishes and not plane.offset:
            side = one[0] * self.turn == other[0]
        else:
            side = self.vanishes or one[0] == other[0]
        return side and (one[1] == other[1] or one[0] in self.empty)


def check_motions(evidence: Entry, limits: Limits) -> Sentence:
    """What the evidence proves; or raise ``CertificateRejected`` naming the entry that fails."""
    arm, curves, places, solutions, through, motions = evidence.fields(*_MEMBERS)
    chain, budgeted = read_chain(arm), list(zip(curves.items(), places.items(), strict=False))
    if not budgeted or len(budgeted) != len(list(curves.items())) or len(budgeted) != len(list(places.items())):
        raise places.fail("expected a list for each of at least one curve")
    plane, before, last = Plane.of(chain, arm), None, None
    counts, ways, chains = list[int](), list[int](), dict[Label, int]()
    for curve, listed in budgeted:
        points = read_curve(curve)
        if last is not None and points[0] != last:
            raise curve.fail("the curve does not begin where the one before ends")
        along, last = Along.of(plane, seen_from_base(chain, coefficients(points)), curve), points[-1]
        betweens, samples = _cut(along, listed, limits.budget)
        for i, sample in enumerate(samples):
            labels = along.labels(sample)
            if before is None:
                chains = dict.fromkeys(labels, 1)
            else:
                between = betweens[i - 1] if i else joined(before, along, listed)
                passes = [(a, b) for a in chains for b in labels if between.goes_on(plane, a, b)]
                ways.append(len(passes))
                chains = {b: sum(chains[a] for a, other in passes if other == b) for b in labels}
            counts.append(len(labels))
            before = along
    for entry, expected in ((solutions, counts), (through, ways)):
        if [item.integer() for item in entry.items()] != expected:
            raise entry.fail("not the numbers that were found")
    if motions.integer() != sum(chains.values()):
        raise motions.fail("not the number of continuous motions")
    return sentence(evidence)


_MEMBERS = ("arm", "curves", "places", "solutions", "through", "motions")


def sentence(evidence: Entry) -> Sentence:
    """That between neighbouring places the equations have as many solutions as are stated."""
    arm, curves, places, solutions, _, _ = evidence.fields(*_MEMBERS)
    chain, numbers = read_chain(arm), [entry.integer() for entry in solutions.items()]
    listed = [ArmEquations.on_curve(chain, coefficients(read_curve(curve))) for curve in curves.items()]
    if not listed or len(listed) != len(list(places.items())):
        raise places.fail("expected a list for each of at least one curve")
    if len(intervals := list(_intervals(places))) != len(numbers):
        raise solutions.fail(f"expected {len(intervals)} numbers")
    ring = ring_of(listed, max(numbers, default=0))
    where: dict[tuple[int, int], list[Formula]] = {}
    for (curve, low, high), count in zip(intervals, numbers, strict=True):
        where.setdefault((curve, count), []).append(between(ring.var(ALONG), low, high))
    exactly = ((disj(ends), listed[curve].exactly(ring, count)) for (curve, count), ends in where.items())
    return with_roots(ring, listed, conj(forall((ALONG,), implies(*pair)) for pair in exactly)), TRUE


def _intervals(places: Entry) -> Iterator[tuple[int, Fraction, Fraction]]:
    """The number of a curve, and two parameters, between the places on it."""
    for k, listed in enumerate(places.items()):
        begin = Fraction(0)
        for entry in listed.items():
            low, high = (read_number(end) for end in entry.fields("low", "high", "factor")[:2])
            if low > 0:
                yield k, begin, low
            begin = high
        if begin <= 1:
            yield k, begin, Fraction(1)


def _cut(along: Along, listed: Entry, budget: Budget) -> tuple[list[Between], list[Fraction]]:
    """What holds at the listed places inside (0, 1), and a parameter in each of the intervals between them, in which
    neither W nor N vanishes (N where W > 0)."""
    begin, betweens, samples = Fraction(0), list[Between](), list[Fraction]()
    is_last = False
    for entry in listed.items():
        budget.check()
        low, high, between = _place(along, entry)
        if is_last or not low < high or (low <= begin and (samples or begin or not low < 0 < high)):
            raise entry.fail("expected intervals in ascending order, around 0 or 1 only if the zero is there")
        if low > 0:
            samples.append(_sample(along, begin, low, entry))
            betweens.append(between)
        is_last, begin = high > 1, high
    if is_last:
        betweens.pop()
    else:
        samples.append(_sample(along, begin, Fraction(1), listed))
    return betweens, samples


def _sample(along: Along, low: Fraction, high: Fraction, entry: Entry) -> Fraction:
    if not low < high:
        raise entry.fail("expected intervals in ascending order")
    side = constant_sign(along.w, low, high)
    if not side or (side > 0 and along.norm is not None and not constant_sign(along.norm, low, high)):
        raise entry.fail("the number of solutions is not proved to be constant up to here")
    return (low + high) / 2


def _place(along: Along, entry: Entry) -> tuple[Fraction, Fraction, Between]:
    """One zero of W or N."""
    low_entry, high_entry, factor_entry = entry.fields("low", "high", "factor")
    low, high = read_number(low_entry), read_number(high_entry)
    if not low < high:
        raise entry.fail("expected an interval")
    factor = along.norm if factor_entry.value is None else Polynomial.of([read_surd(c) for c in factor_entry.items()])
    if not factor or len(factor) < 2:
        raise factor_entry.fail("expected a polynomial that is not constant")
    if factor.at(low).sign() * factor.at(high).sign() >= 0 or not constant_sign(factor.derivative, low, high):
        raise factor_entry.fail("not proved to have exactly one zero in the interval, a simple one")
    for end in (Fraction(0), Fraction(1)):
        if low <= end <= high and factor.at(end):
            raise entry.fail("an end of the curve is in the interval, and not the zero")

    def order(p: Polynomial) -> int:
        k = 0
        while len(p) >= len(factor) and not (parts := sr.divided(p, factor))[1]:
            p, k = parts[0], k + 1
        if not constant_sign(p, low, high):
            raise entry.fail("W, N or Q is not proved to vanish only at one place in the interval, if at all")
        return k

    vanishes, empty = order(along.w), frozenset[int]()
    meets = order(along.norm) if along.norm is not None else 0
    if not vanishes and not meets:
        raise entry.fail("neither W nor N vanishes there")
    if along.quality is not None and meets:
        even, odd = along.quality
        if along.plane.may_fold and not constant_sign(norm_of(along.distance, along.w), low, high):
            raise entry.fail("the second joint may be free in the interval")
        sides = [constant_sign(p, low, high) if p else 0 for p in (even, odd)]
        if vanishes or not even or (not all(sides) and order(even)):
            empty = frozenset(SIGNS)  # N = A² where W = 0; where W > 0 and A = 0, B = 0
        elif all(sides):
            empty = frozenset({-sides[0] * sides[1]})
        else:
            raise entry.fail("which Q vanishes is not proved")
    return low, high, Between(vanishes > 0, empty, (-1) ** (vanishes // 2))


def joined(one: Along, other: Along, entry: Entry) -> Between:
    """What holds where the next curve begins."""
    end = Fraction(1)
    empty = one.empty(lambda p: p.at(end).sign())
    if empty is None:
        raise entry.fail("the second joint is free where the curve begins")
    if one.w.at(end):
        return Between(False, empty, 1)
    turn = 1
    if not one.plane.offset:
        (a, b, k), (c, d, _) = _direction(one, end), _direction(other, Fraction(0))
        turn = 0 if a * d - b * c else (-1) ** k * (a * c + b * d).sign()
    return Between(True, empty, turn)


def _direction(along: Along, s: Fraction) -> tuple[Surd, Surd, int]:
    """The first derivatives of x and y that do not both vanish at s, and their order."""
    x, y, k = along.x, along.y, 0
    while not (x.at(s) or y.at(s)):
        x, y = x.derivative, y.derivative
        k += 1
    return x.at(s), y.at(s), k


def norm_of(a: Split, w: Polynomial) -> Polynomial:
    """The product with what -r makes of it."""
    return a[0] * a[0] - a[1] * a[1] * w


def _column(rows: Sequence[Triple]) -> Triple:
    return tuple(row[2] for row in rows)


RULE = stated(check_motions)

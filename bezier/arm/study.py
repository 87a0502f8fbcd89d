"""A whole curve: whether every point of it can be reached, where not, and how many solutions there are in between.

Exact: the number of solutions is constant between neighbouring critical parameters (``bezier.arm.critical``), so one
rational parameter in each of these intervals and the critical ones themselves decide for all.

Where along a curve a joint can be at one of its limits: parameters between which no solution passes a limit.

With the joint's value as a variable q (the cosine and sine of an angle) the arm whose joint is held at q gives a
relation H(s, q) that every solution satisfies (``bezier.proofs.held_joint``). If k is the least number for which the
k-th derivative of H by q is not zero for all s at q = L, then a solution whose joint is not L all along is at L only
where this derivative vanishes: H = (q - L)^k H', so H' vanishes along the solution. At a length and at the angle 0 that
is a polynomial over the field of the arm, with exact zeros. At an angle of another rational number of radians, whose
sine and cosine are transcendental (Lindemann), a polynomial in these over that field is zero iff it is as a polynomial:
zeros are enclosed, and that of coefficients without content in s are at no algebraic s.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import pairwise

from bezier.arm.critical import AlongCurve, Number, Reason, S
from bezier.arm.elimination import M, Ratio, T, constant, variable
from bezier.arm.inverse import Inverse, solve, solve_at
from bezier.arm.model import Arm, Joint, JointKind
from bezier.curves.curve import Bezier
from bezier.proofs.held_joint import Held
from qe.errors import Unable
from qe.exact.nearby import rational_between
from qe.exact.ring import Poly
from qe.exact.zeros_at_angle import zeros_at_angle


@dataclass(frozen=True, slots=True)
class Stretch:
    """The open interval between two parameters, with the number of solutions for every s in it."""

    low: Place
    high: Place
    count: int
    sample: Fraction


@dataclass(frozen=True, eq=False)
class Special:
    """A critical parameter or an end of the curve, with the solutions there."""

    s: Number
    reasons: tuple[Reason, ...]
    inverse: Inverse


@dataclass(frozen=True, eq=False)
class Study:
    """What is proved about a curve."""

    arm: Arm
    curve: Bezier
    stretches: tuple[Stretch, ...]
    within: tuple[Stretch, ...]
    """Stretches in which no solution passes a limit of a joint, with the numbers of solutions that keep all of them."""
    specials: tuple[Special, ...]
    shared: tuple[Number, ...]
    """Where two solutions have the sine of the last joint in common."""

    @property
    def is_reachable(self) -> bool:
        """Whether there is a solution within the limits of the joints for all s in [0, 1].

        A solution within them on one side of a place where a joint is at a limit is within them there."""
        return not self.gaps and all(p.inverse.allowed_count for p in self.specials)

    @property
    def gaps(self) -> tuple[Stretch, ...]:
        """The stretches without a solution within the limits: their ends are just where the path stops and goes on."""
        return tuple(part for part in self.within if not part.count)


def study(arm: Arm, curve: Bezier, also: Iterable[Number] = ()) -> Study:
    """Study a curve with rational control points (mm). ``also``: parameters that no stretch of ``within`` contains, if
    joints have limits.

    Raises ``Unable`` where the whole curve is special (on the axis, along a border) or the arm does not fit.
    """
    along = AlongCurve(arm, curve)
    critical = dict(along.critical())
    specials = []
    ends = sorted({Fraction(0), Fraction(1), *critical})
    for s in ends:
        point = curve.point(s) if isinstance(s, Fraction) else ()
        answer = solve(arm, point) if point else solve_at(arm, along.place(s), (), along.reduction)
        merging = any(solution.multiple for solution in answer.solutions)  # not only complex ones
        reasons = (r for r in critical.get(s, ()) if r is not Reason.MERGE or merging)
        specials.append(Special(s, tuple(reasons), answer))
    stretches = tuple(_stretches(arm, curve, ends, lambda answer: answer.count))
    within = stretches
    if arm.has_limits:
        places = marks(along, {*critical, *also})
        within = tuple(_stretches(arm, curve, places, lambda answer: answer.allowed_count))
    return Study(arm, curve, stretches, within, tuple(specials), tuple(along.shared_sines()))


def _stretches(
    arm: Arm, curve: Bezier, ends: Sequence[Place], counted: Callable[[Inverse], int | None]
) -> Iterator[Stretch]:
    for low, high in pairwise(ends):
        sample = sample_between(low, high)
        assert sample is not None, "different parameters have numbers between them"
        count = counted(solve(arm, curve.point(sample)))
        assert count is not None, "a point between the critical ones is not special"
        yield Stretch(low, high, count, sample)


BITS = (192, 1024, 4096)
ZERO, ONE = Fraction(0), Fraction(1)
WIDE = 6
"""Less than a turn (rad): where limits are further apart, full turns of a motion count."""

QUARTERS = ((1, 0), (0, 1), (-1, 0), (0, -1))


@dataclass(frozen=True, slots=True)
class Near:
    """A parameter between two rational numbers; its joint is at a limit of a rational number of radians there."""

    low: Fraction
    high: Fraction
    is_joined: bool = False
    """Or several such parameters, of different limits."""

    def __float__(self) -> float:
        return float(self.low)


Place = Number | Near


def is_wide(joint: Joint) -> bool:
    """Whether full turns of a motion may count: a bound below 2π for the distance of the limits is passed."""
    return joint.limits is not None and _turns(joint) and joint.limits[1] - joint.limits[0] >= WIDE


def _turns(joint: Joint) -> bool:
    return joint.motion is JointKind.REVOLUTE


def ends_of(place: Place, bits: int = 64) -> tuple[Fraction, Fraction]:
    """Rational numbers around a parameter."""
    if isinstance(place, Near):
        return place.low, place.high
    return (place, place) if isinstance(place, Fraction) else place.interval(bits)


def marks(along: AlongCurve, critical: Iterable[Number]) -> tuple[Place, ...]:
    """0, 1, the critical parameters, and all in between at which a solution may be at a limit, or, where full turns
    count, an angle may be a multiple of a quarter turn; ascending.

    Enclosures that are not separated are one. Raises ``Unable`` where that joins two of the same limit, or
    an enclosure and an exact parameter."""
    exact, enclosures = set[Number](critical), list[Callable[[int], list[Near]]]()
    for k, joint in enumerate(along.arm.joints):
        relation = None if joint.limits is None else _relation(along, k)
        if relation is not None and is_wide(joint):
            for quarter in QUARTERS:
                exact.update(along.zeros(_held_at(relation, quarter)))
        for limit in joint.limits or ():
            assert relation is not None, "a joint with limits has a relation"
            if joint.motion is JointKind.PRISMATIC or limit == 0:
                exact.update(along.zeros(_held_at(relation, QUARTERS[0] if limit == 0 and _turns(joint) else (limit,))))
            else:
                content, rest = _parted(relation)
                exact.update(along.zeros(content))
                enclosures.append(partial(_enclosed_zeros, along, rest, limit))
    for bits in BITS:
        result = [(near.low, near.high, near, k) for k, f in enumerate(enclosures) for near in f(bits)]
        known = [(*ends_of(s, bits), s, -1) for s in exact | {ZERO, ONE}]
        groups = _groups([*result, *known])
        if all(len(group) == 1 for group in groups):
            break
    return tuple(_joined(group) for group in groups)


Item = tuple[Fraction, Fraction, Place, int]
"""An interval around a parameter, the parameter, and the number of the limit that it belongs to."""


def _groups(items: list[Item]) -> list[list[Item]]:
    """Those whose intervals overlap, together; ascending."""
    groups = list[list[Item]]()
    for item in sorted(items, key=lambda item: item[:2]):
        if groups and item[0] <= max(high for _, high, *_ in groups[-1]):
            groups[-1].append(item)
        else:
            groups.append([item])
    return groups


def _joined(group: list[Item]) -> Place:
    if len(group) == 1:
        return group[0][2]
    limits = [k for *_, k in group]
    if -1 in limits or len(set(limits)) < len(limits):
        where = f"near s = {float(group[0][0]):.12g}"
        raise Unable(f"{where} places where joints are at limits are not separated from others")
    return Near(min(item[0] for item in group), max(item[1] for item in group), is_joined=True)


def _relation(along: AlongCurve, joint: int) -> Poly:
    """H(s, q), with the variables t, m for the cosine and the sine, or t for the length."""
    arm, one = along.arm, constant(along.point[0].top.ring, 1, along.arm.field)
    value = [variable(one.top.ring, name, arm.field) for name in (T, M)]
    chain = arm.chain
    held = Held.of(chain, joint, value if chain.turns[joint] else value[:1], one.by)
    for result, needs in held.relations(along.point):
        if not any(_on_circle(need) for need in needs) and (p := _on_circle(result)):
            return p
    raise Unable(f"the limits of {arm.joints[joint].name} do not show along the curve")


def _on_circle(p: Ratio) -> Poly:
    """With m² replaced by 1 - t², where m occurs."""
    ring = p.top.ring
    t, m = ring.var(T), ring.var(M)
    total = ring.constant(0)
    for k, c in enumerate(p.top.coefficients(ring.index[M])):
        total = total + c * (1 - t * t) ** (k // 2) * m ** (k % 2)
    return total


def _held_at(p: Poly, value: tuple[Fraction | int, ...]) -> Poly:
    """The first derivative by the joint's value that is not zero for all s, at a cosine and a sine, or at a length."""
    t, m = (p.ring.index[name] for name in (T, M))
    turns = len(value) == 2
    while True:
        result = p.at_rational(t, value[0])
        result = result.at_rational(m, value[1]) if turns else result
        if result:
            return result
        # (cos)' = -sin, (sin)' = cos
        p = p.ring.gen(t) * p.derivative(m) - p.ring.gen(m) * p.derivative(t) if turns else p.derivative(t)


def _parted(p: Poly) -> tuple[Poly, Poly]:
    """The greatest common divisor of the coefficients by the joint's value, and the rest without multiple factors."""
    content = p.ring.constant(0)
    for c in p.collected([p.ring.index[name] for name in (T, M)]).values():
        content = content.gcd(c)
    rest = p.exact_divide(content)
    return content, rest.exact_divide(rest.gcd(rest.derivative(S)))


def _enclosed_zeros(along: AlongCurve, p: Poly, limit: Fraction, bits: int) -> list[Near]:
    """Intervals in [0, 1], each with one zero, of p at an angle."""
    found = zeros_at_angle(p, S, along.arm.field.theta, limit, bits)
    if found is None:
        raise Unable(f"the places where a joint is at {limit} are not separated")
    return [Near(low, high) for low, high in found if high >= 0 and low <= 1]


def sample_between(low: Place, high: Place, within: tuple[Fraction, Fraction] = (ZERO, ONE)) -> Fraction | None:
    """A rational number between two parameters and in an interval, if there is one."""
    bits = 64
    while (a := ends_of(low, bits)[1]) >= (b := ends_of(high, bits)[0]):
        bits *= 2
    a, b = max(a, within[0]), min(b, within[1])
    return rational_between(a, b) if a < b else None

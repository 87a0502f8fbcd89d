"""A whole curve: whether every point of it can be reached, where not, and how many solutions there are in between.

Exact: the number of solutions is constant between neighbouring critical parameters (``bezier.arm.critical``), so one
rational parameter in each of these intervals and the critical ones themselves decide for all.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from bezier.arm.critical import AlongCurve, Number, Reason
from bezier.arm.inverse import Inverse, solve, solve_at
from bezier.arm.limit_places import Place, marks, sample_between
from bezier.arm.model import Arm
from bezier.curves.curve import Bezier

Note = Callable[[], None]


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
    """What is proved about a curve. ``within``: stretches in which no solution passes a limit of a joint, with the
    numbers of solutions that keep all of them. ``shared``: where two solutions have the sine of the last joint in
    common."""

    arm: Arm
    curve: Bezier
    stretches: tuple[Stretch, ...]
    within: tuple[Stretch, ...]
    specials: tuple[Special, ...]
    shared: tuple[Number, ...]

    @property
    def is_reachable(self) -> bool:
        """Whether there is a solution within the limits of the joints for all s in [0, 1].

        A solution within them on one side of a place where a joint is at a limit is within them there."""
        return not self.gaps and all(p.inverse.allowed_count for p in self.specials)

    @property
    def gaps(self) -> tuple[Stretch, ...]:
        """The stretches without a solution within the limits; their ends are the exact places where the path stops and
        begins again."""
        return tuple(part for part in self.within if not part.count)


def study(arm: Arm, curve: Bezier, note: Note = lambda: None, also: Iterable[Number] = ()) -> Study:
    """Study a curve with rational control points (mm); ``note`` is called between steps and may raise to stop.
    ``also``: parameters that no stretch of ``within`` contains, if joints have limits.

    Raises ``Unable`` where the whole curve is special (on the axis, along a border) or the arm does not fit.
    """
    along = AlongCurve(arm, curve)
    critical = dict(along.critical())
    note()
    specials = []
    ends = sorted({Fraction(0), Fraction(1), *critical})
    for s in ends:
        point = curve.point(s) if isinstance(s, Fraction) else ()
        found = solve(arm, point) if point else solve_at(arm, along.place(s), (), along.reduction)
        specials.append(Special(s, _told(critical.get(s, ()), found), found))
        note()
    stretches = tuple(_stretches(arm, curve, ends, lambda found: found.count, note))
    within = stretches
    if arm.has_limits:
        places = marks(along, {*critical, *also})
        within = tuple(_stretches(arm, curve, places, lambda found: found.allowed_count, note))
    return Study(arm, curve, stretches, within, tuple(specials), tuple(along.shared_sines()))


def _stretches(
    arm: Arm, curve: Bezier, ends: Sequence[Place], counted: Callable[[Inverse], int | None], note: Note
) -> Iterator[Stretch]:
    for low, high in pairwise(ends):
        sample = sample_between(low, high)
        assert sample is not None, "different parameters have numbers between them"
        count = counted(solve(arm, curve.point(sample)))
        assert count is not None, "a point between the critical ones is not special"
        yield Stretch(low, high, count, sample)
        note()


def _told(reasons: Sequence[Reason], found: Inverse) -> tuple[Reason, ...]:
    """The reasons that concern real solutions: complex ones may meet as well."""
    merging = any(s.multiple for s in found.solutions)
    return tuple(r for r in reasons if r is not Reason.MERGE or merging)

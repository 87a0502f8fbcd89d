"""A whole curve: whether every point of it can be reached, where not, and how many solutions there are in between.

Exact: the number of solutions is constant between neighbouring critical parameters (``bezier.arm.critical``), so one
rational parameter in each of these intervals and the critical ones themselves decide for all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from bezier.arm.critical import AlongCurve, Number, Reason
from bezier.arm.inverse import Inverse, solve, solve_at
from bezier.arm.model import Arm
from bezier.curves.curve import Bezier
from qe.exact.nearby import rational_between

Note = Callable[[], None]


@dataclass(frozen=True, slots=True)
class Stretch:
    """The open interval between two parameters, with the number of solutions for every s in it."""

    low: Number
    high: Number
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
    """What is proved about a curve. ``shared``: where two solutions have the sine of the last joint in common."""

    arm: Arm
    curve: Bezier
    stretches: tuple[Stretch, ...]
    specials: tuple[Special, ...]
    shared: tuple[Number, ...]

    @property
    def is_reachable(self) -> bool:
        """Whether there is a solution for all s in [0, 1]."""
        return all(part.count for part in self.stretches) and all(p.inverse.is_reachable for p in self.specials)

    @property
    def gaps(self) -> tuple[Stretch, ...]:
        """The stretches without a solution; their ends are the exact places where the path stops and begins again."""
        return tuple(part for part in self.stretches if not part.count)


def study(arm: Arm, curve: Bezier, note: Note = lambda: None) -> Study:
    """Study a curve with rational control points (mm); ``note`` is called between steps and may raise to stop.

    Raises ``Unable`` where the whole curve is special (on the axis, along a border) or the arm does not fit.
    """
    along = AlongCurve(arm, curve)
    critical = dict(along.critical())
    note()
    marks = sorted({Fraction(0), Fraction(1), *critical})
    specials, stretches = [], []
    for s in marks:
        point = curve.point(s) if isinstance(s, Fraction) else ()
        found = solve(arm, point) if point else solve_at(arm, along.place(s), (), along.reduction)
        specials.append(Special(s, _told(critical.get(s, ()), found), found))
        note()
    for low, high in pairwise(marks):
        sample = rational_between(low, high)
        count = solve(arm, curve.point(sample)).count
        assert count is not None, "a point between the critical ones is not special"
        stretches.append(Stretch(low, high, count, sample))
        note()
    return Study(arm, curve, tuple(stretches), tuple(specials), tuple(along.shared_sines()))


def _told(reasons: Sequence[Reason], found: Inverse) -> tuple[Reason, ...]:
    """The reasons that concern real solutions: complex ones may meet as well."""
    merging = any(s.multiple for s in found.solutions)
    return tuple(r for r in reasons if r is not Reason.MERGE or merging)

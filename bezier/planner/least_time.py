"""The least time along a planned path: ``law = "least"`` of [timing], with a bound from below; both proved.

The motion is that of ``bezier.retiming`` along the path with rational control points: the bound is for these, where
irrational ones are replaced by numbers next to them (``bezier.motion.motion.near``). That the limits hold is decided
about the path itself, as for every law. The certificate of the plan has that of both sides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import accumulate

from bezier.curves.curve import Bezier
from bezier.motion.motion import Quality, Timing, moving, near, pieces
from bezier.motion.timelaw import TimeLaw
from bezier.paths.path import Path
from bezier.planner.derivations import listed
from bezier.plans import Plan
from bezier.retiming.least_time import LeastTime, checked, least_time
from bezier.trajectories.exact import by_control_points
from bezier.trajectories.limits import Limit
from bezier.trajectories.piecewise import Trajectory
from qe.certify.verify import verify
from qe.errors import InputError, Unable
from qe.exact.rational_poly import RationalPoly
from qe.proof.certificate import Certificate

CLAIM = "The motion keeps its limits, and none takes less than the bound of its time"
PREFIX = "least time: "
"""How the labels of the members of a bundle begin."""


def joined(names: str, parts: Sequence[tuple[Fraction, Bezier]]) -> Trajectory:
    """Curves one after the other, each with its duration; irrational coordinates become numbers next to them."""
    rows = [tuple(tuple(near(c) for c in point) for point in curve.points) for _, curve in parts]
    breaks = tuple(accumulate((length for length, _ in parts), initial=Fraction(0)))
    polys = [by_control_points(row, length) for row, (length, _) in zip(rows, parts, strict=True)]
    return Trajectory(tuple(names), breaks, tuple(polys))


def with_least_time(plan: Plan, quality: Quality, path: Path, timing: Timing, given: Certificate | None) -> Plan:
    """The plan with the motion of least time; ``given``: the certificate of its folder, which states it, in place of a
    search. Raises ``Unable``, and ``CertificateRejected`` for that certificate."""
    places = joined("xyz", [(part.high - part.low, part.curve) for part in pieces(path, None)])
    orders = {"max_speed": 1, "max_acceleration": 2}
    limits = [Limit(orders[key], None, value) for key, value in timing.limits.items()]
    try:
        least = least_time(places, limits) if given is None else checked(places, limits, _members(given))
    except InputError as error:
        raise Unable(f"no least time of the path is known: {error}") from None
    if not {*places.breaks} <= {*least.path.breaks}:
        raise Unable("no least time of the path is known: the speed of its parameter jumps at a join")
    motion = replace(moving(path, timing, _law(least), least.duration), at_least=least.bound, rests=bool(least.rests))
    proof = least.certificate
    members = [*listed(plan.certificate), *((PREFIX + label, one) for label, one in listed(proof))]
    checks = {**plan.checks, CLAIM: verify(proof)} if given is None else plan.checks
    return replace(
        plan, quality=replace(quality, motion=motion), certificate=Certificate.bundle(members), checks=checks
    )


def _members(certificate: Certificate) -> Certificate:
    """Those about the least time."""
    parts = [(label.removeprefix(PREFIX), one) for label, one in listed(certificate) if label.startswith(PREFIX)]
    return Certificate.bundle(parts)


def _law(least: LeastTime) -> TimeLaw:
    """The share of the path as polynomials of the share of the time."""
    total, length = least.duration, least.path.breaks[-1]
    breaks = list(accumulate((step.duration / total for step in least.steps), initial=Fraction(0)))
    share = [RationalPoly.of([-begin * total, total]) for begin in breaks[:-1]]
    places = (step.place.compose(inner) for step, inner in zip(least.steps, share, strict=True))
    return TimeLaw(tuple(breaks), tuple(tuple(c / length for c in place.coefficients()) for place in places))

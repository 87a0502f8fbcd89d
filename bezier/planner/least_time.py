"""The least time along a planned path: ``law = "least"`` of [timing], with a bound from below; both proved.

The motion is that of ``bezier.retiming`` along the path with rational control points; irrational ones are replaced by
numbers next to them, as for every law (``bezier.motion.motion.near``). The certificate of the plan has that of both
sides.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import accumulate

from bezier.motion.motion import ORDERS, Quality, Timing, in_time, moving
from bezier.motion.timelaw import TimeLaw
from bezier.paths.path import Path
from bezier.planner.derivations import listed
from bezier.plans import Plan
from bezier.retiming.least_time import LeastTime, checked, least_time
from bezier.trajectories.limits import Limit
from qe.certify.verify import verify
from qe.errors import InputError, Unable
from qe.exact.rational_poly import RationalPoly
from qe.proof.certificate import Certificate

CLAIM = "The motion keeps its limits, and none takes less than the bound of its time"
PREFIX = "least time: "
"""How the labels of the members of a bundle begin."""


def with_least_time(plan: Plan, quality: Quality, path: Path, timing: Timing, given: Certificate | None) -> Plan:
    """The plan with the motion of least time; ``given``: the certificate of its folder, which states it, in place of a
    search. Raises ``Unable``, and ``CertificateRejected`` for that certificate."""
    places = in_time(path, None)
    limits = [Limit(ORDERS[key], None, value) for key, value in timing.limits.items()]
    try:
        if given is None:
            least = least_time(places, limits)
        else:
            pairs = listed(given)
            about = [(label.removeprefix(PREFIX), one) for label, one in pairs if label.startswith(PREFIX)]
            least = checked(places, limits, Certificate.bundle(about))
    except InputError as error:
        raise Unable(f"no least time of the path is known: {error}") from None
    if not {*places.breaks} <= {*least.path.breaks}:
        raise Unable("no least time of the path is known: the speed of its parameter jumps at a join")
    motion = replace(moving(path, timing, _law(least), least.duration), at_least=least.bound, rests=bool(least.rests))
    proof = least.certificate
    members = [*listed(plan.certificate), *((PREFIX + label, one) for label, one in listed(proof))]
    whole, checks = Certificate.bundle(members), plan.checks
    checks = {**checks, CLAIM: verify(proof)} if given is None else checks
    return replace(plan, quality=replace(quality, motion=motion), certificate=whole, checks=checks)


def _law(least: LeastTime) -> TimeLaw:
    """The share of the path as polynomials of the share of the time."""
    total, length = least.duration, least.path.breaks[-1]
    breaks = list(accumulate((step.duration / total for step in least.steps), initial=Fraction(0)))
    share = [RationalPoly.of([-begin * total, total]) for begin in breaks[:-1]]
    places = (step.place.compose(inner) for step, inner in zip(least.steps, share, strict=True))
    return TimeLaw(tuple(breaks), tuple(place * RationalPoly.of([1 / length]) for place in places))

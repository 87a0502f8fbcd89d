"""How far a moving point is from a Cartesian path at the same time: decided for all t, as a limit of a trajectory.

What is limited is the difference of two trajectories, so the claims are those of ``bezier.trajectories.evidence``: one
sentence of the kernel for each piece, or one about a time at which the distance is larger. The end point of an arm is
no polynomial of the time. There the sentences are about polynomials that are nowhere ``error`` away from it
(``bezier.arm.tip`` has the theorem; the kernel knows no cosine): kept means that they keep ``within - error``, exceeded
that they exceed ``within + error``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

from bezier.arm.model import Arm
from bezier.arm.reader import load_route
from bezier.arm.tip import axes_of, tip_of
from bezier.curves.scalar import described, exactly
from bezier.curves.sentences import Said
from bezier.trajectories.evidence import members, stated
from bezier.trajectories.exact import by_control_points
from bezier.trajectories.limits import Limit, Verdict, decided
from bezier.trajectories.piecewise import Trajectory
from bezier.trajectories.readers import load
from qe.errors import InputError, Unable
from qe.proof.certificate import Certificate

FINER = (20, 44)
"""The end point is known to this many binary digits of the largest distance; more of them where that does not tell."""
WORDS = "distance from the path"


def arm_limits(arm: Arm, trajectory: Trajectory) -> list[Limit]:
    """What an arm says of its joints."""
    listed = list[Limit]()
    for axis, joint in zip(axes_of(arm, trajectory.names), arm.joints, strict=True):
        listed += [Limit(0, axis, high, low) for low, high in ([joint.limits] if joint.limits else [])]
        rates = ((1, joint.max_velocity), (2, joint.max_acceleration))
        listed += [Limit(order, axis, rate) for order, rate in rates if rate is not None]
    return listed


def load_path(file: Path, trajectory: Trajectory) -> Trajectory:
    """A trajectory, or the curves of a TOML file, each of which takes the same part of the whole time."""
    if file.suffix.lower() != ".toml":
        return load(file)
    curves, start = list(load_route(file).values()), trajectory.breaks[0]
    share = (trajectory.breaks[-1] - start) / len(curves)
    breaks = tuple(start + k * share for k in range(len(curves) + 1))
    points = ([[exactly(c) for c in point] for point in curve.points] for curve in curves)
    return Trajectory(("x", "y", "z"), breaks, tuple(by_control_points(listed, share) for listed in points))


@dataclass(frozen=True)
class Along:
    """``verdict``: of the difference of point and path; ``error``: how far the point may be from what stands for it."""

    within: Fraction
    verdict: Verdict
    error: Fraction = Fraction(0)

    @staticmethod
    def of(trajectory: Trajectory, path: Trajectory, within: Fraction, arm: Arm | None = None) -> Along:
        """Whether the trajectory, or the end point of an arm that follows it, is within this distance at all times.
        Raises ``InputError``, and ``Unable`` where it is too close to that to tell."""
        axes = len(trajectory.names) if arm is None else 3
        if len(path.names) != axes or axes > 3:
            raise InputError(f"--along: expected a path of as many coordinates as the point ({axes}), at most 3")
        if (path.breaks[0], path.breaks[-1]) != (trajectory.breaks[0], trajectory.breaks[-1]):
            spans = [" to ".join(f"{float(t.breaks[k]):.10g}" for k in (0, -1)) for t in (trajectory, path)]
            raise InputError(f"--along: expected a path from t = {spans[0]}, as the trajectory, found {spans[1]}")
        if arm is None:
            return Along(within, _decided(trajectory, path, within))
        for bits in FINER:
            error = Fraction(2) ** (within.numerator.bit_length() - within.denominator.bit_length() - bits)
            tip = tip_of(arm, trajectory, error)
            for bound, proves in ((within - error, True), (within + error, False)):
                verdict = _decided(tip, path, bound)
                if verdict.is_kept is proves:
                    return Along(within, verdict, error)
        raise Unable(f"the largest {WORDS} is so close to {float(within):.10g} that it is not decided")

    @property
    def is_kept(self) -> bool:
        """Whether the point is near the path at all times."""
        return self.verdict.is_kept

    @property
    def line(self) -> str:
        """What is proved."""
        (outcome,) = self.verdict.outcomes
        state = "kept for all t, largest" if self.is_kept else "EXCEEDED, worst"
        exact = "" if not self.error else f" (up to {float(self.error):.2g})"
        time = float(outcome.time(self.verdict.trajectory))
        return f"{WORDS}: {state} {outcome.value:.10g}{exact} at t = {time:.10g}"

    def to_json(self) -> dict[str, Any]:
        """Exact numbers, and the largest distance."""
        (outcome,), exact = self.verdict.outcomes, {"within": self.within, "error": self.error}
        time = described(outcome.time(self.verdict.trajectory))
        return {**{k: str(v) for k, v in exact.items()}, "kept": self.is_kept, "worst": outcome.value, "time": time}

    def members(self) -> Iterator[tuple[str, Certificate]]:
        """The proof. Raises ``Unable``."""
        return ((self._label(label), certificate) for label, certificate in members(self.verdict))

    def stated(self) -> list[Said]:
        """What it has to say."""
        return [(self._label(label), sentence, answer) for label, sentence, answer in stated(self.verdict)]

    def _label(self, label: str) -> str:
        near = f", the end point within {self.error} of these polynomials" if self.error else ""
        return f"{WORDS}: {label}{near}"


def _decided(point: Trajectory, path: Trajectory, within: Fraction) -> Verdict:
    """Of the difference. Whether it is continuous is no matter of the distance."""
    a, b = point.cut(path.breaks), path.cut(point.breaks)
    rows = tuple(tuple(p - q for p, q in zip(*pair, strict=True)) for pair in zip(a.pieces, b.pieces, strict=True))
    found = decided(Trajectory(point.names, a.breaks, rows), [Limit(0, None, within)], Fraction(0))
    return replace(found, jumps=())

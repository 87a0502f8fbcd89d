"""An arm as one object for scripts and notebooks: ``Robot.load("ev3-120").inverse((10, 40, 80))``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bezier.arm import kinematics
from bezier.arm.inverse import Inverse, listed, solve
from bezier.arm.joint_path import JointPath, joint_path
from bezier.arm.joint_plan import JointPlan, joint_plan
from bezier.arm.model import Arm
from bezier.arm.pose import rotation_of, solve_pose
from bezier.arm.reachable import SECONDS, Torus, reachable_formula, reachable_set
from bezier.arm.reader import load_arm
from bezier.curves.curve import Bezier
from bezier.motion.timelaw import Law, TimeLaw
from qe.errors import InputError
from qe.proof.answer import Answer

if TYPE_CHECKING:
    from bezier.arm.kinematics import Floats


@dataclass(frozen=True, slots=True)
class Robot:
    """An arm with its questions as methods. Lengths in mm, angles in rad, times in s."""

    arm: Arm

    @staticmethod
    def load(name: str | Path) -> Robot:
        """The arm of a shipped name (``ev3-112``, ``ev3-120``, …), or of a TOML or URDF file. Raises ``InputError``."""
        if not isinstance(name, str | Path):
            raise InputError(f"arm: a name or a file expected, {type(name).__name__} found")
        return Robot(load_arm(str(name)))

    def forward(self, values: Mapping[str, Any]) -> tuple[Any, Any, Any]:
        """The point of the end effector, exactly: see ``bezier.arm.kinematics.position``."""
        return kinematics.position(self.arm, values)

    def positions(self, q: Sequence[Sequence[float]]) -> Floats:
        """Points for many joint positions in floating point, shape (N, 3)."""
        return kinematics.positions(self.arm, q)

    def inverse(self, point: Sequence[Any]) -> Inverse:
        """All real joint positions at a point with exact coordinates. Raises ``InputError`` and ``Unable``."""
        return solve(self.arm, point)

    def inverse_at_pose(self, point: Sequence[Any], rotation: Sequence[Any]) -> Inverse:
        """All real joint positions at a pose: ``rotation`` is a quaternion (w, x, y, z) of any length, or the rows of a
        matrix. For planar arms and arms with six joints, see ``bezier.arm.pose``."""
        given = listed(rotation, "rotation: a quaternion or three rows")
        rows = given if len(given) == 3 else rotation_of(given)
        return solve_pose(self.arm, point, rows)

    def reachable(self) -> Torus:
        """The reachable set in closed form. Raises ``Unable`` for arms of another shape than the EV3's."""
        return reachable_set(self.arm)

    def reachable_formula(self, timeout: float | None = SECONDS) -> Answer:
        """The reachable set as a formula in x, y, z, by quantifier elimination: see ``bezier.arm.reachable``."""
        return reachable_formula(self.arm, timeout=timeout)

    def path(self, curves: Mapping[str, Bezier]) -> JointPath:
        """What is proved about a path whose curves have rational control points."""
        return joint_path(self.arm, curves)

    def plan(
        self, curves: Mapping[str, Bezier], duration: int | Fraction = 50, law: Law = Law.QUINTIC, samples: int = 200
    ) -> JointPlan:
        """The joint sequence of least change along the path, and the proved bounds of its motion."""
        for name, value, kind in (("duration", duration, int | Fraction), ("samples", samples, int), ("law", law, Law)):
            if not isinstance(value, kind) or isinstance(value, bool):
                raise InputError(f"{name}: an exact number or a Law expected, {type(value).__name__} found")
        if duration <= 0:
            raise InputError(f"duration: more than 0 s expected, {duration} found")
        return joint_plan(self.arm, curves, TimeLaw.of(law), Fraction(duration), samples)

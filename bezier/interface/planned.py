"""What ``bezier.plan`` gives back: the path in exact numbers, in floating point, and in the forms of other programs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from dataclasses import replace as changed
from fractions import Fraction
from functools import cached_property
from html import escape
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure
from bezier.interface.work import Work
from bezier.motion.motion import Motion, Quality, in_time, motion_csv
from bezier.obstacles.survey import Finding
from bezier.paths.path import Path
from bezier.planner import outputs, words
from bezier.planner.command import write_folder
from bezier.plans import Clock, Derived, Outcome, Plan
from bezier.problem import Problem
from qe import arguments
from qe.errors import InputError, Unable
from qe.extras import wanted
from qe.proof.certificate import Certificate

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray
    from scipy.interpolate import BSpline, PPoly

    from bezier.arm.joint_plan import JointPlan
    from bezier.motion.track import Track


SMALLEST = Fraction(1, 10**300)


class NoPath(Unable):
    """There is no path to use: none exists, or an obstacle is met, or the motion does not keep its limits.

    ``plan``: what was found all the same, with its certificate.
    """

    def __init__(self, message: str, plan: Planned) -> None:
        self.plan = plan
        super().__init__(message)

    def __reduce__(self) -> tuple[type[NoPath], tuple[str, Planned]]:
        return NoPath, (str(self), self.plan)


@dataclass(frozen=True)
class Planned:
    """A plan. Lengths in mm; times in seconds where limits were given, else in units of the middle curve's duration.

    Without obstacles, limits of the motion and arm only what decides about the path is worked out at once: the
    elimination, the optimum, and the proofs that the path stays in the workspace. The rest (regions, certificates and
    their verification, lengths) follows, once, when it is asked for, under the same limits. Two plans of one problem
    are compared by their problems, outcomes and paths, which are exact.
    """

    work: Work

    def __eq__(self, other: object) -> bool:
        return self._known == other._known if isinstance(other, Planned) else NotImplemented

    def __hash__(self) -> int:
        return hash((self.outcome, self.problem.start, self.problem.goal))

    @property
    def _known(self) -> tuple[object, ...]:
        return changed(self.problem, source=""), self.outcome, self.work.path

    @property
    def found(self) -> Plan:
        """All that planning finds out. Raises ``Unable`` where it does not, ``qe.BudgetExceeded`` at a limit."""
        return self.work.plan

    @property
    def seconds(self) -> float:
        """How long all that was worked out so far took."""
        return self.work.seconds

    # --- exact ------------------------------------------------------------------------------------------
    @property
    def problem(self) -> Problem:
        """The problem in exact numbers."""
        return self.work.known.problem

    @property
    def outcome(self) -> Outcome:
        """``SOLVED``; another one only in the plan of a ``NoPath``."""
        return self.work.known.outcome

    @property
    def path(self) -> Path:
        """The curves, control points and joins, exactly, with what is proved. Raises ``Unable`` where none exists."""
        path = self.work.path
        if path is None:
            raise Unable(words.why_not(self.found) or "no path")
        return path

    @property
    def curves(self) -> Mapping[str, Bezier]:
        """The curves in order, by the paper's names."""
        return self.path.curves

    @property
    def points(self) -> Mapping[str, tuple[Any, ...]]:
        """The control points by the paper's names, exactly."""
        return self.path.points

    @property
    def certificate(self) -> Certificate:
        """For ``qe.verify`` and ``qe check``: everything about the plan, labelled."""
        return self.found.certificate

    @property
    def derivations(self) -> Mapping[str, Derived]:
        """The derivations of the eliminations that the plan rests on, by what was asked; empty without ``proofs``."""
        return self.found.derivations

    @property
    def certified(self) -> bool:
        """Whether the checker accepted every certificate, and the whole path is proved inside and clear.

        The certificates are made and checked when this is first asked for, if not before.
        """
        return self.found.certified

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What was found out about each curve and each obstacle."""
        return self.found.findings

    @property
    def clearance(self) -> Enclosure | None:
        """The least distance of the path from an obstacle (mm), enclosed.

        None without obstacles, and where the distance of one is not known (obstacles given by a formula).
        """
        known = [finding.distance for finding in self.findings]
        distances = [d for d in known if d is not None]
        if not distances or len(distances) < len(known):
            return None
        highs = [d.high for d in distances if d.high is not None]
        return Enclosure(min(d.low for d in distances), min(highs, default=None))

    @property
    def quality(self) -> Quality | None:
        """Length and largest curvature of each curve, and the motion in time."""
        return self.found.quality

    @property
    def length(self) -> Enclosure:
        """The length of the path (mm), enclosed."""
        if self.quality is None:
            raise Unable("; ".join(self.found.remarks) or words.why_not(self.found) or "the length is not known")
        return self.quality.length

    @property
    def motion(self) -> Motion | None:
        """The motion in time with its largest speed and acceleration; None without limits."""
        return None if self.problem.timing is None or self.quality is None else self.quality.motion

    @property
    def joints(self) -> JointPlan | None:
        """The joints of the arm along the path, with what is proved of them; None without an arm."""
        return self.found.joints

    @property
    def duration(self) -> Fraction:
        """The time at the end of the path, which begins at 0."""
        if self.motion is not None:
            return self.motion.duration
        return sum(map(self.path.duration, self.curves), Fraction(0))

    # --- floating point ---------------------------------------------------------------------------------
    @cached_property
    def _track(self) -> Track:
        with wanted():
            from bezier.motion.track import Track

        return Track.of(in_time(self.path, self.motion))

    def __call__(self, t: ArrayLike) -> NDArray[np.float64]:
        """The positions at these times from 0 to ``duration``: of shape (3,) for a number, (n, 3) for n of them."""
        return self._track.at(t)

    def velocity(self, t: ArrayLike) -> NDArray[np.float64]:
        """The velocities at these times, as ``__call__`` has the positions."""
        return self._track.derivative.at(t)

    def acceleration(self, t: ArrayLike) -> NDArray[np.float64]:
        """The accelerations at these times; at a jump, the later one."""
        return self._track.derivative.derivative.at(t)

    # --- for other programs -----------------------------------------------------------------------------
    @property
    def _formats(self) -> Any:
        with wanted():
            from bezier.exports import formats

        return formats

    def to_json(self) -> dict[str, Any]:
        """What ``summary.json`` says, but for files and times."""
        return outputs.facts(self.found)

    def to_bspline(self) -> BSpline:
        """The motion as a SciPy ``BSpline`` over time. Raises ``Unable`` without SciPy."""
        result: BSpline = self._formats.bspline(self._track)
        return result

    def to_ppoly(self) -> PPoly:
        """The motion as a SciPy ``PPoly`` over time. Raises ``Unable`` without SciPy."""
        result: PPoly = self._formats.ppoly(self._track)
        return result

    def to_csv(self) -> str:
        """``motion.csv`` of a plan with limits, else ``path.csv``."""
        return outputs.path_csv(self.path) if self.motion is None else motion_csv(self.path, self.motion)

    def to_ros(self, *, frame: str = "base_link", joints: Sequence[str] | None = None, rows: int = 101) -> str:
        """A ROS 2 trajectory as YAML, in metres and seconds; a gantry's with the names of three ``joints``.

        Without them a ``MultiDOFJointTrajectory``. Raises ``InputError`` for a plan without a motion in time.
        """
        if self.motion is None:
            raise InputError("to_ros: a plan with limits= expected, one without a motion in time found")
        frame, rows = arguments.text(frame, "frame"), arguments.whole(rows, "rows")
        text: str = self._formats.ros_trajectory(self._track, frame=frame, joints=joints, rows=rows)
        return text

    def to_gcode(self, *, plane: str = "xy", tolerance: float = 0.05, feed: float = 1000) -> str:
        """G-code for a pen plotter: chords within ``tolerance`` (mm) of the path in a plane, ``feed`` in mm/min."""
        with wanted():
            from bezier.exports.plane import gcode

        return gcode(
            self._flat(), plane=plane, tolerance=_positive(tolerance, "tolerance"), feed=_positive(feed, "feed")
        )

    def to_svg(self, *, plane: str = "xy") -> str:
        """An SVG image of the path in a plane, with workspace, obstacles and given points.

        Raises ``Unable`` for obstacles without SciPy, which finds their outlines.
        """
        reach = float(self.problem.workspace.radius_squared) ** 0.5
        with wanted():
            from bezier.exports.plane import svg
            from bezier.pictures.obstacles import obstacle_pictures

            pictures = obstacle_pictures(self.problem.obstacles, reach)
        return svg(self._flat(), self.problem, pictures, plane)

    def _flat(self) -> Track:
        """The curves themselves, without a time law, which only raises their degree."""
        with wanted():
            from bezier.motion.track import Track

        return Track.of(in_time(self.path, None))

    def save(self, target: str | FilePath, *, pictures: bool = True) -> list[FilePath]:
        """Write one file, by its ending, or the folder of ``bezier plan``, for a name without one; what was written.

        ``.csv``, ``.json`` (exact control points), ``.npz``, ``.yaml`` (ROS 2), ``.gcode``, ``.svg``. ``pictures``: of
        the folder. Raises ``InputError`` for other endings and where it cannot be written.
        """
        file, drawn = arguments.path(target, "target"), arguments.flag(pictures, "pictures")
        if not file.suffix:
            return self._save_folder(file, drawn)
        make = self._writers().get(file.suffix.lower())
        if make is None:
            endings = ", ".join(self._writers())
            raise InputError(f"target: one of {endings} or the name of a folder expected, {file.name} found")
        content = make()
        try:
            file.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
        except OSError as error:
            raise InputError(f"{file}: cannot be written: {error.strerror}") from None
        return [file]

    def _writers(self) -> dict[str, Callable[[], str | bytes]]:
        return {
            ".csv": self.to_csv,
            ".json": lambda: outputs.path_text(self.found, self.path),
            ".npz": lambda: self._formats.npz(self._track),
            ".yaml": self.to_ros,
            ".gcode": self.to_gcode,
            ".svg": self.to_svg,
        }

    def _save_folder(self, target: FilePath, pictures: bool) -> list[FilePath]:
        clock = Clock(seconds=dict(self.found.seconds))
        clock.start -= self.seconds
        with wanted(), outputs.all_or_none(target) as folder:
            made = changed(self.found, seconds=clock.seconds)
            files, _ = write_folder(made, folder, target, clock, plots=pictures)
        return [target / name for name in files]

    def __str__(self) -> str:
        """The summary that ``bezier plan`` prints."""
        return "\n".join(words.lines(self.found))

    def _repr_html_(self) -> str:
        """The summary, with a picture of the path from above where there is one, for notebooks."""
        picture = ""
        if self.work.path is not None:
            try:
                picture = self.to_svg()
            except Unable:  # a library that draws is not installed
                picture = ""
        return f"<div><pre>{escape(str(self))}</pre>{picture}</div>"

    def __repr__(self) -> str:
        if self.work.path is None:
            return f"Planned({self.problem.method.value}, {self.outcome.value})"
        curves = ", ".join(f"{name} of degree {curve.degree}" for name, curve in self.curves.items())
        try:
            proved = "certified" if self.certified else "not certified"
        except Unable:  # at a limit
            proved = "not known to be certified"
        return f"Planned({self.problem.method.value}, {self.outcome.value}, {proved}: {curves})"


def _positive(value: object, what: str) -> float:
    exact = arguments.rational(value, what, "a number above zero")
    if not SMALLEST < exact < 1 / SMALLEST:
        raise arguments.wrong(what, "a number above zero, within the range of floating point,", value)
    return float(exact)

"""``bezier.certify``: a trajectory from Python, proved or refuted for all t."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bezier.arm.robot import Robot
from bezier.chains.plan import ChainPlan
from bezier.interface.function import given_table
from bezier.interface.planned import Planned
from bezier.interface.work import limited, unlimited
from bezier.motion.motion import in_time, joined
from bezier.trajectories.along import load_path
from bezier.trajectories.command import Certified, limits_of
from bezier.trajectories.limits import Limit
from bezier.trajectories.piecewise import Trajectory
from bezier.trajectories.readers import from_scipy, load
from qe import arguments
from qe.errors import InputError
from qe.progress import Listener, silent

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

SOURCE = "bezier.certify"
LIMITED = ("position", "velocity", "acceleration", "jerk", "velocity_norm", "acceleration_norm", "jerk_norm")


def certify(
    trajectory: object,
    *,
    position: ArrayLike | Sequence[object] | None = None,
    velocity: object = None,
    acceleration: object = None,
    jerk: object = None,
    velocity_norm: object = None,
    acceleration_norm: object = None,
    jerk_norm: object = None,
    obstacles: Sequence[Mapping[str, object]] | None = None,
    robot: object = None,
    along: object = None,
    within: object = None,
    tolerance: object = "1e-9",
    timeout: float | None = None,
    memory: int | None = None,
    progress: Listener = silent,
) -> Certified:
    """Whether a trajectory keeps its limits and is clear of all obstacles for all t, exactly and with proof.

    ``trajectory``: the path of a file in any form that ``bezier certify`` reads, a ``PPoly`` (``CubicSpline``, …) or
    ``BSpline`` of SciPy, a ``Trajectory``, or what ``bezier.plan`` and ``bezier.chain`` give. Limits are the keys of
    the command's file: one number for all axes or one for each, ``position`` a pair or a pair for each; in the units of
    the trajectory, and seconds. ``obstacles`` are tables as for ``bezier.plan``; for two axes bodies of the
    plane; with a ``robot`` its links have to be clear of them. Positions may jump by ``tolerance``.

    ``robot``: the name or file of an arm, or a ``Robot``: then the axes are its joints, whose limits have to hold, too.
    ``along`` and ``within``: the distance (mm) of the point, or of the robot's end point, from a Cartesian path at the
    same time: what ``trajectory`` may be, or the TOML file of a path, each of whose curves takes the same time.

    The result says ``kept``, ``slower_by`` (the factor of slowing down that repairs it), ``verdict.worst`` and
    ``certificate``; ``print(result)`` a line for each limit; ``result.page()`` is a page with charts.

    Raises ``qe.InputError`` naming the argument, ``qe.BudgetExceeded`` at a limit.

    >>> import bezier
    >>> from scipy.interpolate import CubicSpline
    >>> spline = CubicSpline([0, 1, 2], [[0, 0], [1, 2], [3, 1]])
    >>> print(bezier.certify(spline, velocity=[3, 4]))
    2 pieces, 2 axes, from t = 0 to 2
    velocity of q1: kept for all t, largest 2.5 at t = 2
    velocity of q2: kept for all t, largest 3.5 at t = 0
    all limits are kept for all t
    """
    given = locals()
    path = path_of(trajectory)
    limits = limited_motion(given, len(path.names), SOURCE)
    table = None if obstacles is None else given_table({"obstacle": obstacles}, SOURCE, {"obstacle": "obstacles"})
    largest = arguments.rational(tolerance, "tolerance")
    if largest < 0:
        raise InputError(f"{SOURCE}: tolerance: expected a number of at least 0, found {arguments.shown(tolerance)}")
    if (along is None) != (within is None):
        raise InputError(f"{SOURCE}: along and within: expected both, found one of them")
    near = None
    if along is not None:
        is_file = isinstance(along, str | os.PathLike)
        near = load_path(Path(along), path) if is_file else path_of(along)  # type: ignore[arg-type]
    far = Fraction(0) if within is None else arguments.rational(within, "within")
    if within is not None and far <= 0:
        raise InputError(f"{SOURCE}: within: expected a number above 0, found {arguments.shown(within)}")
    arm = None if robot is None else (robot if isinstance(robot, Robot) else Robot.load(robot)).arm  # type: ignore[arg-type]
    work = partial(Certified.of, path, limits, table, largest, arm, near, far)
    try:
        return limited(partial(unlimited, work), timeout, memory, progress)
    except OverflowError:
        raise InputError(f"{SOURCE}: expected quantities of usual size, found one beyond 10^308") from None


def path_of(given: Any, *, timed: bool = True) -> Trajectory:
    """A trajectory, the one in a file, that of an object of SciPy, a chain, or a plan (``timed``: with the law of its
    limits). Raises ``InputError``."""
    if isinstance(given, Trajectory):
        return given
    if isinstance(given, Planned):
        return in_time(given.path, given.motion if timed else None)
    if isinstance(given, ChainPlan):
        if not given.feasible:
            raise InputError(f"path: expected a chain, found none: {given}")
        chain = given.chain
        return joined("xyz"[: chain.dimension], list(zip(chain.times, given.curves, strict=True)))
    if isinstance(given, str | os.PathLike):
        return load(Path(given))
    return from_scipy(given)


def limited_motion(given: Mapping[str, object], axes: int, source: str) -> list[Limit]:
    """The limits among the arguments of a function. Raises ``InputError``."""
    return limits_of(given_table({name: given[name] for name in LIMITED}, source, {}), axes)

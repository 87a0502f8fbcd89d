"""``bezier.retime``: the least time along a path from Python, from both sides."""

from __future__ import annotations

from functools import partial

from bezier.input.toml_table import Table
from bezier.interface.function import table_value
from bezier.interface.trajectory import limited_motion, path_of
from bezier.interface.work import limited
from bezier.motion.timelaw import Law
from bezier.retiming.least_time import LeastTime, least_time
from qe import arguments
from qe.errors import InputError
from qe.progress import Listener, silent

SOURCE = "bezier.retime"


def retime(
    path: object,
    *,
    position: object = None,
    velocity: object = None,
    acceleration: object = None,
    jerk: object = None,
    velocity_norm: object = None,
    acceleration_norm: object = None,
    jerk_norm: object = None,
    law: object = Law.LEAST,
    accuracy: object = "1/250",
    timeout: float | None = None,
    memory: int | None = None,
    progress: Listener = silent,
) -> LeastTime:
    """The motion from rest to rest along a path that takes the least time under limits, and a bound from below.

    ``path``: what ``bezier.certify`` takes; only its places count, not its times. Where its direction jumps the motion
    stops. The limits are those of ``bezier.certify``; one of the acceleration is needed. ``law``: ``"cubic"``,
    ``"quintic"`` or ``"trapezoid"`` in place of the fastest motion; where jerk is limited that is averaged over some
    time, and the bound leaves jerk aside. ``accuracy``: the share above the bound at which the search stops.

    The result says ``duration``, ``bound`` (no motion takes less; both exact), ``trajectory``, ``certificate``;
    ``to_csv()`` is a file for ``bezier certify``, ``page()`` a page with charts. All limits are kept for all t.

    Raises ``qe.InputError`` naming the argument, ``qe.Unable`` where none is found, ``qe.BudgetExceeded`` at a limit.

    >>> import bezier
    >>> from scipy.interpolate import CubicSpline
    >>> spline = CubicSpline([0, 1, 2], [[0, 0], [1, 2], [3, 1]])
    >>> fast = bezier.retime(spline, velocity=3, acceleration=4)
    >>> fast.verdict.is_kept, fast.bound < fast.duration < fast.bound * 1.004
    (True, True)
    """
    given = locals()
    places = path_of(path, timed=False)
    limits = limited_motion(given, len(places.names), SOURCE)
    share = arguments.rational(accuracy, "accuracy")
    if share <= 0:
        raise InputError(f"{SOURCE}: accuracy: expected a number above 0, found {arguments.shown(accuracy)}")
    chosen = Table({"law": table_value(law, "law")}, SOURCE).choice("law", Law)
    return limited(partial(least_time, places, limits, law=chosen, accuracy=share), timeout, memory, progress)

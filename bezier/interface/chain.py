"""``bezier.chain``: the problems of ``bezier chain`` from Python values."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from bezier.chains.plan import ChainPlan, planned
from bezier.chains.reader import read_chain
from bezier.interface.function import given_table, keyed
from bezier.interface.work import limited, unlimited
from qe.progress import Listener, silent

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    Point = ArrayLike | Sequence[object]

SOURCE = "bezier.chain"
NAMES = {"half_space": "half_spaces"}


def chain(
    *,
    start: Point,
    via: Sequence[Point] | ArrayLike,
    goal: Point | None = None,
    radius: object = None,
    centre: Point | None = None,
    half_spaces: Sequence[object] = (),
    degree: object = 3,
    continuity: object = 2,
    durations: object = (),
    total: object = None,
    ends: object = "free",
    velocities: Sequence[Point] | ArrayLike | None = None,
    closed: bool = False,
    objective: object = "legs",
    max_length: object = None,
    max_curvature: object = None,
    timeout: float | None = None,
    memory: int | None = None,
    progress: Listener = silent,
) -> ChainPlan:
    """The best chain of Bézier curves from ``start`` over all ``via`` points to ``goal`` (closed: back to the start).

    Degree 2 with continuity 1, degree 3 with 1 or 2, degree 5 with 2, in time: ``durations`` (s) of the curves, 1 each
    without them, or "free": a search picks some with the sum ``total`` (as many seconds as curves without it). Every
    control point, hence every curve, lies in the ball of this ``radius`` about ``centre`` (the origin), in mm, and in
    all ``half_spaces`` (mappings with ``normal`` and ``offset``, or pairs: normal . p >= offset). ``ends``: "free", or
    "zero" for rest; ``velocities``: at the start and at the goal (mm/s), where these are fixed.
    ``objective``: "legs" (sum of the squared legs of all control polygons, mm²), "middle legs" (those between via
    points, as in (7)), "acceleration", "jerk", "snap" (integrals of their squares over time). ``max_length`` (mm, of
    all curves together) and ``max_curvature`` (1/mm) hold for all t; the bound from below is then one for chains with a
    necessary half-space in their place (``accuracy``). Numbers are exact, as for ``bezier.plan``; the arguments are the
    keys of a file of ``bezier chain``.

    Floating point proposes, rational numbers prove. Raises ``InputError`` naming the argument, ``BudgetExceeded`` at a
    limit, and ``Unable`` where neither a chain nor a contradiction could be proved, or no optimum (conditions that
    touch, or nearly).
    """
    given = keyed(locals(), NAMES)
    listed = half_spaces if isinstance(half_spaces, list | tuple) else []
    if any(isinstance(pair, list | tuple) and len(pair) == 2 for pair in listed):
        given["half_space"] = [
            dict(zip(("normal", "offset"), p, strict=False)) if isinstance(p, list | tuple) else p for p in listed
        ]
    asked = read_chain(given_table(given, SOURCE, NAMES))
    return limited(partial(unlimited, partial(planned, asked)), timeout, memory, progress)

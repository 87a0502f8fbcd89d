"""``bezier.route``: start and goal of a scene from Python, joined or separated, with proof."""

from __future__ import annotations

from functools import partial

from bezier.scenes.route import Blocked, Route, decided
from bezier.scenes.scene import Scene, read_scene
from qe import arguments
from qe.options import Budget
from qe.processes.execution import perform
from qe.processes.limits import Limits
from qe.progress import Listener, silent


def route(
    scene: object, *, timeout: float | None = None, memory: int | None = None, progress: Listener = silent
) -> Route | Blocked:
    """A path from start to goal that is clear of all obstacles, or the proof that there is none.

    ``scene``: a mapping or the path of a JSON file with ``domain`` (a box with ``low`` and ``high``), ``start``,
    ``goal`` and ``obstacle``, a list of boxes and balls, in the plane or in space; lengths in one unit, numbers exact.
    Obstacles are closed: where they touch there is no passage. Boxes are decided completely; between balls passages are
    looked for up to a 64th (in space a sixth) of the diameter.

    The result is a ``Route`` with its corners ``points``, or ``Blocked`` with the open sets that separate start and
    goal; ``blocked`` says which, ``certificate`` proves it and ``check()`` verifies it again.

    Raises ``qe.InputError`` naming the entry, ``qe.Unable`` where it is undecided, ``qe.BudgetExceeded`` at a limit.

    >>> import bezier
    >>> wall = {"kind": "box", "low": [4, 0], "high": [6, 5]}
    >>> scene = {"domain": {"low": [0, 0], "high": [10, 10]}, "start": [1, 5], "goal": [9, 5], "obstacle": [wall]}
    >>> print(bezier.route(scene))
    free: a path of 2 segments, clear of all obstacles
    (1, 5) (4, 15/2) (9, 5)
    >>> upper = {"kind": "box", "low": [4, 5], "high": [6, 10]}
    >>> print(bezier.route({**scene, "obstacle": [wall, upper]}))
    blocked: the obstacles and the domain separate start and goal
    """
    given = read_scene(scene, "bezier.route")
    bounds = Limits(arguments.seconds(timeout), arguments.mebibytes(memory), arguments.listener(progress))
    return perform(partial(_decided, given), bounds)


def _decided(given: Scene, budget: Budget) -> Route | Blocked:
    return decided(given, budget)

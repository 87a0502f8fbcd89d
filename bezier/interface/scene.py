"""``bezier.route``: start and goal of a scene from Python, joined or separated, with proof."""

from __future__ import annotations

from functools import partial

from bezier.interface.function import table_value
from bezier.interface.work import limited
from bezier.scenes.route import Blocked, Route, Wish, decided
from bezier.scenes.scene import given_scene
from qe import arguments
from qe.progress import Listener, silent


def route(
    scene: object,
    *,
    shortest: bool = False,
    degree: int = 3,
    continuity: int = 1,
    gap: float | str | None = None,
    timeout: float | None = None,
    memory: int | None = None,
    progress: Listener = silent,
) -> Route | Blocked:
    """A path from start to goal that is clear of all obstacles, or the proof that there is none.

    ``scene``: a mapping or the path of a JSON or TOML file with ``domain``, ``start``, ``goal``, ``obstacle`` (a list)
    and ``margin``, the distance that is kept from obstacles, in the plane or in space; lengths in one unit, numbers
    exact. docs/scenes.md lists the kinds. Obstacles are closed: where they touch there is no passage. The plane is
    decided completely, and polytopes in space; between round bodies in space passages are looked for as far as
    polytopes with 98 sides around them show them.

    ``shortest``: a short chain of curves of this ``degree`` (1: segments), with so many continuous derivatives, and a
    bound ``at_least`` for the length of every path, both proved. ``gap``: as 5% or 0.05, the same, and more ways are
    tried, 64 at most, until it is proved to be longer than the shortest by no more than this; ``longer`` says by what.

    The result is a ``Route`` with its corners ``points``, or ``Blocked`` with the open sets that separate start and
    goal; ``blocked`` says which, ``certificate`` proves it and ``check()`` verifies it again.

    Raises ``qe.InputError`` naming the entry, ``qe.Unable`` where it is undecided, ``qe.BudgetExceeded`` at a limit.

    >>> import bezier
    >>> wall = {"kind": "box", "low": [4, 0], "high": [6, 5]}
    >>> scene = {"domain": {"low": [0, 0], "high": [10, 10]}, "start": [1, 5], "goal": [9, 5], "obstacle": [wall]}
    >>> print(bezier.route(scene))
    free: a path of 2 segments, clear of all obstacles
    (1, 5) (8001/1000, 2501/500) (9, 5)
    >>> upper = {"kind": "box", "low": [4, 5], "high": [6, 10]}
    >>> print(bezier.route({**scene, "obstacle": [wall, upper]}))
    blocked: the obstacles and the domain separate start and goal
    """
    given = given_scene(scene, "bezier.route", table_value)
    short = arguments.flag(shortest, "shortest") or gap is not None
    degree, continuity = arguments.whole(degree, "degree", 5), arguments.whole(continuity, "continuity", 2)
    wish = Wish.of(degree, continuity, gap)
    return limited(partial(decided, given, wish=wish if short else None), timeout, memory, progress)

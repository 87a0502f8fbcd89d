"""``bezier.plan``: the same problems as in TOML files, from Python values."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from bezier.input.toml_table import Table, meant
from bezier.input.values import table_value
from bezier.interface.planned import NoPath, Planned
from bezier.interface.work import Work
from bezier.planner.words import why_not
from bezier.problem import Problem, problem_of
from qe import arguments
from qe.errors import InputError
from qe.processes.limits import Limits
from qe.progress import Listener, silent

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    Point = ArrayLike | Sequence[object]
    """Three numbers: ints, floats, fractions, texts such as "3/4", an array of numpy."""

SOURCE = "bezier.plan"
NAMES = {"obstacle": "obstacles", "half_space": "half_spaces", "timing": "limits"}
"""Keys of the file and what they are called here."""
P = ParamSpec("P")
T = TypeVar("T")


def _in_one_line(function: Callable[P, T]) -> Callable[P, T]:
    """The function with an ``InputError`` for arguments that it does not have or that are missing."""
    known = inspect.signature(function).parameters
    required = [name for name, parameter in known.items() if parameter.default is inspect.Parameter.empty]

    @functools.wraps(function)
    def checked(*given: P.args, **named: P.kwargs) -> T:
        if given:
            raise InputError(f"{SOURCE}: arguments by name expected, {arguments.shown(given[0])} without one found")
        for name in named:
            if name not in known:
                raise InputError(f"{SOURCE}: {name}: no argument of this name{meant(NAMES.get(name, name), known)}")
        for name in required:
            if name not in named:
                raise InputError(f"{SOURCE}: {name}: expected a point of 3 numbers, found no such argument")
        return function(*given, **named)

    return checked


@_in_one_line
def plan(
    *,
    start: Point,
    goal: Point,
    via: Sequence[Point] | ArrayLike | None = None,
    workspace: object = "ball",
    radius: object = "auto",
    method: object = "quadratic",
    obstacles: Sequence[Mapping[str, object]] | None = None,
    limits: Mapping[str, object] | None = None,
    half_spaces: Sequence[Mapping[str, object]] | None = None,
    ratio: object = None,
    join_speed: object = None,
    single: Mapping[str, object] | None = None,
    arm: object = None,
    proofs: bool = False,
    timeout: float | None = None,
    memory: int | None = None,
    progress: Listener = silent,
) -> Planned:
    """A path from ``start`` past the two ``via`` points to ``goal``, planned and proved in exact arithmetic.

    The arguments are the keys of a problem file (docs/planning.md), with the same meanings: ``obstacles`` are its
    ``[[obstacle]]``, ``half_spaces`` its ``[[half_space]]``, ``limits`` its ``[timing]`` (law, duration, max_speed,
    max_acceleration), each a mapping with their keys; ``arm`` names an arm that has to follow the path. Numbers may
    be ints, floats, fractions, decimals, texts such as "3/4" or "sqrt(27)" for the radius, numpy's, SymPy's; a
    float is the decimal number that it prints. Lengths in mm.

    With ``proofs`` every elimination that the plan rests on comes with its derivation (``plan.derivations``), of which
    each step is checked; they are part of ``plan.certificate``, and ``plan.save`` writes them as pages, too.

    With ``timeout`` (seconds) or ``memory`` (MiB) the work runs in a process that is killed at the limit, as for
    ``qe.eliminate``; ``progress`` is told each step.

    Raises ``qe.InputError`` naming the argument, what was expected and what was found; ``NoPath`` with the reason where
    it is proved that no path of this method exists, where no path clear of the obstacles was found, and where the
    motion does not keep its limits or the arm cannot follow it; ``qe.Unable`` where no answer was reached,
    ``qe.BudgetExceeded`` at a limit.
    """
    given = {
        "method": method,
        "workspace": workspace,
        "start": start,
        "via": via,
        "goal": goal,
        "radius": radius,
        "obstacle": obstacles,
        "half_space": half_spaces,
        "timing": limits,
        "ratio": ratio,
        "join_speed": join_speed,
        "single": single,
        "arm": arm,
    }
    bounds = Limits(arguments.seconds(timeout), arguments.mebibytes(memory), arguments.listener(progress))
    work = Work(problem_from(given), bounds, proofs=arguments.flag(proofs, "proofs"))
    planned = Planned(work)
    reason = None if work.shows_path() else why_not(work.plan)
    if reason is not None:
        raise NoPath(reason, planned)
    return planned


def problem_from(given: Mapping[str, object]) -> Problem:
    """The problem of the keys of a problem file, with values of Python; None for a key that is not there."""
    values = {
        key: table_value(value, f"{SOURCE}: {NAMES.get(key, key)}") for key, value in given.items() if value is not None
    }
    return problem_of(Table(values, SOURCE, names=NAMES))

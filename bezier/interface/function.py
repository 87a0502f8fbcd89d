"""``bezier.plan``: the same problems as in TOML files, from Python values.

Values of Python as the values of a table: numbers exactly as they print, arrays and tuples as lists.

A float is the decimal number that it prints: 0.1 is one tenth, also one of numpy in any precision. What is no number,
text, sequence or mapping stays as it is, and the reader of the table says what it expected.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Collection, Mapping, Sequence, Sized
from decimal import Decimal
from enum import Enum
from fractions import Fraction
from numbers import Integral, Rational, Real
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from bezier.input.numbers import MAX_CHARACTERS, NUMBER, Literal
from bezier.input.toml_table import Table, meant
from bezier.interface.planned import NoPath, Planned
from bezier.interface.work import Work
from bezier.planner.words import why_not
from bezier.problem import Problem, new_problem
from qe import arguments
from qe.errors import InputError
from qe.processes.limits import Limits
from qe.progress import Listener, silent

MOST = 10_000
"""Entries of one list or mapping."""
DEEPEST = 8


def table_value(value: Any, place: str, depth: int = 0) -> Any:
    """A value for ``Table``. Raises ``InputError`` for what is too large, too deep, or has keys that are no names."""
    match value:
        case Enum():
            return value.value
        case str():
            return str(value)
        case bool() | Integral():
            return value if isinstance(value, bool) else int(value)
        case Decimal():
            return Literal(str(value).lower())
        case Rational():
            return _fraction(Fraction(int(value.numerator), int(value.denominator)), place)
        case float():
            return Literal(float.__repr__(value))
        case Real():
            return Literal(str(value))
        case Mapping():
            _check_size(value, place, depth)
            return _mapping(value, place, depth)
    kind = getattr(getattr(value, "dtype", None), "kind", "")
    if kind and getattr(value, "ndim", None) == 0:
        scalar = value[()]  # of an array without dimensions; of a scalar, which no case above knows, itself
        again = type(scalar) is not type(value)
        return bool(value) if kind == "b" else table_value(scalar, place, depth) if again else value
    is_bytes = isinstance(value, bytes | bytearray | memoryview)
    if isinstance(value, Collection) and hasattr(value, "__getitem__") and not is_bytes:
        _check_size(value, place, depth)
        return [table_value(entry, f"{place}[{i}]", depth + 1) for i, entry in enumerate(value)]
    return value


def _fraction(value: Fraction, place: str) -> str:
    if max(abs(value.numerator), value.denominator).bit_length() > 4 * MAX_CHARACTERS:
        raise InputError(f"{place}: expected {NUMBER}, found one of more than {MAX_CHARACTERS} digits")
    return str(value)


def _mapping(value: Mapping[Any, Any], place: str, depth: int) -> dict[str, Any]:
    for key in value:
        if not isinstance(key, str):
            raise InputError(f"{place}: expected a mapping from names, found a key that is a {type(key).__name__}")
    return {k: table_value(v, f"{place}.{k}", depth + 1) for k, v in value.items() if v is not None}


def _check_size(value: Sized, place: str, depth: int) -> None:
    if len(value) > MOST:
        raise InputError(f"{place}: expected at most {MOST} entries, found {len(value)}")
    if depth >= DEEPEST:
        raise InputError(f"{place}: expected lists at most {DEEPEST} deep, found deeper ones")


def given_table(given: Mapping[str, Any], source: str, names: Mapping[str, str]) -> Table:
    """The entries that are not None, as a table whose messages call its keys by these ``names``."""
    values = {k: table_value(v, f"{source}: {names.get(k, k)}") for k, v in given.items() if v is not None}
    return Table(values, source, names=names)


def keyed(given: Mapping[str, Any], names: Mapping[str, str]) -> dict[str, Any]:
    """The arguments of a function by the keys that these ``names`` stand for, but those that say how it works."""
    keys = {name: key for key, name in names.items()}
    return {keys.get(k, k): v for k, v in given.items() if k not in ("proofs", "timeout", "memory", "progress")}


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
    ``qe.eliminate``; ``progress`` is notified of each step.

    Raises ``qe.InputError`` naming the argument, what was expected and what was found; ``NoPath`` with the reason where
    it is proved that no path of this method exists, where no path clear of the obstacles was found, and where the
    motion does not keep its limits or the arm cannot follow it; ``qe.Unable`` where no answer was reached,
    ``qe.BudgetExceeded`` at a limit.
    """
    given = keyed(locals(), NAMES)
    bounds = Limits(arguments.seconds(timeout), arguments.mebibytes(memory), arguments.listener(progress))
    work = Work(problem_from(given), bounds, proofs=arguments.flag(proofs, "proofs"))
    planned = Planned(work)
    reason = None if work.shows_path() else why_not(work.plan)
    if reason is not None:
        raise NoPath(reason, planned)
    return planned


def problem_from(given: Mapping[str, object]) -> Problem:
    """The problem of the keys of a problem file, with values of Python; None for a key that is not there."""
    return new_problem(given_table(given, SOURCE, NAMES))

"""What a caller can set, said once: name, type, default, check, meaning, and the option of the command line.

A public function takes some of these classes as its keywords (``**settings: Unpack[…]``); ``with_settings`` gives it
the signature and the documentation in full. Options of commands, settings of the prompt and docs/api.md come from here.
"""

from __future__ import annotations

import functools
import inspect
import re
import textwrap
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import partial
from typing import Annotated, Any, ParamSpec, TypedDict, TypeVar, get_args, get_type_hints

from qe import arguments
from qe.options import Method, Projection, Stage
from qe.progress import Event, silent

P = ParamSpec("P")
Result = TypeVar("Result")
Progress = Callable[[Event], None]
Order = Any
"""``"y, x"``, ``"y x"``, or a list of names or SymPy symbols."""

MOST_WORKERS = 256
"""Processes that one call starts at most."""
_ADDRESS = re.compile(r"(?:[a-z]+://)?[^\s:/]+:[0-9]{1,5}")


@dataclass(frozen=True, slots=True)
class Setting:
    """One thing that a caller can set: what holds without it, its meaning, and a check that returns a value as the
    engine takes it or raises ``InputError``. The meaning up to its first semicolon is what the command line says."""

    default: object
    says: str
    check: Callable[..., Any] = arguments.flag


def _address(value: object, what: str) -> object:
    if value is not None and not _ADDRESS.fullmatch(arguments.text(value, what)):
        raise arguments.wrong(what, "an address such as tcp://host:8786", value)
    return value


_FORMAT = Setting("text", "format of text (qe.io.formats)", lambda value, what: value)  # which its reader checks
_TIMEOUT = Setting(
    None, "seconds, enforced; the work is killed at the limit and says how far it came", arguments.seconds
)
_MEMORY = Setting(None, "MiB of address space, enforced", arguments.mebibytes)
_PROGRESS = Setting(silent, "is called with every event of the work", arguments.listener)
_PROCESS = Setting(True, "False, or the environment variable QE_PROCESS=off, keeps the work in this process")
_CHECK = Setting(
    False,
    "a certificate, verified by the separate checker, where one can be had; if the method makes none, by a "
    "decomposition of the whole formula. Without it only witnesses are proved. A proof that does not end in "
    "time costs the certificate, not the answer (its reason says so)",
)
_DIVISION = Setting(
    False,
    "a quotient x/0 has some unknown value, as in SMT-LIB, instead of none; the formula holds if it does for "
    "a choice of these values",
)
_METHOD = Setting(Method.AUTO, "elimination method, the only one to be used", partial(arguments.member, choices=Method))
_ORDER = Setting(None, "variable order, as in x,y,z", arguments.names)
_PROJECTION = Setting(
    Projection.BROWN_MCCALLUM,
    "operator by which decompositions project; the answers are equivalent",
    partial(arguments.member, choices=Projection),
)
_ROOT_ATOMS = Setting(False, "the answer may have x < root(k, p)")
_WITHOUT = Setting(
    (), "stages of the engine to be left out; to measure what they gain", partial(arguments.members, choices=Stage)
)
_EXPLAIN = Setting(False, "write to stderr how the answer was reached; Answer.explanation has the same text")
_WORKERS = Setting(
    0,
    "processes on this machine for long decompositions; the answer and its certificate are the same as without",
    partial(arguments.whole, most=MOST_WORKERS),
)
_CLUSTER = Setting(None, "Dask scheduler whose workers take part in long decompositions", _address)
_RACE = Setting(
    (),
    "methods side by side, as in auto,cad; the answer is the first one, and which that is may differ from run to run",
    partial(arguments.members, choices=Method),
)
_ANYTIME = Setting(
    False,
    "at the time limit, report where the formula is known to be true, where false, and what is open, as formulas in "
    "the free variables; in Python Answer.partial, with check under a certificate",
)


_ASSUMING = Setting(
    None,
    "conditions taken for granted, as in a > 0 and b > 0; the answer is right where they hold and does not repeat "
    "them, and the certificate states them. A formula without quantifiers, or a list; text is read as format text",
    lambda value, what: value,  # which its reader checks
)
_GENERIC = Setting(
    False,
    "leading coefficients, polynomials in the free variables, may be assumed not to be zero; Answer.generic lists "
    "those that were",
)


class Limited(TypedDict, total=False):
    """The limits of a call, and who hears of it. A single polynomial operation can take long: under limits, and when
    it takes longer than a moment, the work runs in a worker process that can be killed."""

    timeout: Annotated[float | None, _TIMEOUT]
    memory: Annotated[int | None, _MEMORY]
    progress: Annotated[Progress, _PROGRESS]
    process: Annotated[bool, _PROCESS]


class Proved(Limited, total=False):
    """The limits, and whether there is to be a certificate."""

    check: Annotated[bool, _CHECK]


class Assuming(TypedDict, total=False):
    """What is taken for granted."""

    assuming: Annotated[Any, _ASSUMING]


class Read(Assuming, total=False):
    """How text is read, and what is taken for granted."""

    format: Annotated[str, _FORMAT]


class Parametric(Assuming, Limited, total=False):
    """What is taken for granted, and the limits."""


class Optimisation(Assuming, Proved, total=False):
    """What is taken for granted, the limits, and whether there is to be a certificate."""


class Question(Read, Limited, total=False):
    """How text is read, what it says of quotients, and the limits."""

    total_division: Annotated[bool, _DIVISION]


class ProvedBlock(Read, Proved, total=False):
    """How text is read, the limits, and whether there is to be a certificate."""


class ProvedQuestion(Question, Proved, total=False):
    """The same with what text says of quotients."""


class Search(Read, Proved, total=False):
    """How the engine goes about a question."""

    method: Annotated[str | Method, _METHOD]
    order: Annotated[Order, _ORDER]
    projection: Annotated[str | Projection, _PROJECTION]
    root_atoms: Annotated[bool, _ROOT_ATOMS]
    without: Annotated[Iterable[str | Stage] | str | Stage, _WITHOUT]
    explain: Annotated[bool, _EXPLAIN]
    workers: Annotated[int, _WORKERS]
    cluster: Annotated[str | None, _CLUSTER]
    race: Annotated[Iterable[str | Method] | str | Method, _RACE]


class Decision(Search, Question, total=False):
    """How text is read, what it says of quotients, and how the engine goes about it."""


class Elimination(Decision, total=False):
    """The same, and what to do at a limit."""

    anytime: Annotated[bool, _ANYTIME]
    generic: Annotated[bool, _GENERIC]


@functools.cache
def settings_in(kind: type) -> Mapping[str, tuple[Any, Setting]]:
    """The type and the rest of each setting in one of these classes."""
    return {name: get_args(hint) for name, hint in get_type_hints(kind, include_extras=True).items()}


def with_settings(kind: type) -> Callable[[Callable[P, Result]], Callable[P, Result]]:
    """Give a function that ends in ``**settings: Unpack[kind]`` all of them, checked, and their signature."""
    table = settings_in(kind)

    def decorated(function: Callable[P, Result]) -> Callable[P, Result]:
        signature = inspect.signature(function)
        listed = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        names = {*table, *(p.name for p in listed)}

        @functools.wraps(function)
        def called(*args: P.args, **given: P.kwargs) -> Result:
            for name in given:
                if name not in names:
                    raise TypeError(_unexpected(function.__name__, name, names))
            checked = {name: s.check(given.get(name, s.default), what=name) for name, (_, s) in table.items()}
            return function(*args, **{**given, **checked})

        keywords = [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=s.default, annotation=hint)
            for name, (hint, s) in table.items()
        ]
        called.__signature__ = signature.replace(parameters=[*listed, *keywords])  # type: ignore[attr-defined]
        listing = (f"* ``{name}``: {s.says}" for name, (_, s) in table.items())
        fill = partial(textwrap.fill, width=100, subsequent_indent="  ", break_on_hyphens=False)
        meanings = "\n".join(map(fill, listing))
        called.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\nSettings:\n\n{meanings}"
        return called

    return decorated


def _unexpected(function: str, name: str, names: Iterable[str]) -> str:
    near = get_close_matches(name, sorted(names), 1)
    meant = f". Did you mean {near[0]!r}?" if near else ""
    return f"{function}() got an unexpected keyword argument {name!r}{meant}"

"""Results as lines of JSON that are only ever added to: what they hold, how they are written and read.

A file has three kinds of line: an environment (machine, versions, limits) for every session, a result for every run,
and a comparison for every two answers of a problem without a known one. A line that cannot be read is reported with
its number and passed over.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any


class Status(StrEnum):
    """SOLVED: equivalent to the expected answer. PROBED: no difference at many points. UNCOMPARED: no expected
    answer, or in a form that is not compared. UNABLE: the solver gave up. UNSUPPORTED: it was not offered the problem.
    """

    SOLVED = "solved"
    PROBED = "probed"
    UNCOMPARED = "uncompared"
    WRONG = "WRONG"
    UNABLE = "unable"
    UNSUPPORTED = "unsupported"
    TIMEOUT = "timeout"
    MEMORY = "memory"
    CRASH = "crash"


ANSWERED = frozenset((Status.SOLVED, Status.PROBED, Status.UNCOMPARED))


@dataclass(frozen=True, slots=True)
class Result:
    """One run. ``seconds`` is the solver's own time, ``cpu`` the processor time it took, ``wall`` the time of its whole
    process, ``peak`` MiB, ``length`` the number of characters of the whole answer.

    ``repeat`` numbers the repetitions; ``environment`` is the name of a recorded ``Environment``.
    """

    set: str
    solver: str
    id: str
    status: Status
    seconds: float
    wall: float
    limit: float
    answer: str = ""
    message: str = ""
    repeat: int = 0
    size: int | None = None
    peak: float = 0.0
    cpu: float = 0.0
    length: int = 0
    environment: str = ""
    date: str = ""

    def __post_init__(self) -> None:
        status = Status(self.status)
        if status is Status.UNABLE and self.message.startswith("NotSupported"):
            status = Status.UNSUPPORTED
        object.__setattr__(self, "status", status)
        for name in ("seconds", "wall", "limit", "peak", "cpu", "length"):
            if not isinstance(getattr(self, name), int | float):
                raise TypeError(f"{name}: a number expected")

    @property
    def is_solved(self) -> bool:
        """Whether there is an answer that is not known to be wrong."""
        return self.status in ANSWERED

    @property
    def key(self) -> tuple[str, str, str, int]:
        """Results with one key replace each other, the latest wins."""
        return self.set, self.solver, self.id, self.repeat


@dataclass(frozen=True, slots=True)
class Comparison:
    """The answers of two solvers to one problem, compared; ``answers`` is a digest of both texts."""

    set: str
    id: str
    left: str
    right: str
    verdict: str
    answers: str


@dataclass(frozen=True, slots=True)
class BadLine:
    """A line that was passed over."""

    path: Path
    number: int
    reason: str

    def __str__(self) -> str:
        return f"{self.path}:{self.number}: line skipped: {self.reason}"


@dataclass(slots=True)
class Log:
    """What the files hold: the latest of everything that has a key."""

    results: dict[tuple[str, str, str, int], Result] = field(default_factory=dict)
    environments: dict[str, Mapping[str, Any]] = field(default_factory=dict)
    comparisons: dict[tuple[str, str, str, str], Comparison] = field(default_factory=dict)
    bad: list[BadLine] = field(default_factory=list)

    def add(self, record: Mapping[str, Any]) -> None:
        """Add one record. Raises ``KeyError``, ``TypeError`` or ``ValueError`` for anything else."""
        kind = record.get("kind", "result")
        content = {key: value for key, value in record.items() if key != "kind"}
        if kind == "environment":
            self.environments[content["name"]] = content
        elif kind == "comparison":
            item = Comparison(**content)
            self.comparisons[item.set, item.id, item.left, item.right] = item
        elif kind == "result":
            row = Result(**content)
            self.results[row.key] = row
        else:
            raise ValueError(f"unknown kind {kind!r}")


def read_log(paths: Iterable[Path]) -> Log:
    """Read result files; files that do not exist are empty."""
    log = Log()
    for path in paths:
        log.bad += read_records(path, log.add)
    return log


def read_records(path: Path, add: Callable[[Mapping[str, Any]], None]) -> list[BadLine]:
    """Hand every line to ``add``; the lines that are not JSON, or that ``add`` refuses."""
    bad: list[BadLine] = []
    if not path.exists():
        return bad
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), start=1):
        if not line.strip():
            continue
        try:
            add(json.loads(line))
        except json.JSONDecodeError as error:
            bad.append(BadLine(path, number, f"not JSON ({error.msg})"))
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            bad.append(BadLine(path, number, f"not a record ({error})"))
    return bad


class Appender:
    """Adds lines to a file; a line cut off by a kill is ended first, so that it spoils only itself."""

    def __init__(self, path: Path) -> None:
        self.path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a+b") as file:
            if file.tell():
                file.seek(-1, os.SEEK_END)
                if file.read(1) != b"\n":
                    file.write(b"\n")

    def write(self, record: Mapping[str, Any]) -> None:
        """Add one line; it is in the file when this returns."""
        with self.path.open("a") as file:
            file.write(json.dumps(record, ensure_ascii=False) + "\n")

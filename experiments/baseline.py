"""A frozen baseline: what the engine solved at one commit, in how much processor time, and how long its answers were.

A baseline file is JSON lines: an environment, then one line for each problem of the sets ``public``, ``realgeom``
and ``project``, sorted, repetitions combined by the median. Two files are compared problem by problem; answers by
equivalence. Times mean something only between runs of one machine in one hour, whose speed changes within minutes:
``pair`` runs the engines of two trees in turn.
"""

from __future__ import annotations

import json
import statistics
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from experiments.adapters.answer import Limits
from experiments.measures import by_set, combined
from experiments.problem import Problem
from experiments.results import Log, Result, Status
from experiments.runner import LONGEST_ANSWER, Job, compared, run_one
from experiments.solvers import OURS, Solver, adapter
from experiments.suites.corpus import literature, tagged
from qe.errors import InputError

SETS = ("public", "realgeom", "project")
COMPARED = ("public", "hard", "realgeom", "classics", "project")

FLOOR = 1e-3
"""Seconds below which processor times are not told apart."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One problem: ``cpu`` in seconds, ``length`` in characters; ``limit`` counts twice where it is not solved."""

    set: str
    id: str
    status: Status
    cpu: float
    limit: float
    length: int
    answer: str

    @property
    def key(self) -> tuple[str, str]:
        """The problem's set and name."""
        return self.set, self.id

    @property
    def is_solved(self) -> bool:
        """Whether the answer is known, or not known to be wrong."""
        return self.status in (Status.SOLVED, Status.PROBED, Status.UNCOMPARED)

    @property
    def cost(self) -> float:
        """Seconds of PAR-2: the time, or twice the limit where there is no answer."""
        return self.cpu if self.is_solved else 2 * self.limit


def problems(only: str = "") -> list[Problem]:
    """The problems of a baseline. Raises ``InputError`` where the literature sets are absent."""
    return [p for p in [*literature(), *tagged("classics")] if p.set in SETS and only in f"{p.set} {p.id}"]


def pair(
    problem: Problem, trees: tuple[Path, Path], limits: Limits, *, repeat: int, show: Callable[[str], None] = print
) -> tuple[Entry, Entry]:
    """One problem by the engines of two trees in turn, ``repeat`` times each, with the median of each; a line of it."""
    sides = [Solver(name, adapter(OURS), tree) for name, tree in zip(("old", "new"), trees, strict=True)]
    rows: dict[str, list[Result]] = {side.name: [] for side in sides}
    for k in range(repeat):
        for side in sides:
            rows[side.name].append(run_one(Job(problem, side, k), limits))
    old, new = (_entry(combined(found), found) for found in rows.values())
    show(
        f"{problem.set} {problem.id}: {old.status} {old.cpu:.3f} s, {new.status} {new.cpu:.3f} s, "
        f"ratio {max(new.cpu, FLOOR) / max(old.cpu, FLOOR):.2f}, {old.length} to {new.length} characters"
    )
    return old, new


def slowed(pairs: Iterable[tuple[Entry, Entry]]) -> list[tuple[Entry, Entry]]:
    """The pairs that both engines solved, those first that lost most seconds."""
    both = [(old, new) for old, new in pairs if old.is_solved and new.is_solved and new.cpu > old.cpu]
    return sorted(both, key=lambda p: p[0].cpu - p[1].cpu)


def entries(log: Log) -> list[Entry]:
    """What a log says of our engine on the sets of a baseline, sorted; the median repetition of each problem."""
    found = [
        _entry(row, [r for r in log.results.values() if (r.set, r.solver, r.id) == (row.set, row.solver, row.id)])
        for name, table in by_set(log).items()
        if name in SETS
        for row in table.get(OURS, {}).values()
    ]
    return sorted(found, key=lambda entry: entry.key)


def _entry(row: Result, same: Iterable[Result]) -> Entry:
    """A problem with the median processor time of its repetitions."""
    cpu = round(statistics.median([r.cpu for r in same]), 4)
    return Entry(row.set, row.id, row.status, cpu, row.limit, row.length, row.answer)


def write(path: Path, found: Sequence[Entry], environment: Mapping[str, Any]) -> None:
    """Write a baseline file. Raises ``InputError`` rather than write one without problems."""
    if not found:
        raise InputError("a baseline needs results: none were found")
    lines = [dict(environment)]
    lines += [
        {"set": e.set, "id": e.id, "status": e.status.value, "cpu": e.cpu, "limit": e.limit, "length": e.length}
        | {"answer": e.answer}
        for e in found
    ]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(json.dumps(line, ensure_ascii=False) + "\n" for line in lines))


def read(path: Path) -> list[Entry]:
    """Read a baseline file. Raises ``InputError`` for anything else."""
    try:
        records = [json.loads(line) for line in path.read_text().splitlines()]
        return [Entry(**{**r, "status": Status(r["status"])}) for r in records if r.get("kind") != "environment"]
    except (OSError, ValueError, TypeError, KeyError, AttributeError) as error:
        raise InputError(f"{path}: a baseline file expected ({error})") from None


@dataclass(frozen=True, slots=True)
class Change:
    """What changed on one set. ``ratio`` is the median of (new / old) processor times where both solved."""

    set: str
    problems: int
    lost: tuple[str, ...]
    won: tuple[str, ...]
    par2: tuple[float, float]
    median: tuple[float, float]
    ratio: float
    length: tuple[int, int]
    longer: tuple[str, ...]


def changes(old: Iterable[Entry], new: Iterable[Entry]) -> list[Change]:
    """One line for each set, over the problems that both files hold."""
    before, after = ({e.key: e for e in listed} for listed in (old, new))
    pairs = [(before[key], after[key]) for key in before if key in after]
    names = [name for name in COMPARED if any(p[0].set == name for p in pairs)]
    return [_change(name, [p for p in pairs if p[0].set == name]) for name in names]


def _change(name: str, pairs: Sequence[tuple[Entry, Entry]]) -> Change:
    both = [(a, b) for a, b in pairs if a.is_solved and b.is_solved]
    ratios = [max(b.cpu, FLOOR) / max(a.cpu, FLOOR) for a, b in both]
    return Change(
        name,
        len(pairs),
        tuple(a.id for a, b in pairs if a.is_solved and not b.is_solved),
        tuple(a.id for a, b in pairs if b.is_solved and not a.is_solved),
        (sum(a.cost for a, _ in pairs), sum(b.cost for _, b in pairs)),
        (statistics.median([a.cpu for a, _ in both] or [0.0]), statistics.median([b.cpu for _, b in both] or [0.0])),
        statistics.median(ratios or [1.0]),
        (sum(a.length for a, _ in both), sum(b.length for _, b in both)),
        tuple(a.id for a, b in both if b.length > a.length),
    )


def different(
    old: Iterable[Entry], new: Iterable[Entry], *, memory: int, known: Iterable[Problem] | None = None
) -> Iterator[tuple[Entry, Entry, str]]:
    """Problems whose answers are not proved equivalent, with the word of the comparison; cut answers are left out.

    ``known``: the problems, for their assumptions; by default those of a baseline.
    """
    assumed = {(p.set, p.id): p.assume for p in (problems() if known is None else known)}
    after = {e.key: e for e in new}
    for entry in old:
        other = after.get(entry.key)
        if other is None or not (entry.is_solved and other.is_solved) or entry.answer == other.answer:
            continue
        if max(entry.length, other.length) > LONGEST_ANSWER:
            yield entry, other, "cut"
            continue
        word = compared(entry.answer, other.answer, assumed.get(entry.key), memory)
        if word != "equivalent":
            yield entry, other, word


def lines(found: Iterable[Change]) -> Iterator[str]:
    """The changes for people."""
    for c in found:
        yield (
            f"{c.set}: {c.problems} problems, lost {len(c.lost)}, won {len(c.won)}, "
            f"PAR-2 {c.par2[0]:.2f} s to {c.par2[1]:.2f} s, median {c.median[0]:.4f} s to {c.median[1]:.4f} s, "
            f"median ratio {c.ratio:.3f}, answers {c.length[0]} to {c.length[1]} characters"
        )
        for word, names in (("lost", c.lost), ("won", c.won), ("longer", c.longer)):
            if names:
                yield f"  {word}: {', '.join(names)}"

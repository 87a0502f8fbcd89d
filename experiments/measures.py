"""What the tables and figures say, computed from results alone: medians, PAR-2, growth."""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from experiments.results import Log, Result, Status
from experiments.solvers import NAMES, OURS, WITHOUT

FASTEST = 1e-3
"""Seconds below which times are not told apart."""

Table = Mapping[str, Mapping[str, Result]]
"""Solver to problem to result, for one set."""


def combined(rows: Sequence[Result]) -> Result:
    """One result for the repetitions of a run: wrong if any is, else the median of the larger part."""
    for row in rows:
        if row.status is Status.WRONG:
            return row
    solved = [r for r in rows if r.is_solved]
    part = solved if 2 * len(solved) > len(rows) else [r for r in rows if not r.is_solved]
    return sorted(part, key=lambda r: r.seconds)[(len(part) - 1) // 2]


def by_set(log: Log) -> dict[str, dict[str, dict[str, Result]]]:
    """Set to solver to problem to result; repetitions combined, solvers in the order of ``NAMES``."""
    groups: dict[tuple[str, str, str], list[Result]] = {}
    for row in log.results.values():
        groups.setdefault((row.set, row.solver, row.id), []).append(row)
    found: dict[str, dict[str, dict[str, Result]]] = {}
    for set_name, solver, id in sorted(groups, key=lambda key: (key[0], place(key[1]))):
        found.setdefault(set_name, {}).setdefault(solver, {})[id] = combined(groups[set_name, solver, id])
    return found


def by_group(log: Log) -> dict[str, dict[str, dict[str, Result]]]:
    """The same with the families of one suite together: what stands before the slash in the name of a set."""
    found: dict[str, dict[str, dict[str, Result]]] = {}
    for name, table in by_set(log).items():
        group = found.setdefault(name.partition("/")[0], {})
        for solver, rows in table.items():
            group.setdefault(solver, {}).update({f"{name}/{id}": row for id, row in rows.items()})
    return {group: {s: table[s] for s in sorted(table, key=place)} for group, table in found.items()}


def place(solver: str) -> tuple[int, str]:
    """Solvers stand in the order of ``NAMES``, others after them."""
    return (NAMES.index(solver) if solver in NAMES else len(NAMES)), solver


def offered(rows: Mapping[str, Result]) -> list[Result]:
    """The results of problems that the solver takes at all."""
    return [r for r in rows.values() if r.status is not Status.UNSUPPORTED]


def par2(rows: Iterable[Result]) -> float:
    """Seconds, where an unsolved problem counts with twice its limit."""
    return sum(r.seconds if r.is_solved else 2 * r.limit for r in rows)


def median(values: Iterable[float]) -> float | None:
    """The median, None of nothing."""
    known = list(values)
    return statistics.median(known) if known else None


def median_ratio(mine: Mapping[str, Result], other: Mapping[str, Result]) -> float | None:
    """The median of (other's time / my time) over the problems that both solved."""
    common = [(mine[i], row) for i, row in other.items() if i in mine and row.is_solved and mine[i].is_solved]
    return median(max(b.seconds, FASTEST) / max(a.seconds, FASTEST) for a, b in common)


def solved_over_time(rows: Iterable[Result]) -> list[float]:
    """The times of the solved problems, sorted: element k-1 is the time within which k are solved one by one."""
    return sorted(max(r.seconds, FASTEST) for r in rows if r.is_solved)


def wrong_answers(log: Log) -> list[Result]:
    """Results that are not equivalent to the expected answer."""
    return [r for r in log.results.values() if r.status is Status.WRONG]


@dataclass(frozen=True, slots=True)
class Growth:
    """Time = c * size^exponent, or c * base^size, fitted by least squares on logarithms; R^2 of each."""

    exponent: float
    exponent_fit: float
    base: float
    base_fit: float


def growth(points: Sequence[tuple[float, float]]) -> Growth | None:
    """The growth of (size, seconds); None for fewer than three sizes."""
    if len({size for size, _ in points}) < 3:
        return None
    times = [math.log(max(seconds, FASTEST)) for _, seconds in points]
    power = _line([math.log(size) for size, _ in points], times)
    geometric = _line([float(size) for size, _ in points], times)
    return Growth(power[0], power[1], math.exp(geometric[0]), geometric[1])


def _line(xs: Sequence[float], ys: Sequence[float]) -> tuple[float, float]:
    """(slope, R^2) of the least squares line."""
    fit = statistics.linear_regression(xs, ys)
    mean = statistics.fmean(ys)
    total = sum((y - mean) ** 2 for y in ys)
    rest = sum((y - fit.intercept - fit.slope * x) ** 2 for x, y in zip(xs, ys, strict=True))
    return fit.slope, 1.0 if total == 0 else 1 - rest / total


def scaling_points(rows: Mapping[str, Result]) -> list[tuple[int, float]]:
    """(size, seconds) of the solved problems of a family, by size."""
    return sorted((r.size, r.seconds) for r in rows.values() if r.size is not None and r.is_solved)


@dataclass(frozen=True, slots=True)
class Gain:
    """What a stage of the engine is worth on the problems that ran with and without it."""

    stage: str
    problems: int
    lost: int
    median_ratio: float | None
    worst_ratio: float | None
    seconds_with: float
    seconds_without: float


def gains(tables: Iterable[Table]) -> list[Gain]:
    """One line per stage, over all sets; ``lost`` counts problems that only the whole engine solves."""
    pairs: dict[str, list[tuple[Result, Result]]] = {}
    for table in tables:
        for solver, rows in table.items():
            if solver.startswith(WITHOUT):
                whole = table.get(OURS, {})
                pairs.setdefault(solver, []).extend((whole[i], row) for i, row in rows.items() if i in whole)
    return [_gain(solver.removeprefix(WITHOUT), found) for solver, found in pairs.items() if found]


def _gain(stage: str, pairs: Sequence[tuple[Result, Result]]) -> Gain:
    both = [max(b.seconds, FASTEST) / max(a.seconds, FASTEST) for a, b in pairs if a.is_solved and b.is_solved]
    lost = sum(a.is_solved and not b.is_solved for a, b in pairs)
    return Gain(
        stage,
        len(pairs),
        lost,
        median(both),
        max(both, default=None),
        par2(a for a, _ in pairs),
        par2(b for _, b in pairs),
    )

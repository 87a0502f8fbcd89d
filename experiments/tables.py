"""The page of tables, benchmarks.md, from result files alone."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from experiments import measures
from experiments.results import Log, Result, Status
from experiments.solvers import OURS, WITHOUT
from experiments.suites.corpus import timing_ids

HEADER = """# Benchmarks

Made by `experiments report` from the results of runs, which renews the page.

Every solver runs in a process group of its own under the same limits on time and memory, in random order. `seconds` is
solving time in the process after import and a trivial warm-up problem (QEPCAD and Yices: their whole process).
*wrong* counts answers that are not equivalent to the expected one. *unable* counts everything else without an
answer: out of time or memory, given up, crash; problems that a solver does not take (the SMT solvers decide sentences
only) are not counted. PAR-2 counts an unsolved problem with twice the limit. *ratio* is the median of (solver's
time / our time) over the problems both solved. Answers are compared by equivalence (z3; at rational points where z3
does not decide); *compared* leaves out answers without a known expected answer and those in a form that is not
compared; where several solvers answered such a problem, their answers are compared with each other.
"""

COLUMNS = (
    "solver",
    "problems",
    "solved",
    "compared",
    "wrong",
    "unable",
    "PAR-2 (s)",
    "median (s)",
    "slowest (s)",
    "ratio",
)


def page(log: Log, pictures: Sequence[tuple[str, str]] = ()) -> str:
    """The whole page; ``pictures`` are (caption, address)."""
    sets = measures.by_set(log)
    parts = [HEADER, wrong_answers(log), disagreements(log), environments(log)]
    parts += [f"![{caption}]({address})\n" for caption, address in pictures]
    parts += [set_table(name, without_ablation(table)) for name, table in measures.by_group(log).items()]
    parts += [family_medians(sets), scaling_table(sets), ablation_table(sets), problem_table(sets.get("project", {}))]
    return "\n".join(part for part in parts if part)


def without_ablation(table: measures.Table) -> measures.Table:
    """The solvers that are not our engine with a stage left out."""
    return {solver: rows for solver, rows in table.items() if not solver.startswith(WITHOUT)}


def markdown(heading: str, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A section with a table; empty without rows."""
    lines = [f"| {' | '.join(_cell(c) for c in row)} |" for row in rows]
    if not lines:
        return ""
    return "\n".join([f"## {heading}\n", f"| {' | '.join(columns)} |", "|---" * len(columns) + "|", *lines]) + "\n"


def _cell(value: object) -> str:
    if value is None:
        return ""
    return f"{value:.3g}" if isinstance(value, float) else str(value).replace("|", "\\|")


def wrong_answers(log: Log) -> str:
    """The headline."""
    wrong = measures.wrong_answers(log)
    if not wrong:
        return "**No wrong answer** among the compared ones.\n"
    rows = [(r.solver, r.set, r.id, r.environment or "not recorded", r.answer[:80]) for r in wrong]
    return markdown("WRONG ANSWERS", ("solver", "set", "problem", "environment", "answer"), rows)


def disagreements(log: Log) -> str:
    """Two solvers gave different answers to a problem without a known one: at least one is wrong."""
    rows = [(c.left, c.right, c.set, c.id) for c in log.comparisons.values() if c.verdict == "different"]
    return markdown("Disagreements", ("solver", "other solver", "set", "problem"), rows)


def environments(log: Log) -> str:
    """Machine, date and versions behind the numbers."""
    used: dict[str, int] = {}
    for row in log.results.values():
        used[row.environment] = used.get(row.environment, 0) + 1
    rows = []
    for name, count in sorted(used.items()):
        e = log.environments.get(name, {})
        versions = ", ".join(f"{k} {v}" for k, v in e.get("versions", {}).items() if v != "not installed")
        machine = f"{e['processors']} x {e['machine']}, {e['memory_mib']} MiB, {e['system']}" if e else "not recorded"
        limits = f"{e['limit']} s, {e['memory']} MiB" if "limit" in e else ""
        software = f"Python {e['python']}, {versions}" if e else ""
        rows.append((name or "-", count, e.get("date"), machine, e.get("commit"), limits, software))
    return markdown("Environments", ("name", "runs", "date", "machine", "commit", "limits", "versions"), rows)


def set_table(name: str, table: measures.Table) -> str:
    """A row per solver."""
    mine = table.get(OURS, {})
    rows = [_solver_row(solver, found, mine) for solver, found in table.items() if measures.offered(found)]
    return markdown(name, COLUMNS, rows)


def _solver_row(solver: str, found: Mapping[str, Result], mine: Mapping[str, Result]) -> Sequence[object]:
    rows = measures.offered(found)
    solved = [r for r in rows if r.is_solved]
    wrong = sum(r.status is Status.WRONG for r in rows)
    compared = sum(r.status in (Status.SOLVED, Status.PROBED, Status.WRONG) for r in rows)
    times = [r.seconds for r in solved]
    ratio = None if solver == OURS else measures.median_ratio(mine, found)
    unable = len(rows) - len(solved) - wrong
    slowest = max(times, default=None)
    par2 = round(measures.par2(rows))
    return solver, len(rows), len(solved), compared, wrong, unable, par2, measures.median(times), slowest, ratio


def _solvers(sets: Mapping[str, measures.Table]) -> list[str]:
    present = {solver for table in sets.values() for solver in without_ablation(table)}
    return sorted(present, key=measures.place)


def family_medians(sets: Mapping[str, measures.Table]) -> str:
    """The median seconds of what each solver solved, per family."""
    solvers = _solvers(sets)

    def cell(rows: Mapping[str, Result]) -> str:
        solved = [r.seconds for r in rows.values() if r.is_solved]
        offered = measures.offered(rows)
        return f"{measures.median(solved):.3g} ({len(solved)}/{len(offered)})" if solved else "-" if offered else ""

    rows = [(name, *(cell(table.get(solver, {})) for solver in solvers)) for name, table in sets.items()]
    return markdown("Median seconds per family (solved/offered)", ("family", *solvers), rows)


def scaling_table(sets: Mapping[str, measures.Table]) -> str:
    """Fitted growth of the families with a size."""
    rows = []
    for name, table in sets.items():
        for solver, found in without_ablation(table).items():
            points = measures.scaling_points(found)
            fit = measures.growth(points)
            if fit is not None:
                sizes = f"{points[0][0]}…{points[-1][0]}"
                times = f"{points[0][1]:.3g}…{points[-1][1]:.3g}"
                row = (fit.exponent, fit.exponent_fit, fit.base, fit.base_fit)
                rows.append((name, solver, sizes, times, *row))
    columns = ("family", "solver", "sizes", "seconds", "size^e: e", "R²", "b^size: b", "R²")
    return markdown("Growth", columns, rows)


def ablation_table(sets: Mapping[str, measures.Table]) -> str:
    """What each stage of the engine is worth."""
    rows = [
        (g.stage, g.problems, g.lost, g.median_ratio, g.worst_ratio, round(g.seconds_with), round(g.seconds_without))
        for g in measures.gains(sets.values())
    ]
    columns = ("left out", "problems", "lost", "median ratio", "largest ratio", "PAR-2 with", "PAR-2 without")
    return markdown("Stages of the engine left out, one at a time", columns, rows)


def problem_table(table: measures.Table) -> str:
    """Seconds per problem of the project's corpus on which systems are timed."""
    shown = without_ablation(table)

    def cell(row: Result | None) -> str:
        if row is None or row.status is Status.UNSUPPORTED:
            return ""
        return f"{row.seconds:.3f}" if row.is_solved else row.status.value

    rows = [(i, *(cell(found.get(i)) for found in shown.values())) for i in timing_ids()] if shown else []
    return markdown("project, problem by problem (seconds)", ("problem", *shown), rows)

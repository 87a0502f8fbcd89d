"""Run problem sets through solvers, compare the answers with the expected ones, and write the table.

``python -m experiments.corpus_run run --set project --solver ours`` appends one JSON line per problem to
``out/corpus.jsonl`` (what is there already is not run again without ``--again``); ``python -m experiments.corpus_run
table`` writes ``docs/benchmarks.md`` from that file. Every solver works in a process group of its own with limits
on time and memory, and the whole group is ended afterwards. The literature sets are read from the folder
``shared/corpora`` beside the project where it is present.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import resource
import signal
import subprocess
import sys
import time
import tomllib
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "out" / "corpus.jsonl"
LITERATURE = ROOT.parent / "shared" / "corpora"
START_UP = 3.0  # seconds granted on top of the limit for starting an interpreter and importing a solver
SOLVERS = ("ours", "qepcad", "sympy-extras", "semialg", "z3")


@dataclass(frozen=True, slots=True)
class Problem:
    """One problem of a set; texts in the text syntax."""

    set: str
    id: str
    formula: str
    expected: str | None
    assume: str | None = None


@dataclass(frozen=True, slots=True)
class Result:
    """One run. ``status``: solved, probed (solved, compared at points only), uncompared (no expected answer, or an
    answer in a form that is not compared), WRONG, unable, timeout, memory, crash. ``seconds`` is the solver's own
    time, ``wall`` that of its whole process."""

    set: str
    solver: str
    id: str
    status: str
    seconds: float
    wall: float
    limit: float
    answer: str = ""
    message: str = ""

    @property
    def is_solved(self) -> bool:
        return self.status in ("solved", "probed", "uncompared")


def project_problems() -> list[Problem]:
    """The project's own corpus."""
    found = []
    for path in sorted((ROOT / "tests" / "corpus").glob("*.toml")):
        for record in tomllib.loads(path.read_text())["problem"]:
            found.append(Problem("project", record["id"], record["formula"], record["expected"], record.get("assume")))
    return found


def literature_problems(name: str) -> list[Problem]:
    """A literature set: ``public``, ``realgeom`` or ``classics``."""
    file = {"public": "public.jsonl", "realgeom": "timed_realgeom.jsonl", "classics": "classics.json"}[name]
    text = (LITERATURE / file).read_text()
    if name == "classics":
        records = json.loads(text)["problems"]
        return [Problem(name, r["name"], r["formula"], r.get("expected")) for r in records]
    lines = [json.loads(line) for line in text.splitlines() if line.strip()]
    return [Problem(name, r["id"], r["formula"], r.get("expected"), _round_brackets(r.get("assume"))) for r in lines]


def _round_brackets(text: str | None) -> str | None:
    """Assumptions are stated in QEPCAD's square brackets."""
    return None if text is None else text.replace("[", "(").replace("]", ")")


def problems(name: str) -> list[Problem]:
    """The problems of a set by its name."""
    return project_problems() if name == "project" else literature_problems(name)


def limited(
    command: list[str], task: dict[str, object], seconds: float, memory: int
) -> tuple[int | None, str, str, float]:
    """(exit status or None after a time-out, stdout, stderr, wall time) of a child in its own process group."""

    def cap() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (memory << 20, memory << 20))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    start = time.perf_counter()
    child = subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        start_new_session=True,
        preexec_fn=cap,
    )
    status: int | None = None
    try:
        out, err = child.communicate(json.dumps(task), timeout=seconds)
        status = child.returncode
    except subprocess.TimeoutExpired:
        out, err = "", ""
    finally:
        wall = time.perf_counter() - start
        with contextlib.suppress(ProcessLookupError):  # also ends what the solver left behind
            os.killpg(child.pid, signal.SIGKILL)
    if status is None:
        child.communicate()
    return status, out, err, wall


def run_one(problem: Problem, solver: str, limit: float, memory: int) -> Result:
    """Solve and compare one problem."""
    task: dict[str, object] = {"formula": problem.formula, "limit": limit}
    command = [sys.executable, "-m", "experiments.adapters", solver]
    code, out, err, wall = limited(command, task, limit + START_UP, memory)

    def result(status: str, seconds: float, answer: str = "", message: str = "") -> Result:
        return Result(
            problem.set,
            solver,
            problem.id,
            status,
            round(seconds, 4),
            round(wall, 3),
            limit,
            answer[:4000],
            message[-300:],
        )

    if code is None:
        return result("timeout", wall)
    lines = [line for line in out.splitlines() if line.startswith("{")]
    if code != 0 or not lines:
        last = (err.strip().splitlines() or [""])[-1]
        return result(
            "memory" if "MemoryError" in err or "memory" in last.lower() else "crash",
            wall,
            message=f"exit {code}: {last}",
        )
    report = json.loads(lines[-1])
    if report["status"] != "solved":
        form = "NotSupported: answer with" in report["message"]
        return result("uncompared" if form else "unable", report["seconds"], message=report["message"])
    if report["seconds"] > limit:
        return result("timeout", report["seconds"], report["answer"])
    return result(verdict(problem, report["answer"], memory), report["seconds"], report["answer"])


def verdict(problem: Problem, answer: str, memory: int) -> str:
    """The status of an answer after comparison with the expected one."""
    if problem.expected is None:
        return "uncompared"
    task: dict[str, object] = {"answer": answer, "expected": problem.expected, "assume": problem.assume}
    code, out, _, _ = limited([sys.executable, "-m", "experiments.compare"], task, 60.0, memory)
    if code is None:
        return "probed" if answer else "uncompared"
    return {"equivalent": "solved", "probed": "probed", "different": "WRONG"}.get(out.strip(), "uncompared")


def load(path: Path = RESULTS) -> dict[tuple[str, str, str], Result]:
    """The latest result of every (set, solver, id)."""
    found = {}
    if path.exists():
        for line in path.read_text().splitlines():
            row = Result(**json.loads(line))
            found[row.set, row.solver, row.id] = row
    return found


def run(options: argparse.Namespace) -> None:
    """Run the chosen sets through the chosen solvers, appending results as they come."""
    done = load() if not options.again else {}
    RESULTS.parent.mkdir(exist_ok=True)
    for name in options.set:
        for solver in options.solver:
            todo = [p for p in problems(name) if (options.only or "") in p.id and (name, solver, p.id) not in done]
            rows = []
            with ThreadPoolExecutor(options.jobs) as pool, RESULTS.open("a") as file:
                for row in pool.map(lambda p, s=solver: run_one(p, s, options.limit, options.memory), todo):
                    rows.append(row)
                    file.write(json.dumps(asdict(row)) + "\n")
                    file.flush()
                    print(
                        f"{row.status:<10} {row.seconds:8.3f} s  {solver:<12} {row.id}  {row.message[:80]}", flush=True
                    )
            print(f"{name} {solver}: {summary(rows)}", flush=True)


def summary(rows: Iterable[Result]) -> str:
    """One line: counts and PAR-2 (unsolved problems count twice the limit)."""
    rows = list(rows)
    wrong = [r.id for r in rows if r.status == "WRONG"]
    return (
        f"solved {sum(r.is_solved for r in rows)} of {len(rows)}, wrong {len(wrong)} {wrong}, "
        f"PAR-2 {sum(r.seconds if r.is_solved else 2 * r.limit for r in rows):.0f} s"
    )


def write_table(options: argparse.Namespace) -> None:
    """Write docs/benchmarks.md from the results."""
    from experiments.corpus_table import page

    target = ROOT / "docs" / "benchmarks.md"
    target.write_text(page(load()))
    print(f"{target} written")


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    commands = parser.add_subparsers(required=True)
    runner = commands.add_parser("run")
    runner.add_argument("--set", action="append", choices=["project", "public", "realgeom", "classics"], required=True)
    runner.add_argument("--solver", action="append", choices=SOLVERS, required=True)
    runner.add_argument("--limit", type=float, default=15.0, help="seconds")
    runner.add_argument("--memory", type=int, default=2048, help="MiB")
    runner.add_argument("--jobs", type=int, default=1)
    runner.add_argument("--only", help="problems whose id contains this")
    runner.add_argument("--again", action="store_true", help="run again what has a result already")
    runner.set_defaults(action=run)
    writer = commands.add_parser("table")
    writer.set_defaults(action=write_table)
    options = parser.parse_args()
    options.action(options)


if __name__ == "__main__":
    main()

"""The benchmark: medians of five runs in one process after import, each figure asked beside the one reached.

Run it with ``make bench``. Nothing here is a test; a figure that is not reached is printed as such. When QEPCAD
is installed (Debian package ``qepcad``), its whole-process time on the same problem stands beside ours.
"""

from __future__ import annotations

import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from bezier.methods.quadratic import formula as quadratic
from bezier.problem import read_problem
from experiments.adapters import qepcad
from experiments.limits import run_limited
from qe.io import formats

ROOT = Path(__file__).resolve().parent.parent
BIN = Path(sys.executable).parent
REPEAT = 5
QEPCAD_LIMIT, QEPCAD_MEMORY = 20.0, 4096

GIVEN = """\
method = "{}"
via = [[-1, 3, 3], [1, 3, 3]]
start = [-4, 1, 1]
goal = [4, 1, 1]
radius = "sqrt(27)"
"""
"""The instance of formulas (8) and (7), by the method; z3 and cvc5 do not answer the latter."""


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the table: seconds (or MiB) asked and reached."""

    name: str
    asked: float
    reached: float
    unit: str = "s"
    note: str = ""

    def __str__(self) -> str:
        def show(value: float) -> str:
            if self.unit != "s":
                return f"{value:.0f} {self.unit}"
            return f"{value * 1000:.1f} ms" if value < 1 else f"{value:.2f} s"

        mark = "ok  " if self.reached <= self.asked else "OVER"
        return f"{mark} {self.name:<46} asked {show(self.asked):>9}   reached {show(self.reached):>9}   {self.note}"


def median(work: Callable[[], object]) -> float:
    """Median seconds of five runs."""
    times = []
    for _ in range(REPEAT):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def engine_rows() -> list[Row]:
    """Everything that runs in this process."""
    import qe

    system = quadratic.system(read_problem(GIVEN.format("quadratic")))
    printed, symbolic = str(system.statement()), str(quadratic.SHAPE.symbolic())
    balls, objective = str(system.in_free_points()), str(system.objective())
    region = qe.region(balls)
    optimum = qe.minimize(objective, balls, method="convex")
    closed, one_free = (f"ex {', '.join(names)}. {balls}" for names in (quadratic.FREE, quadratic.FREE[1:]))
    with_certificate = median(lambda: qe.region(balls).certificate.to_json())
    alone = median(lambda: qe.region(balls))
    return [
        Row("(8) as printed", 0.020, median(lambda: qe.eliminate(printed)), note=qepcad_note(printed)),
        Row("(8) with symbolic points", 0.060, median(lambda: qe.eliminate(symbolic))),
        Row("three balls, all existential", 0.020, median(lambda: qe.eliminate(closed)), note=qepcad_note(closed)),
        Row("three balls, x free", 0.050, median(lambda: qe.eliminate(one_free)), note=qepcad_note(one_free)),
        Row("region of three balls", 0.150, alone, note=f"{len(region.cells)} cells"),
        Row("  its certificate, on top", 0.050, max(0.0, with_certificate - alone)),
        Row("  its verification", 0.300, median(lambda: qe.verify(region.certificate))),
        Row(
            "optimum with certificate",
            0.050,
            median(lambda: qe.minimize(objective, balls, method="convex").certificate),
        ),
        Row("  its verification", 0.050, median(lambda: qe.verify(optimum.certificate))),
    ]


def process_rows() -> list[Row]:
    """Whole processes: the import, and the plan with and without pictures."""

    def imported() -> float:
        code = "import time; t = time.perf_counter(); import qe; print(time.perf_counter() - t)"
        return float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)

    def short_command() -> float:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([str(BIN / "qe"), "eliminate", "x > 0"], capture_output=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    with tempfile.TemporaryDirectory() as folder:
        peaks = [resource.getrusage(resource.RUSAGE_SELF).ru_maxrss]

        def plan(*options: str) -> Callable[[], object]:
            problem = str(ROOT / "examples" / "three_balls.toml")
            command = [str(BIN / "bezier"), "plan", problem, "--out", os.path.join(folder, "out"), *options]
            return lambda: peaks.append(peak_kib(command))

        pictures, bare = median(plan()), median(plan("--no-plots"))
    return [
        Row("import qe", 0.150, statistics.median(imported() for _ in range(REPEAT))),
        Row("qe eliminate 'x > 0', processor time", 0.350, statistics.median(short_command() for _ in range(REPEAT))),
        Row("bezier plan, whole process", 6.0, pictures),
        Row("bezier plan --no-plots, whole process", 1.5, bare),
        Row("peak memory of any of these", 400, max(peaks) / 1024, unit="MiB"),
    ]


def peak_kib(command: list[str]) -> int:
    """Run a command that must succeed; the peak of its resident memory."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) != 0:
        raise subprocess.CalledProcessError(status, command)
    return usage.ru_maxrss


def qepcad_note(formula: str) -> str:
    """QEPCAD's whole-process seconds on a formula, or why there are none."""
    if not (shutil.which("qepcad") and Path(qepcad.HOME).is_dir()):
        return "QEPCAD not installed"
    run = run_limited(
        ["env", f"qe={qepcad.HOME}", "qepcad", "+N20000000"],
        formats.write(formats.read(formula, "text", source="<bench>"), "qepcad"),
        seconds=QEPCAD_LIMIT,
        memory=QEPCAD_MEMORY,
    )
    solved = "equivalent quantifier-free" in run.out
    return f"QEPCAD {run.wall:.2f} s" if solved else f"QEPCAD > {QEPCAD_LIMIT:.0f} s"


def main() -> None:
    """Print the table."""
    print(f"medians of {REPEAT}; in-process figures after import")
    for rows in (engine_rows, process_rows):
        for row in rows():
            print(row, flush=True)


if __name__ == "__main__":
    main()

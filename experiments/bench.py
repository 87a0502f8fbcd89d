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

from experiments.adapters import qepcad
from experiments.limits import run_limited
from qe.io import formats

ROOT = Path(__file__).resolve().parent.parent
BIN = Path(sys.executable).parent
REPEAT = 5
QEPCAD_LIMIT, QEPCAD_MEMORY = 20.0, 4096

Point = tuple[int, int, int]
Q0: Point = (-1, 3, 3)
R0: Point = (1, 3, 3)
RADIUS2 = 27


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


def norm(names: str, right: str) -> str:
    """x^2 + y^2 + z^2 <= right."""
    return " + ".join(f"{n}^2" for n in names.split()) + f" <= {right}"


def formula8() -> str:
    """Formula (8) of the paper as printed: 9 variables, 6 of them quantified, 6 equations, 3 norms."""
    equations = [f"p{i} = 2*({Q0[i]}) - q{i} and r{i} = 2*({R0[i]}) - q{i}" for i in range(3)]
    norms = [norm(" ".join(f"{v}{i}" for i in range(3)), str(RADIUS2)) for v in "pqr"]
    return "ex p0, p1, p2, r0, r1, r2. " + " and ".join(equations + norms)


def formula8_symbolic() -> str:
    """Formula (8) with via points u and v and radius s left as symbols."""
    equations = [f"p{i} = 2*u{i} - q{i} and r{i} = 2*v{i} - q{i}" for i in range(3)]
    norms = [norm(" ".join(f"{v}{i}" for i in range(3)), "s^2") for v in "pqr"]
    return "ex p0, p1, p2, r0, r1, r2. " + " and ".join(equations + norms)


def three_balls() -> str:
    """The quantifier-free answer of formula (8): three balls in x, y, z."""
    centres = [(0, 0, 0), tuple(2 * c for c in Q0), tuple(2 * c for c in R0)]
    squares = [" + ".join(f"({n} - ({c}))^2" for n, c in zip("xyz", centre, strict=True)) for centre in centres]
    return " and ".join(f"{square} <= {RADIUS2}" for square in squares)


def objective() -> str:
    """|Q1 - Q0|^2 + |R0 - Q1|^2."""
    return " + ".join(f"({n} - ({a}))^2 + ({b} - {n})^2" for n, a, b in zip("xyz", Q0, R0, strict=True))


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

    balls = three_balls()
    region = qe.region(balls)
    optimum = qe.minimize(objective(), balls, method="convex")
    closed, one_free = f"ex x, y, z. {balls}", f"ex y, z. {balls}"
    with_certificate = median(lambda: qe.region(balls).certificate.to_json())
    alone = median(lambda: qe.region(balls))
    return [
        Row("(8) as printed", 0.020, median(lambda: qe.eliminate(formula8())), note=qepcad_note(formula8())),
        Row("(8) with symbolic points", 0.060, median(lambda: qe.eliminate(formula8_symbolic()))),
        Row("three balls, all existential", 0.020, median(lambda: qe.eliminate(closed)), note=qepcad_note(closed)),
        Row("three balls, x free", 0.050, median(lambda: qe.eliminate(one_free)), note=qepcad_note(one_free)),
        Row("region of three balls", 0.150, alone, note=f"{len(region.cells)} cells"),
        Row("  its certificate, on top", 0.050, max(0.0, with_certificate - alone)),
        Row("  its verification", 0.300, median(lambda: qe.verify(region.certificate))),
        Row(
            "optimum with certificate",
            0.050,
            median(lambda: qe.minimize(objective(), balls, method="convex").certificate),
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

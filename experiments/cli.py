"""The command ``experiments``: run suites of problems through solvers, and make tables, figures and a page of them.

Exit status as in ``qe.cli.shell``; ``run`` ends with 1 when our engine gave a wrong answer.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from experiments.adapters.answer import Limits
from experiments.display import progress
from experiments.problem import ROOT, Problem
from experiments.results import BadLine, Log, Status, read_log
from experiments.solvers import OURS, solver
from experiments.suites import suite
from experiments.sweep.grid import Method
from qe import __version__
from qe.cli.shell import BUG, OK, enter, examples
from qe.errors import InputError

if TYPE_CHECKING:
    from experiments.baseline import Entry

app = typer.Typer(pretty_exceptions_enable=False, rich_markup_mode=None)

baselines = typer.Typer(help="Freeze a baseline of the engine, and compare two.", no_args_is_help=True)
app.add_typer(baselines, name="baseline")

OUT = Path("out")
"""Everything goes below this folder of the current one, unless an option says otherwise."""
ARM = "arm"
RESULTS = OUT / "corpus.jsonl"
Results = Annotated[list[Path] | None, typer.Option("--results", help="Result files [default: out/corpus.jsonl].")]


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"experiments {__version__}")
        raise typer.Exit


@app.callback(epilog=examples("experiments run --suite paper --limit 15", "experiments table", "experiments report"))
def whole(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    """Experiments: run solvers on suites of problems; results are lines of JSON that are only ever added to."""


@app.command(short_help="Run suites through solvers.")
def run(
    suites: Annotated[
        list[str], typer.Option("--suite", help="paper, classics, literature, scaling, linear, ablation or arm.")
    ],
    solvers: Annotated[list[str] | None, typer.Option("--solver", help="A solver; default: ours.")] = None,
    limit: Annotated[
        float, typer.Option("--limit", "--timeout", min=0.01, help="Seconds of solving time for each problem.")
    ] = 15.0,
    memory: Annotated[int, typer.Option(min=1, help="MiB for each problem.")] = 2048,
    repeat: Annotated[int, typer.Option(help="Repetitions; the median counts.", min=1)] = 1,
    jobs: Annotated[int, typer.Option(help="Problems at a time.", min=1)] = 1,
    seed: Annotated[int, typer.Option(help="Of the random order.")] = 1,
    only: Annotated[str, typer.Option(help="Problems whose name or set contains this.")] = "",
    again: Annotated[bool, typer.Option("--again", help="Run again what has a result already.")] = False,
    results: Annotated[Path, typer.Option(help="The file to which results are added.")] = RESULTS,
) -> int:
    """Run suites through solvers. A second call goes on where an interrupted one stopped.

    The suite arm asks no solver: it prints a table of CPU seconds, with published ones beside them.
    """
    from experiments.session import Session

    if ARM in suites:
        _arm_figures(repeat)
        suites = [name for name in suites if name != ARM]
        if not suites:
            return OK
    work = [
        (_problems(name, only), [solver(each) for each in (solvers or chosen.solvers)])
        for name, chosen in [(name, suite(name)) for name in suites]
    ]
    if not any(problems for problems, _ in work):
        raise InputError(f"--only: no problem of {', '.join(suites)} has {only!r} in its name or set")
    session = Session(results, Limits(limit, memory), workers=jobs, again=again)
    _warn(session.log.bad)
    session.run(work, repeat=repeat, seed=seed)
    wrong = [r for r in session.log.results.values() if r.status is Status.WRONG]
    for row in wrong:
        print(f"WRONG ANSWER: {row.solver} on {row.set} {row.id}: {row.answer[:200]}")
    return BUG if any(row.solver.startswith(OURS) for row in wrong) else OK


@app.command()
def table(
    results: Results = None,
    out: Annotated[Path, typer.Option(help="The Markdown page.")] = OUT / "benchmarks.md",
) -> None:
    """Write the tables from result files."""
    _write_table(_read(results), out, figures_beside=out.parent / "images" / "benchmarks")


@app.command()
def figures(
    results: Results = None,
    out: Annotated[Path, typer.Option(help="The folder for SVG files.")] = OUT / "images" / "benchmarks",
) -> None:
    """Draw the figures from result files."""
    _write_figures(_read(results), out)


@app.command()
def html(
    results: Results = None,
    out: Annotated[Path, typer.Option(help="The page.")] = OUT / "benchmarks.html",
) -> None:
    """Write one self-contained page with tables and figures."""
    _write_html(_read(results), out)


@app.command(short_help="The tables, figures and page in one.")
def report(
    results: Results = None,
    out: Annotated[Path, typer.Option(help="The folder for benchmarks.md, images and benchmarks.html.")] = OUT,
    docs: Annotated[Path | None, typer.Option(help="Another folder for benchmarks.md and its images.")] = None,
) -> None:
    """Everything: benchmarks.md with its figures, and benchmarks.html, in the folder out."""
    log = _read(results)
    folder = docs or out
    _write_figures(log, folder / "images" / "benchmarks")
    _write_table(log, folder / "benchmarks.md", figures_beside=folder / "images" / "benchmarks")
    _write_html(log, out / "benchmarks.html")


@app.command(short_help="How many answers are proved, and how long.")
def proofs(
    suites: Annotated[list[str] | None, typer.Option("--suite", help="A suite; default: classics.")] = None,
    limit: Annotated[float, typer.Option(min=0.01, help="Seconds for each answer, the check included.")] = 15.0,
    memory: Annotated[int, typer.Option(min=1, help="MiB for each answer.")] = 2048,
    only: Annotated[str, typer.Option(help="Problems whose name or set contains this.")] = "",
) -> None:
    """How many answers are proved step by step, and what the proofs cost in time and size."""
    from experiments.proofs import lines, measured

    rows = []
    for problem in [p for name in suites or ["classics"] for p in _problems(name, only)]:
        rows.append(measured(problem, limit, memory))
        print(rows[-1], flush=True)
    for text in lines(rows):
        print(text)


@app.command(short_help="What helpers gain in a long decomposition.")
def speedup(
    question: Annotated[
        str, typer.Argument(help="A formula in the text syntax [default: some 20 s of one core].")
    ] = "",
    workers: Annotated[int, typer.Option(help="Worker processes here.", min=1)] = 2,
) -> int:
    """Decompose with helpers and alone, and print the processor time of every process and the clock. Status 1 when the
    answers or the certificates differ."""
    from experiments.speedup import QUESTION, measured

    found = measured(question or QUESTION, workers)
    print(found)
    return OK if found.same else BUG


@app.command(short_help="Many small eliminations in one process.")
def small(
    count: Annotated[int, typer.Option(help="Questions of each family.", min=1)] = 200,
    family: Annotated[list[str] | None, typer.Option(help="Only this family; may be given again.")] = None,
) -> int:
    """Eliminate one variable of many small questions and print each family's processor time and length of answers."""
    from experiments.small import FAMILIES, measured

    if unknown := set(family or ()) - set(FAMILIES):
        raise InputError(f"no family {min(unknown)!r}; there are {', '.join(FAMILIES)}")
    total = 0.0
    for each in measured(count, family):
        print(each, flush=True)
        total += each.seconds
    print(f"{total:.2f} s of processor time in all")
    return OK


@app.command(short_help="Questions rewritten in other coordinates.")
def invariance(
    file: Annotated[
        Path | None,
        typer.Argument(help="Rewritings of the literature [default: affine changes of the project's corpus]."),
    ] = None,
    limit: Annotated[
        float, typer.Option("--limit", "--timeout", min=0.01, help="Seconds of processor time for each question.")
    ] = 8.0,
    memory: Annotated[int, typer.Option(min=1, help="MiB for each question.")] = 2048,
    kind: Annotated[list[str] | None, typer.Option(help="Only rewritings of this kind; may be given again.")] = None,
    only: Annotated[str, typer.Option(help="Problems whose name contains this.")] = "",
    seed: Annotated[int, typer.Option(help="Of the affine changes.")] = 1,
) -> int:
    """Run questions and rewritings that mean the same: how many are lost, ratios of time and of length. Status 1 when
    an answer is wrong."""
    from experiments.invariance import from_file, generated, lines, measured

    known = generated(seed) if file is None else from_file(file)
    pairs = []
    for each in measured(
        (r for r in known if only in r.original.id and r.kind in (kind or [r.kind])), Limits(limit, memory)
    ):
        pairs.append(each)
        print(each, flush=True)
    for text in lines(pairs):
        print(text)
    return BUG if any(pair.after.status is Status.WRONG for pair in pairs) else OK


@app.command(short_help="Time of all over that of the arithmetic.")
def overhead(
    only: Annotated[list[str] | None, typer.Option(help="Problems whose name or set contains this.")] = None,
    suites: Annotated[list[str] | None, typer.Option("--suite", help="A suite; default: literature.")] = None,
    repeat: Annotated[int, typer.Option(help="Repetitions; the median counts.", min=1)] = 3,
) -> None:
    """Count and time FLINT's operations during problems; print the time of all over theirs.

    By default four problems of the literature in which lifting takes most of the time.
    """
    from experiments.overhead import PROBLEMS, measured

    for part in only or PROBLEMS:
        for problem in [p for name in suites or ["literature"] for p in _problems(name, part)]:
            print(measured(problem, repeat), flush=True)


@app.command(short_help="Which rule or method decides what.")
def mechanisms(
    suites: Annotated[list[str] | None, typer.Option("--suite", help="A suite; default: classics.")] = None,
    limit: Annotated[float, typer.Option(min=0.01, help="Seconds for each problem.")] = 5.0,
    only: Annotated[str, typer.Option(help="Problems whose name or set contains this.")] = "",
    check: Annotated[bool, typer.Option("--check", help="Prove the answers, too.")] = False,
) -> None:
    """For each attempt, rule and kind of proved step: how often it was tried and of use, its seconds, those in vain."""
    from experiments.mechanisms import lines, measured

    problems = [p for name in suites or ["classics"] for p in _problems(name, only)]
    if not problems:
        raise InputError(f"--only: no problem has {only!r} in its name or set")
    for text in lines(measured(problems, limit, certify=check)):
        print(text)


@app.command(short_help="Run SMT-LIB scripts through qe smt.")
def scripts(
    folder: Annotated[Path, typer.Argument(exists=True, file_okay=False, help="A folder of SMT-LIB scripts (*.smt2).")],
    limit: Annotated[
        float, typer.Option("--limit", "--timeout", min=0.01, help="Seconds for each script, the start included.")
    ] = 20.0,
    memory: Annotated[int, typer.Option(min=1, help="MiB for each script.")] = 2048,
    only: Annotated[str, typer.Option(help="Scripts whose name contains this.")] = "",
) -> int:
    """Run SMT-LIB scripts through qe smt and count the verdicts. Status 1 when one contradicts what is known."""
    from experiments.scripts import lines, runs

    ran = []
    for each in runs(folder, limit, memory, only):
        ran.append(each)
        print(each, flush=True)
    if not ran:
        raise InputError(f"no script in {folder}" + (f" with {only!r} in its name" if only else ""))
    for text in lines(ran, limit):
        print(text)
    return BUG if any(each.wrong for each in ran) else OK


@baselines.command(short_help="Run the corpora and keep the results.")
def freeze(
    out: Annotated[Path, typer.Argument(help="The file to write.")],
    limit: Annotated[
        float, typer.Option("--limit", "--timeout", min=0.01, help="Seconds of solving time for each problem.")
    ] = 15.0,
    memory: Annotated[int, typer.Option(min=1, help="MiB for each problem.")] = 2048,
    repeat: Annotated[int, typer.Option(help="Repetitions; the median counts.", min=1)] = 3,
    seed: Annotated[int, typer.Option(help="Of the random order.")] = 1,
    only: Annotated[str, typer.Option(help="Problems whose name or set contains this.")] = "",
) -> None:
    """Run the sets public, realgeom and project, and keep what was solved, in how much processor time, how shortly."""
    from experiments import baseline
    from experiments.environment import fingerprint
    from experiments.session import Session

    session = Session(out.with_name(f"{out.stem}.runs.jsonl"), Limits(limit, memory))
    _warn(session.log.bad)
    session.run([(baseline.problems(only), [solver(OURS)])], repeat=repeat, seed=seed)
    baseline.write(
        out, baseline.entries(session.log), fingerprint(limit=limit, memory=memory, repeat=repeat, seed=seed)
    )
    print(out)


@baselines.command(short_help="Compare two baseline files.")
def compare(
    old: Annotated[Path, typer.Argument(help="The older baseline file.")],
    new: Annotated[Path, typer.Argument(help="The newer one.")],
    memory: Annotated[int, typer.Option(min=1, help="MiB for comparing two answers.")] = 2048,
) -> int:
    """Compare two baseline files: solved, PAR-2, medians, lengths, equivalence. Status 1 when answers differ."""
    from experiments import baseline

    before, after = baseline.read(old), baseline.read(new)
    for text in baseline.lines(baseline.changes(before, after)):
        print(text)
    return _differences(baseline.different(before, after, memory=memory))


@baselines.command(short_help="Run the engines of two folders in turn.")
def pair(
    old: Annotated[Path, typer.Argument(help="A folder with an older state of this project.")],
    new: Annotated[Path, typer.Argument(help="Another [default: this one].")] = ROOT,
    suites: Annotated[list[str] | None, typer.Option("--suite", help="A suite; default: literature.")] = None,
    limit: Annotated[float, typer.Option(min=0.01, help="Seconds of processor time for each problem.")] = 15.0,
    memory: Annotated[int, typer.Option(min=1, help="MiB for each problem.")] = 2048,
    repeat: Annotated[int, typer.Option(help="Repetitions; the median counts.", min=1)] = 3,
    only: Annotated[str, typer.Option(help="Problems whose name or set contains this.")] = "",
    show: Annotated[int, typer.Option(help="So many of the problems that lost most seconds.")] = 5,
) -> int:
    """Run the engines of two folders in turn, problem by problem, and compare them. Status 1 when answers differ."""
    from experiments import baseline

    for tree in (old, new):
        if not (tree / "experiments" / "adapters").is_dir():
            raise InputError(f"a folder of this project expected, {tree} has no experiments/adapters")
    known = [p for name in suites or ["literature"] for p in _problems(name, only)]
    trees = old.resolve(), new.resolve()
    pairs = [baseline.pair(problem, trees, Limits(limit, memory), repeat=repeat) for problem in known]
    before, after = [a for a, _ in pairs], [b for _, b in pairs]
    for text in baseline.lines(baseline.changes(before, after)):
        print(text)
    for a, b in baseline.slowed(pairs)[:show]:
        print(f"slower: {a.set} {a.id}: {a.cpu:.3f} s to {b.cpu:.3f} s")
    return _differences(baseline.different(before, after, memory=memory, known=known))


def _differences(found: Iterable[tuple[Entry, Entry, str]]) -> int:
    """Print what is not proved equivalent; the exit status."""
    worst = OK
    for a, _, word in found:
        print(f"{word}: {a.set} {a.id}")
        worst = BUG if word == "different" else worst
    return worst


@app.command(short_help="Solve a grid of problems, draw the atlas.")
def sweep(
    half_width: Annotated[str, typer.Option(help="d of the via points (-d, 0, k), (d, 0, k).")] = "1/12:3:36",
    height: Annotated[str, typer.Option(help="k of the via points; A,B,... or FIRST:LAST:COUNT.")] = "1/12:3:36",
    radius: Annotated[str, typer.Option(help="Radii of the workspace.")] = "3",
    methods: Annotated[list[Method] | None, typer.Option("--method", help="Default: both.")] = None,
    scheduler: Annotated[str | None, typer.Option(help="Address of a Dask scheduler; default: workers here.")] = None,
    workers: Annotated[int, typer.Option(help="Worker processes here.", min=1)] = 2,
    timeout: Annotated[float, typer.Option(help="Seconds for each problem.")] = 30.0,
    out: Annotated[Path, typer.Option(help="Folder for results and pictures.")] = OUT / "sweep",
) -> None:
    """Solve a grid of planning problems with many workers and draw the atlas. A second call goes on after a stop."""
    from experiments.sweep.atlas import atlas
    from experiments.sweep.cluster import sweep as solve_all
    from experiments.sweep.grid import grid, values
    from experiments.sweep.store import Store

    axes = values(half_width, "--half-width"), values(height, "--height"), values(radius, "--radius")
    tasks = grid(*axes, methods or list(Method))
    store = Store(out)
    _warn(store.bad)
    with progress("problems", len(tasks)) as (_, advance):
        advance(sum(task.key in store.outcomes for task in tasks))
        solve_all(tasks, store, scheduler=scheduler, workers=workers, timeout=timeout, note=lambda row: advance(1))
    print(store.path)
    print(store.write_parquet())
    wanted = {task.key for task in tasks}
    for picture in atlas(row for key, row in store.outcomes.items() if key in wanted):
        _write(out / f"{picture.name}.svg", picture.svg())
    failed = [row for key, row in store.outcomes.items() if key in wanted and not row.solved]
    print(f"{len(wanted) - len(failed)} of {len(wanted)} problems solved")


@app.command(short_help="Chains and paths next to clarabel and toppra.")
def planning(
    out: Annotated[Path, typer.Option(help="Folder for the page and the data.")] = OUT / "planning",
    count: Annotated[int, typer.Option(help="Chains, and paths, at most.", min=1)] = 12,
) -> int:
    """Plan chains next to clarabel, certify what toppra makes of paths; write a table with pictures."""
    from experiments.planning import run as compared

    for file in compared(out, count, print):
        print(file)
    return OK


def _arm_figures(repeat: int) -> None:
    from experiments.arm_figures import figures, table

    found = []
    for figure in figures(max(repeat, 3)):
        found.append(figure)
        print(f"{figure.name}: {figure.median:.4f} s", file=sys.stderr)
    print(table(found))


def _problems(name: str, only: str) -> list[Problem]:
    """The chosen problems of a suite. Raises ``InputError`` when the whole suite is empty."""
    found = suite(name).problems()
    if not found:
        raise InputError(f"--suite {name}: problems expected, none found")
    return [p for p in found if only in p.id or only in p.set]


def _write_table(log: Log, out: Path, figures_beside: Path) -> None:
    from experiments.tables import page

    found = sorted(figures_beside.glob("*.svg"))
    pictures = [(path.stem, str(path.relative_to(out.parent))) for path in found]
    _write(out, page(log, pictures))


def _write_figures(log: Log, folder: Path) -> None:
    from experiments.figures import pictures

    for picture in pictures(log):
        _write(folder / f"{picture.name}.svg", picture.svg())


def _write_html(log: Log, out: Path) -> None:
    from experiments import figures as drawing
    from experiments.page import html as page

    _write(out, page(log, list(drawing.pictures(log))))


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    print(path)


def _read(results: list[Path] | None) -> Log:
    """The results. Raises ``InputError`` when there is none, so that nothing empty is written over anything."""
    paths = results or [RESULTS]
    for path in paths:
        if not path.is_file():
            raise InputError(f"--results: a file of results expected, {path} does not exist (see experiments run)")
    log = read_log(paths)
    _warn(log.bad)
    if not log.results:
        raise InputError(f"--results: no result of a run in {', '.join(map(str, paths))}")
    return log


def _warn(bad: Sequence[BadLine]) -> None:
    for line in bad:
        print(f"experiments: {line}", file=sys.stderr)


def main(argv: Sequence[str] | None = None) -> int:
    """The console script."""
    return enter(app, (sys.argv[1:] if argv is None else argv) or ["--help"], name="experiments")

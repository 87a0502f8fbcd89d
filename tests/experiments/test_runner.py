"""Runs of solvers, and what is installed of them."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
import tomllib
import zipfile
from pathlib import Path

import pytest

import experiments
from experiments import cli
from experiments.adapters.answer import Limits
from experiments.crosscheck import crosscheck
from experiments.problem import Problem
from experiments.results import Status, read_log
from experiments.runner import Job, compared, is_done, plan, run_one
from experiments.session import Session
from tests.experiments import fakes
from tests.experiments.test_results import result
from tests.tables import each

LIMITS = Limits(5.0, 400)
TRUE = Problem("set", "true", "ex x. x = 1", "true")


def outcome(solver, problem=TRUE, limits=LIMITS):
    return run_one(Job(problem, solver, 0), limits, "env")


@pytest.mark.parametrize(
    ("solver", "status"),
    [
        (fakes.answering("right", "true"), Status.SOLVED),
        (fakes.answering("wrong", "false"), Status.WRONG),
        (fakes.answering("slow", "true", seconds=99), Status.TIMEOUT),
        (fakes.refusing("shy", "unable", "too hard"), Status.UNABLE),
        (fakes.refusing("narrow", "unsupported", "sentences only"), Status.UNSUPPORTED),
        (fakes.CRASHING, Status.CRASH),
        (fakes.OUT_OF_MEMORY, Status.MEMORY),
        (fakes.SILENT, Status.CRASH),
    ],
    ids=lambda value: getattr(value, "name", ""),
)
def test_status(solver, status):
    row = outcome(solver)
    assert row.status is status and (row.set, row.solver, row.id) == ("set", solver.name, "true")
    assert row.environment == "env" and row.date and row.wall > 0


def test_limits_are_reported_as_such():
    busy = outcome(fakes.BUSY, limits=Limits(0.5, 400))
    assert busy.status is Status.TIMEOUT and busy.seconds == 0.5 and busy.wall < 9
    hog = outcome(fakes.HOG, limits=Limits(10.0, 150))
    assert hog.status is Status.MEMORY and hog.wall < 9 and "MiB" in hog.message


def test_messages_of_a_crash():
    assert outcome(fakes.CRASHING).message == "exit 3: no idea"


def test_answers_are_compared_by_equivalence():
    problem = Problem("set", "p", "ex x. x^2 = a", "a >= 0")
    assert outcome(fakes.answering("other", "2*a > 0 or a = 0"), problem).status is Status.SOLVED
    assert outcome(fakes.answering("other", "a > 0"), problem).status is Status.WRONG
    assert outcome(fakes.answering("other", "a > 0"), Problem("s", "p", "ex x. x^2 = a")).status is Status.UNCOMPARED


def test_assumptions_matter():
    assert compared("a > 0", "true", None, 400) == "different"
    assert compared("a > 0", "true", "a > 1", 400) == "equivalent"


def test_the_order_is_random_and_repeatable():
    problems = [Problem("s", str(i), "true") for i in range(20)]
    solvers = [fakes.BUSY, fakes.HOG]
    jobs = plan(problems, solvers, repeat=2, seed=1)
    assert len({job.key for job in jobs}) == 80 == len(jobs)
    assert jobs == plan(problems, solvers, repeat=2, seed=1) != plan(problems, solvers, repeat=2, seed=2)
    assert [j.problem.id for j in jobs] != sorted(j.problem.id for j in jobs)


@each(
    ({"status": "solved", "limit": 1.0}, True),
    ({"status": "WRONG", "limit": 1.0}, True),
    ({"status": "timeout", "limit": 1.0}, False),
    ({"status": "timeout", "limit": 5.0}, True),
    ({"repeat": 1}, False),
)
def test_what_is_run_again(known, done, tmp_path):
    log = read_log([])
    row = result(set="set", solver="right", id="true", **known)
    log.results[row.key] = row
    assert is_done(Job(TRUE, fakes.answering("right", "true"), 0), log, LIMITS) is done


def lines(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_a_session_goes_on_where_it_stopped(tmp_path, capsys):
    path = tmp_path / "r.jsonl"
    solver = fakes.answering("right", "true")
    work = [([TRUE], [solver])]
    Session(path, LIMITS).run(work * 2)
    once = path.read_text()
    Session(path, LIMITS).run(work)
    assert path.read_text() == once
    Session(path, LIMITS).run(work, repeat=2)
    Session(path, LIMITS, again=True).run(work)
    rows = [r for r in lines(path) if "kind" not in r]
    assert [r["repeat"] for r in rows] == [0, 1, 0] and path.read_text().startswith(once)
    environment = lines(path)[0]
    assert environment["limit"] == 5.0 and environment["commit"] and rows[0]["environment"] == environment["name"]
    assert "set right: solved 1 of 1, wrong 0" in capsys.readouterr().out


def test_a_solver_that_is_not_there_is_left_out(tmp_path, capsys):
    path = tmp_path / "r.jsonl"
    absent = fakes.refusing("absent", "unsupported", "it is not installed")
    Session(path, LIMITS).run([([TRUE], [absent, fakes.answering("right", "true")])])
    assert {r["solver"] for r in lines(path) if "kind" not in r} == {"right"}
    error = capsys.readouterr().err
    assert "absent is left out" in error and "it is not installed" in error and error.count("\n") == 1


def test_answers_without_a_known_one_are_compared_with_each_other(tmp_path, capsys):
    path = tmp_path / "r.jsonl"
    problem = Problem("set", "open", "ex x. x^2 = a")
    solvers = [fakes.answering("ours", "true"), fakes.answering("a", "true"), fakes.answering("b", "false")]
    session = Session(path, LIMITS)
    session.run([([problem], solvers)])
    found = {(c.left, c.right): c.verdict for c in session.log.comparisons.values()}
    assert found == {("ours", "a"): "equivalent", ("ours", "b"): "different"}
    assert "DISAGREEMENT: ours and b on set open" in capsys.readouterr().out
    assert list(crosscheck([problem], read_log([path]), memory=400)) == []


def test_wrong_answers_of_ours_are_a_headline(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(cli, "solver", lambda name: fakes.answering(name, "true and false"))
    path = tmp_path / "r.jsonl"
    monkeypatch.setattr("experiments.session.WARM_UP", Problem("w", "w", "false", "true and false"))
    code = cli.main(["run", "--suite", "classics", "--only", "davenport-heintz", "--results", str(path)])
    assert code == 1
    assert "WRONG ANSWER: ours on project davenport-heintz" in capsys.readouterr().out


def test_a_killed_session_resumes(tmp_path, root):
    """A real session of the real engine, killed by force after its first result."""
    path = tmp_path / "r.jsonl"
    command = ["run", "--suite", "classics", "--only", "quadratic-", "--results", str(path)]
    process = subprocess.Popen(
        [sys.executable, "-m", "experiments", *command], cwd=root, start_new_session=True, stdout=subprocess.DEVNULL
    )
    deadline = time.monotonic() + 60
    while (not path.exists() or path.read_text().count("\n") < 2) and time.monotonic() < deadline:
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait(60)
    before = path.read_text()
    assert cli.main(command) == 0
    assert path.read_text().startswith(before)
    keys = [(r["id"], r["repeat"]) for r in lines(path) if "kind" not in r]
    assert len(keys) == len(set(keys)) >= 2


PROJECT = Path(__file__).resolve().parents[2]


def install(folder: Path) -> None:
    """Copy modules and package data of the packages."""
    tool = tomllib.loads((PROJECT / "pyproject.toml").read_text())["tool"]["setuptools"]
    patterns = ["*.py", *tool["package-data"]["*"]]
    for pattern in (*tool["packages"]["find"]["include"], "experiments*"):
        for top in PROJECT.glob(pattern):
            for path in top.rglob("*") if top.is_dir() else ():
                if path.is_file() and any(path.match(p) for p in patterns):
                    target = folder / path.relative_to(PROJECT)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(path, target)


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    install(folder)
    return folder


def run(installed: Path, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(installed), "PYTHONSAFEPATH": "1"}
    command = [sys.executable, "-m", "experiments", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120)


def files(folder: Path) -> set[Path]:
    return {p.relative_to(folder) for p in folder.rglob("*") if p.is_file() and "__pycache__" not in p.parts}


def test_the_classics_run_from_an_installed_package(installed: Path, tmp_path: Path) -> None:
    """They were silently no problems at all, and the report was written beside the installed packages."""
    before = files(installed)
    done = run(installed, tmp_path, "run", "--suite", "classics", "--only", "davenport-heintz", "--limit", "30")
    assert done.returncode == 0, done.stderr
    records = [json.loads(line) for line in (tmp_path / "out" / "corpus.jsonl").read_text().splitlines()]
    found = [r for r in records if r.get("kind", "result") == "result"]
    assert [r["status"] for r in found] == ["solved"]
    assert {r["commit"] for r in records if r.get("kind") == "environment"} == {"unknown"}
    done = run(installed, tmp_path, "report")
    assert done.returncode == 0, done.stderr
    assert {Path("out/corpus.jsonl"), Path("out/benchmarks.md"), Path("out/benchmarks.html")} <= files(tmp_path)
    assert "davenport-heintz" in (tmp_path / "out" / "benchmarks.md").read_text()
    assert files(installed) == before


def test_the_command_of_the_repository_works_in_any_folder(tmp_path: Path) -> None:
    """Outside the repository it said "No module named experiments"; a folder of that name must not take its place."""
    made, elsewhere = tmp_path / "bin", tmp_path / "elsewhere"
    (elsewhere / "experiments").mkdir(parents=True)
    made.mkdir()
    (made / "python").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    (made / "python").chmod(0o755)
    make = ["make", "-s", f"BIN={made}", f"CORE={made / 'python'}", f"{made}/experiments"]
    subprocess.run(make, cwd=PROJECT, check=True, timeout=60)
    done = subprocess.run(
        [made / "experiments", "run", "--suite", "classics", "--only", "davenport-heintz", "--limit", "30"],
        cwd=elsewhere,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert (elsewhere / "out" / "corpus.jsonl").exists()


@each("report", "table", "figures", "html")
@each(None, "", '{"kind": "environment", "name": "e"}\n', "spoilt\n")
def test_a_report_without_results_overwrites_nothing(content, command, tmp_path, monkeypatch, capsys):
    """In a fresh clone the tracked page was replaced by an empty table."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "docs").mkdir()
    for name in ("docs/benchmarks.md", "benchmarks.md"):
        (tmp_path / name).write_text("tables")
    if content is not None:
        (tmp_path / "out").mkdir()
        (tmp_path / "out" / "corpus.jsonl").write_text(content)
    before = files(tmp_path)
    out = "." if command == "report" else "benchmarks.md"
    for options in ([], ["--out", out], *([["--docs", "docs"]] if command == "report" else [])):
        assert cli.main([command, *options]) == 2
        assert capsys.readouterr().err.count("experiments: --results: ") == 1
    assert files(tmp_path) == before
    assert (tmp_path / "docs/benchmarks.md").read_text() == (tmp_path / "benchmarks.md").read_text() == "tables"


def test_the_repository_s_own_page_is_written_only_on_request(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    fields = {"set": "s", "solver": "ours", "id": "p", "status": "solved", "seconds": 0.5, "wall": 1.0, "limit": 10.0}
    (tmp_path / "r.jsonl").write_text(json.dumps(fields) + "\n")
    assert cli.main(["report", "--results", "r.jsonl"]) == 0
    assert not (tmp_path / "docs").exists() and (tmp_path / "out/benchmarks.md").exists()
    assert cli.main(["report", "--results", "r.jsonl", "--docs", "docs"]) == 0
    assert (tmp_path / "docs/benchmarks.md").read_text() == (tmp_path / "out/benchmarks.md").read_text()


def test_no_problem_is_an_error(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["run", "--suite", "classics", "--only", "no such problem"]) == 2
    assert "no problem of classics" in capsys.readouterr().err
    monkeypatch.setattr("experiments.suites.corpus.CORPUS", tmp_path)
    assert cli.main(["run", "--suite", "classics"]) == 2
    assert "--suite classics: problems expected, none found" in capsys.readouterr().err
    assert files(tmp_path) == set()


def test_the_corpus_lies_in_the_package() -> None:
    folder = Path(experiments.__file__).parent / "corpus"
    assert {p.stem for p in folder.glob("*.toml")} >= {"timing", "shapes", "wrong_answers"}


@pytest.mark.deep
def test_the_wheel_and_the_source_distribution(tmp_path: Path) -> None:
    """The wheel installs the two packages and nothing of a common name; the source distribution holds the tests."""
    copy = tmp_path / "copy"
    subprocess.run(["git", "clone", "-q", str(PROJECT), str(copy)], check=True)
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    subprocess.run([*pip, "wheel", "--no-deps", "-w", str(tmp_path), str(copy)], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        tops = {name.split("/")[0] for name in archive.namelist()}
        archive.extractall(tmp_path / "installed")
    assert {top for top in tops if not top.endswith(".dist-info")} == {"qe", "bezier"}
    done = subprocess.run(
        [sys.executable, "-m", "qe", "eliminate", "ex x. x^2 = b"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(tmp_path / "installed"), "PYTHONSAFEPATH": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == "b >= 0\n"

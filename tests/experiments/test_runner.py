"""The runner: what a run ends with, what is run again, what happens to answers."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

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

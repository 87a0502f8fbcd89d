"""Results of runs: kept, compared, with proofs and limits."""

from __future__ import annotations

import json
import os
import sys
import time
from dataclasses import asdict
from pathlib import Path

import pytest
from typer.testing import CliRunner

from experiments import baseline
from experiments.adapters.answer import Limits
from experiments.baseline import Entry
from experiments.cli import app
from experiments.limits import Ending, group_use, run_limited
from experiments.problem import Problem
from experiments.proofs import Proved, lines, measured
from experiments.results import Appender, Comparison, Log, Result, Status, read_log
from qe.errors import InputError
from tests.experiments.fakes import BUSY, HOG, Solver, fake
from tests.tables import each

OLD = (
    '{"set": "project", "solver": "z3", "id": "p", "status": "unable", "seconds": 0.01, "wall": 0.3, "limit": 15.0, '
    '"answer": "", "message": "NotSupported: z3 decides sentences only"}'
)


def result(**changes: object) -> Result:
    fields = {"set": "s", "solver": "ours", "id": "p", "status": "solved", "seconds": 0.5, "wall": 1.0, "limit": 10.0}
    return Result(**{**fields, **changes})


def test_what_is_written_is_read(tmp_path):
    path = tmp_path / "deeper" / "r.jsonl"
    file = Appender(path)
    comparison = Comparison("s", "p", "ours", "qepcad", "equivalent", "abc")
    file.write({"kind": "environment", "name": "e1", "machine": "M"})
    file.write(asdict(result(answer="x ≤ 0")))
    file.write({"kind": "comparison", **asdict(comparison)})
    log = read_log([path])
    assert list(log.results.values()) == [result(answer="x ≤ 0")] and not log.bad
    assert log.environments["e1"]["machine"] == "M"
    assert list(log.comparisons.values()) == [comparison]


def test_nothing_is_overwritten_and_the_latest_counts(tmp_path):
    path = tmp_path / "r.jsonl"
    Appender(path).write(asdict(result(seconds=1.0)))
    before = path.read_text()
    Appender(path).write(asdict(result(seconds=2.0)))
    Appender(path).write(asdict(result(seconds=3.0, repeat=1)))
    assert path.read_text().startswith(before)
    assert sorted(r.seconds for r in read_log([path]).results.values()) == [2.0, 3.0]


@each("{", "nonsense", "[1, 2]", '{"set": "s"}', '{"kind": "novel"}', json.dumps({**json.loads(OLD), "status": "x"}))
def test_a_bad_line_is_reported_with_its_number_and_skipped(bad, tmp_path):
    path = tmp_path / "r.jsonl"
    path.write_text(f"{OLD}\n{bad}\n\n{OLD.replace('z3', 'cvc5')}\n")
    log = read_log([path])
    assert len(log.results) == 2
    (line,) = log.bad
    assert line.number == 2 and str(line).startswith(f"{path}:2: line skipped: ")


def test_seconds_that_are_no_number_are_refused(tmp_path):
    path = tmp_path / "r.jsonl"
    path.write_text(OLD.replace("0.01", '"fast"') + "\n")
    assert [line.number for line in read_log([path]).bad] == [1]


def test_a_line_cut_off_by_a_kill_spoils_only_itself(tmp_path):
    path = tmp_path / "r.jsonl"
    path.write_text(f'{OLD}\n{{"set": "s", "sol')
    Appender(path).write(asdict(result()))
    log = read_log([path])
    assert len(log.results) == 2 and [line.number for line in log.bad] == [2]


def test_old_lines_are_read(tmp_path):
    path = tmp_path / "old.jsonl"
    path.write_text(OLD + "\n")
    (row,) = read_log([path, tmp_path / "absent.jsonl"]).results.values()
    assert row.status is Status.UNSUPPORTED and row.repeat == 0 and row.environment == ""


def entry(id="a", cpu=1.0, status=Status.SOLVED, answer="x > 0", set="public", length=None):
    return Entry(set, id, status, cpu, 10.0, len(answer) if length is None else length, answer)


def test_a_file_holds_the_median_of_the_repetitions_of_our_engine_only(tmp_path):
    log = Log()
    rows = [
        result(set="public", solver="ours", id="p", repeat=k, cpu=c, length=5) for k, c in enumerate((3.0, 1.0, 2.0))
    ]
    for row in (*rows, result(set="public", solver="z3", id="p"), result(set="paper/x", solver="ours", id="p")):
        log.results[row.key] = row
    path = tmp_path / "b.jsonl"
    baseline.write(path, baseline.entries(log), {"kind": "environment", "name": "e"})
    (found,) = baseline.read(path)
    assert (found.set, found.id, found.cpu, found.length, found.status) == ("public", "p", 2.0, 5, Status.SOLVED)


def test_no_baseline_without_problems(tmp_path):
    with pytest.raises(InputError, match="none were found"):
        baseline.write(tmp_path / "b.jsonl", [], {})
    assert not (tmp_path / "b.jsonl").exists()


@each("no JSON", "[1]", '{"set": "public"}', '{"set": "a", "status": "perhaps"}')
def test_other_files_are_refused(text, tmp_path):
    (tmp_path / "b.jsonl").write_text(text)
    with pytest.raises(InputError, match="a baseline file expected"):
        baseline.read(tmp_path / "b.jsonl")


def test_changes_count_lost_won_times_and_lengths():
    old = [entry("a", 1.0), entry("b", 2.0), entry("c", 4.0), entry("d", 10.0, Status.TIMEOUT, "")]
    new = [
        entry("a", 2.0),
        entry("b", 2.0, answer="x > 0 and x > 0"),
        entry("c", 10.0, Status.TIMEOUT, ""),
        entry("d", 1.0),
    ]
    (change,) = baseline.changes(old, new)
    assert (change.lost, change.won, change.longer) == (("c",), ("d",), ("b",))
    assert change.par2 == (1 + 2 + 4 + 20, 2 + 2 + 20 + 1)
    assert change.ratio == pytest.approx(1.5) and change.median == (1.5, 2.0) and change.length == (10, 20)
    assert "lost: c" in "\n".join(baseline.lines([change]))


def test_answers_are_compared_by_equivalence(monkeypatch):
    monkeypatch.setattr(baseline, "problems", lambda only="": [])
    old = [entry("same", answer="x > 0"), entry("other", answer="x > 0"), entry("lost", answer="x > 0")]
    new = [
        entry("same", answer="2*x > 0"),
        entry("other", answer="x >= 0"),
        entry("lost", status=Status.UNABLE, answer=""),
    ]
    found = [(a.id, word) for a, _, word in baseline.different(old, new, memory=2048)]
    assert found == [("other", "different")]


def test_the_engines_of_two_folders_take_turns_and_their_medians_are_compared(tmp_path):
    trees = (tmp_path / "old", tmp_path / "new")
    for tree, answer in zip(trees, ("x > 0", "2*x > 0"), strict=True):
        (tree / "experiments").mkdir(parents=True)
        (tree / "experiments" / "__init__.py").touch()
        report = {"status": "solved", "answer": answer, "seconds": 0.01, "cpu": 0.01}
        note = f"open({str(tmp_path / 'turns')!r}, 'a').write({tree.name!r} + ' ')"
        (tree / "experiments" / "adapters.py").write_text(f"import json\n{note}\nprint(json.dumps({report!r}))\n")
    shown = []
    problem = Problem("public", "p", "ex y. y^2*x > 0", "x > 0")
    old, new = baseline.pair(problem, trees, Limits(30, 500), repeat=2, show=shown.append)
    assert (tmp_path / "turns").read_text().split() == ["old", "new"] * 2
    assert (old.answer, new.answer, old.length, new.length) == ("x > 0", "2*x > 0", 5, 7)
    assert old.is_solved and new.is_solved and "5 to 7 characters" in shown[0]
    assert not list(baseline.different([old], [new], memory=500, known=[problem]))


def test_the_problems_that_lost_most_seconds_come_first():
    old = [entry("a", 1.0), entry("b", 1.0), entry("c", 1.0), entry("d", 1.0)]
    new = [entry("a", 2.0), entry("b", 9.0), entry("c", 0.5), entry("d", 10.0, Status.TIMEOUT, "")]
    assert [a.id for a, _ in baseline.slowed(zip(old, new, strict=True))] == ["b", "a"]


def test_a_proved_answer() -> None:
    row = measured(Problem("mine", "line", "ex x. a*x = b and x > 1"), 10, 2048)
    assert row.by_steps
    assert row.same
    assert row.size > 100
    assert row.check > 0


def test_the_figures() -> None:
    problem = Problem("mine", "one", "true")
    rows = [
        Proved(problem, True, True, (), True, 0.1, 0.3, 0.2, 1000),
        Proved(problem, True, True, ("magic",), True, 0.1, 0.3, 0.2, 1000),
        Proved(problem, True, False, ("magic",), False, 0.1, 0.3),
        Proved(problem, False),
    ]
    text = "\n".join(lines(rows))
    assert "4 problems, 3 solved" in text
    assert "every step checked 1, by a decomposition instead 1, not checked 1" in text
    assert "median 2.00" in text
    assert "magic (2)" in text
    assert "OTHER ANSWERS with the check: one" in text


def test_the_command() -> None:
    result = CliRunner().invoke(app, ["proofs", "--only", "vacuous-exists"])
    assert result.exit_code == 0
    assert "every step checked 1" in result.output


TASK = "{}"


def run(solver: Solver, *, seconds: float = 10.0, memory: int = 500, start_up: float = 10.0):
    return run_limited(solver.command, TASK, seconds=seconds, memory=memory, start_up=start_up)


def test_what_a_program_says_and_returns():
    program = "import sys; print(sys.stdin.read().upper() * 100000); print('oops', file=sys.stderr); sys.exit(7)"
    done = run_limited([sys.executable, "-c", program], "héllo", seconds=10, memory=500)
    assert (done.ending, done.code, done.err) == (Ending.FINISHED, 7, "oops\n")
    assert done.out == "HÉLLO" * 100000 + "\n"
    assert 0 < done.wall < 10 and done.peak > 1


def test_a_program_imports_what_is_in_its_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two engines were compared that were one: the path of the command that compared them went first."""
    (tmp_path / "experiments").mkdir()
    (tmp_path / "experiments" / "__init__.py").touch()  # a folder without it comes after any package of the path
    (tmp_path / "experiments" / "__main__.py").write_text("print('of the folder')")
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    monkeypatch.setenv("PYTHONSAFEPATH", "1")
    command = [sys.executable, "-m", "experiments"]
    assert run_limited(command, "", seconds=10, memory=500, folder=tmp_path).out == "of the folder\n"


def test_a_busy_loop_is_stopped_within_a_second_of_the_limit():
    done = run_limited([sys.executable, "-c", "while True: pass"], TASK, seconds=0.5, memory=500)
    assert done.ending is Ending.TIME and 0.5 <= done.wall < 9  # one second is asked; the machine may be busy


def test_the_limit_counts_from_the_first_output():
    done = run(BUSY, seconds=0.3)
    assert done.ending is Ending.TIME and done.wall < 9, "not the ten seconds of the start"


def test_a_silent_program_gets_the_time_of_its_start():
    program = [sys.executable, "-c", "import time; time.sleep(0.6); print('late')"]
    assert run_limited(program, TASK, seconds=0.3, memory=500, start_up=5.0).out == "late\n"
    assert run_limited(program, TASK, seconds=0.1, memory=500).ending is Ending.TIME


def test_a_program_that_waits_has_a_multiple_of_the_limit():
    program = [sys.executable, "-c", "import time; print('ready', flush=True); time.sleep(0.6); print('late')"]
    done = run_limited(program, TASK, seconds=0.4, memory=500, start_up=5.0)
    assert (done.ending, done.out) == (Ending.FINISHED, "ready\nlate\n")


def test_a_memory_hog_is_stopped_and_reported():
    done = run(HOG, memory=150)
    assert done.ending is Ending.MEMORY and 150 < done.peak < 700
    assert done.wall < 9, "long before the limit on time"


def test_memory_counts_for_the_whole_group():
    body = "subprocess.run([sys.executable, '-c', 'held = bytearray(1) * (200 << 20); import time; time.sleep(60)'])"
    done = run(fake("parent", body), memory=150)
    assert done.ending is Ending.MEMORY and done.wall < 9


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    with open(f"/proc/{pid}/stat") as file:  # a zombie has ended
        return file.read().rpartition(")")[2].split()[0] != "Z"


@each("", "while True: pass")
def test_a_helper_that_stays_behind_is_ended(after):
    body = f"helper = subprocess.Popen(['sleep', '60'])\nprint(helper.pid, flush=True)\n{after}"
    done = run(fake("parent", body), seconds=0.5)
    helper = int(done.out.splitlines()[1])
    deadline = time.monotonic() + 20
    while alive(helper) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not alive(helper)


def test_the_memory_and_the_processor_time_of_a_group_are_seen():
    memory, seconds = group_use(os.getpgrp())
    assert memory > 10 and seconds >= time.process_time() - 0.1
    assert group_use(2**22 + 1) == (0, 0)


def test_a_run_ends_even_when_nobody_watches():
    """Processor time has a limit of its own, some times the one that is watched."""
    body = "import resource\nprint(resource.getrlimit(resource.RLIMIT_CPU)[0], flush=True)"
    assert run(fake("watched", body), seconds=2.0, start_up=3.0).out.splitlines()[1] == "20"

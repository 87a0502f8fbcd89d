"""Baseline files: what is kept, what is compared, and that nothing empty is written."""

import pytest

from experiments import baseline
from experiments.adapters.answer import Limits
from experiments.baseline import Entry
from experiments.problem import Problem
from experiments.results import Log, Status
from qe.errors import InputError
from tests.experiments.test_results import result
from tests.tables import each


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

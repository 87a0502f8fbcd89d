"""Result files: only added to, read line by line, old lines included."""

import json
from dataclasses import asdict

from experiments.results import Appender, Comparison, Result, Status, read_log
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

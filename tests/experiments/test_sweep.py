"""Sweeps: the grid, the numbers, and a real cluster of worker processes of which one is killed."""

import json
import os
import signal
from fractions import Fraction

import pytest

from bezier.methods.quadratic import formula as quadratic
from experiments import cli
from experiments.sweep.atlas import atlas, boundary
from experiments.sweep.cluster import sweep
from experiments.sweep.grid import Method, Task, grid, values
from experiments.sweep.solve import _problem, outcome, solve
from experiments.sweep.store import Store
from qe.errors import InputError
from tests.tables import each


def task(d, k, r, method):
    return Task(Fraction(d), Fraction(k), Fraction(r), method)


def test_values():
    assert values("1/4, 1/2", "--x") == (Fraction(1, 4), Fraction(1, 2))
    assert values("1:2:5", "--x") == tuple(Fraction(n, 4) for n in (4, 5, 6, 7, 8))
    for text in ("", "a", "1:2", "1/0", "-1", "0:1:3", "1:2:0"):
        with pytest.raises(InputError, match=r"^--x: positive numbers"):
            values(text, "--x")


def test_the_grid_keeps_to_the_ball():
    found = grid(values("1,2,3", "d"), values("1,2", "k"), values("2,3", "r"), Method)
    assert len(found) == len({t.key for t in found}) == 2 * (1 + 4)
    assert all(t.half_width**2 + t.height**2 <= t.radius**2 for t in found)


@each(("2", 1.40211), ("8/5", 1.82407), ("5/2", 1.33369))
def test_objective_of_formula_7(radius, value):
    found = solve(task(1, 1, radius, Method.CUBIC))
    assert found["solved"] and found["objective"] == pytest.approx(value, abs=1e-5) and found["objective_exact"]


def test_feasibility_follows_the_exact_curve():
    on, inside, outside = (
        task(1, 1, 2, Method.QUADRATIC),
        task(1, 2, 3, Method.QUADRATIC),
        task(1, "5/2", "14/5", Method.QUADRATIC),
    )
    rows = [solve(t) for t in (on, inside, outside)]
    assert [row["feasible"] for row in rows] == [True, True, False]
    assert rows[0]["volume_high"] == 0 == rows[2]["volume_high"] and 0 < rows[1]["volume_low"] < rows[1]["volume_high"]


def test_the_drawn_border_is_the_border():
    widths, heights = boundary(3.0)
    for d, k in zip(widths[1:-1:20], heights[1:-1:20], strict=True):
        for factor, feasible in ((Fraction(99, 100), True), (Fraction(101, 100), False)):
            moved = Task(Fraction(d) * factor, Fraction(k), Fraction(3), Method.QUADRATIC)
            if moved.is_problem:
                assert quadratic.three_balls(_problem(moved)).meet is feasible
    assert (widths[0], heights[0]) == (1.5, 0.0) and (widths[-1], heights[-1]) == (0.0, 3.0)


def test_an_outcome_is_stored_once(tmp_path):
    store = Store(tmp_path)
    row = solve(task(1, 1, 3, Method.CUBIC))
    store.add(row)
    store.add({**row, "objective": 99.0})
    (tmp_path / "sweep.jsonl").open("a").write("spoilt\n")
    again = Store(tmp_path)
    assert [r.objective for r in again.outcomes.values()] == [pytest.approx(4 / 3)]
    assert [line.number for line in again.bad] == [2]
    from pyarrow import parquet

    assert parquet.read_table(again.write_parquet()).to_pylist()[0]["objective_exact"] == "4/3"


def test_the_atlas_carries_the_data():
    tasks = grid(values("1/2,1,2", "d"), values("1/2,1,2", "k"), values("3,4", "r"), Method)
    rows = [
        outcome(t, solved=True, feasible=t.half_width < 2, volume_high=float(t.height), objective=float(t.half_width))
        for t in tasks
    ]
    first, second = atlas(rows)
    assert (first.name, second.name) == ("atlas-r3", "atlas-r4")
    panels = [axes for axes in first.figure.axes if axes.get_title()]
    assert [axes.get_title() for axes in panels] == [
        "formula (8) feasible",
        "volume of the region of $Q_1$",
        "least objective of formula (7)",
    ]
    limits = [axes.collections[0].get_array().compressed() for axes in panels]
    assert [(min(v), max(v)) for v in limits] == [(0, 1), (0.5, 2), (0.5, 2)]
    for axes in panels:
        assert axes.get_xlim() == panels[0].get_xlim() and axes.get_xlim()[1] >= 3
        assert axes.get_lines(), "the exact curve is drawn over it"
    assert first.svg().count("<path") > 20


def test_a_killed_worker_loses_nothing_and_repeats_nothing(tmp_path):
    """A local cluster of two processes; the one that gave the first outcome is killed at once."""
    tasks = grid(values("1/8:2:4", "d"), values("1/8:2:4", "k"), values("3", "r"), [Method.CUBIC])
    store, seen, killed = Store(tmp_path), [], []

    def note(row):
        seen.append(row.key)
        if not killed:
            killed.append(int(row.worker.rpartition(":")[2]))
            os.kill(killed[0], signal.SIGKILL)

    sweep(tasks, store, workers=2, timeout=120, note=note)
    keys = [json.loads(line)["key"] for line in store.path.read_text().splitlines()]
    assert sorted(keys) == sorted(t.key for t in tasks) == sorted(seen)
    assert all(row.solved for row in store.outcomes.values())
    workers = {row.worker for row in store.outcomes.values()}
    assert len(workers) > 1 and killed

    sweep(tasks, Store(tmp_path), note=note)  # resumes: nothing is left to do, and no cluster is started
    assert len(seen) == len(tasks)


@pytest.fixture
def scheduler():
    """The address of a cluster that runs already, with one worker in a thread."""
    from distributed import LocalCluster

    with LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=":0") as cluster:
        yield cluster.scheduler_address


def test_a_cluster_that_is_there(tmp_path, scheduler):
    tasks = [task(1, k, 3, Method.CUBIC) for k in (1, 2)]
    store = Store(tmp_path)
    sweep(tasks, store, scheduler=scheduler)
    assert set(store.outcomes) == {t.key for t in tasks}


def test_a_task_that_always_fails_is_recorded(tmp_path, scheduler, monkeypatch):
    def broken(given, timeout):
        if given.height == 2:
            raise RuntimeError("no luck")
        return solve(given, timeout)

    monkeypatch.setattr("experiments.sweep.cluster.solve", broken)
    good, bad = task(1, 1, 3, Method.CUBIC), task(1, 2, 3, Method.CUBIC)
    store = Store(tmp_path)
    sweep([bad, good], store, scheduler=scheduler)
    assert store.outcomes[good.key].solved and not store.outcomes[bad.key].solved
    assert store.outcomes[bad.key].message == "RuntimeError: no luck"


def test_no_scheduler_gives_one_line(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("qe.processes.cluster.CONNECTING", 0.5)
    grid_options = ["--half-width", "1", "--height", "1", "--out", str(tmp_path)]
    assert cli.main(["sweep", *grid_options, "--scheduler", "tcp://127.0.0.1:9"]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1 and "a Dask scheduler expected at tcp://127.0.0.1:9" in error

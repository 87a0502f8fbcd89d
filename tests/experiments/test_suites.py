"""Scripts, adapters of other programs, suites of problems, and sweeps over them."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

import qe
from bezier.methods.quadratic import formula as quadratic
from experiments import cli
from experiments.adapters.__main__ import PEERS
from experiments.adapters.answer import Limits, NotSupported
from experiments.adapters.ours import ours
from experiments.cli import main
from experiments.compare import Verdict, compare
from experiments.scripts import known_answers
from experiments.solvers import ENGINES, NAMES, OURS
from experiments.suites import SUITES, corpus, paper, scaling, suite
from experiments.suites import families as growing
from experiments.sweep.atlas import atlas, boundary
from experiments.sweep.cluster import sweep
from experiments.sweep.grid import Method, Task, grid, values
from experiments.sweep.solve import _problem, outcome, solve
from experiments.sweep.store import Store
from qe.errors import InputError, Unable
from qe.io.text import read, write
from tests.tables import each


@each("paper", "classics", "scaling", "ablation")
def test_every_problem_reads(name):
    found = SUITES[name].problems()
    assert len({(p.set, p.id) for p in found}) == len(found) >= 30
    for problem in found:
        formula = read(problem.formula)
        if problem.expected is not None:
            expected = read(problem.expected)
            assert expected.is_quantifier_free and set(expected.free) <= set(formula.free)


def test_literature_where_it_is_present(shared):
    found = corpus.literature(shared / "corpora")
    assert {p.set for p in found} == {"public", "realgeom", "classics"} and len(found) > 200


def test_questions_of_threads_where_they_are_present(shared):
    found = corpus.wild(shared / "corpora")
    assert len({p.id for p in found}) == len(found) > 80
    assert all(not read(p.formula).free for p in found if p.id.startswith("A-z3"))


def test_literature_where_it_is_absent(tmp_path):
    with pytest.raises(InputError, match=r"^--suite literature: expected a folder") as error:
        corpus.literature(tmp_path / "corpora")
    assert "\n" not in str(error.value)


def test_the_family_is_the_same_on_every_machine():
    first, second, *_ = paper.planning_problems()
    assert first.via == ((-1, 3, 3), (1, 3, 3)) and first.workspace.radius_squared == 27
    assert second.via == paper.planning_problems()[1].via != first.via
    assert any(not expected for expected in (p.expected == "true" for p in paper.problems() if "8-feasible" in p.set))


PAPER = {p.id: p for p in paper.problems()}


@each("formula-8-symbolic", "formula-8-above-1", "formula-8-feasible-2", "formula-4-height-1")
def test_known_answers_of_the_paper_suite(id):
    problem = PAPER[id]
    answer = qe.eliminate(problem.formula, timeout=120)
    assert compare(write(answer.formula), problem.expected, seconds=5) in (Verdict.EQUIVALENT, Verdict.PROBED)


def test_sizes_grow_along_a_family():
    families = {}
    for problem in scaling.problems():
        families.setdefault(problem.set, []).append(problem)
    assert {name.removeprefix("scaling/") for name in families} == {
        "degree",
        "via",
        "balls-2d",
        "balls-3d",
        "bits",
        "tower",
        *(problem.set.removeprefix("scaling/") for problem in growing.problems()),
    }
    for found in families.values():
        sizes = [p.size for p in found]
        assert sizes == sorted(set(sizes)) and len(sizes) >= 4
        assert len({len(p.formula) for p in found}) > 1


def test_the_ball_families_have_the_origin_in_common():
    for problem in scaling.problems():
        if "balls" in problem.set:
            body = problem.formula.partition(". ")[2]
            origin = dict.fromkeys(read(body).free, 0)
            from qe.formula.evaluate import holds_at

            assert holds_at(read(body), origin)


@each("--suite", "--solver")
def test_unknown_names_give_one_line(option, capsys, tmp_path):
    known = [] if option == "--suite" else ["--suite", "paper"]
    assert cli.main(["run", *known, option, "nonesuch", "--results", str(tmp_path / "r")]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1 and f"{option}: one of " in error and "'nonesuch' found" in error
    assert not (tmp_path / "r").exists()


def test_the_ablation_runs_every_stage():
    assert set(suite("ablation").solvers) == {"ours", *(f"ours-without-{stage.value}" for stage in qe.Stage)}


@each("--limit", "--memory")
def test_limits_are_positive(option, capsys, tmp_path):
    arguments = ["run", "--suite", "paper", option, "-1", "--results", str(tmp_path / "r.jsonl")]
    assert cli.main(arguments) == 2
    assert option in capsys.readouterr().err
    assert not (tmp_path / "r.jsonl").exists()


def test_an_expected_answer_about_other_variables_is_none(tmp_path):
    """Of a question on a it spoke of b and c, which were bound there: a right answer was called wrong."""
    record = {"id": "one", "free": ["a"], "formula": "ex b, c. a = b^2 + c^2"}
    file = tmp_path / "set.jsonl"
    file.write_text(
        "\n".join(json.dumps({**record, "expected": text}) for text in ("b = 1 /\\ c = 2", "a >= 0", "true"))
    )
    assert [problem.expected for problem in corpus._lines("set", file)] == [None, "a >= 0", "true"]


LIMITS = Limits(20.0, 1500)
QEPCAD = pytest.param("qepcad", marks=pytest.mark.skipif(not shutil.which("qepcad"), reason="qepcad is not installed"))
SENTENCES = {
    "ex x, y. x^2 + y^2 <= 1 and x*y > 1/2": "false",
    "all x. x^2 + 1 > 0": "true",
    "all x. x^2 > 0": "false",
    "ex x. x^3 = 2": "true",
}
WITH_PARAMETERS = {
    "ex x. x > 0 and a_1*x = v0": "a_1*v0 > 0 or a_1 = 0 and v0 = 0",
    "all x. x^2 + b*x + 1 >= 0": "b^2 <= 4",
}


def solved_by(name, formula):
    adapter = ours(name) if name in ENGINES else PEERS[name]
    return adapter(read(formula), LIMITS)


@pytest.mark.parametrize(
    "name",
    [OURS, "ours-cad", "ours-cad-mccallum", "ours-without-partial", "sympy-extras", "z3", "cvc5", "yices", QEPCAD],
)
def test_sentences(name):
    for formula, expected in SENTENCES.items():
        answer = solved_by(name, formula)
        assert answer.text == expected and answer.seconds > 0


@pytest.mark.parametrize("name", [OURS, "ours-vs", "sympy-extras", QEPCAD])
def test_parameters(name):
    for formula, expected in WITH_PARAMETERS.items():
        assert compare(solved_by(name, formula).text, expected) is Verdict.EQUIVALENT


def test_semialg():
    assert solved_by("semialg", "ex x. x^2 + 1 < 0").text == "false"
    assert compare(solved_by("semialg", "ex x. x > 0 and x < b_1").text, "b_1 > 0") is Verdict.EQUIVALENT


@each("z3", "cvc5", "yices")
def test_smt_solvers_take_sentences_only(name):
    with pytest.raises(NotSupported):
        solved_by(name, "ex x. x^2 = a")


def test_yices_takes_one_block():
    with pytest.raises(NotSupported, match="one block"):
        solved_by("yices", "all x. ex y. y > x")


def test_a_form_with_square_roots_is_translated_back():
    answer = solved_by("sympy-extras", "all x. x >= 0 and x <= 1 -> h^2 + 2*h*x^2 <= 7 + x")
    assert compare(answer.text, "(h >= 0 and h^2 + 2*h <= 8) or (h < 0 and h^2 <= 7)") is Verdict.EQUIVALENT


def test_our_inability_is_told():
    balls = " and ".join(f"(x - {i})^2 + (y - a*{i})^2 + (z - b)^2 <= {7 + i}" for i in range(6))
    with pytest.raises(Unable, match="time"):
        ours("ours-cad")(read(f"ex x, y, z. {balls}"), Limits(0.2, 1500))


def test_all_names_have_an_adapter():
    assert set(NAMES) == {*ENGINES, *PEERS}


def test_the_program(root):
    task = {"formula": "ex x. x^2 = a", "limit": 5, "memory": 1000}
    command = [sys.executable, "-m", "experiments.adapters", "z3"]
    done = subprocess.run(command, input=json.dumps(task), capture_output=True, text=True, cwd=root, check=True)
    ready, report = map(json.loads, done.stdout.splitlines())
    assert ready == {"ready": True} and report["status"] == "unsupported" and "sentences only" in report["message"]


def write_script(folder: Path, name: str, status: str, condition: str) -> None:
    text = f"(set-info :status {status})(declare-const x Real)(assert {condition})(check-sat)(get-info :name)"
    (folder / name).write_text(text)


def test_verdicts_are_counted_and_contradictions_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_script(tmp_path, "right.smt2", "sat", "(= (* x x) 2)")
    assert main(["scripts", str(tmp_path)]) == 0
    assert "1 of 1 scripts decided in 20 s, 0 wrong, 0 open" in capsys.readouterr().out
    write_script(tmp_path, "wrong.smt2", "unsat", "(= (* x x) 2)")
    assert main(["scripts", str(tmp_path), "--only", "wrong"]) == 1
    printed = capsys.readouterr().out
    assert "WRONG" in printed
    assert "0 of 1 scripts decided in 20 s, 1 wrong, 0 open" in printed


def test_what_is_known_comes_from_the_script_or_the_index(tmp_path: Path) -> None:
    write_script(tmp_path, "a.smt2", "unsat", "true")
    write_script(tmp_path, "b.smt2", "unknown", "true")
    write_script(tmp_path, "c.smt2", "unknown", "true")
    rows = [{"file": "a.smt2", "status": "sat"}, {"file": "b.smt2", "status": "unknown", "z3": "sat"}]
    (tmp_path / "index.jsonl").write_text("\n".join(map(json.dumps, rows)))
    assert known_answers(tmp_path) == {"a.smt2": "unsat", "b.smt2": "sat"}


def test_a_folder_without_scripts_is_refused(tmp_path: Path) -> None:
    assert main(["scripts", str(tmp_path)]) == 2


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

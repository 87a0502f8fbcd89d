"""Scripts, adapters of other programs, and suites of problems."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import qe
from experiments import cli
from experiments.adapters.__main__ import PEERS
from experiments.adapters.answer import Limits, NotSupported
from experiments.adapters.ours import ours
from experiments.cli import main
from experiments.compare import Verdict, compare
from experiments.scripts import known_answers
from experiments.solvers import ENGINES, NAMES, OURS
from experiments.suites import SUITES, corpus, paper, scaling, suite
from qe.errors import InputError, Unable
from qe.formula.traverse import is_quantifier_free
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
            assert is_quantifier_free(expected) and set(expected.free) <= set(formula.free)


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


def solve(name, formula):
    adapter = ours(name) if name in ENGINES else PEERS[name]
    return adapter(read(formula), LIMITS)


@pytest.mark.parametrize(
    "name",
    [OURS, "ours-cad", "ours-cad-mccallum", "ours-without-partial", "sympy-extras", "z3", "cvc5", "yices", QEPCAD],
)
def test_sentences(name):
    for formula, expected in SENTENCES.items():
        answer = solve(name, formula)
        assert answer.text == expected and answer.seconds > 0


@pytest.mark.parametrize("name", [OURS, "ours-vs", "sympy-extras", QEPCAD])
def test_parameters(name):
    for formula, expected in WITH_PARAMETERS.items():
        assert compare(solve(name, formula).text, expected) is Verdict.EQUIVALENT


def test_semialg():
    assert solve("semialg", "ex x. x^2 + 1 < 0").text == "false"
    assert compare(solve("semialg", "ex x. x > 0 and x < b_1").text, "b_1 > 0") is Verdict.EQUIVALENT


@each("z3", "cvc5", "yices")
def test_smt_solvers_take_sentences_only(name):
    with pytest.raises(NotSupported):
        solve(name, "ex x. x^2 = a")


def test_yices_takes_one_block():
    with pytest.raises(NotSupported, match="one block"):
        solve("yices", "all x. ex y. y > x")


def test_a_form_with_square_roots_is_translated_back():
    answer = solve("sympy-extras", "all x. x >= 0 and x <= 1 -> h^2 + 2*h*x^2 <= 7 + x")
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

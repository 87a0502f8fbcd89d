"""The suites: every formula reads, and the known answers are right."""

import json

import pytest

import qe
from experiments import cli
from experiments.compare import Verdict, compare
from experiments.suites import SUITES, corpus, paper, scaling, suite
from qe.errors import InputError
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

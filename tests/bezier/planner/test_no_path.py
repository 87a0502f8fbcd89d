"""Plans without a path, derivations of plans, and the files of a plan."""

from __future__ import annotations

import json
import os
import time
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bezier
import qe
from bezier.check.recheck import recheck
from bezier.planner import derivations
from bezier.planner.command import write_folder
from bezier.planner.outputs import all_or_none, facts
from bezier.planner.planning import make_plan
from bezier.plans import Clock, Outcome
from bezier.problem import ends_inside, load_problem, read_problem
from qe.api.verify import with_derivation
from qe.errors import CertificateRejected, InputError, QEError
from qe.formula.syntax import FALSE
from qe.proof.certificate import Certificate, Kind
from tests.bezier.folder_mutation import Quiet
from tests.bezier.made import CRATE_TEXT as CRATE
from tests.tables import each

VIA = 'via = [["-3/2", 2, 3], ["3/2", 2, 3]]\n'


METHODS = ("quadratic", "cubic", "single")


def problem_text(start: str, goal: str, more: str = CRATE, *, method: str = "cubic", via: str = VIA) -> str:
    single = "[single]\ndegree = 5\np = 1\nq = 3\n" if method == "single" else ""
    return f'method = "{method}"\nstart = {start}\ngoal = {goal}\nradius = 6\n{via}{single}{more}'


def folder_of(text: str, folder: Path) -> dict:
    """The summary of what ``bezier plan`` writes, which ``bezier check`` accepts."""
    folder.mkdir()
    clock = Clock()
    write_folder(make_plan(read_problem(text), clock, proofs=True), folder, folder, clock, plots=False)
    recheck(Quiet(), folder)
    return json.loads((folder / "summary.json").read_text())


@pytest.mark.parametrize("via", ["", VIA], ids=["no via points", "via points"])
@each("quadratic", "cubic")
@pytest.mark.parametrize(
    ("start", "goal", "ends"),
    [
        ("[0, 2, 1]", "[4, 2, 1]", ["start"]),
        ("[-4, 2, 1]", '["11/10", 2, 1]', ["goal"]),
        ("[-1, 1, 2]", "[1, 3, 0]", ["start", "goal"]),
    ],
    ids=["start", "goal touches", "both"],
)
def test_an_end_in_an_obstacle_is_refuted_at_once(start, goal, ends, method, via, tmp_path) -> None:
    """Twelve attempts and 20 s, and then "a path may exist all the same"."""
    begin = time.process_time()
    told = folder_of(problem_text(start, goal, method=method, via=via), tmp_path / "out")
    assert time.process_time() - begin < 5 and len(told["attempts"]) == 1
    assert told["status"] == "infeasible" and told["certified"] and told["reason"].startswith("no path exists: ")
    assert [item["point"] for item in told["inside"]] == ends and all("crate" in told["reason"] for _ in ends)
    assert "may exist" not in json.dumps(told)
    certificate = qe.Certificate.from_json((tmp_path / "out" / "certificate.json").read_text())
    assert qe.verify(certificate).accepted and [m.label for m in certificate.payload] == [f"{e} in crate" for e in ends]


def test_certificates_of_another_place_are_rejected(tmp_path) -> None:
    folder_of(problem_text("[0, 2, 1]", "[4, 2, 1]"), tmp_path / "out")
    file = tmp_path / "out" / "certificate.json"
    file.write_text(file.read_text().replace('"1"', '"1/2"'))
    with pytest.raises(CertificateRejected):
        recheck(Quiet(), tmp_path / "out")


def test_an_obstacle_with_quantifiers_refutes_too(tmp_path) -> None:
    shadow = '[[obstacle]]\nkind = "formula"\nname = "shadow"\nformula = "ex w. w^2 + x^2 + y^2 + z^2 < 1"\n'
    told = folder_of(problem_text('["1/2", 0, 0]', "[4, 2, 1]", shadow), tmp_path / "in")
    assert told["status"] == "infeasible" and "the start (1/2, 0, 0) lies in the obstacle shadow" in told["reason"]
    touching = folder_of(problem_text("[-1, 0, 0]", "[4, 2, 1]", shadow), tmp_path / "on")
    assert touching["status"] == "solved" and "inside" not in touching


def test_a_search_that_gave_up_says_no_path_found(tmp_path) -> None:
    """``reason`` was empty for status blocked."""
    wall = '[[obstacle]]\nkind = "box"\nname = "wall"\nlow = [-1, -7, -7]\nhigh = [1, 7, 7]\n'
    told = folder_of(problem_text("[-4, 2, 1]", "[4, 2, 1]", wall), tmp_path / "out")
    assert told["status"] == "blocked" and told["reason"].startswith("no path found: ") and "wall" in told["reason"]
    page = (tmp_path / "out" / "report.html").read_text()
    assert "no path found" in page and "no path exists" not in page


def test_python_tells_them_apart() -> None:
    ends = {"via": [["-3/2", 2, 3], ["3/2", 2, 3]], "goal": [4, 2, 1], "radius": 6, "method": "cubic"}
    ball = {"kind": "ball", "centre": [-4, 2, 1], "radius": 1}
    with pytest.raises(bezier.NoPath, match=r"^no path exists: the start") as caught:
        bezier.plan(start=[-4, 2, 1], obstacles=[ball], **ends)
    assert caught.value.plan.outcome is bezier.Outcome.INFEASIBLE
    assert qe.verify(caught.value.plan.certificate).accepted


def test_every_status_without_success_has_a_reason() -> None:
    contradiction = "".join(f'[[half_space]]\nnormal = [{n}, 0, 0]\noffset = 1\npoints = ["Q1"]\n' for n in (1, -1))
    fast = '[timing]\nlaw = "quintic"\nduration = 1\nmax_speed = "1/10"\n'
    for more, status in ((contradiction, "infeasible"), (fast, "limits_not_kept"), (CRATE, "solved")):
        told = facts(make_plan(read_problem(problem_text("[-4, 2, 1]", "[4, 2, 1]", more))))
        assert told["status"] == status and bool(told.get("reason")) == (status != "solved")


sides = st.tuples(*[st.integers(-40, 40)] * 3)


@settings(max_examples=25, deadline=None)
@given(sides, st.integers(1, 30), st.sampled_from(["start", "goal"]))
def test_an_end_is_inside_exactly_where_the_obstacle_contains_it(offset, radius, end) -> None:
    at = {"start": (-4, 2, 1), "goal": (4, 2, 1)}[end]
    centre = ", ".join(f'"{10 * c + o}/10"' for c, o in zip(at, offset, strict=True))
    ball = f'[[obstacle]]\nkind = "ball"\ncentre = [{centre}]\nradius = "{radius}/10"\n'
    problem = read_problem(problem_text("[-4, 2, 1]", "[4, 2, 1]", ball))
    inside = sum(o * o for o in offset) <= radius * radius
    assert [i.name for i in ends_inside(problem) if i.name == end] == [end] * inside


def test_both_words_are_statuses_of_their_own() -> None:
    assert len({Outcome.BLOCKED.value, Outcome.INFEASIBLE.value}) == 2 and issubclass(bezier.NoPath, QEError)


NEAR = {"start": (-4, 1, 1), "via": [(-1, 3, 3), (1, 3, 3)], "goal": ("9/2", 1, 1)}


@pytest.fixture(scope="module")
def plain(root):
    return make_plan(load_problem(root / "examples" / "three_balls.toml"))


@pytest.fixture(scope="module")
def plan(plain):
    return derivations.with_derivations(plain, Clock())


def members(plan):
    return {m.label: m.certificate for m in plan.certificate.payload}


def test_only_who_asks_gets_them(plain):
    assert not plain.derivations and not any(label.startswith(derivations.PREFIX) for label in members(plain))
    assert set(plain.eliminations) == {"formula (8)", "the condition z ≥ 0"}


def test_each_is_accepted_and_about_its_question(plain, plan):
    assert set(plan.derivations) == set(plain.eliminations) and not plan.unproved
    for name, question in derivations.questions(plan).items():
        if name in plan.derivations:
            certificate = members(plan)[derivations.PREFIX + name]
            assert certificate.kind == Kind.DERIVATION
            assert qe.verify(certificate, formula=question).accepted
    assert members(plain).items() <= members(plan).items()
    assert qe.verify(plan.certificate).accepted


def test_nothing_is_eliminated_a_second_time(plain, plan, monkeypatch):
    def refuse(*_, **__):
        raise AssertionError("eliminated again")

    monkeypatch.setattr("qe.engine.run.answered", refuse)
    monkeypatch.setattr(qe, "eliminate", refuse)
    again = derivations.with_derivations(plain, Clock())
    assert again.certificate.to_json() == plan.certificate.to_json()


def test_another_answer_gets_none(plain):
    false = replace(plain.eliminations["formula (8)"], formula=FALSE, certificate=None)
    found = with_derivation(false, timeout=1)
    assert found.certificate is None and found.why_unchecked and found.guarantee is qe.Guarantee.DERIVED
    made = derivations.with_derivations(replace(plain, eliminations={"formula (8)": false}), Clock(limit=1))
    assert not made.derivations and set(made.unproved) == {"formula (8)"}


def test_the_pages_have_the_steps_with_their_theorems(plan):
    pages = derivations.pages(plan)
    assert list(pages) == ["derivation_1.html", "derivation_2.html"] == list(plan.derivation_pages.values())
    for name, page in zip(plan.derivations, pages.values(), strict=True):
        assert f"<h1>The elimination of {name}</h1>" in page and "Every step was checked" in page
        rules = [rule for rule in plan.derivations[name].rules if rule != "steps"]  # which are made of others
        assert page.count("<summary>theorem</summary>") >= len(rules)


def test_what_a_folder_states_is_about_this_problem(plain, plan):
    found = derivations.with_stated(plain, plan.certificate)
    assert found.certificate == plan.certificate
    assert {n: d.rules for n, d in found.derivations.items()} == {n: d.rules for n, d in plan.derivations.items()}
    table = members(plan)["derivation of the condition z ≥ 0"]
    for label, certificate in (
        ("derivation of formula (8)", table),
        ("derivation of formula (9)", table),
        ("derivation of the condition z ≥ 0", members(plan)["optimum"]),
    ):
        with pytest.raises(CertificateRejected) as caught:
            derivations.with_stated(plain, Certificate.bundle([(label, certificate)]))
        assert caught.value.step == label


def test_what_the_radius_forces_and_obstacles_with_quantifiers():
    wall = {"kind": "formula", "name": "hill", "formula": "ex w. x^2 + y^2 + z^2 + w^2 < 1/4"}
    given = {**NEAR, "via": [(-3, 4, 0), (3, 4, 0)], "start": (-4, 0, 0), "goal": (4, 0, 0)}
    made = bezier.plan(**given, method="cubic", obstacles=[wall], proofs=True)
    names = ["formula (7)", "what the radius forces at Q0", "what the radius forces at R0", "the obstacle hill"]
    assert sorted(made.derivations) == sorted(names) and made.found.outcome is Outcome.SOLVED
    assert made.certified and qe.verify(made.certificate).accepted


def test_flags_only():
    with pytest.raises(qe.InputError, match="proofs"):
        bezier.plan(**NEAR, proofs="yes please")


def names(folder):
    return sorted(p.name for p in folder.iterdir())


def test_a_new_folder(tmp_path):
    target = tmp_path / "a" / "b"
    with all_or_none(target) as folder:
        (folder / "x").write_text("1")
        assert not target.exists()
    assert names(target) == ["x"] and names(tmp_path) == ["a"]


def test_an_old_folder_keeps_other_files(tmp_path):
    target = tmp_path / "out"
    target.mkdir()
    (target / "mine").write_text("keep")
    (target / "x").write_text("old")
    with all_or_none(target) as folder:
        (folder / "x").write_text("new")
    assert names(target) == ["mine", "x"] and (target / "x").read_text() == "new" and names(tmp_path) == ["out"]


def test_nothing_is_left_after_a_failure(tmp_path):
    target = tmp_path / "out"
    with pytest.raises(RuntimeError), all_or_none(target) as folder:
        (folder / "x").write_text("1")
        raise RuntimeError
    assert names(tmp_path) == []


def test_a_file_in_the_way(tmp_path):
    (tmp_path / "out").write_text("")
    with pytest.raises(InputError, match="expected a folder"), all_or_none(tmp_path / "out"):
        pass
    with pytest.raises(InputError, match="not writable"), all_or_none(tmp_path / "out" / "deeper"):
        pass


def test_a_folder_without_permission(tmp_path):
    if os.geteuid() == 0:
        target = "/proc/out"  # not even the superuser can write there
    else:
        tmp_path.chmod(0o500)
        target = tmp_path / "out"
    from pathlib import Path

    with pytest.raises(InputError, match="expected a writable folder"), all_or_none(Path(target)):
        pass


def plan_into(target, *written, listed=None):
    """A run that writes these files, and lists them in its summary, or the ones given."""
    with all_or_none(target) as folder:
        for name in written:
            (folder / name).write_text("{}")
        files = [f"somewhere/{name}" for name in (written if listed is None else listed)]
        (folder / "summary.json").write_text(json.dumps({"files": files}))


def test_a_second_run_removes_what_the_first_one_listed_as_its_own(tmp_path):
    target = tmp_path / "out"
    plan_into(target, "region.json", "path.json", "region.png")
    (target / "notes.txt").write_text("mine")
    plan_into(target, "path.json")
    assert names(target) == ["notes.txt", "path.json", "summary.json"]


def test_a_second_run_removes_nothing_else(tmp_path):
    target = tmp_path / "out"
    # a summary may list anything: only names that planning writes are removed, and only in this folder
    plan_into(target, "path.json", listed=["path.json", "notes.txt", "../outside.txt", "compare.json"])
    for name in ("notes.txt", "region.json", "compare.json"):  # region.json is not listed: it is somebody's own
        (target / name).write_text("mine")
    (tmp_path / "outside.txt").write_text("mine")
    plan_into(target)
    assert names(target) == ["compare.json", "notes.txt", "region.json", "summary.json"]
    assert (tmp_path / "outside.txt").exists()


@each("", "[]", '{"files": 3}', '{"files": [3]}', "[" * 100_000, "\ud800".encode("utf-8", "ignore"))
def test_an_unreadable_listing_removes_nothing(old, tmp_path):
    target = tmp_path / "out"
    target.mkdir()
    (target / "path.json").write_text("mine")
    (target / "summary.json").write_bytes(old if isinstance(old, bytes) else old.encode())
    plan_into(target)
    assert names(target) == ["path.json", "summary.json"]


def test_a_failed_run_removes_nothing(tmp_path):
    target = tmp_path / "out"
    plan_into(target, "region.json")
    with pytest.raises(RuntimeError), all_or_none(target) as folder:
        (folder / "summary.json").write_text('{"files": []}')
        raise RuntimeError
    assert names(target) == ["region.json", "summary.json"]

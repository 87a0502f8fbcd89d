"""No path found and no path exists: different words and different statuses, and always a reason."""

from __future__ import annotations

import json
import time
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bezier
import qe
from bezier.check.recheck import recheck
from bezier.planner.command import write_folder
from bezier.planner.outputs import facts
from bezier.planner.planning import make_plan
from bezier.plans import Clock, Outcome
from bezier.problem import ends_inside, read_problem
from qe.errors import CertificateRejected, QEError
from tests.bezier.folder_mutation import Quiet
from tests.tables import each

CRATE = """
[[obstacle]]
kind = "box"
name = "crate"
low = [-1, 1, 0]
high = [1, 3, 2]
margin = "1/10"
"""
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

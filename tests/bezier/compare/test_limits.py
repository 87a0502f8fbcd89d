"""A comparison shows what was finished and says why the rest is not."""

from __future__ import annotations

import json
import time

import pytest

import qe
from bezier.compare import comparison
from bezier.compare.command import render
from bezier.compare.comparison import Comparison, _Parts, compare
from bezier.compare.output import NOT_REACHED, notes, rows, table, to_json
from bezier.plans import Clock
from bezier.problem import read_problem
from qe.errors import BudgetExceeded, Unable

PROBLEM = """\
method = "cubic"
workspace = "ball"
start = [-4, 1, 1]
via = [["-7/4", 2, "5/2"], ["3/2", 2, "5/2"]]
goal = [4, 1, 1]
radius = "17/4"
"""
"""Regions (8*) and (7) of this problem take long; its plans do not."""


@pytest.fixture(scope="module")
def found() -> Comparison:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(comparison, "COMPARE_SECONDS", 0.2)
        return compare(read_problem(PROBLEM), proofs=True)


def test_parts_that_finish_are_there(found):
    assert all(side.plan.path is not None for side in found.sides.values())
    assert found.planar.whole.region is None and found.planar.cubic.region is None
    assert found.planar.named["(8*)"].reason and "limit" in found.unfinished["planar region of (7)"]


def test_derivations_are_in_the_certificate_and_linked(found):
    assert {"formula (8)", "formula (7)", "the question of the table"} <= set(found.derivations)
    labels = [member.label for member in found.certificate.payload]
    assert {"(8): optimum", "(7): optimum", "derivation of formula (7)"} <= set(labels)
    for name, page in found.derivation_pages.items():
        assert f'href="{page}"' in render(found, {}) and qe.verify(found.derivations[name].certificate).accepted


def test_every_form_shows_them_and_says_why_the_rest_is_missing(found):
    text = table(found)
    assert "path found" in text and "planar region of (7): not finished, time limit" in text
    data = json.loads(json.dumps(to_json(found, [])))
    assert data["planar"]["regions"]["(7)"]["cells"] is None and "limit" in data["planar"]["regions"]["(7)"]["reason"]
    assert data["unfinished"].keys() == found.unfinished.keys() >= {"planar region of (7)", "planar region of (8*)"}
    page = render(found, {})
    assert "path found" in page and "not finished" in page
    cells = {label: cells for label, *cells in rows(found)}
    assert cells["area of Q1 in the plane, mm²"][1] == NOT_REACHED
    assert any(line.startswith("planar region of (8*): not finished") for line in notes(found))


def test_a_part_gets_its_share_and_leaves_the_others_theirs():
    seen: list[float] = []

    def work(seconds: float) -> str:
        seen.append(seconds)
        raise BudgetExceeded("time limit reached")

    parts = _Parts(Clock(limit=10.0))
    assert parts.take("first", 2, work) is None and parts.take("second", 1, work) is None
    assert 4 < seen[0] < 4.3 and 8 < seen[1] < 8.6
    assert parts.unfinished == {"first": "time limit reached", "second": "time limit reached"}
    assert parts.take("third", 1, lambda seconds: "done") == "done" and "third" in parts.clock.seconds


def test_after_the_limit_parts_are_left_out_at_once():
    parts = _Parts(Clock(limit=0.01))
    time.sleep(0.02)
    assert parts.take("late", 1, lambda seconds: pytest.fail("it was begun")) is None
    assert "limit" in parts.unfinished["late"]


def test_a_region_is_shown_without_its_area(monkeypatch):
    def no_area(*arguments: object, **keywords: object) -> None:
        raise Unable("too curved")

    monkeypatch.setattr(comparison, "convex_area", no_area)
    problem = read_problem(PROBLEM)
    plane = comparison.Plane.through(problem)
    formula = comparison.planar_statements(problem, plane)["(8)"]
    part = comparison._region(formula, plane, Clock(), 20.0)
    assert part.region is not None and part.region._pieces and part.area is None
    assert part.reason == "area not found: too curved"


def test_a_region_is_limited_by_processor_time_not_by_the_clock():
    """On a busy machine (8*) was not reached: 30 s by the clock were 10 s of work."""
    problem = read_problem(PROBLEM)
    plane = comparison.Plane.through(problem)
    formula, begin = comparison.planar_statements(problem, plane)["(8*)"], comparison.processor_time()
    with pytest.raises(Unable, match="limit of 2 s of processor time"):
        comparison._region(formula, plane, Clock(), 2.0)
    assert 1.5 < comparison.processor_time() - begin < 5

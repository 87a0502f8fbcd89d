"""The first screen: numbers of enclosures, the cards of a problem, and the scene of its path."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path as FilePath

import pytest
from hypothesis import given
from hypothesis import strategies as st

import qe
from bezier.curves.enclosure import Enclosure
from bezier.planner.planning import make_plan
from bezier.planner.table import method_of
from bezier.plans import Clock, Plan
from bezier.problem import load_problem, read_problem
from bezier.report import first, mathml
from bezier.report.page import page_of, render
from tests.tables import each

START = 'start = [-4, 2, 1]\nvia = [[-1, 2, "5/2"], [1, 2, "5/2"]]\ngoal = [4, 2, 1]\nradius = 6\n'
LIMITS = "[timing]\nmax_speed = 2\n"
GOING_ROUND = '[[obstacle]]\nname = "pole"\nkind = "ball"\ncentre = [0, -3, 1]\nradius = 1\n'


@cache
def planned(*tables: str) -> Plan:
    """Planned once; tests leave it as it is."""
    return make_plan(read_problem("\n".join(tables), "problem.toml"), Clock())


@given(st.fractions(0, 1000), st.fractions(0, Fraction(1, 10)))
def test_a_number_shown_for_an_enclosure_is_right_to_its_last_digit(low: Fraction, width: Fraction) -> None:
    text = Enclosure(low, low + width).shown()
    if "…" not in text:
        digits = len(re.sub(r"e.*|\D", "", text).lstrip("0"))
        unit = Fraction(10) ** (len(str(int(low + width))) - digits + 1)
        assert abs(Fraction(text) - low) <= unit and abs(Fraction(text) - low - width) <= unit
    else:
        below, above = map(Fraction, text.split(" … "))
        assert below <= low and low + width <= above


def test_no_end_is_said() -> None:
    assert Enclosure(Fraction(3), None).shown().startswith("at least 3")


def labels(plan: Plan) -> list[str]:
    return [card.label for card in first.cards(plan)]


def test_cards_are_those_of_the_problem() -> None:
    plain = planned(START)
    assert "least distance to an obstacle" not in labels(plain) and "least time" not in labels(plain)
    full = planned(START, LIMITS, GOING_ROUND)
    assert {"result", "length", "least distance to an obstacle", "least time", "largest curvature"} <= {*labels(full)}
    told = {card.label: card for card in first.cards(full)}
    assert told["least time"].note == "quintic law; limits kept at all times, proved"
    assert full.quality is not None and full.quality.motion is not None
    assert float(told["least time"].value.split()[0]) == pytest.approx(float(full.quality.motion.duration), rel=1e-4)
    assert told["result"].note.startswith("proved") and "NOT" not in told["result"].note


def test_solving_and_drawing_are_told_apart() -> None:
    plan = replace(planned(START), seconds={"elimination": 1.0, "pictures": 2.0, "report": 0.5})
    card = first.cards(plan)[-1]
    assert (card.value, card.note) == ("1.00 s solving", "2.50 s drawing")


def test_where_there_is_no_path_the_reason_comes_first(root: FilePath) -> None:
    plan = make_plan(load_problem(root / "examples" / "no_control_point.toml"))
    page = page_of(plan, method_of(plan.problem.method), None)
    assert page.sections[0].key == "none" and "least 6" in page.sections[0].content
    assert page.title == "no control point: no path exists" and page.first is None


def test_the_scene_moves_with_the_motion(tmp_path: FilePath) -> None:
    plan = planned(START, LIMITS, GOING_ROUND)
    method = method_of(plan.problem.method)
    page = render(plan, method, method.draw(plan, tmp_path))
    data = json.loads(re.findall(r'type="application/json">(.*?)</script>', page)[0])
    assert plan.quality is not None and plan.quality.motion is not None
    end = float(plan.quality.motion.duration)
    assert data["motion"]["unit"] == "s" and data["motion"]["t"][-1] == pytest.approx(end, rel=1e-4)
    assert data["motion"]["p"][:3] == [-4, 2, 1] and data["motion"]["p"][-3:] == [4, 2, 1]
    assert max(data["motion"]["speed"]) <= 2.001 and len(data["bodies"]) == 1
    assert page.count("<canvas") == page.count('<canvas role="img" tabindex="0" aria-label="')
    assert page.count("<svg") == page.count('<svg role="img" aria-label="') and len(page) < 1_500_000


@each(("x^2 - 2*a", "<mo>−</mo>"), ("2*x^2 - a", "<mfrac>"), ("x^2 - a*x + 1", "<mfrac>"))
def test_a_bound_of_degree_two_is_a_radical_over_a_number_above_one(poly: str, shape: str) -> None:
    (cell,) = qe.region(f"{poly} < 0 and a > 0 and a < 10", order=("a", "x")).cells[-1:]
    written = mathml.cell(cell)[-1]
    assert shape in written and "<msqrt>" in written and ("<mfrac>" in written) is (shape == "<mfrac>")

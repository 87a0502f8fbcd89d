"""``bezier.plan`` gives the path at once; what is proved and measured about it is found once, when asked for, in the
limits of the call, and is what planning at once would have found."""

from __future__ import annotations

import pickle
import threading
from collections.abc import Iterator

import pytest

import bezier
import qe
from bezier.interface import work
from bezier.methods.control import optimal_path
from bezier.planner.outputs import facts
from bezier.planner.planning import make_plan
from qe.kernel.verdict import Verdict
from qe.processes.worker import IDLE, end_idle
from tests.tables import each
from tests.workers import large, replace_in_worker, stuck

CUBIC = {"start": [-4, 2, 1], "via": [["-3/2", 2, 3], ["3/2", 2, 3]], "goal": [4, 2, 1], "radius": 6, "method": "cubic"}


@pytest.fixture(autouse=True)
def afresh() -> Iterator[None]:
    """What was replaced in a worker ends with it."""
    yield
    end_idle()


@pytest.fixture
def finished(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """One entry for each time that the second part of a plan was worked out, in this process."""
    calls: list[str] = []
    own = work.finish_plan

    def counted(*args, **named):
        calls.append("")
        return own(*args, **named)

    monkeypatch.setattr(work, "finish_plan", counted)
    return calls


def test_the_path_asks_for_no_verification(finished):
    plan = bezier.plan(**CUBIC)
    assert plan.path.is_inside and plan.points["Q1"] and plan(1.5).shape == plan.velocity(1.5).shape == (3,)
    assert (
        plan.outcome.value == "solved" and plan.motion is None and plan.duration == 3 and plan == bezier.plan(**CUBIC)
    )
    assert "G1" in plan.to_gcode() and "<svg" in plan.to_svg() and plan.to_csv().count("\n") > 100
    assert not finished


def test_what_is_asked_for_is_found_once_and_is_that_of_planning_at_once(finished):
    plan = bezier.plan(**CUBIC)
    threads = [threading.Thread(target=lambda: plan.certified) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(300)
    assert plan.certified and qe.verify(plan.certificate).accepted and plan.length.low > 8
    assert plan.to_json() == facts(make_plan(plan.problem)) and "certified" in repr(plan)
    assert len(finished) == 1


@each("cubic", "quadratic")
def test_certified_is_what_the_checker_says(method, monkeypatch):
    plan = bezier.plan(**{**CUBIC, "method": method})
    monkeypatch.setattr(optimal_path.qe, "verify", lambda certificate: Verdict(False, "cells", "for this test"))
    assert not plan.certified and "not certified" in repr(plan)


def test_a_plan_is_stored_whole(finished):
    plan = bezier.plan(**CUBIC)
    again = pickle.loads(pickle.dumps(plan))
    assert len(finished) == 1 and again == plan and again.certified and again.length == plan.length
    assert len(finished) == 1


def test_the_limit_holds_for_what_is_asked_for_later():
    plan = bezier.plan(**CUBIC, timeout=20)
    replace_in_worker("bezier.interface.work.finish_plan", stuck)
    plan.work.seconds = 19.5
    with pytest.raises(qe.BudgetExceeded):
        _ = plan.certified
    assert not any(worker.is_loaded for worker in IDLE)  # one that is new loads
    plan.work.seconds = 21.0
    with pytest.raises(qe.BudgetExceeded, match="time limit of 20 s"):
        _ = plan.certificate
    assert plan.points["Q1"] and "not known" in repr(plan)


def test_the_memory_holds_for_what_is_asked_for_later():
    plan = bezier.plan(**CUBIC, memory=2000)
    replace_in_worker("bezier.interface.work.finish_plan", large)
    with pytest.raises(qe.BudgetExceeded):
        _ = plan.certified

"""Answers do not depend on the process in which they are found, nor on the step at which the question moves."""

from __future__ import annotations

import pickle

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.formula.build import exists
from qe.formula.syntax import Formula
from qe.options import Budget, Handover
from tests.strategies import formulas

pytestmark = pytest.mark.processes

NAMES = ("x", "y")


@pytest.fixture(autouse=True, scope="module")
def move_early():
    """Every piece of work moves, some at once and some late."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("qe.processes.execution.HERE", 0.002)
        patch.setattr("qe.processes.execution.COLD", 0.002)
        yield


@settings(max_examples=15, deadline=None)
@given(formulas(names=NAMES, max_depth=1))
def test_elimination(formula: Formula):
    question = exists(("x",), formula)
    moved, stayed = qe.eliminate(question), qe.eliminate(question, process=False)
    assert (moved.status, moved.formula, moved.witness) == (stayed.status, stayed.formula, stayed.witness)


@settings(max_examples=12, deadline=None)
@given(formulas(names=NAMES, max_depth=1))
def test_regions(formula: Formula):
    moved, stayed = (qe.region(formula, order=NAMES, process=flag) for flag in (True, False))
    assert moved.table == stayed.table
    again = pickle.loads(pickle.dumps(moved))
    assert again.table == stayed.table
    for region in (moved, again):
        assert region.sample_points() == stayed.sample_points()
        assert [str(cell) for cell in region.cells] == [str(cell) for cell in stayed.cells]
        assert all(region.contains(point) for point in region.sample_points())
        if not stayed.is_empty:
            assert region.bounds("x") == stayed.bounds("x")


@settings(max_examples=12, deadline=None)
@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.integers(0, 4)), min_size=1, max_size=3))
def test_optima(discs):
    conditions = " and ".join(f"(x - {a})^2 + (y - {b})^2 <= {r}" for a, b, r in discs)
    moved = qe.minimize("x + 2*y", conditions)
    assert moved == qe.minimize("x + 2*y", conditions, process=False) == pickle.loads(pickle.dumps(moved))
    assert qe.verify(moved.certificate).accepted


@given(st.lists(st.sampled_from(["share", "part", "work"]), max_size=4))
def test_every_part_of_a_budget_moves_with_it(ways):
    moved: list[int] = []
    budget = Budget(handover=Handover(0.0, lambda: moved.append(1)))
    for way in ways:
        budget = {
            "share": lambda b: b.share(0.5),
            "part": lambda b: b.part(None),
            "work": lambda b: b.part(9),
        }[way](budget)
    budget.check("work")
    budget.check("work")
    assert moved == [1]

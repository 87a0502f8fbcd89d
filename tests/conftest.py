"""Shared test settings: hypothesis profiles, and the optional folder of reading material."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from qe.processes import execution
from qe.processes.limits import Limits
from tests.waiting import limit

ROOT = Path(__file__).resolve().parent.parent

# Many tests start a process of their own, and pytest rewrites every test: compiled once, as Python does unless it is
# told not to; without it the whole run takes a tenth longer.
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

# The default is deterministic: the same examples on every machine and in every run.
_COMMON = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow], "print_blob": True}
settings.register_profile("ci", derandomize=True, database=None, max_examples=15, **_COMMON)
settings.register_profile("explore", max_examples=400, **_COMMON)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))


FAR = 5.0
"""Seconds: a longer limit is there for a fault; that it is met is no part of the test."""


LONGEST = 600.0
"""Seconds that a test may take; tests marked ``deep`` are long on purpose, and have forty times as much."""


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[Any]:
    """No wait is without a limit: what a test waits for may never come."""
    with limit(LONGEST * (40 if item.get_closest_marker("deep") else 1)):
        return (yield)


pytest_runtest_setup = pytest_runtest_teardown = pytest_runtest_call


@pytest.fixture(autouse=True, scope="module")
def work_stays_here(request: pytest.FixtureRequest) -> Iterator[None]:
    """Work moves to a worker for near limits alone, except in tests that are marked to be about processes.

    What tests replace they replace in this process; and workers that are killed take their time to start again.
    """
    may_move = execution._may_move

    def near(limits: Limits, deadline: float, outer: Any) -> bool:
        is_near = limits.memory is not None or (limits.timeout is not None and limits.timeout < FAR)
        return is_near and may_move(limits, deadline, outer)

    with pytest.MonkeyPatch.context() as patch:
        if request.node.get_closest_marker("processes") is None:
            patch.setattr(execution, "_may_move", near)
        yield


@pytest.fixture(autouse=True, scope="session")
def workers_start_soon() -> Iterator[None]:
    """A worker loads what is loaded where it was asked: for callers the engine, in tests every module there is."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("qe.processes.worker.PACKAGES", ("qe.engine.", "qe.elimination."))
        yield


@pytest.fixture(autouse=True, scope="module")
def faults_are_heard(request: pytest.FixtureRequest) -> Iterator[None]:
    """An error that ends a proof costs users the proof alone; here it fails a test that is about others."""

    def raised(error: Exception) -> str:
        raise error

    with pytest.MonkeyPatch.context() as patch:
        if request.node.get_closest_marker("faults") is None:
            patch.setattr("qe.proving.certificates.fault", raised)
        yield


def pytest_configure(config: pytest.Config) -> None:
    """Files go to workers as they are collected: small ones, those of ``tests/unit``, are the last.

    pytest-xdist would begin with those of most tests; then one long file of few tests may be all that is left.
    """
    if hasattr(config.option, "loadscopereorder"):  # where pytest-xdist is installed
        config.option.loadscopereorder = False


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Every property test is a deep test, too, of other examples, and of more where it names no number."""
    if "not deep" not in config.option.markexpr:
        for item in items:
            if getattr(getattr(item, "obj", None), "is_hypothesis_test", False):
                item.add_marker("deep")


def pytest_collection_finish() -> None:
    """What was collected stays until the end: no search for garbage goes through it.

    The others are rarer than usual, since tests make little of it: all together take a fortieth less.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 50, 1_000)


@pytest.fixture(scope="session")
def root() -> Path:
    """The project's root folder."""
    return ROOT


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder ``shared`` beside the project, with problem sets; the test is skipped where it is absent."""
    folder = ROOT.parent / "shared"
    if not folder.is_dir():
        pytest.skip("the folder 'shared' is not beside the project")
    return folder

"""Shared test settings: hypothesis profiles, and the optional folder of reading material."""

from __future__ import annotations

import gc
import os
import signal
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from qe.processes import execution
from tests.waiting import limit

ROOT = Path(__file__).resolve().parent.parent

# Many tests start a process of their own, and pytest rewrites every test: compiled once, as Python does unless it is
# told not to; without it the whole run takes a tenth longer.
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

# The default is deterministic: the same examples on every machine and in every run.
_COMMON = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow], "print_blob": True}
settings.register_profile("ci", derandomize=True, database=None, max_examples=25, **_COMMON)
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
def work_moves_later(request: pytest.FixtureRequest) -> Iterator[None]:
    """Work of up to a second stays in its process, except in tests that are marked to be about processes.

    A process that has collected all tests takes as long to fork as many a question to answer, and what the child loads
    is loaded again by the next one. Limits that are far away hold all the same: work that takes longer moves.
    """
    performed = execution._performed

    def later(work: Any, limits: execution.Limits, at_once: bool, kept: list[Any]) -> Any:
        return performed(work, limits, at_once and limits.timeout is not None and limits.timeout < FAR, kept)

    with pytest.MonkeyPatch.context() as patch:
        if request.node.get_closest_marker("processes") is None:
            patch.setattr(execution, "HERE", 1.0)
            patch.setattr(execution, "_performed", later)
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


def pytest_collection_finish() -> None:
    """What was collected stays until the end: no search for garbage goes through it, here or in forked processes.

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


@pytest.fixture(autouse=True)
def ctrl_c_is_heard(request: pytest.FixtureRequest) -> Iterator[None]:
    """What a test leaves blocked stays blocked in all processes that later tests start: undone here, and told."""
    yield
    if hasattr(signal, "pthread_sigmask") and signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ()):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        warnings.warn(f"{request.node.nodeid} left SIGINT blocked", stacklevel=1)

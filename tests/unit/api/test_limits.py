"""Limits and clusters that callers name, checked."""

import time

import pytest

from qe.api.limits import limits_of, reading
from qe.api.race import raced
from qe.io.text import read
from qe.options import Budget, Method
from qe.processes.limits import Limits
from qe.proof.answer import Answer, Status

pytestmark = pytest.mark.processes


def test_limits() -> None:
    listener = [].append
    limits = limits_of({"timeout": 2, "memory": 100, "progress": listener, "process": False})
    assert isinstance(limits, Limits) and limits.timeout == 2 and limits.process is False
    assert limits.start is not None and 0 <= time.monotonic() - limits.start < 10


def test_reading() -> None:
    limits = Limits(None)
    assert reading("x > 0", "text", limits) == read("x > 0")
    asked: list[tuple[object, ...]] = []
    reading(read("x > 0"), "text", limits, True, reader=lambda *given: asked.append(given) or given[0])  # type: ignore
    assert asked == [(read("x > 0"), "text", True)]


def asked(method: Method, budget: Budget) -> Answer:
    if method is Method.CAD:
        return Answer(Status.SOLVED, read("x > 0"))
    return Answer(Status.UNABLE, None, reason="not mine")


def test_the_first_answer_wins_and_reasons_are_told() -> None:
    won = raced(asked, [Method.VS, Method.CAD], Limits(60))
    assert won.formula == read("x > 0") and "first answer was that of cad, ahead of vs" in won.explanation
    lost = raced(asked, [Method.VS], Limits(60))
    assert lost.status is Status.UNABLE and lost.reason == "vs: not mine"

"""Limits and clusters that callers name, checked."""

from __future__ import annotations

import pytest

from qe.api.limits import MOST_WORKERS, cluster_of, limits_of, reading
from qe.api.race import raced
from qe.errors import InputError
from qe.io.text import read
from qe.options import Budget, Cluster, Method
from qe.processes.execution import Limits
from qe.proof.answer import Answer, Status

pytestmark = pytest.mark.processes


def test_clusters() -> None:
    assert cluster_of(0, None) is None
    assert cluster_of(3, None) == Cluster(3, None) and cluster_of(0, "tcp://host:8786") == Cluster(0, "tcp://host:8786")
    assert cluster_of(0, "host:1") == Cluster(0, "host:1")
    for workers, address in (
        (2, "host:1"),
        (MOST_WORKERS + 1, None),
        (-1, None),
        (0, "host"),
        (0, "host:"),
        (True, None),
    ):
        with pytest.raises(InputError):
            cluster_of(workers, address)


def test_limits() -> None:
    listener = [].append
    found = limits_of(2, 100, listener, False)
    assert isinstance(found, Limits) and found.timeout == 2 and found.process is False
    for bad in ((-1, None, True), (1, 0, True), (1, None, "yes"), ("1", None, True)):
        with pytest.raises(InputError):
            limits_of(bad[0], bad[1], listener, bad[2])  # type: ignore[arg-type]


def test_reading() -> None:
    limits = Limits(None)
    assert reading("x > 0", "text", limits) == read("x > 0")
    asked: list[tuple[object, ...]] = []
    reading(read("x > 0"), "text", limits, True, reader=lambda *given: asked.append(given) or given[0])  # type: ignore
    assert asked == [(read("x > 0"), "text", True)]
    with pytest.raises(InputError):
        reading("x > 0", "text", limits, "no")  # type: ignore[arg-type]


def test_the_first_answer_wins_and_reasons_are_told() -> None:
    def asked(method: Method, budget: Budget) -> Answer:
        if method is Method.CAD:
            return Answer(Status.SOLVED, read("x > 0"))
        return Answer(Status.UNABLE, None, reason="not mine")

    won = raced(asked, [Method.VS, Method.CAD], Budget(60))
    assert won.formula == read("x > 0") and "first answer was that of cad, ahead of vs" in won.explanation
    lost = raced(asked, [Method.VS], Budget(60))
    assert lost.status is Status.UNABLE and lost.reason == "vs: not mine"

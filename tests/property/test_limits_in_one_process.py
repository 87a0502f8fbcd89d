"""Within one process nothing but a look at the budget ends work: every loop of every method looks often enough.

The clock of the budgets is the processor time here, so that it does not matter what else the machine does.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

import qe
from qe.api.input import read_formula
from tests.corpus.catalogue import problems

METHODS = ("auto", "vs", "cad", "cgs", "coverings", "critical", "roots", "convex", "witness")
LIMIT, BETWEEN = 0.15, 0.35
"""Seconds. Modules are loaded and single operations of FLINT may be long; a loop that never looks takes seconds."""

LONG = (
    "all x. x - a >= 0 -> a + b*x + c*x^2 + b*x^3 <= 0",
    "ex a, b, c. all x, y. a*x^4*y + b*x*y^3 + c*x^2*y^2 + d*x + g*y + f > a^2*x^3 + b^2*y^5",
    "all x, y, z. x > 0 and y > 0 and z > 0 -> a*x^3 + b*y^3 + c*z^3 >= x*y*z*(a + b + c - 1)",
    "ex x, y, z. x^2 + y^2 + z^2 = a and x*y*z = b and x^3 + y^3 + z^3 = c",
    "ex x. a*x^4 + b*x^3 + c*x^2 + d*x + f = 0 and x^2 + g*x + h < 0",
    "ex x, y. a*x^2 + b*x*y + c*y^2 = 1 and x^2 + y^2 <= 4 and x*y > c",
    "ex x, y, z, u. x*y - z*u = a and x*z + y*u = b and x + y + z + u = c and x^2 + u^2 > 1 and x*u < 2",
    "all x. ex y. a*x^2 + b*y^2 + c*x*y + d > 0 and x*y^3 - x < c and x + y^2 > a",
    "ex u, v, w. u^2*v + v^2*w + w^2*u = a and u + v + w = b and u*v*w = 1 and u > v and v > w",
)


def overtime(text: str, method: str) -> float:
    """Seconds of processor time beyond the limit."""
    formula = read_formula(text)
    start = time.process_time()
    qe.eliminate(formula, method=method, timeout=LIMIT, process=False)
    return time.process_time() - start - LIMIT


@pytest.fixture(scope="module", autouse=True)
def clock() -> Iterator[None]:
    """What the methods load is no part of what is measured."""
    for method in METHODS:
        for text in ("ex x, y. a*x^2 + b*x = y and x < y", "ex x, y, z, u. x^2 + y^2 + z^2 + u^2 < x + 1"):
            qe.eliminate(text, method=method, check=True, process=False)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("qe.options.time", SimpleNamespace(monotonic=time.process_time))
        yield


@pytest.mark.parametrize("number", range(len(LONG)))
def test_a_limit_holds_without_a_process(number: int) -> None:
    for k in range(3):
        method = METHODS[(number + 3 * k) % len(METHODS)]
        assert overtime(LONG[number], method) < BETWEEN, method


def test_signs_of_a_trace_form_look_at_the_limit() -> None:
    """25 s with a limit of 2.5 s, once."""
    assert overtime(LONG[0], "cgs") < BETWEEN


@pytest.mark.deep
@pytest.mark.parametrize("method", METHODS)
def test_limits_hold_for_all_problems(method: str) -> None:
    texts = [*LONG, *(p.formula for p in problems())]
    folder = Path(__file__).resolve().parents[3] / "shared" / "corpora"
    for name in ("public", "timed_realgeom", "hard"):
        if (path := folder / f"{name}.jsonl").exists():
            texts += [json.loads(line)["formula"] for line in path.read_text().splitlines()]
    late = [seconds for text in texts if (seconds := overtime(text, method)) > BETWEEN]
    assert len(late) <= len(texts) // 50 and max(late, default=0) < 5.0, late  # one resultant may be long

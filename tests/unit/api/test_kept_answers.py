"""An answer that is known is not lost while it is proved: a proof that is ended leaves it behind, as derived."""

import time
from collections.abc import Callable, Iterator
from functools import partial

import pytest

import qe
from qe.api.verify import with_derivation
from qe.errors import InternalError, Unable
from qe.options import Budget
from qe.processes.execution import perform
from qe.processes.limits import Limits
from qe.processes.worker import end_idle
from qe.proof.answer import UNPROVED
from tests.tables import each
from tests.workers import killed, replace_in_worker, stuck

pytestmark = pytest.mark.processes

LONG = 600.0
"""Seconds; no test waits for them."""

CALLS: dict[str, Callable[[], object]] = {
    "eliminate": lambda: qe.eliminate("ex x, y. x^2 + y^2 = a and x + y = b", timeout=LONG, check=True),
    "a race": lambda: qe.eliminate("ex x. a*x^2 + b*x + 1 = 0", timeout=LONG, check=True, race=["vs"]),
    "region": lambda: qe.region("ex y. x^2 + y^2 < 4", timeout=LONG, check=True),
    "minimize": lambda: qe.minimize("x^4 - x*y", "ex z. y = z^3 and z^2 <= 4*x", timeout=LONG, check=True),
    "minimize with a parameter": lambda: qe.minimize("x^2 - p*x", parameters="p", timeout=LONG, check=True),
    "parametric_witnesses": lambda: qe.parametric_witnesses("ex x. a*x = b and x > 1", timeout=LONG, check=True),
}


@pytest.mark.parametrize("name", CALLS)
def test_an_answer_whose_proof_was_ended_comes_back_derived(name):
    replace_in_worker("qe.proving.certificates.derived", killed)
    replace_in_worker("qe.optimization.values.proved", killed)
    found = CALLS[name]()
    answer = found if isinstance(found, qe.Answer) else found.answer  # type: ignore[attr-defined]
    assert answer.formula is not None and answer.certificate is None
    for part in (answer, found):
        if hasattr(part, "guarantee"):
            assert (part.guarantee, part.reason) == (qe.Guarantee.DERIVED, UNPROVED)


def test_an_answer_found_before_the_limit_is_not_lost_by_a_slow_proof():
    asked = "ex x, y. x^2 + y^2 = a and x + y = b"
    replace_in_worker("qe.proving.certificates.derived", stuck)
    answer = qe.eliminate(asked, timeout=3, check=True)
    assert answer.guarantee is qe.Guarantee.DERIVED and answer.reason == UNPROVED
    assert answer.formula == qe.eliminate(asked).formula


def test_a_slow_derivation_of_a_known_answer_ends_at_its_limit():
    answer = qe.eliminate("ex x. a*x^2 + b*x + 1 = 0")
    replace_in_worker("qe.proving.certificates.derived", stuck)
    found = with_derivation(answer, timeout=0.2)
    assert found.formula == answer.formula and found.certificate is None and UNPROVED in found.why_unchecked


@pytest.fixture(autouse=True)
def afresh() -> Iterator[None]:
    """What was replaced in a worker ends with it."""
    yield
    end_idle()


def keeps(then: Callable[[], object], at: float, budget: Budget) -> object:
    """Work that keeps two results after some seconds, and goes on."""
    end = time.monotonic() + at
    while time.monotonic() < end:
        budget.check("waiting")
        time.sleep(0.002)
    budget.keep("first")
    budget.keep("last")
    return then()


def done() -> str:
    return "done"


def unable() -> None:
    raise Unable("cannot")


def wrong() -> None:
    raise InternalError("wrong")


@each(
    (Limits(process=False), False, 0.0),  # in this process
    (Limits(), False, 0.0),  # in this process, from which it might move
    (Limits(), False, 0.5),  # moved
    (Limits(timeout=LONG), True, 0.0),  # in another one from the start
)
def test_work_that_is_unable_to_go_on_gives_what_it_kept_last(limits, at_once, seconds):
    assert perform(partial(keeps, unable, seconds), limits, at_once=at_once) == "last"
    assert perform(partial(keeps, done, seconds), limits, at_once=at_once) == "done"
    with pytest.raises(InternalError):  # a fault is not hidden by what was known before it
        perform(partial(keeps, wrong, seconds), limits, at_once=at_once)

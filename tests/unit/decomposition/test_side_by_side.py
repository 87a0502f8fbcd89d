"""Lifting with helpers gives the table of lifting alone; helpers that die cost their own work only."""

import os
import pickle
import random
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from functools import partial

import pytest

import qe
from qe import arguments
from qe.decomposition import lifting
from qe.decomposition.decompose import Decomposed, decompose
from qe.errors import BudgetExceeded
from qe.exact.fibre_stack import isolate_over
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.formula.normal import nnf, prenex
from qe.formula.syntax import Constant
from qe.io import formats
from qe.options import Budget, Call, Cluster, Helpers, Result
from qe.processes import cluster
from qe.processes.cluster import helping
from tests.differential.generate import NESTED, SMALL, random_formula
from tests.tables import each

PROBLEMS = {
    "free variables": "x^2 + y^2 < 4 and x*y > 1 or x^3 + y^2 > 2*y",
    "existential": "ex y, z. x^2 + y^2 + z^2 < 4 and x*y*z > 1",
    "universal": "all y, z. x^2 + y^2 + z^2 > 4 or x*y < 1",
    "with a constraint": "ex y, z. x^2 + y^2 + z^2 = 4 and x*y + z > 1",
    "nullified": "ex y, z. x*z + y - 1 = 0 and x*y > z^2",
    "a sentence": "all x. ex y. all z. x*y + z^2 > 0 or y^2 < x",
}


class Eager:
    """Helpers in this process that are always ahead, and know only what can be sent to them."""

    def __init__(self, width: int = 1, ahead: int = 3) -> None:
        self.width, self.ahead, self.called, self.started = width, ahead, 0, True

    def ready(self) -> bool:
        return self.started

    def results(self, calls: Iterable[Call[Result]], check: Callable[[], None]) -> Iterator[Result]:
        done: deque[tuple[bool, object]] = deque()
        waiting = iter(calls)
        while True:
            while len(done) < self.ahead and (call := next(waiting, None)) is not None:
                done.append(self._made(call))
            if not done:
                return
            check()
            good, found = done.popleft()
            if not good:
                raise found  # type: ignore[misc]
            yield found  # type: ignore[misc]

    def _made(self, call: Call[Result]) -> tuple[bool, object]:
        self.called += 1
        try:
            return True, pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(call))()))
        except qe.QEError as error:
            return False, pickle.loads(pickle.dumps(error))


def table(text: str, helpers: Helpers | None, work: int | None = None) -> Decomposed:
    prefix, matrix = prenex(formats.read(text, "text"))
    free = formats.read(text, "text").free
    order = (*free, *(v for _, names in prefix for v in names))
    quantifiers = ("",) * len(free) + tuple(kind.value for kind, names in prefix for _ in names)
    budget = Budget(None, work)
    budget.helpers = helpers
    return decompose(nnf(matrix), order, quantifiers, budget=budget)


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Helpers take part from the first cell on."""
    monkeypatch.setattr(lifting, "SPREAD_FROM", 0)
    monkeypatch.setattr(lifting, "SPREAD_WIDTH", 1)


@pytest.mark.parametrize("name", PROBLEMS)
@pytest.mark.parametrize("ahead", [1, 5])
def test_the_table_is_that_of_lifting_alone(name: str, ahead: int, at_once: None) -> None:
    helpers = Eager(ahead=ahead)
    found, alone = table(PROBLEMS[name], helpers), table(PROBLEMS[name], None)
    assert helpers.called and (found.table, found.cells, found.stacks) == (alone.table, alone.cells, alone.stacks)


@pytest.mark.parametrize("seed", range(25))
def test_tables_of_random_formulas_are_those_of_lifting_alone(seed: int, at_once: None) -> None:
    rng = random.Random(seed)
    text = str(random_formula(rng, rng.choice([*SMALL, *NESTED])))
    if not isinstance(nnf(prenex(formats.read(text, "text"))[1]), Constant):
        assert table(text, Eager()).table == table(text, None).table


@each(1, 20, 200)
def test_a_limit_on_work_holds_as_alone(work: int, at_once: None) -> None:
    outcomes = []
    for helpers in (Eager(), None):
        try:
            outcomes.append(table(PROBLEMS["existential"], helpers, work).table)
        except BudgetExceeded as error:
            outcomes.append(error.limit)
    assert outcomes[0] == outcomes[1]


def test_small_work_needs_no_helpers() -> None:
    helpers = Eager()
    table("ex y. x*y > 1 and y < 2", helpers)
    assert not helpers.called


def test_helpers_are_not_started_for_a_short_time() -> None:
    with helping(Cluster(workers=1)) as helpers:
        assert not helpers.ready() and helpers.width == 1


def test_work_goes_on_alone_until_the_helpers_have_started(at_once: None) -> None:
    helpers = Eager()
    helpers.started = False
    found = table(PROBLEMS["existential"], helpers)
    assert not helpers.called and found.table == table(PROBLEMS["existential"], None).table


class Murdered:
    """Helpers of which one is killed when the first results are there."""

    def __init__(self, helpers: Helpers) -> None:
        self.helpers, self.width, self.killed = helpers, helpers.width, 0

    def ready(self) -> bool:
        return True

    def results(self, calls: Iterable[Call[Result]], check: Callable[[], None]) -> Iterator[Result]:
        for place, result in enumerate(self.helpers.results(calls, check)):
            if place == 2 and not self.killed:
                self.killed = next(iter(self.helpers._client.run(os.getpid).values()))  # type: ignore[attr-defined]
                os.kill(self.killed, signal.SIGKILL)
            yield result


def test_a_worker_killed_in_the_middle_costs_its_own_work_only(at_once: None) -> None:
    pytest.importorskip("distributed")
    with helping(Cluster(workers=1)) as helpers:
        murdered = Murdered(helpers)
        first = table(PROBLEMS["existential"], murdered)
        second = table(PROBLEMS["with a constraint"], murdered)
    assert murdered.killed
    assert first.table == table(PROBLEMS["existential"], None).table
    assert second.table == table(PROBLEMS["with a constraint"], None).table


def test_calls_are_sent_together_and_an_error_stands_in_its_place() -> None:
    made = cluster._together(
        [partial(int, "1"), partial(int, "2"), partial(arguments.whole, -1, "n", 3), partial(int, "4")]
    )
    assert made.results == [1, 2] and made.count == 2 and isinstance(made.error, qe.InputError)


@each(
    ({"workers": -1}, "workers: a natural number up to 256 expected"),
    ({"workers": "two"}, "workers: a natural number"),
    ({"cluster": 7}, "cluster: text expected"),
    ({"workers": 2, "cluster": "tcp://127.0.0.1:1"}, "one of them"),
)
def test_what_is_no_cluster_is_refused(keywords: dict[str, object], message: str) -> None:
    with pytest.raises(qe.InputError, match=message):
        qe.eliminate("x > 0", **keywords)  # type: ignore[arg-type]


def test_an_address_without_a_scheduler_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("qe.processes.cluster.CONNECTING", 0.3)
    with helping(Cluster(address="tcp://127.0.0.1:1")) as helpers, pytest.raises(qe.InputError, match="none found"):
        list(helpers.results([], lambda: None))


def test_samples_over_towers_can_be_sent() -> None:
    """Balls found on the way stay behind; the coordinates are the same numbers."""
    ring = Ring.of(("a", "b", "c"))
    a, b, c = (ring.gen(i) for i in range(3))
    point = Point(ring)
    for f in (a**2 - 2, b**3 - a * b - 1, c**2 - b - 5):
        found = isolate_over(point, (f,))
        point = found.sample(2 * len(found.sections) - 1)
    sent = pickle.loads(pickle.dumps(point))
    assert all(sent.ball(i, 64).overlaps(point.ball(i, 64)) for i in range(3))
    assert sent.sign(c**2 - b - 5) == 0 and sent.sign(c - 2) == point.sign(c - 2) == 1

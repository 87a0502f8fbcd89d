"""Coverings, and cells that are decomposed side by side."""

import os
import pickle
import random
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import pairwise

import pytest

import qe
from qe import arguments
from qe.decomposition import lifting
from qe.decomposition.cover import Search, characterization
from qe.decomposition.decompose import Decomposed, decompose
from qe.decomposition.implicant import implicant
from qe.decomposition.line import Cover
from qe.decomposition.parameters import parameter_cells
from qe.errors import BudgetExceeded, NotWellOriented
from qe.exact.fibre_stack import isolate_over
from qe.exact.ring import Ring, format_poly
from qe.exact.sample import Point
from qe.formula.build import atom, conj, convert, disj, exists
from qe.formula.evaluate import truth_under
from qe.formula.normal import nnf, prenex
from qe.formula.syntax import FALSE, TRUE, Constant, Formula, Relation
from qe.formula.traverse import map_atoms, polynomials
from qe.io import formats
from qe.options import Budget, Call, Cluster, Helpers, Result
from qe.processes import cluster
from qe.processes.cluster import helping
from tests.differential.generate import NESTED, SMALL, random_formula, random_poly
from tests.tables import each

# Coverings: what they find is what decompositions find; implicants are few and decide.

NAMES = ("x", "y", "z")


def search(text: str, order: str, quantifiers: str = "", **levels: frozenset[int]) -> Search:
    """The matrix; of the variables those before the quantifiers are free, and all are existential without any."""
    ring = Ring.of(tuple(order))
    kinds = [""] * (len(order) - len(quantifiers)) + list(quantifiers) if quantifiers else ["E"] * len(order)
    return Search(nnf(convert(formats.read(text, "text"), ring)), ring, kinds, Budget(), **levels)


def random_body(rng: random.Random, depth: int = 3) -> Formula:
    ring = Ring.of(NAMES[: rng.choice([2, 2, 3])])

    def part(depth: int) -> Formula:
        if depth == 0 or rng.random() < 0.1:
            return atom(random_poly(rng, ring, ring.names, rng.choice([1, 2, 2, 3])), rng.choice(list(Relation)))
        return (conj if rng.random() < 0.85 else disj)([part(depth - 1) for _ in range(2)])

    return nnf(part(depth))


@each(
    ("x^2 + y^2 < 1 and x*y > 1", False),
    ("x^2 + y^2 < 1 and x*y > 1/4", True),
    ("x^2 = 2 and y^2 = x and x*y > 3", False),
    ("x^2 = 2 and y^2 = x and x*y > 1", True),
    ("(x^2 - 2)*(y^2 - x) = 0 and x^2 + y^2 < 1 and y^3 > 1/2 and x > 1", False),
    ("x^2 + y^2 = 0 and x >= 0 and y >= 0", True),
    ("x^2 + y^2 < 0", False),
    ("x = y and y > x", False),
    ("10^40*x = 1 and 10^40*y = 1 and x < y", False),
    ("x > 10^20 and x < 10^20 + 1/10^20 and y^2 = x", True),
)
@pytest.mark.parametrize("order", ["xy", "yx"])
def test_known_truths(text: str, holds: bool, order: str) -> None:
    assert search(text, order).run().truth is holds


@pytest.mark.parametrize("seed", range(120))
def test_coverings_and_decompositions_agree(seed: int) -> None:
    body = random_body(random.Random(seed))
    ring = body.ring
    if isinstance(body, Constant) or ring is None:
        return
    try:
        found = Search(body, ring, "E" * ring.size, Budget(None, 4000)).run()
    except (NotWellOriented, BudgetExceeded):
        return
    assert found.truth is qe.eliminate(exists(ring.names, body), method="cad", process=False).truth


def test_the_intervals_cover_the_line_and_none_is_superfluous() -> None:
    found = search("x^2 + y^2 < 1 and x*y > 1", "xy").run()
    assert found.truth is False
    first, last = found.intervals[0], found.intervals[-1]
    assert first.lower is None and last.upper is None
    assert all(left.upper is not None and right.lower is not None for left, right in pairwise(found.intervals))
    reasons = [i.known.reason for i in found.intervals]
    assert all(isinstance(reason, frozenset) or reason.point.depth == 1 for reason in reasons)


@each(
    ("x < y^2", "xy", "EA", True),
    ("x < y", "xy", "EA", False),
    ("x < y", "xy", "AE", True),
    ("y^2 = x", "xy", "AE", False),
    ("x^2 + y^2 = z^2", "xyz", "AAE", True),
    ("x*y = 1 or x = 0 and y = 1", "xy", "AE", True),
    ("x*z + y = 0 or y /= 0", "xyz", "AAE", True),
    ("x*y + z^2 > 0", "xyz", "EAA", False),
    ("y < x^2 or z > 0", "yxz", "EAE", True),
)
def test_alternation(text: str, order: str, quantifiers: str, holds: bool) -> None:
    assert search(text, order, quantifiers).run().truth is holds


def test_one_interval_is_known_where_one_value_decides() -> None:
    """For all x there is a y with y^2 < x only where x is positive: over a sample one interval of y is found."""
    found = search("y^2 < x or x <= 0", "xy", "AE").run()
    assert found.truth is True
    for interval in found.intervals:
        reason = interval.known.reason
        assert isinstance(reason, frozenset) or (reason.truth is True and len(reason.intervals) == 1)


def test_nobody_asks_what_holds_beside_values_of_the_first_block() -> None:
    (first,) = search("x < y^2", "xy", "EA").run().intervals
    assert first.is_bare and isinstance(first.known.reason, Cover) and not first.own


def test_cells_of_parameters() -> None:
    cover = search("x^2 + b*x + c = 0", "bcx", "E").run()
    assert cover.truth is None
    factors, cells = parameter_cells(cover, 2)
    assert [[format_poly(f) for f in level] for level in factors] == [[], ["-b^2 + 4*c"]]
    assert sorted((c.signs, c.truth) for c in cells) == [(("", "+"), False), (("", "-"), True), (("", "0"), True)]


def test_signs_of_derivatives_tell_cells_apart() -> None:
    """The largest root of x^3 - 3*x - a: the same signs stand on both sides of the other roots."""
    text = "y^3 - 3*y = a and y >= x"
    plain, whole, thom = (
        search(text, "axy", "E", whole=frozenset(levels[:1]), thom=frozenset(levels[1:]))
        for levels in ((), (1,), (1, 1))
    )
    counts = [len(parameter_cells(s.run(), 2)[1]) for s in (plain, whole, thom)]
    assert counts[0] <= counts[1] <= counts[2]
    over = next(i for i in thom.run().intervals if isinstance(i.known.reason, Cover)).known.reason
    assert isinstance(over, Cover)
    signs = [tuple(i.known.sample.sign(f) for f in i.own) for i in over.intervals]
    assert len({i.own for i in over.intervals}) == 1 and len(set(signs)) == len(signs)


def test_a_covering_depends_on_its_projection_only() -> None:
    """Over x = 0 the line is covered by x*y <= 1 alone, which has no roots there, until x is no longer 0."""
    body = search("x^2 + y^2 < 1 and x*y > 1", "xy")
    found = body._over(Point.of(body.ring, [0]), {})
    assert [format_poly(f) for f in characterization(found)] == ["x"]


def test_a_polynomial_that_is_zero_on_a_line_depends_on_its_coefficients() -> None:
    """Over x = y = 0 the equation holds for all z; over x = 0 and another y for none."""
    body = search("x*z + y = 0", "xyz", "A")
    found = body._over(Point.of(body.ring, [0, 0]), {})
    assert found.truth is True and not found.is_pinned
    assert {format_poly(f) for f in characterization(found)} == {"x", "y"}
    assert found.intervals[0].zero and not found.intervals[0].own


def test_a_polynomial_that_is_zero_on_a_line_and_has_lines_above_holds_over_the_point_only() -> None:
    body = search("t^2 = x*z + y and t > 0", "xyzt", "AE")
    found = body._over(Point.of(body.ring, [0, 0]), {})
    assert found.truth is False and found.is_pinned
    over = body._over(Point.of(body.ring, [0]), {})
    assert over.is_pinned and any(i.is_point and i.pinned for i in over.intervals)


def test_a_polynomial_that_is_zero_on_the_lines_over_a_curve_is_told() -> None:
    """z*u + y is zero over all (x, 0, 0), a line of samples that are no isolated points."""
    with pytest.raises(NotWellOriented, match="zero on a line"):
        search("y = 0 and z = 0 and t^2 = z*u + y and t > x^2", "xyzut", "EEEAE").run()


def test_the_limit_on_work_holds() -> None:
    body = search("x^2 + y^2 + z^2 < 1 and x*y*z > 1", "xyz")
    body.budget = Budget(None, 5)
    with pytest.raises(BudgetExceeded):
        body.run()


@pytest.mark.parametrize("seed", range(60))
def test_an_implicant_decides_the_formula_by_itself(seed: int) -> None:
    rng = random.Random(seed)
    body = random_body(rng, 4)
    signs = {p: rng.choice([-1, 0, 1]) for p in polynomials(body) if rng.random() < 0.8}
    truth = truth_under(body, signs.get)
    if truth is not None:
        chosen = implicant(body, signs, truth)
        assert all(a.poly in signs and a.relation.holds(signs[a.poly]) is truth for a in chosen)
        decided = map_atoms(body, lambda a: (TRUE if truth else FALSE) if a in chosen else a)
        assert decided == (TRUE if truth else FALSE)


# Lifting with helpers gives the table of lifting alone; helpers that die cost their own work only.

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

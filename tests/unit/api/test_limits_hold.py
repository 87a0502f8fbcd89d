"""Limits end every public function; what was known before is kept."""

import pickle
import time
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import pytest
import sympy

import qe
import qe.api.eliminate  # else this is a function
from qe.api.eliminate import raced
from qe.api.limits import limits_of, posed
from qe.api.verify import with_derivation
from qe.errors import BudgetExceeded, InternalError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.formula.syntax import TRUE
from qe.io.text import read
from qe.options import Budget, Method
from qe.processes.channel import Channel
from qe.processes.execution import perform
from qe.processes.limits import Limits
from qe.processes.worker import end_idle
from qe.progress import Event
from qe.proof.answer import UNPROVED, Answer, Status
from tests.tables import each
from tests.unit.api.doors import DOORS
from tests.workers import killed, large, replace_in_worker, stuck

# ``timeout`` ends every public function, also while it is in a call that never looks at its budget.

pytestmark = pytest.mark.processes

SQRT2 = RealAlgebraic.from_root([-2, 0, 1], 1, 2)
DISC = "x^2 + y^2 <= 2"
SHADOW = "ex u. x^2 + y^2 + u^2 <= 2 and x + y >= u"
LIMIT, BOUND = 0.04, 15.0
"""Seconds; the worker is killed 0.25 s after its limit, and the machine may be busy."""
ASKED_BEFORE = 0.5
"""The limit of a region that is made within it, before it is asked for more."""


@pytest.fixture(autouse=True)
def afresh() -> Iterator[None]:
    """What was replaced in a worker ends with it."""
    yield
    end_idle()


SOON = partial(qe.region, SHADOW, timeout=ASKED_BEFORE)

STUCK_IN = {
    "decide": "qe.engine.run.answered",
    "find_instance": "qe.engine.run.answered",
    "equivalent": "qe.engine.run.answered",
    "check_witness": "qe.engine.run.answered",
    "comprehensive_groebner": "qe.groebner.question.segments",
    "real_root_classification": "qe.groebner.question.segments",
    "ComprehensiveGroebnerSystem.solutions_at": "qe.groebner.system.solve_system",
    "ComprehensiveGroebnerSystem.basis_at": "qe.groebner.system.parametric_basis",
    "minimize": "qe.convex.strict.solve",
    "maximize": "qe.convex.strict.solve",
    "parametric_witnesses": "qe.elimination.vs.parametric.eliminate_block",
    "ParametricWitness.at": "qe.elimination.vs.parametric.witness",
    "region": "qe.regions.region.decompose",
    "Region.contains": "qe.regions.region.truth_under",
    "Region.fibre": "qe.regions.region.fibre_of",
    "Region.bounds": "qe.regions.region.decompose",
    "Region.sample_points": "qe.regions.region.coordinates",
    "Region.closure": "qe.regions.planar.decompose",
    "Region.components": "qe.regions.planar.decompose",
    "Region.complement": "qe.regions.region.decompose",
    "Region.is_subset": "qe.api.region_operators.eliminated",
    "Region.section": "qe.regions.region.decompose",
    "Region.bounding_box": "qe.regions.region.decompose",
    "Region.distance": "qe.convex.strict.solve",
    "Region.exact_volume": "qe.api.measure._measured",
    "Region.find_instances": "qe.regions.region.fibre_of",
    "Region.volume": "qe.regions.volume.ends",
    "Region.plot": "qe.regions.sketch.sketch",
    "solve": "qe.regions.region.decompose",
    "find_instances": "qe.regions.region.decompose",
    "ConvexRegion.bounds": "qe.regions.convex_region.minimize",
}
"""Where a public function works for long, by its title in the table of doors."""
WITH = {
    "Region.contains": {"point": {"x": SQRT2, "y": 0}},
    "Region.fibre": {"prefix": [SQRT2]},
    "Region.bounds": {"variable": "y"},
}
"""Arguments that take the long way, where those of the table do not."""
AFRESH = {"Region": partial(qe.region, DISC), "ConvexRegion": partial(qe.region, SHADOW)}
"""Objects that keep what they have learned: others than those of the table, which may know the answer."""


@each(*STUCK_IN.items(), daily=2)
def test_the_limit_holds(title: str, place: str):
    door = DOORS[title]
    given = {name: door.around.get(name, lambda value: value)(v) for name, v in door.given.items()}
    kind, _, name = title.partition(".")
    call = getattr(AFRESH[kind](), name) if kind in AFRESH else door.call
    replace_in_worker(place, stuck)
    start = time.monotonic()
    with pytest.raises(Unable, match="limit"):
        call(**{**given, **WITH.get(title, {})}, timeout=LIMIT)
    assert LIMIT <= time.monotonic() - start < BOUND


@each(
    (
        "qe.regions.build.answered",
        lambda: None,
        lambda of: qe.region("ex z. z^3 = x*y and z > 0", timeout=LIMIT),
    ),
    ("qe.regions.build.solve", SOON, lambda of: of.formula),
    ("qe.regions.convex_region.decompose", SOON, lambda of: of.cells),
    # a table that turns out to be needed for a question which began here
    ("qe.regions.convex_region.decompose", SOON, lambda of: of._asked(partial(getattr, of, "table"))),
)
def test_the_limit_holds_for_what_is_made_later(place: str, made: Callable[[], Any], call: Callable[[Any], object]):
    given = made()
    replace_in_worker(place, stuck)
    start = time.monotonic()
    with pytest.raises(Unable, match="limit"):
        call(given)
    assert LIMIT <= time.monotonic() - start < BOUND


def test_a_hard_region_ends_soon_after_its_limit():
    start = time.monotonic()
    with pytest.raises(BudgetExceeded):
        qe.region("x^6*y^5 + z^7*x - y*z^3 + 3 > 0 and x^7 + y^6*z^5 - x*y*z = 1", timeout=LIMIT)
    assert time.monotonic() - start < BOUND


def test_what_a_volume_is_known_to_be_is_told_at_the_limit():
    region = qe.region("x^2 + y^2 <= 1 and x*y^3 >= 1/50")  # decomposed in no time, also on a slow machine
    with pytest.raises(BudgetExceeded, match=r"volume known only between [\d.]+ and \d"):
        region.volume(1e-40, timeout=1)


def test_memory_limits_hold_for_regions_and_their_questions():
    region = qe.region(DISC, memory=2000)
    for call in (lambda: qe.region(DISC, memory=2000), lambda: region.bounds("y")):
        replace_in_worker("qe.regions.region.decompose", large)
        with pytest.raises(BudgetExceeded) as caught:
            call()
        assert caught.value.limit == "memory"


def test_what_a_question_has_learned_is_kept():
    region = qe.region(SHADOW, timeout=60)
    formula = region.formula
    assert region._formula is formula and region.formula is formula
    table = region.table
    assert region.table is table and region.cells is region.cells
    assert region.bounds("x") is region.bounds("x")


@each(DISC, SHADOW, "x^2 = 2 and y^3 > x", "x + y + z + w < 1 and x^2 + w^2 <= 3")
def test_regions_of_another_process_are_whole(text):
    seen: list[Event] = []
    far, near = qe.region(text, timeout=60, progress=seen.append), qe.region(text, process=False)
    assert type(far) is type(near) and far.order == near.order
    for region in (far, pickle.loads(pickle.dumps(far))):
        assert tuple(region.bounds(region.order[0])) == tuple(near.bounds(near.order[0]))
        assert region.formula == near.formula and region.sample_points() == near.sample_points()
        assert qe.verify(region.certificate).accepted
        assert region.fibre([Fraction(1, 3)] * (len(region.order) - 1)) is not None


def test_optima_of_another_process_are_whole():
    far = qe.minimize("x + y", "x^2 + 2*y^2 <= 3 and x <= 1/2", timeout=60)
    near = qe.minimize("x + y", "x^2 + 2*y^2 <= 3 and x <= 1/2")
    assert far == near and str(far.value) == str(near.value)
    assert far.point["x"] + far.point["y"] == far.value  # elements of one and the same field
    assert qe.verify(far.certificate).accepted and pickle.loads(pickle.dumps(near)) == near


def test_witnesses_of_another_process_are_whole():
    far = qe.parametric_witnesses("ex x. a*x^2 + b*x + 1 = 0", timeout=60)
    near = qe.parametric_witnesses("ex x. a*x^2 + b*x + 1 = 0", process=False)
    assert [str(w) for w in far] == [str(w) for w in near]
    assert [w.at({"a": 1, "b": 9}) for w in far[:1]] == [w.at({"a": 1, "b": 9}, timeout=60) for w in near[:1]]


def test_a_picture_is_drawn_by_another_process(tmp_path: Path):
    qe.region(DISC).plot(tmp_path / "disc.png", timeout=60)
    assert (tmp_path / "disc.png").stat().st_size > 1000


def test_reading_holds_the_limit(monkeypatch):
    monkeypatch.setattr("qe.api.limits.read_posed", stuck)
    start = time.monotonic()
    assert qe.eliminate("(x + y + z + 1)^70 > 0", timeout=LIMIT).status is qe.Status.UNABLE
    with pytest.raises(BudgetExceeded):
        qe.region("(x + y + z + 1)^70 > 0", timeout=LIMIT)
    assert time.monotonic() - start < 2 * BOUND


LONG = "(x + y + z + 1)^70"


@each(
    ("qe.api.optimum.read_objective", lambda: qe.minimize(LONG, timeout=LIMIT)),
    ("qe.api.optimum.read_posed_constraints", lambda: qe.minimize("x", f"{LONG} > 0", timeout=LIMIT)),
    ("qe.api.decide.read_polynomial", lambda: qe.check_witness("ex x. x > y", {"x": LONG}, timeout=LIMIT)),
    ("qe.api.groebner.read_polynomial", lambda: qe.comprehensive_groebner([LONG], "x", timeout=LIMIT)),
    ("qe.sympy.from_sympy", lambda: qe.sympy.minimum(sum(sympy.symbols("x y z")) ** 70, timeout=LIMIT)),
    ("qe.api.input.read_polynomial", lambda: qe.maximize(sympy.Symbol("x") ** 70, timeout=LIMIT)),
)
def test_reading_holds_the_limit_in_every_function(place, call, monkeypatch):
    """Texts and SymPy objects that have to be multiplied out were read without the limit, for seconds."""
    monkeypatch.setattr(place, stuck)  # where it is what is sent
    replace_in_worker(place, stuck)
    start = time.monotonic()
    with pytest.raises(Unable, match="limit"):
        call()
    assert time.monotonic() - start < BOUND


def test_reading_holds_the_limit_of_operations_on_regions():
    start = time.monotonic()
    with pytest.raises(Unable, match="limit"):
        qe.region("x^2 + y^2 + z^2 <= 1").is_subset("(x + y + z + 1)^90 > (x - y*z)^45", timeout=LIMIT)
    assert time.monotonic() - start < BOUND


def test_no_time_left_is_a_limit_and_no_wrong_argument():
    """A comparison gave what was left of its time, less than nothing, to the next question: "a positive number"."""
    assert Budget().time_left("later") is None and 0 < Budget(60).time_left("later") <= 60
    with pytest.raises(Unable, match="limit"):
        Budget(-1).time_left("later")


# An answer that is known is not lost while it is proved: a proof that is ended leaves it behind, as derived.

KEPT_LONG = 600.0
"""Seconds; no test waits for them."""

CALLS: dict[str, Callable[[], object]] = {
    "eliminate": lambda: qe.eliminate("ex x, y. x^2 + y^2 = a and x + y = b", timeout=KEPT_LONG, check=True),
    "a race": lambda: qe.eliminate("ex x. a*x^2 + b*x + 1 = 0", timeout=KEPT_LONG, check=True, race=["vs"]),
    "region": lambda: qe.region("ex y. x^2 + y^2 < 4", timeout=KEPT_LONG, check=True),
    "minimize": lambda: qe.minimize("x^4 - x*y", "ex z. y = z^3 and z^2 <= 4*x", timeout=KEPT_LONG, check=True),
    "minimize with a parameter": lambda: qe.minimize("x^2 - p*x", parameters="p", timeout=KEPT_LONG, check=True),
    "parametric_witnesses": lambda: qe.parametric_witnesses("ex x. a*x = b and x > 1", timeout=KEPT_LONG, check=True),
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
    (Limits(timeout=KEPT_LONG), True, 0.0),  # in another one from the start
)
def test_work_that_is_unable_to_go_on_gives_what_it_kept_last(limits, at_once, seconds):
    assert perform(partial(keeps, unable, seconds), limits, at_once=at_once) == "last"
    assert perform(partial(keeps, done, seconds), limits, at_once=at_once) == "done"
    with pytest.raises(InternalError):  # a fault is not hidden by what was known before it
        perform(partial(keeps, wrong, seconds), limits, at_once=at_once)


# Limits and clusters that callers name, checked.


def test_limits() -> None:
    listener = [].append
    limits = limits_of({"timeout": 2, "memory": 100, "progress": listener, "process": False})
    assert isinstance(limits, Limits) and limits.timeout == 2 and limits.process is False
    assert limits.start is not None and 0 <= time.monotonic() - limits.start < 10


def test_reading() -> None:
    limits = Limits(None)
    assert posed("x > 0", {}, limits).restricted == read("x > 0")
    asked: list[tuple[object, ...]] = []
    settings = {"format": "text", "total_division": True}
    posed(read("x > 0"), settings, limits, reader=lambda *given: asked.append(given) or (given[0], TRUE))  # type: ignore
    assert asked == [(read("x > 0"), "text", True)]


def asked(method: Method, channel: Channel) -> Answer:
    if method is Method.CAD:
        return Answer(Status.SOLVED, read("x > 0"))
    return Answer(Status.UNABLE, None, reason="not mine")


def test_the_first_answer_wins_and_reasons_are_told() -> None:
    won = raced(asked, [Method.VS, Method.CAD], Limits(60))
    assert won.formula == read("x > 0") and "first answer was that of cad, ahead of vs" in won.explanation
    lost = raced(asked, [Method.VS], Limits(60))
    assert lost.status is Status.UNABLE and lost.reason == "vs: not mine"


def test_the_time_in_which_sympy_is_loaded_is_a_part_of_the_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    region, began = qe.region(DISC), list[float | None]()

    def performed(work: object, limits: Limits, **how: object) -> None:
        began.append(limits.start)
        raise Unable("limit")

    monkeypatch.setattr("qe.regions.region.perform", performed)
    start = time.monotonic()
    with pytest.raises(Unable, match="limit"):
        region.exact_volume(timeout=5)
    assert began[0] is not None and start <= began[0] < start + 0.05

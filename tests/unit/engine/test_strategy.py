"""The strategy is data: it loads, its conditions are pure, a method asked for is alone, and no clock decides a form."""

import random
import time

import pytest

import qe
from qe.certify.registry import RULES
from qe.engine.conditions import LINEAR_TERMS, convex_conditions, large_linear_system, quadratic_and_few_parameters
from qe.engine.run import solve
from qe.engine.strategy import METHODS, STRATEGY, Attempt, Listed, Scope, attempts
from qe.formula.block import Block
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import atoms
from qe.io import formats
from qe.options import Budget, Method, Options, Stage
from qe.proof.run_log import Choice
from qe.rules.step import StepKind, steps_without
from tests.differential.generate import LARGE, NESTED, SMALL, random_formula
from tests.tables import each

CONVEX = "ex x, y, z, u. x^2 + y^2 + z^2 + u^2 <= 1 and x + y + z + u >= 2"
QUESTIONS = {
    "vs": "ex x. a*x^2 + b*x + c = 0",
    "cad": "all x. x^4 + p*x + q > 0",
    "critical": "ex y, z. (y - a)^2 + (z - b)^2 <= 1 and y^2 + z^2 <= 4",
    "convex": CONVEX,
    "cgs": "ex x, y. x^2 + y^2 = r and x*y = 1",
    "coverings": "ex x, y. x^3 + y^3 < 1 and x*y > 2 and x > 0",
    "roots": "ex x. x > 0 and x^4 + p*x^2 + q*x + r = 0",
    "witness": "all a, b. ex x, y. (x - a)^2 + (y - b)^2 <= 0",
}


def problem(text: str) -> Block:
    found = Block.of(formats.read(text, "text"))
    assert found is not None
    return found


def test_every_attempt_loads_and_every_method_has_one() -> None:
    for attempt in STRATEGY:
        method = attempt.load()
        assert METHODS[method.name].choice is attempt.listed.choice, attempt
    assert {attempt.method for attempt in STRATEGY} == set(METHODS)


def test_every_method_that_can_be_asked_for_has_a_question() -> None:
    assert set(QUESTIONS) == {method.value for method in Method} - {"auto"}


@each("y^2 + z^2 < 4", "x + y + z >= 1", "y^2 - z^2 <= 4")
def test_critical_values_go_first_for_weak_convex_conditions_only(second: str) -> None:
    assert convex_conditions(problem(QUESTIONS["critical"]), Options()) is not None
    first = "y + z <= a + b" if ">=" in second else "(y - a)^2 + (z - b)^2 <= 1"
    assert convex_conditions(problem(f"ex y, z. {first} and {second}"), Options()) is None


@each("a*x^2 + b*x + 1 < 0", "x^2 < a and x > 1")
def test_one_quadratic_variable_is_shown_to_substitution_first(body: str) -> None:
    assert quadratic_and_few_parameters(problem(f"ex x. {body}"), Options()) is not None


@each("ex x. x^3 < a", "ex x, y. x^2 + y < a", "ex x. x^2 < 2", "ex x. a*x^2 + b*x + c*d*e < 0")
def test_other_blocks_are_not(text: str) -> None:
    assert quadratic_and_few_parameters(problem(text), Options()) is None


@each("ex x. x^2 + a*x + 2 = 0", "ex x. x^2 + a*x + b < 0 and x > 0 and b > 1")
def test_an_answer_of_one_atom_needs_no_decomposition(text: str) -> None:
    answer = qe.eliminate(text)
    methods = [entry.method for entry in answer.log.entries if isinstance(entry, Choice)]
    assert qe.equivalent(answer.formula, qe.eliminate(text, method="cad").formula)
    assert ("cad" in methods) is (len(list(atoms(answer.formula))) > 1)


def test_everything_but_simplification_and_decomposition_can_be_left_out() -> None:
    assert [kind for kind in StepKind if not kind.stages] == [StepKind.SIMPLIFY]
    assert steps_without(Stage) == {StepKind.SIMPLIFY}
    assert {name for name, listed in METHODS.items() if listed.switch is None} == {
        "cad",
        "coverings",
        StepKind.SIMPLIFY.value,
    }


@pytest.mark.parametrize("listed", [listed for listed in METHODS.values() if listed.switch and listed.choice])
def test_a_method_left_out_is_not_tried(listed: Listed) -> None:
    assert listed.switch is not None and listed.choice is not None
    for scope in Scope:
        without = Options(without=frozenset({listed.switch}))
        tried = attempts(scope, problem(QUESTIONS[listed.choice.value]), without)
        assert not any(attempt.listed.switch is listed.switch for attempt, _, _ in tried)


@pytest.mark.parametrize("name", QUESTIONS)
def test_a_method_asked_for_is_alone(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    loaded: list[str] = []
    load = Attempt.load

    def seen(attempt: Attempt) -> object:
        loaded.extend([attempt.method] if attempt.scope is not Scope.QUESTION else [])
        return load(attempt)

    monkeypatch.setattr(Attempt, "load", seen)
    answer = qe.eliminate(QUESTIONS[name], method=name)
    assert answer.formula is not None and answer.formula == qe.eliminate(QUESTIONS[name], method=name).formula
    assert loaded and all(METHODS[method].choice is Method(name) for method in loaded)
    figures = {"vs", "cad", "critical"} & set(answer.stats)
    assert figures <= {name}


@pytest.mark.parametrize("name", QUESTIONS)
def test_a_method_that_does_not_suffice_says_so(name: str) -> None:
    hard = "ex x, y. x^3 + y^5 + a*x*y = b and x*y^3 + x > 2"
    if name not in ("cad", "coverings"):
        answer = qe.eliminate(hard, method=name)
        own = any(word in answer.reason for word in ("bounded", "trace forms"))  # the reason of a method itself
        assert answer.formula is None and ("does not eliminate" in answer.reason or own)


def test_the_order_of_attempts_follows_from_the_problem() -> None:
    def methods(text: str, **options: object) -> list[str]:
        return [a.method for a, _, _ in attempts(Scope.BLOCK, problem(text), Options(**options))]  # type: ignore[arg-type]

    assert methods("ex x. a*x + b > 0 and x < c")[1] == "vs"
    assert methods("ex x. x^3 + a*x + b = 0")[1:] == ["cad", "vs"]
    assert methods("ex x, y. x^3 + a*y + b = 0 and y^3 > x") == ["vs, cubic", "cad", "vs"]
    without = {"without": frozenset({Stage.CUBIC})}
    assert methods("ex x, y. x^3 + a*y + b = 0 and y^3 > x", **without) == ["vs", "cad", "vs"]
    assert methods(QUESTIONS["critical"])[0] == "critical"
    assert methods("ex x. a*x + b > 0 and x < c", without=frozenset({Stage.SUBSTITUTION}))[1:] == ["cad"]
    assert methods("ex x. a*x + b > 0", method=Method.CAD) == ["cad"]


KINDS = (*SMALL, *LARGE, *NESTED)
TIMED: dict[str, str | Formula] = {
    **QUESTIONS,
    **{f"random {k}": random_formula(random.Random(7000 + k), KINDS[k]) for k in range(12)},
    "a rotation": "ex x, y, u, v. x*v - y*u /= 0 and x^2 + y^2 + u^2 + v^2 < a",
}


@pytest.mark.parametrize("name", TIMED)
def test_the_form_of_an_answer_does_not_depend_on_the_clock(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """On a machine four times slower the same answer comes, or none in time; never another one."""
    formula, method = TIMED[name], name if name in QUESTIONS else "auto"
    quick = qe.eliminate(formula, timeout=60, check=True, method=method)
    start, clock = time.monotonic(), time.monotonic
    monkeypatch.setattr("qe.options.time.monotonic", lambda: start + 4 * (clock() - start))
    slow = qe.eliminate(formula, check=True, method=method)
    assert slow.formula is not None and str(slow.formula) == str(quick.formula)
    assert [s.rule for s in slow.log.steps()] == [s.rule for s in quick.log.steps()]
    assert slow.guarantee is quick.guarantee
    assert (slow.certificate and slow.certificate.to_json()) == (quick.certificate and quick.certificate.to_json())


def test_a_certificate_is_looked_for_with_limited_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """So many units, however long each takes: the answer stays, the certificate does not come."""
    others = {rule: check for rule, check in RULES.items() if rule != "theorem"}
    monkeypatch.setattr("qe.proving.prover.RULES", others)  # else the steps are proved one by one
    question = QUESTIONS["critical"]
    given = qe.eliminate(question, check=True)
    assert given.guarantee is qe.Guarantee.CHECKED
    monkeypatch.setattr("qe.proving.certificates.CERTIFY_WORK", 5)
    short = qe.eliminate(question, check=True)
    assert short.guarantee is qe.Guarantee.DERIVED and short.certificate is None
    assert str(short.formula) == str(given.formula) and "limit of 5 units" in short.explanation


def test_no_attempt_is_limited_by_seconds() -> None:
    assert not any("seconds" in name or "share" in name for name in Attempt.__slots__)


def test_four_discs_that_grow_with_time() -> None:
    """Two reports of each of two movers and a common bound of speed: decomposition does not end, substitution nearly
    gave up."""
    text = (
        "ex x, y, t. t >= 0 and t <= 2 and x^2 + y^2 <= v^2*t^2 and (x - 1)^2 + (y - 1)^2 <= v^2*(2 - t)^2"
        " and (x - 3)^2 + (y - 3)^2 <= v^2*t^2 and (x - 2)^2 + (y - 2)^2 <= v^2*(2 - t)^2"
    )
    found = solve(formats.read(text, "text"), Options(), Budget(work=5000))
    assert str(found.formula) == "v^2 >= 2"


def test_many_balls_in_space() -> None:
    """Nine balls through the origin: decomposition took 15 s, and convex optimisation is asked first from four on."""
    centres = [
        (1, 2, 0),
        (-1, 1, 2),
        (0, -2, 1),
        (2, 0, -1),
        (-2, -1, 0),
        (1, -1, 2),
        (0, 1, -2),
        (2, 1, 1),
        (-1, 0, 2),
    ]
    parts = [f"(x - ({a}))^2 + (y - ({b}))^2 + (z - ({c}))^2 <= {a * a + b * b + c * c}" for a, b, c in centres]
    three, all_of_them = (problem(f"ex x, y, z. {' and '.join(some)}") for some in (parts[:3], parts))
    assert [a.method for a, _, _ in attempts(Scope.ASKED, all_of_them, Options())] == ["convex"]
    assert not list(attempts(Scope.ASKED, three, Options()))
    assert solve(all_of_them.formula, Options(), Budget(work=5000)).formula == TRUE


def test_large_linear_systems_are_decided_before_anything_is_simplified() -> None:
    """Simplifying and checking 640 dense rows took longer than deciding them."""
    names = [f"v{k}" for k in range(40)]
    row = " + ".join(f"{k + 1}*{name}" for k, name in enumerate(names))
    rows = [f"{row} <= {k}" for k in range(LINEAR_TERMS // 40 + 1)]
    text = f"ex {', '.join(names)}. {' and '.join(rows)}"
    assert large_linear_system(problem(text), Options()) is not None
    assert large_linear_system(problem(f"{text} and v1 /= 0"), Options()) is None
    assert large_linear_system(problem(f"{text} and v1*v2 < 1"), Options()) is None
    assert large_linear_system(problem(text), Options(method=Method.CAD)) is None
    answer = qe.eliminate(f"{text} and {row} >= 1")
    assert answer.formula == FALSE and answer.certificate is not None and qe.verify(answer.certificate).accepted
    sat = qe.eliminate(text)
    assert sat.formula == TRUE and set(sat.witness or ()) == set(names)

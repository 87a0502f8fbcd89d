"""Everything that public functions give or raise travels between processes, and is short where it is shown."""

import pickle
from collections.abc import Callable

import pytest

import bezier
import qe
from qe.processes.channel import Known, WorkerStopped
from tests.tables import each

X, Y = qe.variables("x y")
GIVEN: dict[str, Callable[[], object]] = {
    "answer": lambda: qe.eliminate("ex x. x^2 + b*x + c = 0", check=True),
    "derivation": lambda: qe.eliminate("ex x. x^2 + b*x + c = 0").derivation,
    "verdict": lambda: qe.verify(qe.minimize("x^2 + y", "y >= x").certificate),
    "system": lambda: qe.comprehensive_groebner(["a*x - 1", "x*y + a"], "x y"),
    "classification": lambda: qe.real_root_classification(["a*x^2 - b"], "x"),
    "region": lambda: qe.region("x^2 + y^2 <= 1"),
    "solutions": lambda: qe.solve("x^2 < y", "x"),
    "optimum": lambda: qe.minimize("x^2 + y", "y >= x and y^2 <= 2"),
    "global optimum": lambda: qe.minimize("x^4 - x"),
    "optimum by cases": lambda: qe.minimize("x^2 + a*x", parameters="a"),
    "witness": lambda: qe.parametric_witnesses("ex x. x > a")[0],
    "formula": lambda: (X > Y).formula,
    "statement": lambda: qe.exists(X, X > Y),
    "point": lambda: qe.find_instance("x^2 = 2"),
}
PLAN = {"start": [-4, 0, 3], "via": [[-2, 1, 3], [2, 1, 3]], "goal": [4, 0, 3], "radius": 6}


@pytest.mark.parametrize("name", GIVEN)
def test_results(name: str) -> None:
    value = GIVEN[name]()
    again = pickle.loads(pickle.dumps(value))
    assert type(again) is type(value) and repr(again) == repr(value) and str(again) == str(value)
    assert len(repr(value)) < 300 and "\n" not in repr(value)


def test_plans() -> None:
    plan = bezier.plan(**PLAN, limits={"max_speed": 1, "max_acceleration": 1})
    assert pickle.loads(pickle.dumps(plan)) == plan
    for part in (plan, plan.path, plan.problem, plan.quality, plan.motion, plan.found, plan.outcome):
        assert repr(pickle.loads(pickle.dumps(part))) == repr(part) and len(repr(part)) < 300


@each(
    qe.InputError("x"),
    qe.ParseError("x", source="s", line=3, column=4, expected="y"),
    qe.NoTruthValue("x"),
    qe.Unable("x"),
    qe.BudgetExceeded("x", limit="memory"),
    qe.CertificateRejected("step", "reason"),
    WorkerStopped("x", limit="time", known=Known()),
)
def test_errors(error: qe.QEError) -> None:
    """The message of a parse error had its place twice, and the error of a limit could not be loaded."""
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error) and vars(again).keys() == vars(error).keys()


def test_what_is_offered_is_what_is_public() -> None:
    for module in (qe, bezier):
        assert {name for name in dir(module) if not name.startswith("__")} - {"api", "sympy"} == {*module.__all__}


def test_numbers_too_large_to_compute_are_refused() -> None:
    plan = bezier.plan(**PLAN, limits={"max_speed": 1, "max_acceleration": 1})
    with pytest.raises(qe.InputError, match="rows: "):
        plan.to_ros(rows=10**5000)
    with pytest.raises(qe.Unable, match="exponents up to"):
        qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2) ** 10**5000

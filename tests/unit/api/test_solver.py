"""``qe.Solver``: levels, models and cores; formulas of other packages; and scripts with the same assertions."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

import qe


def test_levels_models_and_cores() -> None:
    solver = qe.Solver(timeout=60)
    solver.add("x^2 + y^2 <= 1", sympy.Symbol("x") > 0)
    assert solver.check() == "sat" and solver.num_scopes() == 0
    point = solver.model()
    assert set(point) == {"x", "y"} and qe.equivalent("true", "true")
    assert all(qe.decide(f"{point['x']} > 0 and ({point['x']})^2 + ({point['y']})^2 <= 1") for _ in "1")
    solver.push()
    solver.add("z = 0")
    solver.assert_and_track("x > 2", "far")
    assert solver.check() == "unsat" and solver.reason_unknown() == ""
    assert [str(part) for part in solver.core()] == ["x^2 + y^2 <= 1", "far"]
    assert solver.unsat_core() == solver.core() and len(solver.assertions()) == 4
    solver.pop()
    assert solver.check() == "sat" and len(solver.assertions()) == 2
    solver.reset()
    assert solver.check() == "sat" and solver.model() == {} and repr(solver) == "Solver()"


def test_a_core_cannot_be_made_smaller() -> None:
    solver = qe.Solver()
    for k, text in enumerate(("x > 0", "y > x", "z > y", "z < x", "x < 9", "y^2 >= 0")):
        solver.assert_and_track(text, f"c{k}")
    assert solver.check() == "unsat"
    core = solver.core()
    assert core == ["c1", "c2", "c3"]
    for name in core:
        rest = qe.Solver()
        rest.add(*("y > x", "z > y", "z < x")[: int(name[1]) - 1], *("y > x", "z > y", "z < x")[int(name[1]) :])
        assert rest.check() == "sat"


def test_assumptions_of_one_check() -> None:
    solver = qe.Solver(assuming="a > 0")
    solver.add("x^2 = a")
    assert solver.check("x > 0") == "sat" and solver.check("a < 0") == "unsat"
    assert [str(f) for f in solver.core()] == ["a < 0"] and solver.check() == "sat"
    proved = qe.Solver(check=True)
    proved.add("x^2 = 2", "x > 0")
    assert proved.check() == "sat" and proved.answer.guarantee is qe.Guarantee.CHECKED  # type: ignore[union-attr]
    assert str(proved.model()["x"]) == "sqrt(2)"


def test_objectives_as_z3_has_them() -> None:
    solver = qe.Solver(timeout=60)
    solver.add("0 <= x <= 1", "0 <= y <= 1")
    low, high = solver.minimize("(x - y)^2"), solver.maximize("x")
    assert solver.objectives() == [low, high]
    with pytest.raises(qe.InputError, match="a check that was sat"):
        low.value()
    assert solver.check() == "sat" and solver.model() == {"x": 1, "y": 1}
    assert (solver.lower(low), solver.upper(high), high.value()) == (0, 1, 1)
    solver.push()
    solver.add("y < 1/2")
    below = solver.maximize("y")
    assert solver.check() == "sat" and high.value() == Fraction(1, 2) and below.optimum is None  # not taken
    assert qe.decide("0 <= x and y < 1/2", assuming=[f"{n} = {v}" for n, v in solver.model().items()])
    solver.pop()
    assert solver.objectives() == [low, high]
    solver.reset()
    solver.add("x > 0")
    assert (solver.maximize("x"), solver.check()) and solver.objectives()[0].value() == float("inf")
    assert solver.model()["x"] > 0 and solver.check("x < 0") == "unsat"


def test_formulas_of_z3_and_pysmt() -> None:
    z3, shortcuts = pytest.importorskip("z3"), pytest.importorskip("pysmt.shortcuts")
    solver, x = qe.Solver(), shortcuts.Symbol("x y", shortcuts.REAL)
    solver.add(z3.Real("u") ** 2 == 2, shortcuts.GT(x, shortcuts.Real(1)))
    assert solver.check() == "sat" and set(solver.model()) == {"u", "x y"}
    square = shortcuts.Equals(shortcuts.Times(x, x), shortcuts.Symbol("a", shortcuts.REAL))
    assert str(qe.eliminate(shortcuts.Exists([x], square))) == "a >= 0"
    with pytest.raises(qe.InputError, match="a term found"):
        solver.add(x)
    with pytest.raises(qe.InputError, match="Real or Bool expected, Int"):
        solver.add(shortcuts.GT(shortcuts.Symbol("i", shortcuts.INT), shortcuts.Int(1)))


def test_mistakes_are_one_line() -> None:
    solver = qe.Solver()
    with pytest.raises(qe.InputError, match="check that was sat"):
        solver.model()
    with pytest.raises(qe.InputError, match="check that was unsat"):
        solver.core()
    with pytest.raises(qe.InputError, match="num: "):
        solver.pop()
    with pytest.raises(qe.InputError, match="ends too early"):
        solver.add("x >")
    with pytest.raises(qe.InputError, match="name: "):
        solver.assert_and_track("x > 0", 5)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="Did you mean 'timeout'"):
        qe.Solver(timeot=3)  # type: ignore[call-arg]
    with pytest.raises(qe.InputError, match="timeout: "):
        qe.Solver(timeout=-1)
    solver.add("x > 0")
    assert solver.check() == "sat"
    solver.add("x > 1")  # what was known is not known any more
    with pytest.raises(qe.InputError, match="check that was sat"):
        solver.model()


def test_at_a_limit_nothing_is_known() -> None:
    solver = qe.Solver(timeout=1)
    solver.add("x^5*y^4 + y^7*z^3*x = 1 and x*y*z^2 > 3 and x^4*z^5 + y^5 < x^3 - z and z^6*x^5 - y^3*x = 7")
    answer = solver.check()
    assert answer in ("sat", "unsat", "unknown") and (answer != "unknown" or "limit" in solver.reason_unknown())

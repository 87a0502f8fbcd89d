"""Questions with SymPy objects as answers, and z3 objects as questions."""

from collections.abc import Callable

import pytest
import sympy as sp

import qe
from qe import sympy as exact
from qe.io.sympy import from_sympy
from tests.tables import each

x, y, a = sp.symbols("x y a")
p = sp.Symbol("p", positive=True)
n = sp.Symbol("n", nonzero=True, real=True)


@each(
    (x**3 - 2 * x > 0, sp.Union(sp.Interval.open(-sp.sqrt(2), 0), sp.Interval.open(sp.sqrt(2), sp.oo))),
    ([x**2 <= 2, sp.Ne(x, 0)], sp.Interval(-sp.sqrt(2), sp.sqrt(2)) - sp.FiniteSet(0)),
    (sp.sqrt(x) < 2, sp.Interval.Ropen(0, 4)),
    (x**2 < -1, sp.S.EmptySet),
    (sp.Eq(x**2, 2), sp.FiniteSet(-sp.sqrt(2), sp.sqrt(2))),
    (1 / sp.Abs(x) <= 1, sp.Union(sp.Interval(-sp.oo, -1), sp.Interval(1, sp.oo))),
    (p**2 > 4, sp.Interval.open(2, sp.oo)),
    (n**2 < 4, sp.Interval.open(-2, 2) - sp.FiniteSet(0)),
    (
        sp.Contains(x, sp.Union(sp.Interval.open(0, 1), sp.FiniteSet(3))),
        sp.Union(sp.Interval.open(0, 1), sp.FiniteSet(3)),
    ),
    (
        sp.Piecewise((x, x > 0), (x**2, x < -1)) > 2,
        sp.Union(sp.Interval.open(-sp.oo, -sp.sqrt(2)), sp.Interval.open(2, sp.oo)),
    ),
    (sp.And(x < sp.oo, x >= 0), sp.Interval(0, sp.oo)),
    (x**2 < sp.sqrt(2), sp.Interval.open(-sp.root(2, 4), sp.root(2, 4))),
    (sp.sign(x) * sp.Max(x, 1) >= 1, sp.Interval.open(0, sp.oo)),
)
def test_regions(condition: object, expected: sp.Set) -> None:
    found = exact.solve_region(condition)
    assert found == expected or (found - expected).is_empty or sp.simplify(found.measure - expected.measure) == 0
    for k in range(-12, 13):
        point = sp.Rational(k, 3)
        assert bool(found.contains(point)) is bool(expected.contains(point)), point


@each(
    (lambda: exact.function_range(x + 1 / (x**2 + 1)), sp.S.Reals),
    (lambda: exact.function_range(x**2 - 2 * x, x, x >= 0), sp.Interval(-1, sp.oo)),
    (lambda: exact.function_range(sp.Integer(3)), sp.FiniteSet(3)),
    (lambda: exact.function_range(1 / x, x, sp.Interval.Lopen(0, 2)), sp.Interval(sp.Rational(1, 2), sp.oo)),
    (lambda: exact.minimum(x**2 - 2 * x, x, sp.S.Reals), -1),
    (lambda: exact.is_true_for_all(sp.Symbol("m", negative=True) < 1), True),
    (lambda: exact.solve_region(sp.Symbol("m", negative=True) ** 2 > 4), sp.Interval.open(-sp.oo, -2)),
    (lambda: exact.solve_region(sp.Symbol("m", nonpositive=True) ** 2 < 4), sp.Interval.Lopen(-2, 0)),
    (lambda: exact.minimum(p + 1 / p), 2),
    (lambda: exact.maximum(x * y, (x, y), x**2 + y**2 <= 1), sp.Rational(1, 2)),
    (lambda: exact.minimum(x**2 - a * x, x), -(a**2) / 4),
    (lambda: exact.minimum(x**2 - a * x, "x"), -(a**2) / 4),
    (lambda: exact.minimum(x**2 - 2 * x, "x", [x >= 2, True]), 0),
    (lambda: exact.minimum(a * x, x, [x >= 0, x <= 1, True]).subs(a, -2), -2),
    (lambda: exact.maximum(x * (a - x), x, x > 0), sp.Piecewise((0, a <= 0), (a**2 / 4, True))),
    (lambda: exact.minimum(p + a / p, p), sp.Piecewise((-sp.oo, a < 0), (0, sp.Eq(a, 0)), (2 * sp.sqrt(a), a > 0))),
    (lambda: exact.minimum(x + p, x, sp.Interval(p, 1)), sp.Piecewise((2 * p, p <= 1))),
    (lambda: exact.minimum(x, x, x > x), sp.oo),
    (lambda: exact.is_true_for_all(x**2 >= 0), True),
    (lambda: exact.is_true_for_all(p > 0), True),
    (lambda: exact.is_true_for_all([]), True),
    (lambda: exact.is_true_for_all(p > 1), False),
    (lambda: exact.is_true_for_all([p > 0, x**2 + 1 > p - p**2]), True),
    (lambda: exact.reduce_inequalities([x**2 < 4, x > 0], x), sp.And(x > 0, x < 2)),
    (lambda: exact.reduce_inequalities([x + 3 >= 0], []), x >= -3),
    (lambda: exact.reduce_inequalities(x + y * 2 - 1 >= 0, [x]), x >= 1 - 2 * y),
    (lambda: exact.reduce_inequalities(sp.Eq(x**2, 4), x), sp.Or(sp.Eq(x, -2), sp.Eq(x, 2))),
    (lambda: exact.reduce_inequalities(p**2 - 3 * p < 0, p), p < 3),
    (lambda: exact.reduce_inequalities(sp.pi < sp.Abs(a), a), sp.Or(a < -sp.pi, a > sp.pi)),
    (lambda: exact.reduce_inequalities(sp.pi / sp.Abs(x) <= 1, x), sp.Or(x >= sp.pi, x <= -sp.pi)),
    (lambda: exact.reduce_inequalities([]), sp.true),
    (lambda: exact.reduce_inequalities(x**3 + a > 0, x), x > -sp.sign(a) * sp.Abs(a) ** sp.Rational(1, 3)),
    (lambda: exact.reduce_inequalities(x**3 + x + a > 0, x), x**3 + x + a > 0),
    (lambda: exact.solve_region(x**2 < sp.pi), sp.Interval.open(-sp.sqrt(sp.pi), sp.sqrt(sp.pi))),
    (lambda: exact.solve_region(2 * x < sp.E), sp.Interval.open(-sp.oo, sp.E / 2)),
    (lambda: exact.minimum(x**2 + sp.pi), sp.pi),
    (lambda: [exact.is_true_for_all(x**2 + sp.pi > k) for k in (3, 4)], [True, False]),
    (lambda: exact.reduce_inequalities(x > 0).free_symbols, {x}),
)
def test_answers(found: Callable[[], object], expected: object) -> None:
    assert found() == expected


@each(
    (x**2 > a, [x]),
    ([a * x**2 + y * x + 1 < 0], [x]),
    ([x**2 + y**2 < a, x > y], [x, y]),
    ([x**2 + y**2 < a, x > y], [y]),
    (sp.Or(sp.Abs(x * y) < 1, sp.Ne(x, 2)), [y]),
    (x**3 - a * x > 1, [x]),
    ([x > 1, qe.Exists(y, y**2 < a - x)], x),
)
def test_reduced_inequalities_are_the_same_condition(given: object, symbols: object) -> None:
    assert qe.equivalent(given, exact.reduce_inequalities(given, symbols))


def test_assumptions_are_conditions_in_their_place() -> None:
    assert qe.equivalent(qe.eliminate(p * x > 1), "p > 0 and p*x > 1")
    assert qe.decide(qe.ForAll(p, p > 0)) and not qe.decide(qe.ForAll(x, x > 0))
    assert qe.equivalent(qe.Exists(p, p < x), "x > 0")
    assert qe.equivalent(~qe.Exists(x, (x > p)), "p > 0 and false")
    assert qe.equivalent(qe.Exists(x, x**2 < n) | (p > 3), "p > 0 and n /= 0 and (n > 0 or p > 3)")
    assert qe.equivalent(qe.ForAll("p", p > 0), "true")
    assert qe.equivalent(from_sympy(sp.Symbol("z", zero=True) >= x), "z = 0 and z >= x")


def test_what_symbols_of_an_objective_are_assumed_to_be_is_read() -> None:
    """``p + 1/p`` for a positive p was called unbounded."""
    least = qe.minimize(p + 1 / p)
    assert least.value == 2 and least.point == {"p": 1}
    assert str(qe.minimize(p**2 + 2 * p)) == "Optimum(0, not attained)"
    assert str(qe.minimize(x + a / x, x > 0, parameters=[a])) == str(qe.minimize(p + a / p, parameters=[a])).replace(
        "p", "x"
    )
    solver = qe.Solver()
    lowest = solver.minimize(p + 1 / p)
    assert solver.check() == "sat" and solver.lower(lowest) == 2


def test_what_symbols_of_a_system_are_assumed_to_be_is_read() -> None:
    """All solutions of p^2 + a*p + 1 = 0 were counted, not the positive ones."""
    found = {one.count: str(one.condition) for one in qe.real_root_classification([p**2 + a * p + 1], [p])}
    assert found == {0: "a > -2", 1: "a = -2", 2: "a < -2"}
    negative = qe.real_root_classification([sp.Symbol("m", negative=True) ** 2 - p], ["m"])
    assert [(one.count, str(one.condition)) for one in negative] == [(1, "true")]
    assert [str(one.count) for one in qe.real_root_classification([n**2 - a * n], [n])] == ["0", "1"]
    assert str(qe.comprehensive_groebner([p * x - 1], [x])) == str(
        qe.comprehensive_groebner(["p*x - 1"], ["x"], assuming="p > 0")
    )
    with pytest.raises(qe.InputError, match="w is assumed to satisfy w >= 0"):
        qe.real_root_classification([sp.Symbol("w", nonnegative=True) - a], ["w"])


def test_optima_with_parameters_are_piecewise() -> None:
    least, greatest = qe.optimum("x^2 - a*x", "x >= 0", parameters="a").to_sympy()
    assert least == sp.Piecewise((0, a <= 0), (-(a**2) / 4, True)) and greatest == sp.oo
    assert qe.minimize("x", "x^2 < 0 and a = a", parameters="a").to_sympy() is sp.nan
    with pytest.raises(qe.InputError, match="root of a polynomial with parameters"):
        qe.minimize("x", "x^5 - x - a = 0", parameters="a").to_sympy()


@each(
    (lambda: exact.solve_region(x < y), "one free symbol"),
    (lambda: exact.solve_region(x < y, x), "one free symbol"),
    (lambda: exact.solve_region(sp.log(x) < 1), "not algebraic"),
    (lambda: exact.solve_region(sp.Contains(x, sp.S.Integers)), "intervals and points"),
    (lambda: exact.solve_region(sp.Symbol("k", integer=True) < 1), "integer"),
    (lambda: exact.solve_region("x < 1"), "text found"),
    (lambda: exact.function_range(sp.sin(x)), "not algebraic"),
    (lambda: exact.solve_region(sp.sin(x) < sp.pi), "sin is not algebraic"),
    (lambda: exact.reduce_inequalities(x**sp.pi < 1), r"not algebraic: x\*\*pi"),
    (lambda: exact.reduce_inequalities(x < 1, 5), "symbols: the name of a variable"),
    (lambda: exact.is_true_for_all(x), "Boolean combination"),
    (lambda: exact.function_range(x**2 + a, x), r"all of the expression expected \(a\); minimum takes others"),
    (lambda: exact.function_range("x**2"), "a SymPy expression expected, 'x..2' found"),
    (lambda: exact.minimum(x**2, 5), "symbols: the name of a variable"),
    (lambda: exact.function_range(x**2, 5), "symbols: the name of a variable"),
    (lambda: exact.minimum(x**2, x, "x > 0"), "text found"),
    (lambda: exact.minimum(a * x, x, "x > 0"), "text found"),
    (lambda: exact.minimum(None), "a SymPy expression expected, None found"),
    (lambda: exact.maximum(x > 0), "a SymPy expression expected, x > 0 found"),
    (lambda: qe.from_z3(3), "z3"),
)
def test_mistakes_are_told_in_one_line(wrong: Callable[[], object], part: str) -> None:
    with pytest.raises(qe.InputError, match=part) as caught:
        wrong()
    assert "\n" not in str(caught.value)

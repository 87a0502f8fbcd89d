"""What users hold in their hands: short, printed so that it can be read back, picturable, picklable, connected."""

import inspect
import pickle
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings

import qe
from qe.api.input import read_formula
from qe.formula.operators import LONGEST
from tests.strategies import formulas
from tests.tables import each

x, y = qe.variables("x y")
DISC = qe.region("x^2 + y^2 <= 1")
VALUES = {
    "answer": lambda: qe.eliminate("ex x. x^2 + b*x + c = 0", check=True),
    "answer of a sentence": lambda: qe.eliminate("ex x. x^2 = 2"),
    "formula": lambda: read_formula(" and ".join(f"x^{k} + {k} > 0" for k in range(1, 200))),
    "true": lambda: read_formula("true"),
    "certificate": lambda: qe.eliminate("ex x. x^2 = b", check=True).certificate,
    "derivation": lambda: qe.eliminate("ex x. x^2 + b*x + c = 0").derivation,
    "region": lambda: DISC,
    "convex region": lambda: qe.region("ex u. x^2 + u^2 <= 1"),
    "interval": lambda: DISC.bounds("x"),
    "unbounded interval": lambda: qe.region("x > 0").bounds("x"),
    "cell": lambda: DISC.cells[0],
    "range": lambda: DISC.cells[0].ranges[1],
    "solutions": lambda: qe.solve("x^2 + b*x + c = 0", "x"),
    "optimum": lambda: qe.minimize("x^2 + y", "y >= x"),
    "unbounded optimum": lambda: qe.minimize("x"),
    "global optimum": lambda: qe.minimize("x^4 - x", "x < 2"),
    "parametric optimum": lambda: qe.minimize("x^2 - a*x", parameters="a"),
    "case": lambda: next(iter(qe.minimize("x^2 - a*x", parameters="a"))),
    "witness": lambda: qe.parametric_witnesses("ex x. a*x < b")[0],
    "verdict": lambda: qe.verify(DISC.certificate),
    "variable": lambda: x,
    "statement": lambda: (x < y) & (x > 0),
    "number": lambda: qe.find_instance("x^2 = 2"),
}


@pytest.mark.parametrize("title", VALUES)
def test_reprs_are_short_and_pickles_keep_all(title: str) -> None:
    value = VALUES[title]()
    assert len(repr(value)) <= 350 and "\n" not in repr(value)
    restored = pickle.loads(pickle.dumps(value))
    assert str(restored) == str(value) and type(restored) is type(value)


def test_reprs_say_what_it_is() -> None:
    assert repr(qe.eliminate("ex x. x^2 = b")) == "Answer(b >= 0; derived)"
    assert repr(qe.eliminate("ex x. x^2 = 2")).startswith("Answer(true, x = ")
    assert repr(DISC.bounds("x")) == "Interval[-1, 1]" and repr(qe.region("x > 0").bounds("x")) == "Interval(0, oo)"
    assert repr(DISC) == "Region(x, y: x^2 + y^2 <= 1)" and repr(DISC.certificate) == "Certificate(derivation)"
    assert repr(qe.minimize("x^2 + y", "y >= x")) == "Optimum(-1/4 at x = -1/2, y = -1/2)"
    assert repr(qe.minimize("x", "x > 0")) == "Optimum(0, not attained)" and "unbounded" in repr(qe.minimize("x"))


def test_notebooks() -> None:
    answer = qe.eliminate("ex x. x^2 + b*x + c = 0")
    assert answer._repr_latex_() == r"$\displaystyle b^{2} - 4\,c \geq 0$" == answer.formula._repr_latex_()
    assert "<math" in answer._repr_html_() and "derived" in answer._repr_html_()
    assert "witness: x = " in qe.eliminate("ex x. x^2 = 2")._repr_html_()
    assert "unable" in qe.eliminate("ex x. a*x^5 + x = 1", method="vs")._repr_html_()
    assert "data:image/png" in DISC._repr_html_() and "<img" not in qe.region("x < y*z")._repr_html_()
    long = read_formula(" and ".join(f"x^{k} > {k}" for k in range(1, LONGEST // 4)))
    assert long._repr_latex_() is None and (x < y)._repr_latex_() == r"$\displaystyle x < y$"


def test_formulas_have_operators() -> None:
    f, g = read_formula("x > 0"), read_formula("y > x")
    assert str(f & g) == "0 < x < y" and str(f | "z > 1") == "x > 0 or z > 1"
    assert str(~f) == "x <= 0" and qe.equivalent(f >> g, "x > 0 -> y > x") and str("z > 1" & f) == "z > 1 and x > 0"
    assert isinstance(f & (x < y), qe.Statement) and isinstance((x < y) & f, qe.Statement)
    assert qe.equivalent(f & (sp.Symbol("y") > 3), "x > 0 and y > 3")
    with pytest.raises(qe.InputError):
        f & 3


@pytest.mark.parametrize(
    "point",
    [
        (0, 1),
        [Fraction(1, 2), "1/2"],
        np.array([0.5, 0.5]),
        {x: 0, y: 1},
        {sp.Symbol("x"): sp.sqrt(2) / 2, "y": sp.sqrt(2) / 2},
        {"x": np.float32(0.6), "y": np.int8(0)},
        (sp.Rational(1, 3), Decimal("0.1")),
        (np.array(0.5), np.float64(0.5)),
        DISC.sample(),
        (qe.find_instance("2*x^2 = 1")["x"], 0),
    ],
)
def test_points_of_every_kind(point: object) -> None:
    assert DISC.contains(point) and not DISC.is_disjoint("x^2 < 5") and DISC.distance(point) == 0


@pytest.mark.parametrize(
    "point", [(np.timedelta64(1, "s"), 0), (np.float64("nan"), 0), (1,), (True, 0), "ab", (1, None), {"x": 0}, {1, 2}]
)
def test_points_that_are_none(point: object) -> None:
    with pytest.raises(qe.InputError):
        DISC.contains(point)


@each(np.timedelta64(5, "s"), True, "5")
def test_limits_are_numbers_of_seconds(limit: object) -> None:
    with pytest.raises(qe.InputError, match="positive number of seconds"):
        qe.eliminate("x > 0", timeout=limit)


def test_numbers_of_numpy_in_terms() -> None:
    assert str(np.float64(1.5) < x) == "x > 3/2" and str(x + np.int64(2) > 0) == "x > -2"
    assert str((x < y).substitute({x: np.float32(0.25), "y": sp.Rational(1, 2)})) == "true"
    assert qe.check_witness("ex x. 2*x = 1", {x: np.float64(0.5)})
    assert qe.solve(x * y < 1, [y]).order == qe.solve("x*y < 1", y).order == ("x", "y")


def test_signatures_and_names_are_complete() -> None:
    assert set(qe.__all__) <= set(dir(qe)) and not {"annotations", "Any", "import_module"} & set(dir(qe))
    for name in qe.__all__:
        value = getattr(qe, name)
        assert value.__doc__, name
        if inspect.isfunction(value):
            kinds = {p.kind for p in inspect.signature(value).parameters.values()}
            assert inspect.Parameter.VAR_KEYWORD not in kinds, name


def test_total_division_everywhere() -> None:
    assert str(qe.eliminate("1/x > 0", total_division=True).formula) == "x >= 0"
    assert qe.find_instance("1/x > 0 and x = 0", total_division=True) == {"x": 0}
    assert qe.decide("ex x. x = 0 and 1/x = 5", total_division=True) and not qe.decide("ex x. x = 0 and 1/x = 5")
    assert str(qe.solve("1/x > 0", total_division=True)) == "x >= 0"
    assert qe.region("1/x > 0", total_division=True).contains([0])
    assert qe.find_instances("x = 0 and 1/x > 1", 3, total_division=True) == [{"x": 0}]


def test_pictures_of_answers(tmp_path) -> None:
    answer = qe.eliminate("ex x. x^2 + b*x + c = 0")
    assert answer.plot(tmp_path / "plane.png").get_xlabel() == "b"
    assert answer.plot(tmp_path / "turned.png", order="c, b").get_xlabel() == "c"
    assert qe.eliminate("ex x. x^2 = b").plot(tmp_path / "line.svg").get_xlabel() == "b"
    assert (tmp_path / "plane.png").stat().st_size > 1000
    with pytest.raises(qe.InputError, match="1 to 3"):
        qe.eliminate("ex x. x^2 + a*x < b*c + d").plot(tmp_path / "none.png")
    with pytest.raises(qe.Unable, match="no formula"):
        qe.eliminate("ex x. a*x^5 + x = 1", method="vs").plot()


@settings(max_examples=25)
@given(formulas(names=("x", "y"), max_degree=2))
def test_what_is_printed_is_read_back(formula) -> None:
    answer = qe.eliminate(formula)
    assert read_formula(str(formula)) == read_formula(str(read_formula(str(formula))))
    assert qe.equivalent(str(answer), formula)
    region = qe.region(formula, "x, y")
    for cell in region.cells:
        assert read_formula(str(cell)) == cell.formula
    for point in region.sample_points():
        text = " and ".join(f"{name} = {value}" for name, value in point.items())
        assert qe.region(text, "x, y").contains(point)
    if not region.is_empty:
        for end in region.bounds("x"):
            assert end is None or qe.region(f"x = {end}").contains([end])

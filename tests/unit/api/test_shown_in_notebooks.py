"""Every result has a form for notebooks: LaTeX or HTML, and is a plain value all the same."""

import pickle
from fractions import Fraction

import bezier
import qe
from qe.exact.algebraic_text import format_root, in_latex
from tests.tables import each

SQRT2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@each(
    ("3", "3"),
    ("-3/4", r"-\frac{3}{4}"),
    ("-sqrt(2)/2", r"-\frac{\sqrt{2}}{2}"),
    ("(1 - 3*sqrt(5))/2", r"\frac{1 - 3 \sqrt{5}}{2}"),
    ("-3 - 2*sqrt(3)", r"-3 - 2 \sqrt{3}"),
    ("root(1, 2*x^12 - 1)", r"\operatorname{root}_{1}\left(2 x^{12} - 1\right)"),
)
def test_numbers(text: str, source: str) -> None:
    assert in_latex(text) == source


def test_roots_as_text() -> None:
    assert format_root((1, -3, 0, 1), 0) == "root(1, x^3 - 3*x + 1)"
    assert format_root((-1, 1, 0, 0, 0, -2), 2) == "root(3, -2*x^5 + x - 1)"


@each(
    lambda: [qe.find_instance("x_1^2 = 2 and x_1 > 0")],
    lambda: qe.find_instances("x_1^2 = 2 and x_1 > 0", 1),
    lambda: qe.region("x_1^2 = 2 and x_1 > 0").sample_points(),
    lambda: [qe.region("x_1^2 = 2 and x_1 > 0").sample()],
)
def test_points(points) -> None:
    (point,) = points()
    assert point == {"x_1": SQRT2} and pickle.loads(pickle.dumps(point)) == point
    assert point._repr_latex_() == r"$\displaystyle \mathit{x\_1} = \sqrt{2}$"


@each(
    (lambda: qe.minimize("x", "2*x >= 1"), (r"\frac{1}{2}", r"\mathit{x}")),
    (lambda: qe.minimize("x", "2*x > 1"), (r"\frac{1}{2}", "not attained")),
    (lambda: qe.minimize("x", "x^2 = 2"), (r"-\sqrt{2}",)),
    (lambda: qe.minimize("x^3"), ("unbounded",)),
    (lambda: SQRT2, (r"\sqrt{2}",)),
    (lambda: qe.parametric_witnesses("ex x. x > a")[0].at({"a": Fraction(1)}), (r"\mathit{x}",)),
)
def test_formulas(make, parts) -> None:
    source = make()._repr_latex_()
    assert source.startswith("$") and source.endswith("$") and all(part in source for part in parts), source


def test_pages() -> None:
    derivation = qe.eliminate("ex x. x^2 + b*x + c = 0").derivation._repr_html_()
    assert derivation.count("<math") >= 2 and derivation.count("<li") >= len(derivation.split("rule")) - 1
    plan = bezier.plan(start=[-4, 0, 3], via=[[-2, 1, 3], [2, 1, 3]], goal=[4, 0, 3], radius=6)
    assert str(plan).splitlines()[0] in plan._repr_html_() and "<svg" in plan._repr_html_()

"""Regions as sets: members, solutions, ends, topology."""

from fractions import Fraction
from pathlib import Path

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.errors import InputError
from qe.formula.evaluate import holds_at
from qe.regions.ends import ends
from qe.regions.region import Region
from tests.strategies import formulas, points
from tests.tables import each

THREE = "x^2+y^2+z^2 <= 27 and (x+2)^2+(y-6)^2+(z-6)^2 <= 27 and (x-2)^2+(y-6)^2+(z-6)^2 <= 27"


def test_three_balls_are_two_pieces_with_radical_bounds() -> None:
    region = qe.region(THREE)
    assert len(region.cells) == 2
    assert str(region.bounds("x").upper) == "(-19 + 12*sqrt(19))/19"
    assert region.bounds("x").upper_closed
    again = Region.from_json(region.to_json())
    assert again.table == region.table
    assert qe.verify(again.certificate).accepted


@each('"start"', '"answer"')
def test_a_damaged_file_is_refused(member: str) -> None:
    """A certificate without its answer ended in a KeyError."""
    with pytest.raises((qe.InputError, qe.CertificateRejected)):
        Region.from_json(qe.region("x^2 <= 2").to_json().replace(member, '"other"', 1))


def test_bounds_of_open_and_unbounded_sets() -> None:
    region = qe.region("x > 1 and x*y >= 1")
    bounds = region.bounds("x")
    assert (bounds.lower, bounds.upper, bounds.lower_closed) == (1, None, False)
    assert (region.bounds("y").lower, region.bounds("y").upper) == (0, None)
    with pytest.raises(qe.Unable, match="unbounded in"):
        region.volume()


@each(
    (lambda r: r.contains({"x": 1}), "a value for y expected"),
    (lambda r: r.contains({"x": "one", "y": 0}), "an exact number for x expected"),
    (lambda r: r.bounds("w"), "one of x, y expected"),
    (lambda r: r.volume(2), "between 0 and 1"),
)
def test_bad_requests_get_one_line(call, message: str) -> None:
    with pytest.raises(qe.InputError, match=message):
        call(qe.region("x^2+y^2 <= 1"))


def test_order_must_name_every_variable() -> None:
    with pytest.raises(qe.InputError, match="order"):
        qe.region("x^2+y^2 <= 1", order=("x",))


def test_a_formula_without_variables_has_a_region() -> None:
    assert qe.region("false").is_empty and not qe.region("true").is_empty


@each(1, 0.5, "1/2", Fraction(1, 2), [1], {"x": 1}, sympy.sqrt(2))
def test_points_of_a_line(point: object) -> None:
    line = qe.region("x > 0")
    assert point in line and point not in ~line


def test_points_of_a_plane() -> None:
    disc = qe.region("x^2 + y^2 < 1")
    assert (0, 0.5) in disc and {"y": 0, "x": 0} in disc and (1, 0) not in disc
    with pytest.raises(qe.InputError, match="values in order"):
        0.5 in disc


@each(
    ("x^2 = 2", None, ["x = -sqrt(2)", "x = sqrt(2)"]),
    ("x^2 + y^2 = 1 and x = y", "x y", ["x = -sqrt(2)/2 and y = -sqrt(2)/2", "x = sqrt(2)/2 and y = sqrt(2)/2"]),
    ("a*x < b", "x", ["a < 0 and x > b/a", "a = 0 and b > 0", "a > 0 and x < b/a"]),
    ("x^2 + y^2 <= 1", ("x", "y"), ["-1 <= x <= 1 and -sqrt(1 - x^2) <= y <= sqrt(1 - x^2)"]),
    ("y^3 = x", "y", ["y = cbrt(x)"]),
    ("ex y. x = y^2", None, ["x >= 0"]),
    ("x^5 - x = 1", None, ["x = root(1, x^5 - x - 1)"]),
    ("x < x", "x", ["false"]),
    ("ex y. x < y", "x", ["true"]),
)
def test_cases(text: str, variables: object, lines: list[str]) -> None:
    found = qe.solve(text, variables)
    assert str(found).split(" or\n") == lines
    assert qe.equivalent(str(found), text) and qe.equivalent(found.formula, text)


def test_double_roots_are_counted_once() -> None:
    found = qe.solve("x*y^2 - y - 1 >= 0")  # at x = -1/4 both roots are y = -2
    assert qe.equivalent(str(found), "x*y^2 - y - 1 >= 0")
    assert qe.equivalent(f"x = -1/4 and y = -2 and ({found})", "x = -1/4 and y = -2")


def test_the_object() -> None:
    found = qe.reduce("x^2 + b*x + c = 0", "x")
    assert found.order == ("b", "c", "x") and len(found) == len(list(found)) == 3
    assert str(found) == "b^2 - 4*c >= 0 and (x = (-b - sqrt(b^2 - 4*c))/2 or x = (-b + sqrt(b^2 - 4*c))/2)"
    assert repr(found) == "Solutions(b, c, x: 3 cases)" and "<li><code>" in found._repr_html_()
    assert found.region.contains(found[0].sample) and qe.verify(found.region.certificate).accepted


def test_misuse() -> None:
    for wrong in (lambda: qe.solve("x > 0", 3), lambda: qe.solve("x >"), lambda: qe.solve("x > 0", "x", timeout=0)):
        with pytest.raises(qe.InputError):
            wrong()


@settings(max_examples=30)
@given(formulas(names=("x", "y"), max_degree=3), st.lists(points(("x", "y")), min_size=4, max_size=4))
def test_each_case_is_read_back_and_all_together_are_the_formula(formula, at) -> None:
    found = qe.solve(formula, "x y")
    read = [qe.eliminate(str(case)).formula for case in found]  # without the quantifiers that say which root it is
    for point in at:
        assert sum(holds_at(f, point) for f in read) == holds_at(formula, point)  # the cases are disjoint
    for case, f in zip(found, read, strict=True):
        if all(not isinstance(value, qe.RealAlgebraic) for value in case.sample.values()):
            assert holds_at(f, case.sample)


@settings(max_examples=12)
@given(formulas(names=("`a b`", "pi", "ex"), max_degree=2))
def test_odd_names(formula) -> None:
    found = qe.solve(formula)
    assert {*read_formula(str(found)).free} == {*found.formula.free}


@each(
    "x^2 < 2 and x /= 0 or x = 3",
    "x^2 + y^2 <= 4 and (x - 1)^2 + y^2 < 4 or x = 3 and y = 1",
    "y > x^2",
    "y^2 < x^3 - x",
    "x^2 + y^2 + z^2 <= 4 and x + y + z >= 1",
    "x^2 < 0",
)
def test_one_to_three_variables(text: str, tmp_path: Path) -> None:
    path = tmp_path / "region.png"
    qe.region(text).plot(path)
    assert path.read_bytes().startswith(b"\x89PNG")
    assert path.stat().st_size > 5000


def test_other_formats(tmp_path: Path) -> None:
    region = qe.region("x^2 + y^2 <= 1")
    region.plot(tmp_path / "r.svg")
    region.plot(str(tmp_path / "r.pdf"))
    assert "<svg" in (tmp_path / "r.svg").read_text()
    assert (tmp_path / "r.pdf").read_bytes().startswith(b"%PDF")


def test_refusals(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="1 to 3 variables"):
        qe.region("a + b + c + d > 0").plot(tmp_path / "r.png")
    with pytest.raises(InputError, match="ending in"):
        qe.region("x > 0").plot(tmp_path / "r.doc")


def test_ends_are_followed() -> None:
    """On the circle x^2 + y^2 = 4 the ends over x are -sqrt(4 - x^2) and sqrt(4 - x^2)."""
    (piece,) = qe.region("x^2 + y^2 <= 4", order=("x", "y")).cells
    for x in (-1.5, 0.0, 1.0):
        low, high = ends(piece, 1, {0: x}, (-9.0, 9.0))
        assert high == pytest.approx((4 - x * x) ** 0.5)
        assert low == pytest.approx(-high)


def test_double_roots_count_once_over_a_single_value() -> None:
    """y^2 < x^3 - x: where the oval has its extreme y, x starts at the branch, not at the oval's double root."""
    pieces = [p for p in qe.region("y^2 < x^3 - x", order=("y", "x")).cells if p.ranges[0].is_point]
    assert len(pieces) == 2
    for piece in pieces:
        y = float(piece.sample["y"])
        low, _ = ends(piece, 1, {0: y}, (-9.0, 9.0))
        assert low == pytest.approx(2 / 3**0.5)

"""Parts of regions: sketches, walks, plane slices, measures, descriptions, operators."""

from base64 import b64decode
from fractions import Fraction
from random import Random

import numpy as np
import pytest

import qe
from qe.decomposition.interval import Interval
from qe.errors import InputError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.formula.build import exists
from qe.formula.evaluate import holds_at
from qe.io.text import read
from qe.options import Budget
from qe.processes.limits import Limits
from qe.regions import build, operators, picture, planar, sketch, slices, solutions, turnable, volume, walk
from qe.regions.region import Region
from qe.regions.upright import isolated, uprights
from tests.tables import each


def region(text: str, order: str) -> Region:
    return Region.of(read(text), tuple(order.split()), budget=Budget(120), limits=Limits(None))


# --- sketches --------------------------------------------------------------------------------------------------
def test_segments_of_a_line() -> None:
    found = sketch.sketch(region("0 <= x and x < 1 or x = 2", "x"))
    assert [(s.low, s.high, s.lower, s.upper) for s in found.segments] == [(0, 1, True, False), (2, 2, True, True)]
    low, high = found.spans[0]
    assert (low, high) == pytest.approx((-2 * sketch.MARGIN, 2 + 2 * sketch.MARGIN)) and not found.is_empty


def test_bands_of_a_disc() -> None:
    found = sketch.sketch(region("x^2 + y^2 < 4", "x y"))
    (band,) = [b for b in found.bands if len(b.xs) > 1]
    assert band.lower is False and band.upper is False and len(band.xs) == sketch.SAMPLES
    for x, low, high in zip(band.xs, band.low, band.high):
        assert (
            -2 < x < 2 and high == pytest.approx((4 - x * x) ** 0.5, abs=1e-6) and low == pytest.approx(-high, abs=1e-6)
        )
    assert list(band.xs) == sorted(band.xs)


def test_unbounded_directions_are_cut() -> None:
    found = sketch.sketch(region("y > x^2", "x y"))
    (band,) = [b for b in found.bands if len(b.xs) > 1]
    assert band.upper is None and band.lower is False
    assert found.spans[0][0] < -sketch.UNBOUNDED < sketch.UNBOUNDED < found.spans[0][1]
    assert sketch.sketch(region("x > 3", "x")).spans[0][1] > 3 + sketch.UNBOUNDED


def upright(text: str) -> list[tuple[float, float, float, bool]]:
    found = sketch.sketch(region(text, "x y"))
    (_, _), (bottom, top) = found.spans
    lines = uprights(found.bands, top - bottom)
    return [(line.x, round(line.low, 2), round(line.high, 2), line.closed) for line in lines]


@each(
    ("0 <= x and x < 1 and 0 <= y and y <= 1", [(0, 0, 1, True), (1, 0, 1, False)]),
    ("0 <= x and x <= 2 and 0 <= y and y <= 1 and x != 1", [(0, 0, 1, True), (1, 0, 1, False), (2, 0, 1, True)]),
    ("x^2 + y^2 <= 4 and (y >= 0 or x <= 0)", [(0, -2, 0, True)]),
    ("x*y = 0 and x^2 + y^2 <= 4", [(0, -2, 0, True), (0, 0, 2, True)]),
    ("x^2 + y^2 < 4", []),
    ("x = 1 and 0 <= y and y < 2", [(1, 0, 2, True)]),
)
def test_upright_borders(text: str, lines: list[tuple[float, float, float, bool]]) -> None:
    """Where a region ends over one value of x: closed, open, and not where it goes on."""
    assert upright(text) == lines


def test_the_open_end_of_an_upright_segment() -> None:
    (line,) = uprights(sketch.sketch(region("x = 1 and 0 <= y and y < 2", "x y")).bands, 2.0)
    assert line.open_ends == (2.0,)


def test_points_where_others_end_are_not_isolated() -> None:
    tips = sketch.sketch(region("x^2 + y^2 <= 1 and (x < 1 or y = 0) or x = 5 and y = 1", "x y"))
    assert isolated(tips.bands, 2.0) == [(5.0, 1.0)]


def test_what_goes_on_for_ever_has_no_end() -> None:
    (segment,) = sketch.sketch(region("x > 3", "x")).segments
    assert (segment.lower, segment.upper) == (False, None)


def test_one_place_of_floats_has_a_frame() -> None:
    """Numbers so near to each other that floats do not tell them apart gave limits that are equal."""
    low, high = sketch.sketch(region("x > 10^20 and x < 10^20 + 1", "x")).spans[0]
    assert low < 1e20 < high


def test_nothing_and_too_much() -> None:
    empty = sketch.sketch(region("x^2 < 0", "x"))
    assert empty.is_empty and empty.spans == ((-1.0, 1.0),) and empty.segments == ()
    with pytest.raises(InputError, match="1 to 3 variables"):
        sketch.sketch(region("x + y + z + w > 0", "x y z w"))


def test_areas_between_curves() -> None:
    ((xs, low, high),) = sketch.bands(region("y >= x^2 and y <= 1", "x y"))
    assert all(b == pytest.approx(1) and a == pytest.approx(x * x, abs=1e-6) for x, a, b in zip(xs, low, high))


# --- pictures --------------------------------------------------------------------------------------------------
def test_file_names_of_pictures(tmp_path) -> None:  # type: ignore[no-untyped-def]
    for name in ("a.png", "a.SVG", "a.pdf", "a.html"):
        picture.check_ending(tmp_path / name)
    with pytest.raises(InputError, match="a picture needs a file name"):
        picture.check_ending(tmp_path / "a.jpg")


def test_turnable_pages_have_the_points_of_the_surface() -> None:
    scene = turnable._scene(sketch.sketch(region("x^2 + y^2 + z^2 <= 1", "x y z")))
    assert [scene["low"][0], scene["high"][0]] == ["-1", "1"] and min(scene["size"]) > 0.99
    points = np.frombuffer(b64decode(str(scene["points"])), "<u2").reshape(-1, 3) / turnable.STEPS * 2 - 1
    faces = np.frombuffer(b64decode(str(scene["faces"])), "<u4")
    assert abs(np.linalg.norm(points, axis=1) - 1).max() < 0.05 and faces.max() < len(points) and len(faces) % 3 == 0


# --- walks -----------------------------------------------------------------------------------------------------
@each(
    "x^2 + y^2 <= 1",
    "y > x^2",
    "x*y = 1",
    "x^2 = 2 and y^2 = 3",
    "x > 10^30 and y < x",
    "0 < x and x < 1/10^20 and y = 1",
)
def test_walks_end_in_the_region(text: str) -> None:
    given = region(text, "x y")
    chance = Random(3)
    for _ in range(6):
        point = walk.walked(given, chance, Budget(60))
        assert point is not None and given.contains(point)
    assert walk.walked(region("x^2 + y^2 < 0", "x y"), chance, Budget(60)) is None


def test_different_points() -> None:
    found = walk.different_points(region("x^2 + y^2 <= 1", "x y"), 7, 0, Budget(60))
    assert len({tuple(p.values()) for p in found}) == 7
    few = walk.different_points(region("x^2 = 2 and y^2 = 1", "x y"), 9, 0, Budget(60))
    assert len({tuple(p.values()) for p in few}) == 4
    assert walk.different_points(region("x^2 < 0", "x"), 3, 0, Budget(60)) == []


@each((4096, 1), (8191, 1), (8192, 2), (Fraction(1, 2), Fraction(1, 8192)), (3, Fraction(1, 2048)))
def test_the_grid_of_random_values(width: Fraction, step: Fraction) -> None:
    assert walk._grid(Fraction(width), walk.STEPS) == step


def test_different_points_have_short_values_first() -> None:
    points = walk.different_points(region("x^2 + y^2 < 9", "x y"), 8, 0, Budget(60))
    assert len(points) == 8 and all(value.denominator <= 8 for point in points for value in point.values())


def test_values_of_intervals() -> None:
    root = RealAlgebraic.from_root([-2, 0, 1], 1, 2)
    for interval in (
        Interval(Fraction(0), Fraction(1, 10**30), False, False),
        Interval(None, Fraction(3), False, True),
        Interval(root, root + 1, False, False),
        Interval(None, None, False, False),
    ):
        for seed in range(5):
            value = walk._value(interval, Random(seed), walk.STEPS)
            assert isinstance(value, Fraction) and value in interval
    assert walk._value(Interval(root, root, True, True), Random(0), walk.STEPS) == root


# --- measures --------------------------------------------------------------------------------------------------
def test_unbounded_regions_have_no_measure() -> None:
    with pytest.raises(Unable, match="unbounded in y"):
        volume.enclose(region("x^2 <= 1 and y > 0", "x y"), Fraction(1, 10), budget=Budget(60))


@each(
    ("x^2 + y^2 + z^2 <= 1", True),
    ("0 <= x and x <= 1 and 0 <= y and y <= 1 and x*y - 1 <= z and z <= x*y", True),
    ("0 <= x and x <= 1 and 0 <= y and y <= 1 and 0 <= z and z^3 <= x", False),
    ("0 <= x and x <= 1 and 0 <= y and y <= 1 and z >= 0", False),
)
def test_which_slices_have_a_closed_form(text: str, closed: bool) -> None:
    full = [p for p in region(text, "x y z").cells if p.dimension == 3]
    assert full and all(slices.has_closed_slices(p) is closed for p in full)
    assert not any(map(slices.has_closed_slices, region("x^2 + y^2 <= 1", "x y").cells))


# --- topology, descriptions, solutions, operators -------------------------------------------------------------
def test_cells_and_their_frontiers() -> None:
    cells = planar.Cells.of(read("x^2 < 1"), ("x",), Budget(60))
    assert len(cells.truth) == 5 and [p for p, t in sorted(cells.truth.items()) if t] == [(2,)]
    assert sorted(cells.closure()) == [(1,), (2,), (3,)] and sorted(cells.boundary()) == [(1,), (3,)]
    assert cells.interior() == frozenset([(2,)]) and cells.components() == [frozenset([(2,)])]
    closed = planar.formula_of(read("x^2 + y^2 < 1"), ("x", "y"), planar.Cells.closure, Budget(60))
    assert qe.equivalent(closed, "x^2 + y^2 <= 1")


@each(("ex y. x = y^2 and y < 2", "x >= 0"), ("x < root(2, x^2 - a, x)", "a > 0 and (x^2 < a or x < 0)"))
def test_descriptions_of_any_formula(text: str, plain: str) -> None:
    found = build.described(read(text), None, Budget(60), Limits(None))
    assert found.answer is not None and qe.equivalent(found.formula, plain)
    quantifier_free = build.described(read("x > 1"), ("x",), Budget(60), Limits(None))
    assert quantifier_free.answer is None and quantifier_free.order == ("x",)


def test_elimination_as_a_value() -> None:
    found = build.Elimination(("a",))(exists(["x"], read("x^2 = a")), Budget(60))
    assert str(found) == "a >= 0"


def test_solutions_are_read_back() -> None:
    given = region("x^2 = 1 and y > x", "x y")
    found = solutions.Solutions(given.order, tuple(given.cells), given, tuple(map(str, given.cells)))
    assert len(found) == 2 and list(found) == [found[0], found[1]] and " or\n" in str(found)
    assert repr(found) == "Solutions(x, y: 2 cases)" and found._repr_html_().count("<li>") == 2
    for x in (-1, 0, 1):
        for y in (-2, 0, 2):
            assert holds_at(found.formula, {"x": x, "y": y}) == (x * x == 1 and y > x)
    none = solutions.Solutions(("x",), (), region("x^2 < 0", "x"), ())
    assert (
        str(none) == "false" and none._repr_html_() == "<p>no solutions</p>" and repr(none) == "Solutions(x: 0 cases)"
    )


def test_operators_ask_in_one_place(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every operator says which way, with its operands in their order."""
    asked: list[tuple[object, ...]] = []

    class Ways:
        def __getattr__(self, name: str):  # type: ignore[no-untyped-def]
            return lambda *given: asked.append((name, *given)) or name

    class Set(operators.SetOperations):
        order = ("x",)

    monkeypatch.setattr(operators, "_ways", Ways)
    a, b = Set(), Set()
    _ = (a & b, 1 & a, a | b, 1 | a, a - b, a ^ b, ~a, a <= b, a >= b, a == b)
    assert [(entry[0], *(part for part in entry if isinstance(part, str) and part != entry[0])) for entry in asked] == [
        *(("joined", way) for way in ("and", "and", "or", "or", "minus", "xor")),
        ("complement",),
        *(("compared", way) for way in ("subset", "superset", "equal")),
    ]
    assert all(entry[2] is a and entry[3] is b for entry in asked if entry[0] == "compared")
    assert a.__eq__(3) is NotImplemented and len({a, a}) == 1
    asked.clear()
    a.closure(timeout=3), a.is_disjoint(b), a.sample(5), a.find_instances(2, seed=1), a.distance([1])
    assert asked == [
        ("topological", a, "closure", 3),
        ("compared", "disjoint", a, b, None),
        ("sample", a, 5, None),
        ("instances", a, 2, 1, None),
        ("distance", a, [1], None),
    ]

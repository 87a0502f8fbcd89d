"""Points at which a formula holds beside the convex set that it was read from, and missing ones."""

from qe.decomposition.confirm_convex import strangers
from qe.decomposition.decompose import decompose
from qe.exact.sample import Point
from qe.formula.evaluate import holds_at
from qe.io import formats
from qe.options import Budget

DISC = "x^2 + y^2 <= 4"


def found(text: str, body: str, names: tuple[str, ...] = ("x", "y"), bounded: bool = True) -> list[Point] | None:
    formula = formats.read(text, "text")
    table = decompose(formula, names, ("",) * len(names), budget=Budget()).table
    convex = formats.read(body, "text")
    return strangers(table, lambda values: holds_at(convex, dict(zip(names, values, strict=True))), bounded=bounded)


def strays(text: str, body: str, names: tuple[str, ...] = ("x", "y")) -> list[Point]:
    points = found(text, body, names)
    assert points is not None
    return points


def test_the_set_itself() -> None:
    assert found(DISC, DISC) == []
    assert found("x^2 <= 2 and y >= x and y <= 3", "x^2 <= 2 and y >= x and y <= 3") == []
    assert found("x^2 <= 2", "x^2 <= 2", ("x",)) == []


def test_isolated_points_far_away_and_above() -> None:
    (point,) = strays(f"{DISC} or (x - 5)^2 + y^2 <= 0", DISC)
    assert (point.number(0), point.number(1)) == (5, 0)
    (point,) = strays(f"{DISC} or x^2 + (y - 5)^2 <= 0", DISC)
    assert (point.number(0), point.number(1)) == (0, 5)
    (point,) = strays("x^2 <= 2 or (x - 2)^2 <= 0", "x^2 <= 2", ("x",))
    assert point.number(0) == 2


def test_arcs_and_hairs() -> None:
    assert strays(f"{DISC} or (y - x - 5 <= 0 and y - x - 5 >= 0)", DISC)
    assert strays(f"{DISC} or (x^2 <= 0 and y >= 0 and y <= 5)", DISC)
    assert strays(f"{DISC} or (x^2 - 2 <= 0 and x^2 - 2 >= 0 and y >= 0 and y <= 5)", DISC)
    assert strays(f"{DISC} or (x = 5 and y >= 0 and y <= 5)", DISC)


def test_where_boundedness_matters() -> None:
    assert found(DISC, DISC, bounded=False) is None  # the ends at x = 2 and x = -2 are not known to belong to it


def test_missing_points() -> None:
    assert found("x^2 + y^2 < 4", DISC) is None
    assert found(f"{DISC} and x /= 0", DISC) is None
    assert found(f"{DISC} and x^2 /= 2", DISC) is None
    assert found(f"{DISC} and y /= 0", DISC) is None
    assert found(f"{DISC} and x < 2", DISC) is None
    assert found(f"{DISC} and (x /= 0 or y < 2)", DISC) is None
    assert found(f"{DISC} and (x /= 0 or y < 1)", DISC) is None
    assert found("x^2 <= 2 and x^2 /= 2", "x^2 <= 2", ("x",)) is None


def test_faces_over_a_single_value() -> None:
    box = "x >= 0 and x <= 1 and y >= 0 and y <= F"
    assert found(box.replace("F", "1"), box.replace("F", "1")) == []
    assert strays(f"{box.replace('F', '1')} or (x = 0 and y >= 0 and y <= 2)", box.replace("F", "1"))

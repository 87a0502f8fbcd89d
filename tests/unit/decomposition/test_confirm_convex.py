"""Points at which a formula holds beside the convex set that it was read from, and missing ones."""

from qe.decomposition.confirm_convex import strangers
from qe.decomposition.decompose import decompose
from qe.exact.sample import Point
from qe.formula.evaluate import holds_at
from qe.io import formats
from qe.options import Budget
from tests.tables import each

DISC = "x^2 + y^2 <= 4"


def found(text: str, body: str, names: tuple[str, ...] = ("x", "y"), bounded: bool = True) -> list[Point] | None:
    formula = formats.read(text, "text")
    table = decompose(formula, names, ("",) * len(names), budget=Budget()).table
    convex = formats.read(body, "text")
    return strangers(table, lambda values: holds_at(convex, dict(zip(names, values, strict=True))), bounded=bounded)


BOX = "x >= 0 and x <= 1 and y >= 0 and y <= 1"
SLAB, LINE = "x^2 <= 2 and y >= x and y <= 3", "x^2 <= 2"


@each((DISC, "xy"), (SLAB, "xy"), (LINE, "x"), (BOX, "xy"))
def test_the_set_itself(text: str, names: str) -> None:
    assert found(text, text, tuple(names)) == []


@each(
    (f"{DISC} or (x - 5)^2 + y^2 <= 0", DISC, (5, 0)),
    (f"{DISC} or x^2 + (y - 5)^2 <= 0", DISC, (0, 5)),
    (f"{LINE} or (x - 2)^2 <= 0", LINE, (2,)),
)
def test_isolated_points_far_away_and_above(text: str, body: str, at: tuple[int, ...]) -> None:
    (point,) = found(text, body, ("x", "y")[: len(at)]) or []
    assert tuple(point.number(k) for k in range(len(at))) == at


@each(
    (f"{DISC} or (y - x - 5 <= 0 and y - x - 5 >= 0)", DISC),
    (f"{DISC} or (x^2 <= 0 and y >= 0 and y <= 5)", DISC),
    (f"{DISC} or (x^2 - 2 <= 0 and x^2 - 2 >= 0 and y >= 0 and y <= 5)", DISC),
    (f"{DISC} or (x = 5 and y >= 0 and y <= 5)", DISC),
    (f"{BOX} or (x = 0 and y >= 0 and y <= 2)", BOX),  # a face over a single value
)
def test_arcs_and_hairs(text: str, body: str) -> None:
    assert found(text, body)


@each(
    ("x^2 + y^2 < 4", DISC),
    (f"{DISC} and x /= 0", DISC),
    (f"{DISC} and x^2 /= 2", DISC),
    (f"{DISC} and y /= 0", DISC),
    (f"{DISC} and x < 2", DISC),
    (f"{DISC} and (x /= 0 or y < 2)", DISC),
    (f"{DISC} and (x /= 0 or y < 1)", DISC),
    (f"{LINE} and x^2 /= 2", LINE),
)
def test_missing_points(text: str, body: str) -> None:
    assert found(text, body, ("x", "y") if "y" in text else ("x",)) is None


def test_where_boundedness_matters() -> None:
    assert found(DISC, DISC, bounded=False) is None  # the ends at x = 2 and x = -2 are not known to belong to it

"""Deciding a block over single points: every way gives the same answers."""

from fractions import Fraction as F

import pytest

from qe.decomposition.over_point import over_point
from qe.elimination.critical.fibres import Fibres
from qe.exact.algebraic import RealAlgebraic
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.formula.evaluate import holds_at
from qe.io import formats
from qe.options import Budget
from tests.tables import each
from tests.unit.elimination.critical.test_side_conditions import only

LENS = "y^2 + z^2 <= 4 and (y - p)^2 + (z - q)^2 <= 1 and p <= 3"
NAMES = ("p", "q", "y", "z")


def in_lens(p: F, q: F) -> bool:
    return p * p + q * q <= 9 and p <= 3


def points() -> list[tuple[F, F]]:
    grid = [(F(a, 2), F(b, 3)) for a in range(-8, 9, 2) for b in range(-10, 11, 4)]
    return [*grid, (F(0), F(3)), (F(9, 5), F(12, 5))]


def test_answers_and_what_is_remembered() -> None:
    fibres = Fibres(only(LENS, ("p", "q"), ("y", "z")), Budget())
    for p, q in points():
        assert fibres.hold_at((p, q)) == in_lens(p, q)
    assert fibres.decided["known"] > fibres.decided["proposed"]


def test_proposals_are_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    """With nonsense for proposals the answers stay right: they come from the exact decision."""
    for nonsense in (((F(0), F(0)), None), (None, (F(1), F(1))), (None, (F(1), F(-1))), (None, None)):
        monkeypatch.setattr("qe.elimination.critical.fibres.proposed", lambda forms, given=nonsense: given)
        fibres = Fibres(only(LENS, ("p", "q"), ("y", "z")), Budget())
        for p, q in points()[::7]:
            assert fibres.hold_at((p, q)) == in_lens(p, q)


def algebraic(text: str) -> RealAlgebraic:
    return RealAlgebraic.from_root({"sqrt2": (-2, 0, 1), "sqrt3": (-3, 0, 1)}[text], 1, 2)


@each(
    ("sqrt2", F(0), True),  # on the boundary
    ("sqrt2", "sqrt2", False),
    (F(1), F(1), True),
    (F(1), "sqrt3", False),
    (F(-1), "sqrt2", False),
    (F(0), "sqrt2", True),
)
def test_over_algebraic_points(p: F | str, q: F | str, expected: bool) -> None:
    text = "y^2 + z^2 <= 2 and y = p and z >= q and z <= 2"
    decide = over_point(formats.read(text, "text"), NAMES, 2, budget=Budget())
    values = [algebraic(v) if isinstance(v, str) else v for v in (p, q)]
    assert decide(Point.of(Ring.of(NAMES), values)) is expected


def test_over_point_where_polynomials_are_nullified() -> None:
    formula = formats.read("p*y + q*z = p and y^2 + z^2 <= 1 and p*y >= z*q", "text")
    decide = over_point(formula, NAMES, 2, budget=Budget())
    assert decide(Point.of(Ring.of(NAMES), [0, 0]))
    assert decide(Point.of(Ring.of(NAMES), [1, 0]))
    assert holds_at(formula, {"p": 1, "q": 0, "y": 1, "z": 0})
    tall = formats.read("p*y + q*z = 1 and y^2 + z^2 <= 1", "text")
    decide = over_point(tall, NAMES, 2, budget=Budget())
    assert not decide(Point.of(Ring.of(NAMES), [0, 0]))
    assert decide(Point.of(Ring.of(NAMES), [F(3, 5), F(4, 5)]))
    assert not decide(Point.of(Ring.of(NAMES), [F(3, 5), F(3, 5)]))

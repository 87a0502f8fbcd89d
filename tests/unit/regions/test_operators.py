"""Sets and their operators, against what they mean."""

import pickle
from fractions import Fraction

import pytest

import qe
from qe.regions.convex_region import ConvexRegion
from tests.tables import each

DISC = qe.region("x^2 + y^2 <= 1")
HALF = qe.region("y > x", order="x, y")
BALL = "x^2 + y^2 + z^2 + w^2 <= 4 and x + y >= 1"


@each(
    (DISC & HALF, "x^2 + y^2 <= 1 and y > x"),
    (DISC | HALF, "x^2 + y^2 <= 1 or y > x"),
    (DISC - HALF, "x^2 + y^2 <= 1 and y <= x"),
    (DISC ^ HALF, "not (x^2 + y^2 <= 1 <-> y > x)"),
    (~DISC, "x^2 + y^2 > 1"),
    (DISC & "x > 0", "x^2 + y^2 <= 1 and x > 0"),
    ("x > 0" | DISC, "x^2 + y^2 <= 1 or x > 0"),
    (DISC.interior(), "x^2 + y^2 < 1"),
    ((DISC & HALF).closure(), "x^2 + y^2 <= 1 and y >= x"),
    (HALF.boundary(), "x = y"),
)
def test_operators_make_the_set_that_they_mean(made: qe.Region, meant: str) -> None:
    assert made == qe.region(meant, order="x, y")
    assert qe.equivalent(made.formula, meant)


def test_relations_of_sets() -> None:
    assert DISC & HALF <= DISC and DISC >= DISC & HALF and not DISC <= HALF
    assert DISC.is_subset("x < 2") and DISC.is_disjoint("x > 1") and not DISC.is_disjoint("x >= 1")
    assert qe.region("y^2 + x^2 <= 1", order="y, x") == DISC and hash(DISC) == hash(qe.region("x + y > 0"))
    assert DISC != HALF and qe.region("x^2 <= 1") != DISC and DISC != "x^2 + y^2 <= 1"


@each(
    (lambda: DISC & qe.region("z > 0"), "same variables"),
    (lambda: DISC & "z > 0", "z found"),
    (lambda: DISC & 3, "3 found"),
    (lambda: DISC.project("z"), "some of x, y"),
    (lambda: DISC.project("x x"), "each name once"),
    (lambda: DISC.section({"x": 0, "y": 0}), "a variable without a value"),
    (lambda: DISC.section({"z": 0}), "z found"),
    (lambda: DISC.distance({"x": 0}), "a value for y"),
    (lambda: (DISC & "x > 5").distance({"x": 0, "y": 0}), "empty"),
    (lambda: (DISC & "x > 5").sample(), "empty"),
    (lambda: (DISC & "x > 5").bounding_box(), "empty"),
    (lambda: DISC.find_instances(-1), "natural number"),
    (lambda: DISC.sample("a"), "integers"),
    (lambda: DISC.closure(timeout=-1), "positive"),
    (lambda: (DISC & HALF).interior(timeout="1"), "positive"),
)
def test_misuse_gets_one_line(wrong, words: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        wrong()
    assert words in str(caught.value) and "\n" not in str(caught.value)


def test_shadows_and_slices() -> None:
    assert DISC.project("y") == qe.region("y^2 <= 1")
    assert (DISC & HALF).project(["y"]) == qe.region("y^2 < 1 and y > 0 or 2*y^2 < 1 or y = 1")
    assert DISC.section({"x": "1/2"}) == qe.region("4*y^2 <= 3")
    edge = DISC.section({"y": "1/3"}).bounds("x").upper  # irrational
    assert qe.region("x^2 + y^2 + z^2 <= 3").section({"x": edge}) == qe.region("9*y^2 + 9*z^2 <= 19")
    box = DISC.bounding_box()
    assert [tuple(box[v]) for v in "xy"] == [(-1, 1)] * 2 and box["x"].lower_closed


def test_distances() -> None:
    def far(text: str, **point: object) -> str:
        return str(qe.region(text, order=",".join(point)).distance(point))

    assert far("x^2 + y^2 <= 1", x=2, y=2) == "-1 + 2*sqrt(2)"
    assert far("x^2 + y^2 < 1", x=1, y=0) == far("x^2 + y^2 <= 1", x=0, y="0.5") == "0"
    assert far("y <= x", x=0, y=1) == "sqrt(2)/2"
    assert far("x^2 >= 4", x=Fraction(1, 2)) == "3/2"  # no convex set
    assert far("x^2 + y^2 <= 1", x=qe.region("a^2 = 7 and a > 0").bounds("a").lower, y=0) == "-1 + sqrt(7)"
    # sqrt(51/2) from the middle of the ball in the plane x + y = 1, whose square radius is 7/2
    apart = qe.region(BALL).distance({"x": 1, "y": 0, "z": 0, "w": 5})
    assert apart == (qe.region("s^2 = 102 and s > 0").sample()["s"] - qe.region("s^2 = 14 and s > 0").sample()["s"]) / 2


def test_convex_sets_stay_convex() -> None:
    whole = qe.region(BALL)
    part = whole & "z > 0"
    assert isinstance(part, ConvexRegion) and isinstance(whole.project("x, y"), ConvexRegion)
    assert part.components() == [part] and (part & "z < 0").components() == []
    assert whole.contains(whole.sample(3))


def test_points() -> None:
    finite = qe.region("x^2 = 2 or x = 5")
    assert sorted(str(p["x"]) for p in finite.find_instances(9)) == ["-sqrt(2)", "5", "sqrt(2)"]
    many = DISC.find_instances(20, seed=1)
    assert len({tuple(p.values()) for p in many}) == 20 and all(DISC.contains(p) for p in many)
    assert DISC.sample(5) == DISC.sample(5) != DISC.sample(6)
    assert qe.find_instances("ex z. z^2 + x^2 < 1", 2, seed=3) == qe.region("x^2 < 1").find_instances(2, seed=3)
    assert qe.find_instances("x < x", 3) == [] and qe.find_instances("0 < 1", 3) == [{}]
    assert qe.find_instances("x = 1 or x^2 + y^2 < 0", 2, seed=0)[0]["x"] == 1
    thin = qe.region("0 < x and 10^30*x < 1").sample()
    assert 0 < thin["x"] < Fraction(1, 10**30)


def test_limits_hold() -> None:
    hard = "x^7 + y^7 + z^7 + x*y*z + w^5*x = 1 and x^4 + w*y > z^4"
    with pytest.raises(qe.Unable):
        qe.solve(hard, timeout=0.3)
    with pytest.raises(qe.Unable):
        qe.find_instances(hard, 2, timeout=0.3)


def test_everything_is_pickled() -> None:
    for value in (DISC & HALF, DISC.closure(), qe.solve("x^2 + y^2 < 1"), DISC.bounding_box(), DISC.sample()):
        assert str(pickle.loads(pickle.dumps(value))) == str(value)

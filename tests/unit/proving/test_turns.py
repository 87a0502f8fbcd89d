"""Blocks that only look at lengths and angles: one coordinate is 0, another not negative."""

from fractions import Fraction
from typing import Any

from qe.certify.verify import verify
from qe.exact.ring import Ring
from qe.options import Budget, Options
from qe.proof.certificate import Certificate, written
from qe.proof.derivation import moved
from qe.proof.step import Step
from qe.proving.made import FRESH, at_number
from qe.proving.prover import Prover
from tests.tables import each
from tests.unit.certify.claims import RING, formula


def turn(zero: str, half: str, *plane: tuple[str, str, str]) -> dict[str, Any]:
    return {"zero": zero, "half": half, "plane": [list(p) for p in plane]}


def by(*turns: dict[str, Any]) -> dict[str, Any]:
    return {"turns": list(turns)}


def proved(before: str, after: str, turns: dict[str, Any]) -> bool:
    """Whether the step is made of steps of the kernel alone, which is asked once more about all of it."""
    ring = Ring.of((*RING.names, *FRESH))
    one, other = (moved(formula(text), ring) for text in (before, after))
    step = Step("rotation of the axes", one, other, evidence={"proof": turns})
    found = Prover(ring, Options(), Budget(60)).own(step, ())
    if found is None:
        return False
    made = written(found[0], (), one, other, (), found[1])
    return verify(Certificate.derivation(ring.names, one, [made], other), core=True).accepted


XY = ("x", "y", "1")
DISC = "ex x, y. x^2 + y^2 > a and x^2 + y^2 < b"
ANGLE = "ex x, y, z, c. x^2 + y^2 = a and x*z + y*c = b and z^2 + c^2 = 1"
SPACE = "ex x, y, z. x^2 + y^2 + z^2 = a and z > b"


@each(
    (DISC, "ex x. x >= 0 and x^2 > a and x^2 < b", by(turn("y", "x", XY))),
    (DISC, "ex y. y >= 0 and y^2 > a and y^2 < b", by(turn("x", "y", XY))),
    ("all x, y. x^2 + y^2 > a", "all x. x < 0 or x^2 > a", by(turn("y", "x", XY))),
    (
        ANGLE,
        "ex x, z, c. x >= 0 and x^2 = a and x*z = b and z^2 + c^2 = 1",
        by(turn("y", "x", XY, ("z", "c", "1"))),
    ),
    (SPACE, "ex x, z. x >= 0 and x^2 + z^2 = a and z > b", by(turn("y", "x", XY))),
    (
        "ex x, y, z. x^2 + y^2 + z^2 = a",
        "ex x. x >= 0 and x^2 = a",
        by(turn("z", "y", ("y", "z", "1")), turn("y", "x", XY)),
    ),
    (
        "ex x, y, z, c. (x - z /= 0 or y - c /= 0) and x^2 + y^2 = a",
        "ex x, z, c. x >= 0 and (x - z /= 0 or c /= 0) and x^2 = a",
        by(turn("y", "x", XY, ("z", "c", "1"))),
    ),
    (
        "ex x, y, z, c. x*z - y*c > a and x^2 + y^2 < b",
        "ex x, z, c. x >= 0 and x*z > a and x^2 < b",
        by(turn("y", "x", XY, ("c", "z", "1"))),
    ),
)
def test_turned_into_an_axis(before: str, after: str, turns: Any) -> None:
    assert proved(before, after, turns)


@each(
    (DISC, "ex x. x^2 > a and x^2 < b", by(turn("y", "x", XY))),
    (DISC, "ex x. x > 0 and x^2 > a and x^2 < b", by(turn("y", "x", XY))),
    (DISC, "ex x. x <= 0 and x^2 > a and x^2 < b", by(turn("y", "x", XY))),
    ("ex x, y. x^2 - y^2 > a", "ex x. x >= 0 and x^2 > a", by(turn("y", "x", XY))),
    ("ex x, y. x^2 + 2*y^2 > a", "ex x. x >= 0 and x^2 > a", by(turn("y", "x", XY))),
    (ANGLE, "true", by(turn("y", "x", XY))),  # the other vector must turn, too
    (ANGLE, "true", by(turn("y", "x", XY, ("z", "c", "-1")))),
    (ANGLE, "true", by(turn("y", "x", XY, ("z", "c", "2")))),
    (DISC, "true", by(turn("y", "x", ("x", "y", "2")))),
    (SPACE, "true", by(turn("y", "x", XY, ("y", "z", "1")))),
    (DISC, "true", by(turn("y", "y", XY))),
    (DISC, "true", by(turn("a", "x", ("x", "a", "1")))),
    (DISC, "true", by(turn("y", "x", XY, XY))),
    (DISC, "true", by(turn("y", "x", XY, ("y", "x", "1")))),
    (DISC, "true", by(turn("y", "x", ("x", "y", "0")))),
    (DISC, "true", by(turn("y", "x", ("x", "x", "1")))),
    ("ex x. b > 0 and (ex y. x^2 + y^2 > a)", "true", by(turn("y", "x", XY))),
    ("x^2 + y^2 > a", "true", by(turn("y", "x", XY))),
    ("ex x, y. x^2 + y^2 > a and (ex x. x > b)", "true", by(turn("y", "x", XY))),
    ("ex x, y. x > root(1, x^2 + y^2 - a, x)", "true", by(turn("y", "x", XY))),
)
def test_what_breaks_a_rotation(before: str, after: str, turns: Any) -> None:
    assert not proved(before, after, turns)


def test_the_earlier_sign_is_kept_only_where_it_is_not_moved() -> None:
    """The second turn moves y, so that y >= 0 is lost."""
    before = "ex x, y, z. x^2 + y^2 + z^2 = a and (ex b, c. b*x > 0)"
    assert not proved(before, "true", by(turn("z", "y", ("y", "z", "1"))))
    twice = by(turn("z", "y", ("y", "z", "1")), turn("y", "x", XY))
    three = "ex x, y, z. x^2 + y^2 + z^2 = a"
    assert proved(three, "ex x. x >= 0 and x^2 = a", twice)
    assert not proved(three, "ex x. x^2 = a", twice)
    after = "ex x, c. c >= 0 and x >= 0 and x^2 + c^2 = a"
    apart = by(turn("z", "c", ("c", "z", "1")), turn("y", "x", XY))
    assert proved("ex x, y, z, c. x^2 + y^2 + (z^2 + c^2) = a", after, apart)


def test_equations_are_constant_together() -> None:
    """The equations x = 0, y = 0 turn into each other: the sum of their squares is constant."""
    both = "ex x, y, z. x*z = 0 and y*z = 0 and z > a"
    assert proved(both, "ex x, z. x >= 0 and x*z = 0 and z > a", by(turn("y", "x", XY)))
    one = "ex x, y, z. x*z = 0 and y*z > 0 and z > a"
    assert not proved(one, "true", by(turn("y", "x", XY)))


def test_a_number_for_a_variable() -> None:
    found = at_number(formula("not (ex y. x + y > 0) or y = 2*x"), RING.index["x"], Fraction(1, 2))
    assert found == formula("not (ex y. 1 + 2*y > 0) or y = 1")

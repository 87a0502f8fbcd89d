"""Blocks that only look at lengths and angles: one coordinate is 0, another not negative."""

from fractions import Fraction
from typing import Any

from qe.certify.verify import verify
from qe.exact.ring import Ring
from qe.formula.evaluate import substituted
from qe.options import Budget, Options
from qe.proof.certificate import Certificate, written
from qe.proof.derivation import moved
from qe.proof.step import Step
from qe.proving.made import FRESH
from qe.proving.prover import Prover
from tests.tables import each
from tests.unit.certify.claims import RING, formula
from tests.unit.proving.rotations import NOT_TURNED, TURNED, XY, by, turn


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


@each(
    *TURNED,
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


@each(*NOT_TURNED)
def test_what_breaks_a_rotation(before: str, after: str, turns: Any, reason: str) -> None:
    assert not proved(before, after, turns)


def test_a_number_for_a_variable() -> None:
    found = substituted(formula("not (ex y. x + y > 0) or y = 2*x"), {"x": Fraction(1, 2)})
    assert found == formula("not (ex y. 1 + 2*y > 0) or y = 1")

"""The degree shift before an elimination set, in steps of the kernel."""

from typing import Any

import pytest

from qe.certify.registry import RULES
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import Exists, Formula
from qe.kernel.quantifiers import unordered
from qe.kernel.step import Claim
from qe.proof.entry import Entry
from qe.proving.made import FRESH, Made
from qe.proving.shifts import lower_first, raised
from tests.tables import each
from tests.unit.certify.claims import RING, formula, limits

ORDER = Ring.of((*RING.names, *FRESH))


def claim(before: Formula, after: Formula, evidence: Any = None) -> Claim:
    return Claim("steps", before, after, ORDER, Entry(evidence or {}, "evidence"), "step")


def lowered(text: str, exponent: int) -> Formula:
    """What becomes of a block over the formula, by steps that the kernel accepts, there and back."""
    block = convert(formula(f"ex x, y. {text}"), ORDER)
    assert isinstance(block, Exists)
    made = Made(claim(block, block), limits(), block)
    found = lower_first(made, block, "x", exponent)
    RULES["steps"](claim(block, found, {"steps": made.steps}), (), limits())
    back: Any = raised(Made(claim(found, block), limits(), found), block, "x", exponent)
    RULES["steps"](claim(found, block, {"steps": back}), (), limits())
    return found


@each(
    ("x^6 + a*x^3 = y", 3, "x^2 + a*x = y"),
    ("x^3 < a and x > 0 and x^3 > y", 3, "x < a and x > 0 and x > y"),
    ("x^4 + y < 0", 2, "x^2 + y < 0 and x > 0"),  # an open set contains more than 0
    ("x^4 + y <= 0", 2, "x^2 + y <= 0 and x >= 0"),
    ("x^4 < a and x^2 /= y and y <= 0", 2, "x^2 < a and x /= y and y <= 0 and x > 0"),
    ("x^2 = y and x > 0", 2, "x = y and x > 0 and x >= 0"),
    ("x^2 < y and x >= 0", 2, "x < y and x >= 0"),
)
def test_exponents_are_divided(text: str, exponent: int, after: str) -> None:
    assert unordered(lowered(text, exponent)) == unordered(convert(formula(f"ex x, y. {after}"), ORDER))


@each(
    ("x^3 = y", 2),
    ("x^4 + x^2 + y = 0", 4),
    ("x^2 = y and x < 0", 2),
    ("x^2 = y and x <= 0", 2),
    ("x^2 = y and (x > 0 or y > 1)", 2),  # it is no conjunct
    ("x^2 = y or x > 0", 2),
    ("x^2 = a and y*x > 0", 2),  # the sign of x is not known
    ("x^2 = y and x < root(1, x^2 - a)", 2),
)
def test_what_the_theorem_does_not_allow(text: str, exponent: int) -> None:
    with pytest.raises(CertificateRejected):
        lowered(text, exponent)

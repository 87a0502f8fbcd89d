"""Steps of rules that are no primitives, in the language of the kernel: true ones are, false ones cannot be."""

from __future__ import annotations

from typing import Any

import pytest

from qe.certify.step import Claim
from qe.errors import CertificateRejected
from qe.formula.traverse import conjuncts
from qe.proof.entry import Entry
from qe.proving.elaborators import ELABORATORS
from tests.unit.certify.claims import NO_LEMMAS, RING, formula, limits, line, objection, step


def refused(rule: str, before: str, after: str, evidence: Any, given: str = "true") -> str:
    """Why a step is not one of the kernel; nothing where it is."""
    context = conjuncts(formula(given)) if given != "true" else ()
    claim = Claim(rule, formula(before), formula(after), RING, Entry(evidence, "evidence"), "step")
    try:
        steps = ELABORATORS[rule](claim, context, limits())
    except CertificateRejected as error:
        return str(error)
    return objection("steps", before, after, {"steps": steps}, given)


def by(*equations: tuple[str, str]) -> dict[str, Any]:
    return {"equations": [[name, line(text)] for name, text in equations], "theory": NO_LEMMAS}


WITNESS, SHEAR, APART = "witness in the parameters", "linear form as a variable", "disjuncts with equations apart"
REDUNDANT, CONSTANT = "redundant part", "constant"
BLOCK = "ex x. (x = a or x = b) and x > c and (x < 1 or x > 2)"
FIRST = "(ex x. x > c and (x < 1 or x > 2) and x = a) or (ex x. x > c and (x < 1 or x > 2) and x = b)"
SECOND = "(ex x. (x = a or x = b) and x > c and x < 1) or (ex x. (x = a or x = b) and x > c and x > 2)"
MIDDLE = ("x", "a + b - 2*x")
SOLVED = {"solved": [["x", "-a + x", 1]], "theory": NO_LEMMAS}
NOWHERE = [step("linear equation solved", "ex a, x. x = a and x > a", "false", SOLVED)]
BESIDE = [step("linear equation solved", "ex a, b, x. b <= 0 and x = a and x > a", "false", SOLVED)]

TRUE_STEPS: list[tuple[str, str, str, Any, str]] = [
    (WITNESS, "ex x. x > a and x < b", "true", by(MIDDLE), "a < b"),
    (WITNESS, "ex x. x >= a", "true", by(("x", "a - x")), "true"),
    (WITNESS, "ex x, y. y > x and x > a", "true", by(("y", "x - y + 1"), ("x", "a - x + 1")), "true"),
    (WITNESS, "ex x, y. y = 2*x and x = a", "true", by(("y", "2*x - y"), ("x", "a - x")), "true"),
    (APART, BLOCK, FIRST, {}, "true"),
    (APART, BLOCK, SECOND, {}, "true"),
    (APART, "ex x. x = a or x = b", "(ex x. x = a) or (ex x. x = b)", {}, "true"),
    (SHEAR, "ex x. x + a > b and x + a < c", "ex x. x > b and x < c", {"variable": "x", "form": "a + x"}, "true"),
    (
        SHEAR,
        "ex x. a*x + b > c and (a*x + b)^2 < 1",
        "(ex x. a /= 0 and x > c and x^2 < 1) or (ex x. a = 0 and a*x + b > c and (a*x + b)^2 < 1)",
        {"variable": "x", "form": "a*x + b"},
        "true",
    ),
    (CONSTANT, "x = a and x > a", "false", {"steps": NOWHERE}, "true"),
    (CONSTANT, "x /= a or x <= a", "true", {"steps": NOWHERE}, "true"),
    (REDUNDANT, "b > 0 or (x = a and x > a)", "b > 0", {"at": [1], "steps": BESIDE}, "true"),
]

FALSE_STEPS: list[tuple[str, str, str, Any, str]] = [
    (WITNESS, "ex x. x > a and x < b", "true", by(MIDDLE), "true"),
    (WITNESS, "ex x. x > a and x < b", "true", by(MIDDLE), "a <= b"),
    (WITNESS, "ex x. x > a and x < b", "true", by(("x", "a - x")), "a < b"),
    (WITNESS, "ex x. x > a and x < b", "true", by(), "a < b"),
    (WITNESS, "ex x. x > a", "true", by(("x", "a*x - 1")), "true"),
    (WITNESS, "ex x. x^2 > a", "true", by(("x", "x - 1")), "x > a"),  # of another x
    (APART, BLOCK, "(ex x. x > c and (x < 1 or x > 2) and x = a)", {}, "true"),
    (APART, BLOCK, "(ex x. (x < 1 or x > 2) and x = a) or (ex x. (x < 1 or x > 2) and x = b)", {}, "true"),
    (APART, "all x. x = a or x = b", "(all x. x = a) or (all x. x = b)", {}, "true"),
    (APART, "ex x. x > a and x < b", "(ex x. x > a) and (ex x. x < b)", {}, "true"),
    (SHEAR, "ex x. x + a > b and x < c", "ex x. x > b and x < c", {"variable": "x", "form": "a + x"}, "true"),
    (SHEAR, "ex x. a*x > b and a*x < c", "ex x. x > b and x < c", {"variable": "x", "form": "a*x"}, "true"),
    (CONSTANT, "x = a and x > a", "true", {"steps": NOWHERE}, "true"),
    (CONSTANT, "x /= a or x <= a", "false", {"steps": NOWHERE}, "true"),
    (CONSTANT, "x = a and x > a", "a > 0", {"steps": NOWHERE}, "true"),
    (REDUNDANT, "b > 0 or (x = a and x > a)", "x = a and x > a", {"at": [0], "steps": NOWHERE}, "true"),
    (REDUNDANT, "b > 0 or (x = a and x > a)", "b > 0", {"at": [1], "steps": []}, "true"),
]


@pytest.mark.parametrize(("rule", "before", "after", "evidence", "given"), TRUE_STEPS)
def test_a_true_step_is_one_of_the_kernel(rule: str, before: str, after: str, evidence: Any, given: str) -> None:
    assert refused(rule, before, after, evidence, given) == ""


@pytest.mark.parametrize(("rule", "before", "after", "evidence", "given"), FALSE_STEPS)
def test_a_false_step_is_none(rule: str, before: str, after: str, evidence: Any, given: str) -> None:
    assert refused(rule, before, after, evidence, given)

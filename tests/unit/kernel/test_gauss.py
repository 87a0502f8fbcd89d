"""Existential variables removed by linear equations: carried out again, compared as sets of conjuncts."""

from __future__ import annotations

from typing import Any

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.kernel.gauss import check_substitution
from qe.proof.entry import formula_to_json

RING = Ring.of(("a", "b", "x", "y"))
MATRIX = "2*x - a = 0 and x > b and y + x = 1 and x*y < 3"


def written(text: str) -> Any:
    return formula_to_json(convert(read(text), RING))


def payload(matrix: str, answer: str, *solved: list[str], **other: Any) -> dict[str, Any]:
    given = {"order": list(RING.names), "variables": [s[0] for s in solved], "solved": list(solved)}
    return {**given, "matrix": written(matrix), "answer": written(answer), **other}


X, Y = ["x", "-a + 2*x"], ["y", "x + y - 1"]
LAST = ["y", "a + 2*y - 2"]
ANSWER = "a > 2*b and a*(2 - a) < 12"


@pytest.mark.parametrize(
    ("matrix", "answer", "solved"),
    [
        (MATRIX, ANSWER, (X, LAST)),
        (MATRIX, "a*(2 - a) < 12 and a > 2*b", (X, LAST)),  # in any order
        (MATRIX, ANSWER, (Y, X)),
        ("x - a = 0 and b = 0 and y = 0 and x^3 < 0", "b = 0 and a^3 < 0", (["x", "-a + x"], ["y", "y"])),
        ("3*x + a = 0 and x^3 < b and y = 0", "-a^3 < 27*b", (["x", "a + 3*x"], ["y", "y"])),
        ("2*a - 3*x = 0 and x < b and y = 0", "2*a < 3*b", (["x", "-2*a + 3*x"], ["y", "y"])),
    ],
)
def test_what_the_substitutions_give(matrix: str, answer: str, solved: Any) -> None:
    check_substitution(payload(matrix, answer, *solved))


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        (payload(MATRIX, "a > 2*b", X, LAST), "not what the substitutions give"),
        (payload(MATRIX, "a >= 2*b and a*(2 - a) < 12", X, LAST), "not what the substitutions give"),
        (payload(MATRIX, "a < 2*b and a*(2 - a) < 12", X, LAST), "not what the substitutions give"),
        (payload(MATRIX, "false", X, LAST), "not what the substitutions give"),
        (payload(MATRIX, ANSWER, X, Y), "not a conjunct here"),
        (payload(MATRIX, ANSWER, X, LAST, variables=["y", "x"]), "in its order"),
        (payload(MATRIX, ANSWER, X, LAST, solved=[X]), "for each variable of the block"),
        (payload(MATRIX, ANSWER, X, LAST, solved=[X, LAST, LAST]), "for each variable of the block"),
        (payload(MATRIX, ANSWER, X, LAST, solved=[[*X, 1], LAST]), "expected .variable, equation"),
        (payload(MATRIX, ANSWER, X, LAST, solved=[[*X, 1], X, LAST]), "expected .variable, equation"),
        (payload("x = a and y = 0 and b = root(1, b^2 - x)", "true", ["x", "-a + x"], ["y", "y"]), "into root atoms"),
        (payload(MATRIX, ANSWER, X, LAST, order=["a", "b", "x", "y", "y"]), "listed twice"),
        (payload(MATRIX, ANSWER, X, LAST, order=["a", "b", "x", "y", "z"]), "the variables of the formula"),
        (payload("a*x = b and y = 0", "true", ["x", "a*x - b"], ["y", "y"]), "a number as its coefficient"),
        (payload("x^2 = b and y = 0 and a = 0", "true", ["x", "x^2 - b"], ["y", "y"]), "linear in the variable"),
        (payload(MATRIX, "y < a", X), "not what the substitutions give"),
        (payload("(x = a or x = b) and y = 0", "true", ["x", "-a + x"], ["y", "y"]), "not a conjunct"),
        (payload("x = a and y = 0 and b = 0", "x = a and b = 0", ["x", "-a + x"], ["y", "y"]), "a quantified variable"),
    ],
)
def test_what_is_refused(given: dict[str, Any], reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        check_substitution(given)

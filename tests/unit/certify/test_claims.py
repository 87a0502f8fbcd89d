"""What certificates claim, in words, and whether that is about a question."""

from __future__ import annotations

from typing import Any

import pytest

from qe.certify.claims import claim_of, is_about
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.io.text import read
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import formula_to_json
from tests.certificates.producing import cell_table


def witness(text: str, *values: str) -> Certificate:
    names = ("x", "y")
    matrix: Any = formula_to_json(convert(read(text), Ring.of(names)))
    return Certificate(Kind.WITNESS, {"order": list(names), "matrix": matrix, "values": list(values)})


def substitution() -> Certificate:
    ring = Ring.of(("a", "x"))
    body, answer = (formula_to_json(convert(read(t), ring)) for t in ("x = a and x > 1", "a > 1"))
    return Certificate(
        Kind.SUBSTITUTION,
        {"order": ["a", "x"], "variables": ["x"], "matrix": body, "solved": [["x", "-a + x"]], "answer": answer},
    )


def test_a_witness_claims_a_true_sentence() -> None:
    given = witness("x > 0 and y = x", "1", "1")
    found = claim_of(given)
    assert found.answer == TRUE and found.words[-1] == "by numbers for the variables"
    assert found.words[0].startswith("the sentence  ex x, y. ") and found.words[1] == "is true"
    assert is_about(given, read("ex x, y. x > 0 and y = x")) == TRUE
    assert is_about(given, read("ex u, v. v = u and u > 0")) == TRUE  # other names, another order
    assert is_about(given, read("all x, y. x <= 0 or y /= x")) == FALSE  # the negation
    assert is_about(given, read("ex x, y. x >= 0 and y = x")) is None


def test_a_substitution_claims_an_equivalence() -> None:
    found = claim_of(substitution())
    assert found.words == (
        "the formula  ex x. a - x = 0 and x - 1 > 0",
        "is equivalent to  a - 1 > 0, for all real values of a",
    )
    about = is_about(substitution(), read("ex x. x = a and x > 1"))
    assert isinstance(about, Formula) and str(about) == "a - 1 > 0"


def test_tables() -> None:
    plain = cell_table("x^2 + y^2 < 1", "x y")
    # nine: the two sectors of x beyond the circle are not divided
    assert claim_of(plain).words == ("truth values of  x^2 + y^2 - 1 < 0  on 9 cells",)
    closed = cell_table("x^2 + y^2 < 1", "x y", "EE")
    assert claim_of(closed).answer == TRUE and "by a cylindrical algebraic decomposition" in claim_of(closed).words
    assert is_about(closed, read("ex x, y. x^2 + y^2 < 1")) == TRUE
    assert is_about(closed, read("ex x, y. x^2 + y^2 < 2")) is None


def test_a_region_claims_no_equivalence() -> None:
    described = cell_table("x^2 + y^2 < 1", "x y")
    assert claim_of(described).answer is None
    assert is_about(described, read("x^2 + y^2 < 1")) is None


def test_bundles() -> None:
    one, other = witness("x > 0 and y = x", "1", "1"), substitution()
    bundle = Certificate.bundle([("first", one), ("second", other)])
    assert claim_of(bundle).words[0] == "2 claims" and claim_of(bundle).words[1].startswith("first: the sentence")
    assert is_about(bundle, read("ex x. x = a and x > 1")) is not None
    assert is_about(bundle, read("ex x. x = a")) is None


@pytest.mark.parametrize(
    ("count", "said"), [(0, "no real solution"), (1, "exactly 1 real solution"), (2, "exactly 2 real solutions")]
)
def test_solutions(count: int, said: str) -> None:
    payload: Any = {
        "order": ["x"],
        "equations": ["x^2 - 2"],
        "conditions": [["x", ">"]],
        "weights": [1],
        "form": [1],
        "solutions": [{}] * count,
    }
    found = claim_of(Certificate(Kind.SOLUTIONS, payload))
    assert found.words[:2] == ("the system  x^2 - 2 = 0 and x > 0", f"has {said}")
    assert found.answer == (TRUE if count else FALSE) and str(found.question) == "ex x. x^2 - 2 = 0 and x > 0"

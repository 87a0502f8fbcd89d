"""Points that satisfy a formula: rational and algebraic coordinates, signs decided exactly."""

from __future__ import annotations

from typing import Any

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.kernel.witness import check_witness
from qe.proof.entry import formula_to_json


def payload(text: str, *values: Any, order: str = "xy") -> dict[str, Any]:
    matrix = formula_to_json(convert(read(text), Ring.of(tuple(order))))
    return {"order": list(order), "matrix": matrix, "values": list(values)}


def root(polynomial: str, low: str, high: str) -> dict[str, Any]:
    return {"polynomial": polynomial, "interval": [low, high]}


ROOT = root("x^2 - 2", "1", "2")
OTHER = root("y^2 - 3", "-2", "-1")


@pytest.mark.parametrize(
    ("text", "values", "holds"),
    [
        ("x^2 + y^2 = 1", ("3/5", "-4/5"), True),
        ("x^2 + y^2 < 1", ("3/5", "-4/5"), False),
        ("x > y", ("-1/2", "-3/5"), True),
        ("x < y", ("-1/2", "-3/5"), False),
        ("x^2*y = 2*y", (ROOT, "7"), True),
        ("x^2*y /= 2*y", (ROOT, "7"), False),
        ("x*y < -12/5 and x*y > -5/2", (ROOT, OTHER), True),
        ("x*y >= -12/5", (ROOT, OTHER), False),
        ("x^2*y^2 = 6", (ROOT, OTHER), True),
        ("x > 1 and not y > 0 or x > 100", (ROOT, "0"), True),
        ("(x > 5 or y > 5) and x > 1", (ROOT, "0"), False),
        ("not (x > 0 and y > 0)", (ROOT, "0"), True),
        ("not (x > 0 and y >= 0)", (ROOT, "0"), False),
        ("true", (ROOT, "0"), True),
        ("false", (ROOT, "0"), False),
        ("x*y = 0 or y > x", ("0", ROOT | {"polynomial": "y^2 - 2"}), True),
    ],
)
def test_what_a_point_satisfies(text: str, values: Any, holds: bool) -> None:
    if holds:
        check_witness(payload(text, *values))
    else:
        with pytest.raises(CertificateRejected, match="do not satisfy"):
            check_witness(payload(text, *values))


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        (root("x^2 - 2", "-2", "2"), "exactly one root"),
        (root("x^2 - 2", "2", "3"), "exactly one root"),
        (root("x^2 - 4", "2", "3"), "exactly one root"),
        (root("x^2 - 4", "1", "2"), "exactly one root"),
        (root("x^2 - 2", "2", "1"), "two ascending ends"),
        (root("x^2 - 2", "1", "1"), "two ascending ends"),
        ({"polynomial": "x^2 - 2", "interval": ["1"]}, "two ascending ends"),
        (root("y^2 - 2", "1", "2"), "a polynomial in x"),
        (root("1", "1", "2"), "a polynomial in x"),
        (root("x*y - 2", "1", "2"), "a polynomial in x"),
        ("0.5", "a rational number"),
    ],
)
def test_what_is_no_number(value: Any, reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        check_witness(payload("x > 0", value, "1"))


def test_a_double_root_is_one_root_without_a_change_of_sign() -> None:
    check_witness(payload("x = 1", root("x^2 - 2*x + 1", "0", "2"), "0"))


def test_one_value_for_each_variable() -> None:
    with pytest.raises(CertificateRejected, match="expected 2 values"):
        check_witness(payload("x > 0", "1"))
    with pytest.raises(CertificateRejected, match="expected 2 values"):
        check_witness(payload("x > 0", "1", "1", "1"))
    twice = {**payload("x > 0", "1", "1"), "order": ["x", "x"]}
    with pytest.raises(CertificateRejected, match="listed twice"):
        check_witness(twice)


def test_quantifiers_and_root_atoms_are_no_matrix() -> None:
    with pytest.raises(CertificateRejected):
        check_witness({"order": ["x"], "matrix": ["ex", ["y"], True], "values": ["1"]})

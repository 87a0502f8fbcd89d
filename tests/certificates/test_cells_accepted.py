"""Certificates of correct decompositions are accepted, in memory and after a trip through JSON."""

from __future__ import annotations

import pytest

import qe.certify.verify as checker
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.options import Projection
from qe.proof.certificate import Certificate
from tests.certificates.producing import cell_table, table_in

THREE_BALLS = (
    "x^2 + y^2 + z^2 <= {r} and (x - {a})^2 + (y - {b})^2 + (z - {c})^2 <= {r} "
    "and (x - {d})^2 + (y - {e})^2 + (z - {f})^2 <= {r}"
)

FREE = {
    "lens": ("x^2 + y^2 <= 4 and (x - 1)^2 + y^2 <= 4", "x y"),
    "identical discs": ("x^2 + y^2 <= 4 and 2*x^2 + 2*y^2 <= 8", "x y"),
    "tangent balls": ("x^2 + y^2 + z^2 <= 1 and (x - 2)^2 + y^2 + z^2 <= 1", "x y z"),
    "balls that meet in a circle": ("x^2 + y^2 + z^2 = 4 and (x - 1)^2 + y^2 + z^2 = 4", "x y z"),
    "empty": ("x^2 + y^2 <= 1 and x > 1", "x y"),
    "no condition": ("true", "x y"),
    "points": ("x^2 + y^2 = 1 and y = x", "x y"),
    "node of a cubic": ("x^3 + y^3 - 3*x*y = 0 and x^2 + y^2 <= 1", "x y"),
    "cusp": ("x^2 - y^3 = 0", "x y"),
    "even contact": ("(y - x^2)^2 - (x - 1)^4*y >= 0", "x y"),
    "nullified at one point": ("x^2*z + y^2*z^3 - x*y = 0 and z < 1", "x y z"),
    "nullified on lines": ("x*z^2 + y*z - y + z = 0 and z > 1", "x y z"),
    "Whitney umbrella": ("x^2 - y^2*z = 0 and z < 2", "z x y"),
    "tower": ("x^3 = 2 and y^3 = x*y + 1 and z^2 <= y*x", "x y z"),
    "cubic over algebraic points": ("x^2 = 2 and y^4 - 3*x*y^2 + y <= x - 1", "x y"),
    "double roots over algebraic points": ("x^2 = 2 and y^4 - 2*x*y^2 + 2 <= 0", "x y"),
}

QUANTIFIED = {
    "quadratic": ("x^2 + b*x + c = 0", "b c x", "..E", None),
    "general quadratic": ("a*x^2 + b*x + c = 0", "a b c x", "...E", None),
    "quartic": ("x^4 + p*x^2 + q*x + r >= 0", "p q r x", "...A", None),
    "every real has a cube root": ("y^3 = x", "x y", "AE", True),
    "not every real has a square root": ("y^2 = x", "x y", "AE", False),
    "a hidden point of nullification": ("x = 0 and x*z + y - 1 = 0", "x y z", "EEE", True),
    "alternation": ("x^2 + y^2 <= 1 or z > y", "x z y", "EAE", True),
}


@pytest.mark.parametrize("projection", Projection)
@pytest.mark.parametrize("name", FREE)
def test_tables_over_free_variables(name: str, projection: Projection) -> None:
    certificate = cell_table(*FREE[name], projection=projection)
    assert checker.verify(certificate) == checker.Verdict(True)
    again = Certificate.from_json(certificate.to_json())
    assert again == certificate
    assert checker.verify(again).accepted


@pytest.mark.parametrize("projection", Projection)
@pytest.mark.parametrize("name", QUANTIFIED)
def test_quantified_tables(name: str, projection: Projection) -> None:
    text, order, quantifiers, truth = QUANTIFIED[name]
    certificate = cell_table(text, order, quantifiers, projection)
    assert str(checker.verify(certificate)) == "accepted"
    assert checker.verify_json(certificate.to_json()).accepted
    assert table_in(certificate).root.truth is truth


@pytest.mark.parametrize("numbers", [(-1, 3, 3, 1, 3, 3, 27), (0, 3, 1, 2, 2, 3, 22), (-1, 1, 0, 1, 1, 0, 2)])
def test_three_balls(numbers: tuple[int, ...]) -> None:
    text = THREE_BALLS.format(**dict(zip("abcdefr", numbers, strict=True)))
    assert str(checker.verify(cell_table(text, "x y z"))) == "accepted"


def test_the_answer_is_compared_on_every_cell() -> None:
    table = table_in(cell_table("x^2 + b*x + c = 0", "b c x", "..E"))
    for text, accepted in [("b^2 - 4*c >= 0", True), ("b^2 - 4*c > 0", False), ("true", False), ("b >= 0", False)]:
        answer = _over(text, ("b", "c", "x"))
        verdict = checker.verify(Certificate.cells(table, answer))
        assert verdict.accepted is accepted
        assert accepted or verdict.step == "payload.steps[0].after"


def test_an_answer_with_roots() -> None:
    table = table_in(cell_table("x^2 + y^2 <= 4 and y >= 0", "x y"))
    for k, relation, accepted in [(-1, "<=", True), (1, "<=", False), (2, "<=", False), (-1, "<", False)]:
        answer = _over(f"y >= 0 and y {relation} root({k}, x^2 + y^2 - 4, y)", ("x", "y"))
        assert checker.verify(Certificate.cells(table, answer)).accepted is accepted
    table = table_in(cell_table("x^2 + y^2 < 4 and y > 0", "x y"))
    for k, relation, accepted in [(2, "<", True), (1, "<", False), (2, "<=", False), (3, "<", False)]:
        answer = _over(f"y > 0 and y {relation} root({k}, x^2 + y^2 - 4, y)", ("x", "y"))
        assert checker.verify(Certificate.cells(table, answer)).accepted is accepted


def _over(text: str, names: tuple[str, ...]) -> Formula:
    return convert(read(text), Ring.of(names))


def test_a_bundle_names_the_member_that_fails() -> None:
    good = cell_table("x^2 <= 2", "x")
    table = table_in(cell_table("x^2 <= 3", "x"))
    bad = Certificate.cells(table, _over("x^2 - 3 < 0", ("x",)))
    assert checker.verify(Certificate.bundle([("one", good), ("two", good)])).accepted
    verdict = checker.verify_json(Certificate.bundle([("one", good), ("two", bad)]).to_json())
    assert not verdict.accepted
    assert verdict.step == "certificates[1].payload.steps[0].after"
    assert verdict.reason.startswith("two: ")

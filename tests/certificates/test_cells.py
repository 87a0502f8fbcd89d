"""Certificates of decompositions: accepted where they are correct; altered ones are rejected with the entry named."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import pytest

import qe.certify.verify as checker
from qe.certify.verify import verify, verify_json
from qe.decomposition.decompose import decompose
from qe.decomposition.operators.operator import Operator
from qe.decomposition.operators.table import OPERATORS
from qe.errors import InputError
from qe.exact.from_projection import discriminant
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.formula.syntax import Formula
from qe.io.text import read
from qe.options import Budget, Projection
from qe.proof.certificate import Certificate
from tests.certificates.mutation import Path, at, leaves, lists, other_numbers, other_signs, replaced, without
from tests.certificates.producing import TABLE, cell_table, table_in

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


LENS = ("x^2 + y^2 <= 4 and (x - 1)^2 + y^2 <= 4", "x y")
SOLID = ("x^2 + y^2 + z^2 <= 4", "x y z")
CUSP = ("x^2 - y^3 = 0 and y < 2", "x y")
QUADRATIC = ("x^2 + b*x + c = 0", "b c x", "..E")
SENTENCE = ("x^2 + y^2 < 4 -> y < 2", "x y", "AA")
CONSTRAINED = ("y^2 = x and y^3 > 1", "x y", ".E")
TWO_CONSTRAINTS = ("x^2 + y^2 = 4 and x*y = 1 and y > x + 5", "x y", "EE")
TWO_LEVELS = ("y^2 = x and y*z = 1", "x y z", ".EE")
IMPLICATION = ("x^2 + y^2 /= 4 or x*y /= 1 or y < x + 5", "x y", "AA")
CASES = {
    "lens": LENS,
    "solid": SOLID,
    "cusp": CUSP,
    "quadratic": QUADRATIC,
    "sentence": SENTENCE,
    "constrained": CONSTRAINED,
    "two constraints": TWO_CONSTRAINTS,
    "two levels": TWO_LEVELS,
    "implication": IMPLICATION,
}


def _whole(case: tuple[str, ...]) -> Any:
    return json.loads(cell_table(*case).to_json())


def _alternatives(path: Path, value: Any) -> list[Any]:
    """Values that make the entry wrong (not merely different)."""
    key = path[-1] if isinstance(path[-1], str) else path[-2]
    if key == "signs":
        return list(other_signs(value))
    if key == "sectors":
        return list(other_numbers(value))
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1, 10**9]
    if value is None:
        return [True, False, "null", 0]
    return [f"{value}1", value[:-1], value[1:], ""]


def _harmless(whole: Any, path: Path, value: Any) -> bool:
    """Whether the altered certificate is still a true one.

    The outermost sector samples may be anything beyond the outermost sections; the name of the operator may
    change where the lists are closed under both; a cell that its siblings make superfluous may have any truth
    value that its own signs give it.
    """
    if path[-2:-1] == ("sectors",):
        first, last = path[-1] == 0, path[-1] == len(at(whole, path[:-1])) - 1
        return (first and str(value).startswith("-")) or (last and not str(value).startswith("-"))
    if path[-1] == "truth":
        return at(whole, path) is None and isinstance(value, bool) and _table(whole)["quantifiers"][-1] != ""
    return path[-1] == "projection" or path == ("version",)


def _table(whole: Any) -> Any:
    return whole["payload"]["steps"][0]["evidence"]["cells"]


@pytest.mark.parametrize("name", CASES)
def test_every_altered_entry_is_rejected(name: str) -> None:
    """Every entry is altered once, entries of one kind in different ways."""
    _rejected(name, one=True)


@pytest.mark.deep
@pytest.mark.parametrize("name", CASES)
def test_every_entry_altered_in_every_way_is_rejected(name: str) -> None:
    _rejected(name, one=False)


def _rejected(name: str, *, one: bool) -> None:
    whole = _whole(CASES[name])
    tried = 0
    for place, (path, value) in enumerate(leaves(whole)):
        if path[0] == "digest":
            continue
        others = [o for o in _alternatives(path, value) if o != value or type(o) is not type(value)]
        wrong = [o for o in others if not _harmless(whole, path, o)]
        for other in [wrong[place % len(wrong)]] if one and wrong else wrong:
            verdict = verify_json(replaced(whole, path, other))
            assert not verdict.accepted, (path, value, other)
            assert verdict.step or path[-1] == "rule", (path, value, other)  # an unknown rule proves nothing
            assert verdict.step != "digest", (path, value, other)
            tried += 1
    assert tried > (20 if one else 50)


@pytest.mark.parametrize("name", CASES)
def test_every_dropped_entry_is_rejected(name: str) -> None:
    whole = _whole(CASES[name])
    for path, content in lists(whole):
        for index in range(len(content) if path != ("payload", "steps") else 0):  # F <-> F needs none
            verdict = verify_json(without(whole, path, index))
            assert not verdict.accepted, (path, index)
            assert verdict.step not in ("", "digest")


def test_with_the_old_digest_nothing_passes() -> None:
    """It is compared before anything else, so a part of what each entry may become is enough."""
    whole = _whole(LENS)
    for path, value in leaves(whole):
        for other in [one for one in _alternatives(path, value) if one != value][:1]:
            assert not verify_json(replaced(whole, path, other, signed=False)).accepted, (path, other)
    digest = replaced(whole, ("digest",), "0" * 64, signed=False)
    assert verify_json(digest).step == "digest"


def test_a_harmless_change_is_caught_by_the_digest_alone() -> None:
    whole = _whole(("x^2 <= 2", "x"))
    path: Path = (*TABLE, "root", "stack", "sectors", 0)
    assert verify_json(replaced(whole, path, "-1000")).accepted
    assert verify_json(replaced(whole, path, "-1000", signed=False)).step == "digest"


ENTRIES = {
    (*TABLE, "matrix", 1, 1): "x^2 + y^2 - 5",
    (*TABLE, "matrix", 1, 2): "<",
    (*TABLE, "factors", 0, 0): "x - 1",
    (*TABLE, "factors", 1, 0): "x^2 + y^2 - 5",
    (*TABLE, "quantifiers", 0): "E",
    (*TABLE, "order", 0): "t",
    (*TABLE, "projection"): "collins",
    ("payload", "answer"): ["atom", "x", ">"],
}


@pytest.mark.parametrize("path", ENTRIES, ids=str)
def test_well_formed_but_wrong_entries(path: Path) -> None:
    verdict = verify_json(replaced(_whole(LENS), path, ENTRIES[path]))
    assert not verdict.accepted
    assert verdict.step.startswith("payload")


def test_the_entry_is_named() -> None:
    whole = _whole(LENS)
    path: Path = (*TABLE, "root", "stack", "cells", 2, "signs")
    verdict = verify_json(replaced(whole, path, "?"))
    assert verdict.step == "payload.steps[0].evidence.cells.root.stack.cells[2].signs"


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "3", '{"format": "other"}', '{"a": 1, "a": 2}', '{"x": 1.5}', '{"x": NaN}', "[" * 100_000],
)
def test_text_that_is_no_certificate(text: str) -> None:
    with pytest.raises(InputError):
        Certificate.from_json(text)
    assert not verify_json(text).accepted


def test_another_version_is_refused() -> None:
    text = replaced(_whole(LENS), ("version",), 4)
    with pytest.raises(InputError, match="version 4"):
        Certificate.from_json(text)


def test_an_operator_without_a_theorem_of_the_checker_is_refused() -> None:
    """McCallum's tables are recorded under the theorem that proves them, never under his name."""
    made = decompose(read(LENS[0]), ("x", "y"), ("", ""), budget=Budget(60), operator=OPERATORS[Projection.MCCALLUM])
    assert made.operator.name is Projection.MCCALLUM and made.table.projection is Projection.BROWN_MCCALLUM
    verdict = verify_json(replaced(_whole(LENS), (*TABLE, "projection"), "mccallum"))
    assert not verdict.accepted and verdict.step == "payload.steps[0].evidence.cells.projection"


def without_discriminants(operator: Operator) -> Operator:
    def of_one(f: Poly, variable: int) -> Iterator[Poly]:
        yield from (p for p in operator.of_one(f, variable) if p != discriminant(f, variable))

    return replace(operator, of_one=of_one)


def without_resultants(operator: Operator) -> Operator:
    return replace(operator, of_two=lambda f, g, variable: iter(()))


@pytest.mark.parametrize("part", [without_discriminants, without_resultants])
@pytest.mark.parametrize("projection", Projection)
def test_a_projection_without_a_part_is_rejected(part: Callable[[Operator], Operator], projection: Projection) -> None:
    names, matrix = ("a", "b", "x"), read("x^3 + a*x + b < 0 and x^2 - a > b")
    right = decompose(matrix, names, ("", "", "E"), budget=Budget(60), operator=OPERATORS[projection]).table
    assert verify(Certificate.cells(right)).accepted
    wrong = decompose(matrix, names, ("", "", "E"), budget=Budget(60), operator=part(OPERATORS[projection])).table
    verdict = verify(Certificate.cells(wrong))
    assert not verdict.accepted
    assert verdict.step

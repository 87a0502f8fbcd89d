"""Cell tables as steps: whether the prefix and the matrix of a table are a prenex form of the formula."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import pytest

import qe
from qe.api.input import read_formula
from qe.elimination.cad import certificate_for
from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj
from qe.formula.syntax import FALSE, TRUE, And, Formula
from qe.io.text import read
from qe.kernel.table import is_prenex_form
from qe.options import Budget, Options, Projection
from qe.proof.cells import Cell, CellTable
from qe.proof.certificate import Certificate, written
from tests.certificates.producing import cell_table
from tests.unit.certify.claims import formula, objection


def table(matrix: str, order: str, quantifiers: str) -> CellTable:
    names = tuple(order.split())
    kinds = tuple(q.replace(".", "") for q in quantifiers)
    matrix_: Formula = convert(read_formula(matrix), Ring.of(names))
    return CellTable(names, kinds, matrix_, Projection.LAZARD, tuple(() for _ in names), Cell("", None))


@pytest.mark.parametrize(
    ("text", "matrix", "order", "quantifiers", "right"),
    [
        ("ex x. x > a", "x > a", "a x", ".E", True),
        ("all x. x > a", "x > a", "a x", ".E", False),
        ("ex x. x > a", "x >= a", "a x", ".E", False),
        ("ex x. x > a", "x > a", "a x", "..", False),
        ("ex x. x > a", "x > a", "a x", "EE", False),  # a is free
        ("ex x. all y. x*y > a", "x*y > a", "a x y", ".EA", True),
        ("ex x. all y. x*y > a", "x*y > a", "a y x", ".AE", False),
        ("ex x, y. x*y > a", "x*y > a", "a y x", ".EE", True),
        ("(ex x. x > a) and (all y. y^2 > a)", "x > a and y^2 > a", "a x y", ".EA", True),
        ("(ex x. x > a) and (all y. y^2 > a)", "y^2 > a and x > a", "a y x", ".AE", True),
        ("(ex x. x > a) or (all y. y^2 > a)", "x > a and y^2 > a", "a x y", ".EA", False),
        ("(ex x. x > a) and (all x. x^2 > a)", "x > a and x^2 > a", "a x", ".E", False),  # bound twice
        ("(ex x. x > a) and (ex x. x < a)", "x > a and x < a", "a x", ".E", False),  # no value need do for both
        ("x > a and (ex x. x^2 > a)", "x > a and x^2 > a", "a x", ".E", False),  # free and bound
        ("not (ex x. x > a)", "x <= a", "a x", ".A", True),
        ("not (ex x. x > a)", "x <= a", "a x", ".E", False),
        ("ex x. (all y. y > x) and (ex z. z < x)", "y > x and z < x", "x z y", "EEA", True),
        ("ex x. (all y. y > x) and (ex z. z < x)", "y > x and z < x", "z x y", "EEA", True),  # neighbours of one kind
        ("all z. ex x. all y. z*x > y", "z*x > y", "x z y", "EAA", False),
        ("all z. ex x. all y. z*x > y", "z*x > y", "z x y", "AEA", True),
        ("all z. ex x. all y. z*x > y", "z*x > y", "z y x", "AAE", False),
        ("ex x. x > a", "x > a", "a x y", ".EA", True),  # a variable that does not occur
    ],
)
def test_prenex_forms(text: str, matrix: str, order: str, quantifiers: str, right: bool) -> None:
    assert is_prenex_form(formula(text), table(matrix, order, quantifiers)) is right


def test_constants_and_a_ring_of_just_the_variables() -> None:
    asked, claimed = convert(read_formula("ex x. x > a"), Ring.of(("a", "x"))), table("x > a", "a x", ".E")
    assert is_prenex_form(asked, claimed)
    for constant, other in ((TRUE, FALSE), (FALSE, TRUE)):
        assert is_prenex_form(constant, table(str(constant), "a x", ".E"))
        assert not is_prenex_form(constant, table(str(other), "a x", ".E"))
        assert not is_prenex_form(constant, claimed) and not is_prenex_form(asked, table(str(constant), "a x", ".E"))


@lru_cache
def evidence(text: str, order: str, quantifiers: str) -> Any:
    return cell_table(text, order, quantifiers).evidence_for("cells")


SQUARE = ("x^2 < a", "a x", ".E")


@pytest.mark.parametrize(
    ("before", "after", "table", "reason"),
    [
        ("ex x. x^2 < a", "a > 0", SQUARE, ""),
        ("ex x. not (x^2 >= a)", "not (a <= 0)", SQUARE, ""),
        ("ex x. x^2 < a", "a >= 0", SQUARE, "step.after: differs from the truth value"),
        ("ex x. x^2 < a", "a > 1", SQUARE, "not a product of listed factors"),
        ("ex x. x^2 < a", "ex x. x^2 < a", SQUARE, ""),  # no more than that the table is right
        ("ex x. x^2 < a", "ex x. x^2 + 0 < a and 1 > 0 and x^2 - a < 1", SQUARE, "an answer without quantifiers"),
        ("ex x. x^2 <= a", "a > 0", SQUARE, "another formula"),
        ("all x. x^2 < a", "a > 0", SQUARE, "another formula"),
        ("ex x. x^2 < b", "b > 0", SQUARE, "other variables"),
        ("ex x. x^2 < a", "b > 0", SQUARE, "other variables"),
        ("ex x. x^2 < a", "a > 0", ("x^2 < u", "u x", ".E"), "other variables"),
    ],
)
def test_a_table_is_about_the_step(before: str, after: str, table: Any, reason: str) -> None:
    for rule in ("cells", "shorter"):
        found = objection(rule, before, after, evidence(*table))
        assert reason in found and bool(found) is bool(reason), found


@pytest.mark.parametrize(
    ("after", "given", "accepted"),
    [
        ("true", "a > 0", True),
        ("false", "a <= 0", True),
        ("true", "a > 0 and b > 3", True),  # of which the table knows nothing
        ("true", "b > 3", False),
        ("true", "a >= 0", False),
        ("false", "a > 0", False),
        ("a /= 0", "a >= 0", True),
        ("a /= 0", "true", False),
    ],
)
def test_a_table_where_something_holds(after: str, given: str, accepted: bool) -> None:
    found = objection("cells", "ex x. x^2 < a", after, evidence(*SQUARE), given)
    assert (found == "") is accepted, found


def test_a_table_below_what_is_known_is_no_region() -> None:
    """Cells on which x > 1 is false are open there: the step proves less than the table seems to say."""
    ring = Ring.of(("x", "y"))
    disc, beyond = (convert(read(text), ring) for text in ("x^2 + y^2 < 4 or y > 5", "x > 1"))
    made = certificate_for(disc, disj((disc, conj((beyond, disc)))), Options(order=ring.names), Budget(20))
    assert made is not None
    table = made.evidence_for("cells")["cells"]
    for cell in table["root"]["stack"]["cells"]:
        if cell["signs"][table["factors"][0].index("x - 1")] in "-0":
            cell.pop("stack")
    whole = conj((beyond, disc))
    assert isinstance(whole, And)
    step = written("cells", [whole.args.index(disc)], disc, disc, [beyond], {"cells": table})
    content = Certificate.derivation(ring.names, whole, [step], whole).to_json()
    assert qe.verify(Certificate.from_json(content)).accepted and Certificate.from_json(content).single_step == {}
    with pytest.raises(qe.InputError, match="a region in JSON expected"):
        qe.Region.from_json(content)


def test_facts_with_quantifiers_are_no_hindrance() -> None:
    """Their bound variables are no variables of the table: a right step ended in an internal error."""
    ring = Ring.of(("a", "x", "y"))
    fact, before, after = (convert(read(text), ring) for text in ("ex y. y^4 = a + 1", "ex x. x^2 = a", "a >= 0"))
    made = certificate_for(before, after, Options(), Budget(20))
    assert made is not None
    whole = conj((fact, before))
    assert isinstance(whole, And)
    step = written("cells", [whole.args.index(before)], before, after, [fact], made.single_step["evidence"])
    content = Certificate.derivation(ring.names, whole, [step], conj((fact, after))).to_json()
    assert qe.verify(Certificate.from_json(content)).accepted
    assert "without quantifiers" in objection("cells", "ex x. x^2 = a", "ex y. y^2 = a", made.single_step["evidence"])

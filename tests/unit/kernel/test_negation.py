"""Negations go inside by De Morgan's laws, and nothing else happens."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given

from qe.formula.evaluate import holds_at
from qe.formula.syntax import And, Atom, Formula, Not, Or, RootAtom
from qe.formula.traverse import subformulas
from qe.kernel.negation import negation, normal
from tests.strategies import NAMES, formulas, points
from tests.unit.certify.claims import formula, objection


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("not (a > 0 and b = 0)", "a <= 0 or b /= 0"),
        ("not (a > 0 or b = 0)", "a <= 0 and b /= 0"),
        ("not (ex x. x > a)", "all x. x <= a"),
        ("not (all x. x > a or b < 0)", "ex x. x <= a and b >= 0"),
        ("not (a > root(1, a^2 - b) and b > 0)", "not (a > root(1, a^2 - b)) or b <= 0"),
    ],
)
def test_a_negation_pushed_inside(before: str, after: str) -> None:
    for rule in ("duality", "negation normal form"):
        assert objection(rule, before, after) == ""
        assert objection(rule, after, before) == ""


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("not (a > 0 and b = 0)", "a <= 0 and b /= 0"),
        ("not (a > 0 and b = 0)", "a < 0 or b /= 0"),
        ("not (ex x. x > a)", "ex x. x <= a"),
        ("not (ex x. x > a)", "all x. x > a"),
        ("not (a > root(1, a^2 - b) and b > 0)", "a <= root(1, a^2 - b) or b <= 0"),  # where there is no root
    ],
)
def test_other_formulas_are_no_negation_normal_form(before: str, after: str) -> None:
    assert "differ in more than negations" in objection("duality", before, after)


def test_quantifiers_change_with_an_odd_number_of_negations() -> None:
    some, every = formula("ex x. x > a"), formula("all x. x > a")
    assert (normal(some), normal(every)) == (some, every)
    assert negation(some) == formula("all x. x <= a")
    assert negation(every) == formula("ex x. x <= a")
    assert normal(Not(Not(every))) == every


def test_there_is_no_evidence_to_give() -> None:
    assert objection("duality", "a > 0", "a > 0", {"theory": 1})


XY = NAMES[:2]


@given(formulas(names=XY, root_atoms=True), points(XY))
def test_the_negation_has_the_other_truth_and_no_negation_but_before_root_atoms(
    formula: Formula, point: dict[str, Fraction]
) -> None:
    assert holds_at(negation(formula), point) is not holds_at(formula, point)
    assert holds_at(normal(formula), point) is holds_at(formula, point)
    for part in subformulas(negation(formula)):
        assert not isinstance(part, Not) or isinstance(part.arg, RootAtom)
        assert not isinstance(part, And | Or) or len(part.args) > 1
        assert not isinstance(part, Atom) or part.poly.variables

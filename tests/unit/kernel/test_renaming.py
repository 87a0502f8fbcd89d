"""Formulas that are the same up to the names of bound variables."""

from __future__ import annotations

import pytest

from qe.formula.syntax import And, Exists, ForAll, Formula
from qe.io.text import read
from qe.kernel.renaming import arranged, shape
from tests.unit.certify.claims import objection


def _beside(idle: type[Exists] | type[ForAll], first: str, *inside: str) -> Formula:
    """A conjunction with another one behind a quantifier that binds nothing."""
    whole = read(" and ".join((first, *inside)))
    assert isinstance(whole, And)
    return And((whole.args[0], idle(("z",), And(whole.args[1:]))))


@pytest.mark.parametrize("idle", [Exists, ForAll])
def test_what_an_idle_quantifier_held_apart_joins_its_neighbours(idle: type[Exists] | type[ForAll]) -> None:
    given = _beside(idle, "x > 0", "y > 0", "x*y > 1")
    assert shape(given) == shape(read("x > 0 and y > 0 and x*y > 1"))
    assert shape(given) != shape(read("x > 0 and (y > 0 or x*y > 1)"))


@pytest.mark.parametrize(
    ("before", "after", "right"),
    [
        ("ex x. x > a", "ex y. y > a", True),
        ("ex x, y. x < y + a", "ex y, x. y < x + a", True),
        ("ex x. all y. x*y > a", "ex z. all x. z*x > a", True),
        ("(ex x. x > a) and (ex x. x < b)", "(ex x. x > a) and (ex y. y < b)", True),
        ("ex x. x > a", "ex x. x > b", False),  # another free variable
        ("ex x. x > a", "ex x. x >= a", False),
        ("ex x. x > a", "all x. x > a", False),
        ("ex x. all y. x*y > a", "all y. ex x. x*y > a", False),
        ("ex x, y. x < y + a", "ex x, y. y < x + a", False),  # the two change places, and a keeps its own
        ("ex x. x > root(1, x^2 - a)", "ex y. y > root(1, y^2 - a)", True),
        ("ex x. x > root(1, x^2 - a)", "ex y. y > root(2, y^2 - a)", False),
        ("ex x. x > root(1, x^2 - a)", "ex y. y > root(1, y^2 - b)", False),
        (
            "ex x, y. all z. ex a, b. z^2 < x + y + a + b",
            "ex x, y. all z. ex a, b. b^2 < x + y + a + z",
            False,  # every bound variable has a number of its own
        ),
        ("x > 0", "y > 0", False),
        ("a > 0 and b > 0", "a > 0 or b > 0", False),
        ("not (a > 0 and b > 0)", "a > 0 and b > 0", False),
    ],
)
def test_only_names_of_bound_variables_may_differ(before: str, after: str, right: bool) -> None:
    assert (objection("renaming", before, after) == "") is right
    assert (objection("renaming", after, before) == "") is right
    assert objection("renaming", before, after, {"theory": {}})  # there is no evidence to give


def test_another_normal_sign_in_another_order_of_variables() -> None:
    """x - a and a - x are one polynomial and its negative by the name that is bound."""
    assert objection("renaming", "ex x. x - a > 0", "ex b. b - a > 0") == ""
    assert objection("renaming", "ex x. x - b > 0", "ex a. a - b > 0") == ""
    assert objection("renaming", "ex x. x - b > 0", "ex a. a - b < 0") != ""


def test_the_order_of_parts_matters_to_the_shape_alone() -> None:
    left, right = read("a > 0 and (ex x. x^2 < b)"), read("(ex y. y^2 < b) and a > 0")
    assert shape(left) != shape(right)
    assert arranged(left) == arranged(right)
    assert arranged(left) != arranged(read("(ex y. y^2 < a) and a > 0"))

"""Closure and interior of convex sets without quantifiers, of others by their definition."""

from __future__ import annotations

import qe
from qe.formula.syntax import Formula
from qe.formula.traverse import is_quantifier_free
from qe.io.text import read
from qe.options import Budget
from qe.regions.topology import boundary, closure, interior
from tests.tables import each


def found(operation: object, text: str) -> Formula:
    formula = read(text)
    return operation(formula, formula.free, Budget())  # type: ignore[operator,no-any-return]


@each(
    ("x^2 + y^2 < 1 and y >= 0", "x^2 + y^2 <= 1 and y >= 0", "x^2 + y^2 < 1 and y > 0"),
    ("x^2 + y^2 <= 1 and x + y > 1", "x^2 + y^2 <= 1 and x + y >= 1", "x^2 + y^2 < 1 and x + y > 1"),
    ("x = 1 and y < 2", "x = 1 and y <= 2", "false"),
    ("x^2 + y^2 < 1 and x >= 1", "false", "false"),
    ("x^2 <= 0 and y > 0", "x = 0 and y >= 0", "false"),
)
def test_convex_sets_by_other_relations(text: str, closed: str, opened: str) -> None:
    for operation, expected in ((closure, closed), (interior, opened)):
        answer = found(operation, text)
        assert is_quantifier_free(answer) and qe.equivalent(answer, expected)


@each(
    ("x^3 - x^2 > 0", "x >= 1", "x > 1"),
    ("x^2*(1 - x) >= 0 and x > 0", "0 <= x and x <= 1", "0 < x and x < 1"),
    ("x^3 - x^2 >= 0", "x >= 1 or x = 0", "x > 1"),
    ("x /= 0 and x <= 1", "x <= 1", "x < 1 and x /= 0"),
    ("x < 0 or x >= 1", "x <= 0 or x >= 1", "x < 0 or x > 1"),
)
def test_others_by_the_definition(text: str, closed: str, opened: str) -> None:
    assert qe.equivalent(found(closure, text), closed) and qe.equivalent(found(interior, text), opened)
    assert qe.equivalent(found(boundary, text), f"({closed}) and not ({opened})")

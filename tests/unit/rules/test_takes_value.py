"""Atoms that are met whatever the rest is: found only where they are, with a value to show for it."""

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.algebraic import RealAlgebraic
from qe.formula.syntax import TRUE
from qe.io.text import read
from qe.rules.lift import holds_at
from qe.rules.step import StepKind
from qe.rules.takes_value import TakesValue
from tests.property.prepare_support import prepared_with_rules
from tests.tables import each

ALONE = frozenset({StepKind.TAKES_VALUE})


def taken(text: str) -> bool:
    return prepared_with_rules(read(text), enabled=ALONE)[1] != []


@each(
    ("ex x. x^6 + a*x^5 + b*x^4 + c > 0", True),
    ("ex x. x^6 + a*x^5 + b*x^4 + c >= 0", True),
    ("ex x. x^6 + a*x^5 + b*x^4 + c < 0", False),
    ("ex x. -2*x^6 + a*x^5 + c <= 0", True),
    ("ex x. x^6 + a*x^5 + c = 0", False),
    ("ex x. x^6 + a*x^5 + c /= 0", True),
    ("ex x. x^7 + a*x^5 + b*x^4 + c = 0", True),
    ("ex x. x^7 + a*x^5 + b*x^4 + c <= 0 and b > 0", True),
    ("ex x. a*x^7 + x^5 + c = 0", False),
    ("ex x, y. x^7*y + x^5 + c = 0 and y > 0", True),
    ("ex x, y. x^7*y + x^5 + c = 0 and y >= 0", False),
    ("ex x, y. x^6*y + x^5 + c > 0 and y < 0", False),
    ("ex x. x^7 + a*x + 1 = 0 and x > b", False),
    ("ex x. (x^7 + a*x + 1 = 0 or b > 0) and c > 0", False),
    ("ex x. x^7 + a = 0 and ex y. y*x > 1", False),
    ("all x. x^6 + a*x^5 + b < 0", True),
)
def test_where_it_applies(text: str, expected: bool) -> None:
    assert taken(text) is expected


def test_high_degrees_are_immediate() -> None:
    assert qe.eliminate("ex x, y. x^3 + a*x + y^2 = 1 and y^3 + x = b").formula == TRUE
    assert str(qe.eliminate("ex x. x^9 + a*x^5 + b*x^4 + c*x + d = 0 and a > 0").formula) == "a > 0"
    assert qe.eliminate("ex x. x^6 + a*x^5 + b*x > c and x > d").formula == TRUE


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.integers(-5, 5), min_size=3, max_size=6),
    st.sampled_from(["=", "<", "<=", ">", ">=", "/="]),
    st.one_of(st.fractions(-3, 3, max_denominator=4), st.sampled_from([(-2, 0, 1), (1, -3, 0, 1)])),
)
def test_values_satisfy_the_atom(coefficients: list[int], relation: str, other: object) -> None:
    degree = len(coefficients)
    text = " + ".join(f"({c})*x^{k}*y^{degree - k}" for k, c in enumerate(coefficients))
    question = read(f"x^{degree} + {text} - 3 {relation} 0")
    if degree % 2 == 0 and relation in ("=", "<", "<="):
        return
    at = other if isinstance(other, Fraction) else RealAlgebraic.from_root(other, 1, 2)  # type: ignore[arg-type]
    value = TakesValue("x", question.poly, question.relation).value({"y": at})  # type: ignore[attr-defined]
    assert holds_at(question, {"x": value, "y": at})  # type: ignore[dict-item]


def test_witnesses_come_back() -> None:
    answer = qe.eliminate("ex x, y. x^5 + y*x - 1 = 0 and y^2 = 2 and y > 0")
    assert answer.witness is not None
    assert holds_at(read("x^5 + y*x - 1 = 0 and y^2 = 2 and y > 0"), answer.witness)  # type: ignore[arg-type]

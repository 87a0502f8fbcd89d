"""What was asked for takes part and nothing else; a check changes no answer; answers that are constant say so."""

from __future__ import annotations

import random

import pytest

from qe import Guarantee, Status, eliminate, equivalent
from qe.certify.claims import is_about
from qe.formula.syntax import FALSE, TRUE, Constant
from qe.kernel.renaming import is_same
from tests.differential.generate import Shape, random_formula
from tests.tables import each

CUBIC = "ex x. x^3 + a*x + b = 0 and x > 0"


@each("ex x. x^5 + a*x + b = 0 and x > 0", "ex x, y. x^4 + y^5 + x*y = 1 and x*y^3 + x > 2", "all x. x^4 + p*x + q > 0")
def test_substitution_asked_for_alone_was_finished_by_decomposition(text: str) -> None:
    answer = eliminate(text, method="vs")
    assert answer.status is Status.UNABLE and "substitution alone" in answer.reason
    assert "cad" not in answer.stats


def test_a_switch_from_substitution_to_decomposition_is_recorded() -> None:
    answer = eliminate("ex x, y. x + a*y > 0 and y^4 + b*x < c", without="roots")
    assert "vs" in answer.stats and "cad" in answer.stats
    assert "vs: y left for another method" in answer.stats["switches"]


@pytest.mark.parametrize(
    "text",
    [
        CUBIC,
        "ex x. a*x^2 + b*x + c = 0",
        "all x, y. a*x^2 + 2*b*x*y + c*y^2 + d > 0",
        "ex x, y. x^2 + y^2 < a and x*y > b",
        "all x. not (a*x^2 + b*x + 1 < 0)",
    ],
)
def test_a_check_changed_the_answer(text: str) -> None:
    plain, checked = eliminate(text), eliminate(text, check=True)
    assert str(checked.formula) == str(plain.formula)
    assert checked.guarantee is Guarantee.CHECKED


@pytest.mark.parametrize("seed", range(24))
def test_a_check_changes_no_answer(seed: int) -> None:
    """The property behind the symptom, with a certificate that claims the very formula that is returned."""
    formula = random_formula(random.Random(seed), (Shape(1, 1, 3, 3), Shape(2, 1, 2, 3), Shape(1, 2, 2, 3))[seed % 3])
    plain, checked = eliminate(formula), eliminate(formula, check=True)
    assert checked.formula == plain.formula
    assert checked.certificate is not None and checked.guarantee is Guarantee.CHECKED
    said = is_about(checked.certificate, formula)
    assert said is not None and is_same(said, plain.formula)


@each(
    ("x + y = 0 and x - y = 0 and x > 0", FALSE),
    ("x > 0 and y > x and z > y and z < 0", FALSE),
    ("a*b = 0 and c*d = 1 and a - b = 3 and c = d + 1 and d > 4", FALSE),
    ("x <= 0 or y <= x or z <= y or z >= 0", TRUE),
)
def test_formulas_without_solution_were_returned_as_they_stood(text: str, expected: Constant) -> None:
    assert eliminate(text).formula == expected
    assert eliminate(text, check=True).formula == expected


@pytest.mark.parametrize("seed", range(40))
def test_small_answers_are_constant_only_in_form(seed: int) -> None:
    """No quantifier-free formula that is cheap to decide comes back when it is equivalent to true or to false."""
    rng = random.Random(1000 + seed)
    formula = random_formula(rng, Shape(2, 0, 2, 4))
    found = eliminate(formula).formula
    if not isinstance(found, Constant):
        assert not equivalent(found, TRUE) and not equivalent(found, FALSE), str(found)

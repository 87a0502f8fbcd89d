"""Answers under assumptions: right where these hold, not longer than without, and their certificates say so."""

from __future__ import annotations

import random

import pytest

import qe
from qe.formula.assumed import claimed
from qe.formula.build import conj
from qe.formula.features import length
from qe.formula.syntax import TRUE, Formula
from qe.simplifier.simplify import simplify as standard
from tests.differential.generate import Shape, random_formula

CONDITIONS = (
    "a > 0",
    "a >= 0 and b > 0",
    "a < 0",
    "a /= 0",
    "a > 0 or b > 0",
    "a > 1 and b < -1",
    "a = 0",
    "b = 2*a",
    "a^2 + b^2 <= 1",
    "a > 0 and a < 0",
)
SHAPES = (Shape(1, 1, 3, 3), Shape(2, 1, 2, 2), Shape(2, 0, 2, 4), Shape(1, 1, 2, 4), Shape(2, 0, 3, 3))


def question(seed: int) -> Formula:
    """A random formula in a and b, with x bound or without a quantifier."""
    return random_formula(random.Random(seed), SHAPES[seed % len(SHAPES)])


@pytest.mark.filterwarnings("ignore::qe.DoubtfulInput")
@pytest.mark.parametrize("seed", range(40))
def test_an_answer_is_right_where_the_assumptions_hold_and_not_longer(seed: int) -> None:
    asked, assumed = question(seed), CONDITIONS[seed % len(CONDITIONS)]
    plain = qe.eliminate(asked)
    answer = qe.eliminate(asked, assuming=assumed)
    assert answer.formula is not None and plain.formula is not None
    assert length(answer.formula) <= length(plain.formula)
    assert set(answer.formula.free) <= set(asked.free)
    assert qe.equivalent(answer.formula, plain.formula, assuming=assumed)
    assert qe.simplify(plain.formula, assuming=assumed).formula is not None


@pytest.mark.filterwarnings("ignore::qe.DoubtfulInput")
@pytest.mark.parametrize("seed", range(30))
def test_a_certificate_states_the_assumptions_and_is_verified(seed: int) -> None:
    asked, assumed = question(seed), CONDITIONS[seed % len(CONDITIONS)]
    answer = qe.eliminate(asked, assuming=assumed, check=True)
    assert answer.formula is not None
    if not asked.free:
        return  # the assumptions say nothing of it
    assert answer.guarantee is qe.Guarantee.CHECKED, (str(asked), assumed, answer.reason)
    assert answer.derivation.is_complete
    assert qe.verify(answer.certificate, formula=asked, assuming=assumed).accepted
    before, after = answer.sides
    assert before == claimed(answer.assuming, asked, asked) and qe.equivalent(before, after)
    if answer.truth is None and not qe.equivalent(asked, before):  # nothing is said of the question alone
        assert not qe.verify(answer.certificate, formula=asked).accepted


@pytest.mark.filterwarnings("ignore::qe.DoubtfulInput")
@pytest.mark.parametrize("seed", range(20))
def test_a_generic_answer_is_right_where_what_it_lists_holds(seed: int) -> None:
    asked = question(seed)
    plain, answer = qe.eliminate(asked), qe.eliminate(asked, generic=True, check=seed % 4 == 0)
    assert answer.formula is not None and plain.formula is not None
    assert qe.find_instance(answer.assuming) is not None
    assert qe.equivalent(answer.formula, plain.formula, assuming=list(answer.generic))
    assert qe.equivalent(conj(answer.generic), answer.assuming) if answer.generic else answer.assuming == TRUE


@pytest.mark.parametrize("seed", range(20))
def test_simplify_is_equivalent_and_not_longer_than_the_standard_simplifier(seed: int) -> None:
    given = random_formula(random.Random(seed), Shape(2, 0, 3, 5))
    answer = qe.simplify(given)
    assert answer.formula is not None
    assert length(answer.formula) <= length(standard(given)) and qe.equivalent(answer.formula, given)

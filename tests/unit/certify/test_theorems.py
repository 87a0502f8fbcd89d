"""Theorems of rules: what the modules of their checkers say."""

import pytest

from qe.certify.registry import RULES
from qe.certify.theorems import theorem_of


@pytest.mark.parametrize("rule", RULES)
def test_every_rule_with_a_checker_has_its_theorem(rule: str) -> None:
    assert theorem_of(rule), f'the docstring of the module of the checker of "{rule}" says THEOREM'


def test_a_rule_has_the_theorem_of_its_checker_and_no_other() -> None:
    assert "intermediate values" in theorem_of("root")[0]
    assert len(theorem_of("solutions")) == 1
    assert theorem_of("no such rule") == ()

"""Formulas whose parts came from different polynomial rings."""

from __future__ import annotations

import qe


def test_a_disjunct_without_the_quantified_variables_does_not_end_critical_values_with_an_error() -> None:
    """The parts of the answer were over rings of their own: "number of generators does not match"."""
    question = "ex y. y^2 <= 1 and p + 2 >= 0 and (2*p*q - 1 >= 0 or p + y = 0)"
    answer = qe.eliminate(question, method="critical")
    assert answer.formula is not None
    assert qe.equivalent(answer.formula, "p + 2 >= 0 and (2*p*q >= 1 or p <= 1 and p >= -1)")
    assert qe.equivalent(question, answer.formula)

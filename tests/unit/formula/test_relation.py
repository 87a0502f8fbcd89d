"""The six comparisons with zero, by the signs that satisfy them."""

from __future__ import annotations

import pytest

from qe.formula.relation import Relation

SIGNS = (-1, 0, 1)


@pytest.mark.parametrize("relation", list(Relation))
def test_negation_turning_and_strictness_by_definition(relation: Relation) -> None:
    python = {"=": "==", "/=": "!="}.get(relation.value, relation.value)
    for sign in SIGNS:
        truth = eval(f"{sign} {python} 0")
        assert relation.holds(sign) is truth
        assert (sign in relation.signs) is truth
        assert relation.negated.holds(sign) is not truth
        assert relation.flipped.holds(-sign) is truth
    assert relation.negated.negated is relation and relation.flipped.flipped is relation
    assert relation.is_strict is (0 not in relation.signs)

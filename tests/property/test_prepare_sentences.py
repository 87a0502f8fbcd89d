"""Preparation keeps the meaning of whole formulas, whatever their quantifiers, and whichever steps are enabled.

Random formulas rich in equations, nested quantifiers with repeated names included, are decided before and after at
rational values of their free variables by the reference elimination or z3.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from qe.formula.build import atom
from qe.formula.syntax import Atom, Formula, Relation, RootAtom
from qe.formula.traverse import map_atoms
from qe.prepare import ALL_STEPS, StepKind, prepare
from tests.differential.check import Comparison, compare, reduced
from tests.differential.generate import LARGE, NESTED, SMALL, Shape, random_formula

SHAPES = (*SMALL, *NESTED, *LARGE, Shape(0, 3, 2, 5), Shape(1, 2, 2, 5), Shape(2, 2, 2, 4))


def with_equations(rng: random.Random, formula: Formula) -> Formula:
    """Half of the atoms turned into equations."""

    def change(found: Atom | RootAtom) -> Formula:
        return atom(found.poly, Relation.EQ) if isinstance(found, Atom) and rng.random() < 0.5 else found

    return map_atoms(formula, change)


def check(seed: str, *, seconds: float) -> bool:
    """Fail with a reduced formula if preparation changes the meaning of the formula of this seed.

    Whether the oracles could tell anything about it.
    """
    rng = random.Random(seed)
    formula = with_equations(rng, random_formula(rng, rng.choice(SHAPES)))
    some = frozenset(k for k in StepKind if rng.random() < 0.6)
    decided = 0
    for enabled in (ALL_STEPS, some):

        def compared(candidate: Formula, enabled: frozenset[StepKind] = enabled) -> Comparison:
            after = prepare(candidate, enabled=enabled).formula
            return compare(candidate, after, random.Random(seed), points=3, seconds=seconds)

        def fails(candidate: Formula, compared: Callable[[Formula], Comparison] = compared) -> bool:
            return compared(candidate).difference is not None

        found = compared(formula)
        assert found.difference is None, f"meaning changed: {reduced(formula, fails)}"
        decided += found.decided
    return decided > 0


@pytest.mark.parametrize("block", range(5))
def test_meaning_is_kept(block: int) -> None:
    assert sum(check(f"prepare {seed}", seconds=0.2) for seed in range(12 * block, 12 * block + 12)) >= 4


@pytest.mark.deep
@pytest.mark.parametrize("block", range(60))
def test_meaning_is_kept_deep(block: int) -> None:
    assert sum(check(f"deep prepare {seed}", seconds=1.0) for seed in range(20 * block, 20 * block + 20)) >= 7

"""Steps about equations: those of answers, and what equations together say inside disjunctions."""

from __future__ import annotations

import random
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.api.input import read_formula
from qe.elimination.protocol import Context
from qe.engine.untangle import untangled
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import Relation
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from tests.certificates.test_broken_producers import accepted

RING = Ring.of(("a", "b", "x", "y", "z", "u", "v", "w"))


@settings(deadline=None, max_examples=15, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_equations_of_answers(seed: int) -> None:
    """Linear equations and products, as they come out of eliminations: each small step has evidence."""
    rng, ring, log = random.Random(seed), Ring.of(("a", "b", "c")), RunLog()
    lines = [ring.gen(i) * rng.choice((1, 2)) - ring.gen(j) * rng.choice((0, 1)) for i, j in combinations(range(3), 2)]
    cases = disj((atom(rng.choice(lines), Relation.NE), atom(rng.choice(lines), Relation.EQ)))
    equation = atom(rng.choice(lines) * rng.choice((*lines, ring.constant(1))), Relation.EQ)
    untangled(conj((equation, cases, atom(rng.choice(lines), Relation.EQ))), Context(Options(), Budget(), log))
    assert all(map(accepted, log.steps()))


@pytest.mark.parametrize(
    ("inside", "proved"),
    [
        ("x - 1 = 0 or x - y > 0", True),
        ("x - 1 = 0 or x - y >= 0", False),
        ("x + 1 = 0 or x - y > 0", False),
        ("x - 1 = 0 or y - x > 0", False),
    ],
)
def test_equations_together_reduce_what_stands_in_disjunctions(inside: str, proved: bool) -> None:
    circles = "x^2 + y^2 = 1 and z^2 + w^2 = 1"
    before = f"ex x, y, z, w. {circles} and (x^2 + y^2 - 2*x + 1 = 0 or x*z^2 + x*w^2 - x^2*y - y^3 > 0)"
    sides = (moved(read_formula(text), RING) for text in (before, f"ex x, y, z, w. {circles} and ({inside})"))
    assert accepted(Step("Groebner basis of the equations", *sides)) is proved

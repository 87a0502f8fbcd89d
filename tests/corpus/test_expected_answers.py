"""The corpus is well formed, and its expected answers agree with oracles that are not the engine."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from experiments import reference
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE
from qe.io.text import read
from qe.options import Budget
from tests.corpus.catalogue import KEYS, Problem, problems, records
from tests.differential.generate import at_point

TAGS = {"timing", "regression", "shape", "geometry", "published", "slow", "textbook", "threads"}

# Out of the reach of the reference elimination within the time it is given here; z3 checks what it can of them.
BEYOND_REFERENCE = frozenset(
    {
        "catastrophe-and-sphere",
        "chebyshev-3",
        "coverings-nullified-cubic",
        "cyclic-4",
        "missed-feasible-point",
        "roots-over-two-square-roots",
        "solid-cylinder-misses-ball",
        "third-root-of-a-reducible-quintic",
        "three-balls-meet",
        "variable-elimination-before-coverings",
    }
)
# Out of the reach of the reference elimination, and z3 takes seconds.
SLOW_BY_Z3 = frozenset({"roots-over-two-square-roots"})


def test_records_are_well_formed() -> None:
    seen = set()
    for file, record in records():
        name = record["id"]
        assert set(record) - {"assume"} == KEYS, (file, name)
        assert name not in seen, name
        seen.add(name)
        assert record["citation"] and record["why"] and record["tags"], name
        assert set(record["tags"]) <= TAGS, name  # type: ignore[arg-type]


@pytest.mark.parametrize("problem", problems(), ids=lambda p: p.id)
def test_texts_are_readable(problem: Problem) -> None:
    formula, expected = read(problem.formula), read(problem.expected)
    assert expected.is_quantifier_free
    assert set(expected.free) <= set(formula.free)
    if not formula.free:
        assert expected in (TRUE, FALSE)


def points(problem: Problem, count: int) -> list[dict[str, Fraction]]:
    """Rational points for the free variables: the origin, small integers, fractions."""
    rng = random.Random(problem.id)
    names = read(problem.formula).free
    values = [
        *map(Fraction, (0, 0, 1, 1, -1, 2, -2, 3, 5)),
        Fraction(1, 2),
        Fraction(-2, 3),
        Fraction(11, 10),
        Fraction(7, 4),
    ]
    return [{n: Fraction(0) for n in names}, *({n: rng.choice(values) for n in names} for _ in range(count - 1))]


@pytest.mark.parametrize(
    "problem",
    [p for p in problems() if p.id not in BEYOND_REFERENCE and not {"textbook", "threads"} & {*p.tags}],  # known ones
    ids=lambda p: p.id,
)
def test_expected_answer_holds_at_points_by_the_reference(problem: Problem) -> None:
    formula, expected = read(problem.formula), read(problem.expected)
    budget = Budget(60.0)  # a bound on blunders, not a measurement: the machine may be busy
    for point in points(problem, 12 if formula.free else 1):
        claimed = holds_at(expected, point) if expected.free else expected == TRUE
        assert reference.decide(at_point(formula, point), budget=budget) is claimed, point


@pytest.mark.parametrize(
    "problem",
    [
        pytest.param(p, id=p.id, marks=[pytest.mark.deep] if p.id in SLOW_BY_Z3 else [])
        for p in problems()
        if p.id in BEYOND_REFERENCE
    ],
)
def test_expected_answer_holds_at_points_by_z3(problem: Problem) -> None:
    pytest.importorskip("z3")
    from experiments.z3_oracle import decide

    formula, expected = read(problem.formula), read(problem.expected)
    for point in points(problem, 5 if formula.free else 1):
        claimed = holds_at(expected, point) if expected.free else expected == TRUE
        assert decide(at_point(formula, point), seconds=30) is claimed, point

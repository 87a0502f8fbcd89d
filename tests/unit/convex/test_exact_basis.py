"""Proposals are never believed: whatever comes, the outcome is right or there is none."""

import random
from fractions import Fraction

import pytest

from qe.convex import linear_rows
from qe.convex.exact_basis import Refutation, decided
from qe.convex.highs import Proposal, highs
from qe.convex.linear_point import LinearContradiction, linear_point
from qe.convex.linear_rows import LinearRows
from qe.convex.system import atoms_of
from qe.formula.syntax import Constant
from qe.io.text import read
from qe.options import Budget


def random_conditions(rng, size, count):
    names = [f"x{k}" for k in range(size)]
    parts = []
    for _ in range(count):
        terms = " + ".join(f"({rng.randint(-3, 3)})*{x}" for x in names)
        parts.append(f"{terms} + {rng.choice(names)} {rng.choice(['<', '<=', '>', '>=', '='])} {rng.randint(-4, 4)}")
    return read(" and ".join(parts))


def system_of(conditions):
    """None for a constant."""
    return None if isinstance(conditions, Constant) else LinearRows.of(atoms_of(conditions))


def nothing(problem, seconds):
    return None


def check(conditions, outcome):
    system = LinearRows.of(atoms_of(conditions))
    if isinstance(outcome, Refutation):
        assert system.refuted_by(outcome.weights)
    elif outcome is not None:
        assert system.holds(outcome)


@pytest.mark.parametrize("sparse", [False, True])
def test_random_systems_against_the_exact_simplex_method(monkeypatch, sparse):
    pytest.importorskip("highspy")
    if sparse:  # strict conditions come first, and an interior method proposes
        monkeypatch.setattr(linear_rows, "_MANY", -1)
        monkeypatch.setattr(linear_rows, "_SPARSE", 2)
    rng, decided_ones = random.Random(3), 0
    for _ in range(150):
        conditions = random_conditions(rng, rng.randint(1, 5), rng.randint(1, 9))
        system = system_of(conditions)
        if system is None:
            continue
        exact = linear_point(conditions, budget=Budget(), propose=nothing)
        outcome = decided(system, lambda: None, highs)
        check(conditions, outcome)
        decided_ones += outcome is not None
        if outcome is not None:
            assert isinstance(exact, LinearContradiction) == isinstance(outcome, Refutation)
    assert decided_ones > 100


def test_multipliers_of_very_different_size_are_no_zeros():
    """That of a long row is small: it was taken for zero, and 640 conditions took 16 s."""
    system = system_of(read("x + y >= 1 and x <= 0 and 10000000000*x + 20000000000*y <= 9999999999"))

    def proposed(problem, seconds):
        return Proposal((), (), (0.0, 0.0, 0.0), (2.0, 1.0, 1e-10), ray=True)

    outcome = decided(system, lambda: None, proposed)
    assert isinstance(outcome, Refutation) and len(outcome.weights) == 3


def test_random_proposals_never_give_a_wrong_outcome():
    rng = random.Random(4)

    def broken(problem, seconds):
        columns = rng.sample(range(problem.size + 1), rng.randint(0, problem.size + 1))
        rows = rng.sample(range(len(problem.system.rows)), rng.randint(0, len(problem.system.rows)))
        numbers = [rng.choice([0.0, 1.0, -2.5, 1e300, float("inf"), float("nan")]) for _ in range(problem.size + 1)]
        duals = [rng.choice([0.0, 1.0, -1.0, float("nan")]) for _ in problem.system.rows]
        return Proposal(columns, rows, numbers, duals, ray=rng.random() < 0.3)

    for _ in range(300):
        conditions = random_conditions(rng, rng.randint(1, 4), rng.randint(2, 6))
        system = system_of(conditions)
        if system is not None:
            check(conditions, decided(system, lambda: None, broken))


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("x >= 1 and x <= 1", True),
        ("x > 1 and x <= 1", False),
        ("x >= 1 and 1000000000000*x <= 999999999999", False),
        ("x > 0 and 1000000000000000000000*x < 1", True),
        ("x + y = 1 and x + y = 2", False),
        ("x + y = 1 and x - y = 2 and x > y", True),
        ("x < y and y < z and z < x", False),
    ],
)
def test_close_strict_and_equal(text, holds):
    pytest.importorskip("highspy")
    outcome = decided(LinearRows.of(atoms_of(read(text))), lambda: None, highs)
    assert outcome is None or isinstance(outcome, Refutation) != holds
    check(read(text), outcome)


def test_a_large_system_without_proposals_is_left_to_the_simplex_method():
    text = " and ".join(f"x{k} + x{k + 1} + x{k + 2} < {k}" for k in range(400)) + " and x5 > 1"
    point = linear_point(read(text), budget=Budget(), propose=nothing)
    assert isinstance(point, dict)
    assert all(point[f"x{k}"] + point[f"x{k + 1}"] + point[f"x{k + 2}"] < k for k in range(400))


def test_weights_of_the_wrong_sign_refute_nothing():
    system = LinearRows.of(atoms_of(read("x <= 1 and x >= 0")))
    assert not system.refuted_by({0: 1, 1: 1})
    assert not system.refuted_by({0: -1, 1: -1})
    assert system.holds((Fraction(1, 2),)) and not system.holds((Fraction(2),))


@pytest.mark.parametrize("least", [12, 40])
def test_bounds_of_variables_lead_to_exact_points_and_contradictions(monkeypatch, least):
    """Shares x_ij >= 0 of which each row and each column has 1, at a cost of i + j each: 30 in all."""
    pytest.importorskip("highspy")
    monkeypatch.setattr(linear_rows, "_MANY", -1)
    monkeypatch.setattr(linear_rows, "_SPARSE", 2)
    places = range(6)
    parts = [f"x{i}{j} >= 0 and x{i}{j} <= 1" for i in places for j in places]
    for i in places:
        parts += [" + ".join(f"x{i}{j}" for j in places) + " = 1", " + ".join(f"x{j}{i}" for j in places) + " = 1"]
    cost = " + ".join(f"{i + j}*x{i}{j}" for i in places for j in places if i + j)
    conditions = read(" and ".join([*parts, f"{cost} >= {least}"]))
    outcome = decided(LinearRows.of(atoms_of(conditions)), lambda: None, highs)
    check(conditions, outcome)
    assert outcome is not None and isinstance(outcome, Refutation) is (least > 30)

"""Linear conditions: what floats propose is made exact and agrees with the simplex method; nothing false gets by."""

import random
from dataclasses import replace
from fractions import Fraction

import pytest

import qe
from qe.convex import linear_point as module
from qe.convex.exact_basis import Refutation, decided
from qe.convex.highs import Proposal, Slackened, highs
from qe.convex.linear_point import LinearContradiction, linear_point
from qe.convex.linear_rows import LinearRows
from qe.convex.system import atoms_of
from qe.exact.sparse_solve import solve_sparse
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from qe.io import formats
from qe.options import Budget
from tests.tables import each

RELATIONS = ("<", "<=", "=", ">", ">=")


def system(rng: random.Random, size: int, count: int, largest: int = 4) -> Formula:
    """Random sparse conditions, tight ones at a common point among them."""
    point = [rng.randint(-3, 3) for _ in range(size)]
    parts = []
    for _ in range(count):
        chosen = rng.sample(range(size), rng.randint(1, min(4, size)))
        terms = {j: rng.choice([c for c in range(-largest, largest + 1) if c]) for j in chosen}
        value = sum(c * point[j] for j, c in terms.items()) + rng.choice((0, 0, 1, -1))
        left = " + ".join(f"({c})*x{j}" for j, c in terms.items())
        parts.append(f"{left} {rng.choice(RELATIONS)} {value}")
    return formats.read(" and ".join(parts), "text")


def rows(formula: Formula) -> LinearRows:
    return LinearRows.of(atoms_of(formula))


def by_floats(formula: Formula, propose: object = highs) -> tuple[Fraction, ...] | Refutation | None:
    return decided(rows(formula), lambda: None, propose)  # type: ignore[arg-type]


def test_floats_made_exact_agree_with_the_simplex_method() -> None:
    pytest.importorskip("highspy")
    rng, seen = random.Random(5), {True: 0, False: 0, None: 0}
    for _ in range(250):
        formula = system(rng, rng.randint(2, 8), rng.randint(3, 14))
        outcome, exact = by_floats(formula), module._pivoted(rows(formula), Budget())
        if outcome is None:
            seen[None] += 1
            continue
        refuted = isinstance(outcome, Refutation)
        assert refuted is isinstance(exact, Refutation), str(formula)
        seen[refuted] += 1
        if isinstance(outcome, Refutation):
            assert rows(formula).refuted_by(outcome.weights)
        else:
            assert holds_at(formula, dict(zip(rows(formula).names, outcome, strict=True)))
    assert seen[True] > 50 and seen[False] > 50 and seen[None] < 10, seen


@each(1, 10**-6, 10**6, "nonsense")
def test_a_broken_proposer_makes_nothing_false(noise: object) -> None:
    rng = random.Random(9)

    def broken(problem: Slackened, seconds: float | None) -> Proposal | None:
        made = highs(problem, seconds)
        if made is None or noise == "nonsense":
            columns = rng.sample(range(problem.size + 1), rng.randint(0, problem.size))
            tight = rng.sample(range(len(problem.system.rows)), min(len(columns), len(problem.system.rows)))
            point = [rng.uniform(-5, 5) for _ in range(problem.size + 1)]
            return Proposal(
                columns, tight, point, [rng.uniform(-1, 1) for _ in problem.system.rows], rng.random() < 0.5
            )
        scale = float(str(noise))
        point, multipliers = ([v + rng.gauss(0, scale) for v in part] for part in (made.point, made.multipliers))
        return replace(made, point=point, multipliers=multipliers)

    for _ in range(60):
        formula = system(rng, rng.randint(2, 6), rng.randint(3, 12))
        outcome, exact = by_floats(formula, broken), module._pivoted(rows(formula), Budget())
        if isinstance(outcome, Refutation):
            assert rows(formula).refuted_by(outcome.weights) and isinstance(exact, Refutation)
        elif outcome is not None:
            assert holds_at(formula, dict(zip(rows(formula).names, outcome, strict=True)))


@each(True, False)
def test_large_dense_systems_have_a_point_or_a_certificate(feasible: bool) -> None:
    rng, size = random.Random(2), 40
    names = [f"x{j}" for j in range(size)]
    parts, total = [], [0] * size
    for _ in range(size):
        row = [rng.randint(-9, 9) for _ in range(size)]
        total = [a + b for a, b in zip(total, row, strict=True)]
        parts.append(" + ".join(f"({c})*{n}" for c, n in zip(row, names, strict=True)) + " < 1")
    last = " + ".join(f"({c})*{n}" for c, n in zip(total, names, strict=True))
    parts.append(f"{last} {'<' if feasible else '>'} {size}")
    question = f"ex {', '.join(names)}. {' and '.join(parts)}"
    answer = qe.eliminate(question, check=True)
    assert answer.truth is feasible and answer.guarantee is qe.Guarantee.CHECKED


def test_without_a_proposer_the_simplex_method_answers() -> None:
    rng = random.Random(4)
    for _ in range(20):
        formula = system(rng, 6, 260, largest=3)  # enough coefficients for floats to be asked
        known = linear_point(formula, budget=Budget(), propose=lambda problem, seconds: None)
        other = linear_point(formula, budget=Budget())
        assert isinstance(known, LinearContradiction) is isinstance(other, LinearContradiction)


def test_close_numbers_are_told_from_equal_ones() -> None:
    tiny = Fraction(1, 10**30)
    for strict, feasible in (("<", False), ("<=", True)):
        text = f"x + y >= 1 and 3*x - y >= 2 and 4*x {strict} 3"
        assert isinstance(by_floats(formats.read(text, "text")), tuple) is feasible
    formula = formats.read(f"x + y >= 1 and 3*x - y >= 2 and 4*x < 3 + {tiny}", "text")
    point = by_floats(formula)
    assert isinstance(point, tuple) and holds_at(formula, dict(zip(rows(formula).names, point, strict=True)))


def test_sparse_systems_are_solved_exactly() -> None:
    rng = random.Random(6)
    for _ in range(100):
        size = rng.randint(1, 12)
        solution = [Fraction(rng.randint(-9, 9), rng.randint(1, 5)) for _ in range(size)]
        table = [
            {j: rng.randint(-5, 5) or 1 for j in rng.sample(range(size), rng.randint(1, size))} for _ in range(size)
        ]
        scale = 60
        right = [sum(c * solution[j] for j, c in row.items()) * scale for row in table]
        solved = solve_sparse([{j: c * scale for j, c in row.items()} for row in table], [int(b) for b in right])
        if solved is None:  # not the only one
            continue
        for row, b in zip(table, right, strict=True):
            assert sum(c * solved[j] for j, c in row.items()) * scale == b


def test_contradictory_equations_have_no_solution() -> None:
    assert solve_sparse([{0: 1, 1: 1}, {0: 2, 1: 2}], [1, 3]) is None
    assert solve_sparse([{0: 1}, {0: 1}], [1, 2]) is None

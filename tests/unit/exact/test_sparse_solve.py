import random
from fractions import Fraction

from qe.exact.sparse_solve import solve_sparse


def test_solutions_are_exact_and_further_equations_may_follow():
    rng = random.Random(1)
    for n in (1, 4, 12, 40):
        point = [Fraction(rng.randint(-99, 99), rng.randint(1, 9)) for _ in range(n)]
        rows = [{j: rng.randint(1, 9) for j in rng.sample(range(n), min(n, 3))} for _ in range(3 * n)]
        rows += [{j: 7 * 2**70 + j} for j in range(n)]
        scale = 2520
        right = [sum(scale * c * point[j] for j, c in row.items()) for row in rows]
        solved = solve_sparse([{j: scale * c for j, c in row.items()} for row in rows], map(int, right))
        assert solved == dict(enumerate(point))


def test_dense_systems():
    rng = random.Random(2)
    rows = [{j: rng.randint(-9, 9) or 1 for j in range(30)} for _ in range(30)]
    solved = solve_sparse(rows, [1] * 30)
    assert solved is not None
    assert all(sum(c * solved[j] for j, c in row.items()) == 1 for row in rows)


def test_no_solution_or_several():
    assert solve_sparse([{0: 1}, {0: 1}], [1, 2]) is None
    assert solve_sparse([{0: 1, 1: 1}], [1]) is None
    assert solve_sparse([{0: 1, 1: 1}, {0: 2, 1: 2}], [1, 2]) is None

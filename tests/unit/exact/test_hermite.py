"""Leading minors of matrices of polynomials, and the signatures of Hankel matrices by their signs."""

import random

import pytest

from qe.exact.hermite import added_signature, leading_minors
from qe.exact.ring import Poly, Ring

RING = Ring.of(("a", "b"))
A, B = RING.gen(0), RING.gen(1)


def by_first_row(rows: list[list[Poly]]) -> Poly:
    """The determinant, expanded along the first row."""
    if not rows:
        return RING.constant(1)
    minors = (by_first_row([row[:c] + row[c + 1 :] for row in rows[1:]]) for c in range(len(rows)))
    return sum(((-1) ** c * rows[0][c] * minor for c, minor in enumerate(minors)), RING.constant(0))


@pytest.mark.parametrize("size", range(1, 6))
def test_the_leading_minors_are_the_determinants_of_the_leading_blocks(size: int) -> None:
    rng = random.Random(size)
    rows = [
        [rng.randint(-2, 2) * A + rng.randint(-2, 2) * B + rng.randint(-1, 1) for _ in range(size)] for _ in range(size)
    ]
    minors = list(leading_minors(lambda i, j: rows[i][j], size, RING.constant(1)))
    assert minors == [by_first_row([row[:k] for row in rows[:k]]) for k in range(1, size + 1)]


def test_minors_are_reduced_on_the_way() -> None:
    """Modulo b = 0: what is reduced goes into the larger minors."""
    rows = [[A, B, A], [B, A, B], [A, B, A + 1]]
    reduced = lambda p: p.at_rational(1, 0)  # noqa: E731
    assert list(leading_minors(lambda i, j: rows[i][j], 3, RING.constant(1), reduced=reduced)) == [A, A**2, A**2]


def hankel(values: list[int], weights: list[int]) -> tuple[list[int], int, int]:
    """The leading minors of sum(w*v^(i+j)), its rank and signature, for distinct values and weights that are not 0."""
    size = len(values) + 1
    entry = [sum(w * v**k for v, w in zip(values, weights, strict=True)) for k in range(2 * size - 1)]
    minors = leading_minors(lambda i, j: RING.constant(entry[i + j]), size, RING.constant(1))
    return [m.constant_value() for m in minors], len(values), sum((w > 0) - (w < 0) for w in weights)


@pytest.mark.parametrize("seed", range(200))
def test_the_signs_of_minors_give_the_signature(seed: int) -> None:
    rng = random.Random(seed)
    values = rng.sample(range(-3, 4), rng.randint(1, 5))
    minors, rank, signature = hankel(values, [rng.choice([-2, -1, 1, 2]) for _ in values])
    assert minors[rank - 1] and not any(minors[rank:])
    total, gap, last = 0, 0, 1
    for minor in minors[:rank]:
        gap += 1
        if minor:
            sign = (minor > 0) - (minor < 0)
            added = added_signature(gap, sign, last)
            assert added is not None
            total, gap, last = total + added, 0, sign
    assert total == signature


def test_signs_that_do_not_occur() -> None:
    assert added_signature(2, 1, 1) is None and added_signature(2, -1, 1) == 0
    assert added_signature(4, -1, 1) is None and added_signature(4, 1, 1) == 0

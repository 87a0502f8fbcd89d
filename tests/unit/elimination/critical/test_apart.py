"""Blocks taken apart by their disjuncts, each in as few parameters as it looks at."""

import random
from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.elimination.critical.apart import taken_apart
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, disj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Relation
from qe.io.text import read
from tests.tables import each

LINES = "ex a, b. all x. -1 <= x and x <= 1 -> -m <= x^3 + a*x + b and x^3 + a*x + b <= m"


@settings(deadline=None, max_examples=40, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_a_piece_is_the_same_in_fewer_parameters(seed: int) -> None:
    rng, ring = random.Random(seed), Ring.of(("a", "b", "c", "d", "y"))
    names, y = ring.names[:4], ring.var("y")

    def combination() -> list[int]:
        return [rng.choice((-3, -2, -1, 1, 2)) for _ in names]

    def polynomial(rows: list[list[int]]):
        u, v = (sum((ring.var(n) * k for n, k in zip(names, row, strict=True)), ring.constant(0)) for row in rows)
        return y**3 + u * y * rng.randint(1, 2) + v * v + rng.randint(-2, 2)

    choices = [polynomial([combination(), combination()]) for _ in range(2)]
    body = conj((atom(y**2 - 1, Relation.LE), disj(atom(p, rng.choice(tuple(Relation))) for p in choices)))
    pieces = taken_apart(("y",), body, 2)
    assert len(pieces) == 2 and all(len(piece.body.free) <= 3 for piece in pieces)
    for _ in range(20):
        point = {name: Fraction(rng.randint(-6, 6), rng.randint(1, 3)) for name in ring.names}
        truths = [holds_at(piece.whole, point) for piece in pieces]
        assert truths == [holds_at(piece.back(piece.body), point) for piece in pieces]
        assert any(truths) is holds_at(body, point)


@each("y^3 + a*y + b*y^2 + c > 0", "y^3 + a*y > 0 and (y > b or y < c or y^2 > a or y = d or y = 2)")
def test_other_bodies_stay_whole(text: str) -> None:
    assert taken_apart(("y",), read(text), 2) == ()


def test_best_approximation_of_a_cubic_by_lines() -> None:
    answer = qe.eliminate(LINES)
    assert qe.equivalent(answer.formula, "4*m >= 1")
    assert "critical" in answer.stats

"""Lemmas found for steps of simplification: linear consequences, and equations put in one after the other."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.elimination.search.monomial_bounds import MonomialBounds
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert
from qe.formula.syntax import FALSE, Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.step import Step
from qe.proving.prover import Prover
from tests.tables import each

RING = Ring.of(("a", "b", "s", "t", "x", "y", "z"))


def is_proved(before: Formula, after: Formula, known: Formula | None = None) -> bool:
    """Whether a step of simplification has evidence, without a decomposition."""
    prover = Prover(RING, Options(), Budget(60), tables=False)
    context = conjuncts(convert(known, RING)) if known is not None else ()
    step = Step("simplification", convert(before, RING), convert(after, RING))
    return prover.evidence(step, context) is not None


LINEAR = [
    ("x > y and y > z and z > x + 1", "false"),
    ("x + 2*y <= 3 and x - y >= 4 and y >= 1", "false"),
    ("x + y <= 3 and x - y >= 4 and 2*y >= -1", "x - y = 4 and 2*y = -1 and x + y = 3"),
    ("x > 1 and y > x or x > 2 and x < y", "x > 1 and y > x"),
    ("x^2 + y < 0 and y > z and z > 3", "false"),
    ("x*y > z and z > t and t > x*y", "false"),
    ("x > y and y > z and (x < z or x > 0)", "x > y and y > z and x > 0"),
]
CHAINS = [
    ("a = 1 and x <= 0 and 3*x^2 - 2*x - a = 0 and x^3 - a*x = x^2 - a + 2*b + 2", "a = 1 and 3*x = -1 and 27*b = -11"),
    ("(a - 1)^3*(b - 1) = 0 and b^3 = 0", "a = 1 and b = 0"),
    ("x = 0 and 2*x*y = y and 4*y^2 - 4*z^2 + 1 = 0 and z > 0", "x = 0 and y = 0 and 2*z = 1"),
    ("a = 1 and b = a and x = b and y = x + b and z = y^2 and z < 3", "false"),
]

BOUNDED = [
    ("a > 0 and b > 1 and a*b + 2*b <= 1", "false"),
    ("a >= 0 and 2*b < 1 and 2*a*b - a + 4*b >= 3", "false"),
    ("x > 2 and y > 3 and x*y - 3*x - 2*y + 6 <= 0", "false"),
]


@pytest.mark.parametrize(("before", "after"), LINEAR + CHAINS + BOUNDED)
def test_what_follows_is_proved(before: str, after: str) -> None:
    assert is_proved(read(before), read(after))


@each(
    ("x > y and y > z and z > x - 1", "false"),
    ("x + y <= 3 and x - y >= 4 and 2*y >= -2", "x - y = 4"),
    ("x^2 + y < 0 and y > z and z > -3", "false"),
    ("a = 1 and 3*x^2 - 2*x - a = 0", "a = 1 and 3*x = -1"),
    ("x = 0 and 2*x*y = y and 4*y^2 - 4*z^2 + 1 = 0", "x = 0 and y = 0 and 2*z = 1"),
    ("a = 1 and b = a and x = b and y = x + b and z = y^2 and z < 5", "false"),
    ("a > 0 and b > 1 and a*b + 2*b <= 2 + a", "a = 0"),
    ("x > 2 and y > 3 and x*y - 3*x - 2*y + 5 <= 0", "false"),
)
def test_what_does_not_follow_is_not(before: str, after: str) -> None:
    assert not is_proved(read(before), read(after))


def test_the_context_takes_part() -> None:
    before, known = read("ex s. s >= 0 and t >= s and s > 1"), read("t < 1")
    assert is_proved(before, FALSE, known)
    assert not is_proved(before, FALSE, read("t < 2"))


@given(
    st.lists(st.integers(-5, 5), min_size=2, max_size=6),
    st.integers(1, 3),
    st.lists(st.sampled_from(("<", "<=")), min_size=6, max_size=6),
)
def test_cycles_of_differences(steps: list[int], scale: int, signs: list[str]) -> None:
    """x_1 + d_1 <= x_2, ..., x_n + d_n <= x_1 hold somewhere iff the d_i add up to less than 0, or 0 without <."""
    names = RING.names[: len(steps)]
    parts = []
    for k, (d, sign) in enumerate(zip(steps, signs)):
        p = RING.var(names[k]) - RING.var(names[(k + 1) % len(names)]) + d
        parts.append(atom(p * scale, Relation(sign)))
    strict = "<" in signs[: len(steps)]
    assert is_proved(conj(parts), FALSE) is (sum(steps) > 0 or (strict and sum(steps) == 0))


@given(st.lists(st.tuples(st.integers(0, 4), *[st.integers(0, 2)] * 3), min_size=1, max_size=4), st.integers(-3, 3))
def test_distances_from_bounds(terms: list[tuple[int, int, int, int]], bound: int) -> None:
    """A sum of products of x - b, 2*y + 1 and z with positive coefficients is positive where these are."""
    x, y, z = RING.var("x") - bound, RING.var("y") * 2 + 1, RING.var("z")
    total = sum((x**i * y**j * z**k * c for c, i, j, k in terms), RING.constant(1))
    given_ = conj((*(atom(p, Relation.GT) for p in (x, y, z)), atom(total, Relation.LE)))
    assert is_proved(given_, FALSE)


@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 4, st.sampled_from(list(Relation))), min_size=1, max_size=6))
def test_conflicts_and_points(rows: list[tuple[int, int, int, int, Relation]]) -> None:
    x, y, z = (RING.var(name) for name in "xyz")
    found = [atom(x * p + y * q + z * r + c, relation) for p, q, r, c, relation in rows]
    atoms = [a for a in found if isinstance(a, Atom) and a.relation is not Relation.NE]
    bounds = MonomialBounds(RING)
    for part in (atoms[:2], atoms):  # what was learnt from the first is kept
        conflict = bounds.conflict(part, lambda: None)
        if conflict is None:
            at = bounds.point()
            values = [Fraction(at[name]) for name in RING.names]
            assert all(a.relation.holds((v > 0) - (v < 0)) for a in part for v in [a.poly.evaluate(values)])
        else:
            assert conflict <= set(part)
            assert is_proved(conj(a for a in part if a in conflict), FALSE)

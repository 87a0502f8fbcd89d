"""Ranges of long sums: their sign where all terms have one, nothing where they differ."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import Relation
from qe.simplify.facts import Facts, generator

RING = Ring.of(("x", "y", "z"))
MONOMIALS = [k for k in product(range(4), repeat=3) if 0 < sum(k) <= 5]
assert len(MONOMIALS) > 30


def poly(coefficients: list[int]) -> Poly:
    x, y, z = (RING.gen(i) for i in range(3))
    terms = (c * x**a * y**b * z**d for c, (a, b, d) in zip(coefficients, MONOMIALS, strict=True))
    return sum(terms, RING.constant(0))


def facts(*relations: tuple[int, Relation]) -> Facts:
    return Facts().extended(atom(generator(RING, i), relation) for i, relation in relations)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(0, 3), min_size=len(MONOMIALS), max_size=len(MONOMIALS)), st.data())
def test_a_long_sum_of_one_sign(coefficients: list[int], data: st.DataObject) -> None:
    signs = [
        data.draw(st.sampled_from((Relation.GT, Relation.GE, Relation.LT, Relation.LE, Relation.NE))) for _ in "xyz"
    ]
    down = data.draw(st.booleans())
    flipped = data.draw(st.integers(0, len(coefficients) - 1))
    if data.draw(st.booleans()):
        coefficients[flipped] *= -1
    sums = poly([-c for c in coefficients] if down else coefficients)
    if sums.is_constant:
        return
    known = facts(*enumerate(signs)).signs(sums)
    values = [data.draw(st.sampled_from([v for v in (-2, -1, 0, 1, 2) if r.holds((v > 0) - (v < 0))])) for r in signs]
    value = sums.evaluate([Fraction(v) for v in values])
    assert (value > 0) - (value < 0) in known


def test_long_sums_are_decided() -> None:
    ones = poly([1] * len(MONOMIALS))
    positive = [(i, Relation.GT) for i in range(3)]
    assert facts(*positive).signs(ones) == {1}
    assert facts(*positive).signs(-ones) == {-1}
    assert facts(*((i, Relation.GE) for i in range(3))).signs(ones) == {0, 1}
    assert facts(*positive[:2]).signs(ones) == {-1, 0, 1}
    squares = poly([1 if not any(k % 2 for k in powers) or powers[0] else 0 for powers in MONOMIALS])
    assert facts((0, Relation.GT), (1, Relation.NE)).signs(squares) == {-1, 0, 1}
    assert facts(*positive).signs(ones - 2 * poly([1] + [0] * (len(MONOMIALS) - 1))) == {-1, 0, 1}
    with_x = poly([int(powers[0] > 0) for powers in MONOMIALS])
    assert with_x.term_count() > 24
    below = facts((0, Relation.LT), *positive[1:])
    assert below.signs(with_x) == {-1, 0, 1}
    assert below.signs(poly([powers[0] and (-1) ** powers[0] for powers in MONOMIALS])) == {1}


def test_a_sentence_on_a_long_sum_needs_no_decomposition() -> None:
    text = " + ".join(f"{k + 1}*x^{a}*y^{b}*z^{c}" for k, (a, b, c) in enumerate(MONOMIALS))
    answer = qe.eliminate(f"ex x, y, z. x > 0 and y > 0 and z > 0 and {text} < 1/10^9 - 1/10^9", timeout=60, check=True)
    assert answer.truth is False

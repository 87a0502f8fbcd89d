"""Sums and products that are collected while they are read mean what the trees mean, and stay small."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.io import collected
from qe.io import surface as s
from qe.io.lowering import lower_term
from qe.io.terms import Value
from tests.unit.io.failing import fail

NAMES = [s.Name(name, 0) for name in "xyz"]
NUMBERS = [s.Number(value) for value in (0, 1, -1, 7, Fraction(-2, 3), Fraction(1, 6), 10**30)]


def total(parts: list[s.Term]) -> s.Term:
    """The sum of what is collected of the parts and of the others."""
    terms: collected.Coefficients = {}
    return collected.joined(terms, [part for part in parts if not collected.add(terms, part)])


def both(parts: list[tuple[s.Term, s.Term]]) -> st.SearchStrategy[tuple[s.Term, s.Term]]:
    """What is collected of the parts, and a tree of them."""
    read, trees = [part[0] for part in parts], [part[1] for part in parts]
    ways: list[tuple[s.Term | None, s.Term]] = [
        (total(read), s.Sum(trees) if len(trees) > 1 else trees[0]),
        (collected.negative(read[0]), s.Minus(trees[0])),
        (collected.product(read), product(trees)),
        (collected.quotient(read[0], s.Number(-6)), s.Quotient(trees[0], s.Number(-6), 0)),
        (collected.power(read[0], s.Number(3)), s.Power(trees[0], s.Number(3), 0)),
    ]
    return st.sampled_from([(short or tree, tree) for short, tree in ways])


def product(parts: list[s.Term]) -> s.Term:
    result = parts[0]
    for part in parts[1:]:
        result = s.Product(result, part, 0)
    return result


PAIRS: st.SearchStrategy[tuple[s.Term, s.Term]] = st.recursive(
    st.sampled_from([(leaf, leaf) for leaf in (*NAMES, *NUMBERS)]),
    lambda inner: st.lists(inner, min_size=1, max_size=4).flatmap(both),
    max_leaves=12,
)


def value(term: s.Term) -> tuple[object, Fraction]:
    """The primitive polynomial and the factor before it, in the ring of all names."""
    everything = s.Sum([term, *(s.Product(s.Number(0), name, 0) for name in NAMES)])
    found = lower_term(s.Sum([s.Product(s.Number(0), product(list(NAMES)), 0), everything]), fail)
    unit, primitive = found.poly.normal()
    return primitive, Fraction(unit, found.den)


@given(PAIRS)
def test_what_is_collected_means_what_the_tree_means(pair: tuple[s.Term, s.Term]) -> None:
    assert value(pair[0]) == value(pair[1])


@given(PAIRS, PAIRS)
def test_the_sides_of_a_comparison_have_the_difference_of_the_terms(
    left: tuple[s.Term, s.Term], right: tuple[s.Term, s.Term]
) -> None:
    a, b = collected.sides(left[0], right[0])
    assert value(s.Sum([a, s.Minus(b)])) == value(s.Sum([left[1], s.Minus(right[1])]))


def test_what_could_become_large_stays_a_tree() -> None:
    x = NAMES[0]
    long = s.Polynomial({(f"x{k}",): 1 for k in range(collected.SHORT + 1)})
    large = s.Number(1 << 3000)
    assert total([long, x]) == s.Sum([s.Polynomial({("x",): 1}), long])
    assert collected.product([long, x]) is None and collected.negative(long) is None
    assert collected.product([x] * 65) is None and collected.product([large, x]) is None
    assert collected.power(x, s.Number(Fraction(1, 2))) is None and collected.power(x, s.Number(0)) is None
    assert collected.quotient(x, s.Number(0)) is None
    assert collected.sides(long, x) == [long, x] and collected.sides(long, s.Number(0)) == [long, s.Number(0)]
    square = s.Polynomial({("x",): 1, ("y",): 1})
    for _ in range(9):
        bigger = collected.product([square, square])
        if bigger is None:
            break
        assert isinstance(bigger, s.Polynomial) and len(bigger.terms) <= collected.SHORT
        square = bigger
    else:
        pytest.fail("a polynomial was squared again and again")


def test_terms_that_cancel_are_no_terms() -> None:
    x = NAMES[0]
    assert total([x, s.Number(2), s.Polynomial({("x",): -1})]) == s.Number(2)
    assert collected.product([x, s.Number(0)]) == s.Number(0)
    assert isinstance(lower_term(s.Sum([x, s.Polynomial({("x",): -1})]), fail), Value)

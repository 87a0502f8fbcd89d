"""Sets of signs, and lemmas that cut them down: against all assignments of signs, one by one."""

from __future__ import annotations

from itertools import product
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import CertificateRejected, Unable
from qe.kernel.signs import (
    ANY,
    NEGATIVE,
    POSITIVE,
    PRODUCT,
    SQUARE,
    ZERO,
    Identity,
    Line,
    read_lemma,
    read_polynomials,
)
from qe.proof.entry import Entry, poly_to_text
from tests.unit.certify.claims import RING, poly

BITS = {-1: NEGATIVE, 0: ZERO, 1: POSITIVE}


def signs(bits: int) -> list[int]:
    return [s for s, bit in BITS.items() if bits & bit]


def bits(found: list[int]) -> int:
    return sum(BITS[s] for s in set(found))


def test_tables_of_signs() -> None:
    for a, b in product(range(8), repeat=2):
        if a and b:
            assert PRODUCT[a][b] == bits([s * t for s in signs(a) for t in signs(b)])
        assert SQUARE[a] == bits([s * s for s in signs(a)])


def lemma(content: Any, *polys: str) -> Any:
    return read_lemma(Entry(content, "lemma"), [poly(p) for p in polys], RING)


def possible(terms: Any, domains: list[int]) -> list[tuple[int, ...]]:
    """The assignments of signs for which no term is alone in being positive, or negative."""
    found = []
    for chosen in product(*map(signs, domains)):
        values = []
        for unit, powers in terms:
            value = {POSITIVE: 1, NEGATIVE: -1}[unit]
            for i, odd in powers:
                value *= chosen[i] if odd else chosen[i] ** 2
            values.append(value)
        if not any(values) or (1 in values and -1 in values):
            found.append(chosen)
    return found


@st.composite
def identities(draw: st.DrawFn) -> Identity:
    count = draw(st.integers(1, 4))
    powers = st.dictionaries(st.integers(0, 2), st.booleans(), max_size=2)
    units = st.sampled_from((POSITIVE, NEGATIVE))
    return Identity(tuple((draw(units), tuple(draw(powers).items())) for _ in range(count)))


@given(identities(), st.lists(st.integers(1, 7), min_size=3, max_size=3))
def test_an_identity_takes_no_possible_sign_away(given_: Identity, domains: list[int]) -> None:
    left = list(domains)
    cut = given_.cut(left)
    assert {k for k in range(3) if left[k] != domains[k]} <= set(cut) and bool(cut) is (left != domains)
    for chosen in possible(given_.terms, domains):
        assert all(bits([s]) & d for s, d in zip(chosen, left, strict=True))
    single = list(map(len, map(signs, domains))) == [1, 1, 1]
    if single and not possible(given_.terms, domains):
        assert not all(left)  # where the signs are fixed, a contradiction is found


@pytest.mark.parametrize(
    ("terms", "before", "after"),
    [
        # p = q*r: the sign of q follows from those of p and r
        ([(1, [(0, True)]), (-1, [(1, True), (2, True)])], (POSITIVE, ANY, NEGATIVE), (POSITIVE, NEGATIVE, NEGATIVE)),
        # p = q^2 + 1 is positive
        ([(1, [(0, True)]), (-1, [(1, False)]), (-1, [])], (ANY, ANY, ANY), (POSITIVE, ANY, ANY)),
        # p^2 + q^2 = 0
        ([(1, [(0, False)]), (1, [(1, False)])], (ANY, ANY, ANY), (ZERO, ZERO, ANY)),
        # p = q + r
        ([(1, [(0, True)]), (-1, [(1, True)]), (-1, [(2, True)])], (ANY, POSITIVE, POSITIVE | ZERO), (POSITIVE,)),
        # 1 + p^2 = 0
        ([(1, []), (1, [(0, False)])], (ANY, ANY, ANY), (0, ANY, ANY)),
    ],
)
def test_what_an_identity_takes_away(terms: Any, before: Any, after: Any) -> None:
    made = Identity(tuple((POSITIVE if c > 0 else NEGATIVE, tuple(powers)) for c, powers in terms))
    left = list(before)
    assert made.cut(left)
    assert tuple(left[: len(after)]) == after
    assert made.polynomials == tuple(dict.fromkeys(i for _, powers in made.terms for i, _ in powers))


GOOD = [["1", [[0, 1]]], ["-1", [[1, 1], [2, 1]]]]


def test_identities_are_multiplied_out() -> None:
    assert lemma({"identity": GOOD}, "a^2 - b^2", "a - b", "a + b").terms == (
        (POSITIVE, ((0, True),)),
        (NEGATIVE, ((1, True), (2, True))),
    )
    assert lemma({"identity": [["1", [[0, 2]]], ["-1", [[1, 1]]]]}, "a - b", "a^2 - 2*a*b + b^2").terms[0][1] == (
        (0, False),
    )


@pytest.mark.parametrize(
    ("terms", "reason"),
    [
        ([["1", [[0, 1]]], ["-1", [[1, 2]]]], "do not add up"),
        ([["1", [[0, 1]]], ["1", [[1, 1], [2, 1]]]], "do not add up"),
        ([], "do not add up"),
        ([["0", [[0, 1]]], *GOOD], "an integer that is not 0"),
        ([["1/2", [[0, 1]]], ["-1/2", [[1, 1], [2, 1]]]], "an integer that is not 0"),
        ([["1", [[0, 1]]], ["-1", [[1, 1], [1, 1]]]], "once in a product"),
        ([["1", [[3, 1]]]], "expected a listed polynomial"),
        ([["1", [[0, 0]]]], "a positive exponent"),
        ([["1", [[0, 1, 1]]]], "expected [polynomial, exponent]"),
        ([["1"]], "expected [coefficient"),
    ],
)
def test_what_is_no_identity(terms: Any, reason: str) -> None:
    with pytest.raises(CertificateRejected) as error:
        lemma({"identity": terms}, "a^2 - b^2", "a - b", "a + b")
    assert reason in error.value.reason


def test_products_out_of_reach_are_not_multiplied_out() -> None:
    with pytest.raises(Unable):
        lemma({"identity": [["1", [[0, 9000]]]]}, "a + b")
    with pytest.raises(CertificateRejected, match="too many terms"):
        lemma({"identity": [["1", [[0, 400], [1, 400]]]]}, "a + b", "b + c")


def test_the_signs_on_a_line_are_those_between_and_at_the_roots() -> None:
    """x and x - 1, with -1, 1/2 and 2 between their roots."""
    found = lemma({"line": [0, 1], "samples": ["-1", "1/2", "2"]}, "x", "x - 1")
    assert set(found.cells) == {
        (NEGATIVE, NEGATIVE),
        (ZERO, NEGATIVE),
        (POSITIVE, NEGATIVE),
        (POSITIVE, ZERO),
        (POSITIVE, POSITIVE),
    }
    domains = [ANY, ZERO | POSITIVE]
    assert found.cut(domains)
    assert domains == [POSITIVE, ZERO | POSITIVE]
    assert not found.cut(domains)
    domains = [NEGATIVE | ZERO, POSITIVE]
    assert found.cut(domains)
    assert not all(domains)


def test_samples_need_not_be_between_all_neighbours() -> None:
    found = lemma({"line": [0], "samples": ["-2", "0", "1", "2"]}, "x^2 - 2")
    assert set(found.cells) == {(POSITIVE,), (ZERO,), (NEGATIVE,)}


@pytest.mark.parametrize(
    ("line", "samples", "reason"),
    [
        ([0, 1], ["-1", "2"], "two polynomials change"),
        ([0, 1], ["-1", "1/2"], "at every real root"),
        ([0, 2], ["-1", "1/2", "2"], "polynomials in one variable"),
        ([0, 1], ["-1", "2", "1/2"], "ascending samples"),
        ([0, 1], ["-1", "1/2", "1/2", "2"], "ascending samples"),
        ([0, 1], [], "ascending samples"),
        ([0, 1], ["-1", "0", "1/2", "2"], "a sample is a root"),
        ([0, 0], ["-1", "1"], "each once"),
        ([], ["-1", "1"], "each once"),
        ([5], ["-1", "1"], "each once"),
        ([3], ["0", "1/2", "2"], "at every real root"),  # (x - 1)^2 does not change its sign at its root
    ],
)
def test_what_is_no_line(line: Any, samples: Any, reason: str) -> None:
    with pytest.raises(CertificateRejected) as error:
        lemma({"line": line, "samples": samples}, "x", "x - 1", "y", "x^2 - 2*x + 1")
    assert reason in error.value.reason


def test_polynomials_are_normal_and_listed_once() -> None:
    def read(*texts: str) -> Any:
        return read_polynomials(Entry(list(texts), "polynomials"), RING)

    assert read(poly_to_text(poly("a*x - b"))) == (poly("a*x - b"),)
    for wrong in (("a", "a"), ("2*a",), ("-a",), ("1",)):
        with pytest.raises(CertificateRejected):
            read(*wrong)


def test_a_line_says_nothing_of_other_polynomials() -> None:
    domains = [ANY, ANY, ANY]
    assert not Line((2,), ((NEGATIVE,), (ZERO,), (POSITIVE,))).cut(domains)
    assert domains == [ANY, ANY, ANY]

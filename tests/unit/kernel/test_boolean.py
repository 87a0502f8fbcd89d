"""Refutation over signs: what is refuted holds at no point, and what is not excluded by lemmas is not refuted."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.formula.build import atom, conj, disj, neg
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula, Relation
from qe.kernel.boolean import ByLemmas, Search, Theory, equivalence
from qe.kernel.signs import read_lemma
from qe.proof.entry import Entry
from qe.proving.refutation import NODES, Refutation
from tests.unit.certify.claims import NO_LEMMAS, RING, formula, limits, objection, poly


def theory(polys: tuple[str, ...] = (), *lemmas: Any) -> Theory:
    listed = tuple(map(poly, polys))
    return Theory(listed, tuple(read_lemma(Entry(x, "lemma"), listed, RING) for x in lemmas), limits())


def refutes(known: Theory, formulas: Iterable[Formula], nodes: int = NODES) -> bool:
    """Whether a refutation is found; if so, each of its clauses follows for the kernel, and with them it is refuted."""
    goal = tuple(formulas)
    found, search = refutation(known, goal), Search(known, goal)
    is_refuted = found.go_on(nodes, nodes)
    assert is_refuted or not search.is_refuted
    for case in found.cases({p: k for k, p in enumerate(known.polynomials)}) if is_refuted else ():
        assert isinstance(case, list)
        clause = [divmod(literal, 8) for literal in case]  # type: ignore[operator]
        assert search.clauses.implies(clause)
        search.clauses.add(clause)
    assert search.is_refuted is is_refuted
    return is_refuted


def refutation(known: Theory, goal: tuple[Formula, ...]) -> Refutation:
    """A search that knows the lemmas of the theory."""
    found = Refutation(goal, limits())
    found.learn(known.polynomials, known.lemmas)
    return found


SQUARE = {"identity": [["1", [[0, 1]]], ["-1", [[1, 2]]], ["-1", []]]}
"""Polynomial 0 is the square of polynomial 1, and 1 more."""
ORDER = {"identity": [["1", [[0, 1]]], ["1", [[1, 1]]], ["-1", [[2, 1]]]]}
"""Polynomial 2 is the sum of 0 and 1."""


@pytest.mark.parametrize(
    ("texts", "refuted"),
    [
        (("a > 0", "a < 0"), True),
        (("a > 0", "a >= 0"), False),
        (("a > 0 or b > 0", "a <= 0", "b <= 0"), True),
        (("a > 0 or b > 0", "a <= 0"), False),
        (("a >= 0", "a <= 0", "a /= 0"), True),
        (("(a > 0 or a < 0) and (b = 0 or a = 0)", "b /= 0"), True),
        (("false",), True),
        (("true",), False),
        ((), False),
        (("ex x. x^2 = a", "all y. y^2 /= a"), True),  # the same condition, and its negation
        (("ex x. x^2 = a", "all y. y^2 /= b"), False),
        (("ex x. x^2 = a", "not (ex y. y^2 = a)"), True),
        (("a > root(1, a^2 - b)", "not (a > root(1, a^2 - b))"), True),
        (("a > root(1, a^2 - b)", "a < root(1, a^2 - b)"), False),  # nothing is known of root atoms
        (("b > 0", "a^2 + b > 0 or a = 0", "a^2 + b < 0"), False),
    ],
)
def test_without_lemmas(texts: tuple[str, ...], refuted: bool) -> None:
    assert refutes(theory(), map(formula, texts)) is refuted


def test_lemmas_that_took_part() -> None:
    known = theory(("a^2 + 1", "a", "b"), SQUARE, {"line": [2], "samples": ["-1", "1"]})
    for text, used in (("a^2 + 1 <= 0", frozenset((0,))), ("a < 0 and a > 0", frozenset())):
        found = refutation(known, (formula(text),))
        assert found.go_on(NODES, NODES) and frozenset(found.lemmas) == used
    assert not refutation(known, (formula("a^2 + 1 > 0"),)).go_on(NODES, NODES)


def test_cases_of_signs_that_lemmas_need() -> None:
    """a*b < 0 and a*c < 0 and b*c < 0: only cases of the signs of a, b, c show that it is impossible."""
    products = [
        {"identity": [["1", [[k, 1]]], ["-1", [[i, 1], [j, 1]]]]} for k, i, j in ((3, 0, 1), (4, 0, 2), (5, 1, 2))
    ]
    known = theory(("a", "b", "c", "a*b", "a*c", "b*c"), *products)
    assert refutes(known, map(formula, ("a*b < 0", "a*c < 0", "b*c < 0")))
    assert not refutes(known, map(formula, ("a*b < 0", "a*c < 0", "b*c > 0")))


def test_the_search_is_limited() -> None:
    hard = [formula(f"a > {k} or b > {k}") for k in range(12)] + [formula("c > 0 and c < 1 or c = 7")]
    assert not refutes(theory(), hard)
    false = [formula(f"a {x} 0 or b {y} 0 or c {z} 0") for x in "<>=" for y in "<>=" for z in "<>="]
    assert not refutation(theory(), (*false, formula("true"))).go_on(1, 1)
    assert refutes(theory(), (*false, formula("true")))


def test_one_of_many_claims_is_refuted_without_cases_of_what_stands_beside_it() -> None:
    """Twelve disjunctions on either side: 2^12 cases, if those on the left are told apart first (long answers)."""
    pairs = [(f"{x} > {k}", f"{y} > {k}") for x, y in ("ab", "bc", "ac") for k in range(4)]
    left = conj(formula(f"{p} or {q}") for p, q in pairs)
    right = conj(formula(f"{p} or {q}".replace(">", ">=")) for p, q in pairs)
    ahead, back = equivalence(left, right, ())
    assert refutes(theory(), ahead, 2)
    assert not refutes(theory(), back, 20)


@st.composite
def conditions(draw: st.DrawFn, depth: int = 2) -> Formula:
    if not depth or draw(st.booleans()):
        p = poly(draw(st.sampled_from(("a", "b", "a + b", "a^2 + 1"))))
        return atom(p, draw(st.sampled_from(tuple(Relation))))
    parts = [draw(conditions(depth - 1)) for _ in range(2)]
    return draw(st.sampled_from((conj, disj, lambda fs: neg(conj(fs)))))(parts)


NUMBERS = [Fraction(n) for n in (-2, -1, 0, 1, 2)]


@settings(max_examples=30)
@given(conditions(), conditions())
def test_what_is_refuted_holds_nowhere_and_the_rest_somewhere(left: Formula, right: Formula) -> None:
    """The signs of a, b and a + b on a grid are all that there are, so both directions hold."""
    known = theory(("a", "b", "a + b", "a^2 + 1"), ORDER, {"identity": [["1", [[3, 1]]], ["-1", [[0, 2]]], ["-1", []]]})
    truths = [
        (holds_at(left, point), holds_at(right, point))
        for point in ({"a": a, "b": b} for a in NUMBERS for b in NUMBERS)
    ]
    assert refutes(known, (left, right)) is not any(x and y for x, y in truths)
    same = all(refutes(known, goal) for goal in equivalence(left, right, ()))
    assert same is all(x is y for x, y in truths)


def test_equivalence_where_something_is_known() -> None:
    left, right = formula("a > 0"), formula("a /= 0")
    assert not all(refutes(theory(), goal) for goal in equivalence(left, right, ()))
    assert all(refutes(theory(), goal) for goal in equivalence(left, right, [formula("a >= 0")]))
    assert equivalence(left, formula("not (a <= 0)"), ()) == []


def test_a_step_stands_only_if_every_goal_is_refuted() -> None:
    """The checker made of obligations: both directions of an equivalence, under the context, by the lemmas given."""
    check = ByLemmas(lambda claim, context: equivalence(claim.before, claim.after, context))

    def said(before: str, after: str, given: str = "true", evidence: Any = NO_LEMMAS) -> str:
        return objection(check, before, after, {"theory": evidence}, given)

    assert said("a > 0 and b > 0", "b > 0 and a > 0") == said("a > 0 and b > 0", "b > 0", "a > 0") == ""
    for before, after in (("a > 0", "a >= 0"), ("a >= 0", "a > 0"), ("a > 0", "b > 0")):
        assert "do not exclude that it is wrong" in said(before, after)
    square = {"polynomials": ["a^2 + 1", "a"], "lemmas": [SQUARE], "cases": []}
    assert said("a^2 + 1 > 0", "true", evidence=square) == ""
    assert "do not exclude" in said("a^2 + 1 > 0", "true")
    assert "theory" in objection(check, "a > 0", "b > 0", {})

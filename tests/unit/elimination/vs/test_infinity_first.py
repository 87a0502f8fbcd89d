"""Solutions near infinity first: (exists x. F) iff F(-oo) or F(+oo) or what remains, which has a lower degree."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.elimination.vs.infinity_first import far_first
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, neg
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.formula.traverse import polynomials as polynomials_of
from qe.io.text import read
from qe.options import Budget
from tests.strategies import formulas, polynomials
from tests.tables import each


@each(
    ("a*x^3 + b*x + c < 0", "a /= 0 or b /= 0 or c < 0"),
    ("a*x^5 + b*x^2 + c <= 0 and x /= d", "a /= 0 or b < 0 or b = 0 and c <= 0"),
)
def test_odd_degrees(text: str, solutions: str) -> None:
    found = far_first("x", read(text), budget=Budget())
    assert found is not None
    assert qe.equivalent(found.solutions, solutions)
    for p in polynomials_of(found.rest):
        assert "x" not in p.ring.index or p.degree(p.ring.index["x"]) <= 2


@each("x^3 + a*x + b < 0", "x^4 + a*x > b and x < c", "x^5 + a*x /= 0")
def test_what_holds_far_out_whatever_the_parameters_are(text: str) -> None:
    far = far_first("x", read(text), budget=Budget())
    assert far is not None
    assert (far.solutions, far.rest) == (TRUE, FALSE)


@each("x^3 + a*x + b = 0", "a*x^4 + b*x + c < 0", "a*x^3 + b*x + c = 0", "a*x^2 + b < 0")
def test_where_the_degree_does_not_fall(text: str) -> None:
    assert far_first("x", read(text), budget=Budget()) is None


def test_seven_variables_of_degree_five() -> None:
    """Neither substitution nor decomposition ends on this one (problem neq5 of the ganrac collection)."""
    text = "f + `e`*x + x^2 + a*x^3 + b*x^5 <= 0 and x /= a and c + b*x + d*x^2 /= 0"
    answer = qe.eliminate(f"ex x. {text}", timeout=60)
    assert answer.formula is not None
    for point, expected in {
        "a = 0 and b = 1 and c = 0 and d = 0 and e = 0 and f = 9": True,
        "a = 0 and b = 0 and c = 1 and d = 0 and e = 0 and f = 9": False,
        "a = 0 and b = 0 and c = 1 and d = 0 and e = 2 and f = 1": True,
        "a = 0 and b = 0 and c = 1 and d = 1 and e = 0 and f = 0": False,
        "a = 5 and b = 0 and c = 0 and d = 0 and e = 2 and f = 1": False,
    }.items():
        assert qe.decide(f"ex a, b, c, d, e, f. {point} and ({answer.formula})") is expected, point


RING = Ring.of(("a", "x"))


@settings(max_examples=25)
@given(
    polynomials(RING, max_degree=2),
    formulas(names=("a", "x"), max_degree=2, max_depth=1),
    st.sampled_from([Relation.LT, Relation.LE, Relation.GE, Relation.NE]),
    st.booleans(),
)
def test_the_parts_are_equivalent_to_the_block(rest: Poly, side: Formula, relation: Relation, both: bool) -> None:
    cubic = atom(RING.var("a") * RING.var("x") ** 3 + rest, relation)
    body = (conj if both else disj)((cubic, side))
    found = far_first("x", body, budget=Budget(5))
    if found is not None:
        whole, parts = exists(["x"], body), disj((found.solutions, found.rest))
        different = disj((conj((whole, neg(parts))), conj((parts, neg(whole)))))
        assert not qe.decide(exists(["a"], different), timeout=60)


@each("a", "a*(2*a - 1)", "a^2*(a + 1)", "a*(a^2 - 2)", "a^2 + a")
@pytest.mark.parametrize("rest", ["a*x^2 - x", "x^2 + a*x + 1", "-x^2 - 2"])
def test_the_degree_falls_or_nothing_is_said(lead: str, rest: str) -> None:
    """A leading coefficient that is a product was put beside the block and not into it: the same block, for ever."""
    body = read(f"({lead})*x^3 + {rest} > 0")
    found = far_first("x", body, budget=Budget(30))
    if found is not None:
        left = [p.degree(p.ring.index["x"]) for p in polynomials_of(found.rest) if "x" in p.ring.index]
        assert all(degree < 3 for degree in left)


def test_a_block_that_leaves_itself_near_infinity_is_answered() -> None:
    text = "ex x, y. (2*x^2*y + a^2 + y - 2 > 0 or a^2*x - a*x^2 - 3 > 0) and 2*a*x*y - 2*a + y + 1 = 0"
    answer = qe.eliminate(text, check=True)
    assert str(answer.formula) == "a /= 0" and answer.guarantee is qe.Guarantee.CHECKED

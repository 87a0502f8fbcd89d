"""Existential sentences about convex sets: the same truth as by decomposition, with proofs either way."""

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.elimination.convex import decide_convex
from qe.formula.syntax import Exists
from qe.options import Budget
from qe.proof.certificate import Certificate, Root
from tests.tables import each

SMALL = st.integers(-3, 3)
DISC = st.tuples(SMALL, SMALL, st.integers(1, 8), st.sampled_from(["<", "<="])).map(
    lambda t: f"(x - ({t[0]}))^2 + (y - ({t[1]}))^2 {t[3]} {t[2]}"
)
LINE = st.tuples(SMALL, SMALL, SMALL, st.sampled_from(["<", "<=", "="])).map(
    lambda t: f"{t[0]}*x + ({t[1]})*y {t[3]} {t[2]}"
)


@settings(max_examples=30, deadline=None)
@given(st.lists(st.one_of(DISC, DISC, LINE), min_size=2, max_size=4))
def test_agrees_with_decomposition(parts: list[str]) -> None:
    text = "ex x, y. " + " and ".join(parts)
    sentence = read_formula(text)
    if not isinstance(sentence, Exists):
        return
    found = decide_convex(sentence, budget=Budget())
    assert found is not None
    assert (found.values is not None) == qe.decide(text, method="cad")
    assert qe.verify(found.certificate).accepted
    if found.values is not None:
        matrix = Certificate.witness(sentence.body, tuple(found.values), [Root.of(v) for v in found.values.values()])
        assert qe.verify(matrix).accepted


SIX = "a^2 + b^2 + c^2 <= 4 and d^2 + e^2 + f^2 <= 4 and (a - d)^2 + (b - e)^2 + (c - f)^2 <= 1 and a + b + c >= {}"


def test_many_variables_get_a_witness_that_is_checked() -> None:
    answer = qe.eliminate(f"ex a, b, c, d, e, f. {SIX.format(3)} and d + e + f <= 2")
    assert answer.truth is True and answer.witness is not None and len(answer.witness) == 6
    assert answer.guarantee is qe.Guarantee.CHECKED


@each("7/2", "4")
def test_an_empty_set_gets_a_proof(bound: str) -> None:
    # a + b + c <= 2*sqrt(3) on the ball, so no bound above 3.4642 is reached
    answer = qe.eliminate(f"ex a, b, c, d, e, f. {SIX.format(bound)}", check=True)
    assert answer.truth is False
    assert answer.certificate is not None and answer.certificate.evidence_for("multipliers") is not None
    assert answer.guarantee is qe.Guarantee.CHECKED


LINEAR = st.tuples(SMALL, SMALL, SMALL, SMALL, st.sampled_from(["<", "<=", "=", ">", ">="])).map(
    lambda t: f"{t[0]}*x + ({t[1]})*y + ({t[2]})*z {t[4]} {t[3]}"
)


@settings(max_examples=40, deadline=None)
@given(st.lists(LINEAR, min_size=2, max_size=6), st.sampled_from(["convex", "auto"]))
def test_linear_conditions_are_decided_as_by_substitution_with_proof(parts: list[str], method: str) -> None:
    text = "ex x, y, z. " + " and ".join(parts)
    answer = qe.eliminate(text, method=method, check=True, process=False)
    assert answer.truth == qe.decide(text, method="vs", process=False)
    assert answer.certificate is not None and answer.guarantee is qe.Guarantee.CHECKED
    assert answer.truth or method == "auto" or answer.certificate.trusts == ()


@each("<", "<=")
def test_a_cycle_of_differences_is_refuted_by_its_sum(relation: str) -> None:
    # 100 variables took no answer in 12 s: every form was restricted to a flat as a dense matrix
    chain = " and ".join(f"x{k} {relation} x{k + 1}" for k in range(99))
    text = f"ex {', '.join(f'x{k}' for k in range(100))}. {chain} and x99 < x0"
    answer = qe.eliminate(text, check=True, timeout=20)
    assert answer.truth is False and answer.guarantee is qe.Guarantee.CHECKED
    assert answer.certificate is not None and answer.certificate.trusts == ()


def test_other_sentences_are_left_to_others() -> None:
    for text in ("ex x, y. x*y > 1", "ex x, y. x^2 + y^2 >= 1", "ex x, y. x < 1 or y < 1", "ex x, y. x^2 + y^2 = 1"):
        sentence = read_formula(text)
        assert isinstance(sentence, Exists) and decide_convex(sentence, budget=Budget()) is None
    assert qe.decide("ex a, b, c, d. a*b + c*d > 1 and a^2 + b^2 + c^2 + d^2 < 3")

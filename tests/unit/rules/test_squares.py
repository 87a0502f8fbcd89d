"""Rule "signs by sums of squares": answers as without it, proofs accepted, forged ones refused."""

import json
import random
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.io.text import read
from qe.kernel.verdict import Verdict
from qe.proof.answer import Guarantee
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.tables import each

RULE = "signs by sums of squares"

SENTENCES = [
    "all a, b, c, d. a^4 + b^4 + c^4 + d^4 >= 4*a*b*c*d",
    "all a, b, c, d. a^4 + b^4 + c^4 + d^4 + a*b*c*d + a*b^3 + 1 > 0",
    "all a, b, c. a >= 0 and b >= 0 and c >= 0 -> a^2*b + b^2*c + c^2*a + a^3 >= 3*a*b*c",
    "all a, b, c. a > 0 and b > 0 and c > 0 -> a/(b + c) + b/(c + a) + c/(a + b) >= 3/2",
]


@pytest.mark.parametrize("text", SENTENCES)
def test_true_with_a_proof(text: str) -> None:
    answer = qe.eliminate(text, check=True, timeout=60)
    assert answer.truth is True and answer.guarantee is Guarantee.CHECKED
    assert RULE in [step.rule for step in answer.derivation.steps]
    assert qe.eliminate(text, without="squares", timeout=60).formula == answer.formula


@each(
    ("ex x, y, z. x^4 + y^4 + z^4 + 1 <= 4*x*y*z and x*y = a and a > 0", "a - 1 = 0"),
    ("ex x, y, z. x^4 + y^4 + z^4 + 2 <= 4*x*y*z or x = a", "true"),
    ("ex x. x >= 0 and a >= 0 and x^3 + a^3 + 1 >= 3*x*a and x + a = b", "a >= 0 and a - b <= 0"),
)
def test_what_is_left_of_a_condition(text: str, left: str) -> None:
    answer = qe.eliminate(text, check=True, timeout=60)
    assert answer.guarantee is Guarantee.CHECKED
    assert qe.equivalent(answer.formula, left)


MEANS = "a^4 + b^4 + c^4 + d^4 - 4*a*b*c*d"


@each(
    (f"{MEANS} >= 0", "true"),
    (f"{MEANS} < 0", "false"),
    (f"{MEANS} <= 0", f"{MEANS} = 0"),
    (f"{MEANS} > 0", f"{MEANS} > 0"),
    (f"{MEANS} /= 0", f"{MEANS} /= 0"),
    (f"{MEANS} + 1 <= 0", "false"),
    ("2*a^4 + 2*b^4 + 2*c^4 + 2*d^4 < 1", None),  # with 1 added it would be nowhere negative
    ("a >= 0 and b >= 0 and d >= 0 and a*b*d < 1", None),
)
def test_what_one_sign_leaves_of_each_comparison(condition: str, left: str | None) -> None:
    found = prepare(read(f"ex d. {condition}"), enabled={StepKind.SQUARES}).formula
    wanted = left or condition
    assert str(found) == str(read(wanted if wanted in ("true", "false") else f"ex d. {wanted}"))


def altered(text: str, change: Callable[[list[Any]], Iterator[None]]) -> list[Verdict]:
    """What the checker says of a proof for every change of the lemmas of its step by the rule."""
    answer = qe.eliminate(text, check=True, timeout=60)
    assert answer.certificate is not None and answer.formula is not None
    payload = json.loads(answer.certificate.to_json())["payload"]
    steps = payload["steps"]
    (place,) = [k for k, step in enumerate(steps) if step["rule"] == "signs" and step["evidence"]["theory"]["lemmas"]]

    def verdict() -> Verdict:
        return qe.verify(qe.Certificate.derivation(payload["order"], read(text), steps, answer.formula))

    assert verdict().accepted
    return [verdict() for _ in change(steps[place]["evidence"]["theory"]["lemmas"])]


def other_numbers(lemmas: list[Any]) -> Iterator[None]:
    for lemma in lemmas:
        for term in lemma["identity"]:
            for other in (str(int(term[0]) + 1), str(-int(term[0]))):
                kept, term[0] = term[0], other
                yield
                term[0] = kept


def other_exponents(lemmas: list[Any]) -> Iterator[None]:
    for lemma in lemmas:
        for power in (power for term in lemma["identity"] for power in term[1]):
            power[1] += 1
            yield
            power[1] -= 1


def nothing(lemmas: list[Any]) -> Iterator[None]:
    lemmas.clear()
    yield


@each(other_numbers, other_exponents, nothing)
@pytest.mark.parametrize("text", SENTENCES[::2])
def test_altered_identities_are_refused(text: str, change: Callable[[list[Any]], Iterator[None]]) -> None:
    verdicts = altered(text, change)
    assert verdicts and not any(verdict.accepted for verdict in verdicts)


@settings(max_examples=12)
@given(st.integers(0, 10**6))
def test_as_without_the_rule(seed: int) -> None:
    rng = random.Random(seed)
    names = ["x", "y", "a"]

    def monomial() -> str:
        return "*".join(rng.choice(names) for _ in range(rng.randint(1, 2)))

    squares = " + ".join(f"({monomial()} - {rng.randint(0, 2)}*{monomial()})^2" for _ in range(3))
    relation = rng.choice(["<=", "<", ">=", ">", "=", "/="])
    text = f"ex x, y. x >= 0 and {squares} + {rng.randint(0, 1)} {relation} 0 and x + y*a > {rng.randint(-1, 1)}"
    mine, other = qe.eliminate(text, timeout=60), qe.eliminate(text, without="squares", timeout=60)
    assert qe.equivalent(mine.formula, other.formula)

"""The rule "roots by signs", whose steps are decompositions: proved as they are produced; altered claims are not."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.elimination.rootsigns import method, question
from qe.exact.ring import Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, disj
from qe.formula.evaluate import substituted
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, Formula, Or, Relation
from qe.io.text import read
from qe.options import Budget, Options
from qe.proof.step import Step
from qe.proving.prover import Prover

FORMS = (
    "ex x. x > 0 and x^4 + a*x^2 + b*x + c = 0",
    "all x. x^4 + a*x^2 + b*x + c >= 0",
    "ex x. a*x^3 + c*x + d <= 0 and x >= 0 and x <= 1",
)


def claimed(before: Formula, after: Formula) -> bool:
    """Whether the step is made of steps of the kernel that are accepted."""
    names = dict.fromkeys((*before.ring.names, *(after.ring.names if after.ring else ())))
    ring = Ring.of(names)
    prover = Prover(ring, Options(), Budget(60))
    found = prover.own(Step("roots by signs", convert(before, ring), convert(after, ring)), ())
    return found is not None


def produced(before: Formula) -> Formula:
    problem = Block.of(before)
    assert problem is not None
    x = problem.body.ring.index[problem.variables[0]]
    asked = question.read(problem.dual.body, x)
    assert asked is not None
    return problem.asked(method.answer(asked, x, Budget()))


def altered(formula: Formula) -> Iterator[Formula]:
    """One comparison with another relation or other side, or one part left out."""
    match formula:
        case Atom(poly, relation):
            yield from (Atom(poly, r) for r in Relation if r is not relation)
            yield from (atom(poly + k, relation) for k in (1, -1))
        case And(args) | Or(args):
            join = conj if isinstance(formula, And) else disj
            for k, arg in enumerate(args):
                yield join((*args[:k], *args[k + 1 :]))
                yield from (join((*args[:k], other, *args[k + 1 :])) for other in altered(arg))
        case Exists(variables, body):
            yield from (Exists(variables, other) for other in altered(body) if other not in (TRUE, FALSE))


@pytest.mark.parametrize("text", [*FORMS[:2], "ex x. a*x^4 + b*x + 1 <= 0 and x > 1"])
def test_an_altered_claim_is_accepted_only_where_it_is_the_same_on_all_rows(text: str) -> None:
    """Some alterations change nothing (p <= 0 for p < 0 where 0 is met elsewhere): those are checked at numbers."""
    before = read(text)
    after = produced(before)
    assert claimed(before, after)
    rng, right, wrong = random.Random(text), [], 0
    for other in list(altered(after))[rng.randrange(8) :: 16]:
        if claimed(before, other):
            right.append(other)
        else:
            wrong += 1
    assert wrong > 2 * len(right)
    for other in right:
        for _ in range(3):
            values = {name: rng.randint(-3, 3) for name in before.free}
            here, there = (qe.decide(substituted(f, values), without="roots", process=False) for f in (before, other))
            assert here is there, (other, values)


def polynomial(rng: random.Random, degree: int) -> str:
    terms = [f"{rng.choice(('a', 1, 2, -1, 0))}*x^{k}" for k in range(degree)]
    return " + ".join([*terms, f"{rng.choice((1, -1, 'a'))}*x^{degree}"])


@settings(max_examples=6, deadline=None)
@given(st.integers(0, 10**6))
def test_what_is_produced_is_accepted(seed: int) -> None:
    rng = random.Random(seed)
    relation = rng.choice(("=", "<", "<=", ">", ">="))
    beside = rng.choice(("", "and x > a", "and x <= 2", "and x > 0 and x <= b", "and x >= 0 and x <= 1", "g"))
    if beside == "g":
        relation, beside = "=", f"and {polynomial(rng, 2)} {rng.choice(('>', '>=', '/=', '<'))} 0"
    before = read(f"ex x. {polynomial(rng, rng.choice((3, 3, 4)))} {relation} 0 {beside}")
    if not isinstance(before, Exists) or question.read(before.body, before.ring.index["x"]) is None:
        return
    assert claimed(before, produced(before))

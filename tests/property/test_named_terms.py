"""A name for a term changes nothing: what is solved without names is solved with them, by the same methods, in
at most twice the time. That holds for names of whole sides and of parts of sums, in the block itself, in one inside it,
at the single comparison, and for names of what nothing else looks at.
"""

from __future__ import annotations

import random
import time

import pytest

import qe
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import atoms, is_quantifier_free, ring_of
from qe.io.text import read
from tests.corpus.catalogue import problems
from tests.tables import each

PROBLEMS = {p.id: p.formula for p in problems() if "slow" not in p.tags}
SLACK = 0.3
"""Seconds of processor time that say nothing."""


def part(poly: Poly, rng: random.Random) -> Poly:
    """The polynomial, or some of its terms."""
    terms = list(poly.terms())
    if len(terms) < 3 or rng.random() < 0.5:
        return poly
    return poly.ring.from_terms(dict(rng.sample(terms, rng.randint(2, len(terms) - 1))))


def named(formula: Formula, rng: random.Random) -> Formula:
    """The same with up to three terms of its blocks under names; the formula where there are none."""
    ring = ring_of(formula)
    if ring is None:
        return formula
    names = [f"name{k}" for k in range(3)]
    wider, left = Ring.of((*ring.names, *names)), names.copy()

    def in_block(f: Formula) -> Formula:
        if not isinstance(f, Exists | ForAll):
            return joined(f, in_block) if isinstance(f, And | Or) else f
        build = exists if isinstance(f, Exists) else forall
        if not is_quantifier_free(f.body):
            return build(f.variables, in_block(f.body))
        sides = [a for a in atoms(f.body) if isinstance(a, Atom) and not a.poly.is_constant]
        chosen = rng.sample(sides, min(len(left), len(sides), rng.randint(1, 3)))
        body, taken, equations = f.body, list[str](), list[Poly]()
        for a in dict.fromkeys(chosen):
            term, name = part(a.poly, rng), left.pop()
            defined = wider.var(name) - term
            other = atom(a.poly - term + wider.var(name), a.relation)
            way = rng.randrange(3)
            if way == 0:  # at the comparison itself
                body = replaced(body, a, exists([name], conj((atom(defined, Relation.EQ), other))))
                continue
            body = body if way == 1 else replaced(body, a, other)
            taken, equations = [*taken, name], [*equations, defined]
        if not taken:
            return build(f.variables, body)
        if rng.random() < 0.5:
            inner = exists(taken, conj((*(atom(e, Relation.EQ) for e in equations), body)))
            return build(f.variables, inner)
        if isinstance(f, Exists):
            return exists((*f.variables, *taken), conj((*(atom(e, Relation.EQ) for e in equations), body)))
        return forall((*f.variables, *taken), disj((*(atom(e, Relation.NE) for e in equations), body)))

    return in_block(convert(formula, wider))


def joined(f: And | Or, change) -> Formula:
    return (conj if isinstance(f, And) else disj)(change(a) for a in f.args)


def replaced(f: Formula, old: Atom, new: Formula) -> Formula:
    if f == old:
        return new
    return joined(f, lambda a: replaced(a, old, new)) if isinstance(f, And | Or) else f


def asked(formula: Formula, method: str, seconds: float) -> tuple[qe.Answer, float, list[str]]:
    start = time.process_time()
    answer = qe.eliminate(formula, method=method, timeout=seconds, process=False)
    plan = [str(choice).split(" for ")[0] for choice in answer.stats.get("plan", ())]
    return answer, time.process_time() - start, plan


def compared(text: str, seed: int, method: str = "auto", seconds: float = 20.0) -> bool:
    """Whether there was something to compare: a problem that is solved by the method, with terms to be named."""
    formula = read(text)
    other = named(formula, random.Random(seed))
    if other == formula:
        return False
    plain, took, plan = asked(formula, method, seconds)
    if plain.formula is None:
        return False
    answer, seconds, way = asked(other, method, 2 * took + 10 * SLACK)
    assert answer.formula is not None, (text, str(other), answer.reason)
    assert way == plan, (str(other), way, plan)
    assert seconds <= 2 * took + SLACK, (str(other), seconds, took)
    assert answer.formula == plain.formula or qe.equivalent(answer.formula, plain.formula), str(other)
    for name, value in (answer.witness or {}).items():
        assert name in other.variables, (name, value)  # type: ignore[attr-defined]
    return True


def test_named_terms() -> None:
    share = sorted(PROBLEMS)[::3]
    assert sum(compared(PROBLEMS[name], seed) for seed, name in enumerate(share)) > len(share) // 2


@pytest.mark.deep
@pytest.mark.parametrize("name", PROBLEMS)
def test_all_named_terms(name: str) -> None:
    for seed in range(6):
        compared(PROBLEMS[name], seed, seconds=120)


@pytest.mark.deep
@each("vs", "cad", "critical", "convex", "witness", "cgs", "coverings", "roots")
def test_named_terms_by_one_method(method: str) -> None:
    assert sum(compared(text, seed, method, 10) for seed, text in enumerate(PROBLEMS.values())) > 5


def test_a_name_that_nothing_else_looks_at_costs_nothing() -> None:
    """A point is found for four curved conditions; with ``volume`` beside them decomposition did not end."""
    text = "x^3*y + y^3*z + z^3*w + w^3*x*u > 5 and x*y*z*w*u > 1 and x^2*u - y*w > 1"
    text += " and x^2 + y^2 + z^2 + w^2 + u^2 < 20"
    plain = qe.find_instance(text, timeout=20)
    named = qe.find_instance(f"{text} and volume = (x + 1)*(y + 2)*(z + 3)*(w + u)", timeout=20)
    assert plain is not None and named is not None
    assert {name: value for name, value in named.items() if name != "volume"} == dict(plain)
    x, y, z, w, u = (plain[name] for name in "xyzwu")
    assert named["volume"] == (x + 1) * (y + 2) * (z + 3) * (w + u)

"""A step that is wrong is never accepted: random false claims, with the evidence of true ones and with new evidence.

A true step is taken from the engine's log for a random formula, and its formula after is altered. The claim is false if
at some point the altered formula and the true one differ (their quantifiers eliminated by the engine). It is offered
with the evidence of the true step, and with what the search for evidence finds for it.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace

import pytest

from qe.certify.registry import RULES
from qe.certify.step import Claim
from qe.engine.run import solve
from qe.errors import BudgetExceeded, CertificateRejected, InternalError, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall
from qe.formula.evaluate import substituted
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, ForAll, Formula, Or, Relation
from qe.options import Budget, Options
from qe.proof.derivation import moved, put_together
from qe.proof.entry import Entry
from qe.proof.step import Step
from qe.proving.prover import Prover

NAMES = ("a", "b", "x", "y")
GRID = (-3, -2, -1, 0, 1, 2, 3)


def polynomial(rng: random.Random, ring: Ring) -> Poly:
    """A small polynomial, often linear, sometimes a product or a sum of squares."""
    shape = rng.random()
    if shape < 0.15:
        return simple(rng, ring) * simple(rng, ring)
    if shape < 0.2:
        p, q = simple(rng, ring), simple(rng, ring)
        return p * p + q * q
    return simple(rng, ring)


def simple(rng: random.Random, ring: Ring) -> Poly:
    """One or two monomials and a constant."""
    total = ring.constant(rng.randint(-2, 2))
    for _ in range(rng.randint(1, 2)):
        i, e = rng.randrange(ring.size), rng.choice((1, 1, 1, 1, 2, 2, 3))
        total = total + ring.gen(i) ** e * rng.choice((-2, -1, 1, 1, 3))
    return total


def formula(rng: random.Random, ring: Ring, depth: int) -> Formula:
    """A quantifier-free formula."""
    if depth == 0 or rng.random() < 0.2:
        return atom(polynomial(rng, ring), rng.choice((*Relation, Relation.EQ)))
    parts = [formula(rng, ring, depth - 1) for _ in range(rng.randint(2, 3))]
    return conj(parts) if rng.random() < 0.7 else disj(parts)


def question(rng: random.Random) -> Formula:
    """A formula with one block, sometimes with another inside or beside it."""
    ring = Ring.of(NAMES)
    body = formula(rng, ring, 2)
    if rng.random() < 0.2:
        body = conj((body, forall(("y",), formula(rng, ring, 1))))
    block = (exists if rng.random() < 0.7 else forall)(("x", "y"), body)
    return conj((block, formula(rng, ring, 1))) if rng.random() < 0.3 else block


def altered(rng: random.Random, given: Formula) -> Formula:
    """The formula with one thing changed."""
    match given:
        case Atom(poly, relation):
            if rng.random() < 0.5:
                return Atom(poly, rng.choice([r for r in Relation if r is not relation]))
            return atom(poly + rng.choice((-1, 1)), relation)
        case And(args) | Or(args):
            shape, k = rng.random(), rng.randrange(len(args))
            join, other = (conj, disj) if isinstance(given, And) else (disj, conj)
            if shape < 0.2:
                return join(args[:k] + args[k + 1 :])
            if shape < 0.3:
                return other(args)
            return join((*args[:k], altered(rng, args[k]), *args[k + 1 :]))
        case Exists(variables, body) | ForAll(variables, body):
            if rng.random() < 0.1:
                return (forall if isinstance(given, Exists) else exists)(variables, body)
            return (exists if isinstance(given, Exists) else forall)(variables, altered(rng, body))
        case Constant(value):
            return FALSE if value else TRUE
    return given


def eliminated(given: Formula) -> Formula | None:
    """The formula without quantifiers, if that is cheap."""
    if given.is_quantifier_free:
        return given
    try:
        return solve(given, Options(), Budget(0.5)).formula
    except Unable:
        return None


def differs(rng: random.Random, left: Formula, right: Formula, known: Formula) -> bool:
    """Whether two quantifier-free formulas are seen to differ at some point where ``known`` holds."""
    free = sorted({*left.free, *right.free, *known.free})
    for _ in range(60):
        at = {name: rng.choice(GRID) for name in free}
        values = [substituted(f, {n: at[n] for n in f.free}) for f in (left, right, known)]  # type: ignore[misc]
        if values[2] == TRUE and values[0] != values[1]:
            return True
    return False


def true_steps(rng: random.Random) -> Iterator[tuple[Prover, Step]]:
    """The steps of a random question's derivation."""
    asked = question(rng)
    if isinstance(asked, Constant):
        return
    options = Options()
    try:
        found = solve(asked, options, Budget(0.5))
    except Unable:
        return
    derivation = put_together(asked, found.log.steps(), found.formula)
    ring = next((f.ring for f in (derivation.start, *(s.before for s in derivation.steps)) if f.ring is not None), None)
    if ring is not None:
        prover = Prover(ring, options, Budget(1), tables=rng.random() < 0.03)
        yield from ((prover, step) for step in derivation.steps)


def false_claims(seed: int, wanted: int) -> int:
    """How many false claims were offered; fails at the first that is accepted."""
    rng, tries = random.Random(seed), 0
    while tries < wanted:
        for prover, step in true_steps(rng):
            try:
                tries += offered(rng, prover, step)
            except BudgetExceeded:
                continue
    return tries


def offered(rng: random.Random, prover: Prover, step: Step) -> int:
    """How many false claims were made of a step and refused."""
    known = moved(step.context, prover.ring)
    context = (known,) if known != TRUE else ()
    truth, evidence, tries = eliminated(step.after), prover.evidence(step, context), 0
    for _ in range(6):
        wrong = altered(rng, step.after)
        answer = None if truth is None or wrong == step.after else eliminated(wrong)
        if answer is None or truth is None or not differs(rng, truth, answer, known):
            continue
        tries += 1
        if evidence is not None:
            claim = Claim(evidence[0], step.before, wrong, prover.ring, Entry(evidence[1], "evidence"), "step")
            with pytest.raises((CertificateRejected, Unable)):
                RULES[evidence[0]](claim, context, prover.limits)
        assert not proved(prover, replace(step, after=wrong), context), (step.rule, step.before, wrong)
    return tries


def proved(prover: Prover, step: Step, context: tuple[Formula, ...]) -> bool:
    """Whether evidence is found for a step; a decomposition may also see that a sentence is decided otherwise."""
    try:
        return prover.evidence(step, context) is not None
    except InternalError:
        return False


def test_false_claims_are_refused() -> None:
    assert false_claims(seed=1, wanted=25) >= 25


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(20))
def test_many_false_claims_are_refused(seed: int) -> None:
    assert false_claims(seed=1000 + seed, wanted=1000) >= 1000

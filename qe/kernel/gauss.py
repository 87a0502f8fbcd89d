"""Checker for certificates of kind "substitution": existential variables removed by linear equations.

Payload: ``order`` (all variable names), ``variables`` (the existential block), ``matrix`` (quantifier-free), ``solved``
(in the order of their use, ``[variable, equation]``), ``answer``. The claim: ex variables. matrix <-> answer.

THEOREM (Gauss): if a conjunct of phi is the equation c*x + p = 0 with a rational constant c /= 0 and p free of x,
then ex x. phi is equivalent to the rest of phi with x replaced by -p/c. The checker carries the replacements out and
compares the result with the answer as a set of conjuncts.
"""

from __future__ import annotations

from dataclasses import replace

from qe.exact.ring import Ring
from qe.formula.build import conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.linear_equation import substituted, term
from qe.kernel.step import Claim
from qe.options import Budget
from qe.proof.entry import Entry, Json, formula_from_json


def check_substitution(payload: dict[str, Json], budget: Budget | None = None) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    names, block, matrix, solved, answer = Entry(payload, "payload").fields(
        "order", "variables", "matrix", "solved", "answer"
    )
    ring = Ring.of(names.names())
    variables = block.names()
    body = formula_from_json(matrix, ring)
    if set(body.free) | set(variables) != set(ring.names):
        raise names.fail("expected the variables of the formula and of the block")
    steps = [step.row("variable", "equation") for step in solved.items()]
    if [variable.text() for variable, _ in steps] != list(variables):
        raise solved.fail("expected one [variable, equation] for each variable of the block, in its order")
    for entry in solved.items():
        if budget is not None:
            budget.check("verify")
        body = _without(body, variables, Claim("substitution", body, body, ring, entry, entry.path))
    claimed = formula_from_json(answer, ring)
    if set(variables) & set(claimed.free):
        raise answer.fail("a quantified variable is left")
    if _conjuncts(claimed) != _conjuncts(body):
        raise answer.fail("not what the substitutions give")


def _without(body: Formula, variables: tuple[str, ...], claim: Claim) -> Formula:
    """The rest of the body with a variable replaced by its value from the equation."""
    pivot = term(claim.evidence, variables, body, claim)
    needed = Atom(pivot.equation, Relation.EQ)
    if needed not in conjuncts(body):
        raise claim.evidence.fail("not a conjunct here")
    return substituted(replace(pivot, others=conj(c for c in conjuncts(body) if c != needed)), claim)


def _conjuncts(formula: Formula) -> frozenset[Formula]:
    return frozenset(conjuncts(conj([formula])))

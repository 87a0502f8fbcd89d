"""Checker for certificates of kind "substitution": existential variables removed by linear equations.

Payload: ``order`` (all variable names), ``variables`` (the existential block), ``matrix`` (quantifier-free), ``solved``
(in the order of their use, ``[variable, equation]``), ``answer``. The claim: ex variables. matrix <-> answer.

THEOREM (Gauss): if a conjunct of phi is the equation c*x + p = 0 with a rational constant c /= 0 and p free of x,
then ex x. phi is equivalent to the rest of phi with x replaced by -p/c. The checker carries the replacements out and
compares the result with the answer as a set of conjuncts.
"""

from __future__ import annotations

from qe.certify.substitution import quotient
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation, RootAtom
from qe.formula.traverse import conjuncts, free_variables, map_atoms
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
    if set(free_variables(body)) | set(variables) != set(ring.names):
        raise names.fail("expected the variables of the formula and of the block")
    steps = [tuple(step.items()) for step in solved.items()]
    if [step[0].text() for step in steps if len(step) == 2] != list(variables) or len(steps) != len(variables):
        raise solved.fail("expected one [variable, equation] for each variable of the block, in its order")
    for variable, equation in steps:
        if budget is not None:
            budget.check("verify")
        body = _without(body, ring.index[variable.text()], equation.polynomial(ring), equation)
    claimed = formula_from_json(answer, ring)
    if set(variables) & set(free_variables(claimed)):
        raise answer.fail("a quantified variable is left")
    if _conjuncts(claimed) != _conjuncts(body):
        raise answer.fail("not what the substitutions give")


def _without(body: Formula, i: int, equation: Poly, entry: Entry) -> Formula:
    """The rest of the body with variable ``i`` replaced by its value from the equation."""
    if equation.degree(i) != 1 or not equation.leading(i).is_constant:
        raise entry.fail("expected an equation of degree 1 with a constant coefficient")
    parts = conjuncts(body)
    needed = Atom(equation, Relation.EQ)
    if needed not in parts:
        raise entry.fail("not a conjunct here")

    def replaced(found: Atom | RootAtom) -> Formula:
        if isinstance(found, RootAtom):
            raise entry.fail("no substitution into root atoms")
        if not found.poly.degree(i):
            return found
        return atom(_replaced(found.poly, i, equation), found.relation)

    return conj(map_atoms(c, replaced) for c in parts if c != needed)


def _replaced(poly: Poly, i: int, equation: Poly) -> Poly:
    """A positive multiple of ``poly`` at x_i = -p/c, for the equation c*x_i + p = 0."""
    p, lead = equation.coefficients(i)
    top, bottom = (-p, lead) if lead.constant_value() > 0 else (p, -lead)
    return quotient(poly, i, top, bottom)


def _conjuncts(formula: Formula) -> frozenset[Formula]:
    return frozenset(conjuncts(conj([formula])))

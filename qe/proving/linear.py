"""A certificate for answers that linear equations alone give, such as those of control point problems."""

from __future__ import annotations

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert
from qe.formula.syntax import And, Atom, Atomic, Exists, Formula, Relation
from qe.formula.traverse import conjuncts, map_atoms
from qe.proof.certificate import Certificate


def substitution_certificate(block: Formula, answer: Formula) -> Certificate | None:
    """A certificate for ``block`` <-> ``answer``, or None where linear equations with constant pivots do not give it.

    ``block`` must be ``ex variables. conjunction``. Source: the Gauss case of Loos & Weispfenning 1993, section 3.
    """
    if not isinstance(block, Exists) or not block.body.is_quantifier_free or not isinstance(block.body, And):
        return None
    ring = Ring.of(dict.fromkeys((*block.body.free, *block.variables)))
    body = matrix = convert(block.body, ring)
    solved: list[tuple[str, Poly]] = []
    left = list(block.variables)
    while left:
        found = _solvable(body, ring, left)
        if found is None:
            return None
        name, equation = found
        body = _replaced(body, ring.index[name], equation)
        solved.append(found)
        left.remove(name)
    if _set(body) != _set(convert(answer, ring)):
        return None
    return Certificate.substitution(matrix, ring.names, solved, body)


def _solvable(body: Formula, ring: Ring, names: list[str]) -> tuple[str, Poly] | None:
    """A variable and an equation among the conjuncts that is linear in it with a constant coefficient."""
    for conjunct in conjuncts(body):
        if isinstance(conjunct, Atom) and conjunct.relation is Relation.EQ:
            for name in names:
                i = ring.index[name]
                if conjunct.poly.degree(i) == 1 and conjunct.poly.leading(i).is_constant:
                    return name, conjunct.poly
    return None


def _replaced(body: Formula, i: int, equation: Poly) -> Formula:
    rest, lead = equation.coefficients(i)
    top, bottom = (-rest, lead) if lead.constant_value() > 0 else (rest, -lead)

    def change(given: Atomic) -> Formula:
        if not isinstance(given, Atom) or not given.poly.degree(i):
            return given
        return atom(given.poly.at_quotient(i, top, bottom), given.relation)

    used = Atom(equation, Relation.EQ)
    return conj(map_atoms(c, change) for c in conjuncts(body) if c != used)


def _set(formula: Formula) -> frozenset[Formula]:
    return frozenset(conjuncts(formula))

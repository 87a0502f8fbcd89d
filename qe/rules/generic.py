"""Inequations /= that only remove a set without interior."""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import And, Atom, Formula, Or, Relation
from qe.formula.traverse import conjuncts
from qe.rules.block_context import Recur, Workshop, either
from qe.rules.step import StepKind
from qe.rules.tree import Node, Nudged


def drop_inequations(variables: tuple[str, ...], body: Formula, shop: Workshop, recur: Recur) -> Node | None:
    """Let f be open in the variables v of the block (its atoms that contain v are strict, and it is free of negations
    and quantifiers). Then  ex v (f and p /= 0)  iff  (ex v f) and (some coefficient of p with respect to v is not 0):
    a nonempty open set is not inside the zero set of a polynomial that is not the zero polynomial.

    Lift: a solution of f, moved a little where p happens to vanish on it.
    """
    if StepKind.GENERIC not in shop.enabled:
        return None
    removed: list[Atom] = []
    others: list[Formula] = []
    closed: list[Formula] = []
    for part in conjuncts(body):
        if isinstance(part, Atom) and part.relation is Relation.NE and _mentions(part.poly, variables):
            removed.append(part)
        else:
            (others if is_open(part, variables) else closed).append(part)
    if not removed:
        return None
    if closed:
        return _boundary_apart(variables, body, closed, shop, recur)
    shop.note(StepKind.GENERIC, f"{len(removed)} inequations")
    somewhere = [disj(atom(c, Relation.NE) for c in coefficients(p.poly, variables)) for p in removed]
    return Nudged(variables, body, recur(variables, conj((*others, *somewhere)), shop))


def _boundary_apart(
    variables: tuple[str, ...], body: Formula, closed: list[Formula], shop: Workshop, recur: Recur
) -> Node | None:
    """g >= 0 iff g > 0 or g = 0: where at most two weak inequalities of low degree in the only variable are in the way.

    In the first case the body is open, in the second the variable can be solved for. Lifts to itself.
    """
    first = closed[0]
    if len(closed) > 2 or len(variables) > 1 or not isinstance(first, Atom) or first.relation is Relation.EQ:
        return None
    if first.poly.degree(first.poly.ring.index[variables[0]]) > 2 or not shop.may_split(StepKind.GENERIC, 2):
        return None
    rest = [p for p in conjuncts(body) if p != first]
    strict = Relation.GT if first.relation is Relation.GE else Relation.LT
    shop.note(StepKind.GENERIC, "boundary apart", 2)
    cases = [atom(first.poly, strict), atom(first.poly, Relation.EQ)]
    return either([recur(variables, conj((case, *rest)), shop) for case in cases])


def _mentions(poly: Poly, variables: tuple[str, ...]) -> bool:
    return any(poly.ring.names[i] in variables for i in poly.variables)


def is_open(formula: Formula, variables: tuple[str, ...]) -> bool:
    """Whether the truth set in the variables is open for fixed values of the others, as far as the syntax shows."""
    match formula:
        case Atom(poly, relation):
            return relation.is_strict or not _mentions(poly, variables)
        case And(args) | Or(args):
            return all(is_open(a, variables) for a in args)
    return False


def coefficients(poly: Poly, variables: tuple[str, ...]) -> list[Poly]:
    """The coefficients of a polynomial in the variables, as polynomials in the others, without repetition."""
    ring = poly.ring
    inside = [i for i in poly.variables if ring.names[i] in variables]
    found: dict[tuple[int, ...], dict[tuple[int, ...], int]] = {}
    for exponents, c in poly.terms():
        key = tuple(exponents[i] for i in inside)
        rest = tuple(0 if i in inside else k for i, k in enumerate(exponents))
        found.setdefault(key, {})[rest] = c
    return list(dict.fromkeys(ring.from_terms(terms) for terms in found.values()))

"""Inequations /= that only remove a set without interior."""

from __future__ import annotations

from qe.formula.build import atom, conj
from qe.formula.openness import is_open, somewhere_nonzero
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import atoms, conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import Any, Pending, Perturbed


def drop_inequations(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """Let f be open in the variables v of the block. Then  ex v (f and p /= 0)  iff  (ex v f) and (some coefficient
    of p with respect to v is not 0): the theorems of ``qe.formula.openness``.

    Lift: a solution of f, moved a little where p happens to vanish on it.
    """
    block = frozenset(map(next(atoms(body)).poly.ring.index.__getitem__, variables))
    removed: list[Atom] = []
    others: list[Formula] = []
    closed: list[Formula] = []
    for part in conjuncts(body):
        if isinstance(part, Atom) and part.relation is Relation.NE and block & set(part.poly.variables):
            removed.append(part)
        else:
            (others if is_open(part, block) else closed).append(part)
    if not removed:
        return None
    if closed:
        return _boundary_apart(variables, body, closed, context)
    somewhere = [somewhere_nonzero(p.poly, block) for p in removed]
    node = Perturbed(variables, body, Pending(variables, conj((*others, *somewhere))))
    return Found(StepKind.GENERIC, f"{len(removed)} inequations", node)


def _boundary_apart(
    variables: tuple[str, ...], body: Formula, closed: list[Formula], context: BlockContext
) -> Found | None:
    """g >= 0 iff g > 0 or g = 0: where at most two weak inequalities of low degree in the only variable are in the way.

    In the first case the body is open, in the second the variable can be solved for. Lifts to itself.
    """
    first = closed[0]
    if len(closed) > 2 or len(variables) > 1 or not isinstance(first, Atom) or first.relation is Relation.EQ:
        return None
    if first.poly.degree(first.poly.ring.index[variables[0]]) > 2 or not context.may_split(StepKind.BOUNDARY, 2):
        return None
    rest = [p for p in conjuncts(body) if p != first]
    strict = Relation.GT if first.relation is Relation.GE else Relation.LT
    cases = [atom(first.poly, strict), atom(first.poly, Relation.EQ)]
    node = Any(tuple(Pending(variables, conj((case, *rest))) for case in cases))
    return Found(StepKind.BOUNDARY, "weak inequality", node)

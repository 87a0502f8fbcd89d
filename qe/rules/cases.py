"""The rules about the equational part of a conjunction (theorems in ``qe.rules.equations``)."""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.build import atom, conj
from qe.formula.syntax import FALSE, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.rules import equations as eq
from qe.rules.block_context import BlockContext, Recur, either
from qe.rules.step import StepKind
from qe.rules.tree import NEVER, Node
from qe.simplify.minima import vanishing

_FACTORS = 6  # a product of more factors than this is not split


def groebner_equations(variables: tuple[str, ...], body: Formula, context: BlockContext, recur: Recur) -> Node | None:
    """Replace the equations by a better basis of their ideal, and reduce the other atoms by it."""
    if StepKind.GROEBNER not in context.enabled or context.bases <= 0:
        return None
    found, others = eq.split_equations(conjuncts(body))
    if not found or (not others and len(found) == 1):
        return None
    basis = eq.ideal_basis(eq.squarefree(found), eq.variable_order(body, variables))
    if basis is None:
        return None
    context.bases -= 1
    if basis.is_unit:
        context.note(StepKind.GROEBNER, f"{eq.describe(found)}: no common zero")
        return NEVER
    chosen = eq.better_equations(found, basis, variables) if len(found) > 1 else tuple(found)
    reduced = [eq.reduce_atoms(f, basis) for f in others]
    if set(chosen) == set(found) and reduced == others:
        return None
    context.note(StepKind.GROEBNER, eq.describe(chosen))
    result = conj((eq.equal_to_zero(chosen), *reduced))
    return NEVER if result == FALSE else recur(variables, result, context)


def split_factors(variables: tuple[str, ...], body: Formula, context: BlockContext, recur: Recur) -> Node | None:
    """One case per factor of an equation whose polynomial is a product.

    Later cases may assume that the factors of the earlier ones do not vanish; that is said only of linear factors in
    one variable, where it costs nothing and may serve as a guard.
    """
    found, others = eq.split_equations(conjuncts(body))
    choice = eq.factor_choice(found, _FACTORS)
    if choice is None or not context.may_split(StepKind.FACTOR_SPLIT, len(choice[1])):
        return None
    position, factors = choice
    context.note(StepKind.FACTOR_SPLIT, eq.describe(factors), len(factors))
    rest = conj((*(atom(p, Relation.EQ) for k, p in enumerate(found) if k != position), *others))
    nodes: list[Node] = []
    earlier: list[Poly] = []
    for factor in factors:
        distinct = [atom(p, Relation.NE) for p in earlier]
        nodes.append(recur(variables, conj((atom(factor, Relation.EQ), *distinct, rest)), context))
        if factor.total_degree == 1 and len(factor.variables) == 1:
            earlier.append(factor)
    return either(nodes)


def split_squares(variables: tuple[str, ...], body: Formula, context: BlockContext, recur: Recur) -> Node | None:
    """An equation p = 0 where p >= 0 everywhere becomes the equations of the set where p is least."""
    if StepKind.SUM_OF_SQUARES not in context.enabled:
        return None
    found, others = eq.split_equations(conjuncts(body))
    for position, poly in enumerate(found):
        squares = vanishing(poly)
        if len(squares) > 1:
            context.note(StepKind.SUM_OF_SQUARES, eq.describe((poly,)), 1)
            rest = [p for k, p in enumerate(found) if k != position]
            return recur(variables, conj((eq.equal_to_zero(rest), eq.equal_to_zero(squares), *others)), context)
    return None

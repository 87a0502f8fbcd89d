"""The rules about the equational part of a conjunction (theorems in ``qe.rules.equations``)."""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.build import atom, conj
from qe.formula.syntax import FALSE, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.rules import equations as eq
from qe.rules.block_context import BlockContext, Found
from qe.rules.step import StepKind
from qe.rules.tree import NEVER, Any, Node, Pending

_FACTORS = 6  # a product of more factors than this is not split


def groebner_equations(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """Replace the equations by a better basis of their ideal, and reduce the other atoms by it."""
    equations, others = eq.split_equations(conjuncts(body))
    if not equations or (not others and len(equations) == 1):
        return None
    basis = eq.ideal_basis(eq.squarefree(equations), eq.variable_order(body, variables))
    if basis is None:
        return None
    if basis.is_unit:
        return Found(StepKind.GROEBNER, f"{eq.describe(equations)}: no common zero", NEVER)
    chosen = eq.better_equations(equations, basis, variables) if len(equations) > 1 else tuple(equations)
    reduced = [eq.reduce_atoms(f, basis, context.watch) for f in others]
    if set(chosen) == set(equations) and reduced == others:
        return None
    result = conj((*(atom(p, Relation.EQ) for p in chosen), *reduced))
    node = NEVER if result == FALSE else Pending(variables, result)
    return Found(StepKind.GROEBNER, eq.describe(chosen), node)


def split_factors(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """One case per factor of an equation whose polynomial is a product.

    Later cases may assume that the factors of the earlier ones do not vanish; that is said only of linear factors in
    one variable, where it costs nothing and may serve as a guard.
    """
    equations, others = eq.split_equations(conjuncts(body))
    choice = eq.factor_choice(equations, _FACTORS)
    if choice is None or not context.may_split(StepKind.FACTOR_SPLIT, len(choice[1])):
        return None
    position, factors = choice
    rest = conj((*(atom(p, Relation.EQ) for k, p in enumerate(equations) if k != position), *others))
    nodes: list[Node] = []
    earlier: list[Poly] = []
    for factor in factors:
        distinct = [atom(p, Relation.NE) for p in earlier]
        nodes.append(Pending(variables, conj((atom(factor, Relation.EQ), *distinct, rest))))
        if factor.total_degree == 1 and len(factor.variables) == 1:
            earlier.append(factor)
    return Found(StepKind.FACTOR_SPLIT, eq.describe(factors), Any(tuple(nodes)))

"""The engine's parts as functions from a formula to an equivalent one, for comparison with the oracles."""

from __future__ import annotations

from collections.abc import Callable

from qe.decomposition.decompose import decompose
from qe.decomposition.formulas import construct
from qe.decomposition.operators.table import OPERATORS
from qe.elimination.coverings import Coverings
from qe.elimination.protocol import Context
from qe.elimination.vs.block import eliminate_block
from qe.errors import BudgetExceeded, NotWellOriented
from qe.formula.block import Block
from qe.formula.build import disj, exists, neg
from qe.formula.normal import Quantifier, prenex
from qe.formula.syntax import Constant, Formula
from qe.options import Budget, Options, Projection
from qe.proof.cells import CellTable
from qe.proof.run_log import RunLog
from qe.rules.preparation import prepare
from qe.simplifier.simplify import simplify

Part = Callable[[Formula, Budget], Formula]


def by_cad(projection: Projection) -> Part:
    """Prenex form, cell table, solution formula."""

    def run(formula: Formula, budget: Budget) -> Formula:
        prefix, matrix = prenex(formula)
        if isinstance(matrix, Constant):
            return matrix
        free = formula.free
        order = (*free, *(name for _, names in prefix for name in names))
        kinds = (*("" for _ in free), *(kind.value for kind, names in prefix for _ in names))

        def refine(levels: frozenset[int] = frozenset()) -> CellTable:
            operator = OPERATORS[projection]
            return decompose(matrix, order, kinds, budget=budget, operator=operator, thom_levels=levels).table

        return construct(refine(), refine)[0]

    return run


def by_coverings(formula: Formula, budget: Budget) -> Formula:
    """Coverings of the lines of all variables; what they do not take for a side condition is as good as no time."""
    try:
        return Coverings().run(Block((), formula), Context(Options(), budget.part(1500), RunLog())).formula
    except NotWellOriented as error:
        raise BudgetExceeded(str(error)) from None


def by_substitution(formula: Formula, budget: Budget) -> Formula:
    """Virtual substitution block by block from the inside; what is of too high a degree stays quantified."""
    prefix, matrix = prenex(formula)
    for kind, names in reversed(prefix):
        negate = kind is Quantifier.FORALL
        inner = neg(matrix) if negate else matrix
        result = eliminate_block(names, inner, budget=budget, simplify=simplify)
        found = disj([result.formula])
        matrix = neg(found) if negate else found
        if result.remaining:
            return _requantified(prefix[: prefix.index((kind, names))], matrix)
    return matrix


def _requantified(prefix: tuple[tuple[Quantifier, tuple[str, ...]], ...], formula: Formula) -> Formula:
    for kind, names in reversed(prefix):
        formula = exists(names, formula) if kind is Quantifier.EXISTS else neg(exists(names, neg(formula)))
    return formula


PARTS: dict[str, Part] = {
    "simplify": lambda f, budget: simplify(f),
    "prepare": lambda f, budget: prepare(f, budget=budget).formula,
    "vs": by_substitution,
    **{f"cad-{projection.value}": by_cad(projection) for projection in Projection},
    "coverings": by_coverings,
}

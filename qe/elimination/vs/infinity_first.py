"""Solutions near infinity first: what remains then has a leading coefficient that is zero.

THEOREM. For a quantifier-free F let F(-oo), F(+oo) be its truth for all sufficiently small, large x (``Substitution``,
for any degree). Then (exists x. F) iff F(-oo) or F(+oo) or exists x. (F and not F(-oo) and not F(+oo)). Where the
remaining block can only hold with the leading coefficient c of one of its polynomials zero, c = 0 may be added to it,
and the degree is lower. For an inequality of odd degree that is the usual case.
"""

from __future__ import annotations

from dataclasses import dataclass

from qe.elimination.protocol import Context, Outcome
from qe.elimination.vs.points import Infinity
from qe.elimination.vs.substitute import Substitution
from qe.formula.block import Block
from qe.formula.build import atom, conj, disj, exists, neg
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.formula.traverse import polynomials
from qe.options import Budget, Options
from qe.proof.run_log import RunLog
from qe.proof.step import Nested
from qe.rules.preparation import prepare
from qe.simplifier.facts import NOTHING
from qe.simplifier.simplify import simplify


class InfinityFirst:
    """Solutions near infinity, and a rest of lower degree."""

    name = "infinity first"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Blocks of one variable over quantifier-free bodies."""
        return self.name if problem.is_flat and len(problem.variables) == 1 else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """The solutions near infinity, or a block of lower degree; None where the degree does not fall."""
        dual = problem.dual
        found = far_first(dual.variables[0], dual.body, budget=context.budget)
        if found is None:
            return None
        whole = problem.asked(disj((found.solutions, found.rest)))
        proof = {"variable": dual.variables[0], "cases": list(found.cases), "parts": list(found.parts)}
        return Outcome(context.log.step(self.name, problem.formula, whole, evidence={"proof": proof}))


@dataclass(frozen=True, slots=True)
class FarFirst:
    """exists x. F iff ``solutions`` or ``rest``; ``rest`` is quantified, prepared, and of lower degree in x.

    ``cases``: of the sign of the leading coefficient, that of the rest first. ``parts``: how the solutions and what is
    left in each case were found.
    """

    solutions: Formula
    rest: Formula
    cases: tuple[Formula, ...]
    parts: tuple[Nested, ...]


def far_first(variable: str, body: Formula, *, budget: Budget) -> FarFirst | None:
    """The two parts of ``exists variable. body`` (body quantifier-free), or None where the degree does not fall."""
    high = [p for p in polynomials(body) if variable in p.ring.index and p.degree(p.ring.index[variable]) > 2]
    if not high:
        return None
    x = high[0].ring.index[variable]
    lead = max(high, key=lambda p: p.degree(x)).leading(x)
    near = disj(Substitution(x, Infinity(side), NOTHING)(body) for side in (-1, 1))
    far = simplify(near, watch=budget.check)
    solutions = Nested(near, (), far)
    if far == TRUE:
        return FarFirst(TRUE, FALSE, (TRUE,), (solutions, Nested(FALSE, (), FALSE)))
    if lead.is_constant:
        return None
    rest_of_body = conj((body, nnf(neg(far))))
    cases = [atom(lead, relation) for relation in (Relation.GT, Relation.LT, Relation.EQ)]
    parts: list[Nested] = []
    for case in cases:
        block, log = exists([variable], conj((rest_of_body, case))), RunLog()
        rest = prepare(block, budget=budget, log=log).formula
        parts.insert(0, Nested(block, tuple(log.steps()), rest))
        if case is not cases[-1] and rest != FALSE:
            return None
    if _degrees(rest, variable) >= _degrees(body, variable):
        return None  # a leading coefficient that is a product may be zero without the degree falling anywhere
    return FarFirst(far, rest, tuple(reversed(cases)), (solutions, *parts))


def _degrees(formula: Formula, variable: str) -> int:
    """The sum of the degrees above 2 in a variable."""
    degrees = (p.degree(p.ring.index[variable]) for p in polynomials(formula) if variable in p.ring.index)
    return sum(degree for degree in degrees if degree > 2)

"""Cylindrical algebraic coverings as a method: sentences of one block."""

from __future__ import annotations

from qe.cad.order import OrderRule
from qe.cad.order_by_projection import choose_order
from qe.coverings.cover import Cover, Search
from qe.coverings.evidence import evidence
from qe.elimination.protocol import Context, Outcome, Problem
from qe.exact.ring import Ring
from qe.exact.sample import Point
from qe.formula.build import convert
from qe.formula.syntax import FALSE, TRUE, Constant
from qe.options import Options, Stage


class Coverings:
    """Sentences of one block, decided by coverings of lines (see ``qe.coverings.cover``)."""

    name = "coverings"

    def suits(self, problem: Problem, options: Options) -> str | None:
        """Blocks without parameters over quantifier-free bodies."""
        return "a sentence of one block" if problem.is_flat and not problem.free else None

    def run(self, problem: Problem, context: Context) -> Outcome:
        """The truth, with values where there are some. Raises ``NotWellOriented`` where a polynomial is zero on a whole
        line, ``BudgetExceeded``.
        """
        body = problem.positive
        if isinstance(body, Constant):
            return Outcome(problem.asked(body), {} if body.value else None)
        named = tuple(v for v in context.options.order or () if v in body.free)
        rest = tuple(v for v in body.free if v not in named)
        rule = OrderRule.WRITTEN if Stage.ORDER in context.options.without else OrderRule.BY_PROJECTION
        blocks = [*((v,) for v in named), *([rest] if rest else [])]
        order, reason = choose_order(body, blocks, rule=rule, budget=context.budget)
        ring = Ring.of(order)
        search = Search(convert(body, ring), ring, context.budget)
        found = search.run()
        context.log.work("coverings", {"order": list(order), "order by": reason, "samples": search.samples})
        proof: dict[str, object] = {}
        if isinstance(found, Cover) and context.options.certify:
            proof = {"proof": evidence(found)}
        truth = FALSE if isinstance(found, Cover) else TRUE
        answer = context.log.step("covering", problem.formula, problem.asked(truth), evidence=proof)
        if isinstance(found, Point):
            return Outcome(answer, {v: found.number(i) for i, v in enumerate(order[: found.depth])})
        return Outcome(answer)

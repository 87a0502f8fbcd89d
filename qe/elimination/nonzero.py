"""Blocks that only ask polynomials not to vanish."""

from __future__ import annotations

from collections.abc import Sequence

from qe.elimination.protocol import Context, Outcome, Problem
from qe.formula.build import conj
from qe.formula.openness import somewhere_nonzero
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.options import Options
from qe.simplify.simplify import simplify


class OnlyNonzero:
    """Blocks that only ask polynomials not to vanish."""

    name = "only asked to be no root"

    def suits(self, problem: Problem, options: Options) -> str | None:
        """Blocks over quantifier-free bodies."""
        return self.name if problem.is_flat else None

    def run(self, problem: Problem, context: Context) -> Outcome | None:
        """The coefficients that must not all vanish; None where the body asks for something else."""
        dual = problem.dual
        settled = only_nonzero(dual.variables, dual.body)
        if settled is None:
            return None
        return Outcome(context.log.step(self.name, problem.formula, problem.asked(simplify(settled))))


def only_nonzero(variables: Sequence[str], body: Formula) -> Formula | None:
    """A formula equivalent to ``exists variables. body`` if body is a conjunction of p /= 0 as far as they occur in it.

    By the second theorem of ``qe.formula.openness``, on all of R^n: (exists x. p_1 /= 0 and … and p_k /= 0) iff every
    p_i has a coefficient, as a polynomial in x, that is not 0.
    None if the body has another shape.
    """
    ring = body.ring
    if ring is None:
        return None
    block = {ring.index[v] for v in variables if v in ring.index}
    parts: list[Formula] = []
    for arg in conjuncts(body):
        if not isinstance(arg, Atom):
            return None
        if not block & set(arg.poly.variables):
            parts.append(arg)
        elif arg.relation is not Relation.NE:
            return None
        else:
            parts.append(somewhere_nonzero(arg.poly, block))
    return conj(parts)

"""Products in an answer whose factors have signs of their own: x*(x - y)*(x + y) < 0 beside x > 0 says x < y and
-x < y. The signs that the factors have at some points are what is tried: two sentences, that the answer and the shorter
one differ nowhere, are decided, and where they differ at a point it is one more of them.
"""

from __future__ import annotations

from qe.elimination.protocol import Context
from qe.engine.redundant import COARSE, FINE, Points
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, exists
from qe.formula.features import is_short, length
from qe.formula.normal import nnf
from qe.formula.syntax import TRUE, And, Formula, Relation
from qe.formula.traverse import atoms, conjuncts
from qe.proof.step import Nested
from qe.simplifier.simplify import simplify

ROUNDS, WORK, MOST_FACTORS, MOST_VARIABLES, MOST_TERMS = 6, 1_000, 12, 4, 200
"""Points that show what is not so, units of work for all sentences, and the size of an answer that is looked at."""

SIGNS = (Relation.GT, Relation.LT, Relation.GE, Relation.LE)


def has_products(formula: Formula, context: Context) -> bool:
    """Whether a conjunction, in few variables, has products of few factors in all."""
    is_small = len(formula.free) <= MOST_VARIABLES and is_short(formula, MOST_TERMS)
    return isinstance(formula, And) and is_small and 0 < len(_factors(formula)) <= MOST_FACTORS


def signs_of_factors(formula: Formula, context: Context, start: object = None) -> Formula:
    """The conjunction by the signs of factors, if that is shorter."""
    points, budget = Points(formula.free, context.budget.check), context.budget.part(WORK)
    points.fill(COARSE + FINE)
    for _ in range(ROUNDS):
        shorter = _by_signs(formula, points)
        if _size(shorter) >= _size(formula) or (decide := context.decide) is None:
            break
        refuted: list[Nested] = []
        for one, other in ((formula, shorter), (shorter, formula)):
            body = conj((one, nnf(other, negate=True)))
            sentence = exists(body.free, body)
            outcome = decide(sentence, context.options, budget)
            if outcome.formula == TRUE:
                if not points.take(outcome.witness):
                    return formula
                break
            refuted.append(outcome.nested(sentence))
        else:
            return context.log.step("signs of factors", formula, shorter, evidence={"proof": {"exceptions": refuted}})
    return formula


def _size(formula: Formula) -> tuple[int, ...]:
    """Atoms, terms and degrees."""
    return *length(formula), sum(a.poly.total_degree for a in atoms(formula))


def _factors(formula: Formula) -> dict[Poly, None]:
    products = (parts for a in atoms(formula) if len(parts := a.poly.factors()[1]) > 1)
    return dict.fromkeys(factor for parts in products for factor, _ in parts)


def _by_signs(formula: Formula, points: Points) -> Formula:
    """What seems to say the same."""
    inside = points.holding(formula)
    if not inside:
        return formula
    signs = ((atom(f, r) for r in SIGNS if not inside & ~points.holding(atom(f, r))) for f in _factors(formula))
    parts = conjuncts(simplify(conj((formula, *(next(one, TRUE) for one in signs)))))
    for part in sorted(parts, key=length, reverse=True):
        rest = tuple(p for p in parts if p is not part)
        if points.holding(conj(rest)) == inside:
            parts = rest
    return conj(parts)

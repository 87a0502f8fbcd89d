"""What has to be refuted, before a search: its polynomials, and whether there is any hope."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from qe.exact.ring import Poly
from qe.formula.syntax import FALSE, Atom, Exists, ForAll, Formula, Relation
from qe.formula.traverse import children, disjuncts
from qe.kernel.negation import negation, normal
from qe.kernel.renaming import shape
from qe.proof.entry import poly_to_text


def polynomials_outside(formulas: Iterable[Formula]) -> dict[Poly, bool]:
    """The polynomials of comparisons that stand under no quantifier; whether one of them is an equation or not =."""
    polys: dict[Poly, bool] = {}
    pending = list(formulas)
    while pending:
        formula = pending.pop()
        if isinstance(formula, Atom):
            polys[formula.poly] = polys.get(formula.poly, False) or formula.relation in (Relation.EQ, Relation.NE)
        elif not isinstance(formula, Exists | ForAll):
            pending += children(formula)
    return dict(sorted(polys.items(), key=lambda entry: poly_to_text(entry[0])))


def is_hopeless(goal: Sequence[Formula]) -> bool:
    """Whether an alternative of what may be wrong is a quantified part of which nothing else in the goal speaks."""
    *known, last = [normal(f) for f in goal] or [FALSE]
    cases = disjuncts(last)
    alone = [_name(f) for f in cases if isinstance(f, Exists | ForAll)]
    if not alone:
        return False
    pending, seen = [*known, *(f for f in cases if not isinstance(f, Exists | ForAll))], set[object]()
    while pending:
        part = pending.pop()
        if isinstance(part, Exists | ForAll):
            seen.add(_name(part))
        elif not part.is_quantifier_free:
            pending += children(part)
    return any(name not in seen and alone.count(name) == 1 for name in alone)


def _name(formula: Exists | ForAll) -> object:
    """What a quantified part has in common with its negation, as a search sees it."""
    return shape(negation(formula) if isinstance(formula, ForAll) else formula)

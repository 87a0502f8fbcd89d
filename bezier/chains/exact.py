"""The optimum itself as an exact algebraic number, where at most two conditions are active: the engine solves the
problem with these conditions alone, and its minimiser is seen to keep all others, so that it is the optimum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import qe
from bezier.chains.chain import Chain, objective_form
from bezier.chains.form import Requirement, Solved
from bezier.chains.proof import Best, names_of
from bezier.curves.curve import Bezier
from qe.convex.evidence import optimum_certificate
from qe.convex.minimise import solve
from qe.convex.system import ConvexSystem
from qe.errors import Unable
from qe.options import Budget
from qe.proof.certificate import Certificate
from qe.proof.multipliers import FormRelation, OptimumStatus

MOST_NUMBERS, SECONDS = 4000, 10.0
_NOTHING = Fraction(1, 10**6)  # share of the largest multiplier


@dataclass(frozen=True, slots=True)
class Exact:
    """The least value and the curves that have it, in a number field; ``certificate``: of the value and the point."""

    value: Any
    curves: tuple[Bezier, ...]
    certificate: Certificate


def exactly(chain: Chain, solved: Solved, rows: Sequence[Requirement], best: Best, most: int) -> Exact | None:
    """The optimum near this one; None where more than ``most`` conditions are active, or it takes too long: with one
    milliseconds, with two up to seconds."""
    size, d = solved.size, chain.dimension
    largest = max(best.weights.values(), default=Fraction(0))
    active = [row for row in rows if best.weights.get(row.label, Fraction(0)) > _NOTHING * largest]
    if len(active) > most or len(rows) * size * d > MOST_NUMBERS or not size:
        return None
    objective = objective_form(chain, solved).quadratic(size, d)
    forms = [row.form.quadratic(size, d) for row in rows if not row.form.is_constant]
    labels = [row.label for row in rows if not row.form.is_constant]
    chosen = [labels.index(row.label) for row in active]
    system = ConvexSystem(names_of(chain, size), objective, tuple(forms), (FormRelation.LE,) * len(forms))
    narrow = replace(system, forms=tuple(forms[i] for i in chosen), relations=(FormRelation.LE,) * len(chosen))
    try:
        evidence = solve(narrow, budget=Budget(SECONDS))
    except Unable:
        return None
    if evidence.status is not OptimumStatus.OPTIMAL or evidence.faces:
        return None
    weights = dict(zip(chosen, evidence.multipliers, strict=True))
    multipliers = tuple(weights.get(i, Fraction(0)) for i in range(len(forms)))
    whole = replace(evidence, forms=system.forms, relations=system.relations, multipliers=multipliers, attained=True)
    certificate = optimum_certificate(whole)
    if not qe.verify(certificate).accepted:  # another condition is broken there
        return None
    point: Any = [tuple(evidence.point[i : i + d]) for i in range(0, size * d, d)]
    return Exact(objective.value(evidence.point), solved.curves(point), certificate)

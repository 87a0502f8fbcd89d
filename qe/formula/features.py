"""How large a formula is: counts that need no algebra."""

from __future__ import annotations

from collections.abc import Mapping

from qe.formula.syntax import Formula, Or
from qe.formula.traverse import atoms, has_root_atoms, subformulas

SMALL_DEGREE = {1: 40, 2: 12, 3: 4, 4: 2}
"""An answer in so many variables is small up to this total degree: its whole space is decomposed in no time."""


def is_small(formula: Formula, degrees: Mapping[int, int] = SMALL_DEGREE) -> bool:
    """Whether a shorter equivalent is easily found, if there is one: few variables and low ``degrees``."""
    if not any(isinstance(part, Or) for part in subformulas(formula)) and not _overlaps(formula):
        return False
    degree = max((a.poly.total_degree for a in atoms(formula)), default=0)
    return degree <= degrees.get(len(formula.free), 0)


def _overlaps(formula: Formula) -> bool:
    """Whether an atom of a conjunction may follow from the others: a curve in the plane, and more than one atom."""
    listed = list(atoms(formula))
    return (
        len(listed) > 1
        and len(formula.free) == 2
        and any(len(a.poly.variables) == 2 and a.poly.total_degree > 1 for a in listed)
    )


def is_short(formula: Formula, terms: int) -> bool:
    """Whether no root atom occurs, and at most so many terms stand in all atoms."""
    return not has_root_atoms(formula) and length(formula)[1] <= terms


def length(formula: Formula) -> tuple[int, int]:
    """Atoms, and terms of their polynomials."""
    polys = [a.poly for a in atoms(formula)]
    return len(polys), sum(p.term_count() for p in polys)

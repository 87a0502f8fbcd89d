"""How large a formula is: counts that need no algebra."""

from __future__ import annotations

from dataclasses import dataclass

from qe.formula.syntax import Formula
from qe.formula.traverse import atoms, bound_variables, free_variables


@dataclass(frozen=True, slots=True, kw_only=True)
class Features:
    """``free``, ``bound``: the variables (bound ones in order of quantification, without repetition); ``atoms``: how
    many there are; ``total_degree``: the largest of their polynomials."""

    free: tuple[str, ...]
    bound: tuple[str, ...]
    atoms: int
    total_degree: int


def features(formula: Formula) -> Features:
    """The features of a formula."""
    found = list(atoms(formula))
    return Features(
        free=free_variables(formula),
        bound=bound_variables(formula),
        atoms=len(found),
        total_degree=max((a.poly.total_degree for a in found), default=0),
    )

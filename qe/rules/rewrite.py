"""Rewriting atoms inside a formula, leaving alone what a quantifier would capture."""

from __future__ import annotations

from collections.abc import Callable, Collection

from qe.formula.build import map_children
from qe.formula.syntax import Atom, Formula, Quantified


def rewrite(formula: Formula, change: Callable[[Atom], Formula], names: Collection[str] = ()) -> Formula:
    """Every comparison with 0 changed, except under quantifiers that bind one of ``names``."""
    if isinstance(formula, Atom):
        return change(formula)
    if isinstance(formula, Quantified) and not set(formula.variables).isdisjoint(names):
        return formula
    return map_children(formula, lambda part: rewrite(part, change, names))

"""Conditions on which variables vanish that follow from the others.

Let a block be ``ex x (f and g)`` where g only says which variables are 0: a Boolean combination of p = 0 and p /= 0 for
products p of variables. A point has a pattern, the set of those variables that are 0 there, and g has the same truth at
all points of a pattern. THEOREM. If every pattern that makes g false makes f false wherever it occurs, then f implies
g, and ``ex x (f and g)`` iff ``ex x f``. That f is false on a pattern is seen by putting in the zeros: a polynomial of
which nothing, a number or an even power of what is not 0 is left has a known sign.

Conditions of this kind (a vector is not 0, its components one by one) break symmetries that the others have.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations

from qe.exact.ring import Poly
from qe.formula.block import Block
from qe.formula.build import conj, exists
from qe.formula.evaluate import truth_under
from qe.formula.syntax import Atom, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import atoms
from qe.rules.block_context import BlockContext
from qe.rules.step import StepKind

_VARIABLES = 6
"""Variables whose patterns are looked at, at most."""

Pattern = frozenset[int]


def without_implied_zeros(formula: Exists | ForAll, context: BlockContext) -> Exists | ForAll:
    """The block without the disjunctions about zeros that follow from its other conjuncts; dually for ``all``."""
    block = Block(formula.variables, formula.body, isinstance(formula, ForAll))
    if StepKind.ZEROS not in context.enabled:
        return formula
    kept = needed(block.conditions)
    if len(kept) == len(block.conditions):
        return formula
    after = block.asked(exists(formula.variables, conj(kept)))
    if not isinstance(after, Exists | ForAll):
        return formula
    context.step(StepKind.ZEROS.value, formula, after)
    return after


def needed(parts: Sequence[Formula]) -> tuple[Formula, ...]:
    """The conjuncts without disjunctions about zeros that follow from the rest."""
    about_zeros = [part for part in parts if isinstance(part, Or) and _is_about_zeros(part)]
    names = sorted({a.poly.ring.index[name] for part in about_zeros for a in atoms(part) for name in a.free})
    if not about_zeros or len(names) > _VARIABLES:
        return tuple(parts)
    patterns = [frozenset(chosen) for size in range(len(names) + 1) for chosen in combinations(names, size)]
    kept = list(parts)
    for part in about_zeros:
        others = [other for other in kept if other is not part]
        if all(
            truth_under(part, _values_at(zero)) or any(truth_under(o, _signs(zero, names)) is False for o in others)
            for zero in patterns
        ):
            kept = others
    return tuple(kept)


def _values_at(zero: Pattern) -> Callable[[Poly], int]:
    """The sign of a monomial where these variables alone are zero, up to that of the others."""
    return lambda poly: 0 if zero.intersection(poly.variables) else 1


def _is_about_zeros(part: Formula) -> bool:
    return part.is_quantifier_free and all(
        isinstance(a, Atom) and a.relation in (Relation.EQ, Relation.NE) and a.poly.term_count() == 1
        for a in atoms(part)
    )


def _signs(zero: Pattern, names: Sequence[int]) -> Callable[[Poly], int | None]:
    """The signs that follow where of these variables exactly those of the pattern are 0."""
    others = set(names) - zero

    def sign(poly: Poly) -> int | None:
        rest = [(e, c) for e, c in poly.terms() if not any(e[i] for i in zero)]
        if len(rest) > 1:
            return None
        for exponents, c in rest:
            if any(power % 2 or i not in others for i, power in enumerate(exponents) if power):
                return None
            return 1 if c > 0 else -1
        return 0

    return sign

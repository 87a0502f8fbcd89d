"""Numbers that are not algebraic in formulas: variables with names of their own, between rational bounds.

What holds for all values between the bounds holds for the number. At pi (Lindemann 1882) and e (Hermite 1873) no
polynomial over Q vanishes, so some bounds are narrow enough for every condition on one of them alone.
"""

from __future__ import annotations

from collections.abc import Iterable

from qe.exact.ring import Ring
from qe.exact.transcendental import floor_of
from qe.formula.build import atom, conj
from qe.formula.syntax import Formula, Relation
from qe.formula.traverse import atoms
from qe.spelling import NUMBERS

SPARE_BITS = 64
"""Bits of a bound beyond those that a polynomial of the formula needs so that hardly a sign depends on the rest."""


def unknowns(names: Iterable[str]) -> list[str]:
    """Those of the names that stand for no number."""
    return [name for name in names if name not in NUMBERS]


def is_settled(formula: Formula) -> bool:
    """Whether no condition speaks of numbers alone: closer bounds would say whether it holds."""
    return {*NUMBERS}.isdisjoint(formula.free) or all(unknowns(a.free) for a in atoms(formula))


def bounds_of_numbers(*formulas: Formula) -> Formula:
    """Between which rationals the numbers are that occur free in the formulas; TRUE where none does."""
    names = [name for name in NUMBERS if any(name in formula.free for formula in formulas)]
    if not names:
        return conj(())
    polys = [a.poly for formula in formulas for a in atoms(formula)]
    bits = SPARE_BITS + max((p.height_bits() + 1) * (p.total_degree + 1) for p in polys)
    ring, within = Ring.of(names), []
    for name in names:
        scaled, low = ring.var(name) * 2**bits, floor_of(name, bits)
        within += [atom(scaled - ring.constant(low + k), r) for k, r in ((0, Relation.GT), (1, Relation.LT))]
    return conj(within)

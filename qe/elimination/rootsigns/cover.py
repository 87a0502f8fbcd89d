"""A short formula in the signs of given polynomials that tells true rows of signs from false ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from qe.decomposition.formulas import formula_of_cells
from qe.decomposition.sign_table import Masks, where
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, And, Formula, Or, Relation
from qe.formula.traverse import atoms
from qe.proof.cells import CHARACTER_OF, FreeCell

Signs = tuple[int, ...]

LE, GE = Relation.LE, Relation.GE


@dataclass(frozen=True)
class Rows:
    """Rows of signs of polynomials that are not constant, no two of them multiples of each other by a number."""

    polys: tuple[Poly, ...]
    signs: tuple[Signs, ...]

    @cached_property
    def _columns(self) -> dict[Poly, Masks]:
        """By the polynomial of an atom the rows, as bits, on which it has which sign."""
        listed: dict[Poly, Masks] = {}
        for k, p in enumerate(self.polys):
            unit, normal = p.normal()
            text = [row[k] if unit > 0 else -row[k] for row in reversed(self.signs)]
            listed[normal] = {s: int("0" + "".join("01"[t == s] for t in text), 2) for s in (1, 0, -1)}
        return listed

    def where(self, formula: Formula) -> int:
        """The rows on which a formula holds, as bits."""
        return where(formula, self._columns.__getitem__, (1 << len(self.signs)) - 1)[0]

    def formula(self, true: int, false: int, splitting: Sequence[Poly]) -> Formula:
        """Holds on the true rows and not on the false ones; cases by the sign of a polynomial where that is shorter."""
        if not true or not false:
            return FALSE if not true else TRUE
        cells = self._cells(true, True) + self._cells(false, False)
        best = gathered(formula_of_cells([self.polys], cells, products=False))  # whose rows are not in the columns
        for k, p in enumerate(splitting):
            for first, second in ((LE, GE), (GE, LE)):
                divided = self._divided(true, false, atom(p, first), atom(p, second), splitting[k + 1 :], length(best))
                if length(divided) < length(best):
                    best = divided
        return best

    def _divided(
        self, true: int, false: int, first: Formula, second: Formula, splitting: Sequence[Poly], most: int
    ) -> Formula:
        """Two weak cases; where the polynomial is 0 one of them has to be met."""
        here, there = self.where(first), self.where(second)
        one = conj((first, self.formula(true & here & ~there, false & here, splitting)))
        if length(one) >= most:
            return one
        return disj((one, conj((second, self.formula(true & there & ~self.where(one), false & there, splitting)))))

    def _cells(self, bits: int, truth: bool) -> list[FreeCell]:
        chosen = [k for k in range(len(self.signs)) if bits >> k & 1]
        return [FreeCell((k,), ("".join(CHARACTER_OF[s] for s in self.signs[k]),), truth) for k in chosen]


def gathered(formula: Formula) -> Formula:
    """(A or B) and (A or C) as A or (B and C), and dually: the dearest common part first."""
    if not isinstance(formula, And | Or):
        return formula
    inner, join, across = (Or, conj, disj) if isinstance(formula, And) else (And, disj, conj)
    parts = [arg.args if isinstance(arg, inner) else (arg,) for arg in formula.args]
    shared = Counter(f for part in parts for f in part)
    common = max(shared, key=lambda f: (shared[f] - 1) * length(f))
    if shared[common] == 1:
        return formula
    rest = [across(f for f in part if f != common) for part in parts if common in part]
    others = [across(part) for part in parts if common not in part]
    return gathered(join((*others, across((common, gathered(join(rest)))))))


def length(formula: Formula) -> int:
    """What is to be small: the sizes of the polynomials."""
    return sum(a.poly.total_degree + a.poly.term_count() + 2 for a in atoms(formula))

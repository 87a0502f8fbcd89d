"""Linear conditions as sparse rows of integers, and the exact checks of what is proposed about them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain
from math import lcm

from qe.exact.ring import Poly
from qe.exact.wide import LinearPoly
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.proof.multipliers import FormRelation

_SPARSE, _MANY = 0.2, 5_000
"""Below that share of entries, and with more of them, an interior method with crossover is faster than simplex."""


def linear_atoms(conditions: Formula) -> list[Atom]:
    """Those of a conjunction of linear equations and inequalities; of anything else none."""
    parts = conjuncts(conditions)
    atoms = [a for a in parts if isinstance(a, Atom) and a.relation is not Relation.NE and a.poly.total_degree <= 1]
    return atoms if len(atoms) == len(parts) else []


@dataclass(frozen=True, slots=True)
class Row:
    """sum terms[j] * x_j + constant relation 0, where the polynomial of the condition is ``sign`` times that sum."""

    terms: Mapping[int, int]
    constant: int
    relation: FormRelation
    sign: int

    @property
    def is_strict(self) -> bool:
        """Whether equality is excluded."""
        return self.relation is FormRelation.LT

    @property
    def is_equation(self) -> bool:
        """Whether equality is demanded."""
        return self.relation is FormRelation.EQ


@dataclass(frozen=True, slots=True)
class LinearRows:
    """A conjunction of rows in the variables ``names``."""

    names: tuple[str, ...]
    rows: tuple[Row, ...]

    @staticmethod
    def of(atoms: Iterable[Atom]) -> LinearRows:
        """The rows of linear atoms other than inequations, in their order; the variables as they first occur."""
        listed = [(a.relation, *_linear(a.poly)) for a in atoms]
        columns = {name: k for k, name in enumerate(dict.fromkeys(chain.from_iterable(parts[1] for parts in listed)))}
        return LinearRows(tuple(columns), tuple(_row(*parts, columns.__getitem__) for parts in listed))

    @property
    def is_sparse(self) -> bool:
        """Whether there are many entries, and many more zeros."""
        entries = sum(len(row.terms) for row in self.rows)
        return _MANY < entries < _SPARSE * len(self.names) * len(self.rows)

    def holds(self, point: Sequence[Fraction]) -> bool:
        """Whether a point keeps all conditions."""
        whole = lcm(*(v.denominator for v in point))
        scaled = [v.numerator * (whole // v.denominator) for v in point]
        for row in self.rows:
            value = sum(c * scaled[j] for j, c in row.terms.items()) + row.constant * whole
            if value > 0 or (value == 0 and row.is_strict) or (value < 0 and row.is_equation):
                return False
        return True

    def refuted_by(self, weights: Mapping[int, int]) -> bool:
        """THEOREM (Farkas 1902, Motzkin 1936). There is no point if weights, nonnegative on inequalities, make the sum
        of the rows a positive number, or 0 with a strict inequality among those of positive weight."""
        if any(w < 0 and not self.rows[i].is_equation for i, w in weights.items()):
            return False
        sums: dict[int, int] = {}
        total = 0
        for i, w in weights.items():
            row = self.rows[i]
            total += w * row.constant
            for j, c in row.terms.items():
                sums[j] = sums.get(j, 0) + w * c
        if any(sums.values()):
            return False
        return total > 0 or (total == 0 and any(w and self.rows[i].is_strict for i, w in weights.items()))


def _linear(poly: Poly) -> tuple[Iterable[str], Sequence[int], int]:
    """Variables, their coefficients and the constant."""
    names = poly.ring.names
    if isinstance(poly, LinearPoly):
        return [names[i] for i in poly.variables], poly.numbers, poly.rest
    terms = {names[powers[0][0]] if powers else "": c for powers, c in poly.sparse_terms()}
    rest = terms.pop("", 0)
    return list(terms), list(terms.values()), rest


def _row(given: Relation, names: Iterable[str], numbers: Sequence[int], rest: int, column: Callable[[str], int]) -> Row:
    sign = -1 if given in (Relation.GT, Relation.GE) else 1
    terms = dict(zip(map(column, names), numbers if sign > 0 else [-c for c in numbers]))
    kind = FormRelation.LT if given.is_strict else FormRelation.LE
    return Row(terms, sign * rest, FormRelation.EQ if given is Relation.EQ else kind, sign)

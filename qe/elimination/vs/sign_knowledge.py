"""Which signs polynomials can have inside a subproblem, and atoms made smaller by that knowledge."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.simplify.facts import NOTHING

_ANY = frozenset((-1, 0, 1))
_FACTORED_TERMS = 300  # above this many terms a polynomial counts as irreducible here


@dataclass(frozen=True, slots=True)
class Signs:
    """Sign sets per normalised polynomial, from atoms that hold wherever the result is used."""

    table: Mapping[Poly, frozenset[int]] = field(default_factory=dict)

    @staticmethod
    def of(formula: Formula) -> Signs:
        """What the conjoined atoms of ``formula`` say."""
        return Signs().given(formula)

    def given(self, formula: Formula) -> Signs:
        """These facts and the conjoined atoms of ``formula``."""
        table = dict(self.table)
        for part in conjuncts(formula):
            if isinstance(part, Atom):
                table[part.poly] = table.get(part.poly, _ANY) & part.relation.signs
        return Signs(table)

    def possible(self, poly: Poly) -> frozenset[int]:
        """The signs that the polynomial can have, as far as known (a superset of the true set)."""
        if poly.is_constant:
            value = poly.constant_value()
            return frozenset(((value > 0) - (value < 0),))
        unit, primitive = poly.normal()
        signs = self._irreducible(primitive)
        if len(signs) > 1 and primitive.total_degree > 1:
            unit2, parts = factor_parts(primitive)
            if len(parts) > 1 or parts[0][1] > 1:
                product = frozenset((1 if unit2 > 0 else -1,))
                for factor, exponent in parts:
                    product = _times(product, _power(self._irreducible(factor), exponent))
                signs &= product
        return signs if unit > 0 else frozenset(-s for s in signs)

    def _irreducible(self, primitive: Poly) -> frozenset[int]:
        return NOTHING.signs(primitive) & self.table.get(primitive, _ANY)

    def sign(self, poly: Poly) -> int | None:
        """1 or -1 where the polynomial is known to be positive or negative, else None."""
        signs = self.possible(poly)
        return next(iter(signs)) if len(signs) == 1 and 0 not in signs else None

    def atom(self, poly: Poly, relation: Relation) -> Formula:
        """A formula equivalent to ``poly relation 0`` under these facts.

        Factors of known sign are dropped, even powers become conditions on their base:
        f^2*g < 0 iff f /= 0 and g < 0;  f^2*g <= 0 iff f = 0 or g <= 0.
        """
        if poly.is_constant or poly.total_degree == 1:
            return self._decided(poly, relation)
        _, parts = factor_parts(poly)
        unit = 1 if poly.normal()[0] > 0 else -1
        if relation in (Relation.EQ, Relation.NE):
            kept = [f for f, _ in parts if 0 in self.possible(f)]
            return self._decided(_product(poly, kept), relation) if kept else atom(poly.ring.constant(1), relation)
        even: list[Poly] = []
        odd: list[Poly] = []
        for factor, exponent in parts:
            signs = self._irreducible(factor)
            if exponent % 2 and signs <= {-1, 0} and signs != {0}:
                unit = -unit
            if exponent % 2 == 0 or signs <= {-1, 0} or signs <= {0, 1}:
                if 0 in signs:
                    even.append(factor)
            else:
                odd.append(factor)
        rest = self._decided(_product(poly, odd) * unit, relation)
        if not even:
            return rest
        square = _product(poly, even)
        if relation.is_strict:
            return conj((self._decided(square, Relation.NE), rest))
        return disj((self._decided(square, Relation.EQ), rest))

    def _decided(self, poly: Poly, relation: Relation) -> Formula:
        signs = self.possible(poly)
        if signs <= relation.signs:
            return TRUE
        allowed = signs & relation.signs
        if not allowed:
            return FALSE
        if allowed == {0}:
            squares = _sum_of_squares(poly)
            return conj(atom(m, Relation.EQ) for m in squares) if squares else atom(poly, Relation.EQ)
        return atom(poly, relation)


def _sum_of_squares(poly: Poly) -> list[Poly]:
    """[m1, m2, ...] if poly is a sum of terms c*mi^(2k) with all c of one sign, at least two; else []."""
    terms = poly.terms()
    if len(terms) < 2 or any(k % 2 for e, _ in terms for k in e) or len({c > 0 for _, c in terms}) > 1:
        return []
    return [poly.ring.from_terms({tuple(min(k, 1) for k in e): 1}) for e, _ in terms]


def factor_parts(primitive: Poly) -> tuple[int, tuple[tuple[Poly, int], ...]]:
    """Unit and factors with multiplicities; a polynomial of very many terms counts as irreducible."""
    if primitive.total_degree <= 1 or primitive.term_count() > _FACTORED_TERMS:
        unit, q = primitive.normal()
        return unit, ((q, 1),)
    return primitive.factors()


def _product(model: Poly, factors: Iterable[Poly]) -> Poly:
    total = model.ring.constant(1)
    for f in factors:
        total = total * f
    return total


def _times(left: frozenset[int], right: frozenset[int]) -> frozenset[int]:
    return frozenset(a * b for a in left for b in right)


def _power(signs: frozenset[int], exponent: int) -> frozenset[int]:
    return frozenset(s**exponent for s in signs)

"""Substitution of a test point into a quantifier-free formula (virtual: no roots or infinitesimals appear).

THEOREM (Weispfenning 1997; Loos & Weispfenning 1993 for the infinitesimals; ``cubic`` for roots of cubics). Where the
guard of the point and the given sign facts hold, the result is equivalent to the formula at the point: at a real root,
at a root plus or minus every sufficiently small positive number, or at every sufficiently large (small) number.
"""

from __future__ import annotations

from qe.elimination.vs.cubic import at_cubic, remainder
from qe.elimination.vs.points import CubicRoot, Infinity, LinearRoot, QuadraticRoot, SymbolicPoint
from qe.elimination.vs.tables import root_condition
from qe.exact.ring import Poly
from qe.formula.build import conj, disj
from qe.formula.syntax import Atom, Atomic, Formula, Relation
from qe.formula.traverse import map_atoms
from qe.simplifier.factors import atom_under
from qe.simplifier.facts import Facts

EQ, NE, LT = Relation.EQ, Relation.NE, Relation.LT
_UPWARD = (Relation.GT, Relation.GE)


class Substitution:
    """``x`` (an index into the ring) replaced by ``point``, in places where ``facts`` hold. Caches per atom.

    The strict atoms in ``settled`` are known not to vanish at the root that a point is next to.
    """

    __slots__ = ("_done", "facts", "point", "settled", "x")

    def __init__(self, x: int, point: SymbolicPoint, facts: Facts, settled: frozenset[Atom] = frozenset()) -> None:
        self.x, self.point, self.facts, self.settled = x, point, facts, settled
        self._done: dict[Atom, Formula] = {}

    def __call__(self, formula: Formula) -> Formula:
        """The formula at the point. Root atoms must not contain the variable."""
        return map_atoms(formula, self._leaf)

    def _leaf(self, leaf: Atomic) -> Formula:
        if not isinstance(leaf, Atom) or not leaf.poly.degree(self.x):
            return leaf
        found = self._done.get(leaf)
        if found is None:
            plain = leaf in self.settled and not isinstance(self.point, Infinity)
            evaluate = self._exactly if plain else self.atom
            found = self._done[leaf] = evaluate(leaf.poly, leaf.relation)
        return found

    def atom(self, f: Poly, relation: Relation) -> Formula:
        """``f relation 0`` at the point."""
        if not f.degree(self.x):
            return self._known(f, relation)
        if isinstance(self.point, Infinity):
            return self._identically(f, relation) or self._at_infinity(f, relation, self.point.sign)
        if self.point.epsilon:
            return self._identically(f, relation) or self._next_to(f, relation, self.point.epsilon)
        return self._exactly(f, relation)

    def _known(self, f: Poly, relation: Relation) -> Formula:
        """``f relation 0`` for a polynomial without x."""
        return atom_under(f, relation, self.facts)

    def _identically(self, f: Poly, relation: Relation) -> Formula | None:
        """At a transcendental point f = 0 iff all coefficients vanish; None for an inequality."""
        if relation is EQ:
            return conj(self._known(c, EQ) for c in f.coefficients(self.x))
        if relation is NE:
            return disj(self._known(c, NE) for c in f.coefficients(self.x))
        return None

    def _at_infinity(self, f: Poly, relation: Relation, side: int) -> Formula:
        """The first coefficient from above that is not zero decides (with alternating signs at -infinity)."""
        strict = Relation.GT if relation in _UPWARD else LT
        coefficients = f.coefficients(self.x)
        result = self._known(coefficients[0], relation)
        for k in range(1, len(coefficients)):
            c = coefficients[k] if side > 0 or k % 2 == 0 else -coefficients[k]
            result = disj((self._known(c, strict), conj((self._known(c, EQ), result))))
        return result

    def _next_to(self, f: Poly, relation: Relation, side: int) -> Formula:
        """f < 0 just right of e iff f(e) < 0, or f(e) = 0 and f' < 0 just right of e (left: -f')."""
        if not f.degree(self.x):
            return self._known(f, relation)
        strict = Relation.GT if relation in _UPWARD else LT
        slope = f.derivative(self.x)
        here = self._exactly(f, EQ)
        further = self._next_to(slope if side > 0 else -slope, relation, side)
        return disj((self._exactly(f, strict), conj((here, further))))

    def _exactly(self, f: Poly, relation: Relation) -> Formula:
        """``f relation 0`` at the real number."""
        if isinstance(self.point, LinearRoot):
            return self._at_quotient(f, relation, self.point)
        if isinstance(self.point, CubicRoot):
            return at_cubic(f, self.x, relation, self.point, self.facts.sign(self.point.coefficients[3]), self._known)
        assert isinstance(self.point, QuadraticRoot)
        return self._at_quadratic(f, relation, self.point)

    def _at_quotient(self, f: Poly, relation: Relation, e: LinearRoot) -> Formula:
        """a^n * f(-b/a) is a polynomial; for odd n its sign is corrected by that of a."""
        value = f.at_quotient(self.x, -e.b, e.a)
        if f.degree(self.x) % 2 and relation not in (EQ, NE):
            sign = self.facts.sign(e.a)
            value = value * (e.a if sign is None else sign)
        return self._known(value, relation)

    def _at_quadratic(self, f: Poly, relation: Relation, e: QuadraticRoot) -> Formula:
        """Reduce f to u*x + v modulo the quadratic g, then a sign table.

        With w = a^k*f = u*x + v (mod g): 2*a*w(e) = A + B*sqrt(D), A = 2*a*v - u*b, B = branch*u, and
        A^2 - B^2*D = 4*a*R with R = a*v^2 - b*u*v + c*u^2, the resultant of g and u*x + v.
        """
        a, b, c = e.a, e.b, e.c
        (v, u), odd = remainder(f, self.x, (c, b, a))
        first, second = 2 * (a * v) - u * b, u if e.branch > 0 else -u
        norm = a * (v * v) - b * (u * v) + c * (u * u)
        sign = self.facts.sign(a)
        scale: Poly | int = a if sign is None else sign
        if not odd:  # the factor a^(k+1) has the sign of a
            first, second = first * scale, second * scale
        return root_condition(first, second, norm * scale, relation, self._known)

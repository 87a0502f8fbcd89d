"""Two variables that can be exchanged: their sum and product in their place.

THEOREM. Let f be unchanged when x and y change places. If f(x, y) iff g(x + y, x*y), then ex x, y f iff ex x, y (g and
x^2 - 4*y >= 0): s and p are the sum and the product of real numbers iff t^2 - s*t + p has a real root. Every polynomial
that the exchange leaves alone is one in x + y and x*y (the theorem on symmetric polynomials). Two conditions p rel 0
and q rel 0 that change places say the same as p + q rel 0 and p*q > 0 (rel is < or >), p*q >= 0 (<= or >=), p*q = 0
(=), and p*q /= 0 alone (/=). A solution of the right side lifts to the roots of t^2 - s*t + p.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from qe.exact.number import simplest
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.features import is_short
from qe.formula.syntax import Atom, Atomic, Constant, Formula, Relation
from qe.formula.traverse import atoms, bound_variables, conjuncts, map_atoms
from qe.rules.block_context import BlockContext, Found
from qe.rules.lift import Assignment, Solve, Value, root, value_at
from qe.rules.step import StepKind
from qe.rules.tree import Lifted, Pending

_TERMS, _DEGREE = 600, 12
"""So many terms in all atoms, and degrees, up to which the rule looks."""


def exchange_variables(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on the first two variables of the block that it makes simpler."""
    ring = body.ring
    if len(variables) < 2 or ring is None or not is_short(body, _TERMS):
        return None
    inner = frozenset(bound_variables(body))
    for x, y in combinations([v for v in variables if v not in inner], 2):
        i, j = ring.index[x], ring.index[y]
        new = None if _is_easy(body, i, j) else by_sum_and_product(body, i, j)
        if new is not None and _is_simpler(new, body, i, j):
            after = conj((new, atom(ring.gen(i) ** 2 - ring.gen(j) * 4, Relation.GE)))
            if isinstance(after, Constant):
                return None
            larger = Solve(x, ring.var(x) - ring.var(y), ring.constant(1))  # where x still has the value of the sum
            node = Lifted((larger, SmallerRoot(y, x)), Pending(variables, after))
            return Found(StepKind.EXCHANGE, f"{x} + {y}, {x}*{y}", node, {"variables": [x, y]})
    return None


def _is_easy(body: Formula, i: int, j: int) -> bool:
    """Whether the degrees in both variables differ, are too large, or substitution and convexity have them anyway."""
    degree, other = (max(a.poly.degree(k) for a in atoms(body)) for k in (i, j))
    if degree != other or not 2 <= degree <= _DEGREE:
        return True
    has_equations = any(isinstance(a, Atom) and a.relation is Relation.EQ for a in atoms(body))
    return not has_equations and _degrees(body, i, j)[2] <= 2


def _is_simpler(new: Formula, body: Formula, i: int, j: int) -> bool:
    """Whether the smaller of the degrees in the two variables is smaller than it was, or else the degree in both
    together."""
    after, before = _degrees(new, i, j), _degrees(body, i, j)
    s, p, both = max(after[0], 2), max(after[1], 1), max(after[2], 2)
    return (min(s, p), both) < (min(before[:2]), before[2])


def _degrees(body: Formula, i: int, j: int) -> tuple[int, int, int]:
    """The degrees in two variables, and in both together."""
    exponents = [(e[i], e[j]) for a in atoms(body) for e, _ in a.poly.terms()]
    return (
        max((k for k, _ in exponents), default=0),
        max((k for _, k in exponents), default=0),
        max(map(sum, exponents), default=0),
    )


def by_sum_and_product(body: Formula, i: int, j: int) -> Formula | None:
    """g of the theorem, with the names of the two variables for their sum and product; None where f may change."""
    parts: list[Formula] = []
    rest = list(conjuncts(body))
    while rest:
        part = rest.pop(0)
        images = {a: image for a in atoms(part) if (image := _in_new_terms(a, i, j)) is not None}
        if images.keys() >= {*atoms(part)}:
            parts.append(map_atoms(part, images.__getitem__))
            continue
        if not isinstance(part, Atom):
            return None
        p, q = part.poly, _swapped(part.poly, i, j)
        other = atom(q, part.relation)
        if other not in rest:
            return None
        rest.remove(other)
        parts += _both(p, q, part.relation, i, j)
    return conj(parts)


def _in_new_terms(atomic: Atomic, i: int, j: int) -> Formula | None:
    """A condition that the exchange leaves alone, with p^2 for p in an equation or inequation where p changes sign."""
    poly, swapped = atomic.poly, _swapped(atomic.poly, i, j)
    if swapped == -poly and isinstance(atomic, Atom) and atomic.relation in (Relation.EQ, Relation.NE):
        poly = swapped = poly**2
    return atom(symmetric(poly, i, j), atomic.relation) if swapped == poly else None


def _both(p: Poly, q: Poly, relation: Relation, i: int, j: int) -> tuple[Formula, ...]:
    """p rel 0 and q rel 0, for polynomials that change places."""
    product = symmetric(p * q, i, j)
    if relation is Relation.NE:
        return (atom(product, relation),)
    positive = Relation.GT if relation.is_strict else Relation.GE
    return atom(symmetric(p + q, i, j), relation), atom(product, relation if relation is Relation.EQ else positive)


def _swapped(poly: Poly, i: int, j: int) -> Poly:
    return poly.compose({i: poly.ring.gen(j), j: poly.ring.gen(i)})


def symmetric(poly: Poly, i: int, j: int) -> Poly:
    """q with q(x + y, x*y) = poly(x, y) for a polynomial that stays the same when its variables i and j change places.

    By Newton's power sums: x^a*y^b + x^b*y^a = (x*y)^b * (x^(a-b) + y^(a-b)).
    """
    ring = poly.ring
    s, p, result = ring.gen(i), ring.gen(j), ring.constant(0)
    sums = [ring.constant(2), s]
    for (a, b), c in poly.collected((i, j)).items():
        if a < b:
            continue
        while len(sums) <= a - b:
            sums.append(s * sums[-1] - p * sums[-2])
        result = result + c * p**b * (sums[a - b] if a > b else 1)
    return result


@dataclass(frozen=True, slots=True)
class SmallerRoot:
    """variable = the smaller root of t^2 - s*t + p, where it has the value p and ``sum`` the value s."""

    variable: str
    sum: str

    def value(self, assignment: Assignment) -> Value:
        """The smaller root. Raises ``Unable`` where there is none, or no value is computed."""
        line = Ring.of((self.sum, self.variable))
        s, p = line.gen(0), line.gen(1)
        distance = root(value_at(s**2 - p * 4, assignment), 2)
        known = {self.sum: assignment.get(self.sum, Fraction(0)), self.variable: distance}
        return simplest(value_at(s - p, known) / 2)

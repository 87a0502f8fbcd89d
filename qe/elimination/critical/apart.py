"""A block taken apart by the disjuncts of its body, each asked in as few parameters as it looks at.

THEOREM. (a) ex y (f or g) iff ex y f or ex y g. (b) Let w be a vector over the parameters p such that the derivative
of every polynomial of f along w is 0, and w_i > 0. Then f has the same truth at p and at p - (p_i/w_i)*w, whose i-th
coordinate is 0: if  ex y f[p_i = 0] iff r  for the other parameters q, then  ex y f iff r[q_j = p_j - p_i*w_j/w_i].
PROOF of (b). f's polynomials are constant along p + t*w.

So a block that looks at a + m and one that looks at a - m, each in two parameters, need not be asked in a, m and b.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod

from qe.exact.sparse_solve import whole_multiples
from qe.formula.build import conj
from qe.formula.evaluate import at_quotients, substituted
from qe.formula.syntax import Formula
from qe.formula.traverse import conjuncts, disjuncts, has_root_atoms
from qe.rules.nullspace import constant_direction

MOST_PIECES = 4
"""A body of more disjuncts is not taken apart."""

Direction = Mapping[str, int]
"""The vector w of the theorem, in whole numbers: where it is not 0."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A disjunct, what it becomes with parameters at 0, and the ``steps`` to that: (parameter, direction), in order."""

    whole: Formula
    body: Formula
    steps: tuple[tuple[str, Direction], ...]

    def back(self, formula: Formula) -> Formula:
        """The formula for the disjunct from the one for its body."""
        for name, direction in reversed(self.steps):
            formula = _moved(formula, name, direction)
        return formula


def taken_apart(variables: Sequence[str], body: Formula, most: int) -> tuple[Piece, ...]:
    """The pieces of a quantifier-free body, if each has one to ``most`` parameters left; else none."""
    choices = [list(disjuncts(part)) for part in conjuncts(body)]
    if prod(map(len, choices)) > MOST_PIECES or has_root_atoms(body):
        return ()
    pieces = tuple(_piece(conj(chosen), frozenset(variables)) for chosen in product(*choices))
    few = all(0 < len(set(p.body.free) - set(variables)) <= most and p.whole.free for p in pieces)
    return pieces if few else ()


def _piece(whole: Formula, variables: frozenset[str]) -> Piece:
    body, steps = whole, []
    while True:
        parameters = frozenset(body.free) - variables
        found = constant_direction(body, parameters) if len(parameters) > 1 else {}
        if not found:
            break
        direction = whole_multiples(found)
        name = min(direction, key=lambda v: (direction[v], v))
        if direction[name] < 0:
            direction = {v: -w for v, w in direction.items()}
        steps.append((name, direction))
        body = substituted(body, {name: Fraction(0)})
    return Piece(whole, body, tuple(steps))


def _moved(formula: Formula, name: str, direction: Direction) -> Formula:
    """Every other parameter q_j of the direction becomes (w_i*q_j - w_j*p_i)/w_i, where w_i > 0."""
    if (ring := formula.ring) is None:
        return formula
    others = {v: ring.var(v) * direction[name] - ring.var(name) * w for v, w in direction.items() if v != name}
    return at_quotients(formula, {v: (top, direction[name]) for v, top in others.items()})

"""Given points that lie in an obstacle: no path through them is clear of it, whatever the method."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from bezier.curves.scalar import Vector, exactly
from bezier.obstacles.obstacle import Constraint, Obstacle
from qe.exact.ring import Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import Formula, Relation
from qe.proof.certificate import Certificate

AXES = ("x", "y", "z")


@dataclass(frozen=True, slots=True)
class Inside:
    """The given point ``name`` at ``place`` belongs to a piece of the obstacle."""

    name: str
    place: tuple[Fraction, ...]
    obstacle: Obstacle
    piece: int

    @property
    def label(self) -> str:
        """Of the certificate."""
        return f"{self.name} in {self.obstacle.name}"

    def in_words(self) -> str:
        """As a clause."""
        return f"the {self.name} ({', '.join(map(str, self.place))}) lies in the obstacle {self.obstacle.name}"

    def certificate(self) -> Certificate:
        """That the conditions of the piece hold at the place."""
        constraints = self.obstacle.pieces[self.piece].constraints
        return Certificate.witness(conj(map(_formula, constraints)), AXES, self.place)


def inside(points: Mapping[str, Vector], obstacles: Sequence[Obstacle]) -> tuple[Inside, ...]:
    """Every point with every obstacle that it belongs to, exactly; touching a closed obstacle is belonging to it."""
    found = []
    for name, point in points.items():
        place = tuple(map(exactly, point))
        for obstacle in obstacles:
            held = (all(c.holds(c.value(place)) for c in piece.constraints) for piece in obstacle.pieces)
            number = next((k for k, holds in enumerate(held) if holds), None)
            if number is not None:
                found.append(Inside(name, place, obstacle, number))
    return tuple(found)


def _formula(constraint: Constraint) -> Formula:
    scale = lcm(*(c.denominator for _, c in constraint.terms))
    poly = Ring.of(AXES).from_terms({exponents: int(c * scale) for exponents, c in constraint.terms})
    return atom(poly, Relation.GT if constraint.strict else Relation.GE)

"""Comparisons with zero."""

from __future__ import annotations

from enum import Enum


class Relation(Enum):
    """A comparison with zero. ``value`` is its text form."""

    EQ = "="
    NE = "/="
    LT = "<"
    LE = "<="
    GT = ">"
    GE = ">="

    def holds(self, sign: int) -> bool:
        """Whether a number of this sign (-1, 0, 1) satisfies the relation."""
        return sign in _SIGNS[self]

    @property
    def negated(self) -> Relation:
        """The relation that holds exactly where this one does not."""
        return _NEGATED[self]

    @property
    def flipped(self) -> Relation:
        """The relation r' with: p r 0 iff -p r' 0."""
        return _FLIPPED[self]

    @property
    def is_strict(self) -> bool:
        """Whether the solution set is open (<, >, /=)."""
        return self in (Relation.LT, Relation.GT, Relation.NE)

    @property
    def signs(self) -> frozenset[int]:
        """The signs that satisfy the relation."""
        return _SIGNS[self]


_SIGNS = {
    Relation.EQ: frozenset((0,)),
    Relation.NE: frozenset((-1, 1)),
    Relation.LT: frozenset((-1,)),
    Relation.LE: frozenset((-1, 0)),
    Relation.GT: frozenset((1,)),
    Relation.GE: frozenset((0, 1)),
}
_NEGATED = {
    Relation.EQ: Relation.NE,
    Relation.NE: Relation.EQ,
    Relation.LT: Relation.GE,
    Relation.GE: Relation.LT,
    Relation.GT: Relation.LE,
    Relation.LE: Relation.GT,
}
_FLIPPED = {
    Relation.EQ: Relation.EQ,
    Relation.NE: Relation.NE,
    Relation.LT: Relation.GT,
    Relation.GT: Relation.LT,
    Relation.LE: Relation.GE,
    Relation.GE: Relation.LE,
}

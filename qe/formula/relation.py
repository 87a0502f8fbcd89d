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


_SIGNS = dict(zip(Relation, map(frozenset, ((0,), (-1, 1), (-1,), (-1, 0), (1,), (0, 1))), strict=True))
BY_SIGNS = {signs: relation for relation, signs in _SIGNS.items()}
_NEGATED = {relation: BY_SIGNS[frozenset((-1, 0, 1)) - signs] for relation, signs in _SIGNS.items()}
_FLIPPED = {relation: BY_SIGNS[frozenset(-sign for sign in signs)] for relation, signs in _SIGNS.items()}

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

    signs: frozenset[int]
    """The signs that satisfy the relation."""

    negated: Relation
    """The relation that holds exactly where this one does not."""

    flipped: Relation
    """The relation r' with: p r 0 iff -p r' 0."""

    def holds(self, sign: int) -> bool:
        """Whether a number of this sign (-1, 0, 1) satisfies the relation."""
        return sign in self.signs

    @property
    def is_strict(self) -> bool:
        """Whether the solution set is open (<, >, /=)."""
        return self in (Relation.LT, Relation.GT, Relation.NE)


BY_SIGNS = dict(zip(map(frozenset, ((0,), (-1, 1), (-1,), (-1, 0), (1,), (0, 1))), Relation, strict=True))
for _signs, _relation in BY_SIGNS.items():  # as attributes: they are asked for more often than anything else
    _relation.signs, _relation.negated = _signs, BY_SIGNS[frozenset((-1, 0, 1)) - _signs]
    _relation.flipped = BY_SIGNS[frozenset(-sign for sign in _signs)]

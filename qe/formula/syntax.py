"""First-order formulas over the ordered field of the reals: a frozen syntax tree.

Semantics is the standard one over R. Every ``Atom`` of one formula has its polynomial in one common
``Ring``; quantifiers bind variables by name. Build formulas with ``qe.formula.build``, which keeps
the invariants stated on each class; these constructors do not simplify.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

from qe.exact.ring import Poly


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


class Formula:
    """Base class of all nodes; ``str()`` prints the text syntax."""

    __slots__ = ()

    def __str__(self) -> str:
        from qe.io.text import write

        return write(self)

    def _sympy_(self) -> Any:
        """The SymPy Boolean, wherever SymPy meets a formula; ``InputError`` for quantifiers and root atoms."""
        from qe.io.sympy import to_sympy

        return to_sympy(self)


@dataclass(frozen=True, slots=True, repr=False)
class Constant(Formula):
    """TRUE or FALSE."""

    value: bool

    def __repr__(self) -> str:
        return "TRUE" if self.value else "FALSE"


TRUE, FALSE = Constant(True), Constant(False)


@dataclass(frozen=True, slots=True)
class Atom(Formula):
    """``poly relation 0``. Invariant: poly is non-constant, primitive, with positive leading coefficient."""

    poly: Poly
    relation: Relation


@dataclass(frozen=True, slots=True)
class RootAtom(Formula):
    """``variable relation root_k(poly)``: the k-th smallest distinct real root of ``poly`` in ``variable``.

    ``k`` counts from 1; negative k counts from the largest (-1). The atom is false where fewer than |k| real
    roots exist, whatever the relation, and where poly vanishes identically in ``variable``. Because of that
    convention its negation is not a root atom again (Brown 1999, extended Tarski formulas).
    """

    variable: str
    relation: Relation
    poly: Poly
    k: int


@dataclass(frozen=True, slots=True)
class And(Formula):
    """Conjunction. Invariant (builders): at least two arguments, none an And or a Constant."""

    args: tuple[Formula, ...]


@dataclass(frozen=True, slots=True)
class Or(Formula):
    """Disjunction. Invariant (builders): at least two arguments, none an Or or a Constant."""

    args: tuple[Formula, ...]


@dataclass(frozen=True, slots=True)
class Not(Formula):
    """Negation."""

    arg: Formula


@dataclass(frozen=True, slots=True)
class Exists(Formula):
    """There are real values of ``variables`` such that ``body``."""

    variables: tuple[str, ...]
    body: Formula


@dataclass(frozen=True, slots=True)
class ForAll(Formula):
    """For all real values of ``variables``, ``body``."""

    variables: tuple[str, ...]
    body: Formula

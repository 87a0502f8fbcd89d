"""First-order formulas over the ordered field of the reals: a frozen syntax tree.

Semantics is the standard one over R. Every ``Atom`` of one formula has its polynomial in one common
``Ring``; quantifiers bind variables by name. Build formulas with ``qe.formula.build``, which keeps
the invariants stated on each class; these constructors do not simplify.
"""

from __future__ import annotations

from dataclasses import dataclass

from qe.exact.ring import Poly
from qe.formula.notation import Level, Notation, bracketed, chain, oriented, polynomial
from qe.formula.relation import Relation as Relation
from qe.formula.text import TEXT


class Formula:
    """Base class of all nodes; ``str()`` prints the text syntax."""

    __slots__ = ()

    def __str__(self) -> str:
        return self.written(TEXT)

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        """The text in a line format, with no more brackets than reading it back needs.

        ``level``: the construct around it; ``last``: nothing follows, so that a quantifier may stay open.
        """
        raise TypeError(f"not a formula: {self!r}")


@dataclass(frozen=True, slots=True, repr=False)
class Constant(Formula):
    """TRUE or FALSE."""

    value: bool

    def __repr__(self) -> str:
        return "TRUE" if self.value else "FALSE"

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return notation.true if self.value else notation.false


TRUE, FALSE = Constant(True), Constant(False)


@dataclass(frozen=True, slots=True)
class Atom(Formula):
    """``poly relation 0``. Invariant: poly is non-constant, primitive, with positive leading coefficient."""

    poly: Poly
    relation: Relation

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        parts, relation = oriented(self.poly, self.relation)
        return f"{polynomial(parts, notation)} {notation.relation(relation)} 0"


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

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return notation.root(self.variable, self.relation, self.poly, self.k)


@dataclass(frozen=True, slots=True)
class And(Formula):
    """Conjunction. Invariant (builders): at least two arguments, none an And or a Constant."""

    args: tuple[Formula, ...]

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return chain(self.args, Level.AND, level, last, notation)


@dataclass(frozen=True, slots=True)
class Or(Formula):
    """Disjunction. Invariant (builders): at least two arguments, none an Or or a Constant."""

    args: tuple[Formula, ...]

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return chain(self.args, Level.OR, level, last, notation)


@dataclass(frozen=True, slots=True)
class Not(Formula):
    """Negation."""

    arg: Formula

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        if isinstance(self.arg, RootAtom) or notation.strict:
            return notation.negation + bracketed(self.arg, notation.brackets, notation)
        return notation.negation + self.arg.written(notation, Level.NOT, last)


@dataclass(frozen=True, slots=True)
class Exists(Formula):
    """There are real values of ``variables`` such that ``body``."""

    variables: tuple[str, ...]
    body: Formula

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return _quantified(self, notation, last)


@dataclass(frozen=True, slots=True)
class ForAll(Formula):
    """For all real values of ``variables``, ``body``."""

    variables: tuple[str, ...]
    body: Formula

    def written(self, notation: Notation, level: Level = Level.OPEN, last: bool = True) -> str:
        return _quantified(self, notation, last)


def _quantified(formula: Exists | ForAll, notation: Notation, last: bool) -> str:
    prefix = notation.quantifier(isinstance(formula, ForAll), formula.variables)
    if notation.scope is not None:
        return prefix + bracketed(formula.body, notation.scope, notation)
    if not last:
        return bracketed(formula, notation.brackets, notation)
    return prefix + formula.body.written(notation)

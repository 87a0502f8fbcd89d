"""What a certificate says of an answer under assumptions: ``A implies (question iff answer)``.

A derivation leads from one formula to an equivalent one, so it says this in one of two forms, each of them the same as
the sentence above: ``(A implies question) iff (A implies answer)``, or, where the question begins with a universal
block, ``(A and question) iff (A and answer)``. Inside, at the question's place, A is known.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from qe.formula.build import conj, convert, disj, forall, implies
from qe.formula.normal import nnf
from qe.formula.numbers import unknowns
from qe.formula.syntax import TRUE, ForAll, Formula


class Aim(Enum):
    """What is wanted of an answer: that it is equivalent; so where polynomials are not zero; or a shorter formula."""

    EQUIVALENT = 1
    GENERIC = 2
    SHORTER = 3


@dataclass(frozen=True, slots=True)
class Posed:
    """A question as the engine gets it: ``known``, without quantifiers and over the same ring, may be used."""

    formula: Formula
    known: Formula = TRUE
    aim: Aim = Aim.EQUIVALENT

    @property
    def restricted(self) -> Formula:
        """Question and assumptions together."""
        return conj((self.known, self.formula))

    def closed(self, formula: Formula) -> Formula:
        """A formula wherever the assumptions hold; the values of the variables of which they speak are any."""
        return formula if self.known == TRUE else forall(unknowns(self.known.free), implies(self.known, formula))


def claimed(known: Formula, question: Formula, formula: Formula) -> Formula:
    """That side of what is claimed in which ``formula`` stands: the ``question`` or the answer to it, given ``known``.

    ``known`` and ``question`` are over one ring.
    """
    if known == TRUE:
        return formula
    ring = known.ring
    inner = formula if ring is None or formula.ring is None else convert(formula, ring)
    if isinstance(question, ForAll):
        return conj((known, inner))
    return disj((nnf(known, negate=True), inner))


def restricted(known: Formula, question: Formula) -> Formula:
    """The question, the assumptions joined to it so that they stand under its outermost quantifiers: existential ones
    have ``known and question``, universal ones ``known implies question``."""
    if isinstance(question, ForAll):
        return disj((nnf(known, negate=True), question))
    return conj((known, question))

"""A block of quantifiers with what its conditions look like, each worked out once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from qe.exact.ring import Poly
from qe.formula.build import exists, forall
from qe.formula.normal import nnf
from qe.formula.syntax import Atom, Atomic, Exists, ForAll, Formula
from qe.formula.traverse import atoms, conjuncts


@dataclass(frozen=True)
class Block:
    """One block of quantifiers of one kind: ``ex variables. body``, or ``all variables. body`` if ``universal``.

    The body may hold further quantifiers. A method that knows existential blocks only works on the ``dual``,
    ``ex variables. positive``, and turns its formula back by ``asked``.
    """

    variables: tuple[str, ...]
    body: Formula
    universal: bool = False

    @staticmethod
    def of(formula: Formula) -> Block | None:
        """The outermost block of a formula; None where it does not begin with a quantifier."""
        if isinstance(formula, Exists | ForAll):
            return Block(formula.variables, formula.body, isinstance(formula, ForAll))
        return None

    @cached_property
    def formula(self) -> Formula:
        """The block as one formula."""
        return (forall if self.universal else exists)(self.variables, self.body)

    @property
    def free(self) -> tuple[str, ...]:
        """The parameters."""
        return self.formula.free

    @property
    def is_flat(self) -> bool:
        """Whether nothing inside is quantified."""
        return self.body.is_quantifier_free

    @cached_property
    def positive(self) -> Formula:
        """The body of the existential block that is this one, or its negation if ``universal``, in normal form."""
        return nnf(self.body, negate=self.universal)

    @cached_property
    def dual(self) -> Block:
        """The existential block that is this one, or its negation if ``universal``, in negation normal form."""
        return Block(self.variables, self.positive) if self.universal or self.positive != self.body else self

    @cached_property
    def conditions(self) -> tuple[Formula, ...]:
        """The conjuncts of ``positive``."""
        return conjuncts(self.positive)

    @cached_property
    def atoms(self) -> tuple[Atomic, ...]:
        """Every atom occurrence of the body."""
        return tuple(atoms(self.body))

    @cached_property
    def polynomials(self) -> tuple[Poly, ...]:
        """The distinct polynomials of the atoms, in order of first occurrence."""
        return tuple(dict.fromkeys(a.poly for a in self.atoms))

    @cached_property
    def has_root_atoms(self) -> bool:
        """Whether a root atom occurs."""
        return any(not isinstance(a, Atom) for a in self.atoms)

    @cached_property
    def degree(self) -> int:
        """The highest degree of a quantified variable."""
        places = ((p, p.ring.index.get(v)) for p in self.polynomials for v in self.variables)
        return max((p.degree(i) for p, i in places if i is not None), default=0)

    @cached_property
    def curved(self) -> int:
        """How many of the polynomials are not linear."""
        return sum(p.total_degree > 1 for p in self.polynomials)

    @cached_property
    def occurring(self) -> int:
        """How many of the quantified variables occur."""
        return sum(v in self.body.free for v in self.variables)

    @property
    def total(self) -> int:
        """How many variables occur, the parameters among them."""
        return len(self.body.free)

    def asked(self, formula: Formula) -> Formula:
        """The answer to this block, from one to its dual."""
        return nnf(formula, negate=self.universal)

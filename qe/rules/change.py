"""Variables chosen as polynomials in the others: translations, scalings, rotations and mirrors end in this."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import Atom, Formula
from qe.rules.lift import Solve
from qe.rules.rewrite import rewrite
from qe.rules.tree import Lifted, solved


@dataclass(frozen=True, slots=True)
class Change:
    """``values``: what takes the places of variables that no quantifier inside binds; these are not in it."""

    values: Mapping[str, Poly]

    @staticmethod
    def to_number(name: str, number: int, ring: Ring) -> Change:
        """One variable fixed."""
        return Change({name: ring.constant(number)})

    def image(self, formula: Formula) -> Formula:
        """The formula with the values; root atoms must not contain the variables."""

        def change(given: Atom) -> Formula:
            index = given.poly.ring.index
            places = {index[name]: value for name, value in self.values.items() if given.poly.degree(index[name])}
            return atom(given.poly.compose(places), given.relation) if places else given

        return rewrite(formula, change)

    @property
    def lifts(self) -> tuple[Solve, ...]:
        """The way back."""
        return tuple(Solve(name, value, value.ring.constant(1)) for name, value in self.values.items())

    def node(self, variables: tuple[str, ...], body: Formula) -> Lifted:
        """The block at the values, still to be reduced."""
        return solved(self.lifts, variables, self.image(body))

"""Division and square roots as SMT-LIB has them: total functions whose values outside their domains are not known.

``x/0`` is f(x) for a function f that nothing is known of. A value f(t) whose argument has no bound variables is a new
unknown, and equal arguments give equal unknowns (W. Ackermann's reduction). Where the argument has bound variables f
cannot be written down; then the formula is either weakened (every use has a value of its own: if that cannot be
satisfied, nor can what was written), or f is a constant or the identity (what is satisfied then is satisfiable).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from math import prod
from typing import Any

from qe.errors import InputError
from qe.exact.ring import Poly
from qe.formula.build import conj
from qe.formula.evaluate import truth_under
from qe.formula.syntax import Formula
from qe.io.cases import Case


class Fill(Enum):
    """What is known of the values outside the domains."""

    ANY = "any"
    CONSTANT = "constant"
    ARGUMENT = "argument"


@dataclass(slots=True)
class Total:
    """How functions are made total in one lowering, and what came of it. ``bound``: the names that quantifiers bind.
    ``values``: function and arguments (the same term in several cases) of every unknown, by its name. ``weakened``:
    whether the formula says less than was written; ``unclear``: whether it may also say more."""

    bound: frozenset[str] = frozenset()
    fill: Fill = Fill.ANY
    values: dict[str, tuple[str, tuple[Case, ...]]] = field(default_factory=dict)
    weakened: bool = False
    unclear: bool = False

    def checked(self, formula: Formula) -> Formula:
        """The formula, if it says what was written. Raises ``InputError`` where no formula does."""
        if self.weakened:
            raise InputError("x/0 is any function of x, which no formula says where x is bound; qe smt runs scripts")
        return formula

    def at(self, point: Mapping[str, Any]) -> list[tuple[str, Any, Any]]:
        """Function, argument and value of the unknowns at a point; not those whose argument is no quotient there, or
        is another one by their guards. Those whose guards are not decided at sight come last."""
        certain: list[tuple[str, Any, Any]] = []
        doubtful: list[tuple[str, Any, Any]] = []

        def sign(poly: Poly) -> int | None:
            if any(poly.ring.names[i] not in point for i in poly.variables):
                return None
            value = _at(poly, point)
            return int(value > 0) - int(value < 0)

        for name, (function, cases) in self.values.items():
            for case in cases:
                holds = truth_under(conj(case.guards), sign)
                if holds is False:
                    continue
                names = case.value.poly.ring.names
                polys = [case.value.poly, *(factor for factor, _ in case.below)]
                if all(names[i] in point for poly in polys for i in poly.variables):
                    below = prod((_at(factor, point) ** k for factor, k in case.below), start=Fraction(case.value.den))
                    if below != 0:
                        value = _at(case.value.poly, point) / below
                        (certain if holds else doubtful).append((function, value, point.get(name, Fraction(0))))
        return certain + doubtful

    def begin(self) -> None:
        """Forget what an earlier attempt told."""
        self.values.clear()
        self.weakened = self.unclear = False


def _at(poly: Poly, point: Mapping[str, Any]) -> Any:
    names = poly.ring.names
    values = (prod([c, *(point[names[i]] ** k for i, k in powers)]) for powers, c in poly.sparse_terms())
    return sum(values, Fraction(0))

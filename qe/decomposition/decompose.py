"""A prenex formula to a cell table: order, projection, lifting."""

from __future__ import annotations

from dataclasses import dataclass

from qe.decomposition.constraints import Constraints, equational_constraints
from qe.decomposition.lifting import Lifter, Plan, sector_levels
from qe.decomposition.matrix import compile_matrix, strengthened
from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.operators.operator import Operator
from qe.decomposition.projection import factor_lists
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.exact.watch import Watch
from qe.formula.build import convert
from qe.formula.monotone import direction
from qe.formula.syntax import Formula
from qe.formula.traverse import polynomials
from qe.options import Budget
from qe.proof.cells import CellTable


@dataclass(frozen=True, slots=True)
class Decomposition:
    """The table and what it cost. ``operator``: of its projection; ``nullified``: it had to take over from another."""

    table: CellTable
    operator: Operator
    cells: int
    stacks: int
    factors: int
    nullified: bool

    @property
    def restricted(self) -> tuple[str, ...]:
        """The variables at whose levels an equational constraint restricted projection and lifting."""
        return tuple(v for v, own in zip(self.table.order, self.table.constraints, strict=False) if own)


@dataclass(frozen=True, slots=True, kw_only=True)
class Tactics:
    """Which of its shortcuts a decomposition takes; the answers are equivalent.

    ``constraints``: projection and lifting restricted by equational constraints. ``partial``: nothing is decomposed
    where the truth is known already. ``open_only``: sectors only where all atoms are strict. ``whole_free``: no
    shortcut but a longer way: the space of the free variables is decomposed also where the truth is known, which
    gives every free cell the signs of all factors and formula construction more to choose from.
    ``free_constraints``: constraints restrict the levels of free variables too, where their sectors then lack signs.
    ``monotone``: where the truth changes only once along the last free variable, that place is found by bisection.
    ``anytime``: where the budget ends, the table says what is decided in the space of the free variables; its other
    cells there have no truth value.
    """

    constraints: bool = True
    anytime: bool = False
    partial: bool = True
    open_only: bool = True
    whole_free: bool = False
    free_constraints: bool = True
    monotone: bool = True


def decompose(
    matrix: Formula,
    order: tuple[str, ...],
    quantifiers: tuple[str, ...],
    *,
    budget: Budget,
    operator: Operator = BROWN_MCCALLUM,
    thom_levels: frozenset[int] = frozenset(),
    tactics: Tactics = Tactics(),
    extra: tuple[Poly, ...] = (),
) -> Decomposition:
    """The cell table of Q_k x_k … Q_n x_n. matrix over the variables ``order`` (free ones first).

    Where the operator meets a nullified factor that its theorem does not allow, the work is redone with the one that
    takes over. ``thom_levels``: levels at which two cells over the same cell
    differ in signs (derivatives join the factors: see ``factor_lists``, and ``Lifter.lacking`` for nullified ones).
    ``extra``: polynomials over the ring of ``order`` whose factors are to be in the lists too.
    Raises ``BudgetExceeded``.
    """
    job = _Job(convert(matrix, Ring.of(order)), order, quantifiers, budget, thom_levels, tactics, operator)
    return operator.applied(lambda used: job.attempt(used, extra))


@dataclass(frozen=True, slots=True)
class _Job:
    matrix: Formula
    order: tuple[str, ...]
    quantifiers: tuple[str, ...]
    budget: Budget
    thom_levels: frozenset[int]
    tactics: Tactics
    chosen: Operator

    def _constraints(self) -> Constraints:
        """The equational constraints that the tactics let take part."""
        if not self.tactics.constraints or not any(self.quantifiers[-1:]):
            return Constraints()
        found = equational_constraints(self.matrix, len(self.order))
        if self.tactics.free_constraints:
            return found
        return Constraints({k: own for k, own in found.factors.items() if self.quantifiers[k]}, found.implied)

    def _direction(self) -> int:
        """In which direction of the last free variable the matrix stays true."""
        free = sum(quantifier == "" for quantifier in self.quantifiers)
        return direction(self.matrix, free - 1) if 0 < free < len(self.order) else 0

    def attempt(self, operator: Operator, added: tuple[Poly, ...]) -> Decomposition:
        """``added``: polynomials in the factor lists besides those of the matrix."""
        size = len(self.order)
        constraints = self._constraints() if operator.restricted else Constraints()
        listed = [*polynomials(self.matrix), *added]
        levels = factor_lists(listed, size, operator, self.budget, self.thom_levels, constraints.factors)
        places = {f: (k, j) for k, level in enumerate(levels) for j, f in enumerate(level)}
        strong = strengthened(self.matrix, constraints.implied, places)
        indices = {
            k: frozenset(places[f][1] for f in own)
            for k, own in constraints.factors.items()
            if len(own) < len(levels[k])  # a constraint made of all factors restricts nothing
        }
        sectors_from = sector_levels(self.matrix, self.quantifiers) if self.tactics.open_only else size
        plan = Plan(
            levels,
            self.quantifiers,
            operator,
            sectors_from,
            indices,
            self.tactics.partial,
            self.tactics.whole_free,
            self.thom_levels,
            self._direction() if self.tactics.monotone else 0,
        )
        lifter = Lifter(plan, self.budget, anytime=self.tactics.anytime)
        root = lifter.run(Point(Ring.of(self.order), watch=Watch(self.budget.check)), compile_matrix(strong, places))
        if lifter.lacking:
            return self.attempt(operator, (*added, *lifter.lacking))
        restricted = tuple(tuple(sorted(indices.get(k, ()))) for k in range(size)) if indices else ()
        table = CellTable(self.order, self.quantifiers, self.matrix, operator.proof, levels, root, restricted)
        nullified = operator != self.chosen
        return Decomposition(table, operator, lifter.cells, lifter.stacks, sum(map(len, levels)), nullified)

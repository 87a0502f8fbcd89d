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
class Decomposed:
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
) -> Decomposed:
    """The cell table of Q_k x_k … Q_n x_n. matrix over the variables ``order`` (free ones first).

    Where the operator meets a nullified factor that its theorem does not allow, the work is redone with the one that
    takes over. ``thom_levels``: levels at which two cells over the same cell
    differ in signs (derivatives join the factors: see ``factor_lists``, and ``Lifter.lacking`` for nullified ones).
    ``extra``: polynomials over the ring of ``order`` whose factors are to be in the lists too.
    Raises ``BudgetExceeded``.
    """
    matrix, size = convert(matrix, Ring.of(order)), len(order)
    free = sum(quantifier == "" for quantifier in quantifiers)
    takes_part = tactics.constraints and operator.restricted and any(quantifiers[-1:])
    found = equational_constraints(matrix, size) if takes_part else Constraints()
    kept = {k: own for k, own in found.factors.items() if tactics.free_constraints or quantifiers[k]}
    restricting = Constraints(kept, found.implied)
    sectors_from = sector_levels(matrix, quantifiers) if tactics.open_only else size
    way = direction(matrix, free - 1) if tactics.monotone and 0 < free < size else 0

    def attempt(used: Operator, added: tuple[Poly, ...]) -> Decomposed:
        """``added``: polynomials in the factor lists besides those of the matrix."""
        constraints = restricting if used.restricted else Constraints()
        listed = [*polynomials(matrix), *added]
        levels = factor_lists(listed, size, used, budget, thom_levels, constraints.factors)
        places = {f: (k, j) for k, level in enumerate(levels) for j, f in enumerate(level)}
        strong = strengthened(matrix, constraints.implied, places)
        indices = {
            k: frozenset(places[f][1] for f in own)
            for k, own in constraints.factors.items()
            if len(own) < len(levels[k])  # a constraint made of all factors restricts nothing
        }
        plan = Plan(
            levels, quantifiers, used, sectors_from, indices, tactics.partial, tactics.whole_free, thom_levels, way
        )
        lifter = Lifter(plan, budget, anytime=tactics.anytime)
        root = lifter.run(
            Point(Ring.of(order), watch=Watch(budget.check, budget.spend)), compile_matrix(strong, places)
        )
        if lifter.lacking:
            return attempt(used, (*added, *lifter.lacking))
        restricted = tuple(tuple(sorted(indices.get(k, ()))) for k in range(size)) if indices else ()
        table = CellTable(order, quantifiers, matrix, used.proof, levels, root, restricted)
        return Decomposed(table, used, lifter.cells, lifter.stacks, sum(map(len, levels)), used != operator)

    return operator.applied(lambda used: attempt(used, extra))

"""One conjunction under the block: equations, weak and strict inequalities in parameters and quantified variables."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product

from qe.convex.system import Condition, NotConvex, read_system
from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.openness import is_closed, is_open
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation
from qe.proof.multipliers import FormRelation

MAX_DISJUNCTS = 32


@dataclass(frozen=True)
class System:
    """A conjunction over ``ring``, whose first ``free`` variables are the parameters.

    ``guards``: atoms in the parameters alone; ``conditions``: the others. Invariant: no condition is an inequation.
    """

    ring: Ring
    free: int
    guards: tuple[Atom, ...]
    conditions: tuple[Condition, ...]

    @property
    def bound(self) -> tuple[int, ...]:
        """The indices of the quantified variables."""
        return tuple(range(self.free, self.ring.size))

    @property
    def equations(self) -> tuple[Poly, ...]:
        return tuple(c.poly for c in self.conditions if c.relation is FormRelation.EQ)

    @property
    def inequalities(self) -> tuple[Poly, ...]:
        """The distinct ones, whether strict or weak: the closed conditions say the same."""
        return tuple(dict.fromkeys(c.poly for c in self.conditions if c.relation is not FormRelation.EQ))

    @cached_property
    def is_closed(self) -> bool:
        """Whether all relations are weak: over bounded fibres the truth set in the parameters is then closed."""
        return is_closed(self.formula, range(self.ring.size))

    @cached_property
    def is_open(self) -> bool:
        """Whether all relations are strict: the truth set is then open."""
        return is_open(self.formula, range(self.ring.size))

    @cached_property
    def is_convex(self) -> bool:
        """Whether the conjunction describes a convex set of parameters and quantified variables together.

        Decided exactly: linear equations, and inequalities of degree at most two with semidefinite Hessian.
        """
        try:
            read_system(self.formula)
        except NotConvex:
            return False
        return True

    def without_parameters(self) -> System:
        """The same conjunction with all variables counted as quantified."""
        guards = tuple(Condition.of(a) for a in self.guards if a.relation is not Relation.NE)
        return System(self.ring, 0, (), (*guards, *self.conditions))

    @property
    def formula(self) -> Formula:
        """The conjunction as a formula."""
        return conj((*self.guards, self.inner))

    @property
    def inner(self) -> Formula:
        """The conditions as a formula, without the guards."""
        relations = {FormRelation.LE: Relation.LE, FormRelation.LT: Relation.LT, FormRelation.EQ: Relation.EQ}
        return conj(atom(c.poly, relations[c.relation]) for c in self.conditions)


def systems(body: Formula, ring: Ring, free: int) -> list[System]:
    """The disjuncts of a quantifier-free positive body over ``ring``: the block distributes over them.

    Inequations in quantified variables are split into < and >. Raises ``Unable`` for too many disjuncts and for
    root atoms.
    """
    return [_system(literals, ring, free) for literals in _disjuncts(body, free)]


def _disjuncts(formula: Formula, free: int) -> list[tuple[Atom, ...]]:
    match formula:
        case Constant(value):
            return [()] if value else []
        case Atom(poly, Relation.NE) if poly.level >= free:
            return [(Atom(poly, Relation.LT),), (Atom(poly, Relation.GT),)]
        case Atom():
            return [(formula,)]
        case Or(args):
            found = [d for a in args for d in _disjuncts(a, free)]
        case And(args):
            found = [()]
            for arg in args:
                found = [(*left, *right) for left, right in product(found, _disjuncts(arg, free))]
                if len(found) > MAX_DISJUNCTS:
                    break
        case _:
            raise Unable(f"critical-value elimination: no {type(formula).__name__} inside the block")
    if len(found) > MAX_DISJUNCTS:
        raise Unable(f"critical-value elimination: more than {MAX_DISJUNCTS} disjuncts")
    return found


def _system(literals: tuple[Atom, ...], ring: Ring, free: int) -> System:
    distinct = tuple(dict.fromkeys(literals))
    guards = tuple(a for a in distinct if a.poly.level < free)
    conditions = tuple(Condition.of(a) for a in distinct if a.poly.level >= free)
    return System(ring, free, guards, conditions)

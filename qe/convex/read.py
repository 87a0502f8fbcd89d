"""Reading a convex problem: objective and conjunction of atoms to quadratic polynomials over Q, convexity checked."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from qe.errors import Unable
from qe.exact.quadratic_form import Definiteness, Quadratic, combine, definiteness, quadratic
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.formula.syntax import And, Atom, Constant, Formula, Relation


class NotConvex(Unable):
    """The problem is not a convex quadratic one; general quantifier elimination can still solve it."""


@dataclass(frozen=True, slots=True)
class Constraint:
    """``form`` <= 0, < 0 (``strict``) or = 0 (``equation``, then linear); ``index`` is the place in the input."""

    index: int
    atom: Atom
    form: Quadratic
    strict: bool
    equation: bool


@dataclass(frozen=True, slots=True)
class Problem:
    """Minimise ``objective`` over the points that satisfy every constraint.

    Invariant: the objective and every inequality form are convex, every equation is linear. ``names`` are the
    variables that occur, in ring order; ``contradiction`` is set when the input is FALSE.
    """

    names: tuple[str, ...]
    objective: Quadratic
    constraints: tuple[Constraint, ...]
    contradiction: bool = False

    @property
    def inequalities(self) -> tuple[Constraint, ...]:
        return tuple(c for c in self.constraints if not c.equation)

    @property
    def equations(self) -> tuple[Constraint, ...]:
        return tuple(c for c in self.constraints if c.equation)


def read_problem(objective: Poly, constraints: Formula, *, scale: Fraction | int = 1) -> Problem:
    """Minimise ``scale * objective`` subject to a conjunction of atoms.

    Raises ``NotConvex`` when the objective or a constraint is not a convex quadratic polynomial (decided exactly,
    by LDL^T), an equation is not linear, or the formula is not a conjunction of <, <=, =, >=, >.
    """
    atoms = _atoms(constraints)
    ring = _common_ring(objective, atoms)
    objective = objective.convert(ring)
    atoms = [a for a in (convert(a, ring) for a in atoms) if isinstance(a, Atom)]
    occurring = sorted(set(objective.variables).union(*(a.poly.variables for a in atoms)))
    names = tuple(ring.names[i] for i in occurring)
    form = quadratic(objective, occurring)
    if form is None:
        raise NotConvex("the objective has degree above 2")
    form = combine([Fraction(scale)], [form])
    if definiteness(form.hessian) is Definiteness.NOT_SEMIDEFINITE:
        raise NotConvex("the objective is not convex")
    read = tuple(_constraint(i, a, occurring) for i, a in enumerate(atoms))
    return Problem(names, form, read, contradiction=constraints == Constant(False))


def _atoms(constraints: Formula) -> list[Atom]:
    match constraints:
        case Constant():
            return []
        case Atom():
            return [constraints]
        case And(args) if all(isinstance(a, Atom) for a in args):
            return [a for a in args if isinstance(a, Atom)]
    raise NotConvex("the constraints are not a conjunction of polynomial relations")


def _common_ring(objective: Poly, atoms: list[Atom]) -> Ring:
    ring = objective.ring
    for a in atoms:
        if a.poly.ring is not ring:
            extra = tuple(n for n in a.poly.ring.names if n not in ring.index)
            ring = Ring.of(ring.names + extra)
    return ring


def _constraint(index: int, atom: Atom, variables: list[int]) -> Constraint:
    form = quadratic(atom.poly, variables)
    if form is None:
        raise NotConvex(f"constraint {index + 1} has degree above 2")
    if atom.relation is Relation.NE:
        raise NotConvex(f"constraint {index + 1} is a disequation")
    if atom.relation is Relation.EQ:
        if not form.is_linear:
            raise NotConvex(f"constraint {index + 1} is a nonlinear equation")
        return Constraint(index, atom, form, False, True)
    if atom.relation in (Relation.GE, Relation.GT):
        form = combine([Fraction(-1)], [form])
    if definiteness(form.hessian) is Definiteness.NOT_SEMIDEFINITE:
        raise NotConvex(f"constraint {index + 1} does not describe a convex set")
    return Constraint(index, atom, form, atom.relation.is_strict, False)

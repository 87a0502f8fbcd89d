"""Convex quadratic systems over Q: read from formulas, with their convexity decided exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.errors import Unable
from qe.exact.quadratic_form import Definiteness, Matrix, Quadratic, combine, definiteness, quadratic
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import FALSE, And, Atom, Constant, Formula, Relation
from qe.proof.multipliers import FormRelation


class NotConvex(Unable):
    """The problem is not a convex quadratic one; general quantifier elimination can still solve it."""


@dataclass(frozen=True, slots=True)
class Condition:
    """``poly relation 0`` with the relation <=, < or =."""

    poly: Poly
    relation: FormRelation

    @staticmethod
    def of(atom: Atom) -> Condition:
        """The same condition as an atom other than an inequation."""
        if atom.relation is Relation.EQ:
            return Condition(atom.poly, FormRelation.EQ)
        relation = FormRelation.LT if atom.relation.is_strict else FormRelation.LE
        return Condition(atom.poly if atom.relation in (Relation.LT, Relation.LE) else -atom.poly, relation)

    def form(self, variables: Sequence[int]) -> Quadratic:
        """The polynomial as a quadratic one in these variables of its ring, which are all that occur.

        Raises ``NotConvex``, with the reason, unless it is linear in an equation, convex in an inequality.
        """
        form = quadratic(self.poly, variables)
        if form is None:
            raise NotConvex("has degree above 2")
        if not is_convex(form.hessian, self.relation):
            nonlinear = self.relation is FormRelation.EQ
            raise NotConvex("is a nonlinear equation" if nonlinear else "does not describe a convex set")
        return form


def is_convex(hessian: Matrix, relation: FormRelation) -> bool:
    """Whether a quadratic condition with this Hessian is convex: linear in an equation, semidefinite otherwise."""
    if relation is FormRelation.EQ:
        return not any(map(any, hessian))
    return definiteness(hessian) is not Definiteness.NOT_SEMIDEFINITE


@dataclass(frozen=True, slots=True)
class ConvexSystem:
    """``forms[i] relations[i] 0`` for all i, in the variables ``names``: convex inequalities and linear equations.

    ``objective`` (convex) is to be least on it; 0 where only a solution is asked for.
    """

    names: tuple[str, ...]
    objective: Quadratic
    forms: tuple[Quadratic, ...]
    relations: tuple[FormRelation, ...]

    @property
    def is_weak(self) -> bool:
        """Whether there are no equations and no strict inequalities."""
        return all(r is FormRelation.LE for r in self.relations)


def constant(size: int, value: int) -> Quadratic:
    """A constant as a quadratic polynomial in so many variables."""
    return Quadratic.linear((Fraction(0),) * size, value)


def read_system(conditions: Formula, objective: Poly | None = None, *, scale: Fraction | int = 1) -> ConvexSystem:
    """The conjunction, in the variables that occur, in ring order, with ``scale * objective`` to be least.

    FALSE is read as 1 <= 0. Raises ``NotConvex`` when the objective or a condition is not a convex quadratic one
    (decided exactly, by LDL^T), an equation is not linear, or the formula is not a conjunction of <, <=, =, >=, >.
    """
    atoms, least = atoms_of(conditions), Ring.of(()).constant(0) if objective is None else objective
    ring = Ring.of(dict.fromkeys(name for p in (least, *(a.poly for a in atoms)) for name in p.ring.names))
    least, polys = least.convert(ring), [a.poly.convert(ring) for a in atoms]
    occurring = sorted({i for p in (least, *polys) for i in p.variables})
    form = quadratic(least, occurring)
    if form is None:
        raise NotConvex("the objective has degree above 2")
    form = combine([Fraction(scale)], [form])
    if not is_convex(form.hessian, FormRelation.LE):
        raise NotConvex("the objective is not convex")
    read = [_read(k, Atom(p, a.relation), occurring) for k, (p, a) in enumerate(zip(polys, atoms, strict=True), 1)]
    if conditions == FALSE:
        read.append((constant(len(occurring), 1), FormRelation.LE))
    names = tuple(ring.names[i] for i in occurring)
    return ConvexSystem(names, form, tuple(f for f, _ in read), tuple(r for _, r in read))


def atoms_of(conditions: Formula) -> list[Atom]:
    """The atoms of a conjunction; none for a constant. Raises ``NotConvex`` for other formulas."""
    match conditions:
        case Constant():
            return []
        case Atom():
            return [conditions]
        case And(args) if all(isinstance(a, Atom) for a in args):
            return [a for a in args if isinstance(a, Atom)]
    raise NotConvex("the constraints are not a conjunction of polynomial relations")


def _read(number: int, atom: Atom, variables: Sequence[int]) -> tuple[Quadratic, FormRelation]:
    if atom.relation is Relation.NE:
        raise NotConvex(f"constraint {number} is a disequation")
    condition = Condition.of(atom)
    try:
        return condition.form(variables), condition.relation
    except NotConvex as error:
        raise NotConvex(f"constraint {number} {error}") from None

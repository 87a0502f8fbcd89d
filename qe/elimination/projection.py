"""Shadows of polyhedra: an existential block over linear conditions with numbers as coefficients, and its dual.

Where such conditions have no parameters, and one more, linear in the variables, has parameters in its coefficients, the
answer is read off the polyhedron's vertices v and directions r, whose sums of nonnegative multiples, those of the
vertices adding up to 1, are all of it (Minkowski 1896, Weyl 1935).
THEOREM. Let a linear form f, with f(x) = f0(x) + f(0), be given on a polyhedron P that is not empty. Then f > 0 at a
point of P exactly if f(v) > 0 for some v or f0(r) > 0 for some r. PROOF. f(x) is the sum of l_i f(v_i) and m_j f0(r_j)
with l_i, m_j >= 0; and f(v + t r) = f(v) + t f0(r) grows with t. If P is closed the same is true of f >= 0 and
f(v) >= 0: where no f0(r) is positive, f is largest at a vertex. The points that keep P's strict inequalities are dense
in P if there are any, so that f > 0 at one of them if at any; f = 0 where f >= 0 and f <= 0 are, as P is connected.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.convex.cone import Cone, Vector, dot
from qe.convex.linear_rows import LinearRows, linear_atoms
from qe.convex.polyhedron import Check, Polyhedron
from qe.convex.shadow import shadow
from qe.elimination.protocol import Context, Outcome
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, disj
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, Atom, Constant, Formula, Relation
from qe.formula.traverse import connected, disjuncts
from qe.options import Options

_STEP = 10
"""Units of work of one look at a row."""


class Projection:
    """Conjunctions of linear conditions: the answer has no condition that the others imply."""

    name = "projection"

    def suits(self, problem: Block, options: Options) -> str | None:
        """One block with parameters."""
        return f"{len(problem.variables)} variables" if problem.is_flat and problem.free else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """The shadow; None where the body is no conjunction of linear equations and inequalities."""

        def check() -> None:
            context.budget.spend(_STEP)
            context.budget.check("projection")

        if not (atoms := linear_atoms(problem.positive)):
            positive = None if context.options.certify else _by_generators(problem, check)
            if positive is None:
                return None
            after = nnf(positive, negate=problem.universal)
            shortest = _is_irredundant(linear_atoms(nnf(positive, negate=True)), check)
            return Outcome(context.log.step("projection", problem.formula, after), shortest=shortest)
        system = LinearRows.of(atoms)
        bound = [j for j, name in enumerate(system.names) if name in problem.variables]
        projected = shadow(Polyhedron.of(system), bound, check)
        positive = FALSE if projected is None else _formula(projected, system.names, problem.free)
        after = nnf(positive, negate=problem.universal)
        return Outcome(context.log.step("projection", problem.formula, after), shortest=True)


def _is_irredundant(atoms: Sequence[Atom], check: Check) -> bool:
    """Whether none of these linear conditions follows from the others."""
    polyhedron = Polyhedron.of(LinearRows.of(atoms))
    kept = polyhedron.irredundant(check)
    return kept is not None and 0 < len(kept.halves) == len(polyhedron.halves) == len(atoms)


def _formula(projected: Polyhedron, names: tuple[str, ...], free: tuple[str, ...]) -> Formula:
    """The conditions; two half-spaces that touch are an equation."""
    ring = Ring.of(free)
    known = {(row.normal, row.constant) for row in projected.halves if not row.strict}
    parts = [row.condition(names, ring, Relation.EQ) for row in projected.equations]
    for row in projected.halves:
        opposite = tuple((j, -c) for j, c in row.normal), -row.constant
        flat = not row.strict and opposite in known
        parts.append(row.condition(names, ring, Relation.EQ if flat else None))
    return conj(dict.fromkeys(parts))


def _by_generators(problem: Block, check: Check) -> Formula | None:
    """The positive answer by the second theorem, for variables that conditions join at a time (those of a box one after
    the other); None where the body is not of its kind."""
    plain = [f for f in problem.conditions if {*f.free} <= {*problem.variables} and linear_atoms(f)]
    curved = [f for f in problem.conditions if f not in plain]
    if len(curved) != 1 or not plain:
        return None
    forms = [_form(f, problem.variables) for f in disjuncts(curved[0])]
    if all(form is not None and all(c.is_constant for c in form[0][:-1]) for form in forms):
        return None  # substitution answers that, with evidence
    joined = [(sorted(names), parts) for names, parts in connected(plain, lambda part: frozenset(part.free))[1]]
    single = [([v], ()) for v in problem.variables if not any(v in names for names, _ in joined)]
    for names, parts in (*joined, *single):
        atoms = linear_atoms(conj(parts))
        if (cone := _generated(LinearRows.of(atoms), names, check)) is None:
            return FALSE
        is_closed = not any(a.relation.is_strict for a in atoms)
        images = [_image(f, names, cone, is_closed) for f in disjuncts(curved[0])]
        if None in images:
            return None
        curved = [disj(image for image in images if image is not None)]
    return curved[0]


def _image(given: Formula, names: Sequence[str], cone: Cone, is_closed: bool) -> Formula | None:
    """That a condition that is linear in variables holds at a point of their polyhedron; None of any other."""
    if isinstance(given, Constant):
        return given
    form = _form(given, names)
    return None if form is None else _somewhere(*form, cone, is_closed)


def _form(given: Formula, names: Sequence[str]) -> tuple[list[Poly], Relation] | None:
    """The coefficients of a condition that is linear in variables, and what is constant in them; else None."""
    if not isinstance(given, Atom):
        return None
    ring, rest = given.poly.ring, given.poly
    places = [ring.index[name] for name in names if name in ring.index]
    coefficients = {i: (given.poly.coefficients(i)[1:] or [ring.constant(0)]) for i in places}
    if any(len(c) > 1 or any(c[0].degree(j) for j in places) for c in coefficients.values()):
        return None
    for i in places:
        rest = rest - coefficients[i][0] * ring.gen(i)
    zero = [ring.constant(0)]
    return [*((coefficients.get(ring.index.get(name, -1)) or zero)[0] for name in names), rest], given.relation


def _generated(system: LinearRows, names: Sequence[str], check: Check) -> Cone | None:
    """The cone over a polyhedron: vertices with a last coordinate > 0, directions with 0; None where it is empty."""
    cone, strict = Cone(len(names) + 1), list[Vector]()
    cone.cut((*(0 for _ in names), -1))
    for row in system.rows:
        check()
        terms = {system.names[j]: c for j, c in row.terms.items()}
        normal = (*(terms.get(name, 0) for name in names), row.constant)
        cone.cut(normal)
        if row.is_equation:
            cone.cut(tuple(-c for c in normal))
        strict += [normal] if row.is_strict else []
    inner = tuple(map(sum, zip(*cone.rays)))
    return cone if inner and inner[-1] > 0 and all(dot(normal, inner) < 0 for normal in strict) else None


def _somewhere(form: Sequence[Poly], relation: Relation, cone: Cone, is_closed: bool) -> Formula | None:
    """That a linear form is positive (>= 0, …) at a point of a polyhedron; None where that depends on its boundary."""
    if relation in (Relation.LT, Relation.LE):
        return _somewhere([-c for c in form], relation.flipped, cone, is_closed)
    if not (is_closed or relation in (Relation.GT, Relation.NE)):
        return None
    if relation is Relation.EQ:
        sides = (_somewhere(form, side, cone, is_closed) for side in (Relation.GE, Relation.LE))
        return conj(side for side in sides if side is not None)

    def value(generator: Vector) -> Poly:
        return sum((c * k for c, k in zip(form, generator, strict=True)), form[0] * 0)

    ends = (atom(value(v), relation if v[-1] or relation is Relation.NE else Relation.GT) for v in cone.rays)
    return disj((*ends, *(atom(value(line), Relation.NE) for line in cone.lines)))

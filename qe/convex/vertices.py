"""Linear forms on polyhedra with numbers as coefficients: what they are at vertices and along directions.

A polyhedron is all sums of nonnegative multiples of its vertices v and directions r, those of the vertices adding up
to 1 (Minkowski 1896, Weyl 1935).
THEOREM. Let a linear form f, with f(x) = f0(x) + f(0), be given on a polyhedron P that is not empty. Then f > 0 at a
point of P exactly if f(v) > 0 for some v or f0(r) > 0 for some r. PROOF. f(x) is the sum of l_i f(v_i) and m_j f0(r_j)
with l_i, m_j >= 0; and f(v + t r) = f(v) + t f0(r) grows with t. If P is closed the same is true of f >= 0 and
f(v) >= 0: where no f0(r) is positive, f is largest at a vertex. The points that keep P's strict inequalities are dense
in P if there are any, so that f > 0 at one of them if at any; f = 0 where f >= 0 and f <= 0 are, as P is connected.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from qe.convex.cone import Cone, Vector, dot
from qe.convex.linear_rows import LinearRows, linear_atoms
from qe.exact.ring import Poly
from qe.formula.block import Block
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import connected

_HEIGHTS = (101, 1009, 10007)
"""Generators are lifted to powers of 7 modulo one of these primes; the next where not all pieces are simplices."""
MOST_PIECES = 24
"""Pieces of a polyhedron, at most, for a proof, whose length grows with the third power."""


@dataclass(frozen=True, slots=True)
class Generated:
    """The polyhedron of some conditions: ``cone`` has a last coordinate > 0 at its vertices, and 0 in its directions.

    ``inner``: the sum of its rays, which lies inside.
    """

    names: tuple[str, ...]
    conditions: tuple[Atom, ...]
    cone: Cone
    inner: Vector

    @staticmethod
    def of(names: Sequence[str], conditions: Sequence[Formula], check: Callable[[], object]) -> Generated | None:
        """None where it is empty."""
        atoms, cone, strict = tuple(linear_atoms(conj(conditions))), Cone(len(names) + 1), list[Vector]()
        system = LinearRows.of(atoms)
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
        is_empty = not inner or inner[-1] <= 0 or any(dot(normal, inner) >= 0 for normal in strict)
        return None if is_empty else Generated(tuple(names), atoms, cone, inner)

    @property
    def is_closed(self) -> bool:
        """Whether it has its boundary."""
        return not any(a.relation.is_strict for a in self.conditions)

    def ends(self, form: LinearForm) -> dict[Vector, Formula] | None:
        """Conditions of which one holds iff a form is positive (>= 0, /= 0) somewhere, each with its generator; None
        where that depends on the boundary."""
        if not self.is_closed and form.relation is Relation.GE:
            return None
        strict = form.relation if form.relation is Relation.NE else Relation.GT
        ends = {v: atom(form.at(v), form.relation if v[-1] else strict) for v in self.cone.rays}
        return ends | {line: atom(form.at(line), Relation.NE) for line in self.cone.lines}

    def pieces(self) -> list[tuple[Vector, list[Vector]]]:
        """Linear functions, each the largest on a piece that these generators span, and independent ones: all pieces
        cover the polyhedron. The last coordinate of a function divides the others. None where it has no interior.

        The generators at certain heights, and all above, have these functions as their lower facets (regular
        triangulations: Gelfand, Kapranov, Zelevinsky 1994).
        """
        lines = [(*(s * c for c in line), 0) for line in self.cone.lines for s in (1, -1)]
        for prime in _HEIGHTS:
            lifted = [(*v, -pow(7, k, prime)) for k, v in enumerate(self.cone.rays, start=1)]
            dual = Cone(len(self.inner) + 1)
            for normal in ((*(0 for _ in self.inner), -1), *lines, *lifted):
                dual.cut(normal)
            pieces = [(f, [v[:-1] for v in lifted if not dot(f, v)]) for f in dual.rays if f[-1]]
            if all(len(of) + len(self.cone.lines) == len(self.inner) for _, of in pieces):
                return [] if dual.lines else pieces
        return []


@dataclass(frozen=True, slots=True)
class LinearForm:
    """A condition on a polynomial that is linear in some variables: their coefficients, then what is constant in them,
    compared with 0 by >, >=, = or /=."""

    poly: Poly
    coefficients: tuple[Poly, ...]
    relation: Relation

    @staticmethod
    def of(given: Formula, names: Sequence[str]) -> LinearForm | None:
        """None where it is no such condition."""
        if not isinstance(given, Atom):
            return None
        ring, rest = given.poly.ring, given.poly
        places = [ring.index[name] for name in names if name in ring.index]
        slopes = {i: (given.poly.coefficients(i)[1:] or [ring.constant(0)]) for i in places}
        if any(len(c) > 1 or any(c[0].degree(j) for j in places) for c in slopes.values()):
            return None
        for i in places:
            rest = rest - slopes[i][0] * ring.gen(i)
        zero = [ring.constant(0)]
        form = (*((slopes.get(ring.index.get(name, -1)) or zero)[0] for name in names), rest)
        if given.relation in (Relation.LT, Relation.LE):
            return LinearForm(-given.poly, tuple(-c for c in form), given.relation.flipped)
        return LinearForm(given.poly, form, given.relation)

    def at(self, generator: Vector) -> Poly:
        """Its value at a vertex, times the last coordinate, or along a direction."""
        return sum((c * k for c, k in zip(self.coefficients, generator, strict=True)), self.coefficients[0] * 0)


def on_polyhedra(problem: Block) -> tuple[Formula, Iterator[tuple[list[str], Sequence[Formula]]]] | None:
    """The one condition of a block with parameters, and the variables that the others join, with these: free variables
    first, those of a box one after the other. None where the others are not linear with numbers as coefficients."""
    plain = [f for f in problem.conditions if {*f.free} <= {*problem.variables} and linear_atoms(f)]
    curved = [f for f in problem.conditions if f not in plain]
    if len(curved) != 1 or not plain:
        return None
    joined = [(sorted(names), parts) for names, parts in connected(plain, lambda part: frozenset(part.free))[1]]
    single = [([v], ()) for v in problem.variables if not any(v in names for names, _ in joined)]
    return curved[0], iter((*single, *joined))

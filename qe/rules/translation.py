"""Translation: a block that only looks at differences loses a variable."""

from __future__ import annotations

from qe.formula.build import atom
from qe.formula.syntax import Atom, Formula
from qe.formula.traverse import atoms, bound_variables
from qe.rules.block_context import BlockContext, Found
from qe.rules.lift import Solve
from qe.rules.nullspace import derivative_rows, kernel_vector, occurring
from qe.rules.rewrite import rewrite
from qe.rules.step import StepKind
from qe.rules.tree import Lifted, Pending

_TERMS = 600  # terms in all atoms together up to which directions are looked for


def fix_origin(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """Let w be a vector (0 for the free variables) with sum of w_i * dp/dv_i = 0 for every atom's polynomial p. Then
    p(v + t*w) = p(v) for all real t, so the truth of f is the same along w, and where w_x /= 0 some t makes x = 0:
    ex x, y f  iff  ex y f[0].

    Lift: x = 0.
    """
    found = list(atoms(body))
    inner = frozenset(bound_variables(body))
    if any(not isinstance(a, Atom) for a in found) or sum(a.poly.term_count() for a in found) > _TERMS:
        return None
    if inner & set(body.free):
        return None
    polys, columns = occurring(body, frozenset(variables) | inner)
    direction = kernel_vector(columns, (row for poly in polys for row in derivative_rows(poly, columns)))
    if direction is None:
        return None
    ring = polys[0].ring
    moving = [v for v in variables if v not in inner and direction.get(ring.index[v])]
    if not moving:
        return None
    name = max(moving, key=lambda v: (sum(p.degree(ring.index[v]) > 0 for p in polys), v))
    index = ring.index[name]

    def change(given: Atom) -> Formula:
        return atom(given.poly.at_rational(index, 0), given.relation) if given.poly.degree(index) else given

    rest = tuple(v for v in variables if v != name)
    child = Pending(rest, rewrite(body, change, ()))
    node = Lifted((Solve(name, ring.constant(0), ring.constant(1)),), child)
    proof = {"variable": name, "weights": [(ring.names[i], w) for i, w in direction.items() if w]}
    return Found(StepKind.TRANSLATION, f"{name} = 0", node, proof)

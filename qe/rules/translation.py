"""Translation: a block that only looks at differences loses a variable."""

from __future__ import annotations

from qe.formula.features import is_short
from qe.formula.syntax import Formula
from qe.formula.traverse import bound_variables
from qe.rules.block_context import BlockContext, Found
from qe.rules.change import Change
from qe.rules.nullspace import derivative_rows, kernel_vector, occurring
from qe.rules.step import StepKind

_TERMS = 600  # terms in all atoms together up to which directions are looked for


def fix_origin(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """Let w be a vector (0 for the free variables) with sum of w_i * dp/dv_i = 0 for every atom's polynomial p. Then
    p(v + t*w) = p(v) for all real t, so the truth of f is the same along w, and where w_x /= 0 some t makes x = 0:
    ex x, y f  iff  ex y f[0].

    Lift: x = 0.
    """
    inner = frozenset(bound_variables(body))
    if not is_short(body, _TERMS) or inner & set(body.free):
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
    node = Change.to_number(name, 0, ring).node(variables, body)
    proof = {"variable": name, "weights": [(ring.names[i], w) for i, w in direction.items() if w]}
    return Found(StepKind.TRANSLATION, f"{name} = 0", node, proof)

"""Translation: a block that only looks at differences loses a variable."""

from __future__ import annotations

from qe.formula.features import is_short
from qe.formula.syntax import Formula
from qe.formula.traverse import bound_variables, polynomials
from qe.rules.block_context import BlockContext, Found
from qe.rules.change import Change
from qe.rules.nullspace import constant_direction
from qe.rules.step import StepKind

_TERMS = 600  # terms in all atoms together up to which directions are looked for


def fix_origin(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """Let the polynomials be constant along a vector w (0 for the free variables). Then the truth of f is the same at v
    and at v + t*w, and where w_x /= 0 some t makes x = 0:  ex x, y f  iff  ex y f[0].

    Lift: x = 0.
    """
    inner = frozenset(bound_variables(body))
    if len(variables) == 1 and not inner:
        return None  # which occurs
    if not is_short(body, _TERMS) or inner & set(body.free):
        return None
    direction, ring, polys = constant_direction(body, frozenset(variables) | inner), body.ring, polynomials(body)
    moving = [v for v in variables if v not in inner and v in direction]
    if not moving or ring is None:
        return None
    name = max(moving, key=lambda v: (sum(p.degree(ring.index[v]) > 0 for p in polys), v))
    node = Change.to_number(name, 0, ring).node(variables, body)
    proof = {"variable": name, "weights": [*direction.items()]}
    return Found(StepKind.TRANSLATION, f"{name} = 0", node, proof)

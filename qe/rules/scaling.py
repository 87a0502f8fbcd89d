"""Scaling and translation: a block of homogeneous polynomials, or that only looks at differences, loses a variable."""

from __future__ import annotations

from qe.formula.features import is_short
from qe.formula.syntax import Formula
from qe.formula.traverse import atoms, bound_variables, conjuncts, polynomials
from qe.rules.block_context import BlockContext, Found
from qe.rules.change import Change
from qe.rules.nullspace import constant_direction, homogeneous_weights
from qe.rules.step import StepKind
from qe.rules.tree import Any

_TERMS = 600  # terms in all atoms together up to which weights and directions are looked for


def fix_scale(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """Let weights w (0 for the free variables) make every atom's polynomial homogeneous: p(t^w * v) = t^d p(v).
    Then the truth of f is the same at v and at t^w * v for all t > 0, and where w_x /= 0 a suitable t makes x one of
    -1, 0, 1:  ex x, y f  iff  ex y (f[1]) or ex y (f[0]) or ex y (f[-1]), of which those are left out that the
    conjuncts (x > 0, say) exclude.

    Lift: x is the number that was substituted for it.
    """
    inner = frozenset(bound_variables(body))
    if not is_short(body, _TERMS) or inner & set(body.free) or all(a.poly.total_degree < 2 for a in atoms(body)):
        return None
    if len(variables) == 1 and not inner:
        polys = [a.poly for a in atoms(body)]
        if any(any(p.coefficients(p.ring.index[variables[0]])[:-1]) for p in polys):
            return None  # not each is a power of the variable times what is free of it
    weights = homogeneous_weights(body, frozenset(variables) | inner)
    known = context.facts.extended(conjuncts(body))
    ring = next(atoms(body)).poly.ring
    candidates = []
    for name in variables:
        index = ring.index[name]
        if name in inner or name not in weights:
            continue
        signs = known.signs(ring.gen(index))
        degree = max(a.poly.degree(index) for a in atoms(body))
        candidates.append((len(signs), -degree, name, signs))
    if not candidates:
        return None
    count, _, name, signs = min(candidates)
    if not context.may_split(StepKind.SCALING, max(1, count)):
        return None
    values = sorted(signs, reverse=True)
    nodes = tuple(Change.to_number(name, value, ring).node(variables, body) for value in values)
    proof = {
        "variable": name,
        "weights": [*weights.items()],
        "values": values,
    }
    return Found(StepKind.SCALING, f"{name} in {sorted(signs)}", Any(nodes), proof)


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

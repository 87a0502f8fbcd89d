"""Scaling: a block whose polynomials are homogeneous for some weights loses a variable."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from qe.exact.ring import Poly
from qe.formula.features import is_short
from qe.formula.syntax import Formula
from qe.formula.traverse import atoms, bound_variables, conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.change import Change
from qe.rules.nullspace import kernel_vector, occurring
from qe.rules.step import StepKind
from qe.rules.tree import Any

_TERMS = 600  # terms in all atoms together up to which weights are looked for


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
    weights = find_weights(body, frozenset(variables) | inner)
    if weights is None:
        return None
    known = context.facts.extended(conjuncts(body))
    ring = next(atoms(body)).poly.ring
    candidates = []
    for name in variables:
        index = ring.index[name]
        if name in inner or not weights.get(index):
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
        "weights": [(ring.names[i], w) for i, w in weights.items() if w],
        "values": values,
    }
    return Found(StepKind.SCALING, f"{name} in {sorted(signs)}", Any(nodes), proof)


def find_weights(body: Formula, names: frozenset[str]) -> dict[int, Fraction] | None:
    """Weights, not all 0, on the named variables that make every polynomial homogeneous; None if there are none.

    One row per pair of terms of a polynomial: the weights annihilate the differences of exponents.
    """
    polys, columns = occurring(body, names)
    return kernel_vector(columns, (row for poly in polys for row in _differences(poly, columns)))


def _differences(poly: Poly, columns: Sequence[int]) -> Iterator[list[Fraction]]:
    exponents = [e for e, _ in poly.terms()]
    for other in exponents[1:]:
        yield [Fraction(other[i] - exponents[0][i]) for i in columns]

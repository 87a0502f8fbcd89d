"""A variable that only one atom looks at, quadratic in it, whose other coefficients are those of parameters.

THEOREM. Let x occur in one conjunct only, k*x^2 + l*x + m rel 0 with k > 0, where rel is =, <= or <. The least value of
the polynomial is (4*k*m - l^2)/(4*k), at x = -l/(2*k), and it takes all greater ones. So
    ex x, y (k*x^2 + l*x + m rel 0 and f)  iff  ex y (4*k*m - l^2 rel' 0 and f), where rel' is < for <, else <=.
For k < 0 it is said of minus the polynomial. Where k is a number and l has no variable of the block, no degree in y
grows: a cylinder about the axis x stands in place of a ball.
Lift: the place of the least value, or a root.
"""

from __future__ import annotations

from qe.exact.ring import format_poly
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import bound_variables, conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.lift import Lift, Solve
from qe.rules.step import StepKind
from qe.rules.takes_value import TakesValue
from qe.rules.tree import Lifted, Pending

_AT_LEAST_VALUE = {
    (Relation.EQ, 1): Relation.LE,
    (Relation.EQ, -1): Relation.LE,
    (Relation.LE, 1): Relation.LE,
    (Relation.LT, 1): Relation.LT,
    (Relation.GE, -1): Relation.LE,
    (Relation.GT, -1): Relation.LT,
}
"""rel' by the relation and the sign of k."""


def square_alone(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on the first variable of a block of several that it applies to."""
    if StepKind.SQUARE_ALONE not in context.enabled or len(variables) < 2 or body.ring is None:
        return None
    parts, inner = conjuncts(body), bound_variables(body)
    for name in variables:
        having = [part for part in parts if name in part.free]
        if len(having) != 1 or name in inner or not isinstance(having[0], Atom):
            continue
        poly, relation = having[0].poly, having[0].relation
        i, rest = body.ring.index[name], tuple(v for v in variables if v != name)
        if poly.degree(i) != 2:
            continue
        m, l, k = poly.coefficients(i)
        if not k.is_constant or any(l.degree(body.ring.index[v]) for v in rest):
            continue
        sign = 1 if k.constant_value() > 0 else -1
        least = _AT_LEAST_VALUE.get((relation, sign))
        if least is None or all(m.degree(body.ring.index[v]) == 0 for v in rest):
            continue
        lift: Lift = Solve(name, -l, k * 2)
        if relation is Relation.EQ:
            lift = TakesValue(name, poly, relation)
        condition = atom(k * m * 4 - l * l, least)
        node = Lifted((lift,), Pending(rest, conj(condition if part is having[0] else part for part in parts)))
        return Found(StepKind.SQUARE_ALONE, f"{name} in {format_poly(poly)}", node, {"variable": name})
    return None

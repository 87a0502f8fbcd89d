"""A variable that only one atom looks at, quadratic in it, whose other coefficients are those of parameters.

THEOREM. Let x occur in one conjunct only, k*x^2 + l*x + m rel 0 with k > 0, where rel is =, <= or <. The least value of
the polynomial is (4*k*m - l^2)/(4*k), at x = -l/(2*k), and it takes all greater ones. So
    ex x, y (k*x^2 + l*x + m rel 0 and f)  iff  ex y (4*k*m - l^2 rel' 0 and f), where rel' is < for <, else <=.
For k < 0 it is said of minus the polynomial. Where k is a number and l has no variable of the block, no degree in y
grows: a cylinder about the axis x stands in place of a ball.
Lift: the place of the least value, or a root.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.exact.ring import format_poly
from qe.formula.build import conj
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.rules.block_context import BlockContext, Found
from qe.rules.closed_forms import matches
from qe.rules.lift import Lift, Solve
from qe.rules.step import StepKind
from qe.rules.takes_value import TakesValue, looked_at_once
from qe.rules.tree import solved


def square_alone(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """The theorem on the first variable of a block of several that it applies to."""
    if len(variables) < 2 or body.ring is None:
        return None
    for name, part, before, after in looked_at_once(variables, body):
        found = _least(name, part, [body.ring.index[v] for v in variables if v != name])
        if found is not None:
            condition, lift = found
            node = solved([lift], variables, conj((*before, condition, *after)))
            return Found(StepKind.SQUARE_ALONE, f"{name} in {format_poly(part.poly)}", node, {"variable": name})
    return None


def _least(name: str, part: Atom, others: Sequence[int]) -> tuple[Formula, Lift] | None:
    """What takes the place of the condition, and the way back, where the other variables do not get higher degrees."""
    for match in matches((StepKind.SQUARE_ALONE.value,), (name,), part):
        k, l, m = (match.letters[letter] for letter in "klm")
        plain = k.is_constant and not any(l.degree(i) for i in others) and any(m.degree(i) for i in others)
        if plain and match.formula("given") == TRUE:
            root, least = TakesValue(name, part.poly, part.relation), Solve(name, -l, k * 2)
            return match.formula("answer"), root if part.relation is Relation.EQ else least
    return None

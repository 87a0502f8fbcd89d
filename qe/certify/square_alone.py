"""Rule "square of a variable alone": a variable of which only one comparison of degree 2 asks something.

THEOREM. Let x be free in one conjunct only, p rel 0 with p = k*x^2 + l*x + m and a number k /= 0. By completing the
square 4*k*p = (2*k*x + l)^2 - (l^2 - 4*k*m), so that, with d = l^2 - 4*k*m,
    ex x (p = 0) iff d >= 0;   ex x (k*p <= 0) iff d >= 0;   ex x (k*p < 0) iff d > 0,
and the other conjuncts do not know x.

Evidence: ``variable`` x.
"""

from __future__ import annotations

from qe.certify.step import Claim, Context, Limits, only
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Atom, Relation
from qe.formula.traverse import conjuncts

_DISCRIMINANT = {Relation.EQ: Relation.GE, Relation.LE: Relation.GE, Relation.LT: Relation.GT}


def check_square_alone(claim: Claim, context: Context, limits: Limits) -> None:
    """The comparison is replaced by that of the discriminant, and the variable is gone."""
    (variable,) = only(claim, "variable")
    block, name, x = claim.variable(variable)
    parts = conjuncts(block.body)
    knowing = [part for part in parts if name in part.free]
    having = knowing[0] if len(knowing) == 1 else None
    if not isinstance(having, Atom) or having.poly.degree(x) != 2:
        raise claim.fail(f"expected one comparison with {name}, of degree 2")
    slope = having.poly.derivative(x)
    second = slope.derivative(x)
    if not second.is_constant:
        raise claim.fail("a number as coefficient of the square expected")
    relation = having.relation if second.constant_value() > 0 else having.relation.flipped
    if relation not in _DISCRIMINANT:
        raise claim.fail("an equation or an upper bound of a convex polynomial expected")
    discriminant = slope * slope - second * having.poly * 2
    condition = atom(discriminant, _DISCRIMINANT[relation])
    left = [v for v in block.variables if v != name]
    if claim.after != exists(left, conj(condition if part is having else part for part in parts)):
        raise claim.fail("not the block with the discriminant in place of the comparison")

"""Rule "linear form named": a new variable for a polynomial that conditions look at.

THEOREM. Let l = 0 stand in f, and let b*p = q(L) + m*l for polynomials m and L, b a number that is not 0. Then p and
q(L) have the same sign where l = 0 if b > 0, opposite ones if b < 0, and vanish together in any case. So with a new
variable y, for conditions p on which this is known, ex x (p rel 0 and f) iff ex y (q(y) rel' 0 and ex x (y = L and f)),
where rel' is rel, turned round where b < 0. A universal block is the negation of an existential one.

Evidence: ``scales``, the numbers |b|, for the outer conditions in their order. L is read off the inner block.
"""

from __future__ import annotations

from fractions import Fraction

from qe.exact.ring import Poly
from qe.formula.syntax import Atom, Exists, Formula, Relation
from qe.formula.traverse import bound_variables, conjuncts
from qe.kernel.block import existential
from qe.kernel.step import Claim, Context, Limits, only


def check_named_form(claim: Claim, context: Context, limits: Limits) -> None:
    """Every condition is compared with what its outer counterpart says about the form."""
    (scales,) = only(claim, "scales")
    before, after = existential(claim)
    if not isinstance(before, Exists) or not isinstance(after, Exists) or len(after.variables) != 1:
        raise claim.fail("expected a block, and a block of one variable in its place")
    (name,) = after.variables
    outer = [part for part in conjuncts(after.body) if isinstance(part, Atom)]
    blocks = [part for part in conjuncts(after.body) if isinstance(part, Exists)]
    if (
        name in (*before.free, *bound_variables(before))
        or len(blocks) != 1
        or len(outer) + 1 < len(conjuncts(after.body))
    ):
        raise claim.fail("expected conditions on a new variable, and one block")
    form, linear = _inner(blocks[0], before, name, claim)
    given = [part for part in conjuncts(before.body) if part not in linear]
    numbers = [entry.rational() for entry in scales.items()]
    if not linear <= set(conjuncts(before.body)) or not len(given) == len(outer) == len(numbers):
        raise claim.fail("the conditions are not those of the block")
    lines = [part.poly for part in linear if isinstance(part, Atom) and part.relation is Relation.EQ]
    for p, q, number in zip(given, outer, numbers, strict=True):
        limits.tick()
        if (
            set(q.free) & set(before.variables)
            or not isinstance(p, Atom)
            or not _agree(p, q, number, name, form, lines)
        ):
            raise claim.fail("a condition on the form is not the one of the block")


def _inner(block: Exists, before: Exists, name: str, claim: Claim) -> tuple[Poly, set[Formula]]:
    """L, and the conditions that stand unchanged in the inner block."""
    naming = [part for part in conjuncts(block.body) if name in part.free]
    if set(block.variables) != set(before.variables) or len(naming) != 1:
        raise claim.fail("expected the same block, with one equation for the new variable")
    (part,) = naming
    y = claim.ring.index[name]
    if not isinstance(part, Atom) or part.relation is not Relation.EQ or part.poly.degree(y) != 1:
        raise claim.fail("expected an equation that is linear in the new variable")
    rest, lead = part.poly.coefficients(y)
    if not lead.is_constant or abs(lead.constant_value()) != 1:
        raise claim.fail("the coefficient of the new variable is not 1")
    return rest * -lead.constant_value(), set(conjuncts(block.body)) - {part}


def _agree(p: Atom, q: Atom, number: Fraction, name: str, form: Poly, lines: list[Poly]) -> bool:
    """Whether b*p = q(L) + m*l or -b*p = q(L) + m*l for one of the equations, and the relations go with the sign."""
    y, found = form.ring.index[name], False
    for sign, relation in ((1, p.relation), (-1, p.relation.flipped)):
        difference = p.poly * number.numerator - q.poly.compose({y: form}) * number.denominator * sign
        multiple = not difference or any(difference.gcd(line) in (line, -line) for line in lines)
        found = found or (number > 0 and q.relation is relation and multiple)
    return found

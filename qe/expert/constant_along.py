"""Rule "constant along directions": both sides look the same from many values of the parameters, so one value will do.

THEOREM. Let w be a vector, 0 outside the free variables, with sum w_i dp/dv_i = 0 for every polynomial p of A and of B.
Then A and B have the same truth at v and v + t*w for all t, so where w_x /= 0:  A <-> B iff A[x = 0] <-> B[x = 0].
PROOF. At any v take t = -v_x/w_x. For fixed values of the bound variables every p is constant along w.

Evidence: ``directions`` [[x, [[name, rational], ...]], ...], put in one after the other, and ``steps`` from what
becomes of A to what becomes of B.
"""

from __future__ import annotations

from fractions import Fraction

from qe.expert.symmetry import check_constant_on, read_vector
from qe.formula.syntax import Exists, ForAll
from qe.formula.traverse import polynomials, subformulas
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.substitution import at_number


def check_constant_along(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    directions, steps = only(claim, "directions", "steps")
    sides = [claim.before, claim.after]
    bound = {v for side in sides for f in subformulas(side) if isinstance(f, Exists | ForAll) for v in f.variables}
    for direction in directions.items():
        variable, along = direction.row("variable", "vector")
        name, vector = variable.text(), read_vector(along, set(claim.ring.names) - bound, claim)
        if name not in claim.ring.index or not vector.get(claim.ring.index[name]):
            raise direction.fail(f"{name} is no variable that moves")
        for side in sides:
            check_constant_on(polynomials(side), vector, along, limits)
        sides = [at_number(side, claim.ring.index[name], Fraction(0), claim) for side in sides]
    if limits.replay(steps, sides[0], (), claim.ring) != sides[1]:
        raise steps.fail("the steps do not lead there")

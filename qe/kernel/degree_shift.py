"""Rule "degree shift": all exponents of a variable share a divisor.

THEOREM. Let every exponent of x in f be a multiple of k > 1, f(x) = g(x^k). Then ex x f iff ex x (x >= 0 and g) for
even k, and iff ex x g for odd k, since x^k takes all non-negative (all) real values. Comparisons of x itself with 0 may
stay for odd k, and for even k where f implies x >= 0; x = 0 and x /= 0 may stay in any case. See ``lowered_degree``.

Evidence: ``variable``, ``exponent``, ``theory`` (for x >= 0).
"""

from __future__ import annotations

from qe.formula.build import atom, conj, exists
from qe.formula.syntax import TRUE, Atom, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.boolean import ByLemmas, Goal
from qe.kernel.lowered_degree import asks_sign, divided
from qe.kernel.step import Claim, Context, only, outside
from qe.kernel.substitution import mapped


def shift_goals(claim: Claim, context: Context) -> list[Goal]:
    """The exponents are divided and the result compared with what stands after; x >= 0 is to be shown where needed."""
    variable, exponent, _ = only(claim, "variable", "exponent", "theory")
    k, ring, asked = exponent.integer(2), claim.ring, []
    before, _, x = claim.variable(variable)

    def change(given: Atom) -> Formula:
        asked.append(asks_sign(given, x))
        return divided(given, x, k, exponent) if given.poly.degree(x) else given

    lowered = mapped(before.body, change, (ring.gen(x),), claim)
    positive = TRUE if k % 2 else atom(ring.gen(x), Relation.GE)
    if claim.after != exists(before.variables, conj((positive, lowered))):
        raise claim.fail("not what the shift of degrees gives")
    if k % 2 or not any(asked):
        return []
    return [(*outside(context, before.variables), *conjuncts(before.body), atom(ring.gen(x), Relation.LT))]


check_degree_shift = ByLemmas(shift_goals)

"""Rule "degree shift": all exponents of a variable share a divisor.

THEOREM. Let every exponent of x in f be a multiple of k > 1, f(x) = g(x^k). Then ex x f iff ex x (x >= 0 and g) for
even k, and iff ex x g for odd k, since x^k takes all non-negative (all) real values. Comparisons of x itself with 0 may
stay for odd k, and for even k where f implies x >= 0; x = 0 and x /= 0 may stay in any case.

Evidence: ``variable``, ``exponent``, ``theory`` (for x >= 0).
"""

from __future__ import annotations

from qe.certify.boolean import ByLemmas, Goal
from qe.certify.step import Claim, Context, only
from qe.certify.substitution import mapped
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts


def shift_goals(claim: Claim, context: Context) -> list[Goal]:
    """The exponents are divided and the result compared with what stands after; x >= 0 is to be shown where needed."""
    variable, exponent, _ = only(claim, "variable", "exponent", "theory")
    name, k, before = variable.text(), exponent.integer(2), claim.before
    if not isinstance(before, Exists) or name not in before.variables:
        raise variable.fail("expected a variable of the existential block")
    ring = claim.ring
    x, bare = ring.index[name], False

    def change(given: Atom) -> Formula:
        nonlocal bare
        parts = given.poly.coefficients(x)
        if len(parts) == 1:
            return given
        if given.poly == ring.gen(x):
            bare = bare or given.relation not in (Relation.EQ, Relation.NE)
            return given
        if any(part for power, part in enumerate(parts) if power % k):
            raise exponent.fail("not all exponents are multiples of it")
        image = ring.constant(0)
        for part in reversed(parts[::k]):
            image = image * ring.gen(x) + part
        return atom(image, given.relation)

    lowered = mapped(before.body, change, frozenset((name,)), claim)
    positive = TRUE if k % 2 else atom(ring.gen(x), Relation.GE)
    if claim.after != exists(before.variables, conj((positive, lowered))):
        raise claim.fail("not what the shift of degrees gives")
    if not bare or k % 2:
        return []
    known = [f for f in context if not set(before.variables) & set(f.free)]
    return [(*known, *conjuncts(before.body), atom(ring.gen(x), Relation.LT))]


check_degree_shift = ByLemmas(shift_goals)

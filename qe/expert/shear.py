"""Rule "linear form as a variable": x stands for m*x + n.

THEOREM. Let m and n be polynomials without x and without variables bound inside f. Where m /= 0, w = m*x + n takes
every real value as x does, and x = (w - n)/m. Let d be the degree of p in x, and q(w) * m^e = m^d * p((w - n)/m): then
p(x) = q(w) / m^(d - e), which has the sign of q(w) where d - e is even or m > 0, and is zero exactly where q(w) is in
any case. So with f' for f with every p replaced by such a q, ex v f iff ex v (m /= 0 and f') or ex v (m = 0 and f).

Evidence: ``variable``, ``form`` m*x + n (or its negative, where m is a number: m > 0 is taken). The quotients q are
worked out here, with the greatest e.
"""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import Atom, Formula, Relation
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.substitution import mapped, quotient


def check_shear(claim: Claim, context: Context, limits: Limits) -> None:
    """The form is put in, and the result is compared with what stands after."""
    variable, form = only(claim, "variable", "form")
    (block, _, x), ring = claim.variable(variable), claim.ring
    given_form = form.polynomial(ring)
    if given_form.degree(x) != 1:
        raise form.fail("expected a polynomial of degree 1 in the variable")
    n, m = given_form.coefficients(x)
    if m.is_constant and m.constant_value() < 0:
        m, n = -m, -n

    def change(given: Atom) -> Formula:
        limits.tick()
        keeps_sign = given.relation in (Relation.EQ, Relation.NE) or m.is_constant
        return atom(_in_form(given.poly, x, m, n, parity=not keeps_sign), given.relation)

    image = mapped(block.body, change, (given_form,), claim)
    if m.is_constant:
        expected = exists(block.variables, image)
    else:
        regular, singular = conj((atom(m, Relation.NE), image)), conj((atom(m, Relation.EQ), block.body))
        expected = disj((exists(block.variables, regular), exists(block.variables, singular)))
    if claim.after != expected:
        raise claim.fail("not what the form in place of the variable gives")


def _in_form(p: Poly, x: int, m: Poly, n: Poly, *, parity: bool) -> Poly:
    """The q of the theorem; ``parity``: d - e is even."""
    left = p.degree(x)
    q = quotient(p, x, p.ring.gen(x) - n, m)
    while left and not m.is_constant and q and q.gcd(m) in (m, -m):
        q, left = q.exact_divide(m), left - 1
    return q * m if parity and left % 2 else q

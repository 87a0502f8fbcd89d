"""Rule "value that is taken": a variable of which only one comparison asks something that some value meets.

THEOREM. Let x be free in one conjunct only, p rel 0 with p of degree d >= 1 in x, and let its leading coefficient c not
vanish where the others hold. Far out p has the sign of c on the right, and that of (-1)^d * c on the left; so for odd d
it takes every value, and for even d values of the sign of c. Hence ex x, y (p rel 0 and f) iff ex y f, where d is odd,
where rel is /=, or where rel is one of > and >= and c > 0, or of < and <= and c < 0.

Evidence: ``variable`` x, ``theory`` for what is said of c.
"""

from __future__ import annotations

from qe.certify.boolean import ByLemmas, Goal
from qe.certify.negation import negation
from qe.certify.step import Claim, Context, only, outside
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Atom, Relation
from qe.formula.traverse import conjuncts

_FAR = {Relation.GT: Relation.GT, Relation.GE: Relation.GT, Relation.LT: Relation.LT, Relation.LE: Relation.LT}


def value_goals(claim: Claim, context: Context) -> list[Goal]:
    """The conjunct is left out; where the others hold, its leading coefficient is as the theorem wants it."""
    variable, _ = only(claim, "variable", "theory")
    block, name, x = claim.variable(variable)
    parts = conjuncts(block.body)
    having = [part for part in parts if name in part.free]
    others = [part for part in parts if name not in part.free]
    met = having[0] if len(having) == 1 else None
    if not isinstance(met, Atom):
        raise claim.fail(f"expected one comparison with {name}")
    if claim.after != exists([v for v in block.variables if v != name], conj(others)):
        raise claim.fail("not the block without this comparison")
    if met.poly.degree(x) % 2 or met.relation is Relation.NE:
        wanted = Relation.NE
    elif met.relation is Relation.EQ:
        raise claim.fail("a polynomial of even degree need not vanish")
    else:
        wanted = _FAR[met.relation]
    return [(*outside(context, block.variables), *others, negation(atom(met.poly.leading(x), wanted)))]


check_value_taken = ByLemmas(value_goals)

"""Linear equations: certificates for answers that they alone give, such as those of control point problems, and the
cases of a coefficient that may vanish, in steps of the kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import Formula, Relation
from qe.kernel.linear_equation import Pivot, pivot_of, substituted
from qe.kernel.step import Claim, only
from qe.proof.entry import Entry, Json, poly_to_text, polynomial_from_json
from qe.proving.lemma_list import EMPTY, Term, identities
from qe.proving.made import Made


def guarded(made: Made, after: Formula) -> None:
    """The coefficient of an equation is not 0, or it vanishes with the rest of it; where it is not, x is put in."""
    claim = made.claim
    (entry,) = only(claim, "solved")[0].row("equation")
    block, body = claim.block().variables, claim.block().body
    pivot = pivot_of(entry, block, body, claim)
    lead, rest = pivot.lead, pivot.rest
    regular = exists(block, conj((atom(lead, Relation.NE), body)))
    vanishing = exists(block, conj((atom(lead, Relation.EQ), atom(rest, Relation.EQ), pivot.others)))
    image = conj((atom(lead, Relation.NE), substituted(replace(pivot, sign=0), claim)))
    solved = exists([v for v in block if v != pivot.name], image)
    x = claim.ring.gen(pivot.x)
    sum_of: list[Term] = [(1, ((pivot.equation, 1),)), (-1, ((lead, 1), (x, 1))), (-1, ((rest, 1),))]
    lemmas = identities([sum_of], claim.ring)
    made.signs(claim.before, disj((regular, vanishing)), lemmas)
    evidence: Json = {"solved": [[pivot.name, poly_to_text(pivot.equation), 0]], "theory": EMPTY}
    made.step("linear equation solved", regular, solved, evidence)


def term(entry: Entry, names: Sequence[str], others: Formula, claim: Claim) -> Pivot:
    """The substitution that an equation [variable, polynomial] gives whose coefficient is a number."""
    variable, solved = entry.row("variable", "equation")
    name, equation = variable.text(), polynomial_from_json(solved, claim.ring)
    if name not in names:
        raise variable.fail("expected a variable of the block")
    x = claim.ring.index[name]
    if equation.degree(x) != 1 or not equation.leading(x).is_constant:
        raise solved.fail("expected an equation that is linear in the variable, with a number as its coefficient")
    rest, lead = equation.coefficients(x)
    return Pivot(x, name, lead, rest, 1 if lead.constant_value() > 0 else -1, others)

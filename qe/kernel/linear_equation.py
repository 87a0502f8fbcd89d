"""Rule "linear equation solved" (Gauss).

THEOREM (Loos, Weispfenning 1993). Let a, b be polynomials without x, and f[-b/a] be f with a^d g(-b/a) in place of each
g of degree d in x, times a once more where d is odd and the sign of a is not known (with the sign changed where it is
negative). Then ex x (a*x + b = 0 and f) iff f[-b/a], if a /= 0 follows from what is known and from conjuncts of f
without x, which f[-b/a] keeps; and (a /= 0 or b = 0) and f, if x does not occur in f.
That conjuncts with x do not count is a side condition: 1 + a*x <= 0 implies a /= 0, but becomes a^2*(1 - b) <= 0.

Evidence: ``solved``: [variable, equation, sign of a] in their order, the sign 1, -1, 0 (only known not to be zero) or
null (not known); ``theory``: lemmas for the signs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.boolean import ByLemmas, Goal
from qe.kernel.negation import negation
from qe.kernel.step import Claim, Context, only, outside
from qe.kernel.substitution import mapped, quotient
from qe.proof.entry import Entry, polynomial_from_json

_KNOWN = {1: Relation.GT, -1: Relation.LT, 0: Relation.NE}


def linear_goals(claim: Claim, context: Context) -> list[Goal]:
    """The substitutions are carried out and compared with what stands after; signs are to be shown."""
    solved = only(claim, "solved", "theory")[0]
    goals: list[Goal] = []
    block, body = claim.block().variables, claim.block().body
    known = outside(context, block)
    for entry in solved.items():
        pivot = pivot_of(entry, block, body, claim)
        if pivot.sign is not None:
            beside = [p for p in conjuncts(pivot.others) if pivot.name not in p.free]
            goals.append((*known, *beside, negation(atom(pivot.lead, _KNOWN[pivot.sign]))))
        body = _solved(pivot, claim)
        block = tuple(v for v in block if v != pivot.name)
    if _parts(exists(block, body)) != _parts(claim.after):
        raise claim.fail("not what the substitutions give")
    return goals


check_linear = ByLemmas(linear_goals)


@dataclass(frozen=True, slots=True)
class Pivot:
    """lead*x + rest = 0 beside ``others``; ``sign``: what is claimed of lead."""

    x: int
    name: str
    lead: Poly
    rest: Poly
    sign: int | None
    others: Formula

    @property
    def equation(self) -> Poly:
        """The polynomial that is 0."""
        return self.lead * self.lead.ring.gen(self.x) + self.rest


def pivot_of(entry: Entry, block: Sequence[str], body: Formula, claim: Claim) -> Pivot:
    """The equation [variable of the block, polynomial, sign of its coefficient], a conjunct of the body."""
    variable, solved, of_lead = entry.row("variable of the block", "equation", "sign")
    name, equation, sign = variable.text(), polynomial_from_json(solved, claim.ring), of_lead.value
    if name not in block:
        raise variable.fail("expected a variable of the block")
    x = claim.ring.index[name]
    if isinstance(sign, bool) or sign not in (1, -1, 0, None):
        raise of_lead.fail("expected 1, -1, 0 or null")
    if equation.degree(x) != 1 or Atom(equation, Relation.EQ) not in conjuncts(body):
        raise solved.fail("no conjunct here that is linear in the variable")
    rest, lead = equation.coefficients(x)
    if lead.is_constant and sign != (1 if lead.constant_value() > 0 else -1):
        raise of_lead.fail("not the sign of this number")
    others = conj(p for p in conjuncts(body) if p != Atom(equation, Relation.EQ))
    return Pivot(x, name, lead, rest, sign if isinstance(sign, int) else None, others)


def _solved(pivot: Pivot, claim: Claim) -> Formula:
    """What the equation leaves of the conjunction."""
    if pivot.sign is None:
        if pivot.name in pivot.others.free:
            raise claim.fail(f"the coefficient of {pivot.name} may vanish")
        return conj((disj((atom(pivot.lead, Relation.NE), atom(pivot.rest, Relation.EQ))), pivot.others))
    return substituted(pivot, claim)


def substituted(pivot: Pivot, claim: Claim) -> Formula:
    """The other conjuncts with -rest/lead for the variable."""
    x, lead = pivot.x, pivot.lead

    def change(given: Atom) -> Formula:
        degree, relation = given.poly.degree(x), given.relation
        if not degree:
            return given
        image = quotient(given.poly, x, -pivot.rest, lead)
        if degree % 2 and relation not in (Relation.EQ, Relation.NE):
            image = image * (pivot.sign or lead)
        return atom(image, relation)

    return conj(
        mapped(part, change, (pivot.equation,), claim) if pivot.name in part.free else part
        for part in conjuncts(pivot.others)
    )


def _parts(formula: Formula) -> tuple[object, ...]:
    """The formula, whatever the order of the conjuncts of its block."""
    if isinstance(formula, Exists):
        return frozenset(formula.variables), frozenset(conjuncts(formula.body))
    return (frozenset(conjuncts(formula)),)

"""Linear equations: certificates for answers that they alone give, such as those of control point problems, and the
cases of a coefficient that may vanish, in steps of the kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists
from qe.formula.syntax import And, Atom, Atomic, Exists, Formula, Relation
from qe.formula.traverse import conjuncts, map_atoms
from qe.kernel.linear_equation import Pivot, pivot_of, substituted
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry, Json, poly_to_text, polynomial_from_json
from qe.proving.lemma_list import EMPTY, Term, identities
from qe.proving.made import Made


def substitution_certificate(block: Formula, answer: Formula) -> Certificate | None:
    """A certificate for ``block`` <-> ``answer``, or None where linear equations with constant pivots do not give it.

    ``block`` must be ``ex variables. conjunction``. Source: the Gauss case of Loos & Weispfenning 1993, section 3.
    """
    if not isinstance(block, Exists) or not block.body.is_quantifier_free or not isinstance(block.body, And):
        return None
    ring = Ring.of(dict.fromkeys((*block.body.free, *block.variables)))
    body = matrix = convert(block.body, ring)
    solved: list[tuple[str, Poly]] = []
    left = list(block.variables)
    while left:
        found = _solvable(body, ring, left)
        if found is None:
            return None
        name, equation = found
        body = _replaced(body, ring.index[name], equation)
        solved.append(found)
        left.remove(name)
    if _set(body) != _set(convert(answer, ring)):
        return None
    return Certificate.substitution(matrix, ring.names, solved, body)


def _solvable(body: Formula, ring: Ring, names: list[str]) -> tuple[str, Poly] | None:
    """A variable and an equation among the conjuncts that is linear in it with a constant coefficient."""
    for conjunct in conjuncts(body):
        if isinstance(conjunct, Atom) and conjunct.relation is Relation.EQ:
            for name in names:
                i = ring.index[name]
                if conjunct.poly.degree(i) == 1 and conjunct.poly.leading(i).is_constant:
                    return name, conjunct.poly
    return None


def _replaced(body: Formula, i: int, equation: Poly) -> Formula:
    rest, lead = equation.coefficients(i)
    top, bottom = (-rest, lead) if lead.constant_value() > 0 else (rest, -lead)

    def change(given: Atomic) -> Formula:
        if not isinstance(given, Atom) or not given.poly.degree(i):
            return given
        return atom(given.poly.at_quotient(i, top, bottom), given.relation)

    used = Atom(equation, Relation.EQ)
    return conj(map_atoms(c, change) for c in conjuncts(body) if c != used)


def _set(formula: Formula) -> frozenset[Formula]:
    return frozenset(conjuncts(formula))


def guarded(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """The coefficient of an equation is not 0, or it vanishes with the rest of it; where it is not, x is put in."""
    (entry,) = only(claim, "solved")[0].row("equation")
    block, body, made = claim.block().variables, claim.block().body, Made(claim, limits, claim.before, context)
    pivot = pivot_of(entry, block, body, claim)
    lead, rest = pivot.lead, pivot.rest
    regular = exists(block, conj((atom(lead, Relation.NE), body)))
    vanishing = exists(block, conj((atom(lead, Relation.EQ), atom(rest, Relation.EQ), pivot.others)))
    image = conj((atom(lead, Relation.NE), substituted(replace(pivot, sign=0), claim)))
    after = exists([v for v in block if v != pivot.name], image)
    x = claim.ring.gen(pivot.x)
    sum_of: list[Term] = [(1, ((pivot.equation, 1),)), (-1, ((lead, 1), (x, 1)))]
    lemmas = identities([[*sum_of, (-1, ((rest, 1),))] if rest else sum_of], claim.ring)
    made.signs(claim.before, disj((regular, vanishing)), lemmas)
    solved: Json = {"solved": [[pivot.name, poly_to_text(pivot.equation), 0]], "theory": EMPTY}
    made.step("linear equation solved", regular, after, solved)
    return made.finished(claim.after)


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

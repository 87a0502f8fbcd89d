"""Primitive "theorem": an instance of a theorem of ``qe.theorems``.

THEOREM. Let G -> (B <-> A) hold for all real values of its letters, and let polynomials stand for the letters that
have none of the variables that B or A bind. Then B' <-> A' holds where G' does, with these polynomials in place of
the letters, whatever the bound variables are called: no polynomial is taken below a quantifier that binds a name of
it. A universal block and what stands after it are the negations of B' and A'.

Evidence: ``theorem``, its name, and ``words`` for its marks; ``letters``, a polynomial for each; ``variables``, a
name for each variable that is bound; ``theory``, by which what is given holds.
"""

from __future__ import annotations

from collections.abc import Mapping

from qe.certify.block import existential
from qe.certify.boolean import ByLemmas, Goal
from qe.certify.limits import check_power
from qe.certify.negation import negation, normal
from qe.certify.renaming import arranged
from qe.certify.step import Claim, Context, only
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Not, Or
from qe.formula.traverse import conjuncts
from qe.kernel.statements import Theorem, theorem
from qe.proof.entry import Entry


def theorem_goals(claim: Claim, context: Context) -> list[Goal]:
    """Both sides are those of the instance; what is given holds at the place."""
    name, words, letters, variables, _ = only(claim, "theorem", "words", "letters", "variables", "theory")
    used = theorem(name.text(), tuple(word.text() for word in words.items()))
    if used is None:
        raise name.fail("no theorem of this name with these words")
    images = _letters(letters, used, claim)
    names = _variables(variables, used, images, claim)
    block, given, answer = (instance(f, images, names, claim.ring) for f in (used.block, used.given, used.answer))
    before, after = existential(claim)
    if arranged(normal(block)) != arranged(before) or arranged(normal(answer)) != arranged(after):
        raise claim.fail(f'not an instance of "{used.name}"')
    return [(*context, negation(part)) for part in conjuncts(given)]


check_theorem = ByLemmas(theorem_goals)


def _letters(entry: Entry, used: Theorem, claim: Claim) -> dict[str, Poly]:
    return {
        letter: member.polynomial(claim.ring)
        for letter, member in zip(used.letters, entry.fields(*used.letters), strict=True)
    }


def _variables(entry: Entry, used: Theorem, images: Mapping[str, Poly], claim: Claim) -> dict[str, str]:
    """A name for each bound variable, none of which is a name in what stands for the letters."""
    names = [member.text() for member in entry.fields(*used.variables)]
    taken = {claim.ring.names[i] for poly in images.values() for i in poly.variables}
    if len(set(names)) < len(names) or not set(names) <= claim.ring.index.keys() or taken & set(names):
        raise entry.fail("expected different variables that what stands for the letters does not have")
    return dict(zip(used.variables, names, strict=True))


def instance(formula: Formula, images: Mapping[str, Poly], names: Mapping[str, str], ring: Ring) -> Formula:
    """A formula of a theorem about the polynomials that stand for its letters, over their ring."""
    known = {**images, **{name: ring.var(other) for name, other in names.items()}}

    def changed(f: Formula) -> Formula:
        match f:
            case Atom(poly, relation):
                return atom(_composed(poly, known, ring), relation)
            case And(args):
                return conj(map(changed, args))
            case Or(args):
                return disj(map(changed, args))
            case Not(arg):
                return neg(changed(arg))
            case Exists(variables, body):
                return exists([names[v] for v in variables], changed(body))
            case ForAll(variables, body):
                return forall([names[v] for v in variables], changed(body))
        return f

    return changed(formula)


def _composed(poly: Poly, known: Mapping[str, Poly], ring: Ring) -> Poly:
    """The polynomial with others in place of its variables."""
    total, powers = ring.constant(0), dict[tuple[str, int], Poly]()
    for exponents, coefficient in poly.terms():
        product = ring.constant(coefficient)
        for name, exponent in zip(poly.ring.names, exponents, strict=True):
            if exponent and (name, exponent) not in powers:
                check_power(known[name], exponent)
                powers[name, exponent] = known[name] ** exponent
            if exponent:
                product = product * powers[name, exponent]
        total = total + product
    return total

"""Primitive "theorem": an instance of a theorem of ``qe.theorems``.

THEOREM. Let G -> (B <-> A) hold for all real values of its letters, and let polynomials stand for the letters that
have none of the variables that B or A bind. Then B' <-> A' holds where G' does, with these polynomials in place of
the letters, whatever the bound variables are called, different ones in each of the two: no polynomial is taken below a
quantifier that binds a name of it. A universal block and what stands after it are the negations of B' and A'.

Evidence: ``theorem``, its name, and ``words`` for its marks; ``letters``, a polynomial for each; ``variables``, a
name for each variable that is bound; ``theory``, by which what is given holds.
"""

from __future__ import annotations

from collections.abc import Mapping

from qe.exact.ring import Poly
from qe.formula.traverse import conjuncts
from qe.kernel.block import existential
from qe.kernel.boolean import ByLemmas, Goal
from qe.kernel.negation import negation, normal
from qe.kernel.quantifiers import unordered
from qe.kernel.statements import Theorem, theorem
from qe.kernel.step import Claim, Context, only
from qe.proof.entry import Entry


def theorem_goals(claim: Claim, context: Context) -> list[Goal]:
    """Both sides are those of the instance; what is given holds at the place."""
    name, words, letters, variables, _ = only(claim, "theorem", "words", "letters", "variables", "theory")
    used = theorem(name.text(), tuple(word.text() for word in words.items()))
    if used is None:
        raise name.fail("no theorem of this name with these words")
    images = {n: member.polynomial(claim.ring) for n, member in zip(used.letters, letters.fields(*used.letters))}
    names = _variables(variables, used, images, claim)
    block, given, answer = (used.formula(part, images, names, claim.ring) for part in ("block", "given", "answer"))
    before, after = existential(claim)
    if any(unordered(normal(f)) != unordered(g) for f, g in ((block, before), (answer, after))):
        raise claim.fail(f'not an instance of "{used.name}"')
    return [(*context, negation(part)) for part in conjuncts(given)]


check_theorem = ByLemmas(theorem_goals)


def _variables(entry: Entry, used: Theorem, images: Mapping[str, Poly], claim: Claim) -> dict[str, str]:
    """A name for each bound variable, none of which is a name in what stands for the letters.

    The block and the answer each bind different names.
    """
    names = dict(zip(used.variables, (member.text() for member in entry.fields(*used.variables)), strict=True))
    taken = {claim.ring.names[i] for poly in images.values() for i in poly.variables}
    distinct = all(len({names[v] for v in bound}) == len(bound) for bound in used.bound.values())
    if not distinct or not set(names.values()) <= claim.ring.index.keys() or taken & set(names.values()):
        raise entry.fail("expected different variables that what stands for the letters does not have")
    return names

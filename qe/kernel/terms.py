"""Primitive "terms": a block whose variables are values of terms in those of another, and the other way round.

THEOREM. Let s be terms in the variables w, and t in v, one for each variable of the other block, all of them
quotients of polynomials. If for all w for which B holds no denominator of s is 0 and A holds at v = s, and for all v
for which A holds no denominator of t is 0 and B holds at w = t, then ex v A <-> ex w B. Either list of variables may
be empty; a variable without a term stands for itself. A universal block and what stands after it are the negations of
these.

A polynomial of degree d in a variable whose term is p/q is multiplied by q^d, and once more by q where d is odd, so
that its sign stays; by q^d where q is a positive number.

Evidence: ``there``, the terms s: [variable, numerator, denominator, ...]; ``back``, the terms t; ``theory``, by which
the conditions follow.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from qe.exact.ring import Poly
from qe.formula.build import atom
from qe.formula.syntax import TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.block import existential
from qe.kernel.boolean import ByLemmas, Goal
from qe.kernel.limits import check_power
from qe.kernel.negation import negation, normal
from qe.kernel.step import Claim, Context, only, outside
from qe.kernel.substitution import mapped
from qe.proof.entry import Entry

Quotient = tuple[Poly, Poly]
Terms = Mapping[int, Quotient]


def terms_goals(claim: Claim, context: Context) -> list[Goal]:
    """Each body follows from the other at the terms."""
    there, back, _ = only(claim, "there", "back", "theory")
    before, after = (block_opened(side) for side in existential(claim))
    names = {*before[0], *after[0]}
    if names & ({*claim.before.free, *claim.after.free}):
        raise claim.fail("a variable of one block is free in the other formula")
    known = outside(context, names)
    return [
        *_following(known, after[1], before[1], terms_of(there, before[0], after[0], claim), claim),
        *_following(known, before[1], after[1], terms_of(back, after[0], before[0], claim), claim),
    ]


check_terms = ByLemmas(terms_goals)


def block_opened(formula: Formula) -> tuple[tuple[str, ...], Formula]:
    """The variables and the body of a block; a formula that is none has no variables."""
    return (formula.variables, formula.body) if isinstance(formula, Exists) else ((), formula)


def terms_of(entry: Entry, variables: tuple[str, ...], others: tuple[str, ...], claim: Claim) -> Terms:
    """The quotients for variables of one block, in those of the other and in what is free outside."""
    found: dict[int, Quotient] = {}
    for row in entry.items():
        variable, top, bottom = row.row("variable", "numerator", "denominator")
        name = variable.text()
        if name not in variables or claim.ring.index[name] in found:
            raise variable.fail("expected variables of the block, each once")
        quotient = top.polynomial(claim.ring), bottom.polynomial(claim.ring)
        used = {claim.ring.names[i] for part in quotient for i in part.variables}
        if used & (set(variables) - set(others)) or not quotient[1]:
            raise row.fail("expected a quotient of polynomials in the variables of the other block")
        found[claim.ring.index[name]] = quotient
    if not set(variables) <= {*others, *(claim.ring.names[i] for i in found)}:
        raise entry.fail("a variable has no term")
    return found


def _following(known: Context, given: Formula, wanted: Formula, terms: Terms, claim: Claim) -> list[Goal]:
    """What has to be refuted so that ``wanted`` holds at the terms where ``given`` does."""
    about = [poly for i, quotient in terms.items() for poly in (claim.ring.gen(i), *quotient)]
    nonzero = [f.poly for f in known if isinstance(f, Atom) and 0 not in f.relation.signs]
    image = normal(mapped(wanted, lambda a: atom(at_terms(a.poly, terms, nonzero), a.relation), about, claim))
    parts = set(conjuncts(given))
    goals = [(*known, given, negation(part)) for part in conjuncts(image) if part not in parts and part != TRUE]
    bottoms = [atom(bottom, Relation.EQ) for _, bottom in terms.values()]
    return [*goals, *((*known, given, bottom) for bottom in bottoms if isinstance(bottom, Atom))]


def at_terms(poly: Poly, terms: Terms, nonzero: Sequence[Poly] = ()) -> Poly:
    """A positive multiple of the polynomial's value at the terms, where no denominator is 0 and none of ``nonzero``."""
    total, moved = multiplied_out(poly, terms), [i for i in terms if poly.degree(i)]
    for square in {p**2 for p in (*nonzero, *(terms[i][1] for i in moved)) if moved and not p.is_constant}:
        while total and total.gcd(square) in (square, -square):
            total = total.exact_divide(square)
    return total


def multiplied_out(poly: Poly, terms: Terms) -> Poly:
    """The polynomial's value at the terms times powers of the denominators, none of which is left out."""
    ring, powers = poly.ring, {i: _exponent(poly.degree(i), bottom) for i, (_, bottom) in terms.items()}
    moved = {i: k for i, k in powers.items() if poly.degree(i)}
    total = ring.constant(0)
    for exponents, part in poly.collected(tuple(moved)).items():
        for (i, power), e in zip(moved.items(), exponents, strict=True):
            top, bottom = terms[i]
            part = part * _power(top, e) * _power(bottom, power - e)
        total = total + part
    return total


def _exponent(degree: int, bottom: Poly) -> int:
    if bottom.is_constant and bottom.constant_value() > 0:
        return degree
    return degree + degree % 2


def _power(poly: Poly, exponent: int) -> Poly:
    check_power(poly, exponent)
    return poly**exponent

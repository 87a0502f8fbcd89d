"""A polynomial that gets a name, in steps of the kernel: linear forms, values of a form on a sphere or ball."""

from __future__ import annotations

from collections.abc import Sequence

from qe.errors import CertificateRejected
from qe.exact.ring import Poly
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts, map_atoms
from qe.kernel.block import existential
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import Json, formula_from_json, poly_to_text
from qe.proving.lemma_list import EMPTY, Term, identities
from qe.proving.made import Made, equal

EQ, GE = Relation.EQ, Relation.GE


def named(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """Conditions on a form become conditions on its name, by the equations beside them."""
    numbers = [entry.rational() for entry in only(claim, "scales")[0].items()]
    (before, after), ring = existential(claim), claim.ring
    if not isinstance(before, Exists) or not isinstance(after, Exists):
        raise claim.fail("two blocks expected")
    name = after.variables[0]
    outer = [part for part in conjuncts(after.body) if isinstance(part, Atom)]
    inner = next(part for part in conjuncts(after.body) if isinstance(part, Exists))
    naming = next(part for part in conjuncts(inner.body) if isinstance(part, Atom) and name in part.free)
    beside = [part for part in conjuncts(inner.body) if part != naming]
    given = [part for part in conjuncts(before.body) if part not in beside]
    y = ring.index[name]
    rest, lead = naming.poly.coefficients(y)
    form, lines = rest * -lead.constant_value(), [f.poly for f in beside if isinstance(f, Atom) and f.relation is EQ]
    listed: list[list[Term]] = []
    for p, q, number in zip(given, outer, numbers, strict=True):
        assert isinstance(p, Atom)
        terms: list[Term] = [(number.numerator, ((p.poly, 1),))]
        for sign in (1, -1):
            difference = p.poly * number.numerator - q.poly.compose({y: form}) * (number.denominator * sign)
            line = next((f for f in lines if difference and difference.gcd(f) in (f, -f)), None)
            if line is not None or not difference:
                change = (q.poly - q.poly.compose({y: form})).exact_divide(ring.gen(y) - form)
                times = -number.denominator * sign
                lead_sign = lead.constant_value()
                terms += [(times, ((q.poly, 1),)), (-times * lead_sign, ((change, 1), (naming.poly, 1)))]
                terms += [(-1, ((difference.exact_divide(line), 1), (line, 1)))] if line is not None else []
                break
        listed.append(terms)
    made = Made(claim, limits, before, context)
    names = (name, *before.variables)
    whole = exists(names, conj((naming, before.body)))
    moved = exists(names, conj((naming, *beside, *outer)))
    made.named(before, whole, name, naming)
    made.step("simplification", whole, moved, {"theory": identities(listed, ring)})
    return made.finished(after)


def seen_along(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """The form gets a name, and the theorem says which values it has on the sphere."""
    given, listed, entry = only(claim, "sphere", "variables", "form")
    before, names, ring, after = claim.block(), listed.names(), claim.ring, claim.after
    part, form = formula_from_json(given, ring), entry.polynomial(ring)
    if not isinstance(part, Atom) or not isinstance(after, Exists) or not set(names) <= set(before.variables):
        raise given.fail("a comparison expected, and variables of the block")
    made = Made(claim, limits, before, context)
    t, first = made.fresh(), ring.index[names[0]]
    naming = equal(ring.var(t), form)
    values = [f for f in conjuncts(after.body) if not _kept(f, before, part, made)]
    renamed = map_atoms(after, lambda a: atom(a.poly.compose({first: ring.var(t)}), a.relation))
    raise CertificateRejected("", "")


def _kept(part: Formula, before: Exists, sphere: Atom, made: Made) -> bool:
    return part in conjuncts(before.body)

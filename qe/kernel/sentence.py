"""Rules "convex", "point or multipliers" and "instance": a sentence decided by a point, or by multipliers.

THEOREM. ex v. f is true if f holds at one point, and false if conjuncts of f have no common solution. all v. f is the
negation of ex v. not f.

Evidence: ``certificate``, of kind "witness" (that f holds at numbers) or "optimum" (that conjuncts of f, each up to a
positive factor, cannot hold together).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, convert
from qe.formula.syntax import FALSE, TRUE, Exists, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.block import existential
from qe.kernel.negation import normal
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.certificate import Kind
from qe.proof.entry import Entry, formula_from_json

RELATIONS = {"<=": Relation.LE, "<": Relation.LT, "=": Relation.EQ}
"""The relations of optima."""


def check_sentence(claim: Claim, context: Context, limits: Limits) -> None:
    """The certificate is checked, and is about the sentence of the step."""
    entry = only(claim, "certificate")[0]
    certificate = limits.leaf(entry)
    payload = Entry(certificate.payload, f"{entry.path}.payload") if isinstance(certificate.payload, dict) else None
    before, after = existential(claim)
    if not isinstance(before, Exists) or before.free:
        raise claim.fail("expected a sentence of one block")
    if certificate.kind == Kind.WITNESS and payload is not None and after == TRUE:
        _check_point(payload, before, claim)
    elif certificate.kind == Kind.OPTIMUM and payload is not None and after == FALSE:
        _check_conjuncts(payload, before, claim)
    else:
        raise entry.fail("expected a point, or multipliers, for what is claimed")


def _check_point(payload: Entry, before: Exists, claim: Claim) -> None:
    order, matrix, _ = payload.fields("order", "matrix", "values")
    ring = Ring.of(order.names())
    if not set(ring.names) <= set(claim.ring.names):
        raise order.fail("other variables than those of the sentence")
    if convert(normal(formula_from_json(matrix, ring)), claim.ring) != normal(before.body):
        raise matrix.fail("not the formula of the sentence")


def _check_conjuncts(payload: Entry, before: Exists, claim: Claim) -> None:
    if not isinstance(payload.value, dict) or payload.value.get("status") != "infeasible":
        raise payload.fail("expected that there is no solution")
    variables, _, constraints = Entry(payload.value["problem"], f"{payload.path}.problem").fields(
        "variables", "minimise", "constraints"
    )
    names = [v.text() for v in variables.items()]
    if not set(names) <= set(claim.ring.names):
        raise variables.fail("other variables than those of the sentence")
    known = set(conjuncts(before.body))
    for constraint in constraints.items():
        terms, relation = constraint.fields("terms", "relation")
        if atom(read_polynomial(terms, names, claim.ring)[0], RELATIONS[relation.text()]) not in known:
            raise constraint.fail("not a conjunct of the sentence")


def read_polynomial(terms: Entry, names: Sequence[str], ring: Ring) -> tuple[Poly, int]:
    """(p, c) such that the terms, [rational coefficient, exponents of the names], add up to p/c with c > 0."""
    found: dict[tuple[int, ...], Fraction] = {}
    for term in terms.items():
        coefficient, exponents = term.row("coefficient", "exponents")
        powers = [0] * ring.size
        for name, exponent in zip(names, exponents.items(), strict=True):
            powers[ring.index[name]] = exponent.integer()
        found[tuple(powers)] = coefficient.rational()
    scale = lcm(*(c.denominator for c in found.values()))
    return ring.from_terms({powers: int(c * scale) for powers, c in found.items()}), scale

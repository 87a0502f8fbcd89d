"""Whether a certificate is about a given chain: what its members say is read off their labels, and the sentences have
to be those of the chain's conditions and objective, which are made anew. No optimiser takes part."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from fractions import Fraction

import qe
from bezier.chains.chain import Chain, objective_form, requirements
from bezier.chains.form import Form
from bezier.chains.proof import names_of, polynomial
from bezier.chains.repair import changed
from qe.errors import CertificateRejected, QEError
from qe.exact.ring import Ring
from qe.formula.build import atom
from qe.formula.syntax import FALSE, TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.proof.certificate import Certificate, Labelled
from qe.proof.entry import Entry, formula_from_json

LEAST, MOST = "least value at least ", "least value at most "
EXCLUDE, WITHOUT = "they exclude each other", "without "
POSSIBLE, IMPOSSIBLE = "possible", "impossible"


def checked(chain: Chain, certificate: Certificate) -> list[str]:
    """What the certificate proves about the chain, a line for each member. Raises ``CertificateRejected``."""
    members = certificate.payload if isinstance(certificate.payload, tuple) else ()
    if not members:
        raise CertificateRejected("bundle", "expected a bundle")
    conflict = {part for m in members if m.label == EXCLUDE for part in _claimed(chain, m, _labels(chain))}
    for member in members:
        try:
            _examine(chain, member, conflict)
        except (ValueError, LookupError, ZeroDivisionError, QEError) as error:
            raise CertificateRejected(member.label, str(error)) from None
    verdict = qe.verify(certificate)
    if not verdict.accepted:
        raise CertificateRejected(verdict.step, verdict.reason)
    return [member.label for member in members]


def _examine(chain: Chain, member: Labelled, conflict: Collection[Formula]) -> None:
    """Whether the sentence of a member is the one that its label announces."""
    claim, _, change = member.label.partition(" with ")
    if change.endswith(" free"):
        chain = replace(chain, free_via=chain.point_names.index(change.removesuffix(" free")))
    elif change:
        name, _, value = change.partition(" = ")
        chain = changed(chain, name, [Fraction(part) for part in value.split(", ")])
    known = _labels(chain)
    said = set(_claimed(chain, member, known))
    everything = set(known.values())
    if claim.startswith(LEAST):
        below = _value(chain, claim.removeprefix(LEAST), Relation.LT)
        _is(member, below in said <= everything | {below}, FALSE)
    elif claim.startswith(MOST):
        _is(member, said == everything | {_value(chain, claim.removeprefix(MOST), Relation.LE)}, TRUE)
    elif claim in (EXCLUDE, IMPOSSIBLE):
        _is(member, said <= everything, FALSE)
    elif claim == POSSIBLE:
        _is(member, said == everything, TRUE)
    elif claim.startswith(WITHOUT):
        _is(member, bool(conflict) and said >= set(conflict) - {known[claim.removeprefix(WITHOUT)]}, TRUE)
    else:
        raise CertificateRejected(member.label, "no claim about a chain")


def _is(member: Labelled, fits: bool, answer: Formula) -> None:
    payload = member.certificate.payload
    if not fits or not isinstance(payload, dict) or payload.get("answer") is not (answer == TRUE):
        raise CertificateRejected(member.label, "another sentence than that about this chain")


def _labels(chain: Chain) -> dict[str, Formula]:
    """The conditions as atoms by their labels, without those that hold of themselves."""
    solved = chain.solved
    if solved is None:
        raise CertificateRejected("chain", "its joins contradict each other")
    atoms = {row.label: _atom(chain, row.form, Relation.LE) for row in requirements(chain, solved)}
    return {label: condition for label, condition in atoms.items() if condition != TRUE}


def _value(chain: Chain, bound: str, relation: Relation) -> Formula:
    solved = chain.solved
    assert solved is not None
    return _atom(chain, objective_form(chain, solved).shifted(-Fraction(bound)), relation)


def _atom(chain: Chain, form: Form, relation: Relation) -> Formula:
    solved = chain.solved
    assert solved is not None
    ring = Ring.of(names_of(chain, solved.size))
    return atom(polynomial(form, ring, solved.size, chain.dimension), relation)


def _claimed(chain: Chain, member: Labelled, known: dict[str, Formula]) -> list[Formula]:
    """The conditions that the sentence of a member joins under its quantifier."""
    solved, payload = chain.solved, member.certificate.payload
    if solved is None or not isinstance(payload, dict):
        raise CertificateRejected(member.label, "expected a derivation")
    names = names_of(chain, solved.size)
    if payload.get("order") != list(names):
        raise CertificateRejected(member.label, "other variables than those of this chain")
    start = formula_from_json(Entry(payload.get("start"), member.label), Ring.of(names), quantified=True)
    if start == FALSE:  # a condition on given points alone, which is looked for among those of the chain
        return [FALSE] if FALSE in known.values() else [start, TRUE]
    body = start.body if isinstance(start, Exists) else start
    parts = list(conjuncts(body))
    if not all(isinstance(part, Atom) for part in parts) and body != TRUE:
        raise CertificateRejected(member.label, "expected conditions")
    return parts if body != TRUE else []

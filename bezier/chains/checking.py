"""Whether a certificate is about a given chain: what its members say is read off their labels, and the sentences have
to be those of the chain's conditions and objective, which are made anew. No optimiser takes part."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace
from fractions import Fraction

import qe
from bezier.chains.chain import Chain, objective_form, requirements
from bezier.chains.form import Form
from bezier.chains.limits import LENGTH, keeps_limits, stated_chords
from bezier.chains.proof import LEAST, MOST, names_of, polynomial
from bezier.chains.region import at_form, beyond_form, placed
from bezier.chains.repair import changed
from qe.errors import CertificateRejected, QEError
from qe.exact.ring import Ring
from qe.formula.build import atom
from qe.formula.syntax import FALSE, TRUE, Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.proof.certificate import Certificate, Labelled
from qe.proof.entry import Entry, formula_from_json

EXCLUDE, WITHOUT = "they exclude each other", "without "
POSSIBLE, IMPOSSIBLE = "possible", "impossible"


def checked(chain: Chain, certificate: Certificate) -> list[str]:
    """What the certificate proves about the chain, a line for each member. Raises ``CertificateRejected``."""
    members = certificate.payload if isinstance(certificate.payload, tuple) else ()
    if not members:
        raise CertificateRejected("bundle", "expected a bundle")
    first = [m for m in members if m.label.partition(" with ")[0] == EXCLUDE]
    conflict = {part for m in first for part in _claimed(chain, m, _labels(chain).values())}
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
    if matched := re.fullmatch(r"(a|no) chain has (\S+) (?:at|beyond) (.*)", member.label):
        _examine_place(chain, member, matched[2], [Fraction(c) for c in matched[3].split(", ")], matched[1] == "a")
        return
    claim, *changes = member.label.split(" with ")
    for change in changes:
        chain = _changed(chain, change)
    if chain.free not in ("", *chain.moving) and (claim != IMPOSSIBLE or chain.free not in chain.paces):
        raise ValueError("nothing of this name may be free in this claim")
    chords = "".join(change.removeprefix("chords ") for change in changes if change.startswith("chords "))
    known = _labels(chain)
    everything = set(known.values())
    if chords:
        known[LENGTH] = _atom(chain, stated_chords(chain, chain.solved, chords).form, Relation.LE)
    below = {_value(chain, claim.removeprefix(LEAST), Relation.LT)} if claim.startswith(LEAST) else set()
    said = set(_claimed(chain, member, {*known.values(), *below}))
    if below:
        _is(member, below <= said <= {*known.values(), *below}, FALSE)
    elif claim.startswith(MOST):
        _is(member, said == (everything | {_value(chain, claim.removeprefix(MOST), Relation.LE)}) - {TRUE}, TRUE)
        _keeps_limits(chain, member)
    elif claim in (EXCLUDE, IMPOSSIBLE):
        _is(member, said <= set(known.values()), FALSE)
    elif claim == POSSIBLE:
        _is(member, said == everything, TRUE)
        _keeps_limits(chain, member)
    elif claim.startswith(WITHOUT) and claim.removeprefix(WITHOUT) == LENGTH:
        _is(member, bool(conflict) and said >= set(conflict) & everything, TRUE)
    elif claim.startswith(WITHOUT):
        _is(member, bool(conflict) and said >= set(conflict) - {known[claim.removeprefix(WITHOUT)]}, TRUE)
    else:
        raise CertificateRejected(member.label, "no claim about a chain")


def _examine_place(chain: Chain, member: Labelled, name: str, numbers: Sequence[Fraction], has: bool) -> None:
    """A corner of a region (``numbers``: the point), or a half-space (its normal and offset)."""
    freed, _, place = placed(chain, name)
    d, known = chain.dimension, _labels(freed)
    if len(numbers) != d + (not has):
        raise ValueError("the coordinates of a point, or of a half-space, expected")
    said = set(_claimed(freed, member, known.values()))
    if has:
        here = {_atom(freed, form, Relation.LE) for form in at_form(place, tuple(numbers))}
        _is(member, said == (here | set(known.values())) - {TRUE}, TRUE)
    else:
        beyond = _atom(freed, beyond_form(place, tuple(numbers[:d]), numbers[d]), Relation.LT)
        _is(member, beyond in said and said <= {*known.values(), beyond}, FALSE)


def _changed(chain: Chain, change: str) -> Chain:
    if change.startswith("chords "):
        return chain
    if change.endswith(" free"):
        return replace(chain, free=change.removesuffix(" free"))
    name, _, value = change.partition(" = ")
    numbers = [Fraction(part) for part in value.split(", ")]
    if name == "durations" and sum(numbers) != chain.free_total:
        raise ValueError("other durations are given")
    return changed(chain, name, numbers)


def _keeps_limits(chain: Chain, member: Labelled) -> None:
    """Whether the curves of a witness keep the bounds of length and curvature, by exact enclosures."""
    solved = chain.solved
    if chain.max_length is None and chain.max_curvature is None:
        return
    witness = member.certificate.evidence_for("instance") if solved.size else {"values": ()}
    if witness is None:
        raise CertificateRejected(member.label, "expected a witness")
    flat, d = [Fraction(text) for text in witness["values"]], chain.dimension
    points = [tuple(flat[i : i + d]) for i in range(0, len(flat), d)]
    if broken := keeps_limits(chain, solved.curves(points)):
        raise CertificateRejected(member.label, broken)


def _is(member: Labelled, fits: bool, answer: Formula) -> None:
    payload = member.certificate.payload
    if not fits or not isinstance(payload, dict) or payload.get("answer") is not (answer == TRUE):
        raise CertificateRejected(member.label, "another sentence than that about this chain")


def _labels(chain: Chain) -> dict[str, Formula]:
    """The conditions as atoms by their labels, without those that hold of themselves."""
    atoms = {row.label: _atom(chain, row.form, Relation.LE) for row in requirements(chain, chain.solved)}
    return {label: condition for label, condition in atoms.items() if condition != TRUE}


def _value(chain: Chain, bound: str, relation: Relation) -> Formula:
    return _atom(chain, objective_form(chain, chain.solved).shifted(-Fraction(bound)), relation)


def _atom(chain: Chain, form: Form, relation: Relation) -> Formula:
    ring = Ring.of(names_of(chain, chain.solved.size))
    return atom(polynomial(form, ring, chain.solved.size, chain.dimension), relation)


def _claimed(chain: Chain, member: Labelled, known: Collection[Formula]) -> list[Formula]:
    """The conditions that the sentence of a member joins under its quantifier."""
    payload = member.certificate.payload
    if not isinstance(payload, dict):
        raise CertificateRejected(member.label, "expected a derivation")
    names = names_of(chain, chain.solved.size)
    if payload.get("order") != list(names):
        raise CertificateRejected(member.label, "other variables than those of this chain")
    start = formula_from_json(Entry(payload.get("start"), member.label), Ring.of(names), quantified=True)
    if start == FALSE:  # a condition on given points alone, which is looked for among those of the chain
        return [FALSE] if FALSE in known else [start, TRUE]
    body = start.body if isinstance(start, Exists) else start
    parts = list(conjuncts(body))
    if not all(isinstance(part, Atom) for part in parts) and body != TRUE:
        raise CertificateRejected(member.label, "expected conditions")
    return parts if body != TRUE else []

"""What a certificate claims, in words; and whether that is about a given question.

The claim is read off the two formulas between which the steps lead, so an accepted certificate proves just this.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from qe.exact.ring import Ring
from qe.formula.build import disj
from qe.formula.syntax import Constant, Formula
from qe.kernel.negation import negation
from qe.kernel.parts import true_where
from qe.kernel.renaming import is_same
from qe.proof.certificate import Certificate, Kind, Payload
from qe.proof.entry import Entry, formula_from_json
from qe.spelling import quoted


@dataclass(frozen=True, slots=True)
class Claim:
    """``words``: lines of text. ``equivalence``: question and answer of a derivation."""

    words: tuple[str, ...]
    equivalence: tuple[Formula, Formula] | None = None


def claim_of(certificate: Certificate) -> Claim:
    """The claim of a certificate. Raises ``CertificateRejected`` where an entry is malformed."""
    payload = certificate.payload
    if isinstance(payload, tuple):
        words = [f"{m.label}: {line}" for m in payload for line in claim_of(m.certificate).words]
        return Claim((f"{len(payload)} claims", *words) if payload else ("nothing: the bundle is empty",))
    sides = sides_of(certificate)
    if sides is None:
        return Claim((f"{certificate.kind.value}: nothing that is known here",))
    said = _equivalence(*sides)
    if sides[0] == sides[1] and certificate.evidence_for("cells") is not None:
        said = said[0], "has one truth value on each cell of a decomposition"
    return Claim((*said, _rules(_fields(payload)[2])), sides)


def sides_of(certificate: Certificate) -> tuple[Formula, Formula] | None:
    """Question and answer of a derivation, None for anything else. Raises ``CertificateRejected``."""
    if certificate.kind != Kind.DERIVATION:
        return None
    order, start, _, answer = _fields(certificate.payload)
    ring = Ring.of(order.names())
    question, said = (formula_from_json(e, ring, quantified=True) for e in (start, answer))
    return question, said


def _fields(payload: Payload) -> list[Entry]:
    """Order, start, steps and answer of a derivation."""
    assert not isinstance(payload, tuple)
    return Entry(payload, "payload").fields("order", "start", "steps", "answer")


def is_about(certificate: Certificate, formula: Formula) -> Formula | None:
    """The answer that the certificate claims to this formula, up to names of bound variables and the order of
    conjuncts and disjuncts; None where it is about something else.

    A certificate about the negation counts, with the negated answer; of a bundle the first member that is about it.
    """
    for sides in map(sides_of, certificate.parts):
        if sides is not None:
            question, answer = sides
            if is_same(question, formula):
                return answer
            if is_same(question, negation(formula)):
                return negation(answer)
    return None


def parts_of(certificate: Certificate, formula: Formula) -> tuple[Formula, Formula] | None:
    """What the certificate claims to imply this formula, and what its negation; None where it claims neither."""
    claims = [sides for sides in map(sides_of, certificate.parts) if sides is not None]
    sides = [[true_where(claim, side) for claim in claims] for side in (formula, negation(formula))]
    if not any(where is not None for side in sides for where in side):
        return None
    true, false = (disj(where for where in side if where is not None) for side in sides)
    return true, false


def _equivalence(question: Formula, answer: Formula) -> tuple[str, ...]:
    if isinstance(answer, Constant) and not question.free:
        return f"the sentence  {question}", f"is {answer}"
    values = f", for all real values of {', '.join(map(quoted, question.free))}" if question.free else ""
    return f"the formula  {question}", f"is equivalent to  {answer}{values}"


def _rules(steps: Entry) -> str:
    counts: dict[str, int] = {}
    for rule in _named(steps):
        counts[rule] = counts.get(rule, 0) + 1
    listed = ", ".join(f"{rule} ({count})" if count > 1 else rule for rule, count in counts.items())
    return f"by {listed}" if counts else "as it stands, without any step"


def _named(entry: Entry) -> Iterator[str]:
    """The names of the rules of steps, also of nested ones."""
    value = entry.value
    if isinstance(value, dict):
        if isinstance(value.get("rule"), str) and "before" in value:
            yield str(value["rule"])
        for part in value.values():
            yield from _named(Entry(part, entry.path))
    elif isinstance(value, list):
        for part in value:
            if isinstance(part, dict | list):
                yield from _named(Entry(part, entry.path))

"""Checker for certificates of kind "parts": where a formula is true and where it is false, the rest being open.

Payload: ``order``, ``question``, ``true``, ``false`` (without quantifiers) and ``proofs``, certificates about parts of
the question. It says that ``true`` implies the question and ``false`` its negation.

THEOREM. Let T imply A and F imply not A, and so for B, with T' and F'. Then F implies not A and T its negation; T or T'
implies A or B, and F and F' its negation; and dually for A and B. A block over a disjunction is the disjunction of the
blocks (ex x (A or B) iff ex x A or ex x B), and a universal one over a conjunction their conjunction. A block
whose variables do not occur may go. Of any formula nothing is known by the pair (false, false); of one without
quantifiers all by itself and its negation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from qe.certify.claims import parts_of
from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj, exists, forall
from qe.formula.normal import rename_apart
from qe.formula.syntax import FALSE, And, Exists, ForAll, Formula, Or
from qe.kernel.negation import negation, normal
from qe.kernel.renaming import arranged, shape
from qe.options import Budget
from qe.proof.certificate import Certificate, certificate_from
from qe.proof.entry import Entry, Json, formula_from_json

Known = tuple[Formula, Formula]


def check_parts(payload: dict[str, Json], budget: Budget, check_leaf: Callable[[Certificate, Budget], None]) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails. Raises ``Unable``."""
    order, question, true, false, proofs = Entry(payload, "payload").fields(
        "order", "question", "true", "false", "proofs"
    )
    ring = Ring.of(order.names())
    asked = normal(formula_from_json(question, ring, quantified=True))
    apart = rename_apart(asked)  # proofs by cells are about parts of it in these names
    asked = apart if shape(asked) == shape(apart) else asked
    claims = [(entry, normal(formula_from_json(entry, ring))) for entry in (true, false)]
    certificates = [certificate_from(entry) for entry in proofs.items()]
    for k, certificate in enumerate(certificates):
        try:
            check_leaf(certificate, budget)
        except CertificateRejected as error:
            raise CertificateRejected(f"payload.proofs[{k}].{error.step}", error.reason) from None
    known = _known(asked, ring, certificates, budget)
    for (entry, claimed), found in zip(claims, known, strict=True):
        if claimed != FALSE and arranged(claimed) != arranged(normal(found)):
            raise entry.fail(f"not what the proofs give: {found}")


def claims_what_is_proved(certificate: Certificate, budget: Budget) -> bool:
    """Whether its parts are those that its proofs claim, which are not checked here."""
    try:
        assert isinstance(certificate.payload, dict)
        check_parts(certificate.payload, budget, lambda proof, budget: None)
    except (CertificateRejected, Unable):
        return False
    return True


def _known(formula: Formula, ring: Ring, proofs: Sequence[Certificate], budget: Budget) -> Known:
    """What implies the formula, and what its negation, by the proofs and the theorem."""
    budget.check("verify")
    if formula.is_quantifier_free:
        return formula, negation(formula)
    for certificate in proofs:
        found = parts_of(certificate, formula)
        if found is not None and all(set(part.free) <= set(formula.free) for part in found):
            return convert(normal(found[0]), ring), convert(normal(found[1]), ring)
    match formula:
        case Exists(variables, body) | ForAll(variables, body) if not set(variables) & set(body.free):
            return _known(body, ring, proofs, budget)
        case Or(args):
            return _either(_known(a, ring, proofs, budget) for a in args)
        case And(args):
            return _both(_known(a, ring, proofs, budget) for a in args)
        case Exists(variables, body) if isinstance(body, Or):
            return _either(_known(exists(variables, a), ring, proofs, budget) for a in body.args)
        case ForAll(variables, body) if isinstance(body, And):
            return _both(_known(forall(variables, a), ring, proofs, budget) for a in body.args)
    return FALSE, FALSE


def _either(parts: Iterable[Known]) -> Known:
    listed = list(parts)
    return disj(true for true, _ in listed), conj(false for _, false in listed)


def _both(parts: Iterable[Known]) -> Known:
    listed = list(parts)
    return conj(true for true, _ in listed), disj(false for _, false in listed)

"""``verify``: the one entrance to the checkers."""

from __future__ import annotations

from qe.arguments import shown
from qe.certify.cells import check_cells
from qe.certify.clearance import check_clearance
from qe.certify.containment import check_containment
from qe.certify.optimum import check_optimum
from qe.certify.substitution import check_substitution
from qe.certify.verdict import Verdict
from qe.certify.witness import check_witness
from qe.errors import CertificateRejected, InputError
from qe.evidence.cells_json import CellEvidence
from qe.evidence.certificate import Certificate, Kind, Labelled

_CHECKERS = {
    Kind.OPTIMUM: check_optimum,
    Kind.WITNESS: check_witness,
    Kind.SUBSTITUTION: check_substitution,
    Kind.CONTAINMENT: check_containment,
    Kind.CLEARANCE: check_clearance,
}


def verify(certificate: Certificate) -> Verdict:
    """Whether the certificate proves what it says, checked from scratch by code that produces no answers.

    Every entry is checked for its meaning; the digest of a certificate read from text comes last. Raises
    ``InputError`` for anything but a ``Certificate``.
    """
    if not isinstance(certificate, Certificate):
        hint = "a certificate in JSON is read by Certificate.from_json" if isinstance(certificate, str) else ""
        raise InputError(f"certificate: a Certificate expected, {shown(certificate)} found" + (hint and f"; {hint}"))
    try:
        _check(certificate)
        if certificate.digests is not None and certificate.digests[0] != certificate.digests[1]:
            raise CertificateRejected("digest", "the content is not the one that was signed with this digest")
    except CertificateRejected as error:
        return Verdict(False, error.step, error.reason)
    return Verdict(True)


def verify_json(text: str) -> Verdict:
    """``verify`` for a certificate as text; unreadable text is rejected too."""
    try:
        certificate = Certificate.from_json(text)
    except CertificateRejected as error:
        return Verdict(False, error.step, error.reason)
    except InputError as error:
        return Verdict(False, "certificate", str(error))
    return verify(certificate)


def _check(certificate: Certificate) -> None:
    payload = certificate.payload
    if not isinstance(certificate.kind, Kind):
        raise CertificateRejected("kind", "unknown kind of certificate")
    if isinstance(payload, CellEvidence) and certificate.kind is Kind.CELLS:
        check_cells(payload)
    elif isinstance(payload, dict) and certificate.kind in _CHECKERS:
        _CHECKERS[certificate.kind](payload)
    elif isinstance(payload, tuple) and certificate.kind is Kind.BUNDLE:
        for position, member in enumerate(payload):
            if not isinstance(member, Labelled) or not isinstance(member.certificate, Certificate):
                raise CertificateRejected(f"certificates[{position}]", "a certificate with a label expected")
            try:
                _check(member.certificate)
            except CertificateRejected as error:
                step = f"certificates[{position}].{error.step}"
                raise CertificateRejected(step, f"{member.label}: {error.reason}") from None
    else:
        raise CertificateRejected("kind", f"no checker for {certificate.kind.value} with this payload")

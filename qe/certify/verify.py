"""``verify``: the one entrance to the checkers."""

from __future__ import annotations

from collections.abc import Callable

from qe.arguments import shown
from qe.errors import CertificateRejected, InputError, Unable
from qe.kernel.verdict import CRASHES, Verdict
from qe.options import Budget
from qe.proof.certificate import Certificate, Kind, Labelled
from qe.proof.entry import Json

Checker = Callable[[dict[str, Json], Budget], None]
CRASHED = "its checker ends in an internal error here, please report"


def verify(certificate: Certificate, budget: Budget | None = None, *, core: bool = False) -> Verdict:
    """Whether the certificate proves what it says, checked from scratch by code that produces no answers.

    With ``core``, no checker of the expert ring is loaded, and a certificate that needs one is rejected.

    Every entry is checked for its meaning; the digest of a certificate read from text comes last. The budget is looked
    at between steps; when it is used up, or a step is out of reach (``limits``), the verdict is not decided. A checker
    that ends in an error of its own has accepted nothing: that is a rejection, too, and asks to be reported. Raises
    ``InputError`` for anything but a ``Certificate``.
    """
    if not isinstance(certificate, Certificate):
        hint = "a certificate in JSON is read by Certificate.from_json" if isinstance(certificate, str) else ""
        raise InputError(f"certificate: a Certificate expected, {shown(certificate)} found" + (hint and f"; {hint}"))
    try:
        if core:
            from qe.certify.trusts import expert_parts

            if names := expert_parts(certificate):
                raise CertificateRejected("core", f"it needs the expert ring: {', '.join(names)}")
        check_certificate(certificate, budget or Budget(), core=core)
        if certificate.digests is not None and certificate.digests[0] != certificate.digests[1]:
            raise CertificateRejected("digest", "the content is not the one that was signed with this digest")
    except CertificateRejected as error:
        return Verdict(False, error.step, error.reason)
    except Unable as error:
        return Verdict(False, "", str(error), decided=False)
    except RecursionError:
        return Verdict(False, "", "the certificate is nested too deeply", decided=False)
    except (MemoryError, OverflowError):
        return Verdict(False, "", "a number or a table in it is too large", decided=False)
    except CRASHES as error:
        step = next(iter(getattr(error, "__notes__", ())), "certificate")
        return Verdict(False, step, f"{CRASHED} ({type(error).__name__}: {error})")
    return Verdict(True)


def verify_json(text: str, budget: Budget | None = None, *, core: bool = False) -> Verdict:
    """``verify`` for a certificate as text; unreadable text is rejected too."""
    try:
        certificate = Certificate.from_json(text)
    except CertificateRejected as error:
        return Verdict(False, error.step, error.reason)
    except InputError as error:
        return Verdict(False, "certificate", str(error))
    return verify(certificate, budget, core=core)


def check_certificate(certificate: Certificate, budget: Budget, *, core: bool = False) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails, or ``Unable``; ``core``: by the
    kernel alone."""
    payload = certificate.payload
    if not isinstance(certificate.kind, Kind):
        raise CertificateRejected("kind", "unknown kind of certificate")
    if isinstance(payload, dict) and (checker := _checker(certificate.kind, core)) is not None:
        checker(payload, budget)
    elif isinstance(payload, tuple) and certificate.kind == Kind.BUNDLE:
        if not payload:
            raise CertificateRejected("certificates", "an empty bundle proves nothing")
        for position, member in enumerate(payload):
            if not isinstance(member, Labelled) or not isinstance(member.certificate, Certificate):
                raise CertificateRejected(f"certificates[{position}]", "a certificate with a label expected")
            try:
                check_certificate(member.certificate, budget, core=core)
            except CertificateRejected as error:
                step = f"certificates[{position}].{error.step}"
                raise CertificateRejected(step, f"{member.label}: {error.reason}") from None
    else:
        raise CertificateRejected("kind", f"no checker for {certificate.kind.value} with this payload")


def _checker(kind: Kind, core: bool) -> Checker | None:
    """The checker of the only kind that is no bundle."""
    if kind != Kind.DERIVATION:
        return None
    from qe.kernel.derivation import check_derivation
    from qe.kernel.primitives import PRIMITIVES as rules

    if not core:
        from qe.certify.registry import RULES as rules
    return lambda payload, budget: check_derivation(payload, budget, rules)

"""Verification under a limit: of a certificate that a caller has, and of the one that an answer comes with."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from qe.certify.verify import verify as kernel_verdict
from qe.errors import CertificateRejected, InternalError, Unable
from qe.formula.features import text_may_block
from qe.formula.normal import rename_apart, without_clashes
from qe.formula.syntax import Formula
from qe.kernel.verdict import Verdict
from qe.options import VERIFY_SECONDS, Budget, Options
from qe.processes.channel import Channel
from qe.processes.execution import perform, run
from qe.processes.limits import Limits
from qe.proof.answer import UNPROVED, Answer, Guarantee
from qe.proof.certificate import Certificate, Labelled
from qe.proof.entry import Json
from qe.proving.certificates import derived_or_decomposed, without_loss

if TYPE_CHECKING:
    from qe.regions.region import Region

SHARE = 0.8
"""The part of the time left after an answer that its verification may take: the answer has to get home too."""

GRACE = 0.05
SMALL_DEGREE, SMALL_TEXT = 8, 20_000
"""A certificate of this size needs no process of its own: no single step of its verification takes long."""


def verify(
    certificate: Certificate,
    *,
    formula: Formula | None = None,
    timeout: float | None = VERIFY_SECONDS,
    core: bool = False,
) -> Verdict:
    """As ``qe.api.eliminate.verify`` says, of a question that was read. Large certificates, and all that were read from
    text, are checked in a process of their own, which is killed at the limit.
    """
    if not isinstance(certificate, Certificate):
        return kernel_verdict(certificate)  # which says what was expected
    verdict = _limited(certificate, timeout, core=core)
    if formula is None or not verdict.accepted:
        return verdict
    return of_question(certificate, formula)


def read_plainly(text: str, seconds: float) -> Verdict:
    """The verdict of the plain reader on a certificate in JSON (``qe.plain``), in a process without FLINT."""
    budget = Budget(seconds)
    try:
        Certificate.from_json(text)
        command = [sys.executable, "-P", "-S", "-m", "qe.plain", "--json", "--timeout", str(seconds), "-"]
        place = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}  # and no installed package
        run = partial(subprocess.run, input=text, stdout=subprocess.PIPE, env=place, encoding="utf-8")
        said = run(command, timeout=budget.remaining()).stdout
    except CertificateRejected as error:
        return Verdict(False, error.step, error.reason)
    except (Unable, subprocess.TimeoutExpired) as error:
        return Verdict(False, "", str(error), decided=False)
    if not said.endswith("}\n"):
        return Verdict(False, "", "the plain reader ended early", decided=False)
    return Verdict(**json.loads(said))


def of_question(certificate: Certificate, asked: Formula) -> Verdict:
    """The verdict on an accepted certificate: whether it is about a question."""
    from qe.certify.claims import claim_of, parts_of

    if parts_of(certificate, asked) is not None:
        return Verdict(True)
    return Verdict(False, "claim", f"it is about something else: {' '.join(claim_of(certificate).words)}")


def with_verdict(answer: Answer, budget: Budget, *, checked: bool = False) -> Answer:
    """The answer with the guarantee that its certificate gives, which the checkers may have accepted already. One that
    is not verified in the time that is left is dropped, and the reason noted."""
    guarantee, reason = (Guarantee.CHECKED, "") if checked else judged(answer.certificate, budget)
    if guarantee is Guarantee.CHECKED:
        return replace(answer, guarantee=guarantee)
    answer.log.switch("certificate", reason)
    return replace(answer, certificate=None, guarantee=guarantee, reason=reason)


def with_derivation(answer: Answer, timeout: float | None = None) -> Answer:
    """The answer with its own derivation as its certificate, evidence for each of its steps made now and verified.

    Where a step has no accepted evidence, a decomposition of the question takes their place, as with ``check=True``.
    Where that does not end within ``timeout`` seconds, ``guarantee`` stays ``DERIVED``; ``unchecked_steps`` and
    ``reason`` say why. Raises ``Unable`` for what is no answer.
    """
    if answer.formula is None or answer.question is None:
        raise Unable(f"there is no derivation: {answer.reason or 'nothing was asked'}")
    try:
        return perform(partial(_proved, answer), Limits(timeout), at_once=timeout is not None)
    except Unable as error:
        return replace(answer, certificate=None, guarantee=Guarantee.DERIVED, reason=f"{UNPROVED} ({error})")


def _proved(answer: Answer, budget: Budget) -> Answer:
    from qe.formula.counting import without_root_atoms

    asked, said = answer.sides
    question = rename_apart(without_root_atoms(without_clashes(asked)))
    options = Options(certify=True)
    outcome = derived_or_decomposed(asked, question, answer.log, said, options, budget)
    proof = replace(answer, certificate=outcome.certificate, unchecked_steps=outcome.unchecked)
    if outcome.certificate is None:
        return replace(proof, guarantee=Guarantee.DERIVED, reason=outcome.reason)
    return with_verdict(replace(proof, reason=""), budget, checked=outcome.checked)


def judged(certificate: Certificate | None, budget: Budget) -> tuple[Guarantee, str]:
    """The guarantee that a certificate gives within what the budget leaves, and why it is no better."""
    if certificate is None:
        return Guarantee.DERIVED, "there is no certificate"

    def made() -> tuple[Guarantee, str]:
        left = budget.remaining()
        verdict = _limited(certificate, VERIFY_SECONDS if left is None else min(VERIFY_SECONDS, max(0.0, SHARE * left)))
        if verdict.accepted:
            return Guarantee.CHECKED, ""
        if verdict.decided:
            raise InternalError(f"the certificate of an answer was rejected at {verdict.step}: {verdict.reason}")
        return Guarantee.DERIVED, f"the certificate was not verified: {verdict.reason}"

    return without_loss(made, lambda reason: (Guarantee.DERIVED, reason))


def with_guarantee(region: Region, budget: Budget) -> Region:
    """The region, after the elimination of its quantifiers and its table have been verified as far as time allows."""
    answer = region.answer
    if answer is not None and answer.certificate is not None:
        answer = region.answer = with_verdict(answer, budget)
    if region.is_optimised:
        region.reason = "its questions are answered by convex optimisation: bounds have certificates of their own"
        return region
    region.guarantee, region.reason = judged(region.certificate, budget)
    if answer is not None and answer.guarantee is not Guarantee.CHECKED:
        region.guarantee, region.reason = Guarantee.DERIVED, answer.why_unchecked
    return region


def _limited(certificate: Certificate, timeout: float | None, *, core: bool = False) -> Verdict:
    if timeout is None or (certificate.digests is None and _is_small(certificate)):
        return kernel_verdict(certificate, Budget(timeout), core=core)
    try:
        return run(partial(_checked, certificate, core), Limits(timeout), grace=GRACE)
    except Unable as error:
        return Verdict(False, "", str(error), decided=False)


def _checked(certificate: Certificate, core: bool, channel: Channel) -> Verdict:
    return kernel_verdict(certificate, channel.budget(), core=core)


def _is_small(certificate: Certificate) -> bool:
    if not isinstance(certificate, Certificate):  # made by hand: the checker says so
        return True
    payload = certificate.payload
    if isinstance(payload, tuple):
        return all(isinstance(m, Labelled) and _is_small(m.certificate) for m in payload)
    return _is_short(payload)


def _is_short(payload: Json) -> bool:
    """Whether the text in the data, that of cells aside, is short and has no large exponents or long lists."""
    size = 0
    for text in _texts(payload):
        size += len(text) + 1
        if size > SMALL_TEXT or text_may_block(text, SMALL_DEGREE):
            return False
    return True


def _texts(data: Json) -> Iterator[str]:
    pending: list[Json] = [data]
    while pending:
        node = pending.pop()
        if isinstance(node, str):
            yield node
        elif isinstance(node, dict | list):
            below: Iterable[Json] = node if isinstance(node, list) else [v for k, v in node.items() if k != "root"]
            pending += below
            yield " "

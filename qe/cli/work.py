"""What the commands do inside the worker: call the public functions, turn answers into text and plain data (``Reply``),
which alone cross the border to the parent process."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import qe.api.eliminate as api
from qe.api.limits import under
from qe.cli.source import Reply, Request, Source, certificate_text, in_json, read_question
from qe.errors import CertificateRejected, InputError, Unable
from qe.exact.number import point_text
from qe.formula.assumed import claimed
from qe.formula.build import conj, exists
from qe.formula.syntax import TRUE
from qe.io import formats
from qe.io.formats import Format
from qe.io.scripts import asks_satisfiability
from qe.options import Budget
from qe.processes.channel import Channel
from qe.processes.limits import Limits
from qe.proof.answer import Answer
from qe.proof.certificate import Certificate
from qe.proof.partial import Partial


def eliminate(channel: Channel, request: Request, output: Format, *, shorter: bool = False) -> Reply:
    """``qe eliminate`` and ``qe simplify``."""
    ask: Callable[..., Answer] = api.simplify if shorter else api.eliminate
    formula, keywords = request.read(channel)
    answer = ask(formula, **keywords)
    if answer.formula is None:
        if answer.partial is None:
            raise Unable(answer.reason or "no answer")
        return _partial_reply(answer, answer.partial, request, output)
    written = formats.write(answer.formula, output.value)
    assumed = {"assuming": formats.write(answer.assuming, output.value)} if answer.assuming.free else {}
    data = {"status": answer.status.name.lower(), "formula": written, **assumed, **_summary(answer, request.seconds)}
    text = written.rstrip("\n")
    if answer.generic:
        text += f"\nassuming {' and '.join(map(str, answer.generic))}"
    return request.reply(answer, text, data, notes=_story(request, answer))


def _partial_reply(answer: Answer, partial: Partial, request: Request, output: Format) -> Reply:
    """What is known where a limit ended the work: three formulas, with the exit status of no answer."""
    files = {} if partial.certificate is None else {"certificate": certificate_text(partial)}
    parts = {"true": partial.proved_true, "false": partial.proved_false, "open": partial.open}
    written = {name: formats.write(part, output.value).rstrip("\n") for name, part in parts.items()}
    if request.json:
        guarantee = "checked" if partial.is_checked else "derived"
        known = {"reason": answer.reason, "partial": written, "guarantee": guarantee}
        data = {"status": answer.status.name.lower(), **known}
        return Reply(in_json(data), files=files, code=3)
    lines = [f"{name}: {text}" for name, text in written.items()]
    if request.certificate:
        lines.append("certificate: " + ("checked" if partial.is_checked else partial.reason))
    return Reply("\n".join(lines), (answer.reason,) if request.explain else (), files, code=3)


def decide(channel: Channel, request: Request) -> Reply:
    """``qe decide``: a sentence is true or false; an SMT-LIB script, whose constants are existential, sat or unsat."""
    script = request.source.format is Format.SMTLIB or asks_satisfiability(request.source.text)
    formula, keywords = request.read(channel)
    stated = under(formula, TRUE, keywords.pop("assuming"), Limits(), numbers=True)
    if script:
        sentence = exists(stated.restricted.free, stated.restricted)
    else:
        sentence = stated.closed(stated.formula)
        if free := [name for name in stated.formula.free if name not in stated.known.free]:
            names = ", ".join(free)
            hint = f"qe eliminate takes them; all {names}. … makes a sentence"
            raise InputError(f"{request.source.name}: a sentence expected, but free here: {names} ({hint})")
    answer = api.eliminate(sentence, **keywords)
    if answer.truth is None:
        raise Unable(answer.reason or "no answer")
    text = ("sat" if answer.truth else "unsat") if script else ("true" if answer.truth else "false")
    data = {"status": answer.status.name.lower(), **_summary(answer, request.seconds)}
    return request.reply(answer, text, data, notes=_story(request, answer))


def _summary(answer: Answer, seconds: float) -> dict[str, Any]:
    """What the JSON of every answer says."""
    return {
        "truth": answer.truth,
        "witness": None if answer.witness is None else {name: str(value) for name, value in answer.witness.items()},
        "guarantee": answer.guarantee.name.lower(),
        "trusts": list(answer.trusts),
        "stats": plain(answer.stats),
        "seconds": seconds,
    }


def convert(channel: Channel, source: Source, output: Format) -> Reply:
    """``qe convert``."""
    formula, known = read_question(channel, source)
    return Reply(formats.write(conj((known, formula)), output.value).rstrip("\n"))


def check(
    channel: Channel,
    source: Source,
    asked: Source | None,
    seconds: float,
    *,
    assuming: str | None = None,
    as_json: bool = False,
    core: bool = False,
    plainly: bool = False,
) -> Reply:
    """``qe check``: exit status 4 when the certificate is rejected, 3 when that is not decided."""
    from qe.api.verify import of_question, read_plainly
    from qe.certify.claims import claim_of, is_about, parts_of
    from qe.certify.verify import verify

    start = time.perf_counter()
    formula = None
    if asked is not None:
        stated = under(*read_question(channel, asked), assuming, Limits(seconds), numbers=True)
        formula = claimed(stated.known, stated.formula, stated.formula)
    certificate = _certificate(source)
    budget = Budget(seconds, listener=channel.event)
    verdict = read_plainly(source.text, seconds) if plainly else verify(certificate, budget, core=core)
    if verdict.accepted and formula is not None:
        verdict = of_question(certificate, formula)
    if not verdict.decided:
        raise Unable(f"not decided: {verdict.reason}")
    if not verdict.accepted:
        raise CertificateRejected(verdict.step, verdict.reason)
    took, trusts = time.perf_counter() - start, certificate.trusts
    if as_json:
        claims = list(claim_of(certificate).words)
        data = {"status": "accepted", "claims": claims, "trusts": list(trusts), "seconds": round(took, 6)}
        return Reply(in_json(data))
    lines = [f"accepted ({took:.3f} s)", *claim_of(certificate).words, *_rests(trusts)]
    if formula is not None:
        parts = parts_of(certificate, formula)
        assert parts is not None
        if (answer := is_about(certificate, formula)) is not None:
            lines.append(f"so the question that was given has the answer  {answer}")
        else:
            lines.append(f"so the question that was given is true where  {parts[0]}  and false where  {parts[1]}")
    return Reply("\n".join(lines))


def export_proof(channel: Channel, source: Source, seconds: float) -> Reply:
    """``qe export-proof``: exit status 4 when the certificate is rejected, 3 where it cannot be checked or written."""
    from qe.certify.verify import verify
    from qe.coq.export import to_coq

    certificate = _certificate(source)
    verdict = verify(certificate, Budget(seconds, listener=channel.event))
    if not verdict.decided:
        raise Unable(f"not decided: {verdict.reason}")
    if not verdict.accepted:
        raise CertificateRejected(verdict.step, verdict.reason)
    return Reply(to_coq(certificate).rstrip("\n"))


def _certificate(source: Source) -> Certificate:
    try:
        return Certificate.from_json(source.text)
    except InputError as error:
        raise InputError(f"{source.name}: {error}") from None


def _story(request: Request, answer: Answer) -> tuple[str, ...]:
    """For people who want it: the witness, the guarantee, and the steps that led to the answer."""
    if request.json or not request.explain:
        return ()
    lines = []
    if answer.witness:
        lines.append(f"{'counterexample' if answer.truth is False else 'witness'}: {point_text(answer.witness)}")
    lines.append(f"{answer.guarantee.value} in {request.seconds:.3f} s")
    return (*lines, *_rests(answer.trusts), *answer.explanation.splitlines())


def _rests(trusts: Sequence[str]) -> Iterator[str]:
    """What has to be believed besides the kernel, a line each."""
    from qe.certify.registry import RULES
    from qe.kernel.statements import rows

    for name in trusts:
        what = "a rule" if name in RULES else "a kind of certificate"
        why = f"by {rows()[name].data['axiom']}" if name in rows() else f"{what} of the expert ring"
        yield f"rests on: {name}, {why}"


def plain(value: object) -> object:
    """Any value as JSON data: numbers, texts, truth values, lists and objects stay, the rest becomes text."""
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        return [plain(v) for v in value]
    return str(value)

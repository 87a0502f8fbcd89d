"""The certificate of an answer: a method's own, a witness, linear equations, the derivation, or a decomposition."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import TypeVar

from qe.elimination.protocol import Outcome, witness_of
from qe.errors import Contradiction, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import convert
from qe.formula.normal import without_clashes
from qe.formula.syntax import And, Atom, Exists, Formula
from qe.formula.traverse import conjuncts
from qe.options import Budget, Options
from qe.proof.answer import UNPROVED
from qe.proof.certificate import Certificate, Kind, Proof
from qe.proof.derivation import put_together
from qe.proof.entry import formula_to_json
from qe.proof.run_log import RunLog
from qe.proving.primitive_names import PROJECTION
from qe.rules.linear import linear_in, put_in

Result = TypeVar("Result")

CERTIFY_WORK = 200_000
"""Units of work that a decomposition may take for nothing but a certificate (the longest in the corpus: 90 000)."""

CERTIFY_SHARE = 0.4
"""Where the caller limits the time, the share of what is left that it may take: the answer has to get home."""

NOT_WANTED = "no proof was asked for"
"""Why an answer has no certificate that was not to be checked."""

PROOF_SHARE = 0.8
"""The share of the time left after the answer that finding evidence for its steps may take."""


def certificate_of(
    asked: Formula, question: Formula, outcome: Outcome, log: RunLog, options: Options, budget: Budget
) -> Proof:
    """The certificate that a method made if it is about this very question and answer; else one by a witness or by
    linear equations. Where one was asked for also: the derivation, or a decomposition if time allows.

    ``asked``: the formula of the caller; ``question``: the same with its root atoms counted and its variables renamed.
    """
    problem, made = Block.of(question), outcome.certificate
    if outcome.make is not None and (options.certify or not outcome.large):
        made = outcome.make()
    if made is None and outcome.witness is not None and problem is not None and problem.is_flat and not problem.free:
        with suppress(Unable):  # where it is too long to be written
            made = witness_of(problem, outcome.witness)
    if made is not None and _says_just(made, question, outcome.formula):
        return Proof(made)
    if made is not None and _is_known_to_say(made, question, outcome.formula):
        step = made.single_step
        assert isinstance(step["evidence"], dict)
        return Proof(Certificate.step(str(step["rule"]), (), question, outcome.formula, step["evidence"]))
    linear = substitution_certificate(question, outcome.formula)
    if linear is not None or not options.certify:
        return Proof(linear, reason="" if linear is not None else NOT_WANTED)
    return derived_or_decomposed(asked, question, log, outcome.formula, options, budget)


def _is_known_to_say(made: Certificate, question: Formula, answer: Formula) -> bool:
    """Whether it claims this answer to this question, up to names and order."""
    from qe.certify.claims import is_about
    from qe.kernel.renaming import is_same

    said = is_about(made, question)
    return said is not None and is_same(said, answer)


def _says_just(made: Certificate, question: Formula, answer: Formula) -> bool:
    """Whether a derivation leads from this question to this answer as they stand: then nothing has to be read."""
    payload = made.payload
    if made.kind != Kind.DERIVATION or isinstance(payload, tuple):
        return False
    order = payload["order"]
    assert isinstance(order, list)
    ring = Ring.of(map(str, order))
    if not ring.index.keys() >= {*question.free, *question.bound}:
        return False
    sides = (formula_to_json(convert(side, ring), quantified=True) for side in (question, answer))
    return all(payload[name] == side for name, side in zip(("start", "answer"), sides))


def substitution_certificate(block: Formula, answer: Formula) -> Certificate | None:
    """A certificate for ``block`` <-> ``answer``, or None where linear equations with constant pivots do not give it.

    ``block`` must be ``ex variables. conjunction``. Source: the Gauss case of Loos & Weispfenning 1993, section 3.
    """
    if not isinstance(block, Exists) or not block.body.is_quantifier_free or not isinstance(block.body, And):
        return None
    ring = Ring.of(dict.fromkeys((*block.body.free, *block.variables)))
    body = matrix = convert(block.body, ring)
    solved: list[tuple[str, Poly]] = []
    left = list(block.variables)
    while left:
        parts = conjuncts(body)
        plain = ((k, i) for k, i, _, lead in linear_in(parts, left) if lead.is_constant)
        found = next(((ring.names[i], part.poly) for k, i in plain if isinstance(part := parts[k], Atom)), None)
        image = None if found is None else put_in(body, ring.index[found[0]], found[1])
        if found is None or image is None:
            return None
        body = image
        solved.append(found)
        left.remove(found[0])
    if {*conjuncts(body)} != {*conjuncts(convert(answer, ring))}:
        return None
    return Certificate.substitution(matrix, ring.names, solved, body)


def derived_or_decomposed(
    asked: Formula, question: Formula, log: RunLog, answer: Formula, options: Options, budget: Budget
) -> Proof:
    """The derivation; where a step of it has no evidence, a decomposition of the whole question, if time allows."""
    proof = derived(asked, log, answer, options, budget)
    if proof.certificate is not None or PROJECTION in proof.unchecked:
        return proof
    log.switch("derivation", proof.reason)
    table = _table(question, answer, log, options, budget)
    return proof if table is None else replace(proof, certificate=table, reason="")


def derived(asked: Formula, log: RunLog, answer: Formula, options: Options, budget: Budget) -> Proof:
    """The steps of the log from a formula to its answer with evidence for each, within a share of the time.

    Certificates say nothing about a formula in which a quantifier binds a name that it sees: theirs begins with other
    names of its bound variables.
    """

    def made() -> Proof:
        from qe.proving.prover import proved

        derivation = put_together(without_clashes(asked), log.steps(), answer)
        proof = proved(derivation, answer, options, budget.share(PROOF_SHARE).part(CERTIFY_WORK))
        missing = "" if proof.certificate else f"no checked evidence for: {', '.join(proof.unchecked)}"
        return replace(proof, reason=missing)

    return without_loss(made, lambda reason: Proof(None, (f"all ({reason})",), reason=reason))


def without_loss(work: Callable[[], Result], instead: Callable[[str], Result]) -> Result:
    """What ``work`` finds that proves an answer, or ``instead`` of the reason why it does not come to an end.

    No answer is lost for its proof, whatever goes wrong: every search for one, and every check, is called here. Raises
    ``Contradiction`` only, which is a proof that the answer, or another one, is wrong.
    """
    try:
        return work()
    except Unable as error:
        return instead(f"{UNPROVED} ({error})")
    except Contradiction:
        raise
    except Exception as error:  # noqa: BLE001  # a bug in here costs the proof, which says so, and not the answer
        return instead(fault(error))


def fault(error: Exception) -> str:
    """What is said of a proof that an error of this program ended."""
    return f"internal error, please report: {type(error).__name__}: {error}"


def _table(question: Formula, answer: Formula, log: RunLog, options: Options, budget: Budget) -> Certificate | None:
    """A decomposition of the whole question, made for its certificate only; None where it does not end."""

    def made() -> Certificate | None:
        from qe.elimination.cad import certificate_for

        return certificate_for(question, answer, options, budget.share(CERTIFY_SHARE).part(CERTIFY_WORK))

    return without_loss(made, lambda reason: log.switch("no certificate", reason))

"""``eliminate``, ``simplify``, ``region`` and ``verify``, which all other public functions go through."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Unpack, cast

from qe import arguments
from qe.api.input import AnyFormula, order_of, read_posed
from qe.api.limits import limits_of, performed, posed, under
from qe.api.settings import Elimination, Order, ProvedQuestion, Search, with_settings
from qe.errors import InputError, InternalError, Unable
from qe.exact.number import ExactPoint, point_text
from qe.formula.assumed import Aim, Posed, claimed
from qe.formula.block import Block
from qe.formula.build import conj
from qe.formula.evaluate import holds_at
from qe.formula.numbers import bounds_of_numbers, is_settled
from qe.formula.syntax import FALSE, Formula
from qe.io import formats
from qe.io.sharing import refuse_shared
from qe.io.substitution import over_one_ring
from qe.options import VERIFY_SECONDS, Budget, Cluster, Method, Options, Projection, Stage
from qe.processes.channel import Channel
from qe.processes.limits import Limits
from qe.proof.answer import UNPROVED, Answer, Guarantee, Status
from qe.proof.certificate import Certificate
from qe.proof.partial import Partial
from qe.proof.run_log import RunLog

if TYPE_CHECKING:  # the checker and the optimiser are loaded where they are used
    from qe.kernel.verdict import Verdict
    from qe.regions.region import Region

WHOLE_SHARE, PARTS_SHARE = 0.5, 0.85
"""Where parts are wanted if there is no answer: the share of the time that the formula as a whole may take; and the
share of the rest in which the parts are looked at, so that what is found gets home."""

UNVERIFIED_SHARE = 0.6
"""Where the parts are to be checked, the share of the time for them in which they are found."""


@with_settings(Elimination)
def eliminate(formula: AnyFormula, **settings: Unpack[Elimination]) -> Answer:
    """Quantifier elimination over the reals: an equivalent quantifier-free formula.

    At a limit, for which the work runs in a process that can be killed, the answer has status UNABLE, with the reason.
    Raises ``InputError`` for input that cannot be read.
    """
    limits = limits_of(settings)
    try:
        given = posed(formula, settings, limits, numbers=True)
    except Unable as error:
        return Answer(Status.UNABLE, None, reason=str(error))
    order = order_of(settings["order"], formula, given.restricted)
    problem = Posed(given.formula, given.known, Aim.GENERIC if settings["generic"] else Aim.EQUIVALENT)
    return answered_under(problem, order, settings, limits, anytime=settings["anytime"])


@with_settings(ProvedQuestion)
def simplify(formula: AnyFormula, **settings: Unpack[ProvedQuestion]) -> Answer:
    """A formula that is equivalent where ``assuming`` holds, with no more of degree, as short as an answer would be.

    Quantifiers stay: what stands under them is simplified (Dolzmann and Sturm 1997). A formula without any goes through
    all that shortens answers: ideals, decompositions, parts that make no difference. Limits as for ``eliminate``.
    """
    limits = limits_of(settings)
    try:
        given = posed(formula, settings, limits, numbers=True)
    except Unable as error:
        return Answer(Status.UNABLE, None, reason=str(error))
    problem, options = Posed(given.formula, given.known, Aim.SHORTER), Options(certify=settings["check"])
    return _limited(problem, options, limits, settings["check"], None)


def answered_under(
    problem: Posed, order: tuple[str, ...] | None, settings: Search, limits: Limits, *, anytime: bool = False
) -> Answer:
    """The answer to a question that has been read; ``order`` is that of the settings, of its variables alone."""
    check, methods = settings["check"], cast(frozenset[Method], settings["race"])
    options = Options(
        method=Method(settings["method"]),
        order=order,
        projection=Projection(settings["projection"]),
        root_atoms=settings["root_atoms"],
        without=cast(frozenset[Stage], settings["without"]),
        certify=check,
    )
    helpers = _cluster(settings)
    if methods and (helpers is not None or options.method is not Method.AUTO or not limits.process):
        raise InputError("race: cannot go with method, workers, cluster or process=False")
    whole = limits.shared(WHOLE_SHARE) if anytime else limits
    answer = _limited(problem, options, whole, check, helpers, methods)
    if answer.formula is not None and not is_settled(answer.formula):  # numbers came closer than the question showed
        formula, *known = over_one_ring(problem.formula, problem.known, bounds_of_numbers(answer.formula))
        answer = _limited(replace(problem, formula=formula, known=conj(known)), options, whole, check, helpers, methods)
    if anytime and answer.formula is None:
        answer = replace(answer, partial=_partial(problem.formula, options, limits))
    if settings["explain"]:
        print(answer.explanation or answer.reason, file=sys.stderr)
    return answer


def _cluster(settings: Search) -> Cluster | None:
    """The processes that help; None where there are none."""
    count, address = settings["workers"], settings["cluster"]
    if address is not None and count:
        raise InputError("workers, cluster: one of them expected, both found")
    return None if address is None and not count else Cluster(count, address)


def _limited(
    problem: Posed,
    options: Options,
    limits: Limits,
    check: bool,
    cluster: Cluster | None,
    methods: Iterable[Method] = (),
) -> Answer:
    """The answer, from a worker where it takes long or a limit is to hold; with ``methods`` the first that one has."""
    try:
        if methods:
            return raced(partial(_answer_by, problem, options, check), methods, limits)
        work = partial(_answer, problem, options, check, cluster)
        return performed(work, problem.formula, limits, at_once=cluster is not None)
    except Unable as error:
        return Answer(Status.UNABLE, None, reason=str(error), question=problem.formula)


def _partial(formula: Formula, options: Options, limits: Limits) -> Partial:
    """What can be said of the parts of a formula in the time that is left; at worst, nothing."""
    from qe.engine.anytime import partly

    left = None
    if limits.timeout is not None and limits.start is not None:
        left = max(0.0, limits.start + limits.timeout - time.monotonic()) * PARTS_SHARE
    budget = Budget(left)
    finding = budget.share(UNVERIFIED_SHARE) if options.certify else budget
    try:
        known = partly(formula, options, finding, Limits(memory=limits.memory, process=limits.process))
    except Unable:
        return Partial()
    if not options.certify:
        return known
    from qe.api.verify import judged

    if known.proved_true == known.proved_false == FALSE:
        return replace(known, certificate=None, reason="nothing is decided")
    guarantee, reason = judged(known.certificate, budget)
    return replace(known, is_checked=guarantee is Guarantee.CHECKED, reason=reason)


def unproved(sentence: Formula, budget: Budget) -> Answer:
    """The answer to a sentence, in this process, for those who show no guarantee: rational values are put back into the
    sentence, which needs no kernel."""
    from qe.engine.posed import answer_to, answered

    refuse_shared(sentence)
    answer, block = answer_to(answered(Posed(sentence), Options(), budget)), Block.of(sentence)
    if answer.witness is None or block is None:
        return answer
    rational = {name: value for name, value in answer.witness.items() if isinstance(value, Fraction)}
    if not block.is_flat or len(rational) < len(answer.witness):
        return decided(sentence, Options(), budget)
    if holds_at(block.body, rational) is block.universal:
        raise InternalError(f"the values that were found do not satisfy the formula: {point_text(rational)}")
    return answer


def decided(sentence: Formula, options: Options, budget: Budget) -> Answer:
    """The answer to a sentence that has been read, in this process."""
    answer = _answer(Posed(sentence), options, options.certify, None, budget)
    if answer.truth is None:
        raise Unable(answer.reason or "no decision was reached")
    return answer


def instance(answer: Answer, given: Formula) -> ExactPoint | None:
    """The values of a formula's free variables that the answer whether there are any has; None: there are none."""
    if answer.truth is False:
        return None
    if answer.witness is None and given.free:
        raise Unable("the formula is satisfiable, but no point was found")
    return ExactPoint({name: (answer.witness or {}).get(name, Fraction(0)) for name in given.free})


def _answer_by(problem: Posed, options: Options, check: bool, method: Method, channel: Channel) -> Answer:
    return _answer(problem, options.with_(method=method), check, None, channel.budget())


def _answer(problem: Posed, options: Options, check: bool, cluster: Cluster | None, budget: Budget) -> Answer:
    """What the engine says, verified where that is wanted, or costs little; what is to be proved is kept before."""
    if cluster is not None:
        from qe.processes.cluster import helping

        with helping(cluster) as budget.helpers:
            return _answer(problem, options, check, None, budget)
    from qe.engine.posed import answer_to, answered, proved

    try:
        known = answered(problem, options, budget)
        if options.certify:
            budget.keep(replace(answer_to(known), certificate=None, reason=UNPROVED))
        outcome = proved(known, options, budget)
    except Unable as error:
        log = RunLog()
        log.work("limits", {"work": budget.used})
        return Answer(Status.UNABLE, None, reason=str(error), question=problem.formula, log=log)
    answer, certificate = answer_to(outcome), outcome.outcome.certificate
    if certificate is not None and (check or certificate.evidence_for("instance") or answer.witness is not None):
        from qe.api.verify import with_verdict

        return with_verdict(answer, budget, checked=outcome.outcome.checked)
    return answer


@with_settings(ProvedQuestion)
def region(formula: AnyFormula, order: Order = None, **settings: Unpack[ProvedQuestion]) -> Region:
    """The solution set of a formula in its free variables (or in ``order``, which may name more), as a cylindrical
    description with a certificate; quantifiers are eliminated first.

    Without ``order`` a quantified formula is described in the order in which its answer was found: the other may be
    much harder. For a conjunction of convex quadratic conditions in four or more variables membership, fibres and
    bounds are found by exact optimisation, and the description on request. The limits hold here and for every question
    that is asked of the region. With ``check`` the description is made at once and verified; ``Region.guarantee`` and
    ``reason`` say what came of it, ``Region.answer`` has the elimination of the quantifiers with its derivation,
    ``Region.proof`` is for others. Raises ``InputError`` for what cannot be read and ``BudgetExceeded`` at a limit.
    """
    limits, names = limits_of(settings), arguments.names(order)
    whole, check = replace(limits, start=None), settings["check"]
    given = posed(formula, settings, limits).restricted
    return performed(partial(region_of, given, names, whole, check), given, limits)


def region_of(given: Formula, names: tuple[str, ...] | None, whole: Limits, check: bool, budget: Budget) -> Region:
    """The solution set, in this process; with ``check`` its table is verified."""
    from qe.api.verify import with_guarantee
    from qe.regions.build import described

    solution_set = described(given, names, budget, whole, check=check)
    return with_guarantee(solution_set, budget) if check else solution_set


def verify(
    certificate: Certificate,
    *,
    formula: AnyFormula = None,
    assuming: AnyFormula = None,
    format: str = "text",
    timeout: float | None = VERIFY_SECONDS,
    core: bool = False,
) -> Verdict:
    """Whether separate code accepts the certificate, within ``timeout`` seconds (None: no limit); see ``qe.certify``.

    With ``formula``, also whether it is about that question (under ``assuming``), or its negation, up to the names of
    bound variables and the order of conjuncts and disjuncts. With ``core``, a certificate that needs rules of the
    expert ring (``Certificate.trusts`` names them) is rejected at ``core``, one about another question at ``claim``.
    Past the limit the verdict is neither accepted nor ``decided``. Raises ``InputError`` for what is no certificate,
    a formula that cannot be read and a limit that is not positive.
    """
    from qe.api.verify import verify as check

    chosen = formats.checked(format)
    problem = None
    if formula is not None:
        given = under(*read_posed(formula, chosen.value), assuming, Limits(), numbers=True)
        problem = claimed(given.known, given.formula, given.formula)
    arguments.flag(core, "core")
    return check(certificate, formula=problem, timeout=arguments.seconds(timeout), core=core)


def raced(asked: Callable[[Method, Channel], Answer], methods: Iterable[Method], limits: Limits) -> Answer:
    """The first answer that ``asked``, which can be pickled, has by one of the methods, within the limits; UNABLE, with
    the reasons of all, where none has one."""
    from qe.processes.racing import first

    unproved: list[Answer] = []
    order = sorted(methods, key=lambda method: method.value)
    works = {method: partial(asked, method) for method in order}
    winner, answers = first(works, lambda answer: answer.status is Status.SOLVED, limits, kept=unproved.append)
    answer = None if winner is None else answers[winner]
    if winner is not None and isinstance(answer, Answer):
        others = ", ".join(method.value for method in order if method is not winner)
        answer.log.choice("", (), f"the first answer was that of {winner.value}, ahead of {others or 'no other'}")
        return answer
    if unproved:
        return unproved[0]
    reasons = [f"{method.value}: {_reason(answers.get(method))}" for method in order]
    return Answer(Status.UNABLE, None, reason="; ".join(reasons))


def _reason(outcome: object) -> str:
    if isinstance(outcome, Answer):
        return outcome.reason
    return "its process ended without an answer" if outcome is None else str(outcome)

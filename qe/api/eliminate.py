"""``eliminate``, ``region`` and ``verify``, which all other public functions go through."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

from qe import arguments
from qe.api.input import AnyFormula, order_of, read_formula
from qe.api.limits import cluster_of, limits_of, performed, reading
from qe.errors import InputError, Unable
from qe.formula.syntax import FALSE, Formula
from qe.options import VERIFY_SECONDS, Budget, Cluster, Method, Options, Projection, Stage
from qe.processes.execution import Budgets, Limits
from qe.progress import Event, silent
from qe.proof.answer import UNPROVED, Answer, Guarantee, Status
from qe.proof.certificate import Certificate, Kind
from qe.proof.partial import Partial
from qe.proof.run_log import RunLog

if TYPE_CHECKING:  # the checker and the optimiser are loaded where they are used
    from qe.certify.verdict import Verdict
    from qe.regions.region import Region

Result = TypeVar("Result")

WHOLE_SHARE, PARTS_SHARE = 0.5, 0.85
"""Where parts are wanted if there is no answer: the share of the time that the formula as a whole may take; and the
share of the rest in which the parts are looked at, so that what is found gets home."""

UNVERIFIED_SHARE = 0.6
"""Where the parts are to be checked, the share of the time for them in which they are found."""

Progress = Callable[[Event], None]
Order = Any
"""``"y, x"``, ``"y x"``, or a list of names or SymPy symbols."""


def _options(
    method: str | Method,
    order: Order,
    projection: str | Projection,
    root_atoms: bool,
    without: Iterable[str | Stage] | str | Stage,
    progress: Progress,
) -> Options:
    return Options(
        method=arguments.member(method, Method, "method"),
        order=arguments.names(order),
        projection=arguments.member(projection, Projection, "projection"),
        root_atoms=arguments.flag(root_atoms, "root_atoms"),
        without=arguments.members(without, Stage, "without"),
        progress=arguments.listener(progress),
    )


def eliminate(
    formula: AnyFormula,
    *,
    format: str = "text",
    total_division: bool = False,
    timeout: float | None = None,
    memory: int | None = None,
    method: str | Method = Method.AUTO,
    order: Order = None,
    projection: str | Projection = Projection.BROWN_MCCALLUM,
    progress: Progress = silent,
    root_atoms: bool = False,
    without: Iterable[str | Stage] | str | Stage = (),
    explain: bool = False,
    check: bool = False,
    process: bool = True,
    workers: int = 0,
    cluster: str | None = None,
    race: Iterable[str | Method] | str | Method = (),
    anytime: bool = False,
) -> Answer:
    """Quantifier elimination over the reals: an equivalent quantifier-free formula.

    ``timeout`` (seconds), ``memory`` (MB): with either, the work runs in a forked worker process that is killed at the
    limit, since a single polynomial operation can take long (where processes cannot fork, ``timeout`` is only checked
    between steps). At a limit the answer has status UNABLE, with the reason. Without limits the work moves to such a
    process when it takes longer than a moment, so that Ctrl-C ends it at once; ``process=False``, or the environment
    variable ``QE_PROCESS=off``, keeps it in this process.

    ``anytime``: at a ``timeout``, which is shared, ``Answer.partial`` says for which values of the free variables the
    formula is proved to be true, for which false, and which are open; with ``check`` under a certificate.

    ``check``: the answer comes with a certificate where one can be had (if the method makes none, by a decomposition of
    the whole formula), verified by the separate checker; certificates that are a witness always are. A proof
    or verification that does not end in time costs the certificate, not the answer (``Answer.reason`` says so).

    ``total_division``: a quotient in text has some value where its denominator is zero, too, as in SMT-LIB: the formula
    holds if it does for a choice of these values.

    ``explain``: how the answer was found is told on stderr; ``Answer.explanation`` holds the same text. ``without``:
    stages of the engine to be left out (``qe.Stage``), to measure what they gain. ``projection``: the operator by which
    decompositions project (``qe.Projection``); the answers are equivalent.

    ``workers`` (processes on this machine) or ``cluster`` (the address of a Dask scheduler): the cells of long
    decompositions are lifted side by side; the answer and its certificate are the same as without. ``race``: methods
    that try side by side, each in a process of its own; the answer is the first one, and which that is may differ from
    run to run.

    Raises ``InputError`` for input that cannot be read.
    """
    start = time.monotonic()
    explain, check = arguments.flag(explain, "explain"), arguments.flag(check, "check")
    limits = limits_of(timeout, memory, progress, process).begun(start)
    options = _options(method, order, projection, root_atoms, without, progress).with_(certify=check)
    helpers, racing = cluster_of(workers, cluster), arguments.members(race, Method, "race")
    if racing and (helpers is not None or options.method is not Method.AUTO or not limits.process):
        raise InputError("race: cannot go with method, workers, cluster or process=False")
    try:
        given = reading(formula, format, limits, total_division)
    except Unable as error:
        return Answer(Status.UNABLE, None, reason=str(error))
    options = options.with_(order=order_of(order, formula, given))
    whole = limits.shared(WHOLE_SHARE) if arguments.flag(anytime, "anytime") else limits
    if racing:
        answer = _raced(given, options, whole, check, racing)
    else:
        answer = _limited(given, options, whole, check, helpers)
    if anytime and answer.formula is None:
        answer = replace(answer, partial=_partial(given, options, limits))
    if explain:
        print(answer.explanation or answer.reason, file=sys.stderr)
    return answer


def _limited(formula: Formula, options: Options, limits: Limits, check: bool, cluster: Cluster | None) -> Answer:
    """The answer, found in a worker process where it takes long or a limit is to hold."""

    def work(budgets: Budgets) -> Answer:
        budget = budgets()
        chosen = options.with_(progress=budget.listener)
        if cluster is None:
            return _answer(formula, chosen, budget, check)
        from qe.processes.cluster import helping

        with helping(cluster) as budget.helpers:
            return _answer(formula, chosen, budget, check)

    try:
        return performed(work, formula, limits, at_once=cluster is not None)
    except Unable as error:
        return Answer(Status.UNABLE, None, reason=str(error), question=formula)


def _partial(formula: Formula, options: Options, limits: Limits) -> Partial:
    """What can be said of the parts of a formula in the time that is left; at worst, nothing."""
    from qe.engine.anytime import partly

    left = None
    if limits.timeout is not None and limits.start is not None:
        left = max(0.0, limits.start + limits.timeout - time.monotonic()) * PARTS_SHARE
    budget = Budget(left)
    finding = budget.share(UNVERIFIED_SHARE) if options.certify else budget
    try:
        found = partly(formula, options, finding, Limits(memory=limits.memory, process=limits.process))
    except Unable:
        return Partial()
    if not options.certify:
        return found
    from qe.api.verify import judged
    from qe.certify.parts import claims_what_is_proved

    if found.proved_true == found.proved_false == FALSE:
        return replace(found, certificate=None, reason="nothing is decided")
    if found.certificate is not None and not claims_what_is_proved(found.certificate, budget):
        return replace(found, certificate=None, reason="the proofs of the parts do not give the parts as they stand")
    guarantee, reason = judged(found.certificate, budget)
    return replace(found, is_checked=guarantee is Guarantee.CHECKED, reason=reason)


def _raced(formula: Formula, options: Options, limits: Limits, check: bool, methods: Iterable[Method]) -> Answer:
    """The first answer that one of the methods has."""
    from qe.api.race import raced

    def asked(method: Method, budget: Budget) -> Answer:
        return _answer(formula, options.with_(method=method, progress=budget.listener), budget, check)

    try:
        return performed(lambda budgets: raced(asked, methods, budgets()), formula, limits, at_once=True)
    except Unable as error:
        return Answer(Status.UNABLE, None, reason=str(error), question=formula)


def _answer(formula: Formula, options: Options, budget: Budget, check: bool) -> Answer:
    """What the engine finds, which is loaded at the first call; verified where that is asked, or costs little.

    Where the answer is to be proved, it is kept before.
    """
    from qe.engine.run import answer_to, answered, proved

    try:
        known = answered(formula, options, budget)
        if options.certify:
            budget.keep(replace(answer_to(formula, known), certificate=None, reason=UNPROVED))
        found = proved(formula, known, options, budget)
    except Unable as error:
        log = RunLog()
        log.work("limits", {"work": budget.used})
        return Answer(Status.UNABLE, None, reason=str(error), question=formula, log=log)
    answer, certificate = answer_to(formula, found), found.certificate
    if certificate is not None and (check or certificate.kind == Kind.WITNESS or found.witness is not None):
        from qe.api.verify import with_verdict

        return with_verdict(answer, budget, checked=found.checked)
    return answer


def region(
    formula: AnyFormula,
    order: Order = None,
    *,
    format: str = "text",
    total_division: bool = False,
    timeout: float | None = None,
    memory: int | None = None,
    progress: Progress = silent,
    check: bool = False,
    process: bool = True,
) -> Region:
    """The solution set of a formula in its free variables (or in ``order``, which may name more).

    Without ``order`` a quantified formula is described in the order in which its answer was found by critical values:
    factors of that projection are part of the answer, and the other order may be much harder.
    A cylindrical description with a certificate; quantifiers are eliminated first. For a conjunction of convex
    quadratic conditions in four or more variables, or with existential quantifiers before it, membership, fibres
    and bounds are found by exact optimisation, and the description only on request. ``timeout`` (seconds) and
    ``memory`` (MB) hold here and then for every question that is asked of the region; see ``eliminate`` for them and
    for ``process``. With ``check`` the description is made at once (not where there are four or more variables and
    convex conditions) and verified, and ``Region.answer`` has the elimination of the quantifiers with its derivation;
    ``Region.guarantee`` and ``reason`` say what came of it, ``Region.proof`` is for others.
    Raises ``BudgetExceeded`` at a limit.
    """
    start = time.monotonic()
    from qe.regions.build import described

    whole, names = limits_of(timeout, memory, progress, process), arguments.names(order)
    limits = whole.begun(start)
    check = arguments.flag(check, "check")
    given = reading(formula, format, limits, total_division)

    def work(budgets: Budgets) -> Region:
        from qe.api.verify import with_guarantee

        budget = budgets()
        found = described(given, names, budget, whole, check=check)
        return with_guarantee(found, budget) if check else found

    return performed(work, given, limits)


def verify(
    certificate: Certificate,
    *,
    formula: AnyFormula = None,
    format: str = "text",
    timeout: float | None = VERIFY_SECONDS,
    core: bool = False,
) -> Verdict:
    """Whether separate code accepts the certificate, within ``timeout`` seconds (None: no limit); see ``qe.certify``.

    With ``formula``, also whether it is about that question, or its negation, up to the names of bound variables and
    the order of conjuncts and disjuncts; if not, it is rejected at ``claim``. With ``core``, a certificate that needs
    rules of the expert ring (``Certificate.trusts`` names them) is rejected at ``core``. Past the limit the verdict is
    neither accepted nor ``decided``. Raises ``InputError`` for what is no certificate, a formula that cannot be read
    and a limit that is not positive.
    """
    from qe.api.verify import verify as check
    from qe.io import formats

    chosen = formats.checked(format)
    asked = None if formula is None else read_formula(formula, chosen.value)
    arguments.flag(core, "core")
    return check(certificate, formula=asked, timeout=arguments.seconds(timeout), core=core)

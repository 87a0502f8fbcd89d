"""The public functions that list solutions: ``solve``, ``find``, ``witnesses``."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, Unpack

from qe import arguments
from qe.api.eliminate import decided, instance, region_of
from qe.api.input import AnyFormula, read_block, warned
from qe.api.limits import limits_of, performed, posed
from qe.api.settings import ProvedBlock, ProvedQuestion, with_settings
from qe.decomposition.extended_tarski import true_everywhere
from qe.decomposition.pieces import readable
from qe.engine.run import solve as eliminated
from qe.errors import InternalError, Unable
from qe.exact.number import Values
from qe.formula.build import conj, exists, forall, iff, implies
from qe.formula.counting import without_root_atoms
from qe.formula.normal import without_clashes
from qe.formula.syntax import TRUE, Exists, ForAll, Formula
from qe.io.substitution import over_one_ring
from qe.io.text import read, solved_for
from qe.options import Budget, Options
from qe.processes.limits import Limits
from qe.proof.answer import UNPROVED, Answer, Guarantee, Status
from qe.proof.certificate import Certificate
from qe.proof.run_log import RunLog
from qe.proving import certificates
from qe.regions.by_value import cases_by_value, effort
from qe.regions.linear_systems import regular_case
from qe.regions.solutions import Solutions
from qe.regions.walk import MOST_POINTS, different_points
from qe.spelling import NUMBERS

if TYPE_CHECKING:
    from qe.elimination.vs.parametric import ParametricWitnesses
    from qe.regions.region import Region

TEXT_WORK, TABLE_WORK = 20_000, 4_000
"""Units of work for the proof that a text of solutions says the same as the formula; for one from one decomposition."""


@with_settings(ProvedQuestion)
def solve(formula: AnyFormula, variables: Any = None, **settings: Unpack[ProvedQuestion]) -> Solutions:
    """All real solutions, case by case, as Mathematica's ``Reduce`` writes them (cylindrical decomposition).

    ``variables``: those to solve for, in their order; each is expressed in terms of the parameters and of the variables
    before it. Without them x, y, z (perhaps with an index) are meant, with a note; without these all free variables.
    Quantifiers are eliminated first. With ``check`` the decomposition and the text are proved: ``guarantee``.
    Raises ``InputError`` for what cannot be read, ``Unable`` (``BudgetExceeded`` at a limit) where elimination does.
    """
    asked = solved_for(formula) if variables is None and isinstance(formula, str) else variables
    limits, wanted = limits_of(settings), arguments.names(asked, "variables")
    whole = replace(limits, start=None)
    stated = posed(formula, settings, limits, solved=wanted or (), numbers=True)
    given = stated.restricted
    if wanted is None:
        wanted = _customary(given.free)
    order = None if wanted is None else (*(v for v in given.free if v not in wanted), *wanted)
    solved = len(given.free if wanted is None else wanted)
    work = partial(_solutions, given, stated.known, order, solved, whole, settings["check"])
    return performed(work, given, limits)


def _customary(names: tuple[str, ...]) -> tuple[str, ...] | None:
    """The variables that a formula is solved for when nobody says: x, y and z, in this order; None for all."""
    variables = tuple(name for name in names if name not in NUMBERS)
    unknown = tuple(name for name in variables if re.fullmatch("[xyz]_?[0-9]*'*", name))
    unknown = tuple(sorted(unknown, key=lambda name: (name[0], int(re.sub(r"\D", "", name) or 0), name)))
    if not unknown or len(unknown) == len(variables):
        variables = unknown or variables
        return None if variables == names else variables
    warned([f"solved for {', '.join(unknown)}; variables= or --variables says otherwise"])
    return unknown


def _solutions(
    given: Formula,
    known: Formula,
    order: tuple[str, ...] | None,
    solved: int,
    whole: Limits,
    check: bool,
    budget: Budget,
) -> Solutions:
    region = region_of(given, order, replace(whole, process=False), check, budget)
    cases = tuple(region.cells)
    lines = [str(case) for case in cases]
    names = region.order[len(region.order) - solved :]
    for listed in (
        _by_value(region, solved, known, budget),
        _by_determinant(given, known, region.order, solved, whole, budget),
    ):
        if listed is not None and effort(listed, names) <= effort(lines, names):
            lines = listed
    region.limits = whole
    solutions = Solutions(region.order, cases, region, tuple(readable(line, region.order) for line in lines))
    return replace(solutions, answer=_compared(solutions, given, known, budget)) if check else solutions


def _by_determinant(
    given: Formula, known: Formula, order: tuple[str, ...], solved: int, whole: Limits, budget: Budget
) -> list[str] | None:
    """The cases of a square linear system, those where its determinant is zero by value; None for another formula."""
    regular = regular_case(given, order[len(order) - solved :])
    if regular is None:
        return None
    line, singular = regular
    region = region_of(singular, tuple(order), replace(whole, process=False), False, budget)
    cases = _by_value(region, solved, known, budget)
    return None if cases is None else [line, *(case for case in cases if case != "false")]


def _by_value(region: Region, solved: int, known: Formula, budget: Budget) -> list[str] | None:
    """The cases by value as texts; None where there are too many cells."""
    cases = cases_by_value(region.table, len(region.order) - solved, budget, known)
    return None if cases is None else [line for case in cases for line in case.lines]


def _compared(solutions: Solutions, given: Formula, known: Formula, budget: Budget) -> Answer:
    """The answer to the question whether the text says the same as the formula, from one decomposition if that does."""
    from qe.api.verify import with_verdict

    written, question, assumed = over_one_ring(read(str(solutions), known=solutions.order), given, known)
    claim = implies(assumed, iff(written, question))
    sentence = forall(claim.free, claim)
    try:
        if solutions.region.answer is None and claim.is_quantifier_free:  # the table is of this very formula
            order = tuple(name for name in solutions.order if name in claim.free)
            make = partial(true_everywhere, claim, order, budget.part(TABLE_WORK))
            table = certificates.without_loss(lambda: Certificate.cells(make()), lambda reason: None)
            answer = Answer(Status.SOLVED, TRUE, certificate=table, question=sentence)
            answer = answer if table is None else with_verdict(answer, budget)
            if answer.guarantee is Guarantee.CHECKED:
                return answer
        answer = decided(sentence, Options(certify=True), budget.part(TEXT_WORK))
    except Unable as error:
        budget.check("compare the text")
        return Answer(Status.UNABLE, None, question=claim, reason=str(error))
    if answer.truth is False:
        raise InternalError(f"the text says something else than the formula: {solutions}")
    return answer


reduce = solve
"""The older name of ``solve``."""


@with_settings(ProvedQuestion)
def find(formula: AnyFormula, n: int = 1, *, seed: int = 0, **settings: Unpack[ProvedQuestion]) -> list[Values]:
    """Up to ``n`` different exact points that satisfy the formula; fewer only where there are no more.

    One point is found by deciding that there is one, several by a description of the solution set. With ``check`` that
    has a certificate that the checker has accepted, and each point is tried in the formula, or ``Unable`` is raised.
    """
    count, start = arguments.whole(n, "n", MOST_POINTS), arguments.integers([seed], "seed")[0]
    limits = limits_of(settings)
    given = posed(formula, settings, limits).restricted
    work = partial(_found, given, count, start, settings["check"], replace(limits, start=None, process=False))
    return performed(work, given, limits)


find_instances = find
"""The older name of ``find``."""


def _found(given: Formula, count: int, seed: int, check: bool, inner: Limits, budget: Budget) -> list[Values]:
    if count != 1 or seed:
        region = region_of(given, None, inner, check, budget)
        if check and region.guarantee is not Guarantee.CHECKED:
            raise Unable(f"the points are not proved: {region.reason}")
        return different_points(region, count, seed, budget)
    answer = decided(exists(given.free, given), Options(certify=check), budget)
    if (point := instance(answer, given)) is None:
        return []
    if check and answer.guarantee is not Guarantee.CHECKED:
        raise Unable(f"the point is not proved: {answer.reason}")
    return [point]


@with_settings(ProvedBlock)
def parametric_witnesses(formula: AnyFormula, **settings: Unpack[ProvedBlock]) -> ParametricWitnesses:
    """Solutions of the outermost block as terms in the free variables, each under its guard (extended answers).

    The guards together are equivalent to an existential block; for a universal block the terms are counterexamples.
    ``answer`` of the tuple says so as an ``Answer``; with ``check`` it has a certificate, whose steps put the terms in.
    Raises ``InputError`` for a formula without an outermost block, ``Unable`` where substitution does not apply.
    """
    limits = limits_of(settings)
    stated = posed(formula, settings, limits, reader=read_block)
    given = stated.formula
    if isinstance(given, Exists | ForAll) and stated.known != TRUE:
        body = conj((stated.known, given.body)) if isinstance(given, Exists) else implies(stated.known, given.body)
        given = replace(given, body=body)
    found = performed(partial(_witnesses, given, settings["check"]), given, limits)
    return found.under(stated.known)


witnesses = parametric_witnesses
"""The short name of ``parametric_witnesses``."""


def _witnesses(given: Formula, check: bool, budget: Budget) -> ParametricWitnesses:
    from qe.api.verify import with_verdict
    from qe.elimination.vs.parametric import parametric_witnesses as find

    log, options = RunLog(), Options(certify=check)
    listed = find(_outermost_block(given, log, options, budget), budget=budget, log=log)
    formula = listed.equivalent_to(given)
    answer = Answer(Status.SOLVED, formula, question=given, log=log, reason=certificates.NOT_WANTED)
    if check:
        budget.keep(listed.with_(replace(answer, reason=UNPROVED)))
        proof = certificates.derived(given, log, formula, options, budget)
        answer = replace(answer, certificate=proof.certificate, unchecked_steps=proof.unchecked, reason=proof.reason)
        if proof.certificate is not None:
            answer = with_verdict(answer, budget, checked=proof.checked)
    return listed.with_(answer)


def _outermost_block(given: Formula, log: RunLog, options: Options, budget: Budget) -> Formula:
    """The formula with nothing quantified inside its outermost block; the steps go to the log."""
    clear = log.step("renaming", given, without_clashes(given))
    block = log.step("roots counted", clear, without_root_atoms(clear))
    if isinstance(block, Exists | ForAll) and not block.body.is_quantifier_free:
        # what is left may well be a constant
        inner = eliminated(block.body, options.with_(certify=False), budget)
        log.entries += inner.log.entries
        block = replace(block, body=inner.formula)
    return block

"""Answers under assumptions: right wherever these hold, without what they say, and as short as they allow.

The question is put once with the assumptions, which the methods use like any other condition, and once without them,
where that is not much more work; of the two answers, each shortened under the assumptions, the shorter one is taken.
Every step stands at the place of the question in ``A implies question`` (``qe.formula.assumed``), where A is known.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from qe.decomposition.formulas import Undistinguished
from qe.elimination.protocol import Context, Known, Outcome
from qe.engine.redundant import is_cheap_sentence, without_redundant_parts
from qe.engine.run import answered, outcome_for
from qe.engine.strategy import allows
from qe.errors import Unable
from qe.formula.assumed import claimed, restricted
from qe.formula.build import atom, conj, convert, exists
from qe.formula.features import is_small, length
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Constant, ForAll, Formula, Relation
from qe.formula.traverse import atoms, has_root_atoms
from qe.options import Budget, Method, Options, Stage
from qe.proof.run_log import RunLog
from qe.proof.step import Nested, Step
from qe.simplifier.simplify import simplify

CONSISTENT_WORK, SHORT_WORK = 5_000, 3_000
"""Units of work for the question whether the assumptions, or exceptions, can hold, and for a decomposition."""

PLAIN_WORK = 3_000
"""Units of work, with twice that of the question under the assumptions, for the question without them."""

ROUNDS = 4
"""How often all ways to a shorter answer are tried."""

MOST_GENERIC = 12
"""So many inequations are assumed at most."""


def answered_assuming(
    question: Formula, known: Formula, options: Options, budget: Budget, *, generic: bool = False
) -> Known:
    """The answer to a question where ``known``, quantifier-free and over the same ring, holds. With ``generic`` also
    leading coefficients, polynomials in the parameters, are assumed not to be zero.

    Raises ``Unable`` where no method ends.
    """
    nothing = _refuted(known, options.with_(method=Method.AUTO), budget)
    if nothing is not None:
        return Known(question, _whatever(question, known, nothing), known)
    if not question.free:
        return Known(question, answered(question, options, budget), known)
    if not generic:
        return Known(question, _shorter(question, known, options, budget), known)
    supposed = _together((), _leading(question), known, options, budget)
    outcome = _shorter(question, conj((known, *supposed)), options, budget)
    more = _together(supposed, _by_cases(outcome.formula), known, options, budget)
    if more != supposed:
        supposed = more
        outcome = _shorter(question, conj((known, *supposed)), options, budget)
    needed = _needed(question, known, supposed, outcome.formula, options, budget)
    if needed != supposed:
        again = _shorter(question, conj((known, *needed)), options, budget)
        if length(again.formula) <= length(outcome.formula):
            outcome, supposed = again, needed
    return Known(question, outcome, conj((known, *supposed)), supposed)


def simplified(question: Formula, known: Formula, options: Options, budget: Budget) -> Known:
    """A formula that is not longer, equivalent where ``known`` holds; with the quantifiers of the question."""
    log = RunLog()
    simple = simplify(question, known, watch=budget.check)
    if question.is_quantifier_free and not has_root_atoms(question):
        made = answered_assuming(question, known, options, budget)
        if length(made.outcome.formula) <= length(simple):
            return made
    return Known(question, Outcome(log.step("simplification", question, simple, context=known), log=log), known)


def can_hold(known: Formula, options: Options, budget: Budget) -> bool:
    """Whether the assumptions hold somewhere; True also where that takes too much work to tell."""
    return _refuted(known, options.with_(method=Method.AUTO), budget) is None


def _refuted(known: Formula, options: Options, budget: Budget) -> Nested | None:
    """How it follows that a formula holds nowhere; None where it does somewhere, or little work does not tell."""
    sentence = exists(known.free, known)
    try:
        outcome = outcome_for(sentence, options, budget.part(CONSISTENT_WORK))
    except Unable:
        budget.check("assumptions")
        return None
    return outcome.nested(sentence) if outcome.formula == FALSE else None


def _whatever(question: Formula, known: Formula, refuted: Nested) -> Outcome:
    """TRUE where the assumptions hold nowhere."""
    log, evidence = RunLog(), {"proof": {"exceptions": [refuted]}}
    if isinstance(question, ForAll):
        log.step("constant", known, FALSE, evidence=evidence)
        log.step("constant", FALSE, known, evidence=evidence)
    else:
        log.step("constant", nnf(known, negate=True), TRUE, evidence=evidence)
    return Outcome(TRUE, log=log)


def _shorter(question: Formula, known: Formula, options: Options, budget: Budget) -> Outcome:
    """The shorter one of the answers to the question with the assumptions and without them, both shortened."""
    start, best, refused = budget.used, None, Unable("no method ended")
    for joined in (True, False) if known != TRUE else (False,):
        if best is not None and length(best.formula) <= (1, 1):
            break
        part = budget if best is None else budget.part(PLAIN_WORK + 2 * (budget.used - start))
        log = RunLog()
        try:
            both = _joined(question, known, log) if joined else question
            outcome = answered(both, options, part)
            log.entries += outcome.log.entries
            context = Context(options, budget, log, outcome_for)
            formula = shortened_under(outcome.formula, known, question, context)
        except Unable as error:
            budget.check("assumptions")
            refused = error
            continue
        if set(formula.free) - set(question.free):  # the assumptions alone speak of these
            continue
        log.seconds = outcome.log.seconds
        if best is None or length(formula) < length(best.formula):
            best = Outcome(formula, log=log)
    if best is None:
        raise refused
    return best


def _joined(question: Formula, known: Formula, log: RunLog) -> Formula:
    """The question with the assumptions; the step back is propositional, and so the step is its converse."""
    both = restricted(known, question)
    back = Nested(both, (Step("simplification", both, question, known),), question)
    return log.step("converse", question, both, context=known, evidence={"proof": {"steps": back}})


# --- shorter under assumptions ---------------------------------------------------------------------------
def shortened_under(formula: Formula, known: Formula, question: Formula, context: Context) -> Formula:
    """A shorter equivalent, where ``known`` holds, of a quantifier-free answer to a question, as far as one is seen."""
    formula = convert(formula, ring) if (ring := known.ring) is not None else formula
    for _ in range(ROUNDS):
        before = formula
        simple = simplify(formula, known, watch=context.budget.check)
        formula = context.log.step("simplification", formula, simple, context=known)
        if has_root_atoms(formula) or Stage.SHORTENING in context.options.without:
            return formula
        for rule in (_constant, _without_parts, _read_off_cells):
            mark = context.log.mark()
            try:
                formula = formula if isinstance(formula, Constant) else rule(formula, known, question, context)
            except (Unable, Undistinguished):
                context.budget.check("shorten")
                context.log.forget_steps(mark)
        if length(formula) >= length(before):
            break
    return formula


def _constant(formula: Formula, known: Formula, question: Formula, context: Context) -> Formula:
    """TRUE or FALSE where the assumptions leave nothing else."""
    for value in (TRUE, FALSE):
        wrong = conj((known, nnf(formula, negate=value == TRUE)))
        cheap = is_cheap_sentence(exists(wrong.free, wrong))
        if cheap and (nothing := _refuted(wrong, context.options, context.budget)):
            evidence = {"proof": {"exceptions": [nothing]}}
            return context.log.step("constant", formula, value, context=known, evidence=evidence)
    return formula


def _without_parts(formula: Formula, known: Formula, question: Formula, context: Context) -> Formula:
    return without_redundant_parts(formula, context, known=known)


def _read_off_cells(formula: Formula, known: Formula, question: Formula, context: Context) -> Formula:
    """A shorter form that is right on the cells of a decomposition on which the assumptions hold."""
    if not allows(context.options, Method.CAD) or not is_small(conj((known, formula))):
        return formula
    from qe.elimination.cad import short_where

    shorter = short_where(formula, known, context.options, context.budget.part(SHORT_WORK))
    if length(shorter) >= length(formula):
        return formula
    context.log.step("shorter", claimed(known, question, formula), claimed(known, question, shorter))
    return shorter


# --- generic answers -------------------------------------------------------------------------------------
def _together(
    supposed: tuple[Formula, ...], new: Iterable[Formula], known: Formula, options: Options, budget: Budget
) -> tuple[Formula, ...]:
    """Those inequations, and of the new ones those that say something more and can hold together with them."""
    for one in new:
        before = conj((known, *supposed))
        if (
            len(supposed) < MOST_GENERIC
            and simplify(one, before) != TRUE
            and can_hold(conj((before, one)), options, budget)
        ):
            supposed = (*supposed, one)
    return supposed


def _leading(question: Formula) -> tuple[Formula, ...]:
    """That the factors of leading coefficients in a bound variable, polynomials in free ones, are not zero."""
    names, leading = set(question.free), dict[Formula, None]()
    for poly, i in ((a.poly, i) for a in atoms(question) for i in a.poly.variables):
        lead = poly.coefficients(i)[-1]
        if poly.ring.names[i] not in names and names.issuperset(poly.ring.names[j] for j in lead.variables):
            leading |= {atom(factor, Relation.NE): None for factor, _ in lead.factors()[1]}
    return tuple(leading)


def _by_cases(formula: Formula) -> tuple[Formula, ...]:
    """That polynomials are not zero for which an answer has both cases."""
    by_relation = {r: {a.poly for a in atoms(formula) if a.relation is r} for r in (Relation.EQ, Relation.NE)}
    both = by_relation[Relation.EQ] & by_relation[Relation.NE]
    return tuple(atom(poly, Relation.NE) for poly in sorted(both, key=str))


def _needed(
    question: Formula, known: Formula, supposed: Sequence[Formula], formula: Formula, options: Options, budget: Budget
) -> tuple[Formula, ...]:
    """The inequations without some of which the answer would be wrong, as far as little work shows; first those are
    dropped that have no part in the answer."""
    ring = question.ring
    try:
        plain = answered(question, options, budget.part(PLAIN_WORK)).formula
        plain = plain if ring is None else convert(plain, ring)
    except Unable:
        budget.check("generic")
        return tuple(supposed)
    kept = list(supposed)
    for one in supposed:
        rest = conj((known, *(n for n in kept if n != one)))
        differs = [conj((rest, a, nnf(b, negate=True))) for a, b in ((plain, formula), (formula, plain))]
        if not any(can_hold(where, options, budget) for where in differs):
            kept.remove(one)
    return tuple(kept)

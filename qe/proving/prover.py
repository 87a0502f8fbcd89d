"""From the derivation of an answer to a certificate: evidence for every step, as far as it can be had.

Nothing here is trusted: a step counts as proved when the checker of its rule accepts it, and is named otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TypeVar

from qe.certify.registry import RULES
from qe.elimination.cad import certificate_for
from qe.elimination.vs.trace import Eliminated
from qe.errors import CertificateRejected, Contradiction, InternalError, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj
from qe.formula.syntax import FALSE, TRUE, And, Exists, Formula, Or
from qe.formula.traverse import clashes, conjuncts, polynomials, subformula
from qe.kernel.block import block_goals, existential
from qe.kernel.boolean import ByLemmas
from qe.kernel.derivation import check_derivation, limits_of, replaced
from qe.kernel.renaming import is_same
from qe.kernel.step import Check, Claim, Context, Limits, check_names
from qe.kernel.verdict import CRASHES
from qe.options import Budget, Options
from qe.proof.certificate import Certificate, Proof, written
from qe.proof.derivation import Derivation, moved, put_together
from qe.proof.entry import Entry, Json, formula_to_json, poly_to_text
from qe.proof.on_demand import completed
from qe.proof.run_log import RunLog
from qe.proof.step import Nested, Place, Step
from qe.proving.elaborators import ELABORATORS
from qe.proving.lemma_list import EMPTY, identities, with_cases
from qe.proving.lemmas import refuting
from qe.proving.made import places
from qe.proving.nested import derivations_within, names_within, proved_inside
from qe.proving.primitive_names import PRIMITIVE_OF, PROJECTION, QUANTIFIERS, SIGNS, STEPS, THEOREM
from qe.proving.remembering import Accepted, remembering, step_key
from qe.proving.simplified import Simplified
from qe.proving.substitution_steps import steps

T = TypeVar("T")
Shown = tuple[str, Json]
"""The rule by whose checker a step is accepted, and the evidence."""
TABLE_WORK, TABLE_SHARE = 3_000, 0.25
"""Units of work for a decomposition that proves a single step, and the share of the time left that it may take."""

IDEAL = "Groebner basis of the equations"

SIMPLIFYING = (
    "simplification",
    "standard simplification",
    IDEAL,
    "multiple of an equation subtracted",
)
"""Rules whose steps go on under quantifiers."""

CRITICAL = "critical values"
SEARCH, IDENTITIES = "Boolean search", ("signs by sums of squares", "branch and bound")
REDUNDANT = "redundant part"
UNRECORDED = "steps that are not recorded"


def proved(derivation: Derivation, answer: Formula, options: Options, budget: Budget) -> Proof:
    """The derivation with evidence. Steps without any of their own are proved by a decomposition, if it is small.

    Raises ``BudgetExceeded``, and ``InternalError`` where accepted steps do not fit together, which would be a bug.
    """
    derivation = replace(derivation, steps=tuple(completed(step, budget) for step in derivation.steps))
    formulas = (derivation.start, *(step.before for step in derivation.steps), answer)
    ring = next((f.ring for f in formulas if f.ring is not None), Ring.of(()))
    names = dict.fromkeys((*ring.names, *(n for step in derivation.steps for n in names_within(step))))
    prover = Prover(Ring.of(names), options, budget)
    start, goal = moved(derivation.start, prover.ring), moved(answer, prover.ring)
    prover.whole(derivation, start, goal)
    unchecked = tuple(dict.fromkeys(prover.unchecked))
    if unchecked:
        return Proof(None, unchecked)
    certificate = Certificate.derivation(prover.ring.names, start, prover.steps, goal)
    assert isinstance(certificate.payload, dict)
    try:
        check_derivation(certificate.payload, budget, remembering(RULES, prover.accepted))
    except CertificateRejected as error:
        raise InternalError(f"the certificate of an answer was rejected at {error.step}: {error.reason}") from error
    return Proof(certificate, checked=True)


@dataclass(slots=True)
class Prover:
    """The steps written so far, and the rules of those that no checker accepts.

    ``tables``: whether decompositions may help; ``known``: what holds wherever the whole formula matters; ``accepted``:
    what need not be checked again; ``only_ordering``: the numbers of steps after which a part is the same in another
    order, the last one first.
    """

    ring: Ring
    options: Options
    budget: Budget
    tables: bool = True
    known: Context = ()
    accepted: Accepted = field(default_factory=set)
    steps: list[Json] = field(default_factory=list)
    unchecked: list[str] = field(default_factory=list)
    only_ordering: list[int] = field(default_factory=list)
    limits: Limits = field(init=False)

    def __post_init__(self) -> None:
        self.limits = limits_of(self.budget, remembering(RULES, self.accepted))

    # --- steps ---------------------------------------------------------------------------------
    def whole(self, derivation: Derivation, start: Formula, goal: Formula) -> None:
        """All steps of a derivation from ``start`` to ``goal``, and between these and its own ends."""
        current = moved(derivation.start, self.ring)
        if start != current:
            self.joined(start, current)
        for step in derivation.steps:
            before, after, known = (moved(f, self.ring) for f in (step.before, step.after, step.context))
            current = self.taken(replace(step, before=before, after=after, context=known), current)
        if current != goal:
            self.joined(current, goal)

    def nested(self, inner: Nested, start: Formula, known: Context) -> tuple[Formula, list[Json]]:
        """The answer of a derivation inside the evidence of a step, and its steps from ``start`` on.

        Raises ``CertificateRejected`` where one of them has no accepted evidence.
        """
        prover = Prover(self.ring, self.options, self.budget, self.tables, known, self.accepted)
        goal = moved(inner.answer, self.ring)
        prover.whole(put_together(inner.start, inner.steps, inner.answer, self.ring), start, goal)
        if prover.unchecked:
            raise CertificateRejected("parts", f"no evidence for: {', '.join(prover.unchecked)}")
        return goal, prover.steps

    def taken(self, step: Step, current: Formula) -> Formula:
        """The formula after a step at each of its places, one after the other."""
        for _ in step.places:
            found = next(places(current, step.before), None)
            if found is None:
                break
            current = self._at(found, step, current)
        return current

    def _at(self, place: Place, step: Step, current: Formula) -> Formula:
        if step.rule == REDUNDANT:
            try:
                place, step = _part_dropped(place, step, current)
            except IndexError:  # there is no such part
                self.unchecked.append(step.rule)
                return step.after
        facts, changed = replaced(current, place, step.before, step.after, self.known, Entry(None, "place"))
        context = tuple(f for f in conjuncts(step.context) if f in facts)
        if clashes(changed, (name for fact in self.known for name in fact.free)):  # no checker would look at it
            self.unchecked.append(step.rule)
            return changed
        found = self.own(step, context)
        simplifying = found is None and step.rule in SIMPLIFYING
        if simplifying and self._simplified_inside(place, step, context, current) == changed:
            return changed
        if found is None and step.rule != PROJECTION:
            found = self._tabulated(step)
        if found is None:
            self.unchecked.append(step.rule)
        else:
            rule, evidence = found
            if is_same(step.before, step.after):
                self.only_ordering.insert(0, len(self.steps))
            self.steps.append(written(rule, place, step.before, step.after, context, evidence))
        return changed

    def _simplified_inside(self, place: Place, step: Step, context: Context, current: Formula) -> Formula | None:
        """The formula after a simplification, as a step for each place inside; None where no evidence is found, as for
        all of it at once under the context."""

        def evidence(before: Formula, after: Formula, used: Context) -> tuple[str, Json] | None:
            return self.own(Step("simplification", before, after), used)

        failed = {(step.before, step.after, context)}
        return Simplified(evidence, self.known, self.steps, failed).inside(place, step.before, step.after, current)

    def joined(self, current: Formula, goal: Formula) -> None:
        """The last formula of the derivation and the answer, where steps between them are missing."""
        found = self.evidence(Step("simplification", current, goal), ())
        if found is None:
            self.unchecked.append(UNRECORDED)
        else:
            self.steps.append(written(found[0], (), current, goal, (), found[1]))

    # --- evidence ------------------------------------------------------------------------------
    def evidence(self, step: Step, context: Context) -> Shown | None:
        """The rule by whose checker the step is accepted, and the evidence."""
        return self.own(step, context) or self._tabulated(step)

    def own(self, step: Step, context: Context) -> Shown | None:
        """As ``evidence``, without decompositions that nobody has made yet."""
        trace = step.evidence.get("trace")
        if isinstance(trace, Eliminated) and (shown := self._substituted(step, trace)) is not None:
            return shown
        if step.rule == CRITICAL:
            return self._critical(step)
        if isinstance(trace, RunLog):
            return self._replayed(step, trace)
        given = step.evidence.get("proof")
        if isinstance(given, Mapping) and isinstance(made := given.get("certificate"), Certificate):
            return self._by_method(step, context, made)
        if step.rule in IDENTITIES:
            return self._positive(step, given, context)
        evidence = {name: self._json(part) for name, part in given.items()} if isinstance(given, Mapping) else {}
        if step.rule == SEARCH:
            return self._searched(step, evidence)
        if step.rule in ELABORATORS:
            elaborated = self._elaborated(step, context, evidence)
            if elaborated is not None or step.rule not in RULES:
                return elaborated
        if step.rule in SIMPLIFYING and not step.before.is_quantifier_free:
            before, after = (len({*polynomials(f)}) for f in (step.before, step.after))
            if before == after and (moved_only := self._named(QUANTIFIERS, step, (), {})) is not None:
                return moved_only
        rule = PRIMITIVE_OF.get(step.rule, THEOREM if "theorem" in evidence else step.rule)
        return self._named(rule, step, context, evidence)

    def _by_method(self, step: Step, context: Context, made: Certificate) -> Shown | None:
        """The one step of a certificate that a method made of this very step."""
        rule, evidence = str(made.single_step["rule"]), made.single_step["evidence"]
        assert isinstance(evidence, dict)
        if RULES.get(step.rule) is RULES[rule]:
            rule = step.rule  # which says more
        return self._named(rule, step, context, evidence)

    def _named(self, rule: str, step: Step, context: Context, evidence: dict[str, Json]) -> Shown | None:
        """A rule, and the evidence for it with its derivations and lemmas, accepted."""
        return self._found(lambda: self._completed(rule, step, context, evidence))

    def _completed(self, rule: str, step: Step, context: Context, evidence: dict[str, Json]) -> Shown | None:
        if (checker := RULES.get(rule)) is None:
            return None
        check_names(self._claim(rule, step, evidence), context)
        if any(derivations_within(evidence)):
            given = self._claim(rule, step, evidence)
            inside = proved_inside(lambda limits: _checked(checker, given, context, limits), self.limits, self.nested)
            assert isinstance(inside, dict)  # the checker has read it
            evidence = inside
        if isinstance(checker, ByLemmas):
            evidence = {**evidence, "theory": EMPTY}
            goals = checker.obligations(self._claim(rule, step, evidence), context)
            ideal = step.rule == IDEAL
            theory = refuting(goals, self.ring, self.limits, ideal) if goals else EMPTY
            if theory is None:
                return None
            evidence = {**evidence, "theory": theory}
        self._check(self._claim(rule, step, evidence), context)
        return rule, evidence

    def _elaborated(self, step: Step, context: Context, evidence: Json) -> Shown | None:
        """Steps of the kernel that make a step of another rule."""
        try:
            claim, elaborator = self._claim(step.rule, step, evidence), ELABORATORS[step.rule]
            made = proved_inside(lambda limits: elaborator(claim, context, limits), self.limits, self.nested)
        except Contradiction:
            raise
        except (CertificateRejected, *CRASHES):  # what evidence an elaborator cannot read proves nothing
            return None
        except Unable:
            self.budget.check("prove")
            return None
        return self._named(STEPS, step, context, {"steps": made})

    def _found(self, search: Callable[[], T]) -> T | None:
        """What a search for evidence gives; None where there is none, or it is out of reach."""
        try:
            return search()
        except CertificateRejected:
            return None
        except Unable:
            self.budget.check("prove")
            return None

    def _positive(self, step: Step, given: object, context: Context) -> Shown | None:
        """Signs that follow from identities, which the rule has found, perhaps with the clauses by which they do."""
        assert isinstance(given, Mapping)
        lemmas = identities(given["identities"], self.ring, given.get("clauses", ()))
        claim = self._claim(SIGNS, step, {"theory": lemmas})

        def theory_of() -> Json:
            if "clauses" not in given:
                return with_cases(lemmas, block_goals(claim, context), self.ring, self.limits)
            self._check(claim, context)
            return lemmas

        theory = self._found(theory_of)
        return None if theory is None else (SIGNS, {"theory": theory})

    def _substituted(self, step: Step, trace: Eliminated) -> Shown | None:
        """The steps of virtual substitution, all of them accepted."""
        claim = self._claim("virtual substitution", step, {})
        before, after = existential(claim)

        def evidence() -> Shown | None:
            if not isinstance(before, Exists):
                return None
            made: Json = {"steps": steps(before, trace, after, self.ring, self._simplified, self.limits)}
            self._check(self._claim(claim.rule, step, made), ())
            return claim.rule, made

        return self._found(evidence)

    def _critical(self, step: Step) -> Shown | None:
        """The evidence for a step by critical values, accepted."""
        from qe.proving.critical import critical_evidence

        order, claim = step.evidence.get("order"), self._claim(step.rule, step, {})
        if not isinstance(order, tuple):
            return None
        evidence = self._found(lambda: critical_evidence(claim, order, self.options, self.budget))
        return None if evidence is None else self._named(step.rule, step, (), evidence)

    def _replayed(self, step: Step, log: RunLog) -> Shown | None:
        """The steps of which one step is made, all of them accepted."""
        inner = Prover(self.ring, self.options, self.budget, self.tables, (), self.accepted)
        current = step.before
        for part in log.steps():
            before, after, context = (moved(f, self.ring) for f in (part.before, part.after, part.context))
            step_at = Step(part.rule, before, after, context, part.evidence, tuple(places(current, before)))
            current = inner.taken(step_at, current)
        if current != step.after:
            inner.joined(current, step.after)
        shown = None if inner.unchecked else self._named(step.rule, step, (), {"steps": inner.steps})
        for k in inner.only_ordering if shown else ():
            rest: list[Json] = [*inner.steps[:k], *inner.steps[k + 1 :]]
            if fewer := self._named(step.rule, step, (), {"steps": rest}):
                shown, inner.steps = fewer, rest
        return shown

    def _searched(self, step: Step, evidence: dict[str, Json]) -> Shown | None:
        """The evidence for a refutation by a Boolean search, with the clauses that lead to a contradiction."""
        from qe.proving.search import with_clauses

        def completed() -> Shown:
            claim = self._claim(SIGNS, step, with_clauses(self._claim(step.rule, step, evidence), self.limits))
            found = proved_inside(lambda limits: _checked(RULES[SIGNS], claim, (), limits), self.limits, self.nested)
            self._check(replace(claim, evidence=Entry(found, "evidence")), ())
            return SIGNS, found

        return self._found(completed)

    def _simplified(self, before: Formula, after: Formula) -> Json:
        """A step of simplification inside another one; ``CertificateRejected`` where it is not proved."""
        shown = self._named(SIGNS, Step("simplification", before, after), (), {})
        if shown is None:
            raise CertificateRejected(SIGNS, "no lemmas found")
        return written(SIGNS, (), before, after, (), shown[1])

    def _check(self, claim: Claim, context: Context) -> None:
        """Returns where the step is accepted; raises as its checker does."""
        RULES[claim.rule](claim, context, self.limits)
        self.accepted.add(step_key(claim, context))

    def _claim(self, rule: str, step: Step, evidence: Json) -> Claim:
        return Claim(rule, step.before, step.after, self.ring, Entry(evidence, "evidence"), "step")

    def _tabulated(self, step: Step) -> Shown | None:
        """A decomposition that proves the step."""
        known = set(step.before.free)
        if not self.tables or not step.after.is_quantifier_free or not known >= set(step.after.free):
            return None
        budget = self.budget.share(TABLE_SHARE).part(TABLE_WORK)
        certificate = self._found(lambda: certificate_for(step.before, step.after, self.options, budget))
        return None if certificate is None else self._by_method(step, (), certificate)

    def _json(self, value: object) -> Json:
        """Evidence from the log as JSON data over the ring of the derivation."""
        match value:
            case Poly():
                return poly_to_text(value.convert(self.ring).normal()[1])
            case Fraction():
                return str(value)
            case (str() as name, Poly() as equation, int() | None as sign):
                flips = equation.convert(self.ring).normal()[0] < 0
                return [name, self._json(equation), -sign if flips and sign else sign]
            case list() | tuple():
                return [self._json(v) for v in value]
            case Mapping():
                return {name: self._json(part) for name, part in value.items()}
            case Nested():
                return value  # type: ignore[return-value]  # becomes a list of steps when they are proved
            case _ if isinstance(value, Formula):
                return formula_to_json(moved(value, self.ring), quantified=True)
            case None | bool() | int() | str():
                return value
        raise TypeError(f"no evidence: {type(value).__name__}")


def _checked(checker: Check, claim: Claim, context: Context, limits: Limits) -> Json:
    """The evidence of a claim that its checker accepts."""
    checker(claim, context, limits)
    return claim.evidence.value


def _part_dropped(place: Place, step: Step, current: Formula) -> tuple[Place, Step]:
    """A part that makes no difference turned into a constant, at its own place, under what stands next to it there."""
    proof = step.evidence["proof"]
    assert isinstance(proof, Mapping)
    at = tuple(proof["at"])
    parent = subformula(step.before, at[:-1])
    part, constant = subformula(parent, at[-1:]), FALSE if isinstance(parent, Or) else TRUE
    beside, _ = replaced(step.before, at, part, constant, (), Entry(None, "place"))
    evidence = {"proof": {"exceptions": [proof["steps"]]}}
    context = conj((*beside, step.context))
    whole = subformula(current, place)
    if whole != step.before:  # which is a part of it
        assert isinstance(whole, And | Or)
        at = (whole.args.index(subformula(step.before, at[:1])), *at[1:])
    return (*place, *at), replace(step, before=part, after=constant, context=context, evidence=evidence)

"""Simplifications that go on inside a formula: a step for each place, where one step for all of them is out of reach.

What the simplifier has done is done again, a part after the other under what stands beside it, each as a step; what
another rule has done to quantified parts is read off the formula before and after. Nothing here is trusted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from qe.errors import CertificateRejected
from qe.formula.build import conj, disj, exists, forall
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, ForAll, Formula, Or
from qe.formula.traverse import children, polynomials, subformula
from qe.kernel.derivation import replaced
from qe.kernel.step import Context
from qe.proof.certificate import written
from qe.proof.entry import Entry, Json
from qe.proof.step import Place
from qe.simplifier.simplify import simplify

Evidence = Callable[[Formula, Formula, Context], tuple[str, Json] | None]
"""A rule by whose checker two formulas have the same truth under a context, and the evidence that it accepts."""

MOST_FAILED, MOST_ALIKE = 60, 2
"""Steps tried in vain for one simplification, and quantified parts that one of them may have become, at most."""


@dataclass(slots=True)
class Simplified:
    """``known``: what holds around the whole formula; ``steps``: those written so far; ``failed``: what need not be
    tried again."""

    evidence: Evidence
    known: Context
    steps: list[Json]
    failed: set[tuple[Formula, Formula, Context]] = field(default_factory=set)

    def inside(self, place: Place, before: Formula, after: Formula, current: Formula) -> Formula | None:
        """The whole formula ``current`` with ``after`` for ``before`` at a place, each step with evidence.

        None, and no step written, where none is found.
        """
        if before == after:
            return current
        mark = len(self.steps)
        try:
            changed = self._at_once(place, before, after, current) or self._parted(place, before, after, current)
        except CertificateRejected:  # the step is about a part of what stands there
            changed = None
        if changed is None:
            del self.steps[mark:]
        return changed

    def _parted(self, place: Place, before: Formula, after: Formula, current: Formula) -> Formula | None:
        """As ``inside``, where all of it in one step has been tried: for a block that is as much as for its body.

        Either the parts become simpler as far as they do, and the rest at once; or, where this is no step of the
        simplifier alone, what is quantified becomes what is quantified there.
        """
        facts, _ = self._replaced(place, before, after, current)
        if simplify(before, conj(facts)) != after:
            if isinstance(before, Exists | ForAll):
                return self._under(place, before, after, current)
            if not before.is_quantifier_free and isinstance(before, And | Or):
                return self._quantified(place, before, after, current)
        simpler, changed = self._by_parts(place, before, current)
        if simpler in (before, after):
            return None if simpler == before else changed
        return self._at_once(place, simpler, after, changed)

    def _at_once(self, place: Place, before: Formula, after: Formula, current: Formula) -> Formula | None:
        """By one step, with as little as possible of what is known at its place."""
        facts, changed = self._replaced(place, before, after, current)
        names = {*before.free, *after.free}
        context = facts if any(names & set(f.free) for f in facts) else ()
        for used in ((), context) if context and simplify(before) == after else (context,):
            search = before, after, used
            if search in self.failed or len(self.failed) > MOST_FAILED:
                continue
            found = self.evidence(*search)
            if found is None:
                self.failed.add(search)
            else:
                self.steps.append(written(found[0], place, before, after, used, found[1]))
                return changed
        return None

    def _replaced(self, place: Place, before: Formula, after: Formula, current: Formula) -> tuple[Context, Formula]:
        """What is known at a place without quantifiers, and the whole formula with ``after`` for ``before`` there."""
        facts, changed = replaced(current, place, before, after, self.known, Entry(None, "place"))
        return tuple(f for f in facts if f.is_quantifier_free), changed

    def _simpler(self, place: Place, formula: Formula, current: Formula) -> tuple[Formula, Formula]:
        """What a part becomes under what is known at its place, as far as that is proved, and the whole formula."""
        facts, _ = self._replaced(place, formula, formula, current)
        target = simplify(formula, conj(facts))
        if target == formula:
            return formula, current
        changed = self._at_once(place, formula, target, current)
        return self._by_parts(place, formula, current) if changed is None else (target, changed)

    def _by_parts(self, place: Place, formula: Formula, current: Formula) -> tuple[Formula, Formula]:
        """As ``_simpler``, in the order of the simplifier: the comparisons, and each other part under these."""
        if isinstance(formula, Exists | ForAll):
            nested = isinstance(formula.body, Exists | ForAll)
            body, current = (self._simpler if nested else self._by_parts)((*place, 0), formula.body, current)
            return self._dropped(place, formula, body, current)
        kind, tidied = type(formula), set[Formula]()
        while isinstance(formula, And | Or) and type(formula) is kind:
            part = next((f for f in _parts(formula) if f not in tidied and f != formula), None)
            if part is None:
                break
            simpler, current = self._simpler((*place, *_at(current, place, part)), part, current)
            tidied |= {part, simpler}
            if simpler != part:
                formula = replaced(formula, _at(formula, (), part), part, simpler, (), Entry(None, "place"))[1]
        return formula, current

    def _dropped(
        self, place: Place, formula: Exists | ForAll, body: Formula, current: Formula
    ) -> tuple[Formula, Formula]:
        """The block with another body, which stands there, without the variables that do not occur in it."""
        build = exists if isinstance(formula, Exists) else forall
        whole, fewer = build(formula.variables, body), build([v for v in formula.variables if v in body.free], body)
        if whole != fewer:
            self.steps.append(written("renaming", place, whole, fewer, (), {}))
            current = replaced(current, place, whole, fewer, (), Entry(None, "place"))[1]
        return fewer, current

    def _under(self, place: Place, before: Exists | ForAll, after: Formula, current: Formula) -> Formula | None:
        """As ``_parted``: the body, then quantifiers of variables that no longer occur left out."""
        body = after.body if isinstance(after, Exists | ForAll) and type(after) is type(before) else after
        if body is after and set(before.variables) & set(after.free):
            return None
        nested = isinstance(before.body, Exists | ForAll)
        inner = (self.inside if nested else self._parted)((*place, 0), before.body, body, current)
        if inner is None and body is after and not nested:
            inner = self._at_once((*place, 0), before.body, body, current)
        return None if inner is None else self._dropped(place, before, body, inner)[1]

    def _quantified(self, place: Place, before: And | Or, after: Formula, current: Formula) -> Formula | None:
        """As ``_parted``: quantified parts turned into those of the simpler formula, or constants; then the whole."""
        listed = after.args if isinstance(after, And | Or) and type(after) is type(before) else (after,)
        targets = [f for f in listed if not f.is_quantifier_free]
        for k, part in enumerate(before.args):
            if part.is_quantifier_free or part in targets:
                continue
            about = set(polynomials(part))
            near = {f: len(about.intersection(polynomials(f))) for f in targets}
            alike = [f for f in targets if type(f) is type(part) and set(f.bound) & set(part.bound)]
            alike = sorted(alike, key=near.__getitem__, reverse=True)[:MOST_ALIKE]
            for target in alike or (*targets, TRUE, FALSE):
                changed = self.inside((*place, *_at(current, place, part)), part, target, current)
                if changed is not None:
                    rest = replaced(before, (k,), part, target, (), Entry(None, "place"))[1]
                    return changed if rest == after else self.inside(place, rest, after, changed)
        return None


def _at(whole: Formula, place: Place, part: Formula) -> Place:
    """Where a part of what stands at a place is an argument there; nowhere, where it is several of them."""
    listed = children(subformula(whole, place))
    return (listed.index(part),) if part in listed else ()


def _parts(formula: And | Or) -> list[Formula]:
    """The comparisons as one part, and the others."""
    atoms = [f for f in formula.args if isinstance(f, Atom)]
    joined = (conj if isinstance(formula, And) else disj)(atoms)
    return [*([joined] if atoms else []), *(f for f in formula.args if not isinstance(f, Atom))]

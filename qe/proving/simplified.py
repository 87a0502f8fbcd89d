"""Simplifications that go on inside a formula: a step for each place, where one step for all of them is out of reach.

The steps that a simplifier takes are found again from the formula before and after: what is under a quantifier, parts
that are quantified, then parts under what stands beside them. Nothing here is trusted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from qe.errors import CertificateRejected
from qe.formula.build import conj, disj
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, ForAll, Formula, Or
from qe.formula.traverse import polynomials
from qe.kernel.derivation import replaced
from qe.kernel.negation import negation
from qe.kernel.step import Context
from qe.proof.certificate import written
from qe.proof.entry import Entry, Json
from qe.proof.step import Place
from qe.simplify.simplify import simplify

Evidence = Callable[[Formula, Formula, Context], tuple[str, Json] | None]
"""A rule by whose checker two formulas have the same truth under a context, and the evidence that it accepts."""

MOST_TRIED, MOST_ALIKE = 60, 2
"""Steps that are tried for one simplification, and quantified parts that one of them may have become, at most."""


@dataclass(slots=True)
class Simplified:
    """``known``: what holds around the whole formula; ``steps``: those written so far."""

    evidence: Evidence
    known: Context
    steps: list[Json]
    tried: int = 0

    def inside(self, place: Place, before: Formula, after: Formula, current: Formula) -> Formula | None:
        """The whole formula ``current`` with ``after`` for ``before`` at a place, each step with evidence.

        None, and no step written, where none is found.
        """
        mark = len(self.steps)
        try:
            found = self._inside(place, before, after, current)
        except CertificateRejected:  # the step is about a part of what stands there
            found = None
        if found is None:
            del self.steps[mark:]
        return found

    def _inside(self, place: Place, before: Formula, after: Formula, current: Formula) -> Formula | None:
        if before == after:
            return current
        return self._at_once(place, before, after, current) or self._parted(place, before, after, current)

    def _parted(self, place: Place, before: Formula, after: Formula, current: Formula) -> Formula | None:
        """As ``_inside``, where all of it in one step has been tried: for a block that is as much as for its body,
        unless this is a block of the other kind."""
        if before == after:
            return current
        if isinstance(before, Exists | ForAll):
            return self._under(place, before, after, current)
        if isinstance(before, And | Or):
            quantified = None if before.is_quantifier_free else self._apart(place, before, after, current)
            return quantified or self._piecewise(place, before, after, current)
        return None

    def _apart(self, place: Place, before: And | Or, after: Formula, current: Formula) -> Formula | None:
        """As ``_quantified``, with no step left behind where it fails."""
        mark = len(self.steps)
        found = self._quantified(place, before, after, current)
        if found is None:
            del self.steps[mark:]
        return found

    def _at_once(self, place: Place, before: Formula, after: Formula, current: Formula) -> Formula | None:
        """By one step, with as little as possible of what is known at its place."""
        facts, changed = self._replaced(place, before, after, current)
        names = {*before.free, *after.free}
        context = facts if any(names & set(f.free) for f in facts) else ()
        for used in ((), context) if context and simplify(before) == after else (context,):
            self.tried += 1
            found = self.evidence(before, after, used) if self.tried <= MOST_TRIED else None
            if found is not None:
                self.steps.append(written(found[0], place, before, after, used, found[1]))
                return changed
        return None

    def _replaced(self, place: Place, before: Formula, after: Formula, current: Formula) -> tuple[Context, Formula]:
        """What is known at a place without quantifiers, and the whole formula with ``after`` for ``before`` there."""
        facts, changed = replaced(current, place, before, after, self.known, Entry(None, "place"))
        return tuple(f for f in facts if f.is_quantifier_free), changed

    def _under(self, place: Place, before: Exists | ForAll, after: Formula, current: Formula) -> Formula | None:
        """The body simplified, then quantifiers of variables that no longer occur left out."""
        if type(after) is type(before):
            assert isinstance(after, Exists | ForAll)
            body = after.body
        elif set(before.variables) & set(after.free):
            return None
        else:
            body = after
        nested = isinstance(before.body, Exists | ForAll)
        inner = (self._inside if nested else self._parted)((*place, 0), before.body, body, current)
        if inner is None and before.body != body and body is after and not nested:
            inner = self._at_once((*place, 0), before.body, body, current)
        if inner is None:
            return None
        kept = type(before)(before.variables, body)
        if kept != after:
            self.steps.append(written("renaming", place, kept, after, (), {}))
            inner = replaced(inner, place, kept, after, (), Entry(None, "place"))[1]
        return inner

    def _quantified(self, place: Place, before: And | Or, after: Formula, current: Formula) -> Formula | None:
        """Quantified parts turned into those of the simpler formula, or into constants, and then the whole."""
        listed = after.args if isinstance(after, And | Or) and type(after) is type(before) else (after,)
        targets = [f for f in listed if not f.is_quantifier_free]
        for k, part in enumerate(before.args):
            if part.is_quantifier_free or part in targets:
                continue
            about = set(polynomials(part))
            facts, _ = self._replaced((*place, k), part, part, current)
            simpler = simplify(part, conj(facts))
            near = {f: (f == simpler, len(about.intersection(polynomials(f)))) for f in targets}
            alike = [f for f in targets if type(f) is type(part) and set(f.bound) & set(part.bound)]
            alike = sorted(alike, key=near.__getitem__, reverse=True)[:MOST_ALIKE]
            for target in alike or (*targets, TRUE, FALSE):
                mark = len(self.steps)
                found = self._inside((*place, k), part, target, current)
                if found is not None:
                    rest = _joined(before, (*before.args[:k], target, *before.args[k + 1 :]))
                    return found if rest == after else self._inside(place, rest, after, found)
                del self.steps[mark:]
        return None

    def _piecewise(self, place: Place, before: And | Or, after: Formula, current: Formula) -> Formula | None:
        """Each part made simpler under the comparisons beside it, and then the whole."""
        formula, seen = before, set[Formula]()
        while isinstance(formula, And | Or) and type(formula) is type(before):
            part = next((f for f in formula.args if not isinstance(f, Atom) and f not in seen), None)
            if part is None:
                break
            seen.add(part)
            k = formula.args.index(part)
            target = simplify(part, conj(_beside(formula, k)))
            found = None if target == part else self.inside((*place, k), part, target, current)
            if found is not None:
                seen.add(target)
                rest = _joined(formula, (*formula.args[:k], target, *formula.args[k + 1 :]))
                formula, current = rest, found  # type: ignore[assignment]
        if formula == before:
            return None
        return current if formula == after else self._at_once(place, formula, after, current)


def _joined(like: And | Or, parts: tuple[Formula, ...]) -> Formula:
    return (conj if isinstance(like, And) else disj)(parts)


def _beside(formula: And | Or, k: int) -> list[Formula]:
    """The comparisons that hold at the k-th part, but for its truth (in a disjunction: where the others fail)."""
    others: list[Formula] = [f for i, f in enumerate(formula.args) if i != k and isinstance(f, Atom)]
    return others if isinstance(formula, And) else [negation(f) for f in others]

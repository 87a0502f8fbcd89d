"""Answers as derivations: steps, each of which replaces a formula by an equivalent one.

THEOREM. Equivalence is a congruence: if A <-> B holds over R, then so does F <-> F', where F' has B in place of A. So a
derivation F0, F1, ..., Fn whose steps are equivalences proves F0 <-> Fn. A step may use what its place says: with
facts C that hold wherever the place matters (conjuncts beside it), C implies (A <-> B) is enough.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj, exists, forall, map_children, neg
from qe.formula.syntax import And, Atomic, Constant, Exists, ForAll, Formula, Not, Or
from qe.formula.traverse import children
from qe.io.names import names_in
from qe.proof.step import Place, Step

SHOWN = 8
"""So many steps are named in the short form."""


@dataclass(frozen=True, slots=True, repr=False)
class Derivation:
    """``start`` and the steps in their order. ``whole[k]`` is the formula after k steps; ``answer`` is the last one.

    ``is_complete``: replaying the steps leads from ``start`` to the answer that was given; else the steps say how the
    answer was found, but some are missing.
    """

    start: Formula
    steps: tuple[Step, ...] = ()
    whole: tuple[Formula, ...] = field(default=(), repr=False)
    is_complete: bool = False

    def __repr__(self) -> str:
        rules = ", ".join(step.rule for step in self.steps[:SHOWN])
        return f"Derivation({len(self.steps)} steps: {rules}{', …' if len(self.steps) > SHOWN else ''})"

    def to_latex(self) -> str:
        """The derivation as numbered LaTeX lines, each with the name of its rule."""
        from qe.proof import writing

        return writing.latex(self.start, self.steps)

    def to_html(self, *, title: str = "Derivation", note: str = "") -> str:
        """The derivation as one page that needs nothing from elsewhere: formulas in MathML, each step with the theorem
        of its rule, as the checker states it, and its evidence folded. ``note``: a sentence below what is claimed."""
        from qe.proof import writing

        complete = self.is_complete
        return writing.page(self.start, self.steps, self.answer, is_complete=complete, title=title, note=note)

    def _repr_html_(self) -> str:
        """The question, the answer and the steps, for notebooks."""
        from qe.proof import writing

        return writing.fragment(self.start, self.steps, self.answer)

    @property
    def answer(self) -> Formula:
        """The formula after the last step."""
        return self.whole[-1] if self.whole else self.start


def put_together(start: Formula, steps: Iterable[Step], answer: Formula, ring: Ring | None = None) -> Derivation:
    """The derivation with its places. A step whose formula stands nowhere belongs to an attempt that was given up.

    ``ring``: one that has all names, if there is one already.
    """
    listed = list(steps)
    formulas = (start, answer, *(f for step in listed for f in (step.before, step.after, step.context)))
    ring = ring or Ring.of(dict.fromkeys(name for f in formulas for name in names_in(f)))
    current = start = moved(start, ring)
    kept: list[Step] = []
    whole = [current]
    for step in listed:
        before, after = moved(step.before, ring), moved(step.after, ring)
        if before == after:
            continue
        places: list[Place] = []
        changed = _replaced(current, before, after, (), places)
        if places:
            current = changed
            whole.append(current)
            kept.append(Step(step.rule, before, after, moved(step.context, ring), step.evidence, tuple(places)))
    return Derivation(start, tuple(kept), tuple(whole), current == moved(answer, ring))


def moved(formula: Formula, ring: Ring) -> Formula:
    """The formula over another ring, with its negations where they stand."""
    if formula.ring is ring or isinstance(formula, Constant):
        return formula
    key = "moved", formula
    known = ring.cache.get(key)
    if isinstance(known, Formula):
        return known
    if isinstance(formula, Atomic):
        there = convert(formula, ring)
    elif isinstance(formula, Not):
        there = negated(moved(formula.arg, ring))
    else:
        there = map_children(formula, lambda part: moved(part, ring))
    return ring.remembered(key, lambda: there)


def negated(formula: Formula) -> Formula:
    """The negation as it stands: steps inside it have their places there, which pushing it inwards would change."""
    return neg(formula) if isinstance(formula, Constant) else Not(formula)


def _replaced(formula: Formula, before: Formula, after: Formula, path: Place, places: list[Place]) -> Formula:
    """The formula with ``after`` for every occurrence of ``before``, also as a part of a conjunction or disjunction."""
    if formula == before:
        places.append(path)
        return after
    changed = [_replaced(c, before, after, (*path, k), places) for k, c in enumerate(children(formula))]
    match formula:
        case And(args) | Or(args):
            build = conj if isinstance(formula, And) else disj
            if type(before) is type(formula) and set(before.args) <= set(args):
                rest = [c for c, old in zip(changed, args, strict=True) if old not in before.args]
                places.append(path)
                return build((*rest, after))
            return build(changed) if changed != list(args) else formula
        case Not(arg):
            return negated(changed[0]) if changed[0] is not arg else formula
        case Exists(variables, body) | ForAll(variables, body):
            rebuilt = exists if isinstance(formula, Exists) else forall
            return rebuilt(variables, changed[0]) if changed[0] is not body else formula
    return formula

"""Rule "Boolean search": a sentence of many cases is false.

THEOREM. Let every comparison in f be one of p > 0, p = 0, p < 0 or its negation, and let each conjunction and
disjunction imply what is said of its parts (Plaisted, Greenbaum 1986). A real point at which f holds makes true these
clauses, and the clause not a_1 or ... or not a_k of any comparisons that no real point satisfies together. If the empty
clause follows from them, by clauses each of which follows from those before it (``unit_propagation``), then
ex v. f is false. all v. f is the negation of ex v. not f.

Evidence: ``refuted``, each with ``atoms`` and the ``steps`` from the sentence that they hold together to false;
``learnt``: the further clauses, as lists of literals. Every polynomial has three numbers, for > 0, < 0 and = 0, and
each conjunction or disjunction inside another formula has one, in the order in which they occur (``Cases``).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from qe.exact.ring import Poly
from qe.formula.build import conj, exists
from qe.formula.syntax import FALSE, And, Atom, Constant, Formula, Or, Relation
from qe.kernel.block import refuted_block
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.unit_propagation import Clauses
from qe.proof.entry import Entry, formula_from_json


class Cases:
    """The clauses of one formula in negation normal form."""

    def __init__(self, formula: Formula, tick: Callable[[], None]) -> None:
        self.clauses = Clauses(tick)
        self.count = 0
        self._polys: dict[Poly, int] = {}
        self._nodes: dict[Formula, int] = {}
        self.clauses.add([self._named(formula)])

    def exclude(self, atoms: Sequence[Atom]) -> None:
        """That these do not hold together."""
        self.clauses.add([-self.literal(a) for a in atoms])

    def literal(self, given: Atom) -> int:
        """The literal of a comparison."""
        if given.poly not in self._polys:
            self._polys[given.poly] = positive = self._new()
            negative, zero = self._new(), self._new()
            for clause in ([positive, negative, zero], [-positive, -negative], [-positive, -zero], [-negative, -zero]):
                self.clauses.add(clause)
        positive = self._polys[given.poly]
        offset, holds = _LITERALS[given.relation]
        return (positive + offset) if holds else -(positive + offset)

    def _new(self) -> int:
        self.count += 1
        return self.count

    def _named(self, formula: Formula) -> int:
        """A literal that is true where the formula holds."""
        if isinstance(formula, Atom):
            return self.literal(formula)
        if formula in self._nodes:
            return self._nodes[formula]
        found = self._nodes[formula] = self._new()
        match formula:
            case And(args):
                for part in args:
                    self.clauses.add([-found, self._named(part)])
            case Or(args):
                self.clauses.add([-found, *(self._named(part) for part in args)])
            case Constant(value):
                self.clauses.add([found if value else -found])
        return found


_LITERALS = {
    Relation.GT: (0, True),
    Relation.LE: (0, False),
    Relation.LT: (1, True),
    Relation.GE: (1, False),
    Relation.EQ: (2, True),
    Relation.NE: (2, False),
}
"""Which of the three literals of its polynomial a comparison is, or the negation of which."""


def check_boolean_search(claim: Claim, context: Context, limits: Limits) -> None:
    """Every conjunction is refuted, every clause follows, and so does a contradiction."""
    refuted, learnt = only(claim, "refuted", "learnt")
    before = refuted_block(claim)
    cases = Cases(before.body, limits.tick)
    for entry in refuted.items():
        atoms, steps = entry.fields("atoms", "steps")
        together = [_atom(e, claim) for e in atoms.items()]
        sentence = conj(together)
        if limits.replay(steps, exists(sentence.free, sentence), (), claim.ring) != FALSE:
            raise steps.fail("not shown that these do not hold together")
        cases.exclude(together)
    for entry in learnt.items():
        clause = [e.integer(-cases.count) for e in entry.items()]
        if any(not literal or literal > cases.count for literal in clause):
            raise entry.fail("expected literals")
        if cases.clauses.implying(clause) is None:
            raise entry.fail("the clause does not follow from those before it")
        cases.clauses.add(clause)
    if cases.clauses.implying(()) is None:
        raise learnt.fail("not all cases are excluded")


def _atom(entry: Entry, claim: Claim) -> Atom:
    found = formula_from_json(entry, claim.ring)
    if not isinstance(found, Atom):
        raise entry.fail("expected a comparison")
    return found

"""Steps of the kernel, one after the other, and the formula to which they lead: what elaborators write with."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import atoms, children, conjuncts, map_atoms
from qe.kernel.block import block_goals
from qe.kernel.boolean import Goal, equivalence
from qe.kernel.derivation import replaced
from qe.kernel.negation import normal
from qe.kernel.root import root_goals
from qe.kernel.step import Claim, Context, Limits
from qe.kernel.terms import Quotient, at_terms, terms_goals
from qe.proof.certificate import written
from qe.proof.entry import Entry, Json, poly_to_text
from qe.proof.step import Place
from qe.proving.lemma_list import EMPTY, with_cases
from qe.proving.lemmas import refuting
from qe.proving.primitive_names import SIGNS
from qe.proving.simplified import Simplified

FRESH = ("'", "''")
"""Names for variables that steps need on their way; where a formula has them, there are no steps."""


Obligations = Callable[[Claim, Context], Sequence[Goal]]


def by_signs(
    claim: Claim, limits: Limits, before: Formula, after: Formula, context: Context, lemmas: Json = EMPTY
) -> Json:
    """The step that these lemmas prove, with the cases in which they do. ``CertificateRejected`` where they do not."""
    step = replace(claim, rule=SIGNS, before=before, after=after, evidence=Entry({"theory": lemmas}, claim.path))
    theory = with_cases(lemmas, block_goals(step, context), claim.ring, limits)
    if theory is None:
        raise claim.fail("the lemmas do not show this step")
    return written(SIGNS, (), before, after, context, {"theory": theory})


@dataclass(slots=True)
class Made:
    """``steps`` so far, which lead to ``current``; ``known`` holds around all of it.

    Each method adds a step about a part of it and raises ``CertificateRejected`` where lemmas for it are not found.
    """

    claim: Claim
    limits: Limits
    current: Formula
    known: Context = ()
    steps: list[Json] = field(default_factory=list)

    @property
    def ring(self) -> Ring:
        return self.claim.ring

    def fresh(self) -> str:
        """A name that the formula does not have."""
        taken = {*self.current.free, *self.current.bound}
        name = next((n for n in FRESH if n in self.ring.index and n not in taken), "")
        if not name:
            raise self.claim.fail("no name is free")
        return name

    def step(
        self, rule: str, before: Formula, after: Formula, evidence: Json, used: Context = (), place: Place | None = None
    ) -> None:
        """Any step, at a place, or the first one where ``before`` stands."""
        place = self.place(before) if place is None else place
        changed = self.beside(place, before, after)[1]
        if before != after:
            self.steps.append(written(rule, place, before, after, used, evidence))
        self.current = changed

    def signs(self, before: Formula, after: Formula, lemmas: Json = EMPTY, used: Context = ()) -> None:
        """A step that these lemmas prove."""
        step = by_signs(self.claim, self.limits, before, after, used, lemmas)
        assert isinstance(step, dict)
        self.step(SIGNS, before, after, step["evidence"], used)

    def place(self, part: Formula) -> Place:
        """The place nearest to the root where it stands."""
        found = min(places(self.current, part), key=len, default=None)
        if found is None:
            raise self.claim.fail("a part that is to be replaced is not there")
        return found

    def beside(self, place: Place, before: Formula, after: Formula) -> tuple[Context, Formula]:
        """The facts at a place, and what the whole becomes."""
        return replaced(self.current, place, before, after, self.known, Entry(None, self.claim.path))

    def moved(self, before: Formula, after: Formula) -> None:
        """Quantifiers that move."""
        if before != after:
            self.step("quantifiers", before, after, {})

    def named(self, before: Formula, after: Formula, name: str, equation: Atom) -> None:
        """An equation that gives a new variable a value."""
        back = written("linear equation solved", (), after, before, (), solved(equation, name))
        self.step("converse", before, after, {"steps": [back]})

    def put(self, formula: Formula, terms: Mapping[str, Poly | Quotient]) -> Formula:
        """A formula with terms for variables. ``CertificateRejected`` where it has root atoms."""
        if not all(isinstance(a, Atom) for a in atoms(formula)):
            raise self.claim.fail("no root atoms expected")
        one = self.ring.constant(1)
        by = {self.ring.index[v]: (term, one) if isinstance(term, Poly) else term for v, term in terms.items()}
        return map_atoms(formula, lambda a: atom(at_terms(a.poly, by), a.relation))

    def finished(self, after: Formula) -> list[Json]:
        """The steps, with one to the order in which the formula after has its parts."""
        self.moved(self.current, after)
        return self.steps

    def back(self, before: Formula, after: Formula, made: Made) -> None:
        """Steps from what stands after to what stands before."""
        self.step("converse", before, after, {"steps": made.steps})

    def derived(self, before: Formula, after: Formula, steps: Json) -> None:
        """Steps that lead from the one to the other, under what holds around all."""
        if normal(before) == before and normal(after) == after and not isinstance(before, ForAll):
            return self.step("steps", before, after, {"steps": steps}, self.known)
        back = written("converse", (), after, before, self.known, {"steps": steps})  # both sides as they stand
        return self.step("converse", before, after, {"steps": [back]}, self.known)

    def simplified(self, before: Formula, after: Formula) -> None:
        """What signs of polynomials prove, with what stands beside it where that is needed, a part after the other."""

        def evidence(one: Formula, other: Formula, used: Context) -> tuple[str, Json] | None:
            try:
                goals = block_goals(self._step(SIGNS, one, other, {"theory": EMPTY}), used)
            except CertificateRejected:
                goals = equivalence(one, other, used)
            lemmas = refuting(goals, self.ring, self.limits) if goals else EMPTY
            return None if lemmas is None else (SIGNS, {"theory": lemmas})

        changed = Simplified(evidence, self.known, self.steps).inside(self.place(before), before, after, self.current)
        if changed is None:
            raise self.claim.fail("not shown that this was simplified to that")
        self.current = changed

    def terms(
        self,
        before: Formula,
        after: Formula,
        there: Mapping[str, Quotient],
        back: Mapping[str, Quotient],
        lemmas: Json = None,
        place: Place | None = None,
        used: Context | None = None,
    ) -> None:
        """A change of variables by these terms; the lemmas are looked for where none are given, with what is used of
        what stands beside it (all of it)."""
        evidence: dict[str, Json] = {
            name: [[v, poly_to_text(top), poly_to_text(bottom)] for v, (top, bottom) in of.items()]
            for name, of in (("there", there), ("back", back))
        }
        if lemmas is None:
            return self.by_lemmas("terms", terms_goals, before, after, evidence, place, used)
        goals = terms_goals(self._step("terms", before, after, {**evidence, "theory": lemmas}), ())
        theory = with_cases(lemmas, goals, self.ring, self.limits)
        if theory is None:
            raise self.claim.fail("the lemmas do not show the change of variables")
        return self.step("terms", before, after, {**evidence, "theory": theory})

    def root(self, block: Exists, low: Poly | None = None) -> None:
        """An equation for x that rises, or falls, from a place (or the left end) to the right end has a root."""
        part = next(f for f in conjuncts(block.body) if isinstance(f, Atom) and f.relation is Relation.EQ)
        lead = part.poly.leading(self.ring.index[block.variables[0]])
        sign = 0 if low is None else 1 if lead.is_constant and lead.constant_value() > 0 else -1
        start: Json = None if low is None else [poly_to_text(low), "1"]
        self.by_lemmas("root", root_goals, block, TRUE, {"low": start, "high": None, "rising": sign})

    def by_lemmas(
        self,
        rule: str,
        obligations: Obligations,
        before: Formula,
        after: Formula,
        evidence: Mapping[str, Json],
        place: Place | None = None,
        used: Context | None = None,
    ) -> None:
        """A step whose obligations follow from signs, with what is used of what stands beside it (all of it)."""
        place = self.place(before) if place is None else place
        facts = self.beside(place, before, after)[0] if used is None else used
        goals = obligations(self._step(rule, before, after, {**evidence, "theory": EMPTY}), facts)
        lemmas = refuting(goals, self.ring, self.limits) if goals else EMPTY
        if lemmas is None:
            raise self.claim.fail("no lemmas show what has to be shown")
        self.step(rule, before, after, {**evidence, "theory": lemmas}, facts, place)

    def _step(self, rule: str, before: Formula, after: Formula, evidence: Json) -> Claim:
        return replace(self.claim, rule=rule, before=before, after=after, evidence=Entry(evidence, self.claim.path))


def places(formula: Formula, part: Formula, path: Place = ()) -> Iterator[Place]:
    """Where a formula stands, or is a part of a conjunction or disjunction; nothing inside of where it does."""
    if formula == part or (
        isinstance(formula, And | Or) and isinstance(part, type(formula)) and {*part.args} <= {*formula.args}
    ):
        yield path
        return
    for k, child in enumerate(children(formula)):
        yield from places(child, part, (*path, k))


def solved(equation: Atom, name: str) -> Json:
    """Evidence that an equation gives the variable, which has a number as its coefficient."""
    return {"solved": [value(equation, name)], "theory": EMPTY}


def value(equation: Atom, name: str) -> Json:
    """An equation for a variable with a number as coefficient, and the sign of that, as the kernel wants them."""
    lead = equation.poly.leading(equation.poly.ring.index[name])
    return [name, poly_to_text(equation.poly), 1 if lead.constant_value() > 0 else -1]


def equal(one: Poly, other: Poly) -> Atom:
    """That two different polynomials have the same value."""
    return Atom((one - other).normal()[1], Relation.EQ)


def quantified(names: Sequence[str], body: Formula) -> Formula:
    """The block; what is one inside stays one."""
    return Exists(tuple(names), body) if names and body != FALSE else body

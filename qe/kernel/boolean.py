"""The propositional part of rules: formulas that cannot hold together, whatever signs the polynomials have.

THEOREM. Let every comparison p rel 0 be a condition on the sign of p. Name every conjunction and disjunction inside a
formula, and its negation by the same name; let what is named imply what is said of its parts (Plaisted, Greenbaum
1986). At a real point at which the formulas of a goal hold these clauses and the lemmas (``qe.kernel.signs``, each
proved) hold, too. If a contradiction follows from them by clauses each of which follows from those before it
(``qe.kernel.clauses``), the formulas hold together nowhere. Quantified parts and root atoms count as conditions of
their own: the same where they are the same up to the names of bound variables, and all x not A is the negation of
ex x A.

Evidence of a step, as its member ``theory``: ``polynomials`` (those that the lemmas use), ``lemmas``; ``cases``, more
clauses, each with the number of its goal: [goal, [literal, ...]], where literal 8*v + s says that the sign of variable
v is in the set s; and ``refuted``, if there are any: lists of comparisons (``atoms``) with the ``steps`` from the
sentence that they hold together to false. Variables are numbered as they occur: the polynomials of the lemmas, then in
every formula from the outside in, then those of ``refuted``. The alternatives of the last formula of a goal are looked
at one by one where nothing follows for all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from qe.exact.ring import Poly
from qe.formula.build import conj, exists
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation
from qe.kernel.clauses import Clauses, Literal
from qe.kernel.negation import negation, normal
from qe.kernel.renaming import shape
from qe.kernel.signs import ANY, NEGATIVE, POSITIVE, ZERO, Lemma, read_lemma, read_polynomials
from qe.kernel.step import Claim, Context, Limits
from qe.proof.entry import Entry, formula_from_json

_SIGNS = {r: sum({-1: NEGATIVE, 0: ZERO, 1: POSITIVE}[s] for s in r.signs) for r in Relation}

Goal = tuple[Formula, ...]
"""Formulas that cannot hold together."""


@dataclass(frozen=True, slots=True)
class ByLemmas:
    """A checker: what has to be refuted so that a step is right, and the refutation by the theory in its evidence.

    ``obligations`` raises ``CertificateRejected`` where no refutation could help. The member ``theory`` of the evidence
    is read here.
    """

    obligations: Callable[[Claim, Context], Sequence[Goal]]

    def __call__(self, claim: Claim, context: Context, limits: Limits) -> None:
        goals = self.obligations(claim, context)
        assert isinstance(claim.evidence.value, dict)  # the obligations have read it
        entry = Entry(claim.evidence.value.get("theory"), f"{claim.evidence.path}.theory")
        theory, cases = read_theory(entry, claim, limits)
        searches = [Search(theory, goal) for goal in goals]
        for case in cases.items():
            number, literals = case.row("goal", "literals")
            if number.integer() >= len(goals):
                raise number.fail("there is no such goal")
            search = searches[number.integer()]
            clause = [divmod(literal.integer(), 8) for literal in literals.items()]
            if any(i >= len(search.clauses.domains) for i, _ in clause):
                raise literals.fail("expected literals")
            if not search.clauses.implies(clause):
                raise case.fail("the clause does not follow from those before it")
            search.clauses.add(clause)
        if not all(search.is_refuted for search in searches):
            raise claim.fail("the signs that the lemmas allow do not exclude that it is wrong")


def equivalence(left: Formula, right: Formula, context: Iterable[Formula]) -> list[Goal]:
    """What has to be refuted so that two formulas have the same truth under the context."""
    if normal(left) == normal(right):
        return []
    return [(*context, left, negation(right)), (*context, right, negation(left))]


@dataclass(frozen=True, slots=True)
class Theory:
    """Polynomials, lemmas about their signs, and comparisons that cannot hold together."""

    polynomials: tuple[Poly, ...]
    lemmas: tuple[Lemma, ...]
    limits: Limits
    refuted: tuple[tuple[Atom, ...], ...] = ()


def read_theory(entry: Entry, claim: Claim, limits: Limits) -> tuple[Theory, Entry]:
    """What a step's evidence says, proved, and the entry of its cases."""
    listed, lemmas, cases, refuted = entry.fields("polynomials", "lemmas", "cases", optional=("refuted",))
    polys, known = read_polynomials(listed, claim.ring), list[Lemma]()
    for lemma in lemmas.items():
        limits.tick()
        known.append(read_lemma(lemma, polys, claim.ring))
    together = () if refuted.value is None else tuple(_read_refuted(e, claim, limits) for e in refuted.items())
    return Theory(polys, tuple(known), limits, together), cases


def _read_refuted(entry: Entry, claim: Claim, limits: Limits) -> tuple[Atom, ...]:
    listed, steps = entry.fields("atoms", "steps")
    atoms = []
    for item in listed.items():
        atom = formula_from_json(item, claim.ring)
        if not isinstance(atom, Atom):
            raise item.fail("expected a comparison")
        atoms.append(atom)
    sentence = conj(atoms)
    if limits.replay(steps, exists(sentence.free, sentence), (), claim.ring) != FALSE:
        raise steps.fail("not shown that these do not hold together")
    return tuple(atoms)


class Search:
    """The clauses of one goal."""

    def __init__(self, theory: Theory, goal: Iterable[Formula], clauses: Clauses | None = None) -> None:
        self.clauses = clauses or Clauses(theory.limits.tick)
        self._numbers: dict[object, int] = {}
        self._named: set[Literal] = set()
        self.goal = [normal(f) for f in goal]
        for poly in theory.polynomials:
            self._variable(poly, ANY)
        for lemma in theory.lemmas:
            self.clauses.learn(lemma)
        for formula in self.goal:
            self.clauses.add([self.literal(formula)])
        for atoms in theory.refuted:
            self.clauses.add((i, ANY & ~signs) for i, signs in map(self.literal, atoms))

    @property
    def is_refuted(self) -> bool:
        """Whether a contradiction follows, or follows from every alternative of the last formula."""
        last = self.goal[-1] if self.goal else TRUE
        return self.clauses.settled() is None or (
            isinstance(last, Or) and all(self.clauses.settled([self.literal(case)]) is None for case in last.args)
        )

    def _variable(self, key: object, signs: int = NEGATIVE | POSITIVE) -> int:
        """The variable of a polynomial, or of a condition that is no comparison: positive where it holds."""
        if key not in self._numbers:
            self._numbers[key] = self.clauses.new(signs)
        return self._numbers[key]

    def literal(self, formula: Formula) -> Literal:
        """What holds where the formula does, whose negations stand at its atoms; its parts are named, too."""
        match formula:
            case Atom(poly, relation):
                return self._variable(poly, ANY), _SIGNS[relation]
            case Constant(value):
                return self._variable(TRUE, POSITIVE), POSITIVE if value else NEGATIVE
            case Not(arg):
                return self._variable(arg), NEGATIVE
            case ForAll():
                return self._variable(shape(negation(formula))), NEGATIVE
            case Exists():
                return self._variable(shape(formula)), POSITIVE
            case And(args):
                name = self._variable(negation(formula)), NEGATIVE
                if name not in self._named:
                    self._named.add(name)
                    for part in args:
                        self.clauses.add([(name[0], POSITIVE), self.literal(part)])
                return name
            case Or(args):
                name = self._variable(formula), POSITIVE
                if name not in self._named:
                    self._named.add(name)
                    self.clauses.add([(name[0], NEGATIVE), *map(self.literal, args)])
                return name
        return self._variable(formula), POSITIVE

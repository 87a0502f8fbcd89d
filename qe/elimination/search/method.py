"""Boolean search: existential sentences with many cases, by a SAT solver over the signs of their polynomials.

The clauses are those of ``clauses``. Each model of theirs chooses atoms that make the formula true; if these hold at a
point, so does the formula; if not, some of them cannot hold together, which is a further clause. First ``guided`` looks
for such clauses while the solver decides; whether they leave no model is seen by a solver that has nothing but clauses,
and goes on where they do.

THEOREM. If the clauses have no model, the sentence is false: every clause added is true at all real points, and
a real point that makes the formula true gives a model of all of them. There are finitely many choices, each of which is
made at most once (Nieuwenhuis, Oliveras, Tinelli 2006: DPLL(T)).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.elimination.protocol import Context, Outcome
from qe.elimination.search.clauses import Clauses
from qe.elimination.search.guided import UNITS, guided
from qe.elimination.search.theory import Theory
from qe.errors import Unable
from qe.exact.number import Values
from qe.exact.ring import Ring
from qe.extras import lacking
from qe.formula.block import Block
from qe.formula.build import conj, convert, exists
from qe.formula.syntax import FALSE, TRUE, Atom, Exists, Formula
from qe.formula.traverse import conjuncts
from qe.options import Budget, Options
from qe.proof.on_demand import Evidence, OnDemand
from qe.proof.step import Nested, Step

RULE = "Boolean search"


class BooleanSearch:
    """Existential sentences with many cases."""

    name = "search"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Sentences of one block without root atoms."""
        if not problem.is_flat or problem.free or problem.has_root_atoms:
            return None
        return f"{len(problem.atoms)} atoms"

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """The decision. Raises ``Unable`` where python-sat is absent or a conjunction is not decided."""
        if context.decide is None:
            return None
        dual = problem.dual
        found = found_point(dual.positive, context)
        if isinstance(found, Refuted):
            evidence = {"proof": OnDemand(found.evidence)}
            context.log.step(RULE, problem.formula, problem.asked(FALSE), evidence=evidence)
            return Outcome(problem.asked(FALSE))
        context.log.step(RULE, problem.formula, problem.asked(TRUE))
        return Outcome(problem.asked(TRUE), {name: found.get(name, Fraction(0)) for name in dual.variables})


@dataclass(frozen=True, slots=True)
class Refuted:
    """Atoms that cannot hold together, for every choice of cases some; ``decided``: how the engine refuted those that
    it was asked about, as sets of atoms. The others contradict each other by linear combinations, or at sight."""

    conflicts: tuple[tuple[Atom, ...], ...]
    decided: Mapping[frozenset[Formula], Nested]

    def evidence(self, budget: Budget) -> Evidence:
        """The conflicts with the derivation that refutes each of them."""
        return {"refuted": [{"atoms": atoms, "steps": self._steps(atoms)} for atoms in self.conflicts]}

    def _steps(self, atoms: Sequence[Atom]) -> Nested:
        together = conj(atoms)
        sentence = exists(together.free, together)
        known = self.decided.get(frozenset(atoms))
        return known or Nested(sentence, (Step("simplification", sentence, FALSE),), FALSE)


def found_point(body: Formula, context: Context) -> Values | Refuted:
    """Values that make a formula in negation normal form true, or that there are none."""
    try:
        import pysat.solvers  # noqa: F401
    except ImportError as error:
        raise lacking(error) or error from None
    ring, decide = body.ring, context.decide
    if ring is None or decide is None:
        return {} if body == TRUE else Refuted((), {})
    refutations: dict[frozenset[Formula], Nested] = {}

    def decided(sentence: Formula, budget: Budget) -> Values | None:
        narrow = _in_own_ring(sentence)
        outcome = decide(narrow, context.options, budget)
        if outcome.formula == FALSE:
            body = sentence.body if isinstance(sentence, Exists) else sentence
            refutations[frozenset(conjuncts(body))] = outcome.nested(narrow)
            return None
        if outcome.witness is None:
            raise Unable("a conjunction is satisfiable, but no point was found")
        return outcome.witness

    clauses, theory = Clauses(body), Theory(ring, decided, context.budget)
    lemmas = guided(clauses, theory)
    if isinstance(lemmas, dict):
        context.log.work("search", {"clauses": len(clauses.clauses), "refuted": len(refutations)})
        return lemmas
    return _completed(clauses, theory, lemmas, refutations, context)


def _in_own_ring(sentence: Formula) -> Formula:
    """The sentence in the ring of its own variables, if it has few of many: all that follows is quicker there."""
    ring = sentence.ring
    if ring is None or not ring.is_wide or not isinstance(sentence, Exists):
        return sentence
    names = set(sentence.body.free)
    return convert(sentence, Ring.of(name for name in ring.names if name in names))


def _completed(
    clauses: Clauses,
    theory: Theory,
    lemmas: Sequence[Sequence[int]],
    refutations: dict[frozenset[Formula], Nested],
    context: Context,
) -> Values | Refuted:
    """What is left after the guided search: whole assignments one after the other, until one has a point or none is
    left."""
    from pysat.solvers import Solver

    says = clauses.says()
    conflicts = [tuple(says[-literal] for literal in lemma) for lemma in lemmas]
    with Solver(name="cadical153", bootstrap_with=[*clauses.clauses, *lemmas]) as solver:
        while solver.solve():
            context.budget.spend(UNITS)
            context.budget.check("search", len(conflicts) + 1)
            looked = theory.look(clauses.chosen(solver.get_model(), theory.bounds.sign))
            if isinstance(looked, dict):
                context.log.work("search", {"clauses": len(clauses.clauses), "refuted": len(conflicts)})
                return looked
            for reason in looked:
                conflicts.append(tuple(reason))
                solver.add_clause([-clauses.literal(a) for a in reason])
    context.log.work("search", {"clauses": len(clauses.clauses), "refuted": len(conflicts)})
    return Refuted((*clauses.orders, *conflicts), refutations)

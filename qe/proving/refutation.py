"""Refutations over signs: which lemmas they need, and the cases that the kernel is handed. Nothing here is trusted."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from qe.errors import Unable
from qe.formula.syntax import And, Formula, Or
from qe.kernel.boolean import Goal, Search, Theory
from qe.kernel.clauses import Literal
from qe.kernel.signs import ANY, NEGATIVE, POSITIVE, ZERO, Domains, Lemma
from qe.proof.entry import Json

NODES = 2_000
"""Case distinctions for one alternative of what may be wrong, at most."""


@dataclass(frozen=True, slots=True)
class Refutation:
    """Clauses that lead to a contradiction, each by those before it, and the lemmas that took part."""

    cases: list[list[Literal]]
    used: frozenset[int]


@dataclass(frozen=True, slots=True, eq=False)
class _Noted:
    """A lemma that notes when it takes signs away."""

    lemma: Lemma
    number: int
    used: set[int]
    polynomials: tuple[int, ...]

    def cut(self, domains: Domains) -> list[int]:
        changed = self.lemma.cut(domains)
        if changed:
            self.used.add(self.number)
        return changed


def refutation(
    theory: Theory, goal: Iterable[Formula], nodes: int = NODES, splits: int = NODES
) -> Refutation | None:
    """A refutation of the goal, or None where there is none. ``Unable`` past so many case distinctions, and past so
    many by the sign of a polynomial."""
    used = set[int]()
    noted = tuple(_Noted(lemma, k, used, lemma.polynomials) for k, lemma in enumerate(theory.lemmas))
    search = Search(Theory(theory.polynomials, noted, theory.limits, theory.refuted), goal)  # type: ignore[arg-type]
    split = list(dict.fromkeys(i for lemma in noted for i in lemma.polynomials))
    tree = _Tree(search, split, nodes, splits)
    return Refutation(tree.cases, frozenset(used)) if tree.is_refuted() else None


def cases(theory: Theory, goals: Sequence[Goal]) -> Json | None:
    """The clauses by which all goals are refuted, as evidence; None where one is not, or not in so many cases."""
    listed: list[Json] = []
    for k, goal in enumerate(goals):
        found = refutation(theory, goal)
        if found is None:
            return None
        listed += [[k, [8 * i + signs for i, signs in clause]] for clause in found.cases]
    return listed


@dataclass(slots=True)
class _Tree:
    """Case distinctions over the alternatives of disjunctions, and over the signs on which lemmas depend."""

    search: Search
    about: Sequence[int]
    most: int
    splits: int
    cases: list[list[Literal]] = field(default_factory=list)
    nodes: int = 0

    def is_refuted(self) -> bool:
        if self.search.clauses.settled() is None:
            return True
        last = self.search.goal[-1:]
        if last and isinstance(last[0], Or):
            for case in last[0].args:
                self.nodes = 0
                if not self.excluded([self.search.literal(case)]):
                    return False
            return True
        return self.excluded([])

    def excluded(self, assumed: list[Literal]) -> bool:
        """Whether the literals cannot hold together: at once, or after clauses that say so of each of the cases."""
        domains = self.search.clauses.settled(assumed)
        if domains is None:
            return True
        self.nodes += 1
        if self.nodes > self.most:
            raise Unable(f"more than {self.most} cases of signs")
        for literal in self._alternatives(domains):
            if not self.excluded([*assumed, literal]):
                return False
            clause = [(i, ANY & ~signs) for i, signs in (*assumed, literal)]
            self.search.clauses.add(clause)
            self.cases.append(clause)
            if self.search.clauses.settled(assumed) is None:
                return True
        return False

    def _alternatives(self, domains: Domains) -> list[Literal]:
        """Literals of which one holds; none where there is nothing to decide."""
        chosen: list[Literal] = []
        for disjunction in self._open(self.search.goal, domains):
            literals = [x for x in map(self.search.literal, disjunction.args) if domains[x[0]] & x[1]]
            if not chosen or len(literals) < len(chosen):
                chosen = literals
            if len(chosen) < 3:
                break
        if chosen:
            return chosen
        for i in self.about:
            if domains[i] not in (NEGATIVE, ZERO, POSITIVE):
                self.splits -= 1
                if self.splits < 0:
                    raise Unable("too many cases of signs")
                return [(i, s) for s in (NEGATIVE, ZERO, POSITIVE) if domains[i] & s]
        return []

    def _open(self, formulas: Iterable[Formula], domains: Domains) -> Iterator[Or]:
        """The disjunctions that have to hold and that do not yet."""
        pending = list(formulas)
        while pending:
            formula = pending.pop()
            if isinstance(formula, And):
                pending += formula.args
            elif isinstance(formula, Or) and not self._holds(formula, domains):
                fixed = [part for part in formula.args if self._is_fixed(part, domains)]
                if fixed:
                    pending += fixed
                else:
                    yield formula

    def _is_fixed(self, formula: Formula, domains: Domains) -> bool:
        i, signs = self.search.literal(formula)
        return not domains[i] & ~signs

    def _holds(self, formula: Formula, domains: Domains) -> bool:
        """Whether it is true for all signs that are left, as far as its comparisons show."""
        if isinstance(formula, And | Or):
            return (all if isinstance(formula, And) else any)(self._holds(part, domains) for part in formula.args)
        return self._is_fixed(formula, domains)

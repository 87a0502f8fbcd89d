"""Refutations over signs: which lemmas they need, and the cases that the kernel is handed. Nothing here is trusted.

Whatever is derived knows its sources: the lemmas, the clauses and the assumptions on which it rests. So a contradiction
says which of the assumptions exclude each other, and which lemmas are needed (conflict-driven learning: Marques-Silva,
Sakallah 1999).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from qe.errors import BudgetExceeded, Unable
from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Formula, Or, Relation
from qe.kernel.boolean import Goal, Search, Theory
from qe.kernel.clauses import Clauses, Literal
from qe.kernel.signs import ANY, NEGATIVE, POSITIVE, ZERO, Domains, Identity, Lemma, Line
from qe.kernel.step import Limits
from qe.proof.entry import Json

NODES = 2_000
"""Case distinctions for one alternative of what may be wrong, at most."""

Sources = int
"""A set of lemmas, clauses and assumptions: a bit for each."""


class Explained(Clauses):
    """Clauses whose variables know the sources of the signs that are left to them; ``about``: the lemmas on each."""

    def __init__(self, tick: Callable[[], None]) -> None:
        super().__init__(tick)
        self.reasons: list[Sources] = []
        self._conflict: Sources | None = None
        self._listed: list[list[tuple[list[Literal], Sources]]] = []
        self.about: list[list[Lemma]] = []
        self._sources: dict[Lemma, Sources] = {}

    def new(self, signs: int) -> int:
        """As ``Clauses.new``."""
        self.domains.append(signs)
        self.reasons.append(0)
        self._listed.append([])
        self.about.append([])
        return len(self.domains) - 1

    def taught(self, lemma: Lemma, source: Sources) -> None:
        """As ``learn``, with the lemma's own bit."""
        self._sources[lemma] = source
        self._due[lemma] = None
        for i in lemma.polynomials:
            self.about[i].append(lemma)

    def add(self, literals: Iterable[Literal], sources: Sources = 0) -> None:
        """As ``Clauses.add``, with the sources of the clause."""
        joined: dict[int, int] = {}
        for i, signs in literals:
            joined[i] = joined.get(i, 0) | signs
        for i, signs in joined.items():
            sources |= 0 if self.domains[i] & signs else self.reasons[i]
        clause = [(i, signs) for i, signs in joined.items() if self.domains[i] & signs]
        if not clause:
            self._conflict = sources
        for i, signs in clause if len(clause) == 1 else ():
            if self.domains[i] & ~signs:
                self.domains[i] &= signs
                self.reasons[i] |= sources
                self._changed[i] = None
        for i, _ in clause[:2] if len(clause) > 1 else ():
            self._listed[i].append((clause, sources))

    def conflict(self, assumed: Iterable[tuple[Literal, Sources]]) -> tuple[Domains, Sources | None]:
        """The signs that propagation leaves under assumptions, and the sources of a contradiction, if there is one."""
        if self._conflict is None and (self._changed or self._due):
            changed, due, self._changed, self._due = self._changed, self._due, {}, {}
            self._conflict = self._contradiction(self.domains, self.reasons, changed, due)
        if self._conflict is not None:
            return self.domains, self._conflict
        domains, reasons, changed = self.domains.copy(), self.reasons.copy(), {}
        for (i, signs), source in assumed:
            if domains[i] & ~signs:
                domains[i] &= signs
                reasons[i] |= source
                changed[i] = None
        return domains, self._contradiction(domains, reasons, changed, {})

    def _contradiction(
        self, domains: Domains, reasons: list[Sources], changed: dict[int, None], due: dict[Lemma, None]
    ) -> Sources | None:
        while changed or due:
            self._tick()
            if changed:
                i = changed.popitem()[0]
                if not domains[i]:
                    return reasons[i]
                due |= dict.fromkeys(self.about[i])
                changed |= dict.fromkeys(self._made(i, domains, reasons))
                continue
            lemma = due.popitem()[0]
            cut = lemma.cut(domains)
            if cut:
                sources = self._sources[lemma]
                for j in (*lemma.polynomials, *cut):
                    sources |= reasons[j]
                for j in cut:
                    reasons[j] = sources
                changed |= dict.fromkeys(cut)
        return None

    def _made(self, i: int, domains: Domains, reasons: list[Sources]) -> Sequence[int]:
        """The variables whose signs follow from clauses that watch variable i."""
        watching, self._listed[i] = self._listed[i], []
        forced = []
        for watched in watching:
            clause, sources = watched
            k = 0 if clause[0][0] == i else 1
            if not domains[i] & clause[k][1]:
                clause[0], clause[1] = clause[1 - k], clause[k]
                other = next((n for n in range(2, len(clause)) if domains[clause[n][0]] & clause[n][1]), None)
                if other is not None:
                    clause[1], clause[other] = clause[other], clause[1]
                    self._listed[clause[1][0]].append(watched)
                    continue
                j, signs = clause[0]
                if domains[j] & ~signs:
                    domains[j] &= signs
                    for n, _ in clause:
                        sources |= reasons[n]
                    reasons[j] = sources
                    forced.append(j)
            self._listed[i].append(watched)
        return forced


@dataclass(frozen=True, slots=True)
class _Case:
    """A clause by which the kernel goes on."""

    literals: tuple[Literal, ...]


class Refutation:
    """A goal, what is known about its polynomials so far, and the alternatives of its last formula that are not yet
    excluded."""

    def __init__(self, goal: Goal, limits: Limits) -> None:
        self.clauses = Explained(limits.tick)
        self.search = Search(Theory((), (), limits), goal, self.clauses)
        self._outside = len(self.clauses.domains)
        self._sources: list[int | _Case | None] = []
        self._polys: list[int] = []  # the variable of each of the polynomials of the lemmas
        self._split: dict[int, None] = {}
        last = self.search.goal[-1:]
        self.pending: list[list[Literal]] = [[]]
        if last and isinstance(last[0], Or):
            self.pending = [[self.search.literal(case)] for case in last[0].args]
        self._needed: Sources = 0
        self._nodes = self._splits = 0

    def learn(self, polys: Sequence[Poly], lemmas: Sequence[Lemma]) -> None:
        """Lemmas beyond those learned before, about listed polynomials, of which there may be more than before."""
        for poly in polys[len(self._polys) :]:
            self._polys.append(self.search.literal(Atom(poly, Relation.EQ))[0])
        start = sum(isinstance(source, int) for source in self._sources)
        for k, lemma in enumerate(lemmas[start:], start=start):
            renumbered = _renumbered(lemma, self._polys)
            self._split.update(dict.fromkeys(renumbered.polynomials))
            self.clauses.taught(renumbered, self._bit(k))

    def go_on(self, nodes: int, splits: int) -> bool:
        """Whether all alternatives are excluded by now, with so many case distinctions for one of them, and so many
        by the sign of a polynomial."""
        while self.pending:
            self._nodes, self._splits = nodes, splits
            try:
                conflict = self._excluded([(literal, self._bit(None)) for literal in self.pending[0]])
            except BudgetExceeded:
                raise
            except Unable:
                return False
            if conflict is None:
                return False
            self._needed |= conflict
            del self.pending[0]
        return True

    @property
    def lemmas(self) -> list[int]:
        """The numbers of the lemmas that took part."""
        return [source for source in self._used() if isinstance(source, int)]

    def cases(self, numbers: Mapping[Poly, int]) -> list[Json]:
        """The clauses, as evidence in which the polynomials of lemmas have these numbers."""
        places, count = dict[int, int](), len(numbers)
        listed = {self.search.literal(Atom(poly, Relation.EQ))[0]: k for poly, k in numbers.items()}
        for i in range(self._outside):
            if i not in listed:
                places[i], count = count, count + 1
        places |= listed
        used = [source for source in self._used() if isinstance(source, _Case)]
        return [[8 * places[i] + signs for i, signs in case.literals] for case in used]

    def _used(self) -> Iterator[int | _Case | None]:
        return (source for k, source in enumerate(self._sources) if self._needed >> k & 1)

    def _bit(self, source: int | _Case | None) -> Sources:
        self._sources.append(source)
        return 1 << len(self._sources) - 1

    def _excluded(self, assumed: list[tuple[Literal, Sources]]) -> Sources | None:
        """The sources of a contradiction, at once or after clauses that say so of each of the cases."""
        domains, conflict = self.clauses.conflict(assumed)
        if conflict is not None:
            return conflict
        self._nodes -= 1
        if self._nodes < 0:
            raise Unable("too many cases of signs")
        for literal in self._alternatives(domains):
            further = [*assumed, (literal, self._bit(None))]
            conflict = self._excluded(further)
            if conflict is None or not conflict & further[-1][1]:
                return conflict
            self._learned(further, conflict)
            conflict = self.clauses.conflict(assumed)[1]
            if conflict is not None:
                return conflict
        return None

    def _learned(self, assumed: Iterable[tuple[Literal, Sources]], conflict: Sources) -> None:
        """That not all of the assumptions hold that take part in the contradiction."""
        taken = [(literal, bit) for literal, bit in assumed if conflict & bit]
        clause = tuple((i, ANY & ~signs) for (i, signs), _ in taken)
        rest = conflict & ~sum(bit for _, bit in taken)
        self.clauses.add(clause, rest | self._bit(_Case(clause)))

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
        undecided = [i for i in self._split if domains[i] not in (NEGATIVE, ZERO, POSITIVE)]
        if not undecided:
            return []
        self._splits -= 1
        if self._splits < 0:
            raise Unable("too many cases of signs")
        i = max(undecided, key=lambda i: len(self.clauses.about[i]))
        return [(i, s) for s in (NEGATIVE, ZERO, POSITIVE) if domains[i] & s]

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


def _renumbered(lemma: Lemma, numbers: Sequence[int]) -> Lemma:
    """The lemma with the variables of its polynomials."""
    if isinstance(lemma, Line):
        return Line(tuple(numbers[i] for i in lemma.polynomials), lemma.cells)
    return Identity(tuple((unit, tuple((numbers[i], odd) for i, odd in powers)) for unit, powers in lemma.terms))

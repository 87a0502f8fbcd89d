"""The propositional part of the evidence for a Boolean search: clauses that a SAT solver learnt, and of all conflicts
those that a contradiction needs. Nothing here is trusted."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations

from qe.errors import Unable
from qe.extras import lacking
from qe.formula.syntax import FALSE, Atom, Exists
from qe.kernel.block import existential
from qe.kernel.boolean import Search, Theory
from qe.kernel.clauses import Literal
from qe.kernel.signs import ANY, NEGATIVE, POSITIVE, ZERO
from qe.kernel.step import Claim, Limits
from qe.proof.entry import Entry, Json, formula_from_json
from qe.proving.refutation import Explained, Sources

MOST_LEARNT = 20_000
BITS = (POSITIVE, NEGATIVE, ZERO)


def refuted_block(claim: Claim) -> Exists:
    """The block of a sentence that is claimed to be false (or true, if it is universal: then that of its negation)."""
    before, after = existential(claim)
    if not isinstance(before, Exists) or before.free or not before.body.is_quantifier_free or after != FALSE:
        raise claim.fail("expected a sentence of one block, which is false")
    return before


class Numbered(Explained):
    """The same clauses for a SAT solver: a polynomial has three numbers, for > 0, < 0 and = 0; a condition has one.

    ``listed``: the clauses by such numbers; ``count``: how many were added, each with its place as the bit of a source.
    """

    def __init__(self, limits: Limits) -> None:
        super().__init__(limits.tick)
        self.listed: list[list[int]] = []
        self.count = 0
        self._meanings: list[tuple[int, int]] = [(0, 0)]
        self._first: list[int] = []
        self._boolean: list[bool] = []

    def new(self, signs: int) -> int:
        """As ``Clauses.new``; of three signs, one holds."""
        i, first = super().new(signs), len(self._meanings)
        self._first.append(first)
        self._boolean.append(signs != ANY)
        self._meanings += [(i, bit) for bit in (BITS if signs == ANY else BITS[:1])]
        if signs == ANY:
            numbers = range(first, first + 3)
            self.listed += [[*numbers], *([-k, -n] for k, n in combinations(numbers, 2))]
        elif signs == POSITIVE:
            self.listed.append([first])
        return i

    def add(self, literals: Iterable[Literal], sources: Sources = 0) -> None:
        """As ``Clauses.add``."""
        listed = list(literals)
        super().add(listed, sources | 1 << self.count)
        self.count += 1
        self.listed.append([*map(self._number, listed)])

    def _number(self, literal: Literal) -> int:
        """The number of a literal, negated where it excludes that."""
        i, signs = literal
        if self._boolean[i]:
            return self._first[i] if signs & POSITIVE else -self._first[i]
        return self._first[i] + BITS.index(signs) if signs in BITS else -self._first[i] - BITS.index(ANY & ~signs)

    def clause(self, numbers: Iterable[int]) -> list[Literal]:
        """The literals with these numbers."""
        by_variable: dict[int, int] = {}
        for number in numbers:
            i, bit = self._meanings[abs(number)]
            signs = bit if number > 0 else NEGATIVE if self._boolean[i] else ANY & ~bit
            by_variable[i] = by_variable.get(i, 0) | signs
        return list(by_variable.items())


def search(claim: Claim, refuted: Sequence[Sequence[Atom]], limits: Limits) -> Numbered:
    """The clauses of a sentence that is claimed to be false, and of comparisons that do not hold together."""
    clauses = Numbered(limits)
    Search(Theory((), (), limits, tuple(map(tuple, refuted))), (refuted_block(claim).body,), clauses)
    return clauses


def conflicts(entry: Entry, claim: Claim) -> list[list[Atom]]:
    """The comparisons of each entry of ``refuted``."""
    listed = [e.fields("atoms", "steps")[0].items() for e in entry.items()]
    read = [[(e, formula_from_json(e, claim.ring)) for e in items] for items in listed]
    for e, a in (pair for pairs in read for pair in pairs):
        if not isinstance(a, Atom):
            raise e.fail("expected a comparison")
    return [[a for _, a in pairs if isinstance(a, Atom)] for pairs in read]


def with_clauses(claim: Claim, limits: Limits) -> dict[str, Json]:
    """The evidence with the clauses that follow one from the other, and without conflicts that nothing rests on.

    Raises ``CertificateRejected`` where the conflicts do not exclude all cases.
    """
    entry = claim.evidence.fields("refuted")[0]
    refuted = conflicts(entry, claim)
    clauses = search(claim, refuted, limits)
    given, learnt, used = clauses.count, list[list[Literal]](), list[Sources]()
    for clause in map(clauses.clause, _learnt(clauses.listed)):
        reasons = clauses.conflict([((i, ANY & ~signs), 0) for i, signs in clause])[1]
        if reasons is not None:
            clauses.add(clause)
            learnt.append(clause)
            used.append(reasons)
    needed = clauses.conflict(())[1]
    if needed is None:
        raise claim.fail("not all cases are excluded")
    for k in reversed(range(len(learnt))):
        needed |= used[k] if needed >> (given + k) & 1 else 0
    assert isinstance(entry.value, list)  # it has been read
    kept = [part for k, part in enumerate(entry.value, start=given - len(refuted)) if needed >> k & 1]
    cases: list[Json] = [
        [0, [8 * i + signs for i, signs in clause]] for k, clause in enumerate(learnt) if needed >> (given + k) & 1
    ]
    return {"theory": {"polynomials": [], "lemmas": [], "cases": cases, "refuted": kept}}


def _learnt(clauses: list[list[int]]) -> Iterator[list[int]]:
    """The clauses that a solver learns until it finds a contradiction."""
    try:
        from pysat.solvers import Solver
    except ImportError as error:
        raise lacking(error) or error from None
    with Solver(name="glucose4", bootstrap_with=clauses, with_proof=True) as solver:
        if solver.solve():
            return
        lines = [line.split() for line in solver.get_proof() or ()]
    derived = [[int(word) for word in words[:-1]] for words in lines if words and words[0] != "d"]
    if len(derived) > MOST_LEARNT:
        raise Unable(f"a refutation of more than {MOST_LEARNT} clauses")
    yield from (clause for clause in derived if clause)

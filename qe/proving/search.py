"""The propositional part of the evidence for the rule "Boolean search": clauses that a SAT solver learnt, and of all
conflicts those that a contradiction needs. Nothing here is trusted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from qe.errors import Unable
from qe.extras import lacking
from qe.formula.syntax import Atom
from qe.kernel.block import refuted_block
from qe.kernel.boolean_search import Cases
from qe.kernel.step import Claim, Limits
from qe.proof.entry import Json, formula_from_json

MOST_LEARNT = 20_000


def with_clauses(claim: Claim, limits: Limits) -> dict[str, Json]:
    """The evidence with the clauses that follow one from the other, and without conflicts that nothing rests on.

    Raises ``CertificateRejected`` where the conflicts do not exclude all cases.
    """
    entry = claim.evidence.fields("refuted")[0]
    cases, numbers = Cases(refuted_block(claim).body, limits.tick), []
    for refuted in entry.items():
        listed = refuted.fields("atoms", "steps")[0]
        cases.exclude([a for e in listed.items() if isinstance(a := formula_from_json(e, claim.ring), Atom)])
        numbers.append(len(cases.clauses.clauses) - 1)
    given = len(cases.clauses.clauses)
    learnt, used = [], []
    for clause in _learnt(cases.clauses.clauses):
        reasons = cases.clauses.implying(clause)
        if reasons is not None:
            cases.clauses.add(clause)
            learnt.append(clause)
            used.append(reasons)
    last = cases.clauses.implying(())
    if last is None:
        raise claim.fail("not all cases are excluded")
    needed = set(last)
    for k in reversed(range(len(learnt))):
        if given + k in needed:
            needed |= used[k]
    assert isinstance(entry.value, list)  # it has been read
    return {
        "refuted": [part for part, number in zip(entry.value, numbers, strict=True) if number in needed],
        "learnt": [list(clause) for k, clause in enumerate(learnt) if given + k in needed],
    }


def _learnt(clauses: Sequence[Sequence[int]]) -> Iterator[list[int]]:
    """The clauses that a solver learns until it finds a contradiction."""
    try:
        from pysat.solvers import Solver
    except ImportError as error:
        raise lacking(error) or error from None
    with Solver(name="glucose4", bootstrap_with=[list(c) for c in clauses], with_proof=True) as solver:
        if solver.solve():
            return
        lines = [line.split() for line in solver.get_proof() or ()]
    found = [[int(word) for word in words[:-1]] for words in lines if words and words[0] != "d"]
    if len(found) > MOST_LEARNT:
        raise Unable(f"a refutation of more than {MOST_LEARNT} clauses")
    yield from (clause for clause in found if clause)

"""Rule "comprehensive Gröbner system" for sentences that are false: no conjunction of the body has a real solution.

THEOREM. ex v. f is false if f is a disjunction of conjunctions each of which has, among its members, equations and
conditions that no real point satisfies. all v. f is the negation of ex v. not f.

Evidence: ``systems``, each as for the rule "solutions", with no solution.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from qe.errors import Unable
from qe.expert.solutions import check_solutions
from qe.formula.build import convert
from qe.formula.syntax import FALSE, And, Constant, Formula, Or
from qe.formula.traverse import conjuncts
from qe.kernel.block import refuted_block
from qe.kernel.negation import normal
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import Entry

MOST_CONJUNCTIONS = 200


def check_no_solutions(claim: Claim, context: Context, limits: Limits) -> None:
    """The systems are checked, and every conjunction has the system of one of them among its members."""
    entry = only(claim, "systems")[0]
    before = refuted_block(claim)
    refuted = [_system(part, claim, limits) for part in entry.items()]
    for members in conjunctions(normal(before.body)):
        limits.tick()
        if FALSE not in members and not any(system <= members for system in refuted):
            raise entry.fail("a conjunction of the sentence is not refuted")


def _system(entry: Entry, claim: Claim, limits: Limits) -> frozenset[Formula]:
    """The equations and conditions that evidence refutes."""
    system, solutions = check_solutions(entry, limits)
    if solutions != FALSE:
        raise entry.fail("expected no solution")
    if not set(system.free) <= set(claim.ring.names):
        raise entry.fail("other variables than those of the sentence")
    return frozenset(conjuncts(convert(system, claim.ring)))


def conjunctions(formula: Formula) -> Iterator[frozenset[Formula]]:
    """The disjunctive normal form of a formula in negation normal form. Raises ``Unable`` where it is long."""
    for count, members in enumerate(_choices(formula)):
        if count >= MOST_CONJUNCTIONS:
            raise Unable(f"a sentence has more than {MOST_CONJUNCTIONS} conjunctions")
        yield members


def _choices(formula: Formula) -> Iterator[frozenset[Formula]]:
    match formula:
        case Or(args):
            for arg in args:
                yield from _choices(arg)
        case And(args):
            for chosen in product(*map(_choices, args)):
                yield frozenset().union(*chosen)
        case Constant(value):
            yield from (frozenset(),) if value else ()
        case _:
            yield frozenset((formula,))

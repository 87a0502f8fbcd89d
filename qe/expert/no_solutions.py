"""Rule "comprehensive Gröbner system" for sentences that are false: no conjunction of the body has a real solution.

THEOREM. ex v. f is false if f is a disjunction of conjunctions each of which has, among its members, equations and
conditions that no real point satisfies. all v. f is the negation of ex v. not f.

Evidence: ``certificates``, each of kind "solutions" with no solution.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from qe.errors import Unable
from qe.expert.solutions import system_of
from qe.formula.build import convert
from qe.formula.syntax import FALSE, And, Constant, Formula, Or
from qe.kernel.block import refuted_block
from qe.kernel.negation import normal
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.certificate import Kind
from qe.proof.entry import Entry

MOST_CONJUNCTIONS = 200


def check_no_solutions(claim: Claim, context: Context, limits: Limits) -> None:
    """The certificates are checked, and every conjunction has the system of one of them among its members."""
    entry = only(claim, "certificates")[0]
    before = refuted_block(claim)
    refuted = [_system(part, claim, limits) for part in entry.items()]
    for members in conjunctions(normal(before.body)):
        limits.tick()
        if FALSE not in members and not any(system <= members for system in refuted):
            raise entry.fail("a conjunction of the sentence is not refuted")


def _system(entry: Entry, claim: Claim, limits: Limits) -> frozenset[Formula]:
    """The equations and conditions that a certificate refutes."""
    certificate = limits.leaf(entry)
    if certificate.kind != Kind.SOLUTIONS or not isinstance(certificate.payload, dict):
        raise entry.fail("expected a certificate of kind solutions")
    ring, parts, solutions = system_of(Entry(certificate.payload, f"{entry.path}.payload"))
    if solutions.value != []:
        raise solutions.fail("expected no solution")
    if not set(ring.names) <= set(claim.ring.names):
        raise entry.fail("other variables than those of the sentence")
    return frozenset(convert(part, claim.ring) for part in parts)


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

"""Steps of the kernel for what methods say about one block of few variables: a decomposition, which has the answer's
polynomials among its factors, is small where the answer is known."""

from __future__ import annotations

from contextlib import suppress

from qe.elimination.cad import certificate_for
from qe.elimination.rootsigns.question import read
from qe.errors import CertificateRejected
from qe.expert.solutions import check_solutions
from qe.formula.build import atom, conj, convert, disj, exists, map_children
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, Exists, Formula, Relation
from qe.kernel.step import only
from qe.options import Options
from qe.proving.made import Made
from qe.proving.search import refuted_block

WORK = 50_000
"""Units of work for a decomposition."""


def decomposed(made: Made, after: Formula) -> None:
    """The step by a decomposition of the block."""
    tabulated(made, made.current, after)


def tabulated(made: Made, before: Formula, after: Formula) -> None:
    """A step by a decomposition; ``BudgetExceeded`` where it is too large."""
    if not after.is_quantifier_free or not set(before.free) >= set(after.free):
        raise made.claim.fail("an answer without quantifiers, and without other variables, expected")
    certificate = certificate_for(before, after, Options(), made.limits.budget.part(WORK))
    if certificate is None:
        raise made.claim.fail("nothing to decompose")
    made.step("cells", before, after, certificate.single_step["evidence"])


def counted(made: Made, after: Formula) -> None:
    """A block over equations, by a decomposition; a sentence that is false also by ``systems``, with evidence as for
    the rule "solutions" that they have none: each conjunction of the body has one of them among its members."""
    claim = made.claim
    systems = only(claim, optional=("systems", "proofs"))[0]
    if systems.value is None:
        decomposed(made, after)
        return
    from qe.elimination.cgs import conjunctions

    refuted = [(convert(check_solutions(entry, made.limits)[0], claim.ring), entry.value) for entry in systems.items()]
    before = refuted_block(claim)
    cases = [exists(before.variables, conj(members)) for members in conjunctions(before.body)]
    made.signs(before, disj(cases))
    while made.current != FALSE:
        for system, evidence in refuted:
            with suppress(CertificateRejected):
                made.step("solutions", system, FALSE, evidence)
                break
        else:
            raise systems.fail("a conjunction of the sentence is not refuted")


def roots_by_signs(made: Made, after: Formula) -> None:
    """A block about one polynomial: a decomposition where its leading coefficient is not 0; where it is, the lower
    terms stay, and an interval is mapped to y > 0 by l + y, u - y, or (l + u*y)/(1 + y)."""
    before, ring = made.current, made.ring
    if after.is_quantifier_free:
        decomposed(made, after)
        return
    if not isinstance(before, Exists) or len(before.variables) != 1:
        raise made.claim.fail("a block of one variable expected")
    (name,) = before.variables
    question = read(before.body, ring.index[name])
    if question is None:
        raise made.claim.fail("not a question about one polynomial")
    lower, lead = nnf(question.degenerate(ring.index[name])), question.f[-1]
    cases = [exists((name,), conj((atom(lead, rel), before.body))) for rel in (Relation.NE, Relation.EQ)]
    regular = conj((atom(lead, Relation.NE), _without(after, lower)))
    known = conj((question.side, atom(lead, Relation.EQ)))
    body = lower.body if isinstance(lower, Exists) else lower
    moved = exists((name,), conj((known, body)))
    made.signs(before, disj(cases))
    tabulated(made, cases[0], regular)
    there, back = question.terms(ring.gen(ring.index[name]))
    made.terms(cases[1], moved, {name: there}, {name: back})
    made.moved(moved, conj((known, lower)))
    made.simplified(made.current, after)


def _without(formula: Formula, block: Formula) -> Formula:
    """The formula with false for a block."""
    return FALSE if formula == block else map_children(formula, lambda part: _without(part, block))

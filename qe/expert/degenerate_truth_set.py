"""Rule "degenerate truth set": a universal block is false, or its parameters satisfy a linear equation.

THEOREM. all y F implies F[v/y] for every number v. So if such instances have no common solution, all y F is false. If
they have none with p < 0 and none with p > 0, where p = c*u + r with a number c /= 0 and r free of u, then all y F iff
p = 0 and all y F[(-r/c)/u].

Evidence: ``variable`` y, ``values`` v, ``equation`` ([u, p], or null), ``parts``: steps to false from the sentence that
the instances have a common solution; with an equation two lists, for p < 0 and for p > 0.
"""

from __future__ import annotations

from qe.formula.build import atom, conj, exists
from qe.formula.syntax import FALSE, TRUE, ForAll, Formula, Relation
from qe.kernel.linear_equation import substituted, term
from qe.kernel.negation import normal
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.substitution import at_number


def check_degenerate_truth_set(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    variable, values, equation, parts = only(claim, "variable", "values", "equation", "parts")
    block, name = claim.before, variable.text()
    if not isinstance(block, ForAll) or block.variables != (name,) or not block.body.is_quantifier_free:
        raise variable.fail("expected the one variable of a universal block over a quantifier-free formula")
    y = claim.ring.index[name]
    instances = conj(at_number(block.body, y, v.rational(), claim) for v in values.items())
    cases: list[Formula] = [TRUE]
    expected: Formula = FALSE
    if equation.value is not None:
        pivot = term(equation, block.free, block, claim)
        p = pivot.equation
        if name in atom(p, Relation.EQ).free:
            raise equation.fail("an equation of the parameters expected")
        cases = [atom(p, Relation.LT), atom(p, Relation.GT)]
        expected = conj((atom(p, Relation.EQ), substituted(pivot, claim)))
    lists = list(parts.items())
    if len(lists) != len(cases):
        raise parts.fail(f"expected {len(cases)} lists of steps")
    for steps, case in zip(lists, cases, strict=True):
        body = conj((instances, case))
        if limits.replay(steps, exists(body.free, body), (), claim.ring) != FALSE:
            raise steps.fail("not shown that the instances have no common solution")
    if normal(claim.after) != normal(expected):
        raise claim.fail("not what the theorem gives")

"""Rule "infinity first": solutions near infinity, and what remains by the sign of a polynomial in the parameters.

THEOREM. Let S be F(-oo) or F(+oo), the truth of F for all sufficiently small, or large, x (``virtual_substitution``).
If S holds, then some x satisfies F. So ex x F iff S or ex x (F and not S), and the latter iff ex x (F and not S
and C) holds for one of several conditions C that are comparisons of one polynomial with 0 and leave out no sign of it.

Evidence: ``variable``, ``cases`` (the conditions C; "true" alone where none are distinguished), ``parts``: steps from S
to a formula S', then for each case steps from ex x (F and not S' and C) on. The claim is the disjunction of what they
lead to.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.formula.build import conj, disj, exists
from qe.formula.syntax import TRUE, Atom, Exists, Formula
from qe.formula.traverse import has_root_atoms
from qe.kernel.block import existential
from qe.kernel.negation import negation, normal
from qe.kernel.step import Claim, Context, Limits, only, outside
from qe.kernel.virtual_substitution import TestPoint, put
from qe.proof.entry import formula_from_json


def check_infinity_first(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    variable, cases, parts = only(claim, "variable", "cases", "parts")
    (before, after), name = existential(claim), variable.text()
    if not isinstance(before, Exists) or before.variables != (name,) or not before.body.is_quantifier_free:
        raise variable.fail("expected the one variable of a block over a quantifier-free formula")
    if has_root_atoms(before.body):
        raise claim.fail("no root atoms expected")
    x = claim.ring.index[name]
    known = outside(context, [name])
    listed = [formula_from_json(entry, claim.ring) for entry in cases.items()]
    if not _leave_out_nothing(listed):
        raise cases.fail("expected comparisons of one polynomial with 0 that leave out no sign")
    lists = list(parts.items())
    if len(lists) != len(listed) + 1:
        raise parts.fail(f"expected {len(listed) + 1} lists of steps")
    far = disj(put(before.body, x, TestPoint((), 0, side)) for side in (-1, 1))
    found = [limits.replay(lists[0], far, known, claim.ring)]
    for steps, case in zip(lists[1:], listed, strict=True):
        rest = exists([name], conj((before.body, negation(found[0]), case)))
        found.append(limits.replay(steps, rest, known, claim.ring))
    if normal(disj(found)) != after:
        raise claim.fail("not the disjunction to which the parts lead")


def _leave_out_nothing(cases: Sequence[Formula]) -> bool:
    if list(cases) == [TRUE]:
        return True
    found = [a for a in cases if isinstance(a, Atom)]
    signs = frozenset[int]().union(*(a.relation.signs for a in found))
    return len(found) == len(cases) and len({a.poly for a in found}) == 1 and len(signs) == 3

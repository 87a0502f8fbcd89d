"""Rule "elimination set": a quantified variable replaced by finitely many test points.

Evidence: ``variable`` x; ``side`` s (1, -1, or 0 for sets without radicals, with ``quadratics``); ``points``, tried
in their order, each with ``point``, ``guard``, ``formula`` (null: the whole), ``settled``; ``parts``: for each point
the steps from (exists the other variables. guard and formula at the point) on. The claim is that exists x, ... F is
equivalent to the disjunction of the formulas to which these steps lead.

THEOREM. Let F be an and/or combination of atoms with factors of degree at most 2 in x. The disjunction implies exists
x. F, because every guard makes its point real, every formula implies F, and strict atoms that hold at a root hold
next to it (``settled``). It is implied by exists x. F, if for s = 1 (for s = -1 in the mirror)
* -oo is a point, with a guard that holds where F can hold there, and
* at every place where F can turn true on the way from -oo, a point is tried with a formula that holds there.
If F turns true somewhere, so does each disjunct that is true there, and one conjunct beside the others, which hold
there; an atom does at its turning points (``turning_points``). A conjunct made of equations by and/or, with an
equation on each way through its ors, has only these equations' roots as solutions, unless one of them vanishes
identically: then (and then only) the ends of the others, and -oo, are needed; equations joined by "or" alone hold for
all x there. (Gauss.) A strict atom p that is a conjunct of the formula of a point e + epsilon may be taken at e
itself (*settled*) if all points where p can turn true have been tried before with formulas implied by this one: if
p(e) = 0, then p turns true at e. Loos & Weispfenning 1993; Weispfenning 1997; Kosta 2016. Sets without radicals: see
``radical_free``.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj, disj, exists
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import conjuncts
from qe.kernel.elimination_points import Tried, read_points
from qe.kernel.radical_free import replaced_ends
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.turning_cover import Cover, Met
from qe.proof.entry import Entry


def check_elimination_set(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    variable, side, quadratics, points, parts = only(claim, "variable", "side", "quadratics", "points", "parts")
    block, name, x = claim.variable(variable)
    if not block.body.is_quantifier_free:
        raise claim.fail("expected a quantifier-free formula in the block")
    tried = read_points(points, block.body, x, claim.ring)
    direction = side.integer(-1)
    if direction > 1:
        raise side.fail("expected -1, 0 or 1")
    omitted = [q.polynomial(claim.ring) for q in quadratics.items()]
    if claim.after != TRUE:  # which follows from one point alone
        try:
            require_cover(Cover(x, block.body, tried, limits), block.body, direction, omitted)
        except CertificateRejected as error:
            raise points.fail(error.reason) from None
    starts = [start(t, x, name, block.variables, claim.ring) for t in tried]
    check_parts(claim, starts, parts, context, limits)


def require_cover(cover: Cover, body: Formula, side: int, quadratics: Sequence[Poly]) -> list[Met]:
    """What is used of the points. ``CertificateRejected`` (without a path) unless they are an elimination set."""
    found = _one_side(cover, body, side) if side else replaced_ends(cover, body, quadratics)
    for k, tried in enumerate(cover.tried):
        if tried.settled:
            cover.check_settled(k)
    return found


def check_parts(claim: Claim, starts: Sequence[Formula], parts: Entry, context: Context, limits: Limits) -> None:
    """``claim.after`` is the disjunction of the formulas to which the steps lead, one list of steps for each start."""
    listed = list(parts.items())
    if len(listed) != len(starts):
        raise parts.fail(f"expected {len(starts)} lists of steps")
    found = [limits.replay(steps, formula, context, claim.ring) for formula, steps in zip(starts, listed, strict=True)]
    if disj(found) != claim.after:
        raise claim.fail("not the disjunction to which the parts lead")


def start(tried: Tried, x: int, name: str, block: Sequence[str], ring: Ring) -> Formula:
    """What a point adds to the disjunction, before its steps."""
    if tried.point is None:
        return block_of(block, conj((tried.guard, tried.formula)), ring)
    return block_of([v for v in block if v != name], tried.result(x), ring)


def block_of(names: Collection[str], body: Formula, ring: Ring) -> Formula:
    """``exists names. body``, with the variables that occur, in the order of the ring."""
    return exists([v for v in ring.names if v in names and v in body.free], body)


def _one_side(cover: Cover, body: Formula, side: int) -> list[Met]:
    """All places are met at which the body can be true first, coming from one side."""
    args = conjuncts(body)
    for k, arg in enumerate(args):
        for used, degenerate in cover.finite(arg, args[:k] + args[k + 1 :]):
            left = [] if degenerate == FALSE else cover.kept((degenerate,))
            if left is not None:
                return [*used, *left]
            far, near = cover.far(body, side, (degenerate,)), cover.ends(body, (), side, (degenerate,))
            if far is not None and near is not None:
                return [*used, *far, *near]
    far, near = cover.far(body, side, ()), cover.ends(body, (), side)
    if far is None or near is None:
        raise CertificateRejected("", f"no point for {cover.missing}")
    return [*far, *near]

"""Rule "elimination set": a quantified variable replaced by finitely many test points.

Evidence: ``variable`` x; ``exponent`` d; ``side`` s (1, -1, or 0 for sets without radicals, with ``quadratics``);
``points``, tried in their order, each with ``point``, ``guard``, ``formula`` (null: the whole), ``settled``; ``parts``:
for each point the steps from (exists the other variables. guard and formula at the point) on. The claim is that
exists x, ... F is equivalent to the disjunction of the formulas to which these steps lead.

THEOREM. Let F be an and/or combination of atoms with factors of degree at most 2 in x. The disjunction implies
exists x. F, because every guard makes its point real, every formula implies F, and strict atoms that hold at a root hold
next to it (``settled``). It is implied by exists x. F, if for s = 1 (for s = -1 in the mirror)
* -oo is a point, with a guard that holds where F can hold there, and
* at every place where F can turn true on the way from -oo, a point is tried with a formula that holds there.
If F turns true somewhere, so does each disjunct that is true there, and one conjunct beside the others, which hold there;
an atom does at its turning points (``turning_points``). A conjunct made of equations by and/or, with an equation on each
way through its ors, has only these equations' roots as solutions, unless one of them vanishes identically: then (and then
only) the ends of the others, and -oo, are needed; equations joined by "or" alone hold for all x there. (Gauss.)
A strict atom p that is a conjunct of the formula of a point e + epsilon may be taken at e itself (*settled*) if all points
where p can turn true have been tried before with formulas implied by this one: if p(e) = 0, then p turns true at e.
Degree shift: exists x. F(x^d) iff exists x. F(x), and x >= 0 if d is even, x > 0 if moreover the solutions are open.
Loos & Weispfenning 1993; Weispfenning 1997; Dolzmann, Sturm & Weispfenning 1998; Kosta 2016. Sets without radicals: see
``radical_free``.
"""

from __future__ import annotations

from qe.certify.elimination_points import Tried, implies, read_points
from qe.certify.lowered_degree import lowered
from qe.certify.radical_free import replaced_ends
from qe.certify.step import Claim, Context, Limits, only
from qe.certify.turning_cover import Cover, mixed
from qe.errors import CertificateRejected
from qe.formula.build import conj, disj, exists
from qe.formula.syntax import FALSE, Exists, Formula
from qe.formula.traverse import conjuncts
from qe.proof.entry import Entry


def check_elimination_set(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    variable, exponent, side, quadratics, points, parts = only(
        claim, "variable", "exponent", "side", "quadratics", "points", "parts"
    )
    block = claim.before
    if not isinstance(block, Exists) or not block.body.is_quantifier_free:
        raise claim.fail("an existential block over a quantifier-free formula expected")
    name = variable.text()
    if name not in block.variables or name not in claim.ring.index:
        raise variable.fail("a variable of the block expected")
    x = claim.ring.index[name]
    shift = exponent.integer(1)
    body = lowered(block.body, x, shift, exponent)
    tried = read_points(points, body, block.body, x, shift, claim.ring)
    direction = {-1: -1, 0: 0, 1: 1}.get(side.integer(-1))
    if direction is None:
        raise side.fail("expected -1, 0 or 1")
    cover = Cover(x, tuple(tried), limits)
    try:
        if direction:
            _check_side(cover, body, block.body, direction)
        else:
            replaced_ends(cover, body, [q.polynomial(claim.ring) for q in quadratics.items()])
        for k, point in enumerate(tried):
            if point.settled:
                cover.check_settled(k)
    except CertificateRejected as error:
        raise points.fail(error.reason) from None
    rest = tuple(v for v in block.variables if v != name)
    starts = [_start(t, x, name, rest) for t in tried]
    check_parts(claim, starts, parts, context, limits)


def check_parts(claim: Claim, starts: list[Formula], parts: Entry, context: Context, limits: Limits) -> None:
    """``claim.after`` is the disjunction of the formulas to which the steps lead, one list of steps for each start."""
    listed = list(parts.items())
    if len(listed) != len(starts):
        raise parts.fail(f"expected {len(starts)} lists of steps")
    found = [limits.replay(steps, start, context, claim.ring) for start, steps in zip(starts, listed, strict=True)]
    if disj(found) != claim.after:
        raise claim.fail("not the disjunction to which the parts lead")


def _start(tried: Tried, x: int, name: str, rest: tuple[str, ...]) -> Formula:
    if tried.point is None:
        return exists((name, *rest), conj((tried.guard, tried.formula)))
    return exists(rest, tried.result(x))


def _check_side(cover: Cover, body: Formula, original: Formula, side: int) -> None:
    """All places are met at which the body can be true first, coming from one side."""
    args = conjuncts(body)
    for k, arg in enumerate(args):
        beside = args[:k] + args[k + 1 :]
        for degenerate in cover.finite(arg, beside):
            if degenerate == FALSE or _rest(cover, degenerate, arg, original):
                return
            if cover.far(body, side, (degenerate,)) and cover.ends(body, (), side, (degenerate,)):
                return
    if not cover.far(body, side, ()):
        raise CertificateRejected("", "a point at infinity is missing")
    if not cover.ends(body, (), side, ()):
        raise CertificateRejected("", f"no point for {cover.missing}")


def _rest(cover: Cover, degenerate: Formula, gauss: Formula, original: Formula) -> bool:
    """Whether the problem that is left where a conjunct holds for all x is one of the points."""
    if mixed(gauss):
        return False
    whole = conj((degenerate, original))
    return any(t.point is None and implies(whole, conj((t.guard, t.formula))) for t in cover.tried)

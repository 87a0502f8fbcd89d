"""Rule "conditions on zeros that follow": conjuncts about which variables are 0 that the other conjuncts imply.

THEOREM. Let every atom of g be p = 0 or p /= 0 for a product p of variables from a set V. The truth of g depends only
on which variables of V are 0. If f is false at all points of every pattern of zeros that makes g false, then f implies
g, so that f and g <-> f; dually f or g <-> f where not f implies not g.

No evidence: the patterns are gone through here, at most 2**6. That f is false on one is seen from polynomials of which
the zeros leave nothing, a number, or one term with even powers of variables of V that are not 0 there.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Or, Relation
from qe.formula.traverse import atoms, conjuncts, disjuncts
from qe.kernel.step import Claim, Context, Limits, only

_MOST = 6
_EITHER = frozenset((-1, 1))
_ALL = frozenset((-1, 0, 1))


def check_zeros(claim: Claim, context: Context, limits: Limits) -> None:
    """The parts left out hold on every pattern that the parts kept allow (universally: fail)."""
    only(claim)
    before, after = claim.before, claim.after
    if not isinstance(before, Exists | ForAll) or type(after) is not type(before):
        raise claim.fail("a block and the same block with fewer conditions expected")
    split, wanted = (conjuncts, True) if isinstance(before, Exists) else (disjuncts, False)
    kept = set(split(after.body))
    whole = split(before.body)
    gone = [part for part in whole if part not in kept]
    if after.variables != before.variables or not kept <= set(whole):
        raise claim.fail("not the block with some of its conditions left out")
    names = {claim.ring.index[name] for part in gone for name in part.free}
    if len(names) > _MOST or not all(map(_is_about_zeros, gone)):
        raise claim.fail("what is left out is not a condition on the zeros of a few variables")
    for chosen in product((True, False), repeat=len(names)):
        limits.tick()
        vanish = dict(zip(sorted(names), chosen, strict=True))
        if all(_truth(part, vanish) is wanted for part in gone):
            continue
        if not any(_truth(part, vanish) is not wanted and _truth(part, vanish) is not None for part in kept):
            zero = ", ".join(f"{claim.ring.names[i]} {'=' if z else '/='} 0" for i, z in vanish.items())
            raise claim.fail(f"the other conditions are not seen to exclude {zero}")


def _is_about_zeros(part: Formula) -> bool:
    if not part.is_quantifier_free:
        return False
    return all(
        isinstance(a, Atom) and a.relation in (Relation.EQ, Relation.NE) and len(a.poly.terms()) == 1
        for a in atoms(part)
    )


def _truth(part: Formula, vanish: dict[int, bool]) -> bool | None:
    """The truth at all points of a pattern; None where it is not seen."""
    match part:
        case Atom(poly, relation):
            possible = {relation.holds(sign) for sign in _signs(poly, vanish)}
            return possible.pop() if len(possible) == 1 else None
        case And(args) | Or(args):
            values = [_truth(a, vanish) for a in args]
            strong = isinstance(part, Or)
            if strong in values:
                return strong
            return None if None in values else not strong
    return None


def _signs(poly: Poly, vanish: dict[int, bool]) -> frozenset[int]:
    left = list(_left(poly, vanish))
    if not left:
        return frozenset((0,))
    exponents, coefficient = left[0]
    powers = {i: power for i, power in enumerate(exponents) if power}
    if len(left) > 1 or not all(i in vanish for i in powers):
        return _ALL
    if any(power % 2 for power in powers.values()):
        return _EITHER
    return frozenset((1 if coefficient > 0 else -1,))


def _left(poly: Poly, vanish: dict[int, bool]) -> Iterator[tuple[tuple[int, ...], int]]:
    """The terms that the zeros leave."""
    for exponents, coefficient in poly.terms():
        if not any(power and vanish.get(i, False) for i, power in enumerate(exponents)):
            yield exponents, coefficient

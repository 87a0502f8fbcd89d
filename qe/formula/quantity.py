"""Quantifiers that say how many: infinitely many, all but finitely many, exactly k, and that a set is connected.

All are said by ex and all. A formula is true on finitely many intervals and points of a line. So it is true at
infinitely many x iff it is on an open interval; and where it is quantifier-free, iff its *interior form* is true at
some x: p = 0 becomes "all coefficients of p in x are 0", p >= 0 becomes p > 0 or that, p > 0 and p /= 0 stay.

THEOREM. Let f be quantifier-free without negations, g its interior form, the other variables fixed. f holds at
infinitely many x iff g holds at some x. Proof: where g holds at x0, p > 0 and p /= 0 that hold there do so near x0, and
polynomials that are 0 everywhere stay so; hence f holds near x0. If f holds on an interval, take x0 in it where no
polynomial of f that is not 0 everywhere vanishes: comparisons of f that hold there hold in g.
"""

from __future__ import annotations

from itertools import pairwise

from qe.formula.build import atom, conj, disj, exists, forall, implies, neg
from qe.formula.normal import nnf
from qe.formula.openness import thinned
from qe.formula.syntax import TRUE, Formula, Relation
from qe.formula.traverse import has_root_atoms, map_atoms

MOST = 20
"""The largest number that is counted."""


def at(body: Formula, name: str, other: str) -> Formula:
    """The formula with another variable, which it does not have, for one."""
    ring = body.ring
    if ring is None or name not in ring.index:
        return body
    x, new = ring.index[name], ring.var(other)
    return map_atoms(body, lambda a: atom(a.poly.compose({x: new}), a.relation))


def infinitely_many(name: str, body: Formula, spare: list[str]) -> Formula:
    """That infinitely many values satisfy the body; ``spare``: two names that are not in use."""
    ring = body.ring
    if ring is None or name not in ring.index or name not in body.free:
        return body
    if body.is_quantifier_free and not has_root_atoms(body):
        return exists((name,), thinned(nnf(body), (ring.index[name],)))
    x, low, high = (ring.var(n) for n in (name, *spare[:2]))
    between = conj((atom(low - x, Relation.LT), atom(x - high, Relation.LT)))
    return exists(spare[:2], conj((atom(low - high, Relation.LT), forall((name,), implies(between, body)))))


def almost_all(name: str, body: Formula, spare: list[str]) -> Formula:
    """That all values but finitely many satisfy the body."""
    return nnf(infinitely_many(name, nnf(body, negate=True), spare), negate=True)


def at_least(k: int, name: str, body: Formula, spare: list[str]) -> Formula:
    """That k different values satisfy the body; ``spare``: k names."""
    if k == 0 or name not in body.free:
        return body if k else TRUE
    return exists(spare[:k], _rising(name, body, spare[:k]))


def _rising(name: str, body: Formula, values: list[str]) -> Formula:
    """That the body holds at all of these values, each less than the next."""
    ring = body.ring
    assert ring is not None
    ordered = [atom(ring.var(low) - ring.var(high), Relation.LT) for low, high in pairwise(values)]
    return conj((*ordered, *(at(body, name, value) for value in values)))


def exactly(k: int, name: str, body: Formula, denied: Formula, spare: list[str]) -> Formula:
    """That k different values satisfy the body and no other; ``denied``: the body where it stands negated; ``spare``:
    k names."""
    if k == 0 or name not in body.free:
        nothing = forall((name,), neg(denied))
        return nothing if k == 0 else conj((nothing, body))
    ring = body.ring
    assert ring is not None
    same = disj(atom(ring.var(name) - ring.var(value), Relation.EQ) for value in spare[:k])
    return exists(spare[:k], conj((_rising(name, body, spare[:k]), forall((name,), implies(denied, same)))))


def connected(name: str, body: Formula, denied: Formula, spare: list[str]) -> Formula:
    """That with two values all between them satisfy the body: no value, one, or an interval; ``spare``: two names."""
    ring = body.ring
    if ring is None or name not in body.free:
        return disj((body, neg(denied)))
    x, low, high = (ring.var(n) for n in (name, *spare[:2]))
    ends = conj((at(denied, name, spare[0]), at(denied, name, spare[1])))
    between = conj((ends, atom(low - x, Relation.LT), atom(x - high, Relation.LT)))
    return forall((*spare[:2], name), implies(between, body))

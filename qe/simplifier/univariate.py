"""Atoms in one variable against each other, by the order of their polynomials' real roots.

The real roots of all the polynomials cut the line into points and open intervals, on each of which every
atom is constantly true or false. So the atoms of a conjunction contradict each other iff no piece satisfies
all of them, and one of them is redundant iff the pieces that satisfy the others are the same without it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.ring import Poly
from qe.formula.syntax import Atom, Relation
from qe.simplifier.facts import Facts, atom_of
from qe.simplifier.ranges import EVERYTHING, describe

_DEGREE = 12  # polynomials of higher degree are left alone
_ATOMS = 12  # so are more atoms than this in one variable

Pieces = frozenset[int]


@lru_cache(maxsize=4_000)
def roots_of(poly: Poly) -> tuple[RealAlgebraic, ...]:
    """The distinct real roots of a polynomial in one variable, ascending."""
    return tuple(real_roots(poly.to_univariate(poly.variables[0])))


def irredundant(atoms: Sequence[Atom], facts: Facts) -> list[Atom] | None:
    """The atoms of a conjunction without those that follow, variable by variable, from others and the facts.

    None if they contradict each other or the facts.
    """
    groups: dict[int, list[Atom]] = {}
    for given in atoms:
        if len(given.poly.variables) == 1 and given.poly.total_degree <= _DEGREE:
            groups.setdefault(given.poly.variables[0], []).append(given)
    dropped: set[Atom] = set()
    for index, group in groups.items():
        outer = list(_known(facts, index))
        if len(group) + len(outer) < 2 or len(group) + len(outer) > _ATOMS:
            continue
        if all(a.poly.total_degree == 1 for a in (*group, *outer)):
            continue
        redundant = _redundant(index, tuple(group), tuple(outer))
        if redundant is None:
            return None
        dropped |= redundant
    return [a for a in atoms if a not in dropped]


def _known(facts: Facts, index: int) -> Iterable[Atom]:
    for key, known in facts.ranges.items():
        if key.variables == (index,) and key.total_degree <= _DEGREE and not known.is_empty:
            for relation, value in describe(known, EVERYTHING, False):
                yield atom_of(key, relation, value)


@lru_cache(maxsize=2_000)
def _redundant(index: int, group: tuple[Atom, ...], outer: tuple[Atom, ...]) -> frozenset[Atom] | None:
    everything = (*group, *outer)
    cuts = sorted({root for a in everything for root in roots_of(a.poly)})
    samples = _samples(cuts)
    truth = {a: _pieces(a, cuts, samples, index) for a in everything}
    base: Pieces = frozenset(range(2 * len(cuts) + 1))
    for a in outer:
        base &= truth[a]
    left = base
    for a in group:
        left &= truth[a]
    if not left:
        return None
    kept = list(group)
    # equations are worth keeping, high degrees are not
    for candidate in sorted(group, key=lambda a: (a.relation is Relation.EQ, -a.poly.total_degree)):
        rest = base
        for a in kept:
            if a is not candidate:
                rest &= truth[a]
        if rest == left:
            kept.remove(candidate)
    return frozenset(group).difference(kept)


def _samples(cuts: Sequence[RealAlgebraic]) -> list[Fraction]:
    """A rational number in each of the open intervals that the cuts leave."""
    if not cuts:
        return [Fraction(0)]
    out = [cuts[0].interval()[0] - 1]
    for left, right in pairwise(cuts):
        bits = 8
        while (high := left.interval(bits)[1]) >= (low := right.interval(bits)[0]):
            bits *= 2
        out.append((high + low) / 2)
    return [*out, cuts[-1].interval()[1] + 1]


def _pieces(given: Atom, cuts: Sequence[RealAlgebraic], samples: Sequence[Fraction], index: int) -> Pieces:
    """The pieces where an atom is true: 2k is the k-th open interval, 2k+1 the k-th cut.

    At a cut that is no root of the polynomial, its sign is that on either side.
    """
    own = set(roots_of(given.poly))
    size = given.poly.ring.size
    pieces = set()
    for k, sample in enumerate(samples):
        sign = given.poly.sign_at([sample if i == index else 0 for i in range(size)])
        if given.relation.holds(sign):
            pieces.add(2 * k)
        if k < len(cuts) and given.relation.holds(0 if cuts[k] in own else sign):
            pieces.add(2 * k + 1)
    return frozenset(pieces)

"""Comprehensive Groebner systems by the algorithm of Kapur, Sun and Wang (ISSAC 2010; JSC 49, 2013).

A task is a set E of equations and a set N of inequations between parameters, and generators F. One Groebner basis G of
F and E in a block order, variables first, gives: the parameters alone must satisfy Gr = G without variables, else the
ideal is everything; where they do and where no leading coefficient of a minimal part Gm of the rest vanishes, Gm is a
basis. What remains is where one of the leading coefficients vanishes: a task for each of their factors. Tasks without
points are left out (an exact test over the complex numbers), so that every segment is a set with points, and the
segments are disjoint.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import prod

from qe.exact.block_order import BlockOrder, parametric_basis
from qe.exact.groebner import groebner_basis
from qe.exact.ideals import LIMITS, has_zeros
from qe.exact.ring import Poly
from qe.groebner.reduction import divides, reduced_basis
from qe.groebner.segment import Segment
from qe.options import Budget


@dataclass(frozen=True)
class _Task:
    equal: tuple[Poly, ...]
    nonzero: tuple[Poly, ...]
    polys: tuple[Poly, ...]


def segments(
    polys: Sequence[Poly],
    block: BlockOrder,
    budget: Budget,
    *,
    equal: Sequence[Poly] = (),
    nonzero: Sequence[Poly] = (),
) -> Iterator[Segment]:
    """Disjoint segments that cover the points with ``equal`` zero and none of ``nonzero`` zero, each with its basis.

    Raises ``Unable`` at a limit, ``BudgetExceeded``.
    """
    kept = tuple(p for p in nonzero if not (p.is_constant and p))
    pending = [_Task(tuple(equal), kept, tuple(polys))]
    while pending:
        budget.check("comprehensive Gröbner system")
        budget.spend(20)
        found, further = _step(pending.pop(), block)
        pending += reversed(further)
        yield from found


def _step(task: _Task, block: BlockOrder) -> tuple[list[Segment], list[_Task]]:
    equal = _simpler(task.equal, task.nonzero, block)
    if not has_zeros(equal, task.nonzero):
        return [], []
    task = replace(task, nonzero=_open(task.nonzero, equal, block))
    basis = parametric_basis([*task.polys, *equal], block)
    ring = (*task.polys, *equal)[0].ring
    one = (ring.constant(1),)
    if basis and basis[0].is_constant:
        return [Segment(block, equal, task.nonzero, (), one, one)], []
    base = tuple(p for p in basis if block.is_free(p))
    found = []
    # where the equations hold and not all of the base do, 1 is in the ideal
    beyond = tuple(p for p in base if has_zeros(equal, [*task.nonzero, p])) if set(base) != set(equal) else ()
    if beyond:
        some = tuple(dict.fromkeys(_bare(p, task.nonzero) for p in beyond))
        some = () if any(p.is_constant for p in some) else some  # () where always one is not 0
        found.append(Segment(block, equal, task.nonzero, some, one, beyond))
        base = _simpler(base, task.nonzero, block)
        if not has_zeros(base, task.nonzero):
            return found, []
    else:
        base = equal
    rest = tuple(p for p in basis if not block.is_free(p))
    minimal = _minimal(rest, block)
    branches, avoided = [], list(task.nonzero)
    factors = dict.fromkeys(f for p in minimal for f, _ in block.lead(p)[1].factors()[1])
    for factor in sorted(factors, key=_size):
        if factor in task.nonzero or not has_zeros([*base, factor], task.nonzero):
            continue  # it vanishes nowhere
        if has_zeros([*base, factor], avoided):
            branches.append(_Task((*base, factor), tuple(avoided), rest))
        avoided.append(factor)
    if has_zeros(base, avoided):
        everything = (*block.variables, *block.parameters)
        ideal = groebner_basis(base, variables=everything, limits=LIMITS) if base else None
        found.append(Segment(block, base, tuple(avoided), (), reduced_basis(minimal, block, ideal), minimal))
    return found, branches


def _simpler(equal: Sequence[Poly], nonzero: Sequence[Poly], block: BlockOrder) -> tuple[Poly, ...]:
    """Equations with the same zeros where nothing of ``nonzero`` vanishes: squarefree, reduced, without its factors."""
    current = tuple(p for p in equal if p)
    while current:
        basis = parametric_basis([_bare(p, nonzero) for p in current], block)
        if basis == current:
            break
        current = basis
    return current


def _open(nonzero: Sequence[Poly], equal: Sequence[Poly], block: BlockOrder) -> tuple[Poly, ...]:
    """Without those that are constants modulo the equations."""
    if not equal or not nonzero:
        return tuple(nonzero)
    ideal = groebner_basis(equal, variables=(*block.variables, *block.parameters), limits=LIMITS)
    return tuple(p for p in nonzero if ideal is None or not ideal.reduce(p)[1].is_constant)


def _bare(poly: Poly, nonzero: Sequence[Poly]) -> Poly:
    """The product of the irreducible factors that are not in ``nonzero``, each once."""
    return prod((f for f, _ in poly.factors()[1] if f not in nonzero), start=poly.ring.constant(1))


def _minimal(rest: Sequence[Poly], block: BlockOrder) -> tuple[Poly, ...]:
    """A minimal Dickson basis: every leading monomial is a multiple of one of theirs, none of one another."""
    leads = {p: block.lead(p) for p in rest}
    ranked = sorted(rest, key=lambda p: (block.order.key(leads[p][0]), _size(leads[p][1]), p.term_count()))
    kept: list[Poly] = []
    for p in ranked:
        if not any(divides(leads[q][0], leads[p][0]) for q in kept):
            kept.append(p)
    return tuple(kept)


def _size(poly: Poly) -> tuple[int, int]:
    return poly.total_degree, poly.term_count()

"""The next variable of a block, and its elimination set (a pure choice; ``block`` carries it out)."""

from __future__ import annotations

from dataclasses import dataclass, replace

from qe.elimination.vs.candidates import (
    Candidate,
    Gauss,
    best_gauss,
    bounds,
    gauss_constituent,
    gauss_cost,
    points_cost,
    within,
)
from qe.elimination.vs.clusters import clustered
from qe.elimination.vs.points import Infinity
from qe.elimination.vs.radical_free import without_radicals
from qe.formula.build import conj
from qe.formula.syntax import FALSE, Atom, Atomic, Formula, Relation
from qe.formula.traverse import atoms, conjuncts
from qe.rules.degree_shift import common_exponent, lowered, values
from qe.simplifier.facts import NOTHING, Facts, factor_list

_INFINITY_COST = 2.0  # substituting an infinity, in units of a linear root with constant denominator
_UNBEATABLE = 1.0  # a plan of one linear root with a constant denominator in one atom: the search ends with it
_ALONE = 0.5  # factor for a variable that occurs in its equation only: nothing is substituted into
_QUADRATIC_SPREAD = 1.5  # how much worse it is when a block variable's degree grows, per degree


@dataclass(frozen=True, slots=True)
class Plan:
    """Substitute ``candidates`` (and ``infinities``) for x in ``formula``; ``exponent``: degree shift done before.

    ``degenerate`` is a further subproblem, still with x, or FALSE: the Gauss constituent vanishes there.
    """

    x: int
    exponent: int
    formula: Formula
    candidates: tuple[Candidate, ...]
    infinities: tuple[Infinity, ...]
    infinity_guard: Formula | None
    degenerate: Formula
    cost: float


def occurring(formula: Formula) -> frozenset[int]:
    """The indices of the variables that occur in a quantifier-free formula."""
    return frozenset() if formula.ring is None else frozenset(map(formula.ring.index.__getitem__, formula.free))


def choose(formula: Formula, block: frozenset[int], *, strict: bool, highest: int = 2) -> Plan | None:
    """The cheapest plan over the variables of the block, all occurring; None if every degree is too high.

    ``strict``: the solution set in the block is open (see ``qe.formula.openness``). ``highest``: see ``bounds``.
    """
    facts = NOTHING.extended(conjuncts(formula))
    best: Plan | None = None
    for x in sorted(block):
        plan = _plan(formula, x, block - {x}, facts, strict, highest)
        if plan is not None and highest > 2:
            plan = replace(plan, candidates=clustered(plan.candidates, x))
        if plan is not None and (best is None or plan.cost < best.cost):
            best = plan
            if best.cost <= _UNBEATABLE:
                break
    return best


@dataclass(frozen=True, slots=True)
class _Problem:
    """Eliminate x from ``formula``, the conjunction of ``args``, in which x stands for its power of ``exponent``.

    ``facts``: what the arguments say. ``size``: in how many atoms a point is put. ``highest``: see ``bounds``.
    """

    x: int
    exponent: int
    formula: Formula
    args: tuple[Formula, ...]
    facts: Facts
    size: float
    highest: int


def _plan(formula: Formula, x: int, others: frozenset[int], facts: Facts, strict: bool, highest: int) -> Plan | None:
    if any(not isinstance(a, Atom) and x in occurring(a) for a in atoms(formula)):
        return None
    ring = next(atoms(formula)).poly.ring
    exponent = common_exponent(formula, x, nonnegative=-1 not in facts.signs(ring.gen(x)))
    originals = args = conjuncts(formula)
    if exponent > 1:
        strict = strict or _is_positive(formula, x)
        args = (*(lowered(a, x, exponent) for a in originals), values(ring.gen(x), exponent, strict=strict))
        args = tuple(dict.fromkeys(args))
        formula = conj(args)
        facts = NOTHING.extended(args)
    size = sum(1.0 + _spread(a, x, others) for a in atoms(formula) if a.poly.degree(x))
    problem = _Problem(x, exponent, formula, args, facts, size, highest)
    gauss = best_gauss([gauss_constituent(a, x, 1, facts, highest) for a in args])
    found = None if gauss is None else _with_gauss(problem, originals, *gauss)
    return _with_bounds(problem) if found is None else found


def _is_positive(formula: Formula, x: int) -> bool:
    """Whether a conjunct says x > 0 and the solutions for x are an open set: then nothing is added to it."""
    with_x = [a for a in atoms(formula) if a.poly.degree(x)]
    positive = any(isinstance(a, Atom) and a == Atom(a.poly.ring.gen(x), Relation.GT) for a in conjuncts(formula))
    return positive and all(a.relation.is_strict for a in with_x)


def _spread(atomic: Atomic, x: int, others: frozenset[int]) -> float:
    """A penalty for atoms whose other block variables would get a higher degree."""
    if atomic.poly.degree(x) < 2:
        return 0.0
    return _QUADRATIC_SPREAD * sum(atomic.poly.degree(i) for i in others)


def _with_gauss(problem: _Problem, originals: tuple[Formula, ...], gauss: Gauss, k: int) -> Plan | None:
    """Only the points of the Gauss constituent, the k-th argument; where it vanishes identically, the problem without
    it (``originals``: the arguments before the degree shift)."""
    x, exponent, formula, args, size = problem.x, problem.exponent, problem.formula, problem.args, problem.size
    candidates = within(formula, args, k, gauss.candidates) or ()
    cost = gauss_cost(gauss) * size if size > 1 or gauss.degenerate != FALSE else points_cost(candidates) * _ALONE
    if gauss.degenerate == FALSE:
        return Plan(x, exponent, formula, candidates, (), None, FALSE, cost)
    if isinstance(args[k], Atom):
        without = conj((gauss.degenerate, *originals[:k], *originals[k + 1 :]))
        return Plan(x, exponent, formula, candidates, (), None, without, cost)
    plain = _with_bounds(problem)
    if plain is None:
        return None
    others = tuple(replace(c, guard=conj((gauss.degenerate, c.guard))) for c in plain.candidates)
    return Plan(x, exponent, formula, candidates + others, plain.infinities, gauss.degenerate, FALSE, cost + plain.cost)


def _with_bounds(problem: _Problem) -> Plan | None:
    """Lower bounds with -infinity, upper bounds with +infinity, or a set without radicals: the cheapest."""
    x, exponent, formula, facts = problem.x, problem.exponent, problem.formula, problem.facts
    best: Plan | None = None
    for side in (1, -1):
        found = bounds(formula, x, side, facts, frozenset(), problem.highest)
        if found is None:
            return None
        cost = (points_cost(found) + _INFINITY_COST) * problem.size
        if best is None or cost < best.cost:
            best = Plan(x, exponent, formula, found, (Infinity(-side),), None, FALSE, cost)
    plain = without_radicals(formula, x, facts, problem.highest)
    if plain is not None and best is not None:
        cost = (points_cost(plain) + 2 * _INFINITY_COST) * problem.size
        if cost < best.cost:
            best = Plan(x, exponent, formula, plain, (Infinity(-1), Infinity(1)), None, FALSE, cost)
    return best


def split_equation(formula: Formula, block: frozenset[int]) -> tuple[Formula, ...] | None:
    """f*g = 0 and F as the two problems f = 0 and F, g = 0 and F, if a conjoined equation factors so."""
    args = conjuncts(formula)
    for k, arg in enumerate(args):
        if isinstance(arg, Atom) and arg.relation is Relation.EQ:
            parts = factor_list(arg.poly)
            if len(parts) > 1 and block & set(arg.poly.variables):
                rest = (*args[:k], *args[k + 1 :])
                return tuple(conj((Atom(f, Relation.EQ), *rest)) for f, _ in parts)
    return None

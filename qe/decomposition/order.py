"""Variable orders for cylindrical algebraic decomposition, chosen within quantifier blocks only.

Heuristics: Brown (tutorial at ISSAC 2004) reads the degrees of the input; greedy (Dolzmann, Seidl, Sturm, ISSAC 2004)
projects one variable at a time, the one whose projection is smallest. Size is ``sotd``, the sum of the total degrees of
all terms (the same paper). Where the two disagree, their whole projections are compared (``preferred``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from qe.decomposition.constraints import equational_constraints
from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.projection import FactorSet, effort, factor_lists, project
from qe.errors import BudgetExceeded
from qe.exact.algebraic import real_roots
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.formula.normal import nnf, prenex
from qe.formula.syntax import Formula
from qe.formula.traverse import polynomials
from qe.options import Budget, Options, Stage

T = TypeVar("T")

HEAVY = 20_000
"""Projections of more effort are not tried: a resultant cannot be interrupted. All trials take a tenth of a second."""

TOO_HEAVY = 10 * HEAVY
"""The usual order is left for another one outright where its projection has steps of more effort than this."""

TRIALS_FROM = 200
"""With fewer units of work left for what is to be decomposed, trial projections would take longer than that."""

ROOTS_UP_TO = 300
"""Roots are counted where the polynomials of level 0 have degrees up to this in all."""

MARGIN = 0.9
"""A projection counts as smaller from here on; answers over free variables tend to be shorter in Brown's order."""

WRITTEN = "as written"


@dataclass(frozen=True, slots=True)
class Prenex:
    """A formula in prenex form with its variables in the order of its decomposition: free ones first, then by blocks.

    ``matrix``: in negation normal form. ``quantifiers``: of each variable "" (free), "E" or "A". ``reason``: why this
    order.
    """

    matrix: Formula
    order: tuple[str, ...]
    quantifiers: tuple[str, ...]
    reason: str

    @classmethod
    def of(cls, formula: Formula, options: Options, budget: Budget) -> Prenex:
        """Within a block the variables that the caller named come first, in the caller's order."""
        prefix, matrix = prenex(formula)
        parts = [("", formula.free), *((kind.value, names) for kind, names in prefix)]
        blocks: list[tuple[str, ...]] = []
        for _, names in parts:
            named = [v for v in options.order or () if v in names]
            rest = tuple(v for v in names if v not in named)
            blocks += [*((v,) for v in named), *([rest] if rest else [])]
        order, reason = choose_order(nnf(matrix), blocks, written=Stage.ORDER in options.without, budget=budget)
        return cls(nnf(matrix), order, tuple(kind for kind, names in parts for _ in names), reason)

    @property
    def figures(self) -> dict[str, object]:
        """What the log says of the order."""
        return {"order": list(self.order), "order by": self.reason}


@dataclass(frozen=True, slots=True)
class Candidate:
    """An order with the size of its projection: ``sotd`` of all factors, and the distinct real ``roots`` of level 0
    (or a bound, where they are many).
    """

    rule: str
    order: tuple[str, ...]
    sotd: int
    roots: int


def choose_order(
    matrix: Formula, blocks: Sequence[Sequence[str]], *, written: bool = False, budget: Budget
) -> tuple[tuple[str, ...], str]:
    """The order of all variables (free block first, blocks never mixed) and why it was taken.

    A part of the order that the caller fixes is written as blocks of one variable; ``written``: all of it is fixed.
    """
    polys = polynomials(matrix)
    if written or all(len(block) < 2 for block in blocks):
        return tuple(v for block in blocks for v in block), WRITTEN
    brown = tuple(v for block in blocks for v in brown_order(polys, block))
    left = budget.left()
    if left is not None and left < TRIALS_FROM:
        return brown, "brown (there is little work left)"
    greedy = _unless_heavy(lambda: greedy_order(polys, blocks, lambda some, v: _projected(some, v, budget)), budget)
    if greedy is None:
        return brown, "brown (greedy is too heavy)"
    if greedy == brown:
        return greedy, "brown and greedy agree"
    usual = _unless_heavy(lambda: _measured(matrix, "brown", brown, TOO_HEAVY, budget), budget)
    other = _unless_heavy(lambda: _measured(matrix, "greedy", greedy, HEAVY, budget), budget)
    if other is None:
        return brown, "brown (greedy is too heavy)"
    if usual is None:
        return greedy, "greedy (brown is too heavy)"
    best = preferred(usual, other)
    figures = ", ".join(f"{c.rule} {c.sotd} with {c.roots} roots" for c in (usual, other))
    return best.order, f"{best.rule} (size of projection: {figures})"


def brown_order(polys: Sequence[Poly], variables: Iterable[str]) -> tuple[str, ...]:
    """The variables from the one projected last to the one projected first (Brown's heuristic, 2004 tutorial).

    Projected first: lowest degree, then lowest total degree of a term containing it, then fewest terms containing it.
    """
    if not polys:
        return tuple(variables)
    index = polys[0].ring.index

    def weight(name: str) -> tuple[int, int, int, str]:
        i = index.get(name)
        if i is None:
            return 0, 0, 0, name
        inside = [e for p in polys if p.degree(i) for e, _ in p.terms() if e[i]]
        return max((p.degree(i) for p in polys), default=0), max((sum(e) for e in inside), default=0), len(inside), name

    return tuple(sorted(variables, key=weight, reverse=True))


def greedy_order(
    polys: Sequence[Poly], blocks: Sequence[Sequence[str]], project: Callable[[Sequence[Poly], str], list[Poly]]
) -> tuple[str, ...]:
    """The variables of the blocks, outermost block first; within a block the one projected first comes last.

    ``project(polys, v)``: the factors that remain when v has been projected away. Ties keep Brown's order.
    """
    order: list[str] = []
    for block in reversed(blocks):
        left = list(reversed(brown_order(polys, block)))
        while left:
            after = {v: project(polys, v) for v in left} if len(left) > 1 else {left[0]: []}
            first = min(left, key=lambda v: sotd(after[v]))
            left.remove(first)
            order.append(first)
            if left or block is not blocks[0]:
                polys = after[first] or project(polys, first)
    return tuple(reversed(order))


def sotd(polys: Iterable[Poly]) -> int:
    """The sum of the total degrees of all terms."""
    return sum(sum(exponents) for p in polys for exponents, _ in p.terms())


def preferred(usual: Candidate, other: Candidate) -> Candidate:
    """The other order if its projection is clearly smaller and has no more roots on level 0, else the usual one: where
    they disagree, ``sotd`` misleads about half of the time."""
    return other if other.sotd <= MARGIN * usual.sotd and other.roots <= usual.roots else usual


def _unless_heavy(trial: Callable[[], T], budget: Budget) -> T | None:
    try:
        return trial()
    except BudgetExceeded:
        budget.check("order")  # a limit of the caller's goes on
        return None


def _projected(polys: Sequence[Poly], name: str, budget: Budget) -> list[Poly]:
    """The irreducible factors left without the variable; raises ``BudgetExceeded`` rather than start a heavy step."""
    if not polys or name not in polys[0].ring.index:
        return list(polys)
    i = polys[0].ring.index[name]
    factors = FactorSet(polys)
    inside = [f for f in factors if f.degree(i)]
    if effort(inside, i) > HEAVY:
        raise BudgetExceeded("a trial projection is too heavy", limit="effort")
    left = FactorSet(f for f in factors if not f.degree(i))
    for p in project(inside, i, BROWN_MCCALLUM):
        budget.check("order")
        left.add((p,))
    return list(left)


def _measured(matrix: Formula, rule: str, order: tuple[str, ...], heaviest: int, budget: Budget) -> Candidate:
    """The size of the whole projection."""
    matrix = convert(matrix, Ring.of(order))
    levels = factor_lists(
        polynomials(matrix),
        len(order),
        BROWN_MCCALLUM,
        budget,
        constraints=equational_constraints(matrix, len(order)).factors,
        heaviest=heaviest,
    )
    roots = sum(f.degree(0) for f in levels[0])
    if roots <= ROOTS_UP_TO:
        roots = sum(len(real_roots(f.to_univariate(0))) for f in levels[0])
    return Candidate(rule, order, sum(sotd(level) for level in levels), roots)

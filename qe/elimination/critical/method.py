"""Critical-value elimination as a method: what it needs from its neighbours, and the formula of its tables."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

from qe.convex.facial_reduction import on_flat
from qe.decomposition.formulas import Undistinguished, construct, formula_of_cells
from qe.decomposition.order import brown_order
from qe.decomposition.sign_table import free_cells
from qe.elimination.critical.apart import Piece, taken_apart
from qe.elimination.critical.block import Disjunct, Tabulated, eliminate_block
from qe.elimination.critical.universal import eliminate_universal
from qe.elimination.protocol import Context, Outcome
from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, disj, exists, forall
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.formula.traverse import conjuncts, polynomials
from qe.options import Budget, Options, Stage
from qe.proof.cells import CellTable
from qe.proof.step import Nested, Step
from qe.simplifier.simplify import simplify

RULE = "critical values"
UNIVERSAL_RULE = "critical values of a universal block"
DIRECTIONS = "constant along directions"

FEW = 2
"""So many parameters a convex truth set may have."""

MOST_PLANES = 6
"""Planes in later variables that are tried before derivatives, which bring many more cells (measured: ten times)."""


class CriticalValues:
    """Existential blocks over bounded fibres: where their truth can change, and whether it does."""

    name = "critical"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Blocks over quantifier-free bodies."""
        return "critical values are few" if problem.is_flat else None

    def run(self, problem: Block, context: Context) -> Outcome:
        """The block's formula; quantified parts of it are the block on hypersurfaces that the method leaves open.

        Raises ``Unable`` where the method's side conditions are not met.
        """
        dual = problem.dual
        found = by_critical_values(dual.variables, dual.body, context)
        answer = problem.asked(found.formula)
        if len(found.parts) < 2:
            context.log.step(RULE, problem.formula, answer, evidence={"order": found.order})
            return Outcome(answer, order=found.order)
        blocks = [(problem.asked(part.block), problem.asked(part.formula)) for part in found.parts]
        context.log.step("simplification", problem.formula, problem.asked(disj(p.block for p in found.parts)))
        for block, formula in blocks:
            context.log.step(RULE, block, formula, evidence={"order": found.order})
        context.log.step("simplification", problem.asked(disj(p.formula for p in found.parts)), answer)
        return Outcome(answer, order=found.order)


@dataclass(frozen=True, slots=True)
class Part:
    """The block over one disjunct, and the formula that was found for it."""

    block: Formula
    formula: Formula


@dataclass(frozen=True, slots=True)
class Found:
    """The formula of a block, the order of the parameters in which it was found, and its disjuncts (none where
    equations that follow were substituted first)."""

    formula: Formula
    order: tuple[str, ...] | None
    parts: tuple[Part, ...] = ()


class ConvexUniversal:
    """Universal blocks in one or two parameters whose truth set is seen to be convex.

    To be asked before preparation splits the conjuncts. A block of few pieces is eliminated piece by piece, which
    takes less time, gives shorter answers and shorter proofs; where one is not seen to be convex, as a whole.
    """

    name = "critical"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Universal blocks over quantifier-free bodies, one or two parameters; more, if its pieces look at as few."""
        few = 0 < len(problem.free) <= FEW or (problem.universal and problem.is_flat and pieces_of(problem))
        return "a convex truth set" if problem.universal and problem.is_flat and few else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """None where the set is not seen to be convex. Raises ``Unable`` where side conditions are not met."""
        if len(problem.free) > FEW or len(pieces_of(problem)) > 1:
            outcome = self.apart(problem, context)
            if outcome is not None or len(problem.free) > FEW:
                return outcome
        budget = context.budget
        negated = simplify(problem.positive, watch=budget.check)
        order = _order(problem.variables, negated, context.options)
        formula = self.convex(problem.variables, negated, order, context)
        if formula is None:
            return None
        known = {"order": order}
        return Outcome(context.log.step(UNIVERSAL_RULE, problem.formula, formula, evidence=known), order=order)

    def apart(self, problem: Block, context: Context) -> Outcome | None:
        """The block by its pieces, each in one or two parameters."""
        steps = list[Step]()
        for piece in pieces_of(problem):
            order = _order(problem.variables, piece.body, context.options)
            formula = self.convex(problem.variables, piece.body, order, context)
            if formula is None:
                return None
            block, whole = (forall(problem.variables, nnf(f, negate=True)) for f in (piece.body, piece.whole))
            step = Step(UNIVERSAL_RULE, block, formula, evidence={"order": order})
            if piece.steps:
                directions = [[name, [[v, str(w)] for v, w in along.items()]] for name, along in piece.steps]
                proof = {"directions": directions, "steps": Nested(block, (step,), formula)}
                step = Step(DIRECTIONS, whole, piece.back(formula), evidence={"proof": proof})
            steps.append(step)
        context.log.step("simplification", problem.formula, conj(step.before for step in steps))
        for step in steps:
            context.log.step(step.rule, step.before, step.after, evidence=step.evidence)
        return Outcome(conj(step.after for step in steps))

    def convex(
        self, variables: Sequence[str], negated: Formula, order: tuple[str, ...], context: Context
    ) -> Formula | None:
        """``all variables. not negated``, if its truth set is seen to be convex with interior points."""
        start, budget = time.perf_counter(), context.budget
        found = eliminate_universal(variables, negated, order, budget=budget)
        if found is None:
            return None
        assert isinstance(found.found, Tabulated)
        answer = _described(found.found)  # in the plane the table of a convex set settles every cell
        return _logged(simplify(answer, watch=budget.check), negated, order, [found], context, start)


def pieces_of(problem: Block) -> tuple[Piece, ...]:
    """The pieces of a universal block with many parameters, if they look at few."""
    return taken_apart(problem.variables, simplify(problem.positive), FEW)


def by_critical_values(variables: Sequence[str], body: Formula, context: Context) -> Found:
    """``exists variables. body`` (quantifier-free, positive)."""
    start = time.perf_counter()
    budget = context.budget
    flat = on_flat(variables, body, budget=budget)
    ring = body.ring or Ring.of(())
    if flat is not None:
        outside, rest = flat
        left = [v for v in variables if v in rest.free]
        inside = by_critical_values(left, rest, context) if left else Found(rest, None)
        whole = conj(convert(part, ring) for part in (*outside, inside.formula))
        return Found(simplify(whole, watch=budget.check), inside.order)
    parameters = _order(variables, body, context.options)
    found = eliminate_block(variables, body, parameters, budget=budget)
    formulas = [convert(_formula(variables, parameters, part, budget), ring) for part in found]
    parts = [
        Part(convert(exists(variables, part.body), ring), formula)
        for part, formula in zip(found, formulas, strict=True)
    ]
    whole = _logged(simplify(disj(formulas), watch=budget.check), body, parameters, found, context, start)
    return Found(whole, parameters, tuple(parts))


def _logged(
    formula: Formula, body: Formula, parameters: tuple[str, ...], found: list[Disjunct], context: Context, start: float
) -> Formula:
    """The formula over the ring of the body; what was done goes into the log."""
    seconds = round(time.perf_counter() - start, 6)
    stats = [part.stats for part in found]
    context.log.work("critical", {"order": list(parameters), "disjuncts": stats, "seconds": seconds})
    ring = body.ring
    return formula if ring is None else convert(formula, ring)


def _order(variables: Sequence[str], body: Formula, options: Options) -> tuple[str, ...]:
    names = exists(variables, body).free
    named = tuple(v for v in options.order or () if v in names)
    if len(named) == len(names):
        return named
    return names if Stage.ORDER in options.without else brown_order(polynomials(body), names)


def _formula(
    variables: Sequence[str],
    parameters: tuple[str, ...],
    part: Disjunct,
    budget: Budget,
) -> Formula:
    """The formula of one disjunct; quantified on the hypersurfaces where the block is not settled."""
    found = part.found
    if isinstance(found, bool):
        return TRUE if found else FALSE
    if any(atom(f, Relation.EQ) in conjuncts(part.body) for f in found.unsettled):
        raise Unable("critical-value elimination leaves a hypersurface open")
    formula = _described(found)
    surfaces = [exists(variables, conj((atom(f, Relation.EQ), part.body))) for f in found.unsettled]
    ring = part.body.ring or Ring.of(parameters)
    return disj((convert(formula, ring), *(convert(on_surface, ring) for on_surface in surfaces)))


def _described(found: Tabulated) -> Formula:
    """The formula of a table, with further polynomials where signs do not tell a true cell from a false one.

    Two cells that look alike part at some level over a common sample, with sectors between them. A rational value of
    such a sector tells them apart, for good at the first level; at later levels that is only so over the sample, so
    after ``MOST_PLANES`` of them, and in space, derivatives are taken.
    """
    table, planes, later = found.table, frozenset[Poly](), 0
    while later < MOST_PLANES and table.free <= 2:
        try:
            return formula_of_cells(table.factors, free_cells(table))
        except Undistinguished as pair:
            planes |= {_plane(table, pair)}
            later += pair.level > 0
            table = found.refine(frozenset(), planes)
    return construct(table, lambda levels: found.refine(levels, planes))[0]


def _plane(table: CellTable, pair: Undistinguished) -> Poly:
    """x = the sample of the middle sector between two cells, where their ways part."""
    one, other = pair.ways
    stack = table.root.stack
    for position in one[: pair.level]:
        assert stack is not None
        stack = stack.cells[position].stack
    assert stack is not None
    value = stack.sectors[(one[pair.level] + other[pair.level] + 1) // 4]
    return value.denominator * Ring.of(table.order).gen(pair.level) - value.numerator

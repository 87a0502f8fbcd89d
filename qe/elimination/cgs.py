"""Elimination by comprehensive Groebner systems: blocks whose variables are bound by equations.

The equations of a conjunction, with the free variables as parameters, have a comprehensive Groebner system. Over a
segment with finitely many complex solutions there is a real solution with the right signs of the other polynomials iff
a combination of signatures of trace forms is positive, which is a condition on signs of polynomials in the parameters.
Over the others a largest set of variables that the equations leave free joins the parameters and stays quantified
(Weispfenning, A new approach to quantifier elimination for real algebra, 1998; Fukasaku, Iwane, Sato, ISSAC 2015).

Where there is no equation at all, one variable x of strict inequalities g > 0, g /= 0 gets one. Their truth changes at
zeros of the product P of the g only, and between two neighbouring zeros P has an extremum (Rolle). So they hold
somewhere iff they hold at an end of the line or at a zero of P', whatever the parameters: where P' vanishes
identically the ends decide, and where P does nothing holds. g >= 0 is g > 0 or the equation g = 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod

from qe.elimination.protocol import Context, Outcome
from qe.errors import InternalError
from qe.exact.block_order import BlockOrder
from qe.exact.number import Values, simplest
from qe.exact.polynomial_system import solve_system
from qe.exact.quotient import PositiveDimensional, independent_sets
from qe.exact.ring import Poly, Ring
from qe.exact.zeros import Zero
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, disj, exists
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Formula, Or, Relation
from qe.groebner.counting import SolutionCount
from qe.groebner.evidence import Condition, solutions_certificate
from qe.groebner.kapur_sun_wang import segments
from qe.groebner.segment import Segment
from qe.groebner.system import condition_of
from qe.options import Budget, Options
from qe.proof.certificate import Certificate
from qe.proof.on_demand import OnDemand
from qe.simplifier.simplify import simplify

MOST_CONJUNCTIONS = 24
"""Conjunctions in the disjunctive normal form of a body."""


class ComprehensiveGroebner:
    """Blocks over disjunctions of conjunctions."""

    name = "cgs"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Flat blocks."""
        return "trace forms count its solutions" if problem.is_flat else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """The block; of variables that no equation binds one goes, others stay. None for conditions of another kind.

        Raises ``Unable`` where bases or trace forms grow past their limits, ``BudgetExceeded``.
        """
        dual = problem.dual
        free = dual.formula.free
        ring = Ring.of((*free, *dual.variables))
        if _length(dual.body) > MOST_CONJUNCTIONS or dual.has_root_atoms:
            return None
        parts = list(conjunctions(convert(dual.body, ring)))
        read = [_Conjunction.of(part, ring, dual.variables) for part in parts]
        answers, listed = list[Formula](), not free
        for part in read:
            zeros = None if free else part.zeros()
            if zeros is None:
                listed = False
                answers.append(part.eliminated(context.budget))
            elif (witness := part.witness(zeros)) is not None:
                # whatever does not occur in this conjunction may be 0
                return _outcome(problem, context, TRUE, {v: witness.get(v, Fraction(0)) for v in problem.variables})
        refuted = OnDemand(_Conjunctions(tuple(read)).refuted) if listed else None
        return _outcome(problem, context, simplify(disj(answers), watch=context.budget.check), None, refuted)


def _outcome(
    problem: Block, context: Context, formula: Formula, witness: Values | None, refuted: OnDemand | None = None
) -> Outcome:
    # back into the ring of the formula it came from: it is joined with parts of that formula
    ring = problem.formula.ring
    moved = formula if ring is None else convert(formula, ring)
    evidence = {} if refuted is None or formula != FALSE else {"proof": refuted}
    answer = context.log.step("comprehensive Gröbner system", problem.formula, problem.asked(moved), evidence=evidence)
    return Outcome(answer, witness)


def _names(poly: Poly) -> list[str]:
    return [poly.ring.names[i] for i in poly.variables]


def _length(formula: Formula) -> int:
    """The number of conjunctions in its disjunctive normal form."""
    match formula:
        case Or(args):
            return sum(map(_length, args))
        case And(args):
            return prod(map(_length, args))
    return 1


def conjunctions(formula: Formula) -> Iterator[tuple[Formula, ...]]:
    """The disjunctive normal form of a formula in negation normal form."""
    match formula:
        case Or(args):
            for arg in args:
                yield from conjunctions(arg)
        case And(args):
            for choice in product(*(list(conjunctions(arg)) for arg in args)):
                yield tuple(a for part in choice for a in part)
        case Constant(value):
            if value:
                yield ()
        case Atom():
            yield (formula,)
        case _:
            raise InternalError(f"not in negation normal form: {type(formula).__name__}")


@dataclass(frozen=True)
class _Conjunction:
    """``ex block. equations = 0 and conditions``, and ``outside``, which is free of the block."""

    ring: Ring
    block: tuple[str, ...]
    equations: tuple[Poly, ...]
    conditions: tuple[Condition, ...]
    outside: tuple[Atom, ...]

    @staticmethod
    def of(parts: Sequence[Formula], ring: Ring, block: tuple[str, ...]) -> _Conjunction:
        atoms_of = [a for a in parts if isinstance(a, Atom)]
        inside = [a for a in atoms_of if set(_names(a.poly)) & set(block)]
        outside = [a for a in atoms_of if not set(_names(a.poly)) & set(block)]
        equations = tuple(a.poly for a in inside if a.relation is Relation.EQ)
        conditions = tuple(_upward(a) for a in inside if a.relation is not Relation.EQ)
        used = {name for p in (*equations, *(g for g, _ in conditions)) for name in _names(p)}
        return _Conjunction(ring, tuple(v for v in block if v in used), equations, conditions, tuple(outside))

    def eliminated(self, budget: Budget) -> Formula:
        """Equivalent, with quantifiers only where the equations leave variables free."""
        if not self.equations:
            return conj([*self.outside, self._unbound(self.block, budget)])
        zero = [a.poly for a in self.outside if a.relation is Relation.EQ]
        nonzero = [a.poly for a in self.outside if a.relation is Relation.NE]
        return conj([*self.outside, self._over(self.equations, self.block, zero, nonzero, budget)])

    def _over(
        self,
        equations: Sequence[Poly],
        variables: Sequence[str],
        zero: Sequence[Poly],
        nonzero: Sequence[Poly],
        budget: Budget,
    ) -> Formula:
        """The elimination of ``variables`` where some polynomials in the others vanish and some do not."""
        index = self.ring.index
        inner = tuple(index[v] for v in variables)
        others = tuple(i for i in reversed(range(self.ring.size)) if i not in inner)
        parts = []
        for segment in segments(equations, BlockOrder(inner, others), budget, equal=zero, nonzero=nonzero):
            if not segment.is_unit:
                parts.append(conj([condition_of(segment), self._of_segment(segment, variables, budget)]))
        return disj(parts)

    def _of_segment(self, segment: Segment, variables: Sequence[str], budget: Budget) -> Formula:
        if segment.dimension == 0:
            return SolutionCount(segment, self.conditions, budget).is_positive
        if segment.dimension == len(variables):  # nothing is bound
            return self._unbound(variables, budget)
        positions = next(independent_sets(segment.leads, len(variables)))
        free = tuple(variables[k] for k in positions)
        bound = [v for v in variables if v not in free]
        inside = self._over(segment.basis, bound, segment.equal, segment.nonzero, budget)
        return exists(free, conj([condition_of(segment), inside]))

    def _unbound(self, variables: Sequence[str], budget: Budget) -> Formula:
        """``ex variables. conditions`` without one of the variables, that of the least degree."""
        if not variables:
            return conj(atom(g, r) for g, r in self.conditions)
        index = self.ring.index
        x = min(variables, key=lambda v: sum(g.degree(index[v]) for g, _ in self.conditions))
        inside = [(g, r) for g, r in self.conditions if index[x] in g.variables]
        outside = [atom(g, r) for g, r in self.conditions if index[x] not in g.variables]
        others = tuple(v for v in variables if v != x)
        return exists(others, conj([*outside, self._on_a_line(index[x], inside, budget)]))

    def _on_a_line(self, x: int, conditions: Sequence[Condition], budget: Budget) -> Formula:
        """That they hold for some x, all of which contain it: at an end of the line, or at a zero."""
        budget.check("zeros of conditions")
        if not conditions:
            return TRUE
        (g, relation), *rest = sorted(conditions, key=lambda c: c[1] is not Relation.GE)
        if relation is Relation.GE:
            strict = self._on_a_line(x, [(g, Relation.GT), *rest], budget)
            return disj([strict, self._at_zeros(x, g, rest, budget, lambda: self._on_a_line(x, rest, budget))])
        factors = dict.fromkeys(f for g, _ in conditions for f, _ in g.factors()[1] if x in f.variables)
        slope = prod(factors, start=self.ring.constant(1)).derivative(x)
        ends = [conj(_at_end(g, r, x, side) for g, r in conditions) for side in (1, -1)]
        return disj([*ends, self._at_zeros(x, slope, conditions, budget, lambda: FALSE)])

    def _at_zeros(
        self, x: int, p: Poly, conditions: Sequence[Condition], budget: Budget, everywhere: Callable[[], Formula]
    ) -> Formula:
        """That they hold at a zero of p; ``everywhere``: for some x where all of p vanishes."""
        if not p:
            return everywhere()
        others = tuple(i for i in reversed(range(self.ring.size)) if i != x)
        parts = []
        for segment in segments((p,), BlockOrder((x,), others), budget):
            if segment.dimension == 0:
                parts.append(conj([condition_of(segment), SolutionCount(segment, conditions, budget).is_positive]))
            elif segment.dimension == 1:
                parts.append(conj([condition_of(segment), everywhere()]))
        return disj(parts)

    def zeros(self) -> list[Zero] | None:
        """All real solutions of equations without parameters; None where there are infinitely many complex ones."""
        if not any(self.equations):
            return None
        try:
            return solve_system(self.equations, variables=[self.ring.index[v] for v in self.block])
        except PositiveDimensional:
            return None

    def certificate(self) -> Certificate:
        """Of the real solutions, where nothing but the block's variables occurs."""
        return solutions_certificate(
            self.equations, self.conditions, variables=[self.ring.index[v] for v in self.block]
        )

    def witness(self, zeros: Sequence[Zero]) -> Values | None:
        """Exact values of the block's variables: a solution that meets the other conditions."""
        for zero in zeros:
            if all(r.holds(zero.sign(g)) for g, r in self.conditions):
                return {name: simplest(value.to_algebraic()) for name, value in zero.values.items()}
        return None


def _at_end(g: Poly, relation: Relation, x: int, side: int) -> Formula:
    """That g > 0, or g /= 0, as x goes to plus (``side`` = 1) or minus (-1) infinity."""
    formula: Formula = FALSE
    for (power,), c in sorted(g.collected((x,)).items()):
        lead = c * side**power
        formula = disj([atom(lead, relation), conj([atom(lead, Relation.EQ), formula])])
    return formula


def _upward(given: Atom) -> Condition:
    """The polynomial and one of >, >=, /=."""
    upward = {Relation.LT: Relation.GT, Relation.LE: Relation.GE}
    if given.relation in upward:
        return -given.poly, upward[given.relation]
    return given.poly, given.relation


@dataclass(frozen=True)
class _Conjunctions:
    parts: tuple[_Conjunction, ...]

    def refuted(self, budget: Budget) -> dict[str, object]:
        """That none of them has a solution."""
        listed = []
        for part in self.parts:
            budget.check("prove")
            listed.append(part.certificate().evidence_for("solutions"))
        return {"systems": listed}

"""Elimination of a block of existential quantifiers by virtual substitution."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from qe.elimination.vs import trace as steps
from qe.elimination.vs.candidates import in_order
from qe.elimination.vs.plan import Plan, choose, occurring, split_equation
from qe.elimination.vs.points import SymbolicPoint, Value
from qe.elimination.vs.result import BlockResult, Choice
from qe.elimination.vs.substitute import Substitution
from qe.elimination.vs.univariate_samples import solution
from qe.exact.ring import Ring
from qe.formula.build import conj, disj
from qe.formula.normal import nnf
from qe.formula.openness import is_open, thinned
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, Formula, Or
from qe.formula.traverse import conjuncts, connected, has_root_atoms
from qe.options import Budget
from qe.rules.tree import NEVER, All, Any, Leaf, Lifted, Node
from qe.simplifier.facts import NOTHING

Simplifier = Callable[[Formula], Formula]

SUBSTITUTION_COST = 5
"""Units of work of one test point: its substitution and simplification take as long as five cells (measured)."""


def eliminate_block(
    variables: Sequence[str], matrix: Formula, *, budget: Budget, simplify: Simplifier, highest: int = 2
) -> BlockResult:
    """A formula equivalent to ``exists variables. matrix`` (matrix quantifier-free), see ``BlockResult``.

    THEOREM (Loos & Weispfenning 1993, Weispfenning 1997): (exists x. F) iff the disjunction over an elimination set
    of (guard and F at the point). Disjunctions are distributed over, conjuncts without common block variables are
    solved apart, and the variable with the cheapest elimination set goes first; nothing is expanded.
    ``simplify`` must return an equivalent formula. ``highest``: the degree (2 or 3) up to which variables are
    eliminated. Raises ``BudgetExceeded``.
    """
    formula = simplify(nnf(matrix))
    ring = formula.ring
    if ring is None:
        return BlockResult(formula, (), Leaf((), formula))
    run = _Run(ring, budget, simplify, highest)
    block = frozenset(ring.index[v] for v in variables if v in ring.index)
    result, tree, trace = run.solve(formula, block)
    answer = simplify(result)
    return BlockResult(
        answer, tuple(_existentials(answer)), tree, dict(run.stats), steps.Eliminated(formula, result, trace)
    )


def _existentials(formula: Formula) -> Iterator[Exists]:
    if isinstance(formula, Exists):
        yield formula
    elif isinstance(formula, And | Or):
        for arg in formula.args:
            yield from _existentials(arg)


Solved = tuple[Formula, Node, steps.Trace]


class _Run:
    """One elimination: ``solve`` maps a subproblem to an equivalent formula, its tree of solutions, and its trace."""

    __slots__ = ("budget", "done", "highest", "ring", "simplify", "stats")

    def __init__(self, ring: Ring, budget: Budget, simplify: Simplifier, highest: int) -> None:
        self.ring, self.budget, self.simplify, self.highest = ring, budget, simplify, highest
        self.done: dict[tuple[Formula, frozenset[int]], Solved] = {}
        self.stats = {"subproblems": 0, "test points": 0}

    def solve(self, formula: Formula, block: frozenset[int]) -> Solved:
        """``exists block. formula``; the formula is simplified and positive."""
        inside = occurring(formula) & block
        if not inside:
            return formula, Leaf((), formula), steps.Unchanged()
        key = (formula, inside)
        found = self.done.get(key)
        if found is None:
            self.budget.check("virtual substitution", self.stats["subproblems"])
            self.stats["subproblems"] += 1
            found = self.done[key] = self._solve(formula, inside)
        return found

    def _solve(self, formula: Formula, block: frozenset[int]) -> Solved:
        if isinstance(formula, Or):
            answer, tree, traces = self._any(self.solve(part, block) for part in formula.args)
            return answer, tree, steps.Alternatives(formula.args, traces)
        context, groups = connected(conjuncts(formula), lambda part: occurring(part) & block)
        parts = [conj(members) for _, members in groups]
        if not context and len(parts) == 1:
            return self._step(formula, parts[0], block)
        return self._all(context, parts, block)

    def _all(self, context: tuple[Formula, ...], parts: list[Formula], block: frozenset[int]) -> Solved:
        """exists x, y. C and F(x) and G(y)  iff  C and (exists x. F) and (exists y. G)."""
        answers: list[Formula] = list(context)
        trees: list[Node] = []
        parts_solved: list[steps.Part] = []
        for part in parts:
            # the context comes along as background knowledge and is taken out of the answer again
            whole, tree, trace = self._step(conj((*context, part)), part, block)
            formula = steps.without(whole, context)
            parts_solved.append(steps.Part(part, whole, trace))
            if formula == FALSE:
                return FALSE, NEVER, steps.Apart(context, tuple(parts_solved))
            answers.append(formula)
            trees.append(tree)
        return conj(answers), All((Leaf((), conj(context)), *trees)), steps.Apart(context, tuple(parts_solved))

    def _step(self, formula: Formula, part: Formula, block: frozenset[int]) -> Solved:
        """Eliminate one variable of ``part`` (``formula`` is ``part`` with its context), then the others."""
        everything = occurring(part)
        inside = everything & block
        if len(everything) == 1 and not has_root_atoms(part):
            return self._decide(part, self.ring.names[next(iter(inside))])
        strict = is_open(part, inside)
        plan = choose(formula, inside, strict=strict, highest=self.highest)
        if plan is not None:
            attempts: list[steps.Attempt] = []
            answer, tree, traces = self._any(self._alternatives(plan, formula, inside, strict, attempts))
            return answer, tree, steps.Substituted(plan, formula, inside, tuple(attempts), traces)
        cases = split_equation(formula, inside)
        if cases is not None:
            simple = tuple(map(self.simplify, cases))
            answer, tree, traces = self._any(self.solve(case, inside) for case in simple)
            return answer, tree, steps.Split(cases, simple, traces)
        remaining = Exists(tuple(self.ring.names[i] for i in sorted(inside)), part)
        return remaining, Leaf(remaining.variables, part), steps.Unchanged()

    def _decide(self, formula: Formula, variable: str) -> Solved:
        """A formula in one variable alone, of any degree."""
        self.budget.check("real roots")
        found = solution(formula, variable, {})
        if found is None:
            return FALSE, NEVER, steps.Decided(None)
        return TRUE, Lifted((Choice(variable, Value(found), 1, formula),), Leaf((), TRUE)), steps.Decided(found)

    def _alternatives(
        self, plan: Plan, before: Formula, block: frozenset[int], strict: bool, attempts: list[steps.Attempt]
    ) -> Iterator[Solved]:
        """The subproblems of a plan, solved one after the other, cheap test points first."""
        rest = block - {plan.x}

        def attempt(point: SymbolicPoint, guard: Formula, formula: Formula, settled: frozenset[Atom]) -> Solved:
            free = (a for a in conjuncts(formula) if plan.x not in occurring(a))
            known = NOTHING.extended((*free, *conjuncts(guard)))
            result = conj((guard, Substitution(plan.x, point, known, settled)(formula)))
            choice = Choice(self.ring.names[plan.x], point, plan.exponent, before)
            simple = self._counted(thinned(result, rest) if strict else result)
            attempts.append(steps.Attempt(point, guard, formula, settled, result, simple))
            return self._substituted(choice, simple, rest)

        for infinity in plan.infinities:
            yield attempt(infinity, plan.infinity_guard or TRUE, plan.formula, frozenset())
        for candidate, settled in in_order(plan.candidates):
            yield attempt(candidate.point, candidate.guard, candidate.formula, settled)
        if plan.degenerate != FALSE:
            simple = self.simplify(plan.degenerate)
            attempts.append(steps.Attempt(None, TRUE, plan.degenerate, frozenset(), plan.degenerate, simple))
            yield self.solve(simple, block)

    def _counted(self, result: Formula) -> Formula:
        """What a substitution gives, simplified; one more test point."""
        self.budget.check("virtual substitution", self.stats["test points"])
        self.stats["test points"] += 1
        self.budget.spend(SUBSTITUTION_COST)
        return self.simplify(result)

    def _substituted(self, choice: Choice, simple: Formula, rest: frozenset[int]) -> Solved:
        """The subproblem that a choice leaves, solved."""
        if simple == FALSE:
            return FALSE, NEVER, steps.Unchanged()
        answer, tree, trace = self.solve(simple, rest)
        return answer, Lifted((choice,), tree), trace

    def _any(self, alternatives: Iterable[Solved]) -> tuple[Formula, Node, steps.Traces]:
        """The disjunction; stops at the first alternative that is TRUE."""
        trees_by_formula: dict[Formula, Node] = {}
        traces: list[tuple[Formula, steps.Trace]] = []
        for formula, tree, trace in alternatives:
            traces.append((formula, trace))
            if formula == TRUE:
                return TRUE, tree, tuple(traces)
            if formula != FALSE:
                trees_by_formula.setdefault(formula, tree)
        trees = tuple(trees_by_formula.values())
        return disj(trees_by_formula), trees[0] if len(trees) == 1 else Any(trees), tuple(traces)

"""Methods that reduce a question to another one, with the way back from the outcome of that."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from qe.elimination.protocol import Context, Outcome
from qe.errors import Unable
from qe.exact.number import Values
from qe.exact.ring import Ring, format_poly
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert
from qe.formula.syntax import TRUE, And, Exists, Formula, Quantified
from qe.formula.traverse import atoms, bound_variables, map_atoms, subformulas
from qe.options import Options, Stage
from qe.proof.derivation import negated
from qe.proof.run_log import RunLog
from qe.proof.step import Nested
from qe.rules.lift import Solve
from qe.rules.preparation import Prepared, prepare
from qe.rules.step import StepKind
from qe.simplifier.simplify import simplify


def to_dual(problem: Block, log: RunLog) -> None:
    """The step from a problem to its existential dual."""
    rule, dual = "duality" if problem.universal else "negation normal form", problem.dual.formula
    log.step(rule, problem.formula, negated(dual) if problem.universal else dual)


def lifted_values(ready: Prepared, outcome: Outcome, log: RunLog) -> Values | None:
    """The values of all variables of a block from those that preparation kept; None where there are none, or they are
    too hard."""
    if outcome.formula != TRUE or outcome.witness is None:
        return None
    try:
        return ready.lift(outcome.witness)
    except Unable as error:
        log.switch("no witness", error)
        return None


class Simplification:
    """A question that says more than it has to: every method looks for forms that true conditions and factors hide."""

    name = "standard simplification"

    def suits(self, problem: Block, options: Options) -> str | None:
        return "conditions that say nothing new"

    def run(self, problem: Block, context: Context) -> Outcome | None:
        question = problem.formula
        simple = simplify(question, watch=context.budget.check)
        if _weight(simple) >= _weight(question):
            return None
        context.log.step(StepKind.SIMPLIFY.value, question, simple)

        def back(rest: Outcome) -> Outcome:
            values = rest.witness if type(simple) is type(question) else {}  # the block is gone: any values will do
            if problem.free or values is None or rest.formula != problem.asked(TRUE) or not problem.variables:
                return Outcome(rest.formula, order=rest.order)
            return Outcome(rest.formula, {v: values.get(v, Fraction(0)) for v in problem.variables})

        return Outcome(simple, back=back)


def _weight(formula: Formula) -> tuple[int, int]:
    """The atoms of a formula, and the sum of their degrees."""
    found = list(atoms(formula))
    return len(found), sum(a.poly.total_degree for a in found)


class Definitions:
    """What is there only to name a term is substituted first: no choice after that depends on it."""

    name = "definitions"

    def suits(self, problem: Block, options: Options) -> str | None:
        return "equations that are linear in a bound variable"

    def run(self, problem: Block, context: Context) -> Outcome | None:
        question, mark, ring = problem.formula, context.log.mark(), problem.formula.ring
        ready = prepare(question, budget=context.budget, enabled={StepKind.DEFINITION}, log=context.log)
        if ring is None or not any(step.rule == StepKind.LINEAR.value for step in context.log.steps(mark)):
            return None
        gone = {*bound_variables(question)} - {*bound_variables(ready.formula)}
        narrow = Ring.of(name for name in ring.names if name not in gone)  # as without the names: orders go by the ring

        def back(rest: Outcome) -> Outcome:
            formula = convert(rest.formula, ring)
            witness = rest.witness if type(ready.formula) is type(question) else {}
            if problem.free or witness is None or formula != problem.asked(TRUE) or not problem.variables:
                return Outcome(formula, order=rest.order)
            values = lifted_values(ready, Outcome(TRUE, witness), context.log)
            return Outcome(formula, values and {v: values[v] for v in problem.variables})

        return Outcome(convert(ready.formula, narrow), back=back)


class NormalPosition:
    """The bound variables of a question in affine coordinates in which its polynomials are short."""

    name = "normal position"

    def suits(self, problem: Block, options: Options) -> str | None:
        return "coordinates in which the polynomials are shorter"

    def run(self, problem: Block, context: Context) -> Outcome | None:
        from qe.rules.normal_position import coefficients, steps_to_normal_position

        current, ring, log = problem.formula, problem.formula.ring, context.log
        if ring is None or any(step.rule == StepKind.POSITION.value for step in log.steps()):
            return None
        blocks = [f.variables for f in subformulas(current) if isinstance(f, Quantified)]
        indices = [[ring.index[v] for v in names if v in ring.index] for names in blocks]
        steps = steps_to_normal_position(problem.polynomials, indices, context.budget.check)
        for names in blocks:
            inside = [step for step in steps if step.variable in names]
            block = next(f for f in subformulas(current) if isinstance(f, Quantified) and f.variables == names)
            moved, detail = moved_by(block, inside), ", ".join(map(written, inside))
            evidence = {"detail": detail, "proof": {"values": [(s.variable, coefficients(s)) for s in inside]}}
            log.step(StepKind.POSITION.value, block, moved, evidence=evidence)
            current = moved if current is block else moved_by(current, inside)

        def back(rest: Outcome) -> Outcome:
            values = None if rest.witness is None else dict(rest.witness)
            for step in reversed(steps):
                if values is not None and step.variable in values:
                    values[step.variable] = step.value(values)
            return replace(rest, witness=values, certificate=None, make=None)

        return Outcome(current, back=back) if steps else None


def moved_by(formula: Formula, steps: Sequence[Solve]) -> Formula:
    """The formula with the values of variables, which it binds, in their places."""
    from qe.rules.normal_position import at_steps

    return map_atoms(formula, lambda a: atom(at_steps(a.poly, steps), a.relation)) if steps else formula


def written(step: Solve) -> str:
    """The step as an equation."""
    return f"{step.variable} = ({format_poly(step.numerator)})/{step.denominator.constant_value()}"


class LocalVariables:
    """A sentence by one without its local variables (``qe.engine.local``)."""

    name = "local variables"

    def suits(self, problem: Block, options: Options) -> str | None:
        return "variables of one condition each"

    def run(self, problem: Block, context: Context) -> Outcome | None:
        from qe.engine.local import WORK, without_locals

        decide, budget = context.decide, context.budget
        if decide is None:
            return None
        options = context.options.with_(without=context.options.without | {Stage.SHORTENING})

        def eliminated(block: Formula) -> Nested | None:
            try:
                return decide(block, options, budget.part(WORK)).nested(block)
            except Unable:
                budget.check("local variables")
                return None

        shorter = without_locals(problem, context.options, eliminated)
        if shorter is None:
            return None
        to_dual(problem, context.log)
        context.log.take_up(shorter.steps)

        def back(rest: Outcome) -> Outcome:
            whole = options.with_(without=options.without | {Stage.MINISCOPING})  # the search takes all at once
            values = shorter.values(rest, lambda sentence: decide(sentence, whole, budget))
            return Outcome(problem.asked(rest.formula), values)

        return Outcome(shorter.formula, back=back)


def gathered_block(formula: Formula) -> Block | None:
    """The existential block of a conjunction together with the conditions that preparation moved out of it."""
    args = formula.args if isinstance(formula, And) else (formula,)
    blocks = [a for a in args if isinstance(a, Exists)]
    if len(blocks) != 1:
        return None
    rest = [a for a in args if a is not blocks[0]]
    body = conj((*rest, blocks[0].body))
    return Block(blocks[0].variables, body) if body.is_quantifier_free else None

"""Local variables first: those of a linear sentence with many cases that occur in one or two of its conditions.

THEOREM. ex x, y (f and g) iff ex x (f and ex y g), for y that are not free in f. So where ex y g is equivalent to a
formula that is no longer than g, the sentence loses the variables y, and with them cases that lead to the same:
(x < y and y < z) or (x < u and u < z), with y and u in no other condition, says x < z.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from qe.elimination.protocol import Outcome
from qe.engine.conditions import CASES_FROM, case_count, hopeless_cases
from qe.exact.number import Values
from qe.formula.block import Block
from qe.formula.build import conj, exists
from qe.formula.evaluate import substituted
from qe.formula.syntax import FALSE, TRUE, Exists, Formula
from qe.formula.traverse import atoms, conjuncts, connected
from qe.options import Options
from qe.proof.step import Nested, Step
from qe.rules.step import StepKind

VARIABLES_FROM = 8
"""In fewer variables, or with fewer cases than ``CASES_FROM``, the search is done sooner than this."""

MOST_ATOMS = 8
"""Conditions with more comparisons are left to the search: what they have to say of the others takes longer to find."""

WORK = 200
"""Units of work for the variables of one condition."""

SHARED_BY = 1, 2
"""Variables of one condition first; where there are none, of two."""

Eliminate = Callable[[Formula], Nested | None]
"""How the variables of a block with parameters are eliminated, or None."""


@dataclass(frozen=True, slots=True)
class WithoutLocals:
    """``formula``: the sentence without its local variables; ``steps`` lead to it; ``local``: conditions, each with the
    variables that it has lost, in which values for them have to satisfy it."""

    formula: Formula
    steps: tuple[Step, ...]
    local: tuple[tuple[tuple[str, ...], Formula], ...]

    def values(self, outcome: Outcome, decide: Callable[[Formula], Outcome]) -> Values | None:
        """Values for all variables from those with which the formula was found to be true; None where there are none.

        ``decide``: the outcome for a sentence.
        """
        if outcome.formula != TRUE or (outcome.witness is None and self.formula != TRUE):
            return None
        values: Values = dict(outcome.witness or {})
        lost = dict.fromkeys(name for names, _ in self.local for name in names)  # each free in one condition only
        known = {n: values.setdefault(n, Fraction(0)) for _, part in self.local for n in part.free if n not in lost}
        numbers = {name: value for name, value in known.items() if isinstance(value, Fraction)}
        if len(numbers) < len(known):
            return None
        sentence = exists(lost, conj([substituted(part, numbers) for _, part in self.local]))
        inner = decide(sentence)
        if inner.formula != TRUE or (inner.witness is None and sentence != TRUE):
            return None
        return values | dict.fromkeys(lost, Fraction(0)) | (inner.witness or {})


def without_locals(problem: Block, options: Options, eliminate: Eliminate) -> WithoutLocals | None:
    """An existential sentence, or the dual of a universal one, without local variables whose conditions do not grow;
    None where there are none."""
    if len(problem.variables) < VARIABLES_FROM or case_count(problem) < CASES_FROM:
        return None
    if problem.curved:
        return None
    problem = problem.dual
    for most in SHARED_BY:
        shortened = [
            (names, parts, shorter)
            for names, parts in _local(problem, most)
            if (shorter := _shorter(names, parts, eliminate))
        ]
        if shortened:
            false = [one for one in shortened if one[2].answer == FALSE]
            made = _without(problem, false[:1] or shortened)
            return made if made is not None and _is_left_to_search(made.formula, options) else None
    return None


def _is_left_to_search(formula: Formula, options: Options) -> bool:
    """Whether no cases are left, or still so many that the search takes them: a few are slower for other methods."""
    block = Block.of(formula)
    return block is None or not case_count(block) or hopeless_cases(block, options) is not None


def _local(problem: Block, most: int) -> Iterator[tuple[tuple[str, ...], list[Formula]]]:
    """Conditions, some of all, and the variables that occur in no others, each of them in so many at most."""
    parts = conjuncts(problem.body)
    times = Counter(name for part in parts for name in part.free)
    rare = frozenset(name for name in problem.variables if times[name] <= most)
    for names, group in connected(parts, lambda part: rare.intersection(part.free))[1]:
        if len(group) < len(parts) and sum(map(_size, group)) <= MOST_ATOMS:
            yield tuple(name for name in problem.variables if name in names), list(group)


def _shorter(names: tuple[str, ...], parts: list[Formula], eliminate: Eliminate) -> Nested | None:
    """How the variables are eliminated, if the conditions do not become longer by that."""
    nested = eliminate(exists(names, conj(parts)))
    if nested is None or not nested.answer.is_quantifier_free or _size(nested.answer) > sum(map(_size, parts)):
        return None
    return nested


def _without(problem: Block, chosen: list[tuple[tuple[str, ...], list[Formula], Nested]]) -> WithoutLocals | None:
    """The sentence with these blocks moved inwards and eliminated; None where no other variable is left."""
    gone = {name for names, _, _ in chosen for name in names}
    kept = tuple(name for name in problem.variables if name not in gone)
    taken = {part for _, parts, _ in chosen for part in parts}
    rest = [part for part in conjuncts(problem.body) if part not in taken]
    nested = exists(kept, conj((*rest, *(shorter.start for _, _, shorter in chosen))))
    if not isinstance(nested, Exists) or nested.variables != kept:
        return None
    opened = Step(StepKind.GATHERING.value, problem.formula, nested)
    steps = (opened, *(step for _, _, shorter in chosen for step in shorter.steps))
    formula = exists(kept, conj((*rest, *(shorter.answer for _, _, shorter in chosen))))
    return WithoutLocals(formula, steps, tuple((names, conj(parts)) for names, parts, _ in chosen))


def _size(formula: Formula) -> int:
    return sum(1 for _ in atoms(formula))

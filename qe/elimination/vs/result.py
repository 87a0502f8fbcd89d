"""What virtual substitution hands back: an equivalent formula, and how solutions are found (extended answers)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product

from qe.elimination.vs.points import TestPoint
from qe.elimination.vs.trace import Eliminated
from qe.elimination.vs.univariate_samples import solution
from qe.errors import InternalError
from qe.formula.build import conj
from qe.formula.syntax import Exists, Formula
from qe.options import Budget
from qe.rules.lift import Assignment, Value
from qe.rules.tree import All, Any, Leaf, Lifted, Node


@dataclass(frozen=True, slots=True)
class Choice:
    """``variable`` is replaced by ``point`` (its ``exponent``-th power is, if that is not 1).

    ``before`` is the formula in which the substitution took place: wherever the guard of the answer holds and the
    variables chosen later have suitable values, it has a solution in ``variable``; every such solution will do.
    """

    variable: str
    point: TestPoint
    exponent: int
    before: Formula

    def value(self, assignment: Assignment) -> Value:
        """A solution of ``before`` where the other variables have these values, or 0 if they have none.

        Raises ``Unable`` for formulas with root atoms, ``InternalError`` if there is no solution.
        """
        others = {name: assignment.get(name, Fraction(0)) for name in self.before.free}
        found = solution(self.before, self.variable, others)
        if found is None:
            raise InternalError(f"no solution for {self.variable}: its elimination was not an equivalence")
        return found


@dataclass(frozen=True, slots=True)
class Answer:
    """A parametric witness: wherever ``guard`` holds, the ``choices`` (in elimination order) give a solution.

    The point of a choice may mention the parameters and the variables of later choices.
    """

    guard: Formula
    choices: tuple[Choice, ...]

    def witness(self, parameters: Assignment | None = None, *, budget: Budget) -> dict[str, Value]:
        """Values for the variables of the block, at these values of the parameters, where the guard holds: real numbers
        for infinitesimals and infinities, too. Variables that take no part get 0.

        THEOREM: the choices are made last to first; each is any solution of the formula in which its variable was
        eliminated, at the values chosen already. That formula has one, because its elimination was an equivalence;
        ``univariate_samples.solution`` finds and checks it by exact evaluation. Raises as ``Choice.value``.
        """
        values, given = dict(parameters or {}), set(parameters or ())
        for choice in reversed(self.choices):
            budget.check("witness")
            for name in choice.before.free:
                values.setdefault(name, Fraction(0))
            values[choice.variable] = choice.value(values)
        return {name: value for name, value in values.items() if name not in given}

    def __str__(self) -> str:
        terms = ", ".join(
            f"{c.variable if c.exponent == 1 else f'{c.variable}^{c.exponent}'} = {c.point}" for c in self.choices
        )
        return f"{terms or 'anything'} if {self.guard}"


@dataclass(frozen=True, slots=True)
class BlockResult:
    """``formula`` is equivalent to the eliminated block.

    It is quantifier-free in the other variables if ``remaining`` is empty. Otherwise it contains the existential
    subformulas listed in ``remaining``, over block variables of too high a degree, for another method to continue.
    ``tree``: how solutions are found; its leaves without variables hold the guards, its rules are choices. ``trace``:
    how the answer was found (None where nothing was to be eliminated).
    """

    formula: Formula
    remaining: tuple[Exists, ...]
    tree: Node
    stats: Mapping[str, int] = field(default_factory=dict)
    trace: Eliminated | None = field(default=None, repr=False)

    @property
    def answers(self) -> Iterator[Answer]:
        """Parametric witnesses; if ``remaining`` is empty, their guards cover ``formula``."""
        for guards, choices in _enumerate(self.tree):
            yield Answer(conj(guards), choices)


def _enumerate(tree: Node) -> Iterator[tuple[tuple[Formula, ...], tuple[Choice, ...]]]:
    match tree:
        case Leaf((), body):
            yield (body,), ()
        case Lifted(rules, child):
            chosen = tuple(rule for rule in rules if isinstance(rule, Choice))
            for guards, choices in _enumerate(child):
                yield guards, chosen + choices
        case Any(children):
            for child in children:
                yield from _enumerate(child)
        case All(children):
            for picked in product(*(tuple(_enumerate(child)) for child in children)):
                yield sum((g for g, _ in picked), ()), sum((c for _, c in picked), ())

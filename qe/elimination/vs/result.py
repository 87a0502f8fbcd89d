"""What virtual substitution hands back: an equivalent formula, and how solutions are found (extended answers)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product

from qe.elimination.vs.points import TestPoint
from qe.formula.build import conj
from qe.formula.syntax import Exists, Formula


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


@dataclass(frozen=True, slots=True)
class Answer:
    """A parametric witness: wherever ``guard`` holds, the ``choices`` (in elimination order) give a solution.

    The point of a choice may mention the parameters and the variables of later choices.
    """

    guard: Formula
    choices: tuple[Choice, ...]

    def __str__(self) -> str:
        terms = ", ".join(
            f"{c.variable if c.exponent == 1 else f'{c.variable}^{c.exponent}'} = {c.point}" for c in self.choices
        )
        return f"{terms or 'anything'} if {self.guard}"


# --- the tree of solutions, enumerated lazily ------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Done:
    """No variable is left; solutions exist where ``formula`` holds."""

    formula: Formula


@dataclass(frozen=True, slots=True)
class Open:
    """Variables are left that virtual substitution cannot eliminate: no parametric witness."""

    formula: Exists


@dataclass(frozen=True, slots=True)
class Chosen:
    """A choice, then the rest."""

    choice: Choice
    rest: Tree


@dataclass(frozen=True, slots=True)
class Any:
    """Solutions of any of the alternatives."""

    alternatives: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class All:
    """Where ``context`` holds: a solution of every part, in disjoint variables."""

    context: Formula
    parts: tuple[Tree, ...]


Tree = Done | Open | Chosen | Any | All


@dataclass(frozen=True, slots=True)
class BlockResult:
    """``formula`` is equivalent to the eliminated block.

    It is quantifier-free in the other variables if ``remaining`` is empty. Otherwise it contains the existential
    subformulas listed in ``remaining``, over block variables of too high a degree, for another method to continue.
    """

    formula: Formula
    remaining: tuple[Exists, ...]
    tree: Tree
    stats: Mapping[str, int] = field(default_factory=dict)

    @property
    def answers(self) -> Iterator[Answer]:
        """Parametric witnesses; if ``remaining`` is empty, their guards cover ``formula``."""
        for guards, choices in _enumerate(self.tree):
            yield Answer(conj(guards), choices)


def _enumerate(tree: Tree) -> Iterator[tuple[tuple[Formula, ...], tuple[Choice, ...]]]:
    match tree:
        case Done(formula):
            yield (formula,), ()
        case Chosen(choice, rest):
            for guards, choices in _enumerate(rest):
                yield guards, (choice, *choices)
        case Any(alternatives):
            for alternative in alternatives:
                yield from _enumerate(alternative)
        case All(context, parts):
            for picked in product(*(tuple(_enumerate(p)) for p in parts)):
                guards = sum((g for g, _ in picked), (context,))
                yield guards, sum((c for _, c in picked), ())

"""What became of one existential block: a tree of smaller problems, with the way back to a witness.

Every node stands for a formula (``formula``) and for the block's variables that still occur under it.
``lift`` turns values that satisfy the node's matrix into values for the variables the node started with.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from qe.errors import Unable
from qe.formula.build import conj, disj, exists
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.rules.lift import Assignment, Lift, Value, holds_at, perturb


@dataclass(frozen=True, slots=True)
class Leaf:
    """exists variables. body: nothing more was done. Lifts to itself."""

    variables: tuple[str, ...]
    body: Formula

    @property
    def formula(self) -> Formula:
        return exists(self.variables, self.body)

    def satisfied(self, at: Assignment) -> bool:
        return holds_at(self.body, at)

    def lift(self, at: Assignment) -> dict[str, Value]:
        return dict(at)


@dataclass(frozen=True, slots=True)
class Pending(Leaf):
    """A leaf that is still to be reduced, where ``given`` holds beside what is known already."""

    given: tuple[Formula, ...] = ()


class _Above:
    """What says what its child says."""

    __slots__ = ()
    child: Node

    @property
    def formula(self) -> Formula:
        return self.child.formula

    def satisfied(self, at: Assignment) -> bool:
        return self.child.satisfied(at)


@dataclass(frozen=True, slots=True)
class Lifted(_Above):
    """The ``rules``, last one first, give their variables values from the child's assignment."""

    rules: tuple[Lift, ...]
    child: Node

    def lift(self, at: Assignment) -> dict[str, Value]:
        known = self.child.lift(at)
        for rule in reversed(self.rules):
            known[rule.variable] = rule.value(known)
        return known


@dataclass(frozen=True, slots=True)
class Perturbed(_Above):
    """The child's formula left out inequations of ``body``; its solution is moved a little where they fail."""

    variables: tuple[str, ...]
    body: Formula
    child: Node

    def lift(self, at: Assignment) -> dict[str, Value]:
        return perturb(self.variables, self.body, self.child.lift(at))


@dataclass(frozen=True, slots=True)
class Any:
    """The disjunction of the children; an assignment is lifted by a child that it satisfies."""

    children: tuple[Node, ...]

    @property
    def formula(self) -> Formula:
        return disj(c.formula for c in self.children)

    def satisfied(self, at: Assignment) -> bool:
        return any(c.satisfied(at) for c in self.children)

    def lift(self, at: Assignment) -> dict[str, Value]:
        if len(self.children) == 1:
            return self.children[0].lift(at)
        for child in self.children:
            if child.satisfied(at):
                return child.lift(at)
        raise Unable("the assignment satisfies no branch of the prepared formula")


@dataclass(frozen=True, slots=True)
class All:
    """The conjunction of the children, which share no variable of the block: their values are put together."""

    children: tuple[Node, ...]

    @property
    def formula(self) -> Formula:
        return conj(c.formula for c in self.children)

    def satisfied(self, at: Assignment) -> bool:
        return all(c.satisfied(at) for c in self.children)

    def lift(self, at: Assignment) -> dict[str, Value]:
        values = dict(at)
        for child in self.children:
            values = child.lift(values)
        return values


Node = Leaf | Pending | Lifted | Perturbed | Any | All
NEVER = Leaf((), FALSE)


def solved(rules: Sequence[Lift], variables: Sequence[str], body: Formula) -> Lifted:
    """The block without the variables to which the rules give values, still to be reduced."""
    gone = {rule.variable for rule in rules}
    return Lifted(tuple(rules), Pending(tuple(v for v in variables if v not in gone), body))


def either(nodes: Iterable[Node]) -> Node:
    """The disjunction of nodes: without the impossible ones; one that is certain stands alone, and ends the search."""
    possible: list[Node] = []
    for node in nodes:
        if node.formula == TRUE:
            return node
        if node is not NEVER and node.formula != FALSE:
            possible.append(node)
    if not possible:
        return NEVER
    return possible[0] if len(possible) == 1 else Any(tuple(possible))

"""The names of a surface tree, and how deep it is: what has to be known before it is lowered."""

from __future__ import annotations

from collections.abc import Container

from qe.io.surface import (
    MAX_DEPTH,
    Apply,
    Choice,
    Comparison,
    Equivalence,
    Every,
    Fail,
    Implication,
    Meet,
    Minus,
    Name,
    Negation,
    Node,
    Number,
    Polynomial,
    Power,
    Product,
    Quantification,
    Quantity,
    Quotient,
    Root,
    Some,
    Sum,
    Term,
)


def chain(term: Term, known: Container[int] = ()) -> tuple[Term, list[Product | Quotient]]:
    """``a*b/c*…`` as a and the steps that follow it: the chain may be long, so nothing recurses along it.

    It starts at a part whose identity is ``known``, if there is one.
    """
    links: list[Product | Quotient] = []
    while isinstance(term, Product | Quotient) and id(term) not in known:
        links.append(term)
        term = term.left
    return term, links[::-1]


class Names:
    """Collects the names of a tree, free before bound, and refuses trees that are nested too deeply.

    ``special`` counts the parts that may need a name of their own.
    """

    def __init__(self, fail: Fail, meet: Meet) -> None:
        self.fail, self.meet = fail, meet
        self.free: dict[str, None] = {}
        self.bound: dict[str, None] = {}
        self.special = 0

    def all(self) -> list[str]:
        """The names, each once: free ones in order of appearance, then bound ones in order of quantification."""
        return [*self.free, *(name for name in self.bound if name not in self.free)]

    def node(self, node: Node, scope: frozenset[str], depth: int) -> None:
        if depth > MAX_DEPTH:
            raise self.fail(f"nested more than {MAX_DEPTH} levels deep", -1)
        match node:
            case Comparison():
                for side in node.sides:
                    self.term(side, scope, depth + 1)
            case Every(parts) | Some(parts):
                for part in parts:
                    self.node(part, scope, depth + 1)
            case Negation(part):
                self.node(part, scope, depth + 1)
            case Implication(left, right) | Equivalence(left, right):
                self.node(left, scope, depth + 1)
                self.node(right, scope, depth + 1)
            case Quantification(_, names, body):
                self.bound.update(dict.fromkeys(names))
                self.node(body, scope.union(names), depth + 1)
            case Quantity(_, count, name, body):
                self.bound[name] = None
                self.special += count + 2
                self.node(body, scope | {name}, depth + 1)

    def term(self, term: Term, scope: frozenset[str], depth: int) -> None:
        if depth > MAX_DEPTH:
            raise self.fail(f"nested more than {MAX_DEPTH} levels deep", -1)
        match term:
            case Name(name, at):
                self.name(name, at, scope)
            case Polynomial(terms):
                for name in dict.fromkeys(name for names in terms for name in names):
                    self.name(name, -1, scope)
            case Sum(parts):
                for part in parts:
                    self.term(part, scope, depth + 1)
            case Product() | Quotient():
                first, links = chain(term)
                self.term(first, scope, depth + 1)
                for link in links:
                    self.special += isinstance(link, Quotient) and not isinstance(link.right, Number)
                    self.term(link.right, scope, depth + 1)
            case Power(base, exponent, _):
                self.special += not isinstance(exponent, Number) or exponent.value.denominator > 1
                self.term(base, scope, depth + 1)
                self.term(exponent, scope, depth + 1)
            case Minus(part):
                self.term(part, scope, depth + 1)
            case Root():
                self.root(term, scope, depth)
            case Apply(_, arguments):
                self.special += 1
                for argument in arguments:
                    self.term(argument, scope, depth + 1)
            case Choice(condition, then, other):
                self.special += 1
                self.node(condition, scope, depth + 1)
                self.term(then, scope, depth + 1)
                if other is not None:
                    self.term(other, scope, depth + 1)

    def name(self, name: str, at: int, scope: frozenset[str]) -> None:
        if name not in scope:
            self.meet(name, at)
            self.free[name] = None

    def root(self, term: Root, scope: frozenset[str], depth: int) -> None:
        """A root in a variable binds it, and may stand for a number of its own."""
        self.special += 1
        self.term(term.poly, scope, depth + 1)
        if term.variable is not None and term.variable not in scope:  # met in the polynomial, or refused later
            self.free[term.variable] = None

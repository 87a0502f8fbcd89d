"""The names of a surface tree, and how deep it is: what has to be known before it is lowered."""

from __future__ import annotations

import itertools
from collections.abc import Container

from qe.io.sharing import inside
from qe.io.surface import (
    MAX_DEPTH,
    Apply,
    Choice,
    Fail,
    Meet,
    Name,
    Number,
    Part,
    Polynomial,
    Power,
    Product,
    Quantification,
    Quantity,
    Quotient,
    Root,
    Term,
)
from qe.spelling import PI, WORDS_FOR_PI


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
        if PI in self.bound or (PI in self.free and not self.bound.keys().isdisjoint(WORDS_FOR_PI)):
            raise self.fail("pi is a number here; a variable of this name is written `pi`", -1)
        return [*self.free, *(name for name in self.bound if name not in self.free)]

    def part(self, part: Part, scope: frozenset[str] = frozenset(), depth: int = 0) -> None:
        """Collect what stands in a node or term under quantifiers that bind the names of ``scope``."""
        if depth > MAX_DEPTH:
            raise self.fail(f"nested more than {MAX_DEPTH} levels deep", -1)
        children = inside(part)
        match part:
            case Name(name, at):
                self.name(name, at, scope)
            case Polynomial(terms):
                for name in dict.fromkeys(itertools.chain.from_iterable(terms)):
                    if name not in scope:
                        self.name(name, -1, scope)
            case Product() | Quotient():
                first, links = chain(part)
                self.special += sum(isinstance(x, Quotient) and not isinstance(x.right, Number) for x in links)
                children = [first, *(link.right for link in links)]
            case Power(_, exponent, _):
                self.special += not isinstance(exponent, Number) or exponent.value.denominator > 1
            case Quantification(_, names, _):
                self.bound.update(dict.fromkeys(names))
                scope = scope.union(names)
            case Quantity(_, count, name, _):
                self.bound[name] = None
                self.special += count + 2
                scope |= {name}
            case Root():
                self.special += 1
                children = [part.poly]
            case Apply() | Choice():
                self.special += 1
        for child in children:
            self.part(child, scope, depth + 1)
        if isinstance(part, Root) and part.variable is not None and part.variable not in scope:
            self.free[part.variable] = None  # met in the polynomial, or refused later

    def name(self, name: str, at: int, scope: frozenset[str]) -> None:
        if name not in scope:
            self.meet(name, at)
            self.free[name] = None

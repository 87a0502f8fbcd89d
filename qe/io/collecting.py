"""The names of a surface tree, and how deep it is: what has to be known before it is lowered."""

from __future__ import annotations

import itertools
from collections.abc import Container

from qe.io import surface as s
from qe.io.sharing import inside
from qe.spelling import PI, WORDS_FOR_PI


def chain(term: s.Term, known: Container[int] = ()) -> tuple[s.Term, list[s.Product | s.Quotient]]:
    """``a*b/c*…`` as a and the steps that follow it: the chain may be long, so nothing recurses along it.

    It starts at a part whose identity is ``known``, if there is one.
    """
    links: list[s.Product | s.Quotient] = []
    while isinstance(term, s.Product | s.Quotient) and id(term) not in known:
        links.append(term)
        term = term.left
    return term, links[::-1]


class Names:
    """Collects the names of a tree, free before bound, and refuses trees that are nested too deeply.

    ``special`` counts the parts that may need a name of their own.
    """

    def __init__(self, fail: s.Fail, meet: s.Meet) -> None:
        self.fail, self.meet = fail, meet
        self.free: dict[str, None] = {}
        self.bound: dict[str, None] = {}
        self.special = 0

    def all(self) -> list[str]:
        """The names, each once: free ones in order of appearance, then bound ones in order of quantification."""
        if PI in self.bound or (PI in self.free and not self.bound.keys().isdisjoint(WORDS_FOR_PI)):
            raise self.fail("pi is a number here; a variable of this name is written `pi`", -1)
        return [*self.free, *(name for name in self.bound if name not in self.free)]

    def part(self, part: s.Part, scope: frozenset[str] = frozenset(), depth: int = 0) -> None:
        """Collect what stands in a node or term under quantifiers that bind the names of ``scope``."""
        if depth > s.MAX_DEPTH:
            raise self.fail(f"nested more than {s.MAX_DEPTH} levels deep", -1)
        children = inside(part)
        match part:
            case s.Name(name, at):
                self.name(name, at, scope)
            case s.Polynomial(terms):
                for name in dict.fromkeys(itertools.chain.from_iterable(terms)):
                    if name not in scope:
                        self.name(name, -1, scope)
            case s.Product() | s.Quotient():
                first, links = chain(part)
                self.special += sum(isinstance(x, s.Quotient) and not isinstance(x.right, s.Number) for x in links)
                children = [first, *(link.right for link in links)]
            case s.Power(_, exponent, _):
                self.special += not isinstance(exponent, s.Number) or exponent.value.denominator > 1
            case s.Quantification(_, names, _):
                self.bound.update(dict.fromkeys(names))
                scope = scope.union(names)
            case s.Quantity(_, count, name, _):
                self.bound[name] = None
                self.special += count + 2
                scope |= {name}
            case s.Root():
                self.special += 1
                children = [part.poly]
            case s.Apply() | s.Choice():
                self.special += 1
        for child in children:
            self.part(child, scope, depth + 1)
        if isinstance(part, s.Root) and part.variable is not None and part.variable not in scope:
            self.free[part.variable] = None  # met in the polynomial, or refused later

    def name(self, name: str, at: int, scope: frozenset[str]) -> None:
        if name not in scope:
            self.meet(name, at)
            self.free[name] = None

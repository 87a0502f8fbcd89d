"""Names for parts of a question that others share, so that nothing is written out again and again; all names in one.

THEOREM. Let b be a new variable and P a part of F without bound variables. Then F has a solution iff
``(b <-> P) and F'`` has one, F' being F with b in place of P (G. S. Tseitin, On the complexity of derivation in
propositional calculus, 1968); so has it for a term t that always has a value and ``b = t``. A solution of F gives one
of the other by the value of P there; and a solution of the other is one of F.

Equivalences, exclusive disjunctions and conditions of case distinctions are said twice, once as they are and once
denied: nested in each other k times they would be 2^k parts.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Container, Iterable, Sequence
from math import prod
from typing import NamedTuple, TypeAlias, cast

from qe.errors import Unable
from qe.formula.features import written_out
from qe.formula.relation import Relation
from qe.formula.syntax import Formula
from qe.io import surface as s
from qe.spelling import PI, WORDS_FOR_PI

MOST_WRITTEN = 200_000
"""Parts of a question, written out, that share much; beyond them it is refused."""

MUCH = 8
"""How many times as long a question is written out that shares much."""

LONG = 20_000
"""Parts of a question, written out, up to which nothing is named."""

_LEAVES = (s.Polynomial, s.Number, s.Name)
_SHORT, _MANY = 8, 16
"""Parts up to which what is shared stays where it is; cases of a term from which on it gets a name."""

Make: TypeAlias = Callable[[], str]
_CASES = 2**64


class Named(NamedTuple):
    """``nodes`` with names in place of some parts; the ``definitions`` say what the ``names`` mean; ``shared`` are the
    parts that stand in the place of those that were shared, in their order."""

    nodes: list[s.Node]
    definitions: list[s.Node]
    names: list[str]
    shared: list[s.Part]


def inside(part: s.Part) -> Sequence[s.Part]:
    """The parts directly inside another."""
    if isinstance(part, s.Comparison):
        return part.sides
    if isinstance(part, s.Every | s.Some):
        return part.parts
    children: list[s.Part] = []
    for field in part:
        if isinstance(field, list):
            children += [cast(s.Part, item) for item in field if isinstance(item, tuple)]
        elif isinstance(field, tuple):
            children.append(cast(s.Part, field))
    return children


def ordered(roots: Iterable[s.Part]) -> list[s.Part]:
    """All different parts, each after those inside it."""
    parts: dict[int, s.Part] = {}
    pending: list[tuple[s.Part, bool]] = [(root, False) for root in roots]
    while pending:
        part, done = pending.pop()
        if done:
            parts.setdefault(id(part), part)
        elif id(part) not in parts:
            pending.append((part, True))
            for child in inside(part):
                if isinstance(child, _LEAVES):
                    parts[id(child)] = child
                else:
                    pending.append((child, False))
    return list(parts.values())


def refuse_long(parts: Sequence[s.Part]) -> None:
    """Raise ``Unable`` where equivalences nested in each other, and what is shared, would be far too much written out.
    ``parts``: all that there are, each after those inside it; terms count as one."""
    _refuse(_longest(parts), len(parts))


def _longest(parts: Sequence[s.Part]) -> int:
    """How long the longest part is written out, terms counted as one part."""
    sizes: dict[int, int] = {}
    for part in parts:
        size = 0
        if part.__class__ in s.NODES:
            size = 1 + sum([sizes[id(child)] for child in inside(part)])
        sizes[id(part)] = min(2 * size if isinstance(part, s.Equivalence | s.Quantity) else size, _CASES)
    return max(sizes.values(), default=0)


def refuse_shared(formula: Formula) -> None:
    """The same for a formula that is read."""
    _refuse(*written_out(formula))


def _refuse(size: int, different: int) -> None:
    if size > max(MOST_WRITTEN, MUCH * different):
        count = f"{size:,}" if size < 10**12 else "more than 10^12"
        raise Unable(f"written out, <->, xor and shared parts make {count} parts; name some: ex p. (p > 0 <-> …) and …")


def named(nodes: Sequence[s.Node], shared: Sequence[s.Part], bound: Collection[str], make: Make) -> Named:
    """The nodes, asserted together, with names that ``make`` makes for parts that would be written out many times; not
    for what has a name that quantifiers bind (``bound``), nor in small questions."""
    parts = ordered(nodes)
    sizes = _sizes(parts)
    if sum(sizes[id(node)][0] for node in nodes) <= max(LONG, 2 * len(parts)):
        return Named(list(nodes), [], [], list(shared))
    naming = _Naming(parts, bound, make)
    for part in parts:
        naming.replace(part)
    new, kept = naming.now, [naming.meant[id(part)] for part in shared if id(part) in naming.meant]
    return Named([cast(s.Node, new[id(n)]) for n in nodes], naming.definitions, naming.names, kept)


def _sizes(parts: Sequence[s.Part]) -> dict[int, tuple[int, int]]:
    """How long each part is written out, and how many cases a term has."""
    sizes: dict[int, tuple[int, int]] = {}
    for part in parts:
        size = 1 + sum(sizes[id(child)][0] * _times(part, child) for child in inside(part))
        cases = _cases(part, [sizes[id(child)][1] for child in inside(part)])
        if isinstance(part, s.Node):
            size, cases = size * cases, 1
        sizes[id(part)] = min(size if cases > 1 or isinstance(part, s.Node) else 1, _CASES), min(cases, _CASES)
    return sizes


def _cases(part: s.Part, inner: Sequence[int]) -> int:
    """How many cases a term has, those inside having so many."""
    if isinstance(part, s.Choice):
        return sum(inner[1:])
    return prod(inner) * (2 if _has_cases(part) else 1)


def _has_cases(part: s.Part) -> bool:
    """Whether what a term is may depend on a case distinction."""
    if isinstance(part, s.Quotient):
        return not isinstance(part.right, s.Number)
    return isinstance(part, s.Choice | s.Apply)


def _times(part: s.Part, child: s.Part) -> int:
    """How often a part says what is inside it."""
    twice = isinstance(part, s.Equivalence | s.Quantity) or (isinstance(part, s.Choice) and child is part.condition)
    return 2 if twice else 1


class _Naming:
    """``now``: what stands for each part, by its identity."""

    def __init__(self, parts: Sequence[s.Part], bound: Collection[str], make: Make) -> None:
        self.bound, self.make = bound, make
        self.now: dict[int, s.Part] = {}
        self.meant: dict[int, s.Part] = {}
        self.sizes: dict[int, int] = {}
        self.cases: dict[int, int] = {}
        self.logical = _longest(parts) > max(LONG, 2 * len(parts))
        self.fixed: set[int] = set()
        self.definitions: list[s.Node] = []
        self.names: list[str] = []
        self.uses: dict[int, int] = {}
        for part in parts:
            for child in inside(part):
                self.uses[id(child)] = self.uses.get(id(child), 0) + _times(part, child)

    def replace(self, part: s.Part) -> None:
        """Find what stands for a part, after those inside it."""
        children = inside(part)
        self.sizes[id(part)] = 1 + sum(self.sizes[id(child)] * _times(part, child) for child in children)
        cases = _cases(part, [self.cases[id(child)] for child in children])
        self.cases[id(part)] = 1 if isinstance(part, s.Node) else min(cases, _CASES)
        if self.names_bound(part) or any(id(child) in self.fixed for child in children):
            self.fixed.add(id(part))
        meant = self.meant[id(part)] = self.rebuilt(part)
        self.now[id(part)] = meant
        if id(part) not in self.fixed and self.worth(part):
            self.name(part, meant)

    def names_bound(self, part: s.Part) -> bool:
        """Whether a part may not be named for what it says itself: a bound variable, or no value."""
        match part:
            case s.Name(name):
                return name in self.bound
            case s.Polynomial(terms):
                return any(name in self.bound for names in terms for name in names)
        return isinstance(part, s.Root | s.Infinity)

    def worth(self, part: s.Part) -> bool:
        if isinstance(part, s.Node):
            shared = self.logical and self.uses.get(id(part), 0) > 1 and self.sizes[id(part)] > _SHORT
            return shared and not isinstance(part, s.Comparison | s.Truth)
        return _has_cases(part) and self.cases[id(part)] >= _MANY

    def name(self, part: s.Part, meant: s.Part) -> None:
        name = self.make()
        value = s.Name(name, -1)
        self.names.append(name)
        self.sizes[id(part)] = self.cases[id(part)] = 1
        if isinstance(meant, s.Node):
            truth = s.Comparison([value, s.Number(0)], [Relation.GT], -1)
            self.definitions.append(s.Equivalence(truth, meant))
            self.now[id(part)] = truth
        else:
            self.definitions.append(s.Comparison([value, meant], [Relation.EQ], -1))
            self.now[id(part)] = value

    def rebuilt(self, part: s.Part) -> s.Part:
        """The part, made of what stands for those inside it."""
        if all(self.now[id(child)] is child for child in inside(part)):
            return part

        def put(field: object) -> object:
            return [*map(put, field)] if isinstance(field, list) else self.now.get(id(field), field)

        return cast(Callable[..., s.Part], type(part))(*map(put, part))


def chain(term: s.Term, known: Container[int] = ()) -> tuple[s.Term, list[s.Product | s.Quotient]]:
    """``a*b/c*…`` as a (or a part whose identity is ``known``) and the steps that follow it, without recursion."""
    links: list[s.Product | s.Quotient] = []
    while isinstance(term, s.Product | s.Quotient) and id(term) not in known:
        links.append(term)
        term = term.left
    return term, links[::-1]


class Names:
    """The names of a tree, free before bound; trees that are nested too deeply are refused. ``special`` counts the
    parts that may need a name of their own."""

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

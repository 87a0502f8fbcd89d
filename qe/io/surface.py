"""What readers build before names are resolved: terms and formulas as written, with positions.

``lower`` turns such a tree into a ``Formula``: it collects the names (free ones in order of appearance,
then bound ones in order of quantification) into one ring, does the exact arithmetic, and moves every
relation to the form ``poly relation 0``. Scoping stays where it was written: a name may be bound twice or
be free and bound; ``qe.formula.normal.rename_apart`` resolves that when it matters.

``at`` is an offset into the text (-1: unknown). Lists are filled while parsing and not changed later.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Sequence
from fractions import Fraction
from typing import NamedTuple, TypeAlias

from qe.errors import InputError
from qe.exact.ring import Ring
from qe.formula.build import conj, disj, exists, forall, iff, implies, neg, root_atom
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.io import terms
from qe.io.terms import TermError, Value

MAX_DEPTH = 120
"""Nesting of brackets, operators and quantifiers that readers accept; all later code may recurse on it."""

Fail: TypeAlias = Callable[[str, int], InputError]
Meet: TypeAlias = Callable[[str, int], None]
"""Called with every free occurrence of a name and its offset; may raise."""


class Number(NamedTuple):
    """An exact rational number."""

    value: Fraction | int


class Name(NamedTuple):
    """A variable."""

    name: str
    at: int


class Sum(NamedTuple):
    """A sum of at least two parts."""

    parts: list[Term]


class Product(NamedTuple):
    """``left * right``."""

    left: Term
    right: Term
    at: int


class Quotient(NamedTuple):
    """``left / right``."""

    left: Term
    right: Term
    at: int


class Power(NamedTuple):
    """``base ^ exponent``."""

    base: Term
    exponent: Term
    at: int


class Minus(NamedTuple):
    """``-part``."""

    part: Term


class Root(NamedTuple):
    """The ``number``-th root of ``poly`` in ``variable`` (None: the other side of the comparison)."""

    number: Term
    poly: Term
    variable: str | None
    at: int


class Comparison(NamedTuple):
    """``sides[0] relations[0] sides[1] relations[1] sides[2] …``, read as a conjunction."""

    sides: list[Term]
    relations: list[Relation]
    at: int


class Truth(NamedTuple):
    """``true`` or ``false``."""

    value: bool


class Every(NamedTuple):
    """A conjunction."""

    parts: list[Node]


class Some(NamedTuple):
    """A disjunction."""

    parts: list[Node]


class Negation(NamedTuple):
    """``not part``."""

    part: Node


class Implication(NamedTuple):
    """``left -> right``."""

    left: Node
    right: Node


class Equivalence(NamedTuple):
    """``left <-> right``."""

    left: Node
    right: Node


class Quantification(NamedTuple):
    """``all names. body`` or ``ex names. body``."""

    universal: bool
    names: list[str]
    body: Node


Term: TypeAlias = Number | Name | Sum | Product | Quotient | Power | Minus | Root
Node: TypeAlias = Comparison | Truth | Every | Some | Negation | Implication | Equivalence | Quantification
Part: TypeAlias = Term | Node


def lower(
    node: Node,
    fail: Fail,
    *,
    names: Iterable[str] | None = None,
    shared: Sequence[Part] = (),
    meet: Meet = lambda name, at: None,
) -> Formula:
    """The formula that ``node`` means; ``fail(message, at)`` makes the error for a position.

    With ``names`` (all names, for the ring) the tree may be a graph whose parts are shared; ``shared`` lists parts
    in an order in which each comes after those it uses, so that chains of definitions of any length are fine.
    """
    found = _Names(fail, meet)
    if not shared:
        found.node(node, frozenset(), 0)
    lowering = _Lowering(found.ring() if names is None else Ring.of(names), fail)
    for part in shared:
        lowering.remember(part)
    return lowering.node(node)


def lower_term(term: Term, fail: Fail, *, meet: Meet = lambda name, at: None) -> Value:
    """The polynomial over Q that ``term`` means, in the ring of its names."""
    found = _Names(fail, meet)
    found.term(term, frozenset(), 0)
    return _Lowering(found.ring(), fail).term(term)


def _chain(term: Term, known: Container[int] = ()) -> tuple[Term, list[Product | Quotient]]:
    """``a*b/c*…`` as a and the steps that follow it: the chain may be long, so nothing recurses along it.

    It starts at a part whose identity is ``known``, if there is one.
    """
    links: list[Product | Quotient] = []
    while isinstance(term, Product | Quotient) and id(term) not in known:
        links.append(term)
        term = term.left
    return term, links[::-1]


class _Names:
    """Collects the names of a tree, free before bound, and refuses trees that are nested too deeply."""

    def __init__(self, fail: Fail, meet: Meet) -> None:
        self.fail, self.meet = fail, meet
        self.free: dict[str, None] = {}
        self.bound: dict[str, None] = {}

    def ring(self) -> Ring:
        return Ring.of([*self.free, *(name for name in self.bound if name not in self.free)])

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

    def term(self, term: Term, scope: frozenset[str], depth: int) -> None:
        if depth > MAX_DEPTH:
            raise self.fail(f"nested more than {MAX_DEPTH} levels deep", -1)
        match term:
            case Name(name, at):
                if name not in scope:
                    self.meet(name, at)
                    self.free[name] = None
            case Sum(parts):
                for part in parts:
                    self.term(part, scope, depth + 1)
            case Product() | Quotient():
                first, links = _chain(term)
                self.term(first, scope, depth + 1)
                for link in links:
                    self.term(link.right, scope, depth + 1)
            case Power(base, exponent, _):
                self.term(base, scope, depth + 1)
                self.term(exponent, scope, depth + 1)
            case Minus(part):
                self.term(part, scope, depth + 1)
            case Root(_, poly, variable, _):
                self.term(poly, scope, depth + 1)
                if variable is not None and variable not in scope:  # met in the polynomial, or refused later
                    self.free[variable] = None


class _Lowering:
    def __init__(self, ring: Ring, fail: Fail) -> None:
        self.ring, self.fail = ring, fail
        self.terms: dict[int, Value] = {}
        self.nodes: dict[int, Formula] = {}

    def remember(self, part: Part) -> None:
        """Lower a part that others share; the caller keeps it alive, so its identity is a key."""
        if isinstance(part, Node):
            self.nodes[id(part)] = self.node(part)
        elif not isinstance(part, Root):
            self.terms[id(part)] = self.term(part)

    def node(self, node: Node) -> Formula:
        if (known := self.nodes.get(id(node))) is not None:
            return known
        match node:
            case Comparison():
                return self.comparison(node)
            case Every(parts):
                return conj([self.node(part) for part in parts])
            case Some(parts):
                return disj([self.node(part) for part in parts])
            case Negation(part):
                return neg(self.node(part))
            case Implication(left, right):
                return implies(self.node(left), self.node(right))
            case Equivalence(left, right):
                return iff(self.node(left), self.node(right))
            case Quantification(universal, names, body):
                return (forall if universal else exists)(names, self.node(body))
            case Truth(value):
                return TRUE if value else FALSE

    def comparison(self, node: Comparison) -> Formula:
        links: list[Formula] = []
        values: list[Value | Root] = [s if isinstance(s, Root) else self.term(s) for s in node.sides]
        for k, relation in enumerate(node.relations):
            left, right = values[k], values[k + 1]
            try:
                if isinstance(right, Root):
                    links.append(self.root_comparison(node.sides[k], relation, right))
                elif isinstance(left, Root):
                    links.append(self.root_comparison(node.sides[k + 1], relation.flipped, left))
                else:
                    links.append(terms.compare(left, relation, right))
            except TermError as error:
                raise self.fail(str(error), node.at) from None
        return conj(links)

    def root_comparison(self, side: Term, relation: Relation, root: Root) -> Formula:
        if not isinstance(side, Name):
            raise self.fail("root(…) can only be compared with a variable", root.at)
        if root.variable is not None and root.variable != side.name:
            raise self.fail(f"a root in {root.variable} cannot be compared with {side.name}", root.at)
        k = self.constant(root.number, "the first argument of root must be an integer", root.at)
        poly = self.term(root.poly).poly
        if k == 0 or not poly.degree(self.ring.index[side.name]):
            reason = "roots are counted from 1 or -1" if k == 0 else f"the polynomial does not contain {side.name}"
            raise self.fail(f"no such root: {reason}", root.at)
        return root_atom(side.name, relation, poly, k)

    def term(self, term: Term) -> Value:
        """The polynomial that a term means."""
        if (known := self.terms.get(id(term))) is not None:
            return known
        try:
            match term:
                case Number(value):
                    return terms.number(self.ring, value)
                case Name(name, at):
                    if name not in self.ring.index:
                        raise self.fail(f"unknown variable {name}", at)
                    return terms.variable(self.ring, name)
                case Sum(parts):
                    return terms.total([self.term(part) for part in parts])
                case Minus(part):
                    return terms.negative(self.term(part))
                case Power(base, exponent, at):
                    power = self.constant(exponent, "an exponent must be a natural number", at)
                    return terms.power(self.term(base), power)
                case Product() | Quotient():
                    return self.product(term)
                case Root():
                    raise self.fail("root(…) can only be compared with a variable", term.at)
        except TermError as error:
            raise self.fail(str(error), getattr(term, "at", -1)) from None

    def product(self, term: Product | Quotient) -> Value:
        first, links = _chain(term, self.terms)
        value = self.term(first)
        for link in links:
            right = self.term(link.right)
            try:
                value = (terms.product if isinstance(link, Product) else terms.quotient)(value, right)
            except TermError as error:
                raise self.fail(str(error), link.at) from None
        return value

    def constant(self, term: Term, message: str, at: int) -> int:
        if isinstance(term, Number) and term.value.denominator == 1:
            return int(term.value)
        value = self.term(term)
        number = Fraction(value.poly.constant_value(), value.den) if value.poly.is_constant else None
        if number is None or number.denominator != 1:
            raise self.fail(message, at)
        return int(number)

"""What surface trees mean: formulas over polynomials.

``lower`` collects the names (free ones in order of appearance, then bound ones in order of quantification) into one
ring, does the exact arithmetic, and moves every relation to the form ``poly relation 0``. Scoping stays where it was
written: a name may be bound twice or be free and bound; ``qe.formula.normal.rename_apart`` resolves that where needed.

A comparison is true only where both sides have a value; connectives and quantifiers are the classical ones. So
``1/x > 0`` says x > 0, and its negation x <= 0, which is true at 0. This is the usual logic of partial functions (W. M.
Farmer, A partial functions version of Church's simple theory of types, J. Symbolic Logic 55, 1990). ``Total`` gives the
values of functions outside their domains as SMT-LIB has them instead.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall, iff, implies, neg, root_atom
from qe.formula.quantity import almost_all, at_least, connected, exactly, infinitely_many
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.formula.traverse import has_root_atoms
from qe.io import surface as s
from qe.io import terms
from qe.io.auxiliaries import Exhausted, Place
from qe.io.collected import sides
from qe.io.names import refuse_numbers
from qe.io.sharing import Names, ordered, refuse_long
from qe.io.terms import TermError, Value
from qe.io.total import Total
from qe.io.unfolding import Sums
from qe.io.valuation import Valuation

MOST_RESERVED = 4096
"""Names of auxiliary values in one formula."""


def lower(
    node: s.Node,
    fail: s.Fail,
    *,
    names: Iterable[str] | None = None,
    shared: Sequence[s.Part] = (),
    meet: s.Meet = lambda name, at: None,
    total: Total | None = None,
) -> Formula:
    """The formula that ``node`` means; ``fail(message, at)`` makes the error for a position.

    With ``names`` (all names, for the ring) the tree may be a graph whose parts are shared; ``shared`` lists parts
    in an order in which each comes after those it uses, so that chains of definitions of any length are fine. With
    ``total`` functions have values outside their domains too, which it notes. Raises ``Unable`` where nested
    equivalences and shared parts would be much too long written out.
    """
    parts = ordered([node])
    refuse_long(parts)
    collected = Names(fail, meet)
    if not shared:
        collected.part(node)
    elif len(parts) > 1:
        contained = set(map(id, parts))
        shared = [part for part in shared if id(part) in contained]
    if total is not None and names is None:
        total.bound = frozenset(collected.bound)
    listed = collected.all() if names is None else list(dict.fromkeys(names))
    reserve = collected.special if names is None else 0
    while True:
        try:
            return _lowered(node, fail, listed, reserve, shared, total)
        except Exhausted:
            reserve = 2 * reserve + 8
            if reserve > MOST_RESERVED:
                raise fail(f"more than {MOST_RESERVED} roots and case distinctions", -1) from None


def _lowered(
    node: s.Node, fail: s.Fail, names: list[str], reserve: int, shared: Sequence[s.Part], total: Total | None
) -> Formula:
    taken = set(names)
    extra = [f"s{k}" for k in range(1, reserve + len(names) + 1) if f"s{k}" not in taken][:reserve]
    lowering = Lowering(Ring.of([*names, *extra]), fail, extra, total)
    for part in shared:
        lowering.remember(part)
    formula = lowering.node(node, Place())
    if total is not None:
        formula = exists(total.values, conj((formula, *lowering.values.agreements())))
    if not extra:
        return formula
    used = set(lowering.values.made)
    return convert(formula, Ring.of([*names, *(name for name in extra if name in used)]))


def lower_term(term: s.Term, fail: s.Fail, *, meet: s.Meet = lambda name, at: None, numbers: bool = False) -> Value:
    """The polynomial over Q that ``term`` means, in its names, ``numbers`` that are not algebraic among them."""
    collected = Names(fail, meet)
    collected.part(term)
    names = collected.all()
    if not numbers:
        refuse_numbers(names)
    try:
        value = Lowering(Ring.of(names), fail, [], None).values.term(term)
    except Exhausted:
        value = ()
    if not isinstance(value, Value):
        raise fail("a polynomial expected, without divisions by variables, roots and cases", -1)
    return value


class Lowering:
    """Formulas and comparisons over one ring; ``extra`` are the names of it that auxiliary values may take."""

    def __init__(self, ring: Ring, fail: s.Fail, extra: Sequence[str], total: Total | None) -> None:
        self.ring, self.fail = ring, fail
        self.values = Valuation(ring, fail, extra, total, self.node)
        self.nodes: dict[int, Formula] = {}
        self.sums = Sums(self.values.terms, self.values.term)

    def remember(self, part: s.Part) -> None:
        """Lower a part that others share; the caller keeps it alive, so its identity is a key."""
        if isinstance(part, s.Node):
            self.nodes[id(part)] = self.node(part, Place())
        elif not isinstance(part, s.Root | s.Infinity):
            self.values.terms[id(part)] = self.values.term(part)

    def node(self, node: s.Node, place: Place) -> Formula:
        """The formula that the node means at this place."""
        known = self.nodes.get(id(node))
        if known is not None and (place.asserted or not self.values.loose):
            return known
        match node:
            case s.Comparison():
                return self.comparison(node, place)
            case s.Every(parts):
                return conj([self.node(part, place) for part in parts])
            case s.Some(parts):
                return disj([self.node(part, place) for part in parts])
            case s.Negation(part):
                return neg(self.node(part, place.denied))
            case s.Implication(left, right):
                return implies(self.node(left, place.denied), self.node(right, place))
            case s.Equivalence(left, right):
                return self.equivalence(left, right, place)
            case s.Quantification(universal, names, body):
                return (forall if universal else exists)(names, self.node(body, place.inside(universal)))
            case s.Quantity():
                return self.quantity(node, place)
            case s.Truth(value):
                return TRUE if value else FALSE

    def quantity(self, node: s.Quantity, place: Place) -> Formula:
        """How many values satisfy the body, said by ex and all, with names of auxiliary values for the others."""
        kind, count, name, body, at = node
        inner = place.inside(kind == "G")
        holds = self.node(body, inner)
        denied = self.node(body, inner.denied) if self.values.loose else holds
        if name in holds.bound or has_root_atoms(holds):
            raise self.fail(f"{name} is bound once more inside, or compared with root(...)", at)
        spare = [self.values.named(("quantity", id(node), i), lambda name: None) for i in range(max(count, 2))]
        if kind in ("F", "G"):
            return (infinitely_many if kind == "F" else almost_all)(name, holds, spare)
        if kind == "L":
            return at_least(count, name, holds, spare)
        return connected(name, holds, denied, spare) if kind == "C" else exactly(count, name, holds, denied, spare)

    def equivalence(self, left: s.Node, right: s.Node, place: Place) -> Formula:
        asserted = self.node(left, place), self.node(right, place)
        if not self.values.loose:
            return iff(*asserted)
        denied = self.node(left, place.denied), self.node(right, place.denied)
        return conj((implies(denied[0], asserted[1]), implies(denied[1], asserted[0])))

    def comparison(self, node: s.Comparison, place: Place) -> Formula:
        links = zip(pairwise(node.sides), node.relations, strict=True)
        try:
            return conj([self.link(left, relation, right, place) for (left, right), relation in links])
        except TermError as error:
            raise self.fail(str(error), node.at) from None

    def link(self, left: s.Term, relation: Relation, right: s.Term, place: Place) -> Formula:
        """``left relation right``."""
        both = () if isinstance(left, s.Polynomial) else ((right, left, relation), (left, right, relation.flipped))
        for side, other, seen in both:
            if isinstance(side, s.Root) and isinstance(other, s.Name) and side.variable in (None, other.name):
                return self.root_comparison(other, seen, side)
            if (sign := _infinite(side)) is not None:
                return self.bounded(other, seen, sign, place)
            if not isinstance(other, s.Root) and (parts := self.sums.unfolded(side, seen.flipped)):
                join, cases = parts
                return join([self.link(part, seen.flipped, other, place) for part in cases])
        if isinstance(left, s.Polynomial) or isinstance(right, s.Polynomial):
            left, right = sides(left, right, terms.MAX_TERMS)
        a = self.values.term(left)
        if isinstance(a, Value) and isinstance(right, s.Number) and not right.value:
            return atom(a.poly, relation)
        b = self.values.term(right)
        if isinstance(a, Value) and isinstance(b, Value):
            return atom(terms.total((a, terms.negative(b))).poly, relation)
        return self.values.compared(self.values.listed(a), relation, self.values.listed(b), place)

    def root_comparison(self, side: s.Name, relation: Relation, root: s.Root) -> Formula:
        k = self.values.constant(root.number, "the first argument of root must be an integer", root.at)
        poly = self.values.polynomial(root.poly, root.at)
        index = self.ring.index[side.name]
        if k and not poly.degree(index) and len(poly.variables) == 1:
            return self.link(side, relation, root._replace(variable=self.ring.names[poly.level]), Place())
        if k == 0 or not poly.degree(index):
            reason = "roots are counted from 1 or -1" if k == 0 else f"the polynomial does not contain {side.name}"
            raise self.fail(f"no such root: {reason}", root.at)
        return root_atom(side.name, relation, poly, k)

    def bounded(self, side: s.Term, relation: Relation, sign: int, place: Place) -> Formula:
        """``side relation sign*infinity``: only whether the side has a value matters."""
        if _infinite(side) is not None:
            raise self.fail("infinity is compared with terms only", -1)
        if not relation.holds(-sign):
            return FALSE
        value = self.values.term(side)
        return TRUE if isinstance(value, Value) else self.values.defined(value, place)


def _infinite(term: s.Term) -> int | None:
    """The sign of an infinite side; None for any other."""
    if isinstance(term, s.Minus):
        sign = _infinite(term.part)
        return None if sign is None else -sign
    return 1 if isinstance(term, s.Infinity) else None

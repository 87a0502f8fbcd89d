"""Quantifiers of the text syntax and what they range over: sets, bounds, conditions. LaTeX has the same.

Of a whole text: ``a, b, c > 0, a + b + c = 1`` says ``a > 0 and b > 0 and …``, and ``x^2 >= a for all x`` says ``all x.
x^2 >= a``. What may be taken in two ways is refused: a comma next to ``or``, ``->``, quantifiers; ``0 < a, b < 1``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, TypeAlias

from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io import text_lexer
from qe.io.parser import BODY, CLOSES, FORMULA, NOT, RELATIONS, TERM, Parser, Waiting, counted
from qe.io.sharing import Names
from qe.io.text_errors import SyntaxFailure, unmatched_opening
from qe.io.tokens import END, Token
from qe.spelling import WORD

_UNIVERSAL = frozenset(("all", "forall", "All", "A", "∀", "ForAll", "Forall", "FORALL", "\\[ForAll]"))

Within: TypeAlias = Callable[[s.Term, int], s.Node]
"""A set: the formula that a term, at an offset, is in it."""


class QuantifiedParser(Parser):
    """Reads quantifiers. ``conditions``: those of a whole text that stand in front of a quantifier, which then waits
    ``behind`` them."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.conditions: list[s.Node] = []
        self.behind: Callable[[s.Node], s.Node] | None = None

    def quantifier(self) -> s.Node | None:
        """One or more quantifiers, to the dot or the bracket that their body stands in, or behind it to the end."""
        token = self.advance()
        if self.token.kind in ("OPEN", "LEFT"):
            self.quantified_call(token)
            return None
        is_first = self.stack[-1].closing == ("CLOSE",) and self.text[: token.at].rstrip()[-1:] == "("
        headers = [(token, *self.bound())]
        while self.token.kind == "QUANTIFIER":
            headers.append((self.advance(), *self.bound()))
        conditions: list[s.Node] = []

        def make(body: s.Node) -> s.Node:
            body = _under(True, conditions, body)
            for header in reversed(headers):
                body = quantified(*header, body)
            return body

        if self.token.kind == "CLOSE":
            if not is_first:
                raise self.unexpected(("DOT", "COMMA", "QUANTIFIER"))
            self.in_front(make, token.text in ("E", "A"))
            return None
        kind, text, _ = self.advance()
        conditions = self.condition(headers[-1][0]) if kind == "DOT" and text not in ".:," else []
        if kind == END or (conditions and self.token.kind == END):
            self.behind = make
            return s.Truth(True)
        if conditions:
            self.advance()
        if kind == "DOT":
            self.stack.append(Waiting(BODY, FORMULA, FORMULA, make))
        else:
            self.open(FORMULA, CLOSES[kind], lambda parts: make(parts[0]))
        return None

    def in_front(self, make: Callable[[s.Node], s.Node], letter: bool) -> None:
        """``(∀x ∈ ℝ)``: its formula is what comes next, in brackets, or else all to the end. Behind a ``letter`` all of
        it is in brackets: ``(A x)(x + 1) > 0`` may be a product."""
        start = self.advance().at + 1

        def whole(body: s.Node) -> s.Node:
            written = self.text[start : self.token.at].strip()
            begins_product = letter and written[0] == "(" and unmatched_opening(written[:-1]) != 0
            if begins_product and not isinstance(body, s.Quantification):
                raise SyntaxFailure("a quantifier or a product? Write all x. f or ex x. f, or * between factors", start)
            return make(body)

        self.stack.pop()
        level = NOT if self.token.kind in CLOSES else BODY
        self.skip("DOT")
        self.stack.append(Waiting(level, FORMULA, FORMULA, whole))

    def condition(self, quantifier: Token) -> list[s.Node]:
        """What has to hold of the variables of ``for all x, y with x < y: f``, also behind its formula."""
        is_behind = bool(self.conditions) and len(self.stack) == 1
        if quantifier.text in _UNIVERSAL and (is_behind or re.search(r":(?!=)|\.\s", self.text[self.token.at :])):
            start = self.token.at
            return [together(self.several(FORMULA, END if is_behind else "DOT"), start)]
        return []

    def bound(self) -> tuple[list[str], Within | None]:
        """The variables of a quantifier and what they range over, up to the token that has to follow them."""
        is_behind = self.conditions and len(self.stack) == 1
        ends = ["DOT", "QUANTIFIER", "OPEN", "LEFT", "CLOSE", *([END] if is_behind else [])]
        if self.token.kind in ("NUMBER", "MINUS"):
            return self.between(ends)
        names, within = self.names(), None
        if self.skip("IN"):
            within = self.set()
        elif self.token.kind == "RELATION":
            relation = RELATIONS[self.advance().text]
            bound = self.expression(TERM, *ends)
            within = lambda term, at: s.Comparison([term, bound], [relation], at)  # noqa: E731
        if self.token.kind not in ends:
            raise self.unexpected(ends if within else {*ends, "COMMA", "NAME", "IN", "RELATION"})
        return names, within

    def between(self, ends: list[str]) -> tuple[list[str], Within]:
        """The variable of ``for all 0 < x < 1``, and that."""
        start = self.token.at
        condition = self.expression(FORMULA, *ends)
        names = [*dict.fromkeys(re.findall(WORD, self.text[start : self.token.at]))]
        if len(names) != 1:
            raise SyntaxFailure("variables come before what they range over: for all x, y with 0 < x < y: …", start)
        return names, lambda term, at: condition

    def names(self) -> list[str]:
        """Names with commas or nothing between them."""
        names = [self.take("NAME").text]
        while (kind := self.token.kind) in ("COMMA", "NAME"):
            if kind == "COMMA":
                self.advance()
            name = self.take("NAME")
            if kind == "NAME" and name.text in names:
                raise SyntaxFailure(
                    f"{name.text} stands twice behind one quantifier; what is said of it begins after '.'", name.at
                )
            names.append(name.text)
        return names

    def names_or_name(self) -> list[str]:
        """Names in brackets, or one."""
        first = self.take("NAME", *CLOSES)
        if first.kind == "NAME":
            return [first.text]
        names = self.names()
        self.take(CLOSES[first.kind], "COMMA", "NAME")
        return names

    def quantified_call(self, token: Token) -> None:
        """``ForAll[{x, y}, condition, formula]``."""
        closing = CLOSES[self.advance().kind]
        names = self.names_or_name()
        self.take("COMMA")
        universal = token.text in _UNIVERSAL

        def make(formulas: list[s.Node]) -> s.Node:
            if len(formulas) > 2:
                usage = "a quantifier takes variables, perhaps a condition, and a formula"
                raise SyntaxFailure(f"{usage}: ForAll[{{x, y}}, x > y, x^3 > y^3]", token.at)
            *conditions, body = formulas
            return s.Quantification(universal, names, _under(universal, conditions, body))

        self.open(FORMULA, closing, make, many=True)

    # --- sets ------------------------------------------------------------------------------------------------
    def set(self) -> Within:
        """Intersections, then from the left unions and differences."""
        value = self.intersection()
        while self.token.kind in ("UNION", "WITHOUT") or self.token.text in ("union", "Union"):
            is_difference, other = self.advance().kind == "WITHOUT", self.intersection()
            value = _without(value, other) if is_difference else _combined(s.Some, value, other)
        return value

    def intersection(self) -> Within:
        value = self.simple_set()
        while self.skip("COMMON"):
            value = _combined(s.Every, value, self.simple_set())
        return value

    def refuse_others(self) -> None:
        """Refuse a set of numbers that are not all real ones."""
        if self.token.text in text_lexer.NOT_REAL:
            raise SyntaxFailure(
                f"all variables are real (as in ex x. …), {self.token.text} cannot be asked for", self.token.at
            )

    def simple_set(self) -> Within:
        self.refuse_others()
        if self.token.text in text_lexer.ALSO_REALS:
            self.token = self.token._replace(kind="REALS")
        kind = self.take("OPEN", "LEFT", "BEGIN", "REALS").kind
        if kind == "REALS":
            return lambda term, at: s.Comparison([term, term], [Relation.EQ], at)
        if kind == "BEGIN":
            values = self.arguments("END")
            return lambda term, at: s.Some([s.Comparison([term, value], [Relation.EQ], at) for value in values])
        left = self.part(TERM, "COMMA")
        right = self.expression(TERM, "CLOSE", "RIGHT")
        end = left.part if isinstance(left, s.Minus) else left
        low = Relation.GE if kind == "LEFT" and not isinstance(end, s.Infinity) else Relation.GT
        high = Relation.LE if self.advance().kind == "RIGHT" and not isinstance(right, s.Infinity) else Relation.LT
        bounds = (left, low), (right, high)  # behind the term, whose names stand in front of theirs
        return lambda term, at: s.Every([s.Comparison([term, end], [relation], at) for end, relation in bounds])

    def arguments(self, closing: str) -> list[s.Term]:
        """Terms with commas between them, and the bracket behind them."""
        values = self.several(TERM, closing)
        self.advance()
        return values

    def element(self) -> s.Node:
        """``Element[x | y, Reals]``."""
        at = self.advance().at
        closing = CLOSES[self.take("OPEN", "LEFT").kind]
        members = self.arguments("END") if self.skip("BEGIN") else self.several(TERM, "COMMA", sign="ALSO")
        self.take("COMMA")
        within = self.set()
        self.take(closing)
        return all_within(members, within, at)


def quantified(quantifier: Token, names: list[str], within: Within | None, body: s.Node) -> s.Node:
    """A quantifier over names, which may be bounded by a set."""
    if quantifier.text.partition(" ")[0] in (*s.QUANTITIES, "M"):
        return _quantity(quantifier, names, within, body)
    universal = quantifier.text in _UNIVERSAL
    if within is None:
        return s.Quantification(universal, names, body)
    condition = all_within([s.Name(name, quantifier.at) for name in names], within, quantifier.at)
    return s.Quantification(universal, names, _under(universal, [condition], body))


def _quantity(quantifier: Token, names: list[str], within: Within | None, body: s.Node) -> s.Node:
    """How many values of one variable, which may be bounded by a set."""
    kind, _, number = quantifier.text.partition(" ")
    if kind == "M":
        more = quantifier._replace(text=f"L {counted(number, quantifier.at) + 1}")
        return s.Negation(_quantity(more, names, within, body))
    if len(names) != 1:
        raise SyntaxFailure(f"{s.QUANTITIES[kind]}: one variable expected, {', '.join(names)} found", quantifier.at)
    conditions = [] if within is None else [within(s.Name(names[0], quantifier.at), quantifier.at)]
    return s.Quantity(
        kind, counted(number, quantifier.at), names[0], _under(kind == "G", conditions, body), quantifier.at
    )


def _under(universal: bool, conditions: list[s.Node], body: s.Node) -> s.Node:
    """The body of a quantifier that ranges over what has at most one condition."""
    if not conditions:
        return body
    return s.Implication(conditions[0], body) if universal else s.Every([*conditions, body])


def all_within(terms: list[Any], within: Within, at: int) -> s.Node:
    """That all of these terms are in a set."""
    inside = [within(term, at) for term in terms]
    return inside[0] if len(inside) == 1 else s.Every(inside)


def _combined(kind: type[s.Every] | type[s.Some], one: Within, other: Within) -> Within:
    return lambda term, at: kind([one(term, at), other(term, at)])


def _without(one: Within, other: Within) -> Within:
    return lambda term, at: s.Every([one(term, at), s.Negation(other(term, at))])


SHARING = re.compile(rf"{WORD}(?:\s*,\s*{WORD})+(?=\s*(?:[<>=≤≥≠]|!=|/=))")
"""Variables in front of the comparison that they share."""
_LOOSE = s.Some | s.Implication | s.Equivalence
_QUANTIFIED = s.Quantification | s.Quantity
_MORE, _LESS = frozenset((Relation.GT, Relation.GE)), frozenset((Relation.LT, Relation.LE))


def shared(names: Sequence[s.Name], condition: s.Node, before: s.Node | None, at: int) -> s.Node:
    """The condition on its first variable for all of these as well; in ``0 < a, b, c < 1`` all lie between."""
    if not isinstance(condition, s.Comparison):
        raise SyntaxFailure("variables with commas between them stand in front of one comparison: a, b > 0", at)
    sharing: list[s.Term] = [*names]
    conditions: list[s.Node] = []
    if isinstance(before, s.Comparison) and _may_be_between(before, condition):
        conditions += [before._replace(sides=[*before.sides[:-1], name]) for name in (*names, condition.sides[0])]
        sharing.append(before.sides[-1])
    conditions += [condition._replace(sides=[name, *condition.sides[1:]]) for name in sharing]
    return s.Every([*conditions, condition])


def together(parts: Sequence[s.Node], at: int, *, quantified: bool = False) -> s.Node:
    """The conditions as one; ``quantified``: quantifiers follow. What has the variable of ``exists`` in front of it is
    under that: ``exists t: x = t^2, y = t^3``."""
    first, *rest = parts
    if rest and isinstance(first, s.Quantification) and not first.universal and all(_has(p, first.names) for p in rest):
        return first._replace(body=together([first.body, *rest], at))
    bare = [part.part if isinstance(part, s.Negation) else part for part in parts]
    unclear = (len(parts) > 1 and any(isinstance(part, _LOOSE) for part in bare)) or (
        quantified and isinstance(bare[0], s.Equivalence)
    )
    if unclear or any(isinstance(part, _QUANTIFIED) for part in (bare if quantified else bare[:-1])):
        reason = "a comma or a quantifier behind or, ->, <-> and quantifiers is ambiguous"
        raise SyntaxFailure(f"{reason}; write and, brackets, or {{…, …}}", at)
    for left, right in pairwise(parts):
        one, other = _end(left, -1), _end(right, 0)
        if isinstance(one, s.Comparison) and isinstance(other, s.Comparison) and _may_be_between(one, other):
            raise SyntaxFailure("0 < a, b < 1 is ambiguous; write and, as in 0 < a < 1 and 0 < b < 1", at)
    return s.Every(list(parts)) if len(parts) > 1 else parts[0]


def _has(node: s.Node, names: Sequence[str]) -> bool:
    """Whether one of the names occurs free in a formula."""
    free: list[str] = []
    Names(s.unplaced, lambda name, at: free.append(name)).part(node)
    return not {*names}.isdisjoint(free)


def _may_be_between(left: s.Comparison, right: s.Comparison) -> bool:
    """Whether ``0 < a`` and ``b < 1`` may say of both that they lie between the numbers."""
    match left, right:
        case (
            s.Comparison([s.Number() | s.Minus(s.Number()), *_, s.Name(a)], [*_, one]),
            s.Comparison([s.Name(b), *_], [other, *_]),
        ):
            return a != b and ({one, other} <= _MORE or {one, other} <= _LESS)
    return False


def _end(node: s.Node, at: int) -> s.Node:
    while isinstance(node, s.Every):
        node = node.parts[at]
    return node

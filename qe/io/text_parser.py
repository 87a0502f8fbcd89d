"""Grammar of the text syntax: tokens to surface trees. Error messages are made in ``qe.io.text_errors``."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.building import ARITHMETIC, RELATIONS, Builder
from qe.io.grammar import parser
from qe.io.lalr import Parser, Token
from qe.io.text_errors import SyntaxFailure
from qe.io.text_lexer import Make, tokens

_UNIVERSAL = frozenset(("all", "forall", "All", "A", "∀", "ForAll", "Forall", "FORALL", "\\[ForAll]"))
# "c" ends with a closed formula, "o" with a quantifier whose body runs on: nothing can follow an "o" inside
# its brackets, which makes the grammar unambiguous. Formulas and terms share the round brackets.
_FORMULAS = """
%declare QUANTIFIER NAME NUMBER RELATION PLUS MINUS TIMES OVER POWER OPEN CLOSE COMMA DOT
%declare AND OR NOT IMPLIES IFF TRUE FALSE LEFT RIGHT BEGIN END OPENBAR CLOSEBAR IN REALS INFINITY RADICAL
%declare IF THEN ELSE CONNECTIVE COMPARE CHOICE ELEMENT NOTIN UNION COMMON WITHOUT ALSO
?start: c4 | o4
?c4: c3 | c4 IFF c3             -> iff
?o4: o3 | c4 IFF o3             -> iff
?c3: c2 | c2 IMPLIES c3         -> implies
?o3: o2 | c2 IMPLIES o3         -> implies
?c2: c1 | c2 OR c1              -> some
?o2: o1 | c2 OR o1              -> some
?c1: c0 | c1 AND c0             -> every
?o1: o0 | c1 AND o0             -> every
?c0: base | NOT c0              -> negation
?o0: quantified | NOT o0        -> negation
     | IF start THEN start ELSE start -> either
quantified: QUANTIFIER bound DOT start | QUANTIFIER bound quantified -> quantified_again
closed: QUANTIFIER bound OPEN start CLOSE -> quantified_closed
     | QUANTIFIER bound LEFT start RIGHT -> quantified_closed
     | QUANTIFIER bound closed  -> quantified_again
?bound: names | names IN set    -> bounded
     | names RELATION sum       -> bounded_by
names: NAME | names COMMA NAME | names NAME -> names_side_by_side
?base: comparison | TRUE        -> true
     | FALSE                    -> false
     | OPEN start CLOSE         -> brackets
     | LEFT formulas RIGHT      -> listed
     | BEGIN formulas END       -> listed
     | sum IN set               -> member
     | sum NOTIN set            -> outside
     | ELEMENT OPEN members COMMA set CLOSE -> element
     | ELEMENT LEFT members COMMA set RIGHT -> element
     | CONNECTIVE OPEN formulas CLOSE -> connective
     | CONNECTIVE LEFT formulas RIGHT -> connective
     | COMPARE OPEN arguments CLOSE -> compared
     | COMPARE LEFT arguments RIGHT -> compared
     | closed
     | QUANTIFIER OPEN group COMMA formulas CLOSE -> quantified_call
     | QUANTIFIER LEFT group COMMA formulas RIGHT -> quantified_call
?group: NAME                    -> names
     | OPEN names CLOSE         -> brackets
     | LEFT names RIGHT         -> brackets
     | BEGIN names END          -> brackets
members: term | members ALSO term | BEGIN arguments END -> members_listed
formulas: start | formulas COMMA start -> more
?set: meet | set UNION meet     -> union
     | set WITHOUT meet         -> difference
?meet: simple | meet COMMON simple -> common
simple: (OPEN | LEFT) term COMMA term (CLOSE | RIGHT) -> interval
     | BEGIN arguments END      -> finite
     | REALS                    -> reals
"""
_TERMS = f"""
comparison: term RELATION term | comparison RELATION term
?term: sum | IF start THEN term ELSE term -> choice
{ARITHMETIC}
?primary: NUMBER                -> number
     | NAME                     -> name
     | INFINITY                 -> infinity
     | NAME OPEN arguments CLOSE -> call
     | NAME LEFT arguments RIGHT -> call
     | CHOICE OPEN start COMMA term COMMA term CLOSE -> choice_call
     | CHOICE LEFT start COMMA term COMMA term RIGHT -> choice_call
     | OPEN term CLOSE          -> brackets
     | OPENBAR term CLOSEBAR    -> absolute
     | RADICAL primary          -> radical
arguments: term | arguments COMMA term
"""
GRAMMAR = _FORMULAS + _TERMS


@cache
def text_parser(start: str = "start") -> Parser:
    """The parser of the text syntax; of its terms with ``start`` "term"."""
    return parser("text" if start == "start" else f"text_{start}", GRAMMAR, _tokens, TextBuilder(), start=start)


def _tokens(text: str, token: Make) -> Iterator[Token]:
    """The tokens of a text, which may be LaTeX."""
    if is_latex(text):
        from qe.io import latex_lexer

        return latex_lexer.tokens(text, token)
    return tokens(text, token)


def is_latex(text: str) -> bool:
    """Whether a text is read as LaTeX."""
    if "\\" in text or "{" in text or "$" in text:
        from qe.io import latex_lexer

        return latex_lexer.is_latex(text)
    return False


@cache
def latex_parser() -> Parser:
    """The parser of the same syntax in LaTeX."""
    from qe.io.latex_lexer import tokens as latex_tokens

    return parser("text", GRAMMAR, latex_tokens, TextBuilder())


class TextBuilder(Builder):
    """The actions of the text syntax alone."""

    def quantified(self, c: list[Any]) -> s.Node:
        return self.quantify(c[0], c[1], c[3])

    quantified_closed = quantified

    def quantified_again(self, c: list[Any]) -> s.Node:
        return self.quantify(c[0], c[1], c[2])

    def quantified_call(self, c: list[Any]) -> s.Node:
        universal, formulas = str(c[0]) in _UNIVERSAL, c[4]
        if len(formulas) > 2:
            usage = "a quantifier takes variables, perhaps a condition, and a formula: ForAll[{x, y}, x > y, x^3 > y^3]"
            raise SyntaxFailure(usage, c[0].start_pos)
        *conditions, body = formulas
        for condition in conditions:
            body = s.Implication(condition, body) if universal else s.Every([condition, body])
        return s.Quantification(universal, c[2], body)

    def quantify(self, quantifier: Any, bound: Any, body: s.Node) -> s.Node:
        """A quantifier over names, which may be bounded by a set."""
        universal = str(quantifier) in _UNIVERSAL
        if isinstance(bound, list):
            return s.Quantification(universal, bound, body)
        names, within = bound
        inside = [within(s.Name(name, quantifier.start_pos), quantifier.start_pos) for name in names]
        condition = inside[0] if len(inside) == 1 else s.Every(inside)
        return s.Quantification(
            universal, names, s.Implication(condition, body) if universal else s.Every([condition, body])
        )

    def bounded(self, c: list[Any]) -> Any:
        return c[0], c[2]

    def bounded_by(self, c: list[Any]) -> Any:
        return c[0], lambda term, at: s.Comparison([term, c[2]], [RELATIONS[c[1]]], at)

    def closed(self, c: list[Any]) -> s.Node:
        return c[0]  # type: ignore[no-any-return]

    def names_side_by_side(self, c: list[Any]) -> list[str]:
        return [*c[0], str(c[1])]

    def either(self, c: list[Any]) -> s.Node:
        return s.Every([s.Implication(c[1], c[3]), s.Some([c[1], c[5]])])

    def formulas(self, c: list[Any]) -> list[s.Node]:
        return [c[0]]

    def more(self, c: list[Any]) -> list[s.Node]:
        return [*c[0], c[2]]

    def listed(self, c: list[Any]) -> s.Node:
        return s.Every(c[1]) if len(c[1]) > 1 else c[1][0]

    def connective(self, c: list[Any]) -> s.Node:
        name, parts = str(c[0]), c[2]
        if name == "Not" and len(parts) == 1:
            return s.Negation(parts[0])
        if name == "And":
            return s.Every(parts)
        if name == "Or":
            return s.Some(parts)
        if name == "Implies" and len(parts) == 2:
            return s.Implication(*parts)
        if name == "Equivalent":
            return s.Every([s.Equivalence(parts[0], part) for part in parts[1:]])
        if name == "Xor":
            return s.odd(parts)
        raise SyntaxFailure(f"{name} takes {'one formula' if name == 'Not' else 'two formulas'}", c[0].start_pos)

    def compared(self, c: list[Any]) -> s.Node:
        at, sides = c[0].start_pos, c[2]
        if len(sides) < 2:
            raise SyntaxFailure(f"{c[0]} compares two terms", at)
        if c[0] == "Inequality":
            named = [RELATIONS.get(part.name) if isinstance(part, s.Name) else None for part in sides[1::2]]
            relations = [relation for relation in named if relation is not None]
            if len(relations) < len(named) or len(sides) % 2 == 0:
                raise SyntaxFailure("Inequality takes terms and relations: Inequality[0, Less, x, LessEqual, 1]", at)
            return s.Comparison(sides[::2], relations, at)
        return s.Comparison(sides, [RELATIONS[c[0]]] * (len(sides) - 1), at)

    # --- sets: functions from a term and a place to a formula ------------------------------------------------
    def interval(self, c: list[Any]) -> Any:
        low = Relation.GE if c[0].type == "LEFT" else Relation.GT
        high = Relation.LE if c[4].type == "RIGHT" else Relation.LT
        left, right = c[1], c[3]
        ends = (left.part if isinstance(left, s.Minus) else left), right
        low = Relation.GT if isinstance(ends[0], s.Infinity) else low
        high = Relation.LT if isinstance(ends[1], s.Infinity) else high
        bounds = (left, low), (right, high)  # behind the term, whose names stand in front of theirs
        return lambda term, at: s.Every([s.Comparison([term, end], [relation], at) for end, relation in bounds])

    def finite(self, c: list[Any]) -> Any:
        return lambda term, at: s.Some([s.Comparison([term, value], [Relation.EQ], at) for value in c[1]])

    def reals(self, c: list[Any]) -> Any:
        return lambda term, at: s.Comparison([term, term], [Relation.EQ], at)

    def union(self, c: list[Any]) -> Any:
        return lambda term, at: s.Some([c[0](term, at), c[2](term, at)])

    def difference(self, c: list[Any]) -> Any:
        return lambda term, at: s.Every([c[0](term, at), s.Negation(c[2](term, at))])

    def common(self, c: list[Any]) -> Any:
        return lambda term, at: s.Every([c[0](term, at), c[2](term, at)])

    def outside(self, c: list[Any]) -> s.Node:
        return s.Negation(c[2](c[0], c[1].start_pos))

    def member(self, c: list[Any]) -> s.Node:
        return c[2](c[0], c[1].start_pos)  # type: ignore[no-any-return]

    def members(self, c: list[Any]) -> list[s.Term]:
        return [c[0]] if len(c) == 1 else [*c[0], c[2]]

    def members_listed(self, c: list[Any]) -> list[s.Term]:
        return c[1]  # type: ignore[no-any-return]

    def element(self, c: list[Any]) -> s.Node:
        inside = [c[4](term, c[0].start_pos) for term in c[2]]
        return inside[0] if len(inside) == 1 else s.Every(inside)

    # --- terms -----------------------------------------------------------------------------------------------
    def infinity(self, c: list[Any]) -> s.Term:
        return s.Infinity(c[0].start_pos)

    def choice(self, c: list[Any]) -> s.Term:
        return s.Choice(c[1], c[3], c[5], c[0].start_pos)

    def choice_call(self, c: list[Any]) -> s.Term:
        return s.Choice(c[2], c[4], c[6], c[0].start_pos)

    def absolute(self, c: list[Any]) -> s.Term:
        return s.Apply("abs", [c[1]], c[0].start_pos)

    def radical(self, c: list[Any]) -> s.Term:
        return s.Apply("cbrt" if c[0] == "∛" else "sqrt", [c[1]], c[0].start_pos)

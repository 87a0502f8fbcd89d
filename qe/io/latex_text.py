"""LaTeX of texts that are printed, terms and formulas with roots and quotients, in the order in which they stand."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from functools import reduce

from qe.errors import InputError
from qe.io import latex
from qe.io import surface as s
from qe.io.parser import BRACKET, POWER, PRODUCT, SUM
from qe.io.text import read_node, read_term

_ROOTS = {"sqrt": r"\sqrt{{{}}}", "cbrt": r"\sqrt[3]{{{}}}", "abs": r"\left|{}\right|"}


def term_in_latex(text: str) -> str:
    """The source, for math mode, of the term that a text is."""
    return _term(read_term(text))


def formula_in_latex(text: str) -> str:
    """The source, for math mode, of the formula without quantifiers that a text is."""
    return _node(read_node(text))


def _term(term: s.Term, around: int = BRACKET) -> str:
    """A term, in brackets where what stands ``around`` it, by its level, binds as tightly."""
    match term:
        case s.Name(name):
            return latex.name(name)
        case s.Number(value) if value < 0:
            return _bracketed(f"-{_number(-value)}", around > BRACKET)
        case s.Number(value):
            return _bracketed(_number(value), around == POWER and value.denominator > 1)
        case s.Polynomial(terms):
            parts: list[s.Term] = [_monomial(names, c) for names, c in terms.items()]
            return _term(s.Sum(parts) if len(parts) > 1 else parts[0], around)
        case s.Minus(part):
            return _bracketed(f"-{_term(part, SUM)}", around > BRACKET)
        case s.Sum(parts):
            first, *rest = (_term(part) for part in parts)
            text = first + "".join(f" - {t[1:]}" if t.startswith("-") else f" + {t}" for t in rest)
            return _bracketed(text, around > BRACKET)
        case s.Product(left, right):
            text = rf"{_term(left, SUM)}\,{_term(right, PRODUCT)}"
            return _bracketed(text, around == POWER)
        case s.Quotient(left, right):
            return _bracketed(rf"\frac{{{_term(left)}}}{{{_term(right)}}}", around == POWER)
        case s.Power(base, s.Quotient(s.Number(1), s.Number(n))):
            return _bracketed(rf"\sqrt[{n}]{{{_term(base)}}}", around == POWER)
        case s.Power(base, exponent):
            return _bracketed(f"{_term(base, POWER)}^{{{_term(exponent)}}}", around == POWER)
        case s.Apply(function, [part]) if function in _ROOTS:
            return _bracketed(_ROOTS[function].format(_term(part)), around == POWER)
        case s.Root(number, poly, variable):
            inside = _term(poly) + (f", {latex.name(variable)}" if variable else "")
            return rf"\operatorname{{root}}_{{{_term(number)}}}\left({inside}\right)"
    raise InputError("LaTeX for this term is not known")


def _monomial(names: tuple[str, ...], coefficient: Fraction | int) -> s.Term:
    """The product that a term of a polynomial is."""
    size, factors = coefficient if coefficient > 0 else -coefficient, list[s.Term]()
    for name, power in Counter(names).items():
        factors.append(s.Name(name, -1) if power == 1 else s.Power(s.Name(name, -1), s.Number(power), -1))
    if size != 1 or not factors:
        factors.insert(0, s.Number(size))
    product = reduce(lambda left, right: s.Product(left, right, -1), factors)
    return s.Minus(product) if coefficient < 0 else product


def _number(value: Fraction | int) -> str:
    return str(value) if value.denominator == 1 else rf"\frac{{{value.numerator}}}{{{value.denominator}}}"


def _bracketed(text: str, needed: bool) -> str:
    return rf"\left({text}\right)" if needed else text


def _node(node: s.Node, inside: bool = False) -> str:
    """A formula, in brackets where it is a disjunction ``inside`` a conjunction."""
    match node:
        case s.Truth(value):
            return r"\top" if value else r"\bot"
        case s.Every(parts):
            return r" \land ".join(_node(part, inside=True) for part in parts)
        case s.Some(parts):
            return _bracketed(r" \lor ".join(map(_node, parts)), inside)
        case s.Comparison(sides, relations):
            pairs = zip(relations, map(_term, sides[1:]), strict=True)
            return _term(sides[0]) + "".join(f" {latex.RELATIONS.get(r, r.value)} {side}" for r, side in pairs)
    raise InputError("LaTeX for this formula is not known")

"""Presentation MathML: mathematical notation that browsers draw without any library, with lines broken sensibly."""

from __future__ import annotations

import re
from collections.abc import Callable
from html import escape

from qe.formula.notation import Monomial, digits, oriented, positive
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation, RootAtom
from qe.io.latex import GREEK
from qe.spelling import visible

WIDTH = 12
"""Leaves (monomials) after which the outermost operator is written in lines."""

_LETTERS = dict(zip(sorted(GREEK), "αβχδεηγικλμνωφπψρστθυξζ"))
_NAME = re.compile(r"([^\W\d_]+)_?(\d*)('*)")
_RELATIONS = {
    Relation.EQ: "=",
    Relation.NE: "≠",
    Relation.LT: "&lt;",
    Relation.LE: "≤",
    Relation.GT: "&gt;",
    Relation.GE: "≥",
}
_AND, _OR = "∧", "∨"


def name(variable: str) -> str:
    """A variable: ``x1`` as x with an index, Greek letters by name, long words upright."""
    found = _NAME.fullmatch(variable)
    if found is None:
        return f"<mi>{escape(visible(variable))}</mi>"
    letters, number, primes = found.groups()
    text = _LETTERS.get(letters, escape(letters)) + "′" * len(primes)
    return f"<msub><mi>{text}</mi><mn>{number}</mn></msub>" if number else f"<mi>{text}</mi>"


Draw = Callable[[str], str]
"""How a variable is drawn."""

LEFT = ' style="text-align:left"'
"""For every cell: browsers that know no ``columnalign`` centre cells, whatever their table says."""


def write(formula: Formula) -> str:
    """A ``<math>`` element in display style."""
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">{_lines(formula)}</math>'


def _lines(formula: Formula) -> str:
    """The quantifiers, and the operands of the outermost operator in rows of a table when there is much of it."""
    prefix = ""
    while isinstance(formula, Exists | ForAll):
        prefix += _quantifier(formula)
        formula = formula.body
    if not isinstance(formula, And | Or) or _size(formula) <= WIDTH:
        return f"<mrow>{prefix}{expression(formula)}</mrow>"
    operator = _operator(_AND if isinstance(formula, And) else _OR)
    rows = [
        f"<mtr><mtd>{operator if i else ''}</mtd><mtd{LEFT}>{expression(arg, bracket=True)}</mtd></mtr>"
        for i, arg in enumerate(formula.args)
    ]
    return f"<mrow>{prefix}<mtable columnalign='right left'>{''.join(rows)}</mtable></mrow>"


def _size(formula: Formula) -> int:
    match formula:
        case Atom(poly, _) | RootAtom(_, _, poly, _):
            return poly.term_count()
        case And(args) | Or(args):
            return sum(map(_size, args))
        case Not(arg):
            return _size(arg)
        case Exists(_, body) | ForAll(_, body):
            return _size(body)
    return 1


def expression(formula: Formula, *, bracket: bool = False, draw: Draw = name) -> str:
    """A formula on one line; ``bracket``: compound ones need brackets here."""
    match formula:
        case Constant(value):
            return f"<mi>{'true' if value else 'false'}</mi>"
        case Atom():
            parts, relation = oriented(formula.poly, formula.relation)
            return f"<mrow>{polynomial(parts, draw)}{_relation(relation)}<mn>0</mn></mrow>"
        case RootAtom(variable, relation, poly, k):
            root = f"<msub><mi>root</mi><mn>{k}</mn></msub>{bracketed(polynomial(positive(poly), draw))}"
            return f"<mrow>{draw(variable)}{_relation(relation)}{root}</mrow>"
        case Not(arg):
            return f"<mrow>{_operator('¬')}{expression(arg, bracket=True, draw=draw)}</mrow>"
        case Exists(_, body) | ForAll(_, body):
            inner = f"{_quantifier(formula, draw)}{expression(body, draw=draw)}"
        case And(args) | Or(args):
            operator = _operator(_AND if isinstance(formula, And) else _OR)
            inner = operator.join(expression(arg, bracket=True, draw=draw) for arg in args)
        case _:
            raise TypeError(f"not a formula: {formula!r}")
    return bracketed(inner) if bracket else f"<mrow>{inner}</mrow>"


def bracketed(inner: str) -> str:
    """The expression in brackets."""
    return f'<mrow><mo form="prefix">(</mo>{inner}<mo form="postfix">)</mo></mrow>'


def _quantifier(formula: Exists | ForAll, draw: Draw = name) -> str:
    symbol = "∀" if isinstance(formula, ForAll) else "∃"
    variables = "<mo>,</mo>".join(map(draw, formula.variables))
    return f"<mrow><mo>{symbol}</mo>{variables}<mo>:</mo></mrow>"


def _operator(symbol: str) -> str:
    return f'<mo lspace="0.4em" rspace="0.4em">{symbol}</mo>' if symbol in (_AND, _OR) else f"<mo>{symbol}</mo>"


def _relation(relation: Relation) -> str:
    return f"<mo>{_RELATIONS[relation]}</mo>"


def polynomial(parts: list[Monomial], draw: Draw = name) -> str:
    """A sum of monomials (``qe.formula.notation.monomials``)."""
    pieces: list[str] = []
    for coefficient, powers in parts:
        if coefficient < 0 or pieces:
            pieces.append(f"<mo>{'−' if coefficient < 0 else '+'}</mo>")
        factors = [_power(draw(variable), k) for variable, k in powers]
        if abs(coefficient) != 1 or not factors:
            factors.insert(0, f"<mn>{digits(abs(coefficient))}</mn>")
        pieces.append("<mo>&#x2062;</mo>".join(factors))
    return f"<mrow>{''.join(pieces) or '<mn>0</mn>'}</mrow>"


def _power(base: str, k: int) -> str:
    if k == 1:
        return base
    indexed = base.startswith("<msub>")  # the power then stands above the index, not after it
    return f"<msubsup>{base[6:-7]}<mn>{k}</mn></msubsup>" if indexed else f"<msup>{base}<mn>{k}</mn></msup>"

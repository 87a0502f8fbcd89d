"""Presentation MathML: mathematical notation that browsers draw without any library, with lines broken sensibly."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from html import escape
from itertools import pairwise
from typing import Never

from qe.formula.comparison import Range, ranges, sides
from qe.formula.features import length
from qe.formula.linear_forms import Forms, in_linear_forms
from qe.formula.notation import Monomial, digits, monomials, positive
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation, RootAtom
from qe.io.latex import GREEK
from qe.spelling import PI, visible

WIDTH = 12
"""Leaves (monomials) after which an operator is written in lines."""
LINE = 72
"""Letters in a line of a longer polynomial; browsers break no formula themselves, and paper does not scroll."""

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
    parts = _NAME.fullmatch("pi" if variable == PI else variable)
    if parts is None:
        return f"<mi>{escape(visible(variable))}</mi>"
    letters, number, primes = parts.groups()
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
    """The quantifiers, and what they are about; operands stand in rows of a table where there is much of them."""
    prefix = ""
    while isinstance(formula, Exists | ForAll):
        prefix += _quantifier(formula)
        formula = formula.body
    return f"<mrow>{prefix}{expression(formula, broken=True)}</mrow>"


def _rows(formula: And | Or, draw: Draw) -> str:
    """The operands of an operator, each in a row."""
    operator = _operator(_AND if isinstance(formula, And) else _OR)
    drawn = _operands(formula, draw, True)
    rows = (f"<mtr><mtd>{operator if i else ''}</mtd><mtd{LEFT}>{arg}</mtd></mtr>" for i, arg in enumerate(drawn))
    return f"<mtable columnalign='right left'>{''.join(rows)}</mtable>"


def expression(formula: Formula, *, bracket: bool = False, draw: Draw = name, broken: bool = False) -> str:
    """A formula; ``bracket``: compound ones need brackets here; ``broken``: long polynomials take several lines."""
    match formula:
        case Constant(value):
            return f"<mi>{'true' if value else 'false'}</mi>"
        case Atom():
            poly, forms = in_linear_forms(formula.poly)
            draw = _with_forms(forms, draw)
            parts, relation, right, divisor = sides(poly, formula.relation)
            end = f"{_relation(relation)}{_end(right, divisor, draw)}"
            lines = _line_starts(parts) if broken else [0]
            if len(lines) > 1:
                return _in_lines(parts, lines, draw, end)
            return f"<mrow>{polynomial(parts, draw)}{end}</mrow>"
        case RootAtom(variable, relation, poly, k):
            root = f"<msub><mi>root</mi><mn>{k}</mn></msub>{bracketed(polynomial(positive(poly), draw))}"
            return f"<mrow>{draw(variable)}{_relation(relation)}{root}</mrow>"
        case Not(arg):
            return f"<mrow>{_operator('¬')}{expression(arg, bracket=True, draw=draw, broken=broken)}</mrow>"
        case Exists(_, body) | ForAll(_, body):
            inner = f"{_quantifier(formula, draw)}{expression(body, draw=draw, broken=broken)}"
        case And() | Or() if broken and length(formula)[1] > WIDTH:
            inner = _rows(formula, draw)
        case And() | Or():
            inner = _operator(_AND if isinstance(formula, And) else _OR).join(_operands(formula, draw, broken))
        case _:
            unknown: Never = formula  # mypy holds the cases against all kinds
            raise TypeError(f"not a formula: {unknown!r}")
    return bracketed(inner) if bracket else f"<mrow>{inner}</mrow>"


def _operands(formula: And | Or, draw: Draw, broken: bool) -> Iterator[str]:
    for part in ranges(formula.args) if isinstance(formula, And) else formula.args:
        if isinstance(part, Range):
            low, above, term, under, high, forms = part
            middle = f"{_relation(above)}{polynomial(term, _with_forms(forms, draw))}{_relation(under)}"
            yield f"<mrow>{_end(*low, draw)}{middle}{_end(*high, draw)}</mrow>"
        else:
            yield expression(part, bracket=True, draw=draw, broken=broken)


def _with_forms(forms: Forms, draw: Draw) -> Draw:
    """Linear forms in the place of variables."""
    drawn: dict[str, str] = {}
    for name, (form, less) in forms.items():
        shift = _operator("−" if less > 0 else "+") + _end([(abs(less.numerator), ())], less.denominator, draw)
        drawn[name] = bracketed(polynomial(monomials(form), draw) + (shift if less else ""))
    return lambda name: drawn.get(name) or draw(name)


def _end(parts: list[Monomial], divisor: int, draw: Draw) -> str:
    """A sum over a denominator."""
    side = polynomial(parts, draw)
    return side if divisor == 1 else f"<mfrac><mrow>{side}</mrow><mn>{digits(divisor)}</mn></mfrac>"


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


def _line_starts(parts: list[Monomial]) -> list[int]:
    """The numbers of the monomials with which the lines of a sum begin."""
    starts, used = [0], 0
    for k, (coefficient, powers) in enumerate(parts):
        letters = 3 + len(str(coefficient)) + sum(len(variable) + (power > 1) for variable, power in powers)
        if k and used + letters > LINE:
            starts, used = [*starts, k], 0
        used += letters
    return starts


def _in_lines(parts: list[Monomial], starts: list[int], draw: Draw, end: str) -> str:
    """A long sum in lines, with what follows it at the end of the last one."""
    lines = [polynomial(parts[a:b], draw, follows=a > 0) for a, b in pairwise([*starts, len(parts)])]
    lines[-1] = f"<mrow>{lines[-1]}{end}</mrow>"
    rows = "".join(f"<mtr><mtd{LEFT}>{line}</mtd></mtr>" for line in lines)
    return f"<mtable columnalign='left'>{rows}</mtable>"


def polynomial(parts: list[Monomial], draw: Draw = name, *, follows: bool = False) -> str:
    """A sum of monomials (``qe.formula.notation.monomials``); ``follows``: it goes on with one that stands before."""
    pieces: list[str] = []
    for coefficient, powers in parts:
        if coefficient < 0 or pieces or follows:
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

"""Presentation MathML: mathematical notation that browsers draw without any library, with lines broken sensibly."""

from __future__ import annotations

import re
from collections.abc import Callable
from html import escape
from itertools import pairwise

from qe.exact.ring import Poly
from qe.formula import notation
from qe.formula.comparison import Range, end_text, ranges, sides
from qe.formula.features import length
from qe.formula.linear_forms import in_linear_forms, with_forms
from qe.formula.notation import Level, Monomial, Notation, positive
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Or, Relation
from qe.io.latex import GREEK
from qe.spelling import PI, visible

WIDTH = 12
"""Leaves (monomials) after which an operator is written in lines."""
LINE = 72
"""Letters in a line of a longer polynomial; browsers break no formula themselves, and paper does not scroll."""

_LETTERS = dict(zip(sorted(GREEK), "αβχδεηγικλμνωφπψρστθυξζ"))
_NAME = re.compile(r"([^\W\d_]+)_?(\d*)('*)")
_RELATIONS = {Relation.NE: "≠", Relation.LE: "≤", Relation.GE: "≥"}
_BARE = re.compile(r"(<m[ino]\b[^>]*>.*?</m[ino]>|<[^>]*>)|([0-9]+)|\s*([-+])\s*|\s+")
"""What is an element already, or a number, a sign, or a space between elements."""


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
    """A ``<math>`` element in display style; there is a row for each operand where there is much of them."""
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">{in_rows(formula)}</math>'


def expression(formula: Formula, *, level: Level = Level.OPEN, draw: Draw = name) -> str:
    """A formula, ``level``: inside of what."""
    if not hasattr(formula, "written"):
        raise TypeError(f"not a formula: {formula!r}")
    return _marked(formula.written(_notation(draw), level, False))


def in_rows(formula: Formula, level: Level = Level.OPEN) -> str:
    """A formula; operands stand in rows of a table where there is much of them, long polynomials in several lines."""
    match formula:
        case Atom():
            return _in_lines(formula)
        case Exists(variables, body) | ForAll(variables, body):
            prefix = _DRAWN.quantifier(isinstance(formula, ForAll), variables)
            inner = f"<mrow>{prefix}{in_rows(body)}</mrow>"
        case And(args) | Or(args) if length(formula)[1] > WIDTH:
            own, operator = (Level.AND, _AND) if isinstance(formula, And) else (Level.OR, _OR)
            drawn = (
                _marked(part.written(_DRAWN)) if isinstance(part, Range) else in_rows(part, own)
                for part in (ranges(args) if own is Level.AND else args)
            )
            rows = (
                f"<mtr><mtd>{operator if i else ''}</mtd><mtd{LEFT}>{row}</mtd></mtr>" for i, row in enumerate(drawn)
            )
            inner = f"<mtable columnalign='right left'>{''.join(rows)}</mtable>"
        case _:
            return expression(formula, level=level)
    return inner if level is Level.OPEN else bracketed(inner)


def bracketed(inner: str) -> str:
    """The expression in brackets."""
    return inner.join(_DRAWN.brackets)


def polynomial(parts: list[Monomial], draw: Draw = name) -> str:
    """A sum of monomials (``qe.formula.notation.monomials``)."""
    return _marked(notation.polynomial(parts, _notation(draw)))


def _marked(text: str) -> str:
    """A row of elements, of what is written with signs and numbers between them."""

    def element(part: re.Match[str]) -> str:
        known, number, sign = part.groups()
        return known or (number and f"<mn>{number}</mn>") or (sign and f"<mo>{sign.replace('-', '−')}</mo>") or ""

    return f"<mrow>{_BARE.sub(element, text)}</mrow>"


def _in_lines(atom: Atom) -> str:
    """A comparison, its long sum in lines, with what follows it at the end of the last one."""
    whole = expression(atom)
    if len(re.sub("<[^>]*>", "", whole)) <= LINE:
        return whole
    poly, forms = in_linear_forms(atom.poly)
    drawn = with_forms(forms, _DRAWN)
    parts, relation, right, divisor = sides(poly, atom.relation)
    texts = [notation.polynomial(parts[a:b], drawn) for a, b in pairwise([*_line_starts(parts), len(parts)])]
    texts[-1] += _DRAWN.relation(relation) + end_text(right, divisor, drawn)
    lines = [text if not k or text[0] == "-" else f"+{text}" for k, text in enumerate(texts)]
    rows = "".join(f"<mtr><mtd{LEFT}>{_marked(line)}</mtd></mtr>" for line in lines)
    return f"<mtable columnalign='left'>{rows}</mtable>" if len(lines) > 1 else whole


def _line_starts(parts: list[Monomial]) -> list[int]:
    """The numbers of the monomials with which the lines of a sum begin."""
    starts, used = [0], 0
    for k, (coefficient, powers) in enumerate(parts):
        letters = 3 + len(str(coefficient)) + sum(len(variable) + (power > 1) for variable, power in powers)
        if k and used + letters > LINE:
            starts, used = [*starts, k], 0
        used += letters
    return starts


def _power(base: str, k: int) -> str:
    indexed = base.startswith("<msub>")  # the power then stands above the index, not after it
    return f"<msubsup>{base[6:-7]}<mn>{k}</mn></msubsup>" if indexed else f"<msup>{base}<mn>{k}</mn></msup>"


def _notation(draw: Draw) -> Notation:
    def quantifier(universal: bool, names: tuple[str, ...]) -> str:
        return f"<mrow><mo>{'∀' if universal else '∃'}</mo>{'<mo>,</mo>'.join(map(draw, names))}<mo>:</mo></mrow>"

    def root(variable: str, relation: Relation, poly: Poly, k: int) -> str:
        inside = notation.polynomial(positive(poly), made)
        kth = f"<msub><mi>root</mi><mn>{k}</mn></msub>"
        return f"{draw(variable)}{made.relation(relation)}{kth}{inside.join(made.brackets)}"

    made = Notation(
        name=draw,
        relation=lambda relation: f"<mo>{_RELATIONS.get(relation) or escape(relation.value)}</mo>",
        quantifier=quantifier,
        root=root,
        conjunction=_AND,
        disjunction=_OR,
        negation="<mo>¬</mo>",
        true="<mi>true</mi>",
        false="<mi>false</mi>",
        times="<mo>&#x2062;</mo>",
        power=_power,
        brackets=('<mrow><mo form="prefix">(</mo>', '<mo form="postfix">)</mo></mrow>'),
        quotient="<mfrac><mrow>{}</mrow><mn>{}</mn></mfrac>".format,
        strict=True,
        customary=True,
    )
    return made


_AND, _OR = (f'<mo lspace="0.4em" rspace="0.4em">{sign}</mo>' for sign in "∧∨")
_DRAWN = _notation(name)

"""Formulas and exact numbers as MathML, which browsers draw without any script or font from elsewhere.

Variables such as ``q1x`` are shown as the paper writes them: Q with a hat, index 1, coordinate x.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from html import escape
from typing import Any

from bezier.curves.scalar import exact_text
from qe.decomposition.pieces import Piece, Range
from qe.formula.syntax import Formula
from qe.formula.traverse import conjuncts
from qe.io import mathml

_HATTED = re.compile(r'<mover accent="true"><mi>(.)</mi><mo>\^</mo></mover>')
_POINT = re.compile(r"([pqr])([0-9])([xyz])")


_ROW = re.compile(r"<mrow>(?!<mo>\()(.*)</mrow>", re.DOTALL)
_TAG = re.compile(r"<(/?)[a-z]+[^<>]*?(/?)>")
_OPERATORS = ("<mo>+</mo>", "<mo>−</mo>", "<mo>∧</mo>")


def math(body: str) -> str:
    """A ``<math>`` element."""
    return f'<math display="inline" displaystyle="true">{body}</math>'


def lines(body: str) -> str:
    """Mathematics as several ``<math>`` elements between which a line may end, before each +, − and ∧ of its parts.

    Browsers do not break lines inside of one.
    """
    pieces = [""]
    for part in _parts(body):
        if part in _OPERATORS and pieces[-1]:
            pieces.append(part.replace("<mo>", '<mo form="infix">'))
        else:
            pieces[-1] += part
    return "<wbr>".join(map(math, pieces))


def _parts(body: str) -> Iterator[str]:
    """The elements one after the other; the parts of a row that has no brackets around it instead of the row."""
    depth = start = 0
    for tag in _TAG.finditer(body):
        depth += -1 if tag[1] else 0 if tag[2] else 1
        if depth == 0:
            part, start = body[start : tag.end()], tag.end()
            row = _ROW.fullmatch(part)
            if row is None:
                yield part
            else:
                yield from _parts(row[1])


def name(text: str) -> str:
    """A variable or the name of a control point."""
    if match := _POINT.fullmatch(text):
        return _indexed(match[1].upper(), f"<mrow><mn>{match[2]}</mn><mi>{match[3]}</mi></mrow>")
    if re.fullmatch(r"[PQR][0-9]", text):
        return _indexed(text[0], f"<mn>{text[1]}</mn>")
    return f"<mi>{escape(text)}</mi>"


def _indexed(letter: str, index: str) -> str:
    return f'<msub><mover accent="true"><mi>{letter}</mi><mo>^</mo></mover>{index}</msub>'


def without_hats(page: str) -> str:
    """A page with the names of points as in the paper's formula (7), where only the quadratic curves have hats."""
    return _HATTED.sub(r"<mi>\1</mi>", page).replace("\\u0302", "").replace("\u0302", "")


def number(value: Any) -> str:
    """An exact number, with fractions and roots drawn as such."""
    return number_text(exact_text(value))


def number_text(text: str) -> str:
    """An exact number given as text, such as ``(3 - sqrt(5))/2``."""
    try:
        tree = ast.parse(text.replace("^", "**"), mode="eval").body
    except SyntaxError:
        return f"<mtext>{escape(text)}</mtext>"
    return _expression(tree)


def _expression(node: ast.expr) -> str:
    match node:
        case ast.Constant(value):
            return f"<mn>{value!r}</mn>"
        case ast.Name(id):
            return name(id)
        case ast.UnaryOp(ast.USub(), operand):
            return f"<mrow><mo>−</mo>{_wrapped(operand, ast.BinOp)}</mrow>"
        case ast.BinOp(left, ast.Div(), right):
            return f"<mfrac>{_expression(left)}{_expression(right)}</mfrac>"
        case ast.BinOp(left, ast.Mult(), right):
            plain = isinstance(right, ast.Call | ast.Name) or isinstance(getattr(right, "op", None), ast.Pow)
            sign = "" if plain else "<mo>·</mo>"
            return f"<mrow>{_wrapped(left, None)}{sign}{_wrapped(right, None)}</mrow>"
        case ast.BinOp(left, ast.Pow(), right):
            return f"<msup>{_wrapped(left, ast.BinOp)}{_expression(right)}</msup>"
        case ast.BinOp(left, operator, right):
            sign = "+" if isinstance(operator, ast.Add) else "−"
            return f"<mrow>{_expression(left)}<mo>{sign}</mo>{_wrapped(right, None)}</mrow>"
        case ast.Call(ast.Name("sqrt"), [inner]):
            return f"<msqrt>{_expression(inner)}</msqrt>"
        case ast.Call(ast.Name(id), arguments):
            inside = "<mo>,</mo>".join(map(_expression, arguments))
            return f"<mrow><mi>{escape(id)}</mi>{mathml.bracketed(inside)}</mrow>"
    return f"<mtext>{escape(ast.unparse(node))}</mtext>"


def _wrapped(node: ast.expr, kind: type[ast.expr] | None) -> str:
    """With brackets around sums (and around any operation, for ``kind`` BinOp)."""
    additive = isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub))
    is_product = isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Div, ast.Mult))
    needed = additive or (kind is not None and isinstance(node, kind) and not is_product)
    return mathml.bracketed(_expression(node)) if needed else _expression(node)


def vector(values: Iterable[Any]) -> str:
    """A point as a row of exact numbers."""
    return mathml.bracketed("<mo>,</mo>".join(map(number, values)))


def formula(node: Formula) -> str:
    """A formula on one line."""
    return mathml.expression(node, draw=name)


def conjunction_lines(node: Formula) -> list[str]:
    """The parts of a conjunction, each as mathematics between whose parts a line may end; or anything else as one."""
    return [lines(formula(part)) for part in conjuncts(node)]


def cell(piece: Piece) -> list[str]:
    """One ``<math>`` element per variable."""
    return [math(bounds(r)) for r in piece.ranges]


def bounds(item: Range) -> str:
    """``lower <= x < upper``, or ``x = value``."""
    middle = name(item.variable)
    if item.is_point and item.lower is not None:
        return f"<mrow>{middle}<mo>=</mo>{number_text(str(item.lower))}</mrow>"
    left = "" if item.lower is None else f"{number_text(str(item.lower))}<mo>{_relation(item.lower_closed)}</mo>"
    right = "" if item.upper is None else f"<mo>{_relation(item.upper_closed)}</mo>{number_text(str(item.upper))}"
    free = "" if left or right else "<mo>∈</mo><mi>ℝ</mi>"
    return f"<mrow>{left}{middle}{right}{free}</mrow>"


def _relation(closed: bool) -> str:
    return "≤" if closed else "&lt;"

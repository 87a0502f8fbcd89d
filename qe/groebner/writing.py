"""Comprehensive Groebner systems for people: LaTeX and HTML."""

from __future__ import annotations

from collections.abc import Sequence

from qe.exact.ring import Poly
from qe.formula.build import atom
from qe.formula.syntax import TRUE, Formula, Relation
from qe.io import latex, mathml

_STYLE = "border-collapse:collapse", "border-bottom:1px solid #ccc;padding:0.4em 1em;vertical-align:top;text-align:left"


def system_to_latex(rows: Sequence[tuple[Formula, Sequence[Poly]]]) -> str:
    """An array: the condition of a segment beside the equations of its basis."""
    bases = (" \\\\ ".join(map(latex.write, _equations(basis))) for _, basis in rows)
    arrays = (f"\\begin{{array}}{{l}}{equations}\\end{{array}}" for equations in bases)
    lines = [f"{latex.write(condition)} & {array}" for (condition, _), array in zip(rows, arrays, strict=True)]
    return "\\begin{array}{l|l}\n" + " \\\\ \\hline\n".join(lines) + "\n\\end{array}"


def system_to_html(rows: Sequence[tuple[Formula, Sequence[Poly], int]]) -> str:
    """A table: the condition of a segment, the equations of its basis, the dimension of the solutions."""
    table, cell = _STYLE
    head = "".join(f'<th style="{cell}">{title}</th>' for title in ("segment", "basis", "dimension of the solutions"))
    body = []
    for condition, basis, dimension in rows:
        equations = "<br>".join(mathml.write(f) for f in _equations(basis))
        size = "no solutions" if dimension < 0 else str(dimension)
        cells = "".join(f'<td style="{cell}">{text}</td>' for text in (mathml.write(condition), equations, size))
        body.append(f"<tr>{cells}</tr>")
    return f'<table style="{table}"><tr>{head}</tr>{"".join(body)}</table>'


def _equations(basis: Sequence[Poly]) -> list[Formula]:
    """The basis as equations: "false" for the unit ideal, "true" for the zero ideal."""
    return [atom(p, Relation.EQ) for p in basis] or [TRUE]
